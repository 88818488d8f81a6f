"""Measure how large the page of a run is, how long it takes to lay out, and how soon a browser shows it."""

import argparse
import shutil
import tempfile
import time
from pathlib import Path

import numpy as np
from playwright.sync_api import sync_playwright

import pointchart as pc
from pointchart import shapes
from pointchart.clock import StageClock
from pointchart.look.page import compose
from pointchart.report.mesh_facts import mesh_facts
from pointchart.report.record import RunReport, Stage
from pointchart.runs.execution.measured import measure_mesh

DRAWING_IN_SOFTWARE = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, nargs="*", default=[3_000, 30_000, 300_000, 1_000_000])
    given = parser.parse_args()
    print("| points | drawn | MB | laid out, s | shown, s |\n|---:|---:|---:|---:|---:|")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        program = shutil.which("chromium") or shutil.which("google-chrome")
        browser = playwright.chromium.launch(executable_path=program, args=DRAWING_IN_SOFTWARE)
        for n in given.points:
            scan = shapes.sculpture(n).points
            result = pc.reconstruct(scan)
            points = scan[result.rows]
            meshed = measure_mesh(scan, np.arange(len(scan)), result, StageClock())
            run = RunReport("mesh", stages=(Stage("mesh", 1.0),), facts=mesh_facts(meshed, {}))
            start = time.perf_counter()
            laid = compose(points, result, run, title="a scan", command="")
            laid_out = time.perf_counter() - start
            path = Path(folder) / "page.html"
            path.write_text(laid.text, "utf-8")
            shown = sorted(seconds_to_show(browser, path) for _ in range(3))[1]
            size = path.stat().st_size / 1e6
            print(f"| {laid.n_points:,} | {laid.n_drawn:,} | {size:.2f} | {laid_out:.1f} | {shown:.2f} |", flush=True)
        browser.close()


def seconds_to_show(browser, path: Path) -> float:
    """Open a page in a new window, up to its second picture."""
    page = browser.new_page(viewport={"width": 1400, "height": 900})
    start = time.perf_counter()
    page.goto(path.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    seconds = time.perf_counter() - start
    page.close()
    return seconds


if __name__ == "__main__":
    main()
