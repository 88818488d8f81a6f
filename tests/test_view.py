import re
import shlex
import signal
import socket
import sys
import threading
import time
from _thread import interrupt_main
from contextlib import closing, nullcontext
from functools import partial
from http.client import HTTPConnection
from types import SimpleNamespace
from unittest.mock import MagicMock

import numpy as np
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import pointchart as pc
from pointchart import InputError, PointchartError, read_scan, shapes
from pointchart.app import boundary_step, cloud_steps, guard, job, result_steps
from pointchart.app import frame_rate as pace
from pointchart.app.boundary_step import DROP, INSERT, OUTER
from pointchart.app.browser_app import open_page
from pointchart.app.cloud_steps import SHOW
from pointchart.app.html import OTHERWISE, dimmed_html, refused_html
from pointchart.app.job import Cancelled, Job
from pointchart.app.loop_by_hand import LoopByHand
from pointchart.app.one_neighborhood import Around
from pointchart.app.picking import Camera, project
from pointchart.app.step import Step
from pointchart.boundary import is_same_loop, reversed_loop
from pointchart.cli import aside
from pointchart.cli.view import commands
from pointchart.io import read_loop, write_loop
from pointchart.plane.polygons import is_inside

N = 200
RELIEF = shapes.relief(N, seed=2)
TRUE = np.asarray(RELIEF.boundary)
MISSED, INNER = int(TRUE[10]), int(np.argmin(np.linalg.norm(RELIEF.points[:, :2], axis=1)))
WRONG = np.where(TRUE == MISSED, INNER, TRUE)
CROSSED = np.concatenate([TRUE[:10], reversed_loop(TRUE[10:30]), TRUE[30:]])
HARMLESS = ("THREE.Clock", "not on your GPU")
SECONDS = 40_000  # milliseconds that a busy machine may take
MADE = "mesh-made.ply"
STILL = """document.addEventListener("DOMContentLoaded", () => {
    const rule = "*, *::before, *::after { transition: none !important; animation: none !important; }"
        + ".mantine-Notifications-root * { pointer-events: none !important; }";
    document.head.insertAdjacentHTML("beforeend", `<style>${rule}</style>`);
});"""
ALL = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
LEFT = ALL * [0.501, 1.0]
IN_FRONT = Camera(np.array([0.0, 0.0, 9.0]), np.array([[1.0, 0, 0], [0, -1, 0], [0, 0, -1]]), fov=1.0, aspect=1.0)
SLEEPS = sys.executable, "-c", "import sys, time; print('stage sleep 5', file=sys.stderr, flush=True); time.sleep(600)"
WRITES = (
    sys.executable,
    "-c",
    "import sys; open(sys.argv[sys.argv.index('-o') + 1], 'w').write('made'); print('[ok] made', file=sys.stderr)",
)
FAILS = sys.executable, "-c", "raise SystemExit('pointchart: it is refused')"


@pytest.fixture(scope="module")
def scan_file(tmp_path_factory):
    """Write the scan where names have a blank, as a shell has to be told."""
    path = tmp_path_factory.mktemp("my scans") / "relief.ply"
    pc.write_mesh(path, RELIEF.points, np.empty((0, 3), int))
    return path


@pytest.fixture(scope="module")
def page(scan_file):
    opened = open_page(scan_file, read_scan(scan_file), commands(), loop=WRONG)
    yield opened
    opened.close()
    assert not opened.folder.exists()


@pytest.fixture(scope="module")
def opened(browser, page):
    """Return the page in a browser, with what it writes to its console."""
    with browser.new_context(viewport={"width": 880, "height": 560}, device_scale_factor=0.5) as context:
        context.add_init_script(STILL)
        shown = context.new_page()
        shown.set_default_timeout(SECONDS)
        shown.words = []
        shown.on("console", lambda line: shown.words.append((line.type, line.text)))
        shown.on("pageerror", lambda error: shown.words.append(("error", str(error))))
        shown.goto(page.address)
        shown.get_by_text("A click").wait_for()
        yield shown


@pytest.fixture
def bare(scan_file):
    """Return a page that no browser has opened."""
    opened = open_page(scan_file, read_scan(scan_file), commands(), loop=WRONG)
    yield opened
    opened.close()


