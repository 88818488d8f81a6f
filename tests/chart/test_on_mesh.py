import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import flat, rotations

from pointchart import (
    InputError,
    SolveError,
    area_distortions,
    certify,
    conformal_distortions,
    direct,
    l2_stretch,
    linf_stretch,
    minimize_dirichlet,
    multigrid,
    read_scan,
    reconstruct,
    shapes,
    stretches,
    swap_to_least_curvature,
    uv_free_boundary,
    uv_low_stretch,
    uv_of_points,
    uv_on_mesh,
    vertex_stretches,
    write_mesh,
)
from pointchart.boundary import chord_length_on_circle
from pointchart.chart import on_mesh as charts
from pointchart.chart.free_boundary import first_flat
from pointchart.chart.on_mesh import DIRECT_LIMIT, QUICK_TOLERANCES
from pointchart.mesh.make import Meshed
from pointchart.mesh.mesh_quality import measure_quality
from pointchart.mesh.quality import area_vectors
from pointchart.mesh.swap_rule import Swapped
from pointchart.plane.exact_signs import is_simple, orientation_signs
from pointchart.proof.certificate import check_proof
from pointchart.report.mesh_facts import quality_facts
from pointchart.runs.choices import CHARTS
from pointchart.runs.option_values import Chart

ONE_TO_ONE = [uv_on_mesh, uv_low_stretch, uv_free_boundary]
PROTRUDING = {"hemisphere": lambda: shapes.hemisphere(500, angle=150), "tube": lambda: shapes.tube(6, n_around=16)}
SQUARE = flat(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
WHOLE = np.array([[0, 1, 2], [0, 2, 3]])


def charted(chart, shape):
    """Return the parameters that a chart gives to the mesh of a shape."""
    meshed = Meshed(Swapped(shape.triangles, 0, True))
    layout = chord_length_on_circle(shape.points, shape.boundary)
    return chart(shape.points, shape.boundary, layout, meshed, direct).uv


def large_disc():
    """Return a disc of more points than are mapped directly at once, and its mesh without a map."""
    shape = shapes.relief(DIRECT_LIMIT + 2000, seed=3)
    return shape, Meshed(Swapped(shape.triangles, 0, True))


def freed(shape, **options):
    start = charted(uv_on_mesh, shape)
    return minimize_dirichlet(shape.points, shape.triangles, shape.boundary, start, **options)


def surface_area(points, triangles):
    return np.linalg.norm(area_vectors(points, triangles), axis=1).sum()


def image_area(uv, triangles):
    return surface_area(flat(uv), triangles)


# One-to-one


@pytest.mark.parametrize("chart", ONE_TO_ONE)
def test_every_chart_of_the_mesh_is_one_to_one(any_disc, chart):
    uv = charted(chart, any_disc)
    assert certify(any_disc.points, any_disc.triangles, uv=uv, loop=any_disc.boundary).is_one_to_one


@pytest.mark.parametrize("chart", ONE_TO_ONE)
@pytest.mark.parametrize(
    "shape", [shapes.tube(8, n_around=20), shapes.dumbbell(1200, neck=6)], ids=["tube", "dumbbell"]
)
def test_a_tube_and_a_dumbbell_are_certified_with_every_chart(shape, chart):
    result = reconstruct(shape.points, shape.boundary, chart=chart)
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one


@pytest.mark.parametrize("chart", ONE_TO_ONE)
def test_a_chart_that_is_not_one_to_one_is_refused(chart):
    proof = certify(SQUARE, WHOLE, uv=SQUARE[[0, 1, 3, 2], :2])
    with pytest.raises(SolveError, match="the parameters are not one-to-one: 1 triangles are flat"):
        check_proof(proof, is_one_to_one=chart.is_one_to_one)
    check_proof(proof, is_one_to_one=uv_of_points.is_one_to_one)


# Large meshes


def test_a_large_mesh_is_mapped_by_multigrid_as_by_factors_up_to_its_tolerance():
    shape, meshed = large_disc()
    layout = chord_length_on_circle(shape.points, shape.boundary)
    quick, exact = (uv_on_mesh(shape.points, shape.boundary, layout, meshed, solver) for solver in (None, direct))
    assert [mapped.solution.method for mapped in (quick, exact)] == ["multigrid", "direct"]
    assert quick.solution.residual <= 1.01 * QUICK_TOLERANCES[0]
    assert np.abs(quick.uv - exact.uv).max() < 100 * QUICK_TOLERANCES[0]
    assert np.array_equal(quick.uv[shape.boundary], layout)
    for mapped in (quick, exact):
        assert (orientation_signs(mapped.uv, shape.triangles) > 0).all()


def folded(left, right, **_):
    """Solve, and let two unknowns change places."""
    solution = direct(left, right)[0]
    solution[[0, 1]] = solution[[1, 0]]
    return solution, ()


def test_a_large_mesh_is_mapped_on_to_the_next_tolerance_where_the_first_leaves_triangles_turned_over(monkeypatch):
    asked, given = [], []

    def quick(left, right, *, tolerance, start):
        asked.append(tolerance)
        given.append(start)
        if tolerance == 0.5:
            return folded(left, right)
        return multigrid(left, right, tolerance=tolerance, start=start)

    monkeypatch.setattr(charts, "multigrid", quick)
    monkeypatch.setattr(charts, "QUICK_TOLERANCES", (0.5, 1e-10))
    shape, meshed = large_disc()
    layout = chord_length_on_circle(shape.points, shape.boundary)
    mapped = uv_on_mesh(shape.points, shape.boundary, layout, meshed, None)
    assert asked == [0.5, 1e-10]
    assert given[0] is None
    # The start is the first answer, so only two unknowns are off.
    inner = np.delete(mapped.uv, shape.boundary, axis=0)
    assert np.flatnonzero(np.abs(given[1] - inner).max(axis=1) > 1e-6).tolist() == [0, 1]
    assert mapped.solution.method == "quick"
    assert mapped.solution.residual <= 1.01e-10
    assert (orientation_signs(mapped.uv, shape.triangles) > 0).all()


def hopeless(left, right, **_):
    raise SolveError("missed")


@pytest.mark.parametrize("quick", [folded, hopeless])
def test_a_large_mesh_is_mapped_to_the_last_digits_where_the_quick_map_does_not_do(monkeypatch, quick):
    monkeypatch.setattr(charts, "multigrid", quick)
    shape, meshed = large_disc()
    layout = chord_length_on_circle(shape.points, shape.boundary)
    mapped = uv_on_mesh(shape.points, shape.boundary, layout, meshed, None)
    assert mapped.solution.method == "direct"
    assert (orientation_signs(mapped.uv, shape.triangles) > 0).all()


def test_a_long_tube_of_many_points_is_mapped_one_to_one():
    tube = shapes.tube(10, n_around=100)
    assert len(tube.points) > DIRECT_LIMIT
    result = reconstruct(tube.points, tube.boundary)
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one


def test_a_mesh_that_was_assembled_has_no_parameters_of_the_points():
    shape = shapes.hemisphere(300)
    layout = chord_length_on_circle(shape.points, shape.boundary)
    with pytest.raises(InputError, match="the mesh was made without a map, so it has no parameters of the points"):
        uv_of_points(shape.points, shape.boundary, layout, Meshed(Swapped(shape.triangles, 0, True)), direct)


# Low stretch


@pytest.mark.parametrize("name", PROTRUDING)
def test_low_stretch_has_a_tenth_less_stretch_than_the_mean_value_map_and_the_same_boundary(name):
    shape = PROTRUDING[name]()
    before, after = (charted(chart, shape) for chart in (uv_on_mesh, uv_low_stretch))
    stretch = [l2_stretch(shape.points, shape.triangles, uv) for uv in (before, after)]
    assert stretch[1] < 0.9 * stretch[0]
    assert np.array_equal(before[shape.boundary], after[shape.boundary])
    assert (orientation_signs(after, shape.triangles) > 0).all()


def test_low_stretch_is_never_worse_than_the_map_it_starts_from(any_disc):
    before, after = (charted(chart, any_disc) for chart in (uv_on_mesh, uv_low_stretch))
    assert l2_stretch(any_disc.points, any_disc.triangles, after) <= l2_stretch(
        any_disc.points, any_disc.triangles, before
    )


# Free boundary


@pytest.mark.parametrize(
    ("shape", "tolerance"),
    [(shapes.bent_sheet(270, nx=25, ny=15), 1e-3), (shapes.roll(shapes.disc(400, seed=1), 200), 0.02)],
    ids=["grid, whose folds are straight", "disc, whose triangles cut across the cylinder"],
)
def test_a_developable_patch_comes_out_isometric(shape, tolerance):
    uv = charted(uv_free_boundary, shape)
    largest, smallest = stretches(shape.points, shape.triangles, uv)
    assert np.abs(np.r_[largest, smallest] - 1).max() < tolerance
    assert freed(shape).energies[-1] == pytest.approx(4, abs=tolerance**2)


def test_a_plane_comes_out_congruent():
    shape = shapes.disc(300, seed=2)
    uv = charted(uv_free_boundary, shape)
    edges = shape.triangles[:, [0, 1]]
    lengths = [np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1) for x in (uv, shape.points)]
    assert np.allclose(*lengths, rtol=2e-3)


