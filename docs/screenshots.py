"""Take the pictures of the page and of the browser app, by Chromium: ``python docs/screenshots.py docs/figures``."""

import os
import shutil
import subprocess
import sys
import tempfile
from contextlib import closing
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright
from pointchart.app.job import PROGRAM

from pointchart import read_scan, shapes, write_mesh
from pointchart.app.browser_app import open_page
from pointchart.cli.view import commands

# Drawn in software, so that every machine gives the same picture.
DRAWN = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
DRAWING = 3000  # milliseconds in which all that has been sent is drawn
NO_WORD_OF_SOFTWARE = ".mantine-Notifications-root { display: none }"


def take(page, path):
    """Take a picture of a page, in few colours so that it is small."""
    Image.open(BytesIO(page.screenshot())).convert("RGB").quantize(200, dither=Image.Dither.NONE).save(
        path, optimize=True
    )


def report(browser, out):
    """Take the page of a run, coloured by stretch, with a point lit up in both views."""
    subprocess.run([*PROGRAM, "mesh", "demo.ply", "-o", "mesh.ply", "--html", "run.html", "--quiet"], check=True)
    page = browser.new_page(viewport={"width": 1400, "height": 930})
    page.goto(Path("run.html").absolute().as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    page.select_option("#shade", "stretch")
    box = page.locator("#space").bounding_box()
    page.mouse.move(box["x"] + 0.46 * box["width"], box["y"] + 0.6 * box["height"])
    page.wait_for_timeout(DRAWING)
    take(page, out / "report.png")
    page.close()


def app(browser, out):
    """Take the app with points of the boundary that are selected, and with the mesh."""
    with closing(open_page(Path("demo.ply"), read_scan(Path("demo.ply")), commands())) as opened:
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        page.goto(opened.entrance)
        page.get_by_role("tab", name="Boundary").click()
        page.add_style_tag(content=NO_WORD_OF_SOFTWARE)
        page.get_by_role("button", name="Find the boundary").click()
        page.get_by_text("a loop of").first.wait_for()
        box = page.locator("canvas").first.bounding_box()
        page.keyboard.down("Shift")
        around = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
        for turn in around:
            radius = 0.13 + 0.02 * np.sin(3.0 * turn)
            page.mouse.move(
                box["x"] + box["width"] * (0.5 + radius * np.cos(turn)),
                box["y"] + box["height"] * (0.17 + radius * np.sin(turn)),
            )
            if turn == 0.0:
                page.mouse.down()
            page.wait_for_timeout(60)
        page.mouse.up()
        page.keyboard.up("Shift")
        page.get_by_text("selected,").wait_for()
        page.wait_for_timeout(DRAWING)
        take(page, out / "view_boundary.png")
        page.get_by_role("button", name="Clear", exact=True).click()
        page.get_by_role("tab", name="Mesh").click()
        page.get_by_role("button", name="Make the mesh").click()
        page.get_by_text("a certified disc").first.wait_for()
        page.wait_for_timeout(DRAWING)
        take(page, out / "view_mesh.png")


def main(out):
    """Take all pictures."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        scans = Path(folder, "scans")
        scans.mkdir()
        os.chdir(scans)
        write_mesh("demo.ply", shapes.demo_scan().points, np.empty((0, 3), int))
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=DRAWN)
        report(browser, out)
        app(browser, out)
        browser.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]).absolute())