@pytest.fixture
def window(opened, page):
    """Return the page in a browser with the wrong loop, whatever tests ran before."""
    page.hand = LoopByHand(N, WRONG)
    page.look_at("cloud")
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
    """Have pages run another program than pointchart."""
    monkeypatch.setattr("pointchart.app.runner.Job", partial(Job, program=program))


def mesh_step(page):
    return Step(page, "mesh", "Stub", result_steps.MESH, works_on=MADE, out="mesh.ply", take=lambda: None)


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
    end = time.monotonic() + SECONDS / 1000
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    assert condition()


@pytest.mark.parametrize(
    "path", ["/", "/wrong/", "/{}x/", "//{}/", "/?token={}", "/%2e/{}/", "//[", "/{}?a=1", "/{}/?a=1"]
)
def test_without_its_token_alone_the_page_is_refused_with_a_sentence(page, path):
    status, body, _ = ask(page, path.format(token_of(page)))
    assert (status, body) == (403, f"{guard.REFUSED}\n")


def test_the_token_opens_the_page_and_no_cookie_tells_it_to_other_servers_of_this_machine(page):
    status, body, answer = ask(page, f"/{token_of(page)}/")
    assert (status, "<html" in body) == (200, True)
    assert "frame-ancestors 'none'" in answer.getheader("Content-Security-Policy")
    assert answer.getheader("Referrer-Policy") == "no-referrer"
    assert answer.getheader("Set-Cookie") is None
    assert ask(page, "/", Cookie=f"token={token_of(page)}")[0] == 403
    assert ask(page, f"/{token_of(page)}/none")[0] == 404
    assert ask(page, f"/{token_of(page)}/..%2f..%2fetc%2fpasswd")[0] == 404


def test_the_address_that_a_browser_is_started_with_opens_the_page_once(bare):
    """All users of a machine see the words of its processes."""
    entry = bare.entrance.removeprefix(f"http://127.0.0.1:{bare.server.get_port()}")
    assert token_of(bare) not in entry
    assert ask(bare, entry, Origin="http://evil.example")[0] == 403
    assert ask(bare, f"{entry}index.html")[0] == 403
    status, _, answer = ask(bare, entry)
    assert (status, answer.getheader("Location")) == (302, f"/{token_of(bare)}/")
    assert ask(bare, entry)[0] == 403
    assert ask(bare, f"/{token_of(bare)}/")[0] == 200


def test_the_address_that_a_browser_is_started_with_is_soon_closed(scan_file, monkeypatch):
    monkeypatch.setattr(guard, "ENTRY_SECONDS", 0.0)
    with closing(open_page(scan_file, read_scan(scan_file), commands())) as page:
        assert ask(page, page.entrance.partition(f":{page.server.get_port()}")[2])[0] == 403


def test_a_recording_that_someone_else_has_written_is_not_played(page):
    """Viser plays what its address names, scripts included: an address with more than the token is refused."""
    assert ask(page, f"/{token_of(page)}/?playbackPath=data:application/octet-stream;base64,AAAA")[0] == 403
    policy = ask(page, f"/{token_of(page)}/")[2].getheader("Content-Security-Policy")
    (connects,) = [part for part in policy.split("; ") if part.startswith("connect-src")]
    assert not {"blob:", "http:", "https:", "*"} & set(connects.split())


@pytest.mark.parametrize("host", ["evil.example", "evil.example:{}", "127.0.0.1", "127.0.0.1:1"])
def test_another_name_for_this_machine_is_refused(page, host):
    assert ask(page, f"/{token_of(page)}/", Host=host.format(page.server.get_port()))[0] == 403


def test_another_origin_is_refused_even_with_the_token(page):
    path = f"/{token_of(page)}/"
    assert ask(page, path, Origin="http://evil.example")[0] == 403
    assert ask(page, path, Origin="null")[0] == 403


@pytest.mark.parametrize("origin", ["http://evil.example", "http://localhost:{}", "https://127.0.0.1:{}", None])
def test_a_websocket_of_another_origin_or_none_is_refused(page, origin):
    port = page.server.get_port()
    with (
        pytest.raises(InvalidStatus) as refused,
        connect(f"ws://127.0.0.1:{port}/{token_of(page)}", origin=origin and origin.format(port)),
    ):
        pass
    assert refused.value.response.status_code == 403


