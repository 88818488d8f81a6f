"""The page of a run, as a browser shows it."""

import io
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

import pointchart as pc
from pointchart import shapes
from pointchart.clock import StageClock
from pointchart.look.camera import camera
from pointchart.look.page import compose
from pointchart.look.page.colorings import Shade, mesh_shades
from pointchart.look.page.histograms import quality_histograms
from pointchart.look.page.thinned import thin
from pointchart.mesh.connectivity import boundary_loops, fans, half_edges
from pointchart.report.checks import certificate_checks
from pointchart.report.mesh_facts import mesh_facts
from pointchart.report.record import RunReport, Stage
from pointchart.runs.execution.measured import measure_mesh

ACCENT = np.array([0xC8, 0x55, 0x3D])
PAPER = np.array([0xFB, 0xFA, 0xF7])
SIDES = (("x", "width"), ("y", "height"))


@pytest.fixture(scope="module")
def made():
    points = shapes.sculpture(1500).points
    result = pc.reconstruct(points)
    meshed = measure_mesh(points, np.arange(len(points)), result, StageClock())
    return points[result.rows], result, report_of(meshed, {"scan": "a.ply"})


def report_of(meshed, options):
    checks = tuple(certificate_checks(meshed.result.certificate))
    return RunReport("mesh", checks=checks, stages=(Stage("mesh", 1.0),), facts=mesh_facts(meshed, options))


@pytest.fixture(scope="module")
def page_file(made, tmp_path_factory):
    points, result, run = made
    path = tmp_path_factory.mktemp("page") / "run.html"
    words = {"command": "pointchart mesh 'a b.ply'", "figure": "pointchart figure mesh a.ply -o a.pdf"}
    title = "</script><img src=x onerror=alert(1)>&amp;{{data}}.ply"
    path.write_text(compose(points, result, run, title=title, **words).text, "utf-8")
    return path