def test_the_energy_falls_with_each_step_and_starts_no_lower_than_four(any_disc):
    energies = freed(any_disc).energies
    assert (np.diff(energies) < 0).all()
    assert energies[-1] >= 4 - 1e-12


def test_no_step_flips_a_triangle_or_lets_the_boundary_cross_itself():
    shape = PROTRUDING["tube"]()
    n_steps = len(freed(shape).energies) - 1
    assert n_steps > 5
    for k in range(n_steps + 1):
        step = freed(shape, most_steps=k)
        assert len(step.energies) == k + 1
        assert (orientation_signs(step.uv, shape.triangles) > 0).all()
        assert is_simple(step.uv[shape.boundary])


def test_a_strip_that_curls_over_itself_stops_before_it_overlaps():
    # Developed, a cone whose angle is over a full turn would lie on itself.
    turn = np.linspace(0, 2.4 * np.pi, 61)
    radius = np.array([1.0, 1.15, 1.3])
    slope = np.sqrt(1.0 - 0.98**2)
    grid = shapes.grid(61, 3)
    place, ring = (grid.points[:, k].astype(int) for k in (0, 1))
    r, t = radius[ring], turn[place]
    # A helicoidal lift keeps the turns apart in space.
    points = np.c_[r * np.cos(t), r * np.sin(t), slope * r + 0.01 * t]
    triangles = (
        grid.triangles[:, ::-1] if orientation_signs(np.c_[r * t, -r], grid.triangles)[0] < 0 else grid.triangles
    )
    loop = shapes.Shape(points, triangles, grid.uv).boundary
    meshed = Meshed(Swapped(triangles, 0, True))
    uv = uv_free_boundary(points, loop, chord_length_on_circle(points, loop), meshed, direct).uv
    proof = certify(points, triangles, uv=uv, loop=loop)
    assert proof.is_one_to_one
    assert l2_stretch(points, triangles, uv) < 1.5


