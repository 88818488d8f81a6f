from math import cos, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from pointchart import shapes
from pointchart.errors import InputError
from pointchart.shapes import Shape
from pointchart.shapes.planar import delaunay, ragged_delaunay

DISCS = {
    "grid": lambda: shapes.grid(7, 5),
    "disc": lambda: shapes.disc(500),
    "hemisphere": lambda: shapes.hemisphere(500),
    "cap of 150 degrees": lambda: shapes.hemisphere(500, angle=150),
    "short tube": lambda: shapes.tube(0.1),
    "long tube": lambda: shapes.tube(40, n_around=12),
    "bent sheet": lambda: shapes.bent_sheet(270),
    "fold": lambda: shapes.fold(3),
    "relief": lambda: shapes.relief(500),
    "sculpture": lambda: shapes.sculpture(3000),
    "demo scan": shapes.demo_scan,
    "thinned disc": lambda: shapes.thin(shapes.disc(2000)),
    "thinned scan": lambda: shapes.thin(shapes.demo_scan()),
    "thinned cap": lambda: shapes.thin(shapes.hemisphere(2000, angle=150)),
    "noisy, shuffled relief": lambda: shapes.shuffle(shapes.add_noise(shapes.relief(500))),
    "rolled disc": lambda: shapes.roll(shapes.disc(500), 270),
    "dumbbell": lambda: shapes.dumbbell(600),
    "dumbbell with a neck of two spacings": lambda: shapes.dumbbell(600, neck=2),
    "bumpy dumbbell": lambda: shapes.raise_bumps(shapes.dumbbell(600)),
    "graded disc": lambda: shapes.grade(shapes.disc(500), ratio=40),
    "lines three times as far apart": lambda: shapes.laser_scan(shapes.sculpted_face, lines=30, anisotropy=3, noise=0),
    "lines five times as far apart": lambda: shapes.laser_scan(shapes.sculpted_face, lines=30, anisotropy=5, noise=0),
}
NOT_DISCS = {
    "annulus": (shapes.annulus, 0, [96, 96]),
    "moebius": (shapes.moebius, 0, [192]),
    "sphere": (lambda: shapes.sphere(500), 2, []),
    "torus": (shapes.torus, 0, []),
}
PIERCED = {
    "disc": lambda n_gaps: shapes.pierce(shapes.disc(1500, seed=1), n_gaps=n_gaps, seed=1),
    "relief": lambda n_gaps: shapes.pierce(shapes.relief(1500), n_gaps=n_gaps, radius_in_spacings=3),
    "graded disc": lambda n_gaps: shapes.pierce(shapes.grade(shapes.disc(1500)), n_gaps=n_gaps, radius_in_spacings=3),
    "sphere": lambda n_gaps: shapes.pierce(shapes.sphere(1000), n_gaps=n_gaps, radius_in_spacings=3),
    "torus": lambda n_gaps: shapes.pierce(shapes.torus(64, 24), n_gaps=n_gaps, radius_in_spacings=3),
}
SEEDED = {
    "disc": lambda seed: shapes.disc(100, seed=seed),
    "relief": lambda seed: shapes.relief(100, seed=seed),
    "noise": lambda seed: shapes.add_noise(shapes.grid(9, 9), seed=seed),
    "thin": lambda seed: shapes.thin(shapes.grid(9, 9), seed=seed),
    "shuffle": lambda seed: shapes.shuffle(shapes.grid(9, 9), seed=seed),
    "scan": lambda seed: shapes.demo_scan(seed=seed),
    "bumps": lambda seed: shapes.raise_bumps(shapes.dumbbell(400), seed=seed),
    "pierce": lambda seed: shapes.pierce(shapes.disc(500), seed=seed),
}


def signed_areas(uv, triangles):
    a, b, c = uv[triangles.T]
    return np.linalg.det(np.stack([b - a, c - a], axis=1)) / 2


def edges_of(triangles):
    return np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)


def edge_lengths(shape):
    edges = np.unique(edges_of(shape.triangles), axis=0)
    return np.linalg.norm(shape.points[edges[:, 0]] - shape.points[edges[:, 1]], axis=1)


