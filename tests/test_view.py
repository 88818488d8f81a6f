import shlex
import threading
import time
from _thread import interrupt_main
from contextlib import nullcontext
from http.client import HTTPConnection

import numpy as np
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import pointchart as pc
from pointchart import InputError, PointchartError, read_scan, shapes
from pointchart.boundary import is_same_loop, reversed_loop
from pointchart.cli import aside
from pointchart.cli.view import commands
from pointchart.io import read_loop, write_loop
from pointchart.view import guard
from pointchart.view.app import open_page
from pointchart.view.boundary_step import CORNER, DROP, INSERT, OUTER
from pointchart.view.cloud_steps import SHOW
from pointchart.view.drawing import camera_of
from pointchart.view.job import Cancelled, Job
from pointchart.view.picking import LoopByHand, project

RELIEF = shapes.relief(400, seed=2)
TRUE = np.asarray(RELIEF.boundary)
MISSED, INNER = int(TRUE[10]), int(np.argmin(np.linalg.norm(RELIEF.points[:, :2], axis=1)))
WRONG = np.where(TRUE == MISSED, INNER, TRUE)
CROSSED = np.concatenate([TRUE[:10], reversed_loop(TRUE[10:30]), TRUE[30:]])
HARMLESS = ("THREE.Clock", "not on your GPU")
SECONDS = 40_000  # milliseconds that a busy machine may take


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
    with browser.new_context(viewport={"width": 860, "height": 560}) as context:
        shown = context.new_page()
        shown.set_default_timeout(SECONDS)
        shown.words = []
        shown.on("console", lambda line: shown.words.append((line.type, line.text)))
        shown.on("pageerror", lambda error: shown.words.append(("error", str(error))))
        shown.goto(page.address)
        shown.get_by_text("A click").wait_for()
        yield shown


@pytest.fixture
def window(opened, page):
    """Return the page in a browser with the wrong loop, whatever tests ran before."""
    page.hand = LoopByHand(len(RELIEF.points), WRONG)
    page.look_at("cloud")
    page.loop_changed()
    return opened


def ask(page, path, **headers):
    connection = HTTPConnection("127.0.0.1", page.server.get_port())
    try:
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(errors="replace"), answer
    finally:
        connection.close()


def token_of(page):
    return page.address.partition("token=")[2]


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
    x, y = project(page.drawing.places[row : row + 1], camera_of(client))[0]
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


# The door


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?tokens={}", "?token={}x"])
def test_without_its_token_the_page_is_refused_with_a_sentence(page, query):
    status, body, _ = ask(page, f"/{query.format(token_of(page))}")
    assert (status, body) == (403, f"{guard.REFUSED}\n")


def test_the_token_opens_the_page_and_is_kept_in_a_cookie_that_opens_it_as_well(page):
    status, body, answer = ask(page, f"/?token={token_of(page)}")
    cookie = answer.getheader("Set-Cookie")
    assert (status, "<html" in body) == (200, True)
    assert {"HttpOnly", "SameSite=Strict"} <= set(cookie.split("; "))
    assert "frame-ancestors 'none'" in answer.getheader("Content-Security-Policy")
    assert ask(page, "/", Cookie=f"other=1; {cookie.partition(';')[0]}")[0] == 200
    assert ask(page, "/", Cookie=cookie.partition(";")[0] + "x")[0] == 403


@pytest.mark.parametrize("host", ["evil.example", "evil.example:{}", "127.0.0.1", "127.0.0.1:1"])
def test_another_name_for_this_machine_is_refused(page, host):
    assert ask(page, f"/?token={token_of(page)}", Host=host.format(page.server.get_port()))[0] == 403


def test_another_origin_is_refused_even_with_the_token(page):
    path = f"/?token={token_of(page)}"
    assert ask(page, path, Origin="http://evil.example")[0] == 403
    assert ask(page, path, Origin="null")[0] == 403


@pytest.mark.parametrize("origin", ["http://evil.example", "http://localhost:{}", "https://127.0.0.1:{}", None])
def test_a_websocket_of_another_origin_or_none_is_refused(page, origin):
    port = page.server.get_port()
    cookie = {"Cookie": f"pointchart_{port}={token_of(page)}"}
    with (
        pytest.raises(InvalidStatus) as refused,
        connect(f"ws://127.0.0.1:{port}", origin=origin and origin.format(port), additional_headers=cookie),
    ):
        pass
    assert refused.value.response.status_code == 403