def test_the_parameters_have_the_area_of_the_surface(any_disc):
    uv = charted(uv_free_boundary, any_disc)
    area = surface_area(any_disc.points, any_disc.triangles)
    assert image_area(uv, any_disc.triangles) == pytest.approx(area, rel=1e-12)


@settings(max_examples=5)
@given(rotations(), st.floats(-6, 6))
def test_pose_and_size_do_not_change_the_map(rotation, exponent):
    shape = shapes.relief(200, seed=4)
    start = charted(uv_on_mesh, shape)
    moved = 10.0**exponent * (shape.points @ rotation.T)
    one, other = (
        minimize_dirichlet(points, shape.triangles, shape.boundary, start) for points in (shape.points, moved)
    )
    assert other.energies == pytest.approx(one.energies, rel=1e-6)
    assert other.uv == pytest.approx(10.0**exponent * one.uv, rel=1e-5, abs=1e-5 * 10.0**exponent)


def test_the_size_of_the_start_does_not_matter():
    shape = shapes.relief(200, seed=4)
    start = charted(uv_on_mesh, shape)
    one, other = (
        minimize_dirichlet(shape.points, shape.triangles, shape.boundary, scale * start) for scale in (1, 1e7)
    )
    assert other.uv == pytest.approx(one.uv, rel=1e-6, abs=1e-8)


