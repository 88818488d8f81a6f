import shlex
from types import SimpleNamespace

import numpy as np
import pytest
from windows import (
    CROSSED,
    INNER,
    MISSED,
    RELIEF,
    TRUE,
    WRONG,
    N,
    choose,
    click_point,
    download,
    drag_with_shift,
    fill,
    line_shown,
    off_centre,
    place_of,
    press,
    tab,
    until,
)

import pointchart as pc
from pointchart import PointchartError, read_scan, survey_scan
from pointchart.app import boundary_step
from pointchart.app.boundary_step import DROP, INSERT, OUTER
from pointchart.app.loop_by_hand import LoopByHand
from pointchart.app.picking import Camera, project
from pointchart.boundary import is_same_loop, reversed_loop
from pointchart.io import read_loop, write_loop
from pointchart.plane.polygons import is_inside

ALL = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
LEFT = ALL * [0.501, 1.0]
IN_FRONT = Camera(np.array([0.0, 0.0, 9.0]), np.array([[1.0, 0, 0], [0, -1, 0], [0, 0, -1]]), fov=1.0, aspect=1.0)


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
    survey = survey_scan(RELIEF.points)
    found = survey.cloud.rows[survey.loop]
    tab(window, "Boundary")
    press(window, "Find the boundary")
    window.get_by_text(f"a loop of {len(found)} points").wait_for()
    until(lambda: is_same_loop(page.hand.loop, found) and not page.hand.is_own)
    page.views.look_at("boundary scores")
    (client,) = page.server.get_clients().values()
    before = project(page.drawing.places[found], page.drawing.camera(client))
    triangle = np.array([[0.02, 0.02], [0.02, 0.98], [0.6, 0.5]])
    within = found[is_inside([triangle], before)]
    assert 3 < len(within) < len(found) // 2
    for what, gone in (("Drop", within), ("Add", [])):
        drag_with_shift(window, page, triangle)
        window.get_by_text(
            f"{len(within)} selected, {len(within) if what == 'Drop' else 0} of them in the loop"
        ).wait_for()
        press(window, what)
        until(lambda: not page.server.scene.get_handle_by_name("/cloud/selected"))
        assert set(found) - set(page.hand.loop) == set(gone)
    after = project(page.drawing.places[found], page.drawing.camera(client))
    assert np.array_equal(after, before), "the camera has stayed"
    assert is_same_loop(page.hand.loop, found)
    added_again = page.hand.loop
    press(window, "Reverse")
    until(lambda: np.array_equal(page.hand.loop, reversed_loop(added_again)))
    press(window, "Found loop")
    until(lambda: np.array_equal(page.hand.loop, found))


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
    page.views.add("mesh", lambda: None)
    step._select(IN_FRONT, ALL)
    assert said.pop() == "the cloud is not shown, so that no points of it are selected; set Show to cloud"
    step._edit_selected("Clear")
    assert not page.views.has_cloud
    step._edit("Found loop")
    assert said.pop() == "no boundary has been found yet; find it first"
    assert not page.views.has_cloud
    step._edit("Reverse")
    assert page.views.has_cloud


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
        until(lambda row=row: click_point(window, page, row) or page.where() == {"outer": place_of(row)})
    tab(window, "Boundary")
    fill(window, "Outer loop at", "")
    until(lambda: page.where() == {})


def test_a_click_names_the_outer_loop_and_no_word_stands_twice_on_the_command_line(window, page, scan_file):
    tab(window, "Boundary")
    choose(window, "A click", OUTER)
    click_point(window, page, MISSED)
    place = ",".join(f"{x:.9g}" for x in RELIEF.points[MISSED])
    start, outer = f"pointchart boundary '{scan_file}' -o loop.txt", f"--outer{'=' if place[0] == '-' else ' '}{place}"
    until(lambda: line_shown(window) == f"{start} {outer}")
    choose(window, "Component", "largest")
    until(lambda: line_shown(window) == f"{start} --component largest {outer}")
    fill(window, "Outer loop at", "")
    tab(window, "Mesh")
    until(lambda: line_shown(window).endswith(" --component largest --boundary loop.txt"))
    tab(window, "Boundary")
    choose(window, "Component", "(default)")
    until(lambda: page.where() == {})


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