def test_a_websocket_needs_the_token_and_opens_with_it(page):
    port = page.server.get_port()
    own = {"origin": f"http://127.0.0.1:{port}", "subprotocols": ["viser-v0"]}
    for path in ("", "/", "/wrong"):
        with pytest.raises(InvalidStatus), connect(f"ws://127.0.0.1:{port}{path}", **own):
            pass
    with connect(f"ws://127.0.0.1:{port}/{token_of(page)}", **own) as opened:
        assert opened.response.status_code == 101


def test_the_server_listens_on_loopback_only(page):
    assert page.server.get_host() == "127.0.0.1"
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", page.server.get_port()), timeout=5).close()


def test_a_server_that_answers_without_the_token_is_stopped_at_once(monkeypatch):
    monkeypatch.setattr(guard, "_guarding", lambda *_: nullcontext())
    with pytest.raises(InputError, match="answers without the token of the page, so it is not started"):
        guard.start_server("secret", "entry")


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
        window.get_by_text(sentence).wait_for()
    fill(window, "k nearest", "")
    window.get_by_text(f"a star of {star.sizes[INNER]} neighbours").wait_for()


def test_of_many_requests_the_one_under_way_and_the_newest_are_drawn(monkeypatch):
    is_begun, may_end, page = threading.Event(), threading.Event(), MagicMock(reporting=lambda *_: nullcontext())
    page.commands.rules.return_value = None, None
    step = cloud_steps.NeighbourhoodStep(page)
    step.controls = MagicMock(**{"value.return_value": ""})

    def slowly(points, centre, *_, **__):
        is_begun.set()
        may_end.wait(SECONDS / 1000)
        return Around(centre, np.array([7]), np.array([1.0]), is_star=False, is_open=False)

    monkeypatch.setattr(cloud_steps, "around_point", slowly)
    threads = [threading.Thread(target=step.pick, args=(row, None)) for row in (1, 2, 3, 4)]
    for asked, thread in enumerate(threads, start=1):
        thread.start()
        assert is_begun.wait(SECONDS / 1000)
        until(lambda asked=asked: step._asked == asked)
    may_end.set()
    for thread in threads:
        thread.join(SECONDS / 1000)
    drawn = [call.args[0].centre for call in page.drawing.draw_around.call_args_list]
    assert drawn == [1, 4]


def test_a_crossing_loop_is_refused_in_the_words_of_the_library(window, page):
    with pytest.raises(PointchartError) as reason:
        pc.reconstruct(RELIEF.points, loop=CROSSED)
    page.hand.change(CROSSED)
    page.loop_changed()
    tab(window, "Mesh")
    press(window, "Make the mesh")
    refused = window.locator(".refused")
    refused.wait_for()
    assert refused.inner_text() == str(reason.value)
    tab(window, "Boundary")
    press(window, "Undo")
    until(lambda: np.array_equal(page.hand.loop, WRONG))


def test_a_wrong_loop_is_mended_by_picking_and_the_mesh_exported_and_certified(
    window, page, scan_file, tmp_path, command_line, monkeypatch
):
    tab(window, "Boundary")
    choose(window, "A click", DROP)
    click_point(window, page, INNER)
    until(lambda: len(page.hand.loop) == len(TRUE) - 1)
    choose(window, "A click", INSERT)
    click_point(window, page, MISSED)
    until(lambda: is_same_loop(page.hand.loop, TRUE))
    loop = download(window, "Save the loop file", tmp_path / "loop.txt")
    assert is_same_loop(read_loop(loop), TRUE)
    tab(window, "Mesh")
    choose(window, "Domain", "square")
    press(window, "Make the mesh")
    window.get_by_text(f"a certified disc: {N} points").wait_for()
    made = download(window, "Export the mesh", tmp_path / "downloaded.ply")
    mesh = read_scan(made)
    uv = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    proof = pc.certify(RELIEF.points, mesh.triangles, uv=uv, loop=TRUE)
    assert proof.is_disc
    assert proof.is_one_to_one
    # The command line shown, run where the loop was saved, does the same.
    line = line_shown(window)
    assert line == f"pointchart mesh '{scan_file}' -o mesh.ply --boundary loop.txt --domain square"
    monkeypatch.chdir(tmp_path)
    assert command_line(*shlex.split(line)[1:])[0] == 0
    assert (tmp_path / "mesh.ply").read_bytes() == made.read_bytes()
    choose(window, "Domain", "circle")
    press(window, "Export the mesh")
    window.get_by_text("this mesh was made by other options or another loop").first.wait_for()


