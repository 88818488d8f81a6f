"""Pages of the app: in a browser, and without one."""

import numpy as np
import pytest
from windows import PATIENCE, RELIEF, WRONG, N

import pointchart as pc
from pointchart import read_scan
from pointchart.app import boundary_step
from pointchart.app.browser_app import open_page
from pointchart.app.loop_by_hand import LoopByHand

STILL = """document.addEventListener("DOMContentLoaded", () => {
    const rule = "*, *::before, *::after { transition: none !important; animation: none !important; }"
        + ".mantine-Notifications-root * { pointer-events: none !important; }";
    document.head.insertAdjacentHTML("beforeend", `<style>${rule}</style>`);
});"""


@pytest.fixture(scope="module")
def scan_file(tmp_path_factory):
    """Write the scan where names have a blank, as a shell has to be told."""
    path = tmp_path_factory.mktemp("my scans") / "relief.ply"
    pc.write_mesh(path, RELIEF.points, np.empty((0, 3), int))
    return path


@pytest.fixture(scope="module")
def page(scan_file):
    opened = open_page(scan_file, read_scan(scan_file), loop=WRONG)
    yield opened
    opened.close()
    assert not opened.folder.exists()


@pytest.fixture(scope="module")
def opened(browser, page):
    """Return the page in a browser, with what it writes to its console."""
    with browser.new_context(viewport={"width": 880, "height": 560}, device_scale_factor=0.5) as context:
        context.add_init_script(STILL)
        shown = context.new_page()
        shown.set_default_timeout(PATIENCE)
        shown.words = []
        shown.on("console", lambda line: shown.words.append((line.type, line.text)))
        shown.on("pageerror", lambda error: shown.words.append(("error", str(error))))
        shown.goto(page.address)
        shown.get_by_text("A click").wait_for()
        yield shown


@pytest.fixture
def bare(scan_file):
    """Return a page that no browser has opened."""
    opened = open_page(scan_file, read_scan(scan_file), loop=WRONG)
    yield opened
    opened.close()


@pytest.fixture
def window(opened, page):
    """Return the page in a browser with the wrong loop, whatever tests ran before."""
    page.hand = LoopByHand(N, WRONG)
    page.views.look_at("cloud")
    page.loop_changed()
    return opened


@pytest.fixture
def by_hand(bare):
    """Return a page that no browser has opened, its step of the boundary, and what it says."""
    said = []
    bare.on_loop.clear()
    step = boundary_step.BoundaryStep(bare)
    bare.notify = lambda title, sentence, **_: said.append(sentence)
    return bare, step, said