def test_a_triangle_that_is_flat_in_space_does_no_harm():
    points = flat(np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [0, 1]]))
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    turn = 2 * np.pi * np.arange(5) / 5
    uv = minimize_dirichlet(points, triangles, np.arange(5), np.c_[np.cos(turn), np.sin(turn)]).uv
    assert certify(points, triangles, uv=uv).is_one_to_one


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (SQUARE[:3, :2], r"the start has shape \(3, 2\); 4 points need \(4, 2\)"),
        (SQUARE[[0, 1, 1, 3], :2], "1 triangles of the start are flat or turned over, the first at points 0, 1, 2"),
        (SQUARE[::-1, :2], "2 triangles of the start are flat or turned over"),
    ],
)
def test_a_start_that_is_not_one_to_one_is_refused(start, message):
    with pytest.raises(InputError, match=message):
        minimize_dirichlet(SQUARE, WHOLE, [0, 1, 2, 3], start)


def test_a_start_that_overlaps_itself_is_refused():
    turn = np.linspace(0, 3.4 * np.pi, 40)
    rim = np.c_[np.cos(turn), np.sin(turn)] * (1 + 0.01 * np.arange(40))[:, None]
    fan = np.c_[np.zeros(39, int), np.arange(1, 40), np.arange(2, 41)]
    uv = np.r_[[[0.0, 0]], rim]
    with pytest.raises(InputError, match="the boundary of the start crosses itself"):
        minimize_dirichlet(np.c_[uv, np.arange(41.0)], fan, np.arange(41), uv)


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_a_step_to_the_first_flat_triangle_leaves_none_turned_over(seed):
    rng = np.random.default_rng(seed)
    corners, steps = rng.normal(size=(2, 20, 3, 2))
    triangles = np.arange(60).reshape(20, 3)
    is_negative = orientation_signs(corners.reshape(-1, 2), triangles) < 0
    corners[is_negative] = corners[is_negative][:, ::-1]
    reach = first_flat(corners, steps)
    before, after = ((corners + share * reach * steps).reshape(-1, 2) for share in (0.999, 1.001))
    assert (orientation_signs(before, triangles) > 0).all()
    assert (orientation_signs(after, triangles) < 0).any()


# Measures


@settings(max_examples=10)
@given(st.floats(1.0, 20.0), st.floats(-3, 3))
def test_the_measures_of_a_linear_map_are_exact(ratio, exponent):
    shape = shapes.disc(80, seed=5)
    points, uv = shape.points * [ratio, 1, 1], 10.0**exponent * shape.uv
    assert linf_stretch(points, shape.triangles, uv) == pytest.approx(np.sqrt(ratio))
    assert conformal_distortions(points, shape.triangles, uv) == pytest.approx(ratio)
    assert area_distortions(points, shape.triangles, uv) == pytest.approx(1.0)
    assert vertex_stretches(points, shape.triangles, uv) == pytest.approx(np.sqrt((ratio + 1 / ratio) / 2))


def test_a_conformal_map_changes_areas_and_no_angles():
    sphere = shapes.hemisphere(3000)
    assert np.percentile(conformal_distortions(sphere.points, sphere.triangles, sphere.uv), 95) < 1.1
    # Stereographic projection: areas change by 4 / (1 + r^2)^2, from 4 in the middle to 1 at the rim, 2 on the whole.
    assert area_distortions(sphere.points, sphere.triangles, sphere.uv).max() == pytest.approx(2.0, rel=0.05)


def test_a_flat_triangle_is_infinitely_distorted_and_null_in_the_report():
    uv = np.array([[0.0, 0], [1, 0], [0.5, 0], [0, 1]])
    assert linf_stretch(SQUARE, WHOLE, uv) == float("inf")
    assert conformal_distortions(SQUARE, WHOLE, uv)[0] == float("inf")
    assert area_distortions(SQUARE, WHOLE, uv)[0] == float("inf")
    report = quality_facts(measure_quality(SQUARE, WHOLE, uv))
    assert report["l2_stretch"] is report["linf_stretch"] is report["area"]["mean"] is None
    json.dumps(report, allow_nan=False)