def test_the_boundary_is_found_and_points_in_a_polygon_that_is_dragged_are_dropped_and_added_again(window, page):
    tab(window, "Boundary")
    press(window, "Find the boundary")
    window.get_by_text(f"a loop of {len(TRUE)} points").wait_for()
    until(lambda: is_same_loop(page.hand.loop, TRUE) and not page.hand.is_own)
    page.look_at("boundary scores")
    (client,) = page.server.get_clients().values()
    before = project(page.drawing.places[TRUE], page.drawing.camera(client))
    triangle = np.array([[0.02, 0.02], [0.02, 0.98], [0.6, 0.5]])
    within = TRUE[is_inside([triangle], before)]
    assert 3 < len(within) < len(TRUE) // 2
    for what, gone in (("Drop", within), ("Add", [])):
        drag_with_shift(window, page, triangle)
        window.get_by_text(
            f"{len(within)} selected, {len(within) if what == 'Drop' else 0} of them in the loop"
        ).wait_for()
        press(window, what)
        until(lambda: not page.server.scene.get_handle_by_name("/cloud/selected"))
        assert set(TRUE) - set(page.hand.loop) == set(gone)
    after = project(page.drawing.places[TRUE], page.drawing.camera(client))
    assert np.array_equal(after, before), "the camera has stayed"
    assert is_same_loop(page.hand.loop, TRUE)
    press(window, "Reverse")
    until(lambda: is_same_loop(page.hand.loop, reversed_loop(TRUE)))
    press(window, "Found loop")
    until(lambda: is_same_loop(page.hand.loop, TRUE))


@pytest.mark.parametrize(
    ("what", "sentence"),
    [
        ("Drop", "no points are selected; drag with the shift key round some boundary points"),
        ("Undo", "there is no loop before this one"),
    ],
)
def test_what_there_is_nothing_for_says_so(window, page, what, sentence):
    tab(window, "Boundary")
    press(window, what)
    window.get_by_text(sentence).wait_for()
    assert np.array_equal(page.hand.loop, WRONG)


def test_of_half_the_picture_that_half_of_the_loop_is_selected_dropped_and_added(by_hand):
    page, step, said = by_hand
    page.hand = LoopByHand(N, TRUE)
    half = set(TRUE[page.drawing.places[TRUE, 0] < 1e-6])
    step._select(IN_FRONT, LEFT)
    assert set(step._selected) == half
    step._edit_selected("Drop")
    assert set(page.hand.loop) == set(TRUE) - half
    step._edit("Undo")
    page.hand.change(np.array([], int))
    step._scores = np.isin(np.arange(N), TRUE).astype(float)
    step._select(IN_FRONT, LEFT)
    step._edit_selected("Add")
    assert set(page.hand.loop) == half
    assert said == []


@pytest.mark.parametrize(
    ("picture", "loop", "does", "sentence"),
    [
        (ALL, WRONG, "Add", f"nothing to add: of {len(WRONG)} selected all are in the loop already"),
        (ALL, WRONG, "Drop", None),
        (
            LEFT * 0.01,
            WRONG,
            "",
            f"none of {len(WRONG)} boundary points is inside the polygon; draw it round some of them",
        ),
        (ALL, np.array([], int), "", "there are no boundary points to select yet; find the boundary first"),
    ],
)
def test_a_selection_that_cannot_be_says_why_and_the_one_before_stands(by_hand, picture, loop, does, sentence):
    page, step, said = by_hand
    page.hand.change(loop)
    before = step._selected = TRUE[:3]
    step._select(IN_FRONT, picture)
    assert (step._selected is before) == (does == "")
    if does:
        step._edit_selected(does)
    assert said == ([] if sentence is None else [sentence])


def test_points_behind_the_cloud_are_not_selected(by_hand, monkeypatch):
    _, step, said = by_hand
    monkeypatch.setattr(boundary_step, "visible", lambda points, places, eye, spacing: np.zeros(len(places), bool))
    step._select(IN_FRONT, ALL)
    assert len(step._selected) == 0
    assert said == [f"the cloud hides all {len(WRONG)} boundary points inside the polygon; turn it"]
    monkeypatch.setattr(boundary_step, "visible", lambda points, places, eye, spacing: places[:, 0] < 1e-6)
    step._select(IN_FRONT, ALL)
    assert f"{len(step._selected)} selected, " in step._state.content
    assert f"{len(WRONG) - len(step._selected)} more inside the polygon are hidden by the cloud" in step._state.content


