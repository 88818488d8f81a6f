"""CAD files: a face comes back as it was written, with its area, unit and loops, or there is no file."""

import os
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import KDTree

from pointchart.cad import CAD_SUFFIXES, MILLIMETRES, compare, read_cad, write_cad
from pointchart.cad.cad_files import read_face
from pointchart.cad.make_face import make_surface
from pointchart.cad.occ import silence
from pointchart.cad.space_curves import lift
from pointchart.cad.trims import trim_edges
from pointchart.errors import FormatError, InputError, SolveError
from pointchart.plane.polygons import signed_area
from pointchart.surface import BSplineSurface, evaluate, normals

pytest.importorskip("OCP", reason="the extra cad is not installed")

BORDER = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
CLAMPED = np.array([0.0, 0.0, 1.0, 1.0])


def circle(n, radius=0.3, center=(0.5, 0.5)):
    angles = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    return np.array(center) + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def relief(scale=1.0):
    """Return a bicubic surface with hills, about 100 by 60 by 20."""
    knots = [np.concatenate([np.zeros(3), np.linspace(0, 1, n - 2) ** 1.1, np.ones(3)]) for n in (9, 7)]
    x, y = np.meshgrid(np.linspace(0, 100, 9), np.linspace(0, 60, 7), indexing="ij")
    return BSplineSurface(3, *knots, scale * np.stack([x, y, 20.0 * np.sin(x / 20.0) * np.cos(y / 15.0)], axis=-1))


def square(side=10.0):
    return BSplineSurface(1, CLAMPED, CLAMPED, side * np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]))


def face_of(path):
    """Return the face in a file, in millimetres."""
    with silence():
        return read_face(path, path)[0]


def area_of(path):
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    sums = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face_of(path), sums, 1e-9)
    return sums.Mass()


def n_edges(path):
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    explorer, count = TopExp_Explorer(face_of(path), TopAbs_ShapeEnum.TopAbs_EDGE), 0
    while explorer.More():
        explorer.Next()
        count += 1
    return count


LOOPS = {
    "disc": [circle(40)],
    "ring": [circle(40), circle(24, 0.1)[::-1]],
    "whole": [BORDER],
    "whole with two holes": [BORDER, circle(24, 0.1)[::-1], circle(24, 0.1, (0.2, 0.2))[::-1]],
    "diamond": [np.array([[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]])],
}
DROP = np.vstack([[[0.5, 0.95]], circle(40)[16:], circle(40)[:5]])


@pytest.mark.parametrize("name", LOOPS)
@pytest.mark.parametrize("suffix", [".step", ".igs", ".brep"])
def test_surface_and_loops_come_back(tmp_path, suffix, name):
    surface, path = relief(), tmp_path / f"a{suffix}"
    write_cad(path, surface, LOOPS[name])
    found, loops, unit = read_cad(path)
    assert unit == "mm"
    assert found.degree == 3
    assert np.allclose(found.knots_u, surface.knots_u, rtol=0, atol=1e-9)
    assert np.allclose(found.knots_v, surface.knots_v, rtol=0, atol=1e-9)
    assert np.abs(found.control - surface.control).max() <= 1e-9 * 100.0
    assert len(loops) == len(LOOPS[name])
    assert [signed_area(loop) > 0 for loop in loops] == [True] + [False] * (len(loops) - 1)
    given, read = np.concatenate(LOOPS[name]), np.concatenate(loops)
    assert KDTree(read).query(given)[0].max() <= 1e-8


def test_brep_keeps_every_bit(tmp_path):
    surface = relief(1.0 / 3.0)
    write_cad(tmp_path / "a.brep", surface, [BORDER])
    found, loops, _ = read_cad(tmp_path / "a.brep")
    assert np.array_equal(found.control, surface.control)
    assert np.array_equal(found.knots_u, surface.knots_u)
    assert {tuple(corner) for corner in loops[0].tolist()} == {tuple(corner) for corner in BORDER.tolist()}


def test_points_deviate_as_before(tmp_path):
    surface, uv = relief(), np.random.default_rng(4).random((500, 2))
    scan = evaluate(surface, uv) + np.array([0.0, 0.0, 0.25])
    write_cad(tmp_path / "a.step", surface, [BORDER])
    found = read_cad(tmp_path / "a.step")[0]
    assert np.linalg.norm(evaluate(found, uv) - scan, axis=1) == pytest.approx(0.25, abs=1e-9)