@pytest.fixture(scope="module")
def window(browser, page_file):
    """Open the page from the disk without a network; gather whatever the browser complains of or asks for."""
    context = browser.new_context(offline=True, viewport={"width": 1000, "height": 760}, color_scheme="light")
    page, trouble = context.new_page(), []
    page.on("console", lambda message: trouble.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: trouble.append(str(error)))
    page.on("request", lambda request: trouble.append(request.url) if not request.url.startswith("file:") else None)
    page.goto(page_file.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    yield page, trouble
    context.close()


@pytest.fixture
def opened(window):
    """Give the page as it was at first, and fail if it asks for something or complains while a test uses it."""
    page, trouble = window
    page.check("#rim")
    page.select_option("#shade", "plain")
    page.click("#reset")
    page.keyboard.press("Escape")
    page.wait_for_timeout(60)
    yield page
    assert [text for text in trouble if "GPU stall due to ReadPixels" not in text] == []


def seen(page, selector):
    """Return the colours of a part of the page, and where it begins."""
    box = page.locator(selector).bounding_box()
    clip = {key: round(box[key]) for key in ("x", "y", "width", "height")}
    return np.asarray(Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB"), float), box


def disc_of(page):
    """Return the places of the pixels of the disc that is drawn in the plane, beside the caption and the border."""
    image, _ = seen(page, "#plane")
    y, x = np.nonzero(np.abs(image - PAPER).max(axis=2) > 20)
    height, width = image.shape[:2]
    is_disc = ((y > 30) | (x > 150)) & (x > 2) & (x < width - 3) & (y > 2) & (y < height - 3)
    return x[is_disc], y[is_disc]


def ring(page, selector):
    """Return the middle of the ring that is drawn in a pane, in its pixels; the boundary is hidden."""
    image, _ = seen(page, selector)
    y, x = np.nonzero(np.abs(image - ACCENT).max(axis=2) < 12)
    return None if len(x) == 0 else np.array([(x.min() + x.max()) / 2, (y.min() + y.max()) / 2])


def without_boundary(page):
    page.uncheck("#rim")
    page.wait_for_timeout(60)


def test_both_views_are_drawn(opened):
    for pane, least in (("#space", 0.1), ("#plane", 0.3)):
        image, _ = seen(opened, pane)
        assert (np.abs(image - PAPER).max(axis=2) > 20).mean() > least


def test_the_plane_shows_the_unit_disc(opened):
    x, y = disc_of(opened)
    radius = (x.max() - x.min() + 1) / 2
    assert abs((y.max() - y.min() + 1) / 2 - radius) < 2
    assert abs(len(x) / (np.pi * radius**2) - 1) < 0.03


def test_a_point_under_the_pointer_lights_up_in_both_views(opened, made):
    _, result, _ = made
    without_boundary(opened)
    x, y = disc_of(opened)
    box = opened.locator("#plane").bounding_box()
    middle, radius = np.array([(x.min() + x.max()) / 2, (y.min() + y.max()) / 2]), (x.max() - x.min() + 1) / 2
    pane = opened.locator("#space").bounding_box()
    for across, down in ((0.5, 0.5), (0.42, 0.6), (0.55, 0.35)):
        at = np.array([across * pane["width"], down * pane["height"]])
        opened.mouse.move(pane["x"] + at[0], pane["y"] + at[1])
        opened.wait_for_timeout(60)
        row = int(opened.get_attribute("#readout", "data-vertex"))
        vertex = int(np.flatnonzero(result.rows == row)[0])
        in_space, in_plane = (ring(opened, pane) for pane in ("#space", "#plane"))
        assert np.linalg.norm(in_space - at) < 25  # the nearest vertex is not far
        assert np.linalg.norm((in_plane - middle) / radius * [1, -1] - result.uv[vertex]) < 0.012
        opened.mouse.move(box["x"] + in_plane[0], box["y"] + in_plane[1])
        opened.wait_for_timeout(60)
        assert int(opened.get_attribute("#readout", "data-vertex")) == row


def test_a_click_holds_the_point_and_escape_lets_go(opened):
    without_boundary(opened)
    pane = opened.locator("#plane").bounding_box()
    opened.mouse.click(pane["x"] + pane["width"] / 2, pane["y"] + pane["height"] / 2)
    opened.mouse.move(5, 5)
    opened.wait_for_timeout(60)
    assert ring(opened, "#space") is not None
    opened.keyboard.press("Escape")
    opened.wait_for_timeout(60)
    assert ring(opened, "#space") is None


def test_the_checklist_is_that_of_the_run(opened, made):
    _, result, run = made
    checks = opened.locator("#checks li")
    passed = checks.evaluate_all("rows => rows.filter(r => r.className === 'passed').map(r => r.textContent)")
    assert passed == [check.text for check in certificate_checks(result.certificate) if check.passed]
    assert run.facts["certificate"]["disc"]
    assert opened.locator("#verdict").inner_text() == "certified disc, uv one-to-one"
    assert f"{run.facts['certificate']['points']:,} points" in opened.locator("#summary").inner_text()


def test_the_arrays_come_back(opened, made):
    points, result, _ = made
    arrays = opened.evaluate("Object.fromEntries(Object.entries(scene.arrays).map(([k, v]) => [k, Array.from(v)]))")
    rows = np.array(arrays["row"])
    vertex = np.argsort(result.rows)[np.searchsorted(np.sort(result.rows), rows)]
    assert sorted(rows) == sorted(result.rows)
    assert np.array_equal(np.array(arrays["uv"], np.float32).reshape(-1, 2), result.uv[vertex].astype(np.float32))
    extent = np.ptp(points, axis=0).max()
    places = points.min(axis=0) + np.array(arrays["position"]).reshape(-1, 3) / 65535 * extent
    assert np.abs(places - points[vertex]).max() <= 0.51 / 65535 * extent
    ours, theirs = vertex[np.array(arrays["triangles"]).reshape(-1, 3)], result.triangles
    assert {tuple(np.roll(t, -np.argmin(t))) for t in ours.tolist()} == {
        tuple(np.roll(t, -np.argmin(t))) for t in theirs.tolist()
    }
    loop = vertex[arrays["loop"]]
    assert arrays["loop_sizes"] == [len(result.loop)]
    assert any(np.array_equal(np.roll(loop, -k), result.loop) for k in range(len(loop)))


def test_the_values_that_colour_the_mesh_come_back(opened, made):
    points, result, _ = made
    arrays = opened.evaluate("Object.fromEntries(Object.entries(scene.arrays).map(([k, v]) => [k, Array.from(v)]))")
    shown = opened.evaluate("content.shades")
    vertex = np.argsort(result.rows)[np.searchsorted(np.sort(result.rows), arrays["row"])]
    for shade, row in zip(mesh_shades(points, result.triangles, result.uv, result.loop), shown, strict=True):
        low, high = row["range"]
        values = low + np.array(arrays[shade.name]) / 65535 * (high - low)
        wanted = np.log(shade.values[vertex]) if shade.is_log else shade.values[vertex]
        assert row["name"] == shade.name
        assert np.abs(values - wanted).max() <= 0.51 / 65535 * (high - low)


def test_the_readout_tells_the_numbers_of_the_point(opened, made):
    points, result, _ = made
    pane = opened.locator("#space").bounding_box()
    opened.mouse.move(pane["x"] + 0.5 * pane["width"], pane["y"] + 0.5 * pane["height"])
    opened.wait_for_timeout(60)
    row = int(opened.get_attribute("#readout", "data-vertex"))
    vertex = int(np.flatnonzero(result.rows == row)[0])
    text = opened.locator("#readout").inner_text().replace("\N{MINUS SIGN}", "-")
    numbers = r"((?:\s+-?[\d.]+(?:e-?\d+)?)+)"
    names = "x y z", "u v", "deviation", "stretch", "spacing", "boundary score"
    told = {name: [float(x) for x in re.search(name + numbers, text)[1].split()] for name in names}
    assert told["x y z"] == pytest.approx(points[vertex], abs=1e-4)
    assert told["u v"] == pytest.approx(result.uv[vertex], abs=1e-6)
    for shade in mesh_shades(points, result.triangles, result.uv, result.loop):
        assert told[shade.name] == pytest.approx([shade.values[vertex]], rel=2e-3, abs=1e-4)


def test_spacing_stretch_and_score_of_a_plane_are_known():
    sheet = 0.5 * shapes.grid(14, 11).points
    flat = pc.reconstruct(sheet, chart=pc.uv_free_boundary)
    _, stretch, spacing, score = mesh_shades(sheet, flat.triangles, flat.uv, flat.loop)
    inner = np.setdiff1d(np.arange(len(sheet)), flat.loop)
    assert stretch.values == pytest.approx(1.0, abs=1e-3)
    assert np.median(spacing.values[inner]) == pytest.approx(0.5)
    assert score.values[flat.loop].min() > score.values[inner].max()


def test_histograms_of_a_regular_grid_are_known():
    sheet = shapes.grid(14, 11).points
    flat = pc.reconstruct(sheet)
    angle, shape, edges, _ = quality_histograms(sheet, flat.triangles, flat.uv, np.ones(len(sheet)))

    def held(histogram):
        ends = np.linspace(histogram["low"], histogram["high"], len(histogram["counts"]) + 1)
        return [(ends[k], ends[k + 1], n) for k, n in enumerate(histogram["counts"]) if n]

    n_triangles, n_edges = 2 * 13 * 10, 13 * 11 + 14 * 10 + 13 * 10
    (low, high, n), *rest = held(angle)
    assert (rest, n) == ([], n_triangles)
    assert low <= 45.0 <= high
    (low, high, n), *rest = held(shape)
    assert (rest, n) == ([], n_triangles)
    assert low <= 2.0 * np.sqrt(2.0) - 2.0 <= high
    (low, high, sides), (far, end, diagonals) = held(edges)
    assert (sides, diagonals) == (n_edges - 130, 130)
    assert low <= 1.0 <= high
    assert far <= np.sqrt(2.0) <= end + 1e-9


def test_what_comes_from_outside_is_text(opened):
    assert opened.locator("h1").inner_text() == "</script><img src=x onerror=alert(1)>&amp;{{data}}.ply"
    assert opened.locator("img").count() == 0
    assert opened.locator("#command").inner_text() == "pointchart mesh 'a b.ply'"


def test_keys_colour_turn_and_draw_edges(opened):
    opened.focus("#stage")
    before, _ = seen(opened, "#space")
    opened.keyboard.press("3")
    opened.wait_for_timeout(80)
    assert opened.input_value("#shade") == "stretch"
    coloured, _ = seen(opened, "#space")
    assert np.abs(coloured - before).max() > 50
    opened.keyboard.press("e")
    opened.wait_for_timeout(80)
    assert opened.is_checked("#wires")
    opened.keyboard.press("e")
    opened.keyboard.press("ArrowRight")
    opened.wait_for_timeout(80)
    turned, _ = seen(opened, "#space")
    assert np.abs(turned - coloured).max() > 50
    opened.keyboard.press("r")
    opened.wait_for_timeout(80)
    again, _ = seen(opened, "#space")
    assert np.abs(again - coloured).max() < 2


def test_the_command_for_a_figure_looks_from_the_side_that_is_seen(opened, made):
    page, (points, result, _) = opened, made
    page.focus("#stage")
    for keys in ("", "ArrowLeft", "ArrowUp ArrowUp", "ArrowRight ArrowDown ArrowDown ArrowDown"):
        for key in keys.split():
            page.keyboard.press(key)
        page.evaluate("new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")
        *words, view, flag, up = page.locator("#figure pre").inner_text().split()
        assert (words, flag) == (["pointchart", "figure", "mesh", "a.ply", "-o", "a.pdf"], "--up")
        angles = [float(angle) for angle in view.removeprefix("--view=").split(",")]
        towards = camera(points, result.triangles, view=angles, up=up)[2]
        assert towards @ page.evaluate("scene.turn.slice(6, 9)") > np.cos(np.deg2rad(1.0))


def test_a_place_to_look_at_comes_to_the_middle_of_both_views(made, browser, tmp_path):
    points, result, run = made
    vertex = int(np.argmax(points[:, 2]))
    doubt = {"points": 3, "length": 1.0, "spacings": 9.0, "at_vertex": vertex}
    boundary = run.facts["boundary"] | {"doubts": [doubt]}
    doubted = replace(run, facts=run.facts | {"boundary": boundary})
    path = tmp_path / "doubt.html"
    path.write_text(compose(points, result, doubted, title="a", command="").text, "utf-8")
    page = browser.new_page(viewport={"width": 1000, "height": 800})
    page.goto(path.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    assert page.locator("#doubts").inner_text() == "1 place to look at"
    page.click("#places button")
    page.uncheck("#rim")
    page.wait_for_timeout(80)
    assert int(page.get_attribute("#readout", "data-vertex")) == result.rows[vertex]
    for pane in ("#space", "#plane"):
        image, _ = seen(page, pane)
        assert ring(page, pane) == pytest.approx(np.array(image.shape[1::-1]) / 2, abs=3)
    page.close()


def test_the_wheel_zooms_about_the_pointer(opened):
    pane = opened.locator("#plane").bounding_box()
    at = pane["x"] + 0.4 * pane["width"], pane["y"] + 0.6 * pane["height"]
    opened.mouse.move(*at)
    opened.wait_for_timeout(60)
    row = opened.get_attribute("#readout", "data-vertex")
    opened.mouse.wheel(0, -1200)
    opened.wait_for_timeout(80)
    opened.mouse.move(at[0] + 1, at[1])
    opened.mouse.move(*at)
    opened.wait_for_timeout(60)
    assert opened.get_attribute("#readout", "data-vertex") == row
    assert opened.evaluate("scene.zoom.plane") > 5


def test_it_follows_the_system_to_the_dark_and_fits_a_phone(browser, page_file):
    context = browser.new_context(viewport={"width": 390, "height": 844}, color_scheme="dark", has_touch=True)
    page = context.new_page()
    page.goto(page_file.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(20, 25, 30)"
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    space, plane = (page.locator(pane).bounding_box() for pane in ("#space", "#plane"))
    assert plane["y"] >= space["y"] + space["height"] - 2
    context.close()


@pytest.mark.parametrize(("swipe", "scrolls"), [((0, -15), True), ((-8, 0), False)])
def test_a_finger_upwards_scrolls_the_page_and_sideways_turns_the_mesh(browser, page_file, swipe, scrolls):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    page = context.new_page()
    page.goto(page_file.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    box, before = page.locator("#space").bounding_box(), page.evaluate("[...scene.turn]")
    hand = context.new_cdp_session(page)
    for step in range(16):
        place = {way: box[way] + 0.5 * box[size] + step * swipe[k] for k, (way, size) in enumerate(SIDES)}
        kind = "touchMove" if step else "touchStart"
        hand.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [place]})
        page.wait_for_timeout(16)
    hand.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    assert (page.evaluate("scrollY") > 100) == scrolls
    assert (page.evaluate("[...scene.turn]") == before) == scrolls
    context.close()


@pytest.mark.parametrize("most", [100, 300])
def test_a_thinned_mesh_is_a_disc_with_the_boundary_of_the_whole(made, most):
    points, result, _ = made
    shown = thin(points, result.triangles, most)
    edges = half_edges(shown.triangles, most)
    n_edges = len(edges.twins) - np.count_nonzero(edges.twins >= 0) // 2
    assert most - n_edges + len(shown.triangles) == 1
    assert (fans(edges, most) == 1).all()
    loop = boundary_loops(edges)[0]
    along = shown.along(result.loop)
    assert np.array_equal(np.roll(along, -int(np.argmin(along))), loop)
    assert np.array_equal(shown.owner[shown.kept], np.arange(most))


def test_large_meshes_are_thinned_and_say_so(made):
    points, result, run = made
    page = compose(points, result, run, title="a", command="", most=300)
    assert (page.n_drawn, page.n_points) == (300, len(points))
    assert page.size_line.endswith(f"300 of {len(points):,} points drawn")
    assert json.loads(re.search(r'id="content">(.*?)</script>', page.text)[1])["drawn"] == 300


def test_thirty_thousand_points_take_under_five_megabytes():
    grid = shapes.sculpture(30_000)
    result = pc.reconstruct(grid.points)
    points = grid.points[result.rows]
    meshed = measure_mesh(points, np.arange(len(points)), result, StageClock())
    run = report_of(meshed, {})
    assert len(compose(points, result, run, title="a", command="").text.encode()) < 5e6


def test_deviations_of_a_plane_are_zero_and_of_a_bump_point_outwards():
    sheet = shapes.disc(800).points
    flat = pc.reconstruct(sheet)
    deviation = mesh_shades(sheet[flat.rows], flat.triangles, flat.uv, flat.loop)[0]
    assert np.abs(deviation.values).max() < 1e-12
    inner = int(np.argmin(np.linalg.norm(sheet[flat.rows] - sheet[flat.rows].mean(axis=0), axis=1)))
    bump = sheet[flat.rows].copy()
    normal = np.cross(*(bump[flat.triangles[0]][1:] - bump[flat.triangles[0]][0]))
    bump[inner] += 0.02 * normal / np.linalg.norm(normal)
    raised = mesh_shades(bump, flat.triangles, flat.uv, flat.loop)[0].values
    assert np.argmax(raised) == inner
    assert raised[inner] == pytest.approx(0.02, rel=0.4)


@pytest.mark.parametrize("is_signed", [False, True])
def test_colours_reach_over_all_but_the_outermost_points(is_signed):
    values = np.random.default_rng(0).normal(size=5000)
    low, high = Shade("a", "", values, is_signed=is_signed).reach
    assert 0.955 < ((values >= low) & (values <= high)).mean() <= 1.0
    assert not is_signed or low == -high


def test_the_command_writes_a_page_and_a_failed_one_none(tmp_path, command_line):
    scan, out, page = tmp_path / "scan.xyz", tmp_path / "mesh.ply", tmp_path / "run.html"
    np.savetxt(scan, shapes.disc(300).points)
    code, _, said = command_line("mesh", scan, "-o", out, "--html", page)
    assert code == 0
    assert f"{page}: " in said
    assert "opens offline" in said
    assert "--html" in page.read_text("utf-8")
    page.unlink()
    np.savetxt(scan, np.vstack([shapes.disc(300).points, shapes.disc(300).points + 50.0]))
    assert command_line("mesh", scan, "-o", tmp_path / "other.ply", "--html", page)[0] == 1
    assert not page.exists()
    assert not (tmp_path / "other.ply").exists()


@pytest.mark.parametrize("values", [np.full(9, 1e17), 3.0 + np.r_[np.zeros(8), 1e-15], np.zeros(9), np.full(9, 1e-30)])
def test_values_that_differ_by_rounding_alone_are_one_colour(values):
    for is_log in (False, True):
        low, high = Shade("a", "", values, is_log=is_log).reach
        assert len(np.histogram([low], bins=60, range=(low, high))[0]) == 60


def test_a_regular_grid_has_a_page(made):
    sheet = shapes.grid(40, 30).points
    flat = pc.reconstruct(sheet)
    assert compose(sheet[flat.rows], flat, made[2], title="b\udcffd.xyz", command="").text.encode()


def test_rims_of_open_gaps_are_drawn(made, browser, tmp_path):
    pierced = shapes.pierce(shapes.disc(1200), n_gaps=2, radius_in_spacings=3.5).points
    result = pc.reconstruct(pierced, gaps=pc.leave_gaps_open)
    path = tmp_path / "open.html"
    path.write_text(compose(pierced[result.rows], result, made[2], title="a", command="").text, "utf-8")
    page = browser.new_page()
    page.goto(path.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    assert page.evaluate("scene.arrays.loop_sizes.length") == 3
    assert page.evaluate("scene.rimLength") == 2 * sum(page.evaluate("Array.from(scene.arrays.loop_sizes)"))
    page.close()


def test_a_page_has_to_be_html_and_no_input(tmp_path, command_line):
    scan = tmp_path / "scan.xyz"
    np.savetxt(scan, shapes.disc(300).points)
    code, _, said = command_line("mesh", scan, "-o", tmp_path / "a.html", "--html", tmp_path / "a.html")
    assert code == 1
    named = tmp_path / "b.html"
    named.write_text(scan.read_text())
    code, _, said = command_line("mesh", named, "-o", tmp_path / "a.ply", "--html", named)
    assert code == 1
    assert "which would be lost" in said
    code, _, said = command_line("mesh", scan, "-o", tmp_path / "a.ply", "--html", tmp_path / "a.pdf")
    assert code == 1
    assert "the suffix '.pdf' cannot be written here; choose one of .html, .htm" in said


def test_a_full_disk_leaves_neither_page_nor_mesh(tmp_path, command_line, full_disk):
    scan = tmp_path / "scan.xyz"
    np.savetxt(scan, shapes.disc(300).points)
    code, _, said = command_line("mesh", scan, "-o", tmp_path / "a.ply", "--html", tmp_path / "a.html")
    assert code == 1
    assert "No space left on device" in said
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scan.xyz"]


def test_the_page_of_a_surface_tells_its_deviation(tmp_path, command_line, browser):
    scan, page_file, report = tmp_path / "scan.xyz", tmp_path / "run.html", tmp_path / "run.json"
    np.savetxt(scan, shapes.hemisphere(400).points)
    words = ["--tolerance", "2%", "--html", page_file, "--report", report, "--quiet"]
    assert command_line("fit", scan, "-o", tmp_path / "surface.json", *words)[0] == 0
    page = browser.new_page()
    page.goto(page_file.as_uri())
    page.wait_for_function("document.body.dataset.ready === 'yes'")
    surface = json.loads(report.read_text())["surface"]
    assert page.input_value("#shade") == "deviation"
    # The parameters that the page shows are corrected ones, of which nothing was proved.
    assert "one part" in page.locator("#checks").text_content()
    assert page.locator("#verdict").inner_text() == "certified disc"
    assert "one-to-one" not in page.locator("body").inner_text()
    assert " \N{MULTIPLICATION SIGN} ".join(map(str, surface["control_points"])) in page.locator("#fit").inner_text()
    low, high = page.evaluate("content.shades[0].range")
    assert max(-low, high) == pytest.approx(surface["deviation"]["max"])
    page.close()
