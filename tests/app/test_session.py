import threading
from contextlib import nullcontext
from unittest.mock import MagicMock

import numpy as np
import pytest
from windows import INNER, PATIENCE, RELIEF, N, ask, choose, click_point, fill, tab, until

import pointchart as pc
from pointchart import read_scan
from pointchart.app import cloud_steps, guard
from pointchart.app import frame_rate as pace
from pointchart.app.browser_app import open_page
from pointchart.app.cloud_steps import SHOW
from pointchart.app.one_neighborhood import Around
from pointchart.app.picking import project

HARMLESS = ("THREE.Clock", "not on your GPU")


def test_the_page_opens_with_the_six_steps_and_no_error(window):
    names = ["Cloud", "Neighbourhoods", "Boundary", "UV", "Mesh", "Surface"]
    assert window.get_by_role("tab").all_inner_texts() == names
    window.get_by_text(f"{N} points").first.wait_for()
    faults = [words for words in window.words if words[0] in ("error", "warning")]
    assert [words for words in faults if not any(known in words[1] for known in HARMLESS)] == []


def test_a_click_shows_the_neighbourhood_of_a_point(window, page):
    tab(window, "Neighbourhoods")
    choose(window, "A click", SHOW)
    click_point(window, page, INNER)
    star = pc.delaunay_star(RELIEF.points, pc.nearest(RELIEF.points, 20))
    window.get_by_text(f"a star of {star.sizes[INNER]} neighbours").wait_for()
    choose(window, "Neighbourhood", "nearest")
    window.get_by_text("its 20 neighbours").wait_for()
    window.get_by_text("--neighbors nearest").first.wait_for()
    fill(window, "Radius", "0.3")
    window.get_by_text("--neighbors nearest takes -k and no --radius").first.wait_for()
    until(lambda: not page.server.scene.get_handle_by_name("/cloud/around"))
    assert window.get_by_text("its 20 neighbours").count() == 0
    fill(window, "Radius", "")
    choose(window, "Neighbourhood", "(default)")
    for word, sentence in (("3.7", "-k is '3.7'; a whole number is needed"), ("1000000000", "k is 1000000000, but of")):
        fill(window, "k nearest", word)
        window.get_by_text(sentence).first.wait_for()
    fill(window, "k nearest", "")
    window.get_by_text(f"a star of {star.sizes[INNER]} neighbours").wait_for()


def test_of_many_requests_the_one_under_way_and_the_newest_are_drawn(monkeypatch):
    is_begun, may_end, page = threading.Event(), threading.Event(), MagicMock(reporting=lambda *_: nullcontext())
    step = cloud_steps.NeighborhoodStep(page)
    step.controls = MagicMock(values={})

    def slowly(points, center, *_, **__):
        is_begun.set()
        may_end.wait(PATIENCE / 1000)
        return Around(center, np.array([7]), np.array([1.0]), is_star=False, is_open=False)

    monkeypatch.setattr(cloud_steps, "around_point", slowly)
    threads = [threading.Thread(target=step.pick, args=(row, None)) for row in (1, 2, 3, 4)]
    for asked, thread in enumerate(threads, start=1):
        thread.start()
        assert is_begun.wait(PATIENCE / 1000)
        until(lambda asked=asked: step._asked == asked)
    may_end.set()
    for thread in threads:
        thread.join(PATIENCE / 1000)
    drawn = [call.args[0].center for call in page.drawing.draw_around.call_args_list]
    assert drawn == [1, 4]


def test_a_narrow_window_shows_the_whole_scan(browser, bare):
    with browser.new_context(viewport={"width": 720, "height": 500}, device_scale_factor=0.5) as context:
        shown = context.new_page()
        shown.goto(bare.address)
        shown.get_by_text("A click").wait_for(timeout=PATIENCE)
        until(bare.server.get_clients)
        (client,) = bare.server.get_clients().values()
        until(lambda: client.camera.aspect < 0.6)
        until(lambda: np.abs(project(bare.drawing.places, bare.drawing.camera(client)) - 0.5).max() < 0.5)


def test_less_is_drawn_while_a_slow_browser_turns_the_scan(browser, bare, monkeypatch):
    monkeypatch.setattr(pace, "SLOW", -1.0)
    monkeypatch.setattr(pace, "GAIN", np.inf)
    fine, coarse, places = bare.drawing._fine, bare.drawing._coarse, iter(range(10**9))
    with browser.new_context(viewport={"width": 800, "height": 500}, device_scale_factor=0.5) as context:
        shown = context.new_page()
        shown.goto(bare.address)
        shown.get_by_text("A click").wait_for(timeout=PATIENCE)
        shown.locator("canvas").first.wait_for()
        shown.mouse.move(100, 250)
        shown.mouse.down()
        until(lambda: shown.mouse.move(100 + 9 * (next(places) % 9), 250) or not any(frame.visible for frame in fine))
        shown.mouse.up()
        until(lambda: all(frame.visible for frame in fine) and not any(frame.visible for frame in coarse))


def test_a_page_whose_app_has_ended_says_so(browser, bare):
    with browser.new_context(viewport={"width": 480, "height": 300}, device_scale_factor=0.5) as context:
        shown = context.new_page()
        shown.goto(bare.address)
        shown.get_by_text("A click").wait_for(timeout=PATIENCE)
        bare.close()
        shown.get_by_text("ended; start pointchart view again").wait_for(timeout=PATIENCE)


def test_points_keep_their_size_when_the_cloud_gets_other_colours(bare):
    bare.drawing.size_points(2.0)
    size = bare.server.scene.get_handle_by_name("/cloud/fine/points").point_size
    bare.drawing.color_cloud(np.ones((N, 3)))
    assert bare.server.scene.get_handle_by_name("/cloud/fine/points").point_size == size


def test_an_error_that_nobody_foresaw_is_shown_and_logged(bare, caplog):
    told = []
    with bare.reporting("mesh", told.append):
        raise OSError(28, "No space left on device")
    assert told == [
        "this went wrong on the page itself (OSError: [Errno 28] No space left on device); the terminal shows where"
    ]
    assert "Traceback" in caplog.text


@pytest.mark.parametrize("fails", ["browser_app.MeshStep", "session.Drawing"])
def test_a_page_interrupted_while_it_is_built_leaves_no_folder_and_no_server(scan_file, monkeypatch, fails):
    def interrupt(*_):
        raise KeyboardInterrupt

    told = []
    monkeypatch.setattr(f"pointchart.app.{fails}", interrupt)
    with pytest.raises(KeyboardInterrupt):
        open_page(scan_file, read_scan(scan_file), tell_close=told.append)
    page = told[0].__self__
    assert not page.folder.exists()
    with pytest.raises(ConnectionRefusedError):
        ask(page, "/")


def test_view_says_which_extra_to_install(command_line, scan_file, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    sentence = "pointchart: view needs viser; install it by: pip install 'pointchart[view]'\n"
    assert command_line("view", scan_file) == (1, "", sentence)


def test_a_bad_scan_is_refused_before_a_server_starts(command_line, tmp_path, monkeypatch):
    monkeypatch.setattr(guard, "LocalServer", None)
    (tmp_path / "line.xyz").write_text("0 0 0\n1 1 1\n2 2 2\n3 3 3\n")
    refused = [command_line("view", tmp_path / name)[2] for name in ("line.xyz", "missing.ply")]
    refused += [
        command_line("mesh", tmp_path / name, "-o", tmp_path / "m.ply")[2] for name in ("line.xyz", "missing.ply")
    ]
    assert refused[:2] == refused[2:]