@pytest.mark.parametrize("suffix", [".stp", ".iges", ".brep"])
def test_area_in_circles_is_pi_times_their_radii_squared(tmp_path, suffix):
    n, path = 64, tmp_path / f"a{suffix}"
    # A cubic spline is off by 5/384 h^4 times the fourth derivative, 1 / r^3; the area by that times the length.
    share = 2.0 * 5.0 / 384.0 * (2.0 * np.pi / n) ** 4
    write_cad(path, square(10.0), [circle(n)])
    assert area_of(path) == pytest.approx(np.pi * 9.0, rel=share)
    write_cad(path, square(10.0), [circle(n), circle(n, 0.1)[::-1]])
    assert area_of(path) == pytest.approx(np.pi * 8.0, abs=np.pi * 10.0 * share)
    write_cad(path, square(10.0), [BORDER, circle(n, 0.1)[::-1]])
    assert area_of(path) == pytest.approx(100.0 - np.pi, abs=np.pi * share)


def test_area_in_a_polygon_is_exact(tmp_path):
    write_cad(tmp_path / "a.step", square(10.0), LOOPS["diamond"])
    assert area_of(tmp_path / "a.step") == pytest.approx(50.0, rel=1e-9)


@pytest.mark.parametrize(("name", "count"), [("disc", 1), ("ring", 2), ("whole", 4), ("diamond", 4)])
def test_a_smooth_loop_is_one_edge_and_a_corner_ends_one(tmp_path, name, count):
    write_cad(tmp_path / "a.step", relief(), LOOPS[name])
    assert n_edges(tmp_path / "a.step") == count
    assert compare.is_valid(face_of(tmp_path / "a.step"))


def test_a_drop_is_one_edge_from_its_corner_to_itself(tmp_path):
    (edges,) = trim_edges(relief(), [DROP])
    write_cad(tmp_path / "a.step", relief(), [DROP])
    assert n_edges(tmp_path / "a.step") == len(edges) == 1
    assert np.array_equal(edges[0].curve(edges[0].at[[0, -1]]), DROP[[0, 0]])


@pytest.mark.parametrize("unit", MILLIMETRES)
@pytest.mark.parametrize("suffix", [".step", ".igs"])
def test_coordinates_come_back_in_their_unit_and_lengths_in_millimetres(tmp_path, suffix, unit):
    path, factor = tmp_path / f"a{suffix}", MILLIMETRES[unit]
    write_cad(path, square(8.0), [BORDER], unit=unit)
    found, _, found_unit = read_cad(path)
    assert found_unit == unit
    assert np.allclose(found.control, square(8.0).control, rtol=1e-12, atol=1e-12)
    assert area_of(path) == pytest.approx((8.0 * factor) ** 2, rel=1e-9)


def test_an_inch_is_25_4_millimetres_in_brep(tmp_path):
    write_cad(tmp_path / "a.brep", square(1.0), [BORDER], unit="in")
    found, _, unit = read_cad(tmp_path / "a.brep")
    assert unit == "mm"
    assert found.control.max() == 25.4


def test_a_step_file_names_protocol_product_and_unit(tmp_path):
    write_cad(tmp_path / "a.step", square(), [BORDER], unit="in", name="Maß")
    text = (tmp_path / "a.step").read_text(encoding="ascii")
    assert "AUTOMOTIVE_DESIGN" in text
    assert r"PRODUCT('Ma\X2\00DF\X0\'" in text
    assert "CONVERSION_BASED_UNIT('INCH'" in text


@pytest.mark.parametrize("unit", ["mm", "m"])
def test_scans_in_survey_coordinates_are_written(tmp_path, unit):
    surface = replace(relief(), control=relief().control + np.array([5e5, 5.4e6, 300.0]))
    write_cad(tmp_path / "a.step", surface, LOOPS["whole with two holes"], unit=unit)
    found = read_cad(tmp_path / "a.step")[0]
    assert np.abs(found.control - surface.control).max() <= 1e-12 * 5.4e6


@pytest.mark.parametrize("loops", [LOOPS["whole with two holes"], LOOPS["ring"]], ids=["whole", "ring"])
@pytest.mark.parametrize("suffix", [".step", ".igs", ".brep"])
def test_surfaces_that_are_pinched_or_closed_at_a_side_are_written(tmp_path, suffix, loops):
    cone, tube = relief().control.copy(), relief().control.copy()
    cone[0] = cone[0, 0]
    angles = np.linspace(0.0, 2.0 * np.pi, 9)[:, None]
    tube[..., 0], tube[..., 2] = 20.0 * np.cos(angles), 20.0 * np.sin(angles)
    tube[-1] = tube[0]
    for control in (cone, tube):
        write_cad(tmp_path / f"a{suffix}", replace(relief(), control=control), loops)
        found, read_loops, _ = read_cad(tmp_path / f"a{suffix}")
        assert np.abs(found.control - control).max() <= 1e-9 * 100.0
        assert len(read_loops) == len(loops)