def test_a_loop_is_changed_only_where_the_cloud_shows_it(by_hand):
    page, step, said = by_hand
    step._select(IN_FRONT, LEFT)
    page.add_view("mesh", lambda: None)
    step._select(IN_FRONT, ALL)
    assert said.pop() == "the cloud is not shown, so that no points of it are selected; set Show to cloud"
    step._edit_selected("Clear")
    assert not page.shows_cloud
    step._edit("Found loop")
    assert said.pop() == "no boundary has been found yet; find it first"
    assert not page.shows_cloud
    step._edit("Reverse")
    assert page.shows_cloud


def test_clicks_mean_the_same_points_whichever_axis_is_upwards(bare):
    drawing, places = bare.drawing, bare.drawing.places.copy()
    for up in "xyz":
        drawing.stand(up)
        axes, facing = drawing.axes, drawing.facing
        assert np.array_equal(drawing.places, places)
        ray = SimpleNamespace(ray_origin=tuple(axes @ places[INNER] + facing), ray_direction=tuple(-facing))
        assert drawing.pointed_at(ray) == INNER


def test_a_scan_stands_on_the_axis_chosen_and_its_points_are_clicked_where_they_are_seen(window, page):
    (client,) = page.server.get_clients().values()
    choose(window, "A click", OUTER)
    tab(window, "Cloud")
    for up in ("z", "(default)"):
        before = page.drawing.axes
        choose(window, "Upwards", up)
        until(lambda before=before: page.drawing.axes is not before)
        row = off_centre(page, client)
        until(lambda row=row: click_point(window, page, row) or page.where() == ["--outer", place_of(row)])
    tab(window, "Boundary")
    fill(window, "Outer loop at", "")
    until(lambda: page.where() == [])


def off_centre(page, client):
    """Return the point that is seen in the picture, not in its middle, and farthest from all others."""
    seen = project(page.drawing.places, page.drawing.camera(client))
    from_middle = np.abs(seen - 0.5).max(axis=1)
    away = np.linalg.norm(seen[:, None] - seen, axis=2) + 9.0 * np.eye(N)
    return int(np.argmax(np.where((from_middle > 0.2) & (from_middle < 0.45), away.min(axis=1), 0.0)))


def place_of(row):
    return ",".join(f"{x:.9g}" for x in RELIEF.points[row])


def test_a_narrow_window_shows_the_whole_scan(browser, bare):
    with browser.new_context(viewport={"width": 720, "height": 500}, device_scale_factor=0.5) as context:
        shown = context.new_page()
        shown.goto(bare.address)
        shown.get_by_text("A click").wait_for(timeout=SECONDS)
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
        shown.get_by_text("A click").wait_for(timeout=SECONDS)
        shown.locator("canvas").first.wait_for()
        shown.mouse.move(100, 250)
        shown.mouse.down()
        until(lambda: shown.mouse.move(100 + 9 * (next(places) % 9), 250) or not any(frame.visible for frame in fine))
        shown.mouse.up()
        until(lambda: all(frame.visible for frame in fine) and not any(frame.visible for frame in coarse))


def test_a_click_names_the_outer_loop_and_no_word_stands_twice_on_the_command_line(window, page, scan_file):
    tab(window, "Boundary")
    choose(window, "A click", OUTER)
    click_point(window, page, MISSED)
    x, y, z = (f"{x:.9g}" for x in RELIEF.points[MISSED])
    start = f"pointchart boundary '{scan_file}' -o loop.txt"
    until(lambda: line_shown(window) == f"{start} --outer {x},{y},{z}")
    choose(window, "Component", "largest")
    until(lambda: line_shown(window) == f"{start} --outer {x},{y},{z} --component largest")
    fill(window, "Outer loop at", "")
    tab(window, "Mesh")
    until(lambda: line_shown(window).endswith(" --boundary loop.txt --component largest"))
    tab(window, "Boundary")
    choose(window, "Component", "(default)")
    until(lambda: page.where() == [])


