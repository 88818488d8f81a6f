"""What tests of the app do in its window, and the programs that stand for runs there."""

import sys
import time
from functools import partial
from http.client import HTTPConnection

import numpy as np

from pointchart import shapes
from pointchart.app.picking import project
from pointchart.app.result_steps import MESH
from pointchart.app.step import Step
from pointchart.app.step_files import StepFiles
from pointchart.boundary import reversed_loop
from pointchart.runs.mesh_run import MeshRun
from pointchart.runs.process import RunProcess

N = 200
RELIEF = shapes.relief(N, seed=2)
TRUE = np.asarray(RELIEF.boundary)
MISSED, INNER = int(TRUE[10]), int(np.argmin(np.linalg.norm(RELIEF.points[:, :2], axis=1)))
WRONG = np.where(TRUE == MISSED, INNER, TRUE)
CROSSED = np.concatenate([TRUE[:10], reversed_loop(TRUE[10:30]), TRUE[30:]])
PATIENCE = 150_000  # milliseconds that a busy machine may take that still compiles the kernels
MADE = "mesh-made.ply"
# Programs that take a run from stdin and tell what happens, as the process of a run does.
READ = """
import os, pickle, sys, time
run, folder = pickle.load(sys.stdin.buffer)
os.chdir(folder)
from pathlib import Path
from pointchart import SolveError
from pointchart.report.record import Check, RunReport
def tell(event):
    pickle.dump(event, sys.stdout.buffer)
    sys.stdout.flush()
"""
SLEEPS = sys.executable, "-c", f"{READ}tell(('sleep', 5)); time.sleep(600)"
WRITES = (
    sys.executable,
    "-c",
    f"{READ}Path(run.out).write_text('made'); tell(RunReport('mesh', checks=(Check('made', True),)))",
)
WRITES_SILENTLY = sys.executable, "-c", f"{READ}Path(run.out).write_text('made'); tell(RunReport('mesh'))"
FAILS = sys.executable, "-c", f"{READ}tell(SolveError('it is refused'))"
NAMES_ITS_LOOP = sys.executable, "-c", f"{READ}tell(SolveError(str(run.given.boundary)))"


def ask(page, path, **headers):
    connection = HTTPConnection("127.0.0.1", page.server.get_port())
    try:
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(errors="replace"), answer
    finally:
        connection.close()


def token_of(page):
    return page.address.rstrip("/").rpartition("/")[2]


def run_as(monkeypatch, program):
    """Have pages hand their runs to another program."""
    monkeypatch.setattr("pointchart.app.runner.RunProcess", partial(RunProcess, program=program))


def mesh_step(page):
    """Return a step of the page that makes a mesh and shows nothing."""
    return Step(page, MeshRun, "Stub", MESH, files=StepFiles(MADE, "mesh.ply"), take=lambda: None)


def drag_with_shift(window, page, corners):
    """Draw a closed line round corners, places of the picture, not faster than the browser tells of it."""
    box = window.locator("canvas").first.bounding_box()
    places = np.array([box["x"], box["y"]]) + corners * [box["width"], box["height"]]
    window.keyboard.down("Shift")
    window.mouse.move(*places[0])
    window.mouse.down()
    for corner, place in zip(np.roll(corners, -1, axis=0), np.roll(places, -1, axis=0), strict=True):
        window.mouse.move(*place, steps=5)
        until(lambda at=corner: np.abs(last_corner(page) - at).max() < 0.01)
    window.mouse.up()
    window.keyboard.up("Shift")
    until(lambda: not page.server.scene.get_handle_by_name("/cloud/polygon"))


def last_corner(page):
    """Return where in the picture the last corner of the polygon is seen."""
    (client,) = page.server.get_clients().values()
    drawn = page.server.scene.get_handle_by_name("/cloud/polygon")
    return np.full(2, np.inf) if drawn is None else project(drawn.points[-1, :1], page.drawing.camera(client))[0]


def line_shown(window):
    return window.locator(".command code").locator("visible=true").inner_text()


def tab(window, name):
    window.get_by_role("tab", name=name).click()


def choose(window, label, word):
    window.get_by_label(label, exact=True).first.click()
    window.get_by_role("option", name=word, exact=True).click()
    window.get_by_role("listbox").locator("visible=true").wait_for(state="hidden")


def fill(window, label, word):
    """Write into the visible text field behind a label."""
    field = f"xpath=//label[.='{label}']/following::*[self::input or self::textarea][1]"
    window.locator(field).locator("visible=true").fill(word)


def click_point(window, page, row):
    """Click where a point is seen."""
    (client,) = page.server.get_clients().values()
    box = window.locator("canvas").first.bounding_box()
    x, y = project(page.drawing.places[row : row + 1], page.drawing.camera(client))[0]
    window.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"], delay=60)


def press(window, name):
    window.get_by_role("button", name=name, exact=True).click()


def download(window, name, path):
    with window.expect_download() as promised:
        press(window, name)
    promised.value.save_as(path)
    return path


def until(condition):
    end = time.monotonic() + PATIENCE / 1000
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    assert condition()


def off_centre(page, client):
    """Return the point that is seen in the picture, not in its middle, and farthest from all others."""
    seen = project(page.drawing.places, page.drawing.camera(client))
    from_middle = np.abs(seen - 0.5).max(axis=1)
    away = np.linalg.norm(seen[:, None] - seen, axis=2) + 9.0 * np.eye(N)
    return int(np.argmax(np.where((from_middle > 0.2) & (from_middle < 0.45), away.min(axis=1), 0.0)))


def place_of(row):
    return ",".join(f"{x:.9g}" for x in RELIEF.points[row])