def test_curves_in_space_follow_the_surface():
    surface, (edges,) = relief(), trim_edges(relief(), [circle(30)])
    spline, error = lift(surface, edges[0].curve, 1e-5)
    at = np.linspace(0.0, edges[0].at[-1], 2001)
    gaps = np.linalg.norm(spline(at) - evaluate(surface, edges[0].curve(at)), axis=1)
    assert error <= 1e-5
    assert gaps.max() <= 2.0 * error


def test_splines_pass_all_points_and_stay_in_the_domain():
    on_border = np.linspace(0.2, 0.8, 7)
    arch = np.array([[0.9, 0.05], [1.0, 0.2], [1.0, 0.5], [0.5, 0.9], [0.0, 0.5], [0.0, 0.2], [0.1, 0.05]])
    loop = np.vstack([np.column_stack([on_border, np.zeros(7)]), arch])
    (edges,) = trim_edges(square(), [loop])
    for edge in edges:
        places = edge.curve(np.linspace(0.0, edge.at[-1], 101))
        assert places.min() >= -1e-12
        assert places.max() <= 1.0 + 1e-12
        assert np.allclose(edge.curve(edge.at), loop[(edge.first + np.arange(len(edge.at))) % len(loop)], atol=1e-12)


def test_sides_stay_straight_where_a_spline_would_pass_another_loop(tmp_path):
    angles = (np.arange(10) + 0.5) * 2.0 * np.pi / 10
    hole = 0.5 + 0.4 * np.column_stack([np.cos(angles), np.sin(angles)])[::-1]
    outer = np.array([[0.05, 0.05], [0.89, 0.05], [0.89, 0.95], [0.05, 0.95]])  # the chord ends at 0.88, the arc at 0.9
    assert len(trim_edges(square(), [BORDER, hole])[1]) == 1
    assert len(trim_edges(square(), [outer, hole])[1]) == 2
    write_cad(tmp_path / "a.step", square(), [outer, hole])
    assert area_of(tmp_path / "a.step") < 100.0 * (signed_area(outer) + signed_area(hole))


def test_loops_that_meet_are_named(tmp_path):
    tooth = np.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.4, 0.05], [0.1, 0.9]])
    with pytest.raises(InputError, match="loop 0 meets itself or another loop at its sides 0, 2, 3; untangle it"):
        write_cad(tmp_path / "a.step", square(), [tooth])
    hole = np.roll(circle(20, 0.2, (0.7, 0.5)), 10, axis=0)[::-1]
    with pytest.raises(InputError, match="loop 0 meets itself or another loop"):
        write_cad(tmp_path / "a.step", square(), [circle(20), np.roll(hole, 5, axis=0)])


@pytest.mark.parametrize("suffix", [".step", ".igs", ".brep"])
def test_a_face_that_comes_back_otherwise_leaves_the_old_file(tmp_path, monkeypatch, suffix):
    path = tmp_path / f"a{suffix}"
    path.write_text("old")
    monkeypatch.setattr(compare, "DEVIATION", -1.0)
    with pytest.raises(FormatError, match="comes back"):
        write_cad(path, square(), [BORDER])
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_full_disk_leaves_the_old_file(tmp_path, full_disk):
    path = tmp_path / "a.step"
    path.write_text("old")
    with pytest.raises(FormatError, match="No space left on device"):
        write_cad(path, square(), [BORDER])
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_missing_extra_is_named(tmp_path, monkeypatch):
    write_cad(tmp_path / "a.step", square(), [BORDER])
    monkeypatch.setitem(sys.modules, "OCP.collections", None)
    with pytest.raises(FormatError, match=r"is not installed; pip install 'pointchart\[cad\]'"):
        write_cad(tmp_path / "b.step", square(), [BORDER])
    with pytest.raises(FormatError, match=r"pip install 'pointchart\[cad\]'"):
        read_cad(tmp_path / "a.step")


@pytest.mark.parametrize("suffix", CAD_SUFFIXES)
def test_nothing_is_printed_and_settings_are_put_back(tmp_path, capfd, suffix):
    from OCP.Interface import Interface_Static
    from OCP.Message import Message

    before = Interface_Static.CVal_s("write.step.unit"), Message.DefaultMessenger_s().Printers().Size()
    path = tmp_path / f"a{suffix}"
    write_cad(path, square(), LOOPS["ring"], unit="in")
    read_cad(path)
    path.write_bytes(path.read_bytes()[:700])
    with pytest.raises(FormatError):
        read_cad(path)
    assert capfd.readouterr() == ("", "")
    assert before == (Interface_Static.CVal_s("write.step.unit"), Message.DefaultMessenger_s().Printers().Size())