def test_a_websocket_needs_the_token_and_opens_with_it(page):
    port = page.server.get_port()
    own = {"origin": f"http://127.0.0.1:{port}", "subprotocols": ["viser-v0"]}
    with pytest.raises(InvalidStatus), connect(f"ws://127.0.0.1:{port}", **own):
        pass
    cookie = {"Cookie": f"pointchart_{port}={token_of(page)}"}
    with connect(f"ws://127.0.0.1:{port}", additional_headers=cookie, **own) as opened:
        assert opened.response.status_code == 101


def test_the_server_listens_on_loopback_only(page):
    assert page.server.get_host() == "127.0.0.1"


def test_a_server_that_answers_without_the_token_is_stopped_at_once(monkeypatch):
    monkeypatch.setattr(guard, "_guarding", lambda token: nullcontext())
    with pytest.raises(InputError, match="answers without the token of the page, so it is not started"):
        guard.start_server("secret")


# The page in a browser


def test_the_page_opens_with_the_six_steps_and_no_error(window):
    names = ["Cloud", "Neighbourhoods", "Boundary", "UV", "Mesh", "Surface"]
    assert window.get_by_role("tab").all_inner_texts() == names
    window.get_by_text("400 points").first.wait_for()
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
    fill(window, "Radius", "")
    choose(window, "Neighbourhood", "(default)")


def test_a_crossing_loop_is_refused_in_the_words_of_the_command_line(window, page, scan_file, tmp_path, command_line):
    write_loop(tmp_path / "loop.txt", CROSSED)
    code, _, said = command_line("mesh", scan_file, "-o", tmp_path / "mesh.ply", "--boundary", tmp_path / "loop.txt")
    page.hand.change(CROSSED)
    page.loop_changed()
    tab(window, "Mesh")
    press(window, "Make the mesh")
    refused = window.locator(".refused")
    refused.wait_for()
    assert (code, said) == (1, f"pointchart: {refused.inner_text()}\n")
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
    window.get_by_text("a certified disc: 400 points").wait_for()
    made = download(window, "Export the mesh", tmp_path / "downloaded.ply")
    mesh = read_scan(made)
    uv = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    proof = pc.certify(RELIEF.points, mesh.triangles, uv=uv, loop=TRUE)
    assert proof.is_disc
    assert proof.is_one_to_one
    # The command line shown, run where the loop was saved, does the same.
    line = window.locator(".command code").locator("visible=true").inner_text()
    assert line == f"pointchart mesh '{scan_file}' -o mesh.ply --boundary loop.txt --domain square"
    monkeypatch.chdir(tmp_path)
    assert command_line(*shlex.split(line)[1:])[0] == 0
    assert (tmp_path / "mesh.ply").read_bytes() == made.read_bytes()


def test_the_boundary_is_found_and_points_in_a_rectangle_or_polygon_are_dropped_and_added_again(window, page):
    tab(window, "Boundary")
    press(window, "Find the boundary")
    window.get_by_text("a loop of 63 points").wait_for()
    until(lambda: is_same_loop(page.hand.loop, TRUE) and not page.hand.is_own)
    page.look_at("boundary scores")
    box = window.locator("canvas").first.bounding_box()
    for what, n_gone in (("Drop inside", 20), ("Add inside", 0)):
        window.keyboard.down("Shift")
        window.mouse.move(box["x"] + 5, box["y"] + 5)
        window.mouse.down()
        window.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] - 5, steps=4)
        window.mouse.up()
        window.keyboard.up("Shift")
        until(lambda: page.server.scene.get_handle_by_name("/cloud/polygon"))
        press(window, what)
        until(lambda: not page.server.scene.get_handle_by_name("/cloud/polygon"))
        gone = RELIEF.points[np.setdiff1d(TRUE, page.hand.loop)]
        assert len(gone) >= n_gone
        assert (gone[:, 0] < 0.1).all()
    assert is_same_loop(page.hand.loop, TRUE)
    choose(window, "A click", CORNER)
    for x, y in ((0.05, 0.95), (0.9, 0.95), (0.5, 0.5)):
        window.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"], delay=60)
        window.wait_for_timeout(300)
    press(window, "Drop inside")
    until(lambda: len(page.hand.loop) < len(TRUE))
    assert RELIEF.points[np.setdiff1d(TRUE, page.hand.loop), 1].max() < -0.5
    press(window, "Found loop")
    until(lambda: is_same_loop(page.hand.loop, TRUE))