def test_a_loop_file_is_loaded_and_a_false_one_refused(window, page, tmp_path):
    (tmp_path / "false.txt").write_text("0\n1\n4000\n")
    write_loop(tmp_path / "true.txt", TRUE)
    tab(window, "Boundary")
    field = window.locator("input[type=file]").first
    field.set_input_files(tmp_path / "false.txt")
    window.get_by_text("1 boundary entries name no point, the first is 4000 at position 2").wait_for()
    (tmp_path / "my words.txt").write_text("one\n")
    field.set_input_files(tmp_path / "my words.txt")
    window.get_by_text("my words.txt: ").first.wait_for()
    field.set_input_files(tmp_path / "true.txt")
    until(lambda: np.array_equal(page.hand.loop, TRUE))
    assert page.hand.is_own


def test_parameters_are_mapped_and_exported(window, page, tmp_path):
    page.hand = LoopByHand(N)
    tab(window, "UV")
    press(window, "Map to the plane")
    window.get_by_text(f"parameters of {N} points").wait_for()
    table = np.loadtxt(download(window, "Export the parameters", tmp_path / "uv.csv"), delimiter=",", skiprows=1)
    assert np.linalg.norm(table, axis=1).max() == pytest.approx(1.0)


def test_the_surface_is_fitted_and_exported(window, page, tmp_path):
    page.hand = LoopByHand(N)
    tab(window, "Surface")
    fill(window, "Tolerance", "5%")
    press(window, "Fit the surface")
    window.get_by_text("B-spline surface of degree 3").wait_for()
    assert download(window, "Export the surface", tmp_path / "s.step").read_bytes().startswith(b"ISO-10303-21;")


def test_a_run_is_cancelled_by_the_button(window, monkeypatch):
    run_as(monkeypatch, SLEEPS)
    tab(window, "Surface")
    fill(window, "Tolerance", "7%")
    press(window, "Fit the surface")
    press(window, "Cancel")
    window.get_by_text("cancelled; run it again for a result").wait_for()
    press(window, "Export the surface")
    window.get_by_text(re.compile(f"there is no surface yet; fit it first|this surface {OTHERWISE}")).wait_for()


def test_a_page_whose_app_has_ended_says_so(browser, bare):
    with browser.new_context(viewport={"width": 480, "height": 300}, device_scale_factor=0.5) as context:
        shown = context.new_page()
        shown.goto(bare.address)
        shown.get_by_text("A click").wait_for(timeout=SECONDS)
        bare.close()
        shown.get_by_text("ended; start pointchart view again").wait_for(timeout=SECONDS)


def test_a_result_is_exported_only_while_the_words_and_the_loop_that_made_it_stand(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, WRITES)
    step.run()
    assert step.made("mesh", "make it").read_text() == "made"
    assert [path.name for path in bare.folder.iterdir()] == [MADE]
    for change, back in (
        (lambda: step.controls.set("--domain", "square"), lambda: step.controls.set("--domain", "circle")),
        (lambda: bare.hand.change(CROSSED), bare.hand.undo),
    ):
        change()
        bare.loop_changed()
        assert OTHERWISE in step._said.content
        with pytest.raises(InputError, match="made by other options or another loop than those that stand now; make"):
            step.made("mesh", "make it")
        back()
        bare.loop_changed()
        assert OTHERWISE not in step._said.content
        assert step.made("mesh", "make it").exists()


def test_a_run_that_says_nothing_clears_the_refusal_of_the_run_before(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, FAILS)
    step.run()
    assert "it is refused" in step._said.content
    bare.loop_changed()
    assert "it is refused" in step._said.content
    run_as(monkeypatch, (sys.executable, "-c", "import sys; open(sys.argv[sys.argv.index('-o') + 1], 'w')"))
    step.run()
    assert step._said.content == ""


def test_a_run_that_is_refused_leaves_the_result_before_to_the_words_that_made_it(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, WRITES)
    step.run()
    run_as(monkeypatch, FAILS)
    step.controls.set("--domain", "square")
    step.run()
    assert "it is refused" in step._said.content
    assert OTHERWISE in step._said.content
    with pytest.raises(InputError, match="made by other options"):
        step.made("mesh", "make it")
    step.controls.set("--domain", "circle")
    bare.loop_changed()
    assert dimmed_html(refused_html("it is refused")) in step._said.content
    assert OTHERWISE not in step._said.content
    assert step.made("mesh", "make it").read_text() == "made"
    assert [path.name for path in bare.folder.iterdir()] == [MADE]