def euler_characteristic(shape):
    n_edges = len(np.unique(edges_of(shape.triangles), axis=0))
    return len(np.unique(shape.triangles)) - n_edges + len(shape.triangles)


def has_one_fan_a_point(shape):
    """Tell whether the link of every point is one path or one cycle, so that the mesh is a manifold there."""
    links = {}
    for a, b, c in shape.triangles.tolist():
        for corner, link in ((a, (b, c)), (b, (c, a)), (c, (a, b))):
            links.setdefault(corner, []).append(link)
    for link in links.values():
        parts = {end: end for edge in link for end in edge}
        for start, end in link:
            first, second = parts[start], parts[end]
            parts = {point: second if part == first else part for point, part in parts.items()}
        if len(set(parts.values())) > 1:
            return False
    return True


def normals_of(shape):
    a, b, c = shape.points[shape.triangles.T]
    return np.cross(b - a, c - a)


def point_normals(shape):
    normals = np.zeros_like(shape.points)
    np.add.at(normals, shape.triangles, normals_of(shape)[:, None, :])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def scan():
    return shapes.demo_scan()


@pytest.mark.parametrize("make", DISCS.values(), ids=DISCS)
def test_the_true_mesh_is_a_manifold_disc_with_every_point(make):
    shape = make()
    counts = np.unique(edges_of(shape.triangles), axis=0, return_counts=True)[1]
    assert euler_characteristic(shape) == 1
    assert counts.max() == 2
    assert has_one_fan_a_point(shape)
    assert np.array_equal(np.unique(shape.triangles), np.arange(len(shape.points)))
    assert [len(loop) for loop in shape.loops] == [np.count_nonzero(counts == 1)]


@pytest.mark.parametrize("make", DISCS.values(), ids=DISCS)
def test_every_triangle_is_anticlockwise_in_its_parameters(make):
    shape = make()
    assert signed_areas(shape.uv, shape.triangles).min() > 0