@pytest.mark.parametrize("suffix", CAD_SUFFIXES)
@pytest.mark.parametrize("content", [b"no such file\nat all\n", bytes(range(256)) * 8, b"\0" * 900], ids=len)
def test_damaged_files_are_refused(tmp_path, suffix, content):
    (tmp_path / f"a{suffix}").write_bytes(content)
    with pytest.raises(FormatError, match=r"copy or export it again|holds 0 faces"):
        read_cad(tmp_path / f"a{suffix}")


def test_paths_beyond_ascii_are_written(tmp_path):
    folder = tmp_path / "Flächen 曲面"
    folder.mkdir()
    write_cad(folder / "ß.step", square(), [BORDER])
    assert read_cad(folder / "ß.step")[2] == "mm"
    assert [path.name for path in folder.iterdir()] == ["ß.step"]


def test_knots_that_open_cascade_takes_for_one_are_refused(tmp_path):
    knots = np.array([0.0, 0.0, 0.5, np.nextafter(0.5, 1.0), 1.0, 1.0])
    close = BSplineSurface(1, knots, CLAMPED, np.random.default_rng(3).random((4, 2, 3)))
    with pytest.raises(
        SolveError, match=r"a\.step: Open CASCADE makes no face of the surface; fit it with fewer knots"
    ):
        write_cad(tmp_path / "a.step", close, [BORDER])
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are text elsewhere")
def test_paths_that_are_no_text_are_refused(tmp_path):
    path = tmp_path / os.fsdecode(b"\xff.step")
    with pytest.raises(FormatError, match="is no UTF-8, which Open CASCADE needs; rename the file"):
        write_cad(path, square(), [BORDER])
    path.write_bytes(b"any")
    with pytest.raises(FormatError, match="is no UTF-8"):
        read_cad(path)


def test_wrong_paths_are_named(tmp_path):
    with pytest.raises(FormatError, match=r"the suffix '\.ply' cannot be written here; choose one of \.step"):
        write_cad(tmp_path / "a.ply", square(), [BORDER])
    with pytest.raises(FormatError, match=r"does not exist; create it first"):
        write_cad(tmp_path / "no" / "a.step", square(), [BORDER])
    with pytest.raises(FormatError, match=r"there is no such file"):
        read_cad(tmp_path / "a.step")
    (tmp_path / "a.ply").write_text("ply")
    with pytest.raises(FormatError, match=r"the suffix '\.ply' cannot be read here"):
        read_cad(tmp_path / "a.ply")


def write_shape(path, shape):
    from OCP.BRepTools import BRepTools

    assert BRepTools.Write_s(shape, str(path))


def test_faces_of_other_kinds_are_refused(tmp_path):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pln

    path = tmp_path / "a.brep"
    write_shape(path, BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape())
    with pytest.raises(FormatError, match="holds 6 faces, but one is needed"):
        read_cad(path)
    write_shape(path, BRepBuilderAPI_MakeFace(gp_Pln(), 0.0, 1.0, 0.0, 1.0).Face())
    with pytest.raises(FormatError, match="lies on a Plane, not on a B-spline surface"):
        read_cad(path)


def test_a_face_turned_against_its_surface_keeps_its_normal(tmp_path):
    write_cad(tmp_path / "a.brep", relief(), LOOPS["ring"])
    write_shape(tmp_path / "b.brep", face_of(tmp_path / "a.brep").Reversed())
    found, loops, _ = read_cad(tmp_path / "b.brep")
    uv = np.array([[0.3, 0.6]])
    assert np.allclose(normals(found, uv[:, ::-1]), -normals(relief(), uv), atol=1e-12)
    assert [signed_area(loop) > 0 for loop in loops] == [True, False]


def test_unequal_degrees_are_raised_to_the_larger(tmp_path):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace

    carrier = make_surface(square(3.0))
    carrier.IncreaseDegree(1, 3)
    write_shape(tmp_path / "a.brep", BRepBuilderAPI_MakeFace(carrier, 1e-7).Face())
    found = read_cad(tmp_path / "a.brep")[0]
    assert found.degree == 3
    assert evaluate(found, np.array([[0.25, 0.5]])) == pytest.approx(np.array([[0.75, 1.5, 0.0]]))