def test_a_run_cancelled_when_it_has_just_ended_well_leaves_no_result(bare, monkeypatch):
    step, finish = mesh_step(bare), Job.run
    run_as(monkeypatch, WRITES)

    def cancelled_at_the_end(job, tell):
        finish(job, tell)
        raise Cancelled

    monkeypatch.setattr(Job, "run", cancelled_at_the_end)
    step.run()
    with pytest.raises(InputError, match="there is no mesh yet"):
        step.made("mesh", "make it")
    assert list(bare.folder.iterdir()) == []


def test_a_result_is_made_by_the_words_that_stood_when_its_run_began(bare, monkeypatch):
    step, finish = mesh_step(bare), Job.run
    run_as(monkeypatch, WRITES)

    def changed_meanwhile(job, tell):
        lines = finish(job, tell)
        step.controls.set("--domain", "square")
        return lines

    monkeypatch.setattr(Job, "run", changed_meanwhile)
    step.run()
    assert OTHERWISE in step._said.content
    with pytest.raises(InputError, match="this mesh was made by other options"):
        step.made("mesh", "make it")
    step.controls.set("--domain", "circle")
    assert step.made("mesh", "make it").exists()


def test_a_run_reads_the_loop_from_a_file_that_the_line_shown_does_not_tell_of(bare, monkeypatch):
    step = mesh_step(bare)
    (bare.folder / "loop.txt").write_text("as saved")
    run_as(monkeypatch, (sys.executable, "-c", "import sys; raise SystemExit('pointchart: ' + sys.argv[6])"))
    step.run()
    assert ">loop.txt</div>" in step._said.content
    assert (bare.folder / "loop.txt").read_text() == "as saved"


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
        open_page(scan_file, read_scan(scan_file), commands(), tell_close=told.append)
    page = told[0].__self__
    assert not page.folder.exists()
    with pytest.raises(ConnectionRefusedError):
        ask(page, "/")


def test_a_run_tells_its_stages_and_what_it_says(scan_file, tmp_path):
    stages = []
    said = Job(["boundary", str(scan_file), "-o", str(tmp_path / "loop.txt")]).run(lambda *stage: stages.append(stage))
    assert [name for name, _ in stages] == ["prepare", "neighbours", "boundary"]
    assert sorted(share for _, share in stages) == [share for _, share in stages]
    assert said == [f"{tmp_path / 'loop.txt'}: {said[0].partition(': ')[2]}"]
    assert said[0].partition(": ")[2].startswith(f"a loop of {len(TRUE)} points, ")


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        (["a note", "pointchart: the loop is short"], "the loop is short"),
        (["Usage: ...", "Error: Invalid value: --corners needs --domain square"], "--corners needs --domain square"),
        (["Segmentation fault"], "the run ended with status 9 and no word of why"),
        ([], "the run ended with status 9 and no word of why"),
    ],
)
def test_a_failure_is_told_by_its_sentence_alone(lines, sentence):
    assert str(job._failure(9, lines)).partition(",")[0] == sentence


def test_a_run_is_cancelled_at_once_also_before_it_begins():
    late, early = (Job([], program=SLEEPS) for _ in range(2))
    with pytest.raises(Cancelled):
        late.run(lambda *_: late.cancel())
    early.cancel()
    with pytest.raises(Cancelled):
        early.run(print)


def test_a_run_that_is_over_cannot_be_cancelled():
    over = Job([], program=(sys.executable, "-c", ""))
    assert over.run(print) == []
    over.cancel()
    assert over.run(print) == []


def test_what_has_to_end_ends_at_an_interrupt(monkeypatch):
    ended = []
    monkeypatch.setattr(aside, "at_interrupt", [lambda: ended.append("page")])
    # A process in the background, as a runner's may be, is born deaf to it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            aside.aside(lambda: (time.sleep(0.2), interrupt_main(), time.sleep(0.5)))
    finally:
        signal.signal(signal.SIGINT, before)
    assert ended == ["page"]


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


def test_every_control_is_an_option_of_its_command():
    known = commands()
    for command, labels in {
        "param": cloud_steps.METHODS + result_steps.DOMAIN,
        "mesh": result_steps.MESH,
        "fit": result_steps.SURFACE,
        "boundary": boundary_step.LABELS,
    }.items():
        assert all(known.option(command, flag) for flag, _ in labels)
    assert known.option("mesh", "--domain").choices == ("circle", "square")
    assert known.option("fit", "--robust").is_switch