def test_the_report_of_an_isometry_holds_every_measure_and_each_is_one():
    report = quality_facts(measure_quality(SQUARE, WHOLE, SQUARE[:, :2]))
    assert report["l2_stretch"] == report["linf_stretch"] == pytest.approx(1.0)
    for name in ("conformal", "area"):
        assert report[name] == {key: pytest.approx(1.0) for key in ("mean", "percentile_95", "largest")}
    assert report["least_uv_distance"] == 1.0


def test_the_percentile_of_the_report_weighs_by_area():
    points = flat(np.array([[0.0, 0], [99, 0], [99, 1], [0, 2], [99, 1.001]]))
    uv = points[:, :2] * [1, 1]
    uv[4, 1] = 1.5
    triangles = np.array([[0, 1, 2], [0, 2, 4], [0, 4, 3]])
    report = quality_facts(measure_quality(points, triangles, uv))["conformal"]
    assert report["percentile_95"] < report["largest"]


# On the command line


def test_every_word_of_the_command_line_names_a_chart():
    assert set(CHARTS) == set(Chart)
    assert [chart.value for chart in Chart] == ["mesh", "low-stretch", "free", "paper"]


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command line in a folder of its own."""
    from pointchart import cli

    monkeypatch.chdir(tmp_path)

    def call(*words):
        monkeypatch.setattr("sys.argv", ["pointchart", *words])
        with pytest.raises(SystemExit) as end:
            cli.main()
        return end.value.code

    return call


@pytest.mark.parametrize("uv", ["mesh", "low-stretch", "free", "paper"])
def test_mesh_writes_the_stretch_of_each_vertex_and_reports_the_measures(run, tmp_path, uv):
    cap = shapes.hemisphere(300)
    write_mesh("cap.ply", cap.points, cap.triangles)
    assert run("mesh", "cap.ply", "-o", "m.ply", "--uv", uv, "--report", "run.json", "--quiet") in (0, None)
    mesh = read_scan(tmp_path / "m.ply")
    columns = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    assert np.allclose(mesh.attributes["stretch"], vertex_stretches(mesh.points, mesh.triangles, columns))
    quality = json.loads((tmp_path / "run.json").read_text())["quality"]
    assert {"l2_stretch", "linf_stretch", "conformal", "area", "least_uv_distance"} <= set(quality)
    assert quality["l2_stretch"] == pytest.approx(l2_stretch(mesh.points, mesh.triangles, columns))


def test_a_mesh_that_is_meshed_again_gets_the_stretch_of_its_new_parameters(run, tmp_path):
    cap = shapes.hemisphere(300)
    write_mesh("cap.ply", cap.points, cap.triangles, attributes={"stretch": np.arange(300.0)})
    assert run("mesh", "cap.ply", "-o", "m.ply", "--quiet") in (0, None)
    mesh = read_scan(tmp_path / "m.ply")
    columns = np.column_stack([mesh.attributes["u"], mesh.attributes["v"]])
    assert np.allclose(mesh.attributes["stretch"], vertex_stretches(mesh.points, mesh.triangles, columns))


def test_the_area_of_free_parameters_is_that_of_the_surface_in_the_unit_of_the_scan():
    cap = shapes.hemisphere(300)
    result = reconstruct(1000.0 * cap.points, chart=uv_free_boundary)
    edges = [result.uv[result.triangles[:, k]] - result.uv[result.triangles[:, 0]] for k in (1, 2)]
    area = 0.5 * (edges[0][:, 0] * edges[1][:, 1] - edges[0][:, 1] * edges[1][:, 0]).sum()
    assert area == pytest.approx(surface_area(1000.0 * cap.points, result.triangles))


def test_where_the_weights_get_out_of_hand_the_maps_before_stand():
    """Sheets of 1.5 spacings get mixed up, and triangles shrink beyond what doubles hold."""
    sheet = shapes.fold(1.5)
    result = reconstruct(sheet.points, sheet.boundary, chart=uv_low_stretch, swap=swap_to_least_curvature)
    assert result.certificate.is_one_to_one