def test_a_polygon_without_corners_selects_nothing_and_says_so(window, page):
    tab(window, "Boundary")
    press(window, "Drop inside")
    window.get_by_text("the polygon has 0 corners; set 3 at least").wait_for()
    assert np.array_equal(page.hand.loop, WRONG)


def test_a_click_names_the_outer_loop_on_the_command_line(window, page):
    tab(window, "Boundary")
    choose(window, "A click", OUTER)
    click_point(window, page, MISSED)
    x, y, z = (f"{x:.9g}" for x in RELIEF.points[MISSED])
    window.get_by_text(f"--outer {x},{y},{z}").locator("visible=true").wait_for()
    fill(window, "Outer loop at", "")
    until(lambda: page.where() == [])


def test_a_loop_file_is_loaded_and_a_false_one_refused(window, page, tmp_path):
    (tmp_path / "false.txt").write_text("0\n1\n4000\n")
    write_loop(tmp_path / "true.txt", TRUE)
    tab(window, "Boundary")
    field = window.locator("input[type=file]").first
    field.set_input_files(tmp_path / "false.txt")
    window.get_by_text("1 boundary entries name no point, the first is 4000 at position 2").wait_for()
    field.set_input_files(tmp_path / "true.txt")
    until(lambda: np.array_equal(page.hand.loop, TRUE))
    assert page.hand.is_own


def test_parameters_are_mapped_and_exported(window, page, tmp_path):
    page.hand = LoopByHand(len(RELIEF.points))
    tab(window, "UV")
    press(window, "Map to the plane")
    window.get_by_text("parameters of 400 points").wait_for()
    table = np.loadtxt(download(window, "Export the parameters", tmp_path / "uv.csv"), delimiter=",", skiprows=1)
    assert np.linalg.norm(table, axis=1).max() == pytest.approx(1.0)


def test_the_surface_is_fitted_and_exported_and_a_run_is_cancelled_at_once(window, page, tmp_path):
    page.hand = LoopByHand(len(RELIEF.points))
    tab(window, "Surface")
    fill(window, "Tolerance", "5%")
    press(window, "Fit the surface")
    press(window, "Cancel")
    start = time.monotonic()
    window.get_by_text("cancelled; nothing was changed").wait_for()
    assert time.monotonic() - start < 3.0
    assert not list(page.folder.glob("surface*"))
    press(window, "Fit the surface")
    window.get_by_text("B-spline surface of degree 3").wait_for()
    assert download(window, "Export the surface", tmp_path / "s.step").read_bytes().startswith(b"ISO-10303-21;")


# Runs beside the page


def test_a_run_tells_its_stages_and_what_it_says(scan_file, tmp_path):
    stages = []
    said = Job(["boundary", str(scan_file), "-o", str(tmp_path / "loop.txt")]).run(lambda *stage: stages.append(stage))
    assert [name for name, _ in stages] == ["prepare", "neighbours", "boundary"]
    assert sorted(share for _, share in stages) == [share for _, share in stages]
    assert said == [f"{tmp_path / 'loop.txt'}: a loop of 63 points, 6.285 long, {said[0].partition(' long, ')[2]}"]


def test_wrong_usage_is_told_by_its_sentence_alone(scan_file, tmp_path):
    with pytest.raises(PointchartError, match=r"^--corners needs --domain square$"):
        Job(["mesh", str(scan_file), "-o", str(tmp_path / "mesh.ply"), "--corners", "1,2,3,4"]).run(print)


def test_a_run_is_cancelled_before_it_computes_and_leaves_no_file(scan_file, tmp_path):
    job = Job(["mesh", str(scan_file), "-o", str(tmp_path / "mesh.ply")])
    threading.Timer(0.1, job.cancel).start()
    start = time.monotonic()
    with pytest.raises(Cancelled):
        job.run(print)
    assert time.monotonic() - start < 3.0
    assert list(tmp_path.iterdir()) == []


# The command


def test_what_has_to_end_ends_at_an_interrupt(monkeypatch):
    ended = []
    monkeypatch.setattr(aside, "at_interrupt", [lambda: ended.append("page")])
    with pytest.raises(KeyboardInterrupt):
        aside.aside(lambda: (time.sleep(0.2), interrupt_main(), time.sleep(0.5)))
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
    from pointchart.view import boundary_step, cloud_steps, result_steps

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