@pytest.mark.parametrize("make", DISCS.values(), ids=DISCS)
def test_the_boundary_has_the_surface_on_its_left(make):
    shape = make()
    directed = {tuple(edge) for edge in shape.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()}
    loop = shape.boundary
    assert all(edge in directed for edge in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
    u, v = shape.uv[loop].T
    assert np.sum(u * np.roll(v, -1) - v * np.roll(u, -1)) > 0


@pytest.mark.parametrize("make", DISCS.values(), ids=DISCS)
def test_arrays_have_the_promised_types(make):
    shape = make()
    assert (shape.points.dtype, shape.uv.dtype, shape.triangles.dtype) == (np.float64, np.float64, np.int64)
    assert shape.points.shape == (len(shape.uv), 3)
    assert shape.uv.shape == (len(shape.points), 2)
    assert shape.boundary.dtype == np.int64


@pytest.mark.parametrize(("make", "euler", "loops"), NOT_DISCS.values(), ids=NOT_DISCS)
def test_other_topologies_have_their_euler_characteristic_and_loops(make, euler, loops):
    shape = make()
    assert euler_characteristic(shape) == euler
    assert has_one_fan_a_point(shape)
    assert [len(loop) for loop in shape.loops] == loops
    assert len(shape.boundary) == (loops[0] if loops else 0)


def test_only_the_moebius_strip_is_one_sided():
    for make, _, _ in NOT_DISCS.values():
        triangles = make().triangles
        directed = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        is_orientable = len(np.unique(directed, axis=0)) == len(directed)
        assert is_orientable == (make is not shapes.moebius)


def test_both_loops_of_the_annulus_have_the_surface_on_their_left():
    ring = shapes.annulus(30, 4)
    turns = {}
    for loop in ring.loops:
        x, y = ring.points[loop, :2].T
        turns[round(float(np.hypot(x, y)[0]), 9)] = np.sign(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    assert turns == {1.0: 1, 0.5: -1}


def test_the_grid_is_exact():
    shape = shapes.grid(4, 3)
    assert shape.points.tolist() == [[i, j, 0] for j in range(3) for i in range(4)]
    assert shape.boundary.tolist() == [0, 1, 2, 3, 7, 11, 10, 9, 8, 4]
    assert signed_areas(shape.uv, shape.triangles).tolist() == [0.5] * 12
    assert shape.spacing == 1


def test_the_rim_of_the_disc_is_the_unit_circle():
    shape = shapes.disc(1000)
    norm = np.linalg.norm(shape.points, axis=1)
    on_rim = np.isin(np.arange(1000), shape.boundary)
    assert np.allclose(norm[on_rim], 1, rtol=0, atol=1e-15)
    assert norm[~on_rim].max() < 1 - 0.3 * shape.spacing


@given(n=st.integers(8, 600), jitter=st.floats(0, 0.3), seed=st.integers(0, 99))
@settings(max_examples=40, deadline=None)
def test_points_of_the_disc_stay_apart(n, jitter, seed):
    shape = shapes.disc(n, jitter=jitter, seed=seed)
    assert edge_lengths(shape).min() > 0.1 * shape.spacing
    assert euler_characteristic(shape) == 1


@pytest.mark.parametrize("angle", [30, 90, 150])
def test_the_cap_is_a_part_of_the_unit_sphere(angle):
    shape = shapes.hemisphere(800, angle=angle)
    assert np.allclose(np.linalg.norm(shape.points, axis=1), 1, rtol=0, atol=1e-14)
    assert np.allclose(shape.points[shape.boundary, 2], cos(radians(angle)), rtol=0, atol=1e-14)
    assert shape.points[:, 2].min() >= cos(radians(angle)) - 1e-14
    assert np.all(np.sum(normals_of(shape) * shape.points[shape.triangles[:, 0]], axis=1) > 0)


@pytest.mark.parametrize("angle", [30, 90, 150])
def test_the_cap_is_evenly_covered(angle):
    lengths = edge_lengths(shapes.hemisphere(2000, angle=angle))
    assert lengths.max() / lengths.min() < 3.5


def test_the_area_of_the_sphere_is_approached_at_second_order():
    counts = np.array([500, 2000, 8000])
    areas = [np.linalg.norm(normals_of(shapes.sphere(n)), axis=1).sum() / 2 for n in counts]
    rate = np.polyfit(np.log(counts**-0.5), np.log(4 * pi - np.array(areas)), 1)[0]
    assert rate == pytest.approx(2, abs=0.1)


def test_the_normals_of_closed_surfaces_point_outwards():
    ball, ring = shapes.sphere(300), shapes.torus()
    for shape in (ball, ring):
        a, b, c = shape.points[shape.triangles.T]
        assert np.sum(a * np.cross(b, c)) / 6 > 0
    assert np.allclose(np.linalg.norm(ball.points, axis=1), 1, rtol=0, atol=1e-14)
    assert np.all(np.sum(normals_of(ball) * ball.points[ball.triangles[:, 0]], axis=1) > 0)


def test_the_torus_keeps_its_distance_from_the_circle():
    x, y, z = shapes.torus(tube_radius=0.2).points.T
    assert np.allclose(np.hypot(np.hypot(x, y) - 1, z), 0.2, rtol=0, atol=1e-14)


@pytest.mark.parametrize("length", [0.5, 5, 35])
def test_the_tube_has_radius_one_and_a_round_end(length):
    shape = shapes.tube(length, n_around=24)
    x, y, z = shape.points.T
    above = z > length
    assert np.allclose(np.hypot(x, y)[~above], 1, rtol=0, atol=1e-14)
    assert np.allclose(np.hypot(np.hypot(x, y), z - length)[above], 1, rtol=0, atol=1e-13)
    assert np.allclose(z[shape.boundary], 0, rtol=0, atol=1e-13)
    lengths = edge_lengths(shape)
    assert lengths.max() / lengths.min() < 3.5
    outward = np.c_[x, y, np.maximum(z - length, 0)][shape.triangles[:, 0]]
    assert np.all(np.sum(normals_of(shape) * outward, axis=1) > 0)


@pytest.mark.parametrize("angle", [90, 180, 270])
def test_the_bent_sheet_is_rolled_around_a_cylinder(angle):
    shape = shapes.bent_sheet(angle, nx=41, ny=5)
    x, _, z = shape.points.T
    radius = 40 / radians(angle)
    assert np.allclose(np.hypot(x, z), radius)
    assert np.ptp(x[:41]) == pytest.approx(2 * radius * (sin(radians(angle / 2)) if angle < 180 else 1), rel=1e-3)
    assert np.all(np.sum(normals_of(shape)[:, [0, 2]] * np.c_[x, z][shape.triangles[:, 0]], axis=1) > 0)


@pytest.mark.parametrize("gap", [2, 3, 8])
def test_the_sheets_of_the_fold_keep_their_gap(gap):
    shape = shapes.fold(gap, nx=61, ny=5)
    x, _, z = shape.points.T
    sheets = x < 0
    assert np.array_equal(np.abs(z[sheets]), np.full(sheets.sum(), gap / 2))
    assert np.allclose(np.hypot(x, z)[~sheets], gap / 2)
    steps = np.linalg.norm(np.diff(shape.points.reshape(5, 61, 3), axis=1), axis=2)
    assert steps.max() == pytest.approx(1)
    outward = np.c_[np.maximum(x, 0), z][shape.triangles[:, 0]]
    assert np.all(np.sum(normals_of(shape)[:, [0, 2]] * outward, axis=1) > 0)


@given(seed=st.integers(0, 99))
@settings(max_examples=10, deadline=None)
def test_the_relief_is_a_height_field(seed):
    shape = shapes.relief(300, seed=seed)
    assert normals_of(shape)[:, 2].min() > 0
    assert np.array_equal(shape.points[:, :2], shape.uv)


@pytest.mark.parametrize("make", SEEDED.values(), ids=SEEDED)
def test_the_seed_alone_decides_the_result(make):
    first, again, other = make(1), make(1), make(2)
    assert np.array_equal(first.points, again.points)
    assert np.array_equal(first.triangles, again.triangles)
    assert not np.array_equal(first.points, other.points)


def test_noise_has_the_size_asked_for():
    flat = shapes.grid(100, 100)
    noise = shapes.add_noise(flat, sigma_in_spacings=0.3, seed=4).points - flat.points
    assert np.allclose(noise.std(axis=0), 0.3, rtol=0.03)
    assert np.allclose(noise.mean(axis=0), 0, atol=0.01)


def test_noise_scales_with_the_shape():
    flat = shapes.grid(9, 9)
    large = Shape(1000 * flat.points, flat.triangles, flat.uv)
    assert np.allclose(shapes.add_noise(large).points, 1000 * shapes.add_noise(flat).points)


def test_thinning_divides_the_density_by_the_ratio():
    shape = shapes.thin(shapes.grid(300, 300), ratio=16)
    share = np.histogram(shape.uv[:, 0], bins=10, range=(-0.5, 299.5))[0] / 9000
    expected = 16 ** -((np.arange(10) + 0.5) / 10)
    assert np.allclose(share, expected, rtol=0.1)


def test_thinning_keeps_the_points_as_they_are():
    flat = shapes.disc(1000)
    before = {tuple(point) for point in flat.points.tolist()}
    assert {tuple(point) for point in shapes.thin(flat).points.tolist()} < before


@pytest.mark.parametrize("angle", [30, 180, 350])
def test_rolling_is_an_isometry(angle):
    flat = shapes.disc(1000)
    rolled = shapes.roll(flat, angle)
    radius = np.ptp(flat.points[:, 0]) / radians(angle)
    assert np.allclose(np.hypot(rolled.points[:, 0], rolled.points[:, 2]), radius)
    assert np.array_equal(rolled.points[:, 1], flat.points[:, 1])
    assert np.array_equal(rolled.triangles, flat.triangles)
    # A chord of a cylinder is shorter than its arc by a share of (arc / radius)^2 / 24 at most.
    flat_lengths, lengths = edge_lengths(flat), edge_lengths(rolled)
    assert (lengths <= flat_lengths * (1 + 1e-12)).all()
    assert (lengths >= flat_lengths * (1 - (flat_lengths / radius) ** 2 / 24 - 1e-12)).all()


def test_a_bent_sheet_is_a_grid_rolled_up():
    rolled, bent = shapes.roll(shapes.grid(21, 9), 200), shapes.bent_sheet(200, nx=21, ny=9)
    assert np.array_equal(rolled.points, bent.points)


@pytest.mark.parametrize("height", [0.1, 0.5])
def test_bumps_move_points_up_and_down_only_and_in_proportion(height):
    flat = shapes.dumbbell(500)
    low, high = shapes.raise_bumps(flat, height=height, seed=3), shapes.raise_bumps(flat, height=2 * height, seed=3)
    assert np.array_equal(low.points[:, :2], flat.points[:, :2])
    assert np.allclose(2 * low.points[:, 2], high.points[:, 2])
    assert np.ptp(low.points[:, 2]) > 0


@pytest.mark.parametrize("n", [1000, 3000])
@pytest.mark.parametrize("neck", [2, 5, 8])
def test_the_neck_of_a_dumbbell_has_the_width_asked_for_and_its_lobes_the_rest(n, neck):
    flat = shapes.dumbbell(n, neck=neck)
    x, y, z = flat.points.T
    assert len(flat.points) == pytest.approx(n, rel=0.12)
    assert np.array_equal(z, np.zeros(len(z)))
    assert np.ptp(y[np.abs(x) < 0.15]) == pytest.approx(neck * flat.spacing, abs=0.7 * flat.spacing)
    away = np.hypot(np.abs(x) - 0.6, y)
    assert (away <= 0.4)[np.abs(x) > 0.6].all()
    assert 1 - flat.spacing < np.abs(x).max() <= 1


def test_grading_by_one_changes_nothing():
    flat = shapes.disc(200)
    assert np.array_equal(shapes.grade(flat, ratio=1).points, flat.points)


@pytest.mark.parametrize("ratio", [4, 10, 40])
def test_grading_maps_the_disc_to_itself_by_a_conformal_map_with_densities_of_that_ratio(ratio):
    flat = shapes.disc(4000, jitter=0)
    graded = shapes.grade(flat, ratio=ratio)
    norm = np.linalg.norm(graded.points, axis=1)
    assert np.allclose(norm[flat.boundary], 1)
    assert norm.max() < 1 + 1e-12
    before, after = signed_areas(flat.uv, flat.triangles), signed_areas(graded.points[:, :2], flat.triangles)
    shrunk = after / before
    x = graded.points[flat.triangles, 0].mean(axis=1)
    assert shrunk[x.argmin()] / shrunk[x.argmax()] == pytest.approx(ratio, rel=0.1)
    # Conformal: all edges of a small triangle change alike.
    a, b, c = flat.points[flat.triangles].transpose(1, 0, 2)
    d, e, f = graded.points[flat.triangles].transpose(1, 0, 2)
    lengths = [
        np.linalg.norm(p - q, axis=1) / np.linalg.norm(r - s, axis=1) for p, q, r, s in ((d, e, a, b), (e, f, b, c))
    ]
    assert np.allclose(lengths[0], lengths[1], rtol=0.1)


@pytest.mark.parametrize("n_gaps", [1, 3])
@pytest.mark.parametrize("make", PIERCED.values(), ids=PIERCED)
def test_every_gap_is_a_loop_and_takes_one_from_the_euler_characteristic(make, n_gaps):
    whole, scan = make(0), make(n_gaps)
    assert len(scan.loops) == len(whole.loops) + n_gaps
    assert euler_characteristic(scan) == euler_characteristic(whole) - n_gaps
    assert has_one_fan_a_point(scan)
    assert len(np.unique(scan.triangles)) == len(scan.points)
    if whole.loops:
        assert np.array_equal(scan.points[scan.boundary], whole.points[whole.boundary])


@pytest.mark.parametrize("radius", [3, 4, 6])
def test_a_gap_is_a_ball_without_points_and_all_other_points_stay_in_order(radius):
    whole = shapes.disc(3000, seed=1)
    scan = shapes.pierce(whole, n_gaps=1, radius_in_spacings=radius, seed=1)
    far, kept = cKDTree(scan.points).query(whole.points)
    gone = whole.points[far > 0]
    middle = gone[np.argmin(np.linalg.norm(gone - gone.mean(axis=0), axis=1))]
    reach = np.linalg.norm(gone - middle, axis=1).max()
    assert reach == pytest.approx(radius * whole.spacing, rel=0.25)
    assert np.array_equal(kept[far == 0], np.arange(len(scan.points)))
    left = np.linalg.norm(scan.points - middle, axis=1)
    assert left.min() > reach - whole.spacing


def test_gaps_keep_two_radii_from_each_other_and_one_from_the_boundary():
    whole = shapes.disc(4000, seed=2)
    scan = shapes.pierce(whole, n_gaps=8, radius_in_spacings=4, seed=2)
    radius = 4 * whole.spacing
    outer, *gaps = (cKDTree(scan.points[loop]) for loop in scan.loops)
    assert len(gaps) > 5
    for k, gap in enumerate(gaps):
        assert gap.query(outer.data)[0].min() > 0.5 * radius
        assert all(gap.query(other.data)[0].min() > radius for other in gaps[:k])


def test_there_are_fewer_gaps_where_there_is_no_room():
    assert len(shapes.pierce(shapes.disc(500), n_gaps=99, radius_in_spacings=6).loops) < 10
    assert len(shapes.pierce(shapes.disc(100), radius_in_spacings=50).loops) == 1


def test_shuffling_is_a_renumbering():
    shape = shapes.relief(200)
    mixed = shapes.shuffle(shape, seed=3)
    order = cKDTree(shape.points).query(mixed.points)[1]
    assert np.array_equal(np.sort(order), np.arange(200))
    assert np.array_equal(shape.uv[order], mixed.uv)
    assert np.array_equal(order[mixed.triangles], shape.triangles)
    assert not np.array_equal(order, np.arange(200))


def test_the_scan_has_the_spacings_asked_for():
    def plane(s, t):
        return np.stack([s, t, 0 * s], axis=-1)

    shape = shapes.laser_scan(plane, lines=50, anisotropy=2, jitter=0, unevenness=4, noise=0)
    lines = np.unique(shape.points[:, 1])
    assert np.allclose(np.diff(lines), 1 / 50)
    middle = np.sort(shape.points[shape.points[:, 1] == lines[25], 0])
    steps, places = np.diff(middle), (middle[1:] + middle[:-1]) / 2
    assert np.allclose(steps, 4 ** ((2 * places - 1) ** 2 / 2) / 100, rtol=0.01)


def test_range_noise_lies_along_the_view():
    def plane(s, t):
        return np.stack([s, t, 0 * s], axis=-1)

    options = {"lines": 100, "seed": 5, "view": (0, 3, 4)}
    clean, noisy = (shapes.laser_scan(plane, noise=noise, **options) for noise in (0, 0.1))
    error = noisy.points - clean.points
    assert np.allclose(np.cross(error, [0, 3, 4]), 0, atol=1e-15)
    assert np.linalg.norm(error, axis=1).std() > 0
    assert (error @ [0, 0.6, 0.8]).std() == pytest.approx(0.1 / 100, rel=0.05)


def test_the_sculpture_is_seen_whole_from_nowhere():
    normals = point_normals(shapes.sculpture(4000))
    directions = shapes.sphere(1000).points
    assert (normals @ directions.T).min(axis=0).max() < -0.2


@pytest.mark.parametrize("place", [(0, -0.26), (0.85, 0), (-0.85, 0)], ids=["nose", "left side", "right side"])
def test_the_sculpture_overhangs(place):
    face = shapes.sculpture(20_000)
    near = np.linalg.norm(face.points[:, :2] - place, axis=1) < 0.2
    assert point_normals(face)[near, 2].min() < -0.05


@pytest.mark.parametrize("n", [1000, 5000, 20_000])
def test_the_sculpture_has_about_the_number_of_points_asked_for(n):
    assert len(shapes.sculpture(n).points) == pytest.approx(n, rel=0.05)


def test_the_demo_scan_has_about_twenty_thousand_points(scan):
    assert len(scan.points) == pytest.approx(20_000, rel=0.03)


def test_the_edges_of_the_demo_scan_are_short(scan):
    lengths = edge_lengths(scan) / scan.spacing
    assert lengths.min() > 0.2
    assert np.quantile(lengths, 0.99) < 2
    assert lengths.max() < 5


def test_sheets_of_the_demo_scan_stay_three_spacings_apart(scan):
    normals = point_normals(scan)
    i, j = cKDTree(scan.points).query_pairs(3 * scan.spacing, output_type="ndarray").T
    assert np.sum(normals[i] * normals[j], axis=1).min() > -0.3


def test_the_outline_of_the_demo_scan_is_ragged(scan):
    assert len(scan.triangles) < len(delaunay(scan.uv))
    edge = np.diff(scan.uv[np.r_[scan.boundary, scan.boundary[:1]]], axis=0)
    turn = edge[:, 0] * np.roll(edge[:, 1], -1) - edge[:, 1] * np.roll(edge[:, 0], -1)
    assert 0.2 < np.mean(turn < 0) < 0.6


@given(seed=st.integers(0, 999), limit=st.floats(1, 5))
@settings(max_examples=50, deadline=None)
def test_peeling_leaves_a_disc_with_every_point(seed, limit):
    uv = np.random.default_rng(seed).random((60, 2))
    shape = Shape(np.c_[uv, np.zeros(60)], ragged_delaunay(uv, limit=limit), uv)
    assert euler_characteristic(shape) == 1
    assert has_one_fan_a_point(shape)
    assert len(np.unique(shape.triangles)) == 60
    assert len(shape.loops) == 1


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: shapes.grid(1, 5), "1 by 5 points has no triangle"),
        (lambda: shapes.disc(7), "7 points are too few"),
        (lambda: shapes.hemisphere(100, angle=175), "175 degrees"),
        (lambda: shapes.tube(0), "length 0 radii"),
        (lambda: shapes.tube(1, n_around=7), "7 points around"),
        (lambda: shapes.bent_sheet(360), "360 degrees"),
        (lambda: shapes.roll(shapes.disc(50), 0), "roll of 0 degrees is flat or meets itself"),
        (lambda: shapes.roll(shapes.disc(50), 360), "roll of 360 degrees"),
        (lambda: shapes.fold(40), "gap of 40 spacings"),
        (lambda: shapes.dumbbell(99), "dumbbell of 99 points"),
        (lambda: shapes.dumbbell(500, neck=1.9), "a neck of 1.9 spacings is 0.09 wide"),
        (lambda: shapes.dumbbell(500, neck=30), "neck of 30 spacings"),
        (lambda: shapes.annulus(2, 5), "2 by 5 points, around and across, are too few for an annulus"),
        (lambda: shapes.annulus(inner_radius=1), "inner radius of 1"),
        (lambda: shapes.moebius(width=2), "width of 2"),
        (lambda: shapes.sphere(3), "3 points are too few"),
        (lambda: shapes.torus(9, 2), "9 by 2 points, .* at least 3 by 3"),
        (lambda: shapes.torus(tube_radius=1), "tube of radius 1"),
        (lambda: shapes.thin(shapes.grid(3, 3), ratio=0.5), "density ratio of 0.5"),
        (lambda: shapes.thin(shapes.grid(2, 2), ratio=1e9), "thinning by 1000000000.0 leaves 2 of 4"),
        (lambda: shapes.laser_scan(shapes.sculpted_face, lines=3), "scan of 3 lines"),
        (lambda: shapes.sculpture(100), "100 points do not show"),
    ],
)
def test_an_error_names_the_number(make, message):
    with pytest.raises(InputError, match=message):
        make()
