import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import flat, rotations, seeds

from pointchart import shapes
from pointchart.boundary.layout import on_circle, on_square
from pointchart.errors import InputError
from pointchart.map.convex_combination import parameterize
from pointchart.mesh.connectivity import one_rings
from pointchart.proof.certificate import certify
from pointchart.shapes import disc

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
TWO = [[0, 1, 2], [0, 2, 3]]


def faults(points, triangles, **options):
    return certify(points, triangles, **options).faults


def test_every_simulated_disc_is_a_disc_with_its_boundary(any_disc):
    certificate = certify(any_disc.points, any_disc.triangles, loop=any_disc.boundary)
    assert certificate.is_disc
    assert certificate.faults == ()
    assert certificate.boundary_as_given is True
    assert (certificate.euler, certificate.boundary_loops, certificate.folds) == (1, 1, 0)
    assert certificate.n_triangles == 2 * certificate.n_points - 2 - len(any_disc.boundary)


def test_real_scans_are_discs(scan):
    foot = scan("foot")
    certificate = certify(foot.points, foot.triangles, loop=foot.loop)
    assert certificate.is_disc
    assert certificate.n_points == 10010


@pytest.mark.parametrize("turn", [0, 7])
@pytest.mark.parametrize("way", [1, -1])
def test_where_the_boundary_starts_and_which_way_it_runs_does_not_matter(turn, way):
    shape = disc(100)
    asked = np.roll(shape.boundary, turn)[::way]
    assert certify(shape.points, shape.triangles, loop=asked).boundary_as_given is True
    assert certify(shape.points, shape.triangles, loop=np.r_[asked, asked[:1]]).boundary_as_given is True


def test_another_boundary_is_noticed():
    shape = disc(100)
    loop = shape.boundary
    exchanged = np.r_[loop[1], loop[0], loop[2:]]
    inner = np.setdiff1d(np.arange(100), loop)[0]
    for other in (loop[:-1], exchanged, np.r_[loop[:-1], inner], np.r_[inner, loop[1:]], np.r_[loop, inner]):
        certificate = certify(shape.points, shape.triangles, loop=other)
        assert certificate.boundary_as_given is False
        assert certificate.faults == ("its boundary is not the loop given",)


def test_unused_points_are_counted():
    points = np.r_[SQUARE, [[5, 5, 5], [6, 6, 6]]]
    certificate = certify(points, TWO)
    assert certificate.unused_points == 2
    assert certificate.faults == ("2 points are in no triangle",)
    assert certificate.euler == 1


def test_a_pinched_point_is_counted():
    points = np.r_[SQUARE, SQUARE[:2] - [0, 2, 0]]
    triangles = [[0, 2, 3], [0, 4, 5]]
    certificate = certify(points[[0, 1, 2, 3, 4, 5]], triangles)
    assert certificate.pinched_points == 1
    assert "1 points have several fans of triangles" in certificate.faults


def test_an_edge_with_three_triangles_is_counted():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]])
    certificate = certify(points, [[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    assert certificate.overfull_edges == 1
    assert certificate.euler == 5 - 7 + 3
    assert any("1 edges have more than two triangles or turn over" in fault for fault in certificate.faults)


def test_a_triangle_that_is_turned_over_is_noticed():
    shape = disc(60)
    triangles = shape.triangles.copy()
    inner = np.flatnonzero(~np.isin(triangles, shape.boundary).any(axis=1))[0]
    triangles[inner] = triangles[inner, ::-1]
    assert any(
        "3 edges have more than two triangles or turn over" in fault for fault in faults(shape.points, triangles)
    )


def test_a_triangle_twice_is_noticed():
    assert not certify(SQUARE, [*TWO, [0, 1, 2]]).is_disc
    assert not certify(SQUARE, [*TWO, [0, 2, 1]]).is_disc


@pytest.mark.parametrize(
    ("shape", "messages"),
    [
        (shapes.annulus(20, 4), ["its Euler characteristic is 0 instead of 1", "it has 2 boundary loops instead of 1"]),
        (shapes.sphere(100), ["its Euler characteristic is 2 instead of 1", "it has 0 boundary loops instead of 1"]),
        (shapes.torus(12, 8), ["its Euler characteristic is 0 instead of 1", "it has 0 boundary loops instead of 1"]),
        (
            shapes.moebius(20, 4),
            ["its Euler characteristic is 0 instead of 1", "3 edges have more than two triangles or"],
        ),
    ],
)
def test_surfaces_that_are_no_discs_are_told_apart(shape, messages):
    found = faults(shape.points, shape.triangles)
    assert all(any(message in fault for fault in found) for message in messages)


def test_two_discs_are_not_one():
    points = np.r_[SQUARE, SQUARE + 5]
    found = faults(points, [*TWO, [4, 5, 6], [4, 6, 7]])
    assert found == (
        "it has 2 parts instead of 1",
        "its Euler characteristic is 2 instead of 1",
        "it has 2 boundary loops instead of 1",
    )


def test_a_disc_and_a_torus_are_not_one_disc_though_their_euler_characteristic_is_one():
    part, whole = shapes.torus(12, 8), disc(60)
    points = np.r_[whole.points, part.points + 5]
    certificate = certify(points, np.r_[whole.triangles, part.triangles + 60])
    assert (certificate.euler, certificate.boundary_loops, certificate.parts) == (1, 1, 2)
    assert certificate.faults == ("it has 2 parts instead of 1",)


def test_no_triangles_are_no_disc():
    certificate = certify(SQUARE, [])
    assert "it has no triangles" in certificate.faults
    assert "4 points are in no triangle" in certificate.faults
    assert certificate.longest_edge_over_spacing == 0


@settings(max_examples=20)
@given(seeds, st.floats(0, 6.3))
def test_planar_maps_are_one_to_one_and_stay_so_until_two_points_change_places(seed, turn):
    shape = disc(100, seed=seed % 1000)
    uv = shape.uv @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    assert certify(shape.points, shape.triangles, uv=uv).is_one_to_one
    i, j = np.random.default_rng(seed).permutation(100)[:2]
    uv[[i, j]] = uv[[j, i]]
    certificate = certify(shape.points, shape.triangles, uv=uv)
    assert certificate.flat_or_folded_uv > 0
    assert not certificate.is_one_to_one


@pytest.mark.parametrize(
    ("height", "is_flat"), [(0.0, True), (1e-17, False), (5e-324, False), (-1e-17, True), (-5e-324, True)]
)
def test_flat_and_folded_parameters_are_told_to_the_last_digit(height, is_flat):
    points = np.r_[SQUARE, [[0.5, 0.1, 0]]]
    triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    uv = np.r_[SQUARE[:, :2], [[0.5, height]]]
    certificate = certify(points, triangles, uv=uv)
    assert certificate.flat_or_folded_uv == int(is_flat)
    assert certificate.is_one_to_one is not is_flat
    assert certificate.is_disc


def test_points_with_the_same_parameters_are_counted():
    shape = disc(60)
    uv = shape.uv.copy()
    uv[4] = uv[9]
    certificate = certify(shape.points, shape.triangles, uv=uv)
    assert certificate.coinciding_uv == 2
    assert not certificate.is_one_to_one
    assert certificate.is_disc


def test_an_edge_between_two_points_of_one_side_of_the_square_goes_flat_and_is_noticed():
    # The one exception to the theorem: an inner edge whose ends lie on one side of the domain.
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.0], [0.3, 0.5]])
    triangles = np.array([[0, 4, 1], [0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 0, 5]])
    certificate = certify(flat(uv) + [0, 0, 1] * np.eye(6)[:, [4]], triangles, uv=uv, loop=[0, 4, 1, 2, 3])
    assert certificate.is_disc
    assert certificate.flat_or_folded_uv == 1


def test_what_was_not_asked_is_not_answered():
    certificate = certify(SQUARE, TWO)
    assert certificate.coinciding_uv is None
    assert certificate.flat_or_folded_uv is None
    assert certificate.boundary_as_given is None
    assert certificate.is_one_to_one is False


def test_a_bridge_over_a_gap_shows_as_a_long_edge():
    left, right = disc(100), disc(100)
    apart = np.r_[left.points, right.points + np.array([12, 0, 0])]
    bridge = [left.boundary[0], 100 + right.boundary[len(right.boundary) // 2], left.boundary[1]]
    triangles = np.r_[left.triangles, right.triangles + 100, [bridge]]
    assert certify(left.points, left.triangles).longest_edge_over_spacing < 2.5
    assert certify(apart, triangles).longest_edge_over_spacing > 10 / left.spacing / 2


@settings(max_examples=10)
@given(rotations(), st.floats(-9, 9))
def test_certificates_do_not_depend_on_place_and_size(rotation, exponent):
    shape = disc(80, seed=3)
    moved = 10.0**exponent * (shape.points @ rotation.T + 1)
    one, other = (certify(points, shape.triangles, loop=shape.boundary) for points in (shape.points, moved))
    assert np.isclose(one.longest_edge_over_spacing, other.longest_edge_over_spacing, rtol=1e-9)
    assert one.faults == other.faults


@pytest.mark.parametrize(("angle", "folds"), [(0, 0), (149, 0), (151, 1), (180, 1)])
def test_folds_are_edges_that_turn_by_more_than_150_degrees(angle, folds):
    turn = np.radians(angle)
    points = np.array([[0.0, 0, 0], [0, 1, 0], [-1, 0.5, 0], [np.cos(turn), 0.5, np.sin(turn)]])
    assert certify(points, [[0, 1, 2], [1, 0, 3]]).folds == folds


@pytest.mark.parametrize("layout", [on_circle, on_square])
def test_the_mean_value_map_of_a_disc_is_certified(any_disc, layout):
    rings = one_rings(any_disc.triangles, len(any_disc.points))
    uv = parameterize(any_disc.points, any_disc.boundary, layout(np.ones(len(any_disc.boundary))), rings).uv
    certificate = certify(any_disc.points, any_disc.triangles, uv=uv, loop=any_disc.boundary)
    assert certificate.is_disc
    on_one_side = uv[any_disc.boundary]
    is_flat = layout is on_square and has_chord_on_a_side(any_disc, on_one_side)
    assert certificate.is_one_to_one or is_flat


def has_chord_on_a_side(shape, rim):
    """Tell whether an inner edge joins two points of one side of the square."""
    place = {int(i): p for i, p in zip(shape.boundary, rim, strict=True)}
    neighbors = set(zip(shape.boundary.tolist(), np.roll(shape.boundary, -1).tolist(), strict=True))
    edges = shape.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()
    return any(
        a in place
        and b in place
        and (a, b) not in neighbors
        and (b, a) not in neighbors
        and any(place[a][k] == place[b][k] and place[a][k] in (0, 1) for k in range(2))
        for a, b in edges
    )


@pytest.mark.parametrize(
    ("triangles", "message"),
    [
        ([[0, 1, 4]], "triangles 0 name points that are not there; indices run from 0 to 3"),
        ([[0, 1, 2], [0, -1, 2]], "triangles 1 name points that are not there"),
        ([[0, 1, 1]], "triangles 0 name a point twice; remove them"),
        ([[0, 1, 2, 3]], r"triangles have shape \(1, 4\) and type int64; \(m, 3\) whole numbers are needed"),
        ([0, 1, 2], r"triangles have shape \(3,\)"),
    ],
)
def test_wrong_triangles_are_refused(triangles, message):
    with pytest.raises(InputError, match=message):
        certify(SQUARE, triangles)


def test_parameters_of_another_length_are_refused():
    with pytest.raises(InputError, match=r"uv has shape \(3, 2\); 4 points need \(4, 2\)"):
        certify(SQUARE, TWO, uv=np.ones((3, 2)))


def winding_fan(turns, n):
    """Return a fan around the origin that winds several times, as points, triangles and uv."""
    angle = np.linspace(0.0, 2.0 * np.pi * turns, n)
    rim = np.column_stack([np.cos(angle), np.sin(angle)]) * (1.0 + 0.01 * np.arange(n))[:, None]
    uv = np.vstack([[0.0, 0.0], rim])
    triangles = np.column_stack([np.zeros(n - 1, int), np.arange(1, n), np.arange(2, n + 1)])
    return np.column_stack([uv, np.arange(n + 1.0)]), triangles, uv


def test_positive_triangles_that_overlap_are_not_one_to_one():
    proof = certify(*winding_fan(1.7, 40)[:2], uv=winding_fan(1.7, 40)[2])
    assert proof.is_disc
    assert proof.flat_or_folded_uv == 0
    assert proof.simple_uv_boundary is False
    assert not proof.is_one_to_one


def test_a_simple_boundary_that_is_not_convex_is_one_to_one():
    points, triangles, uv = winding_fan(0.7, 20)
    assert certify(points, triangles, uv=uv).is_one_to_one


# Holes


@pytest.mark.parametrize("n_gaps", [1, 2, 3])
def test_a_disc_with_holes_is_as_asked_for_with_that_many_and_with_no_other_number(n_gaps):
    shape = shapes.pierce(disc(1500, seed=1), n_gaps=n_gaps, seed=1)
    for holes in range(5):
        proof = certify(shape.points, shape.triangles, uv=shape.uv, loop=shape.boundary, holes=holes)
        assert proof.is_as_asked == proof.is_one_to_one == (holes == n_gaps)
        assert not proof.is_disc
        assert (proof.euler, proof.boundary_loops, proof.holes) == (1 - n_gaps, 1 + n_gaps, holes)
        if holes != n_gaps:
            assert proof.faults == (
                f"its Euler characteristic is {1 - n_gaps} instead of {1 - holes}",
                f"it has {1 + n_gaps} boundary loops instead of {1 + holes}",
            )
            assert proof.simple_uv_boundary is None


def test_a_disc_without_holes_is_not_the_one_with_a_hole_that_was_asked_for(any_disc):
    proof = certify(any_disc.points, any_disc.triangles, holes=1)
    assert not proof.is_as_asked
    assert not proof.is_disc
    assert proof.faults == (
        "its Euler characteristic is 1 instead of 0",
        "it has 1 boundary loops instead of 2",
    )


def test_the_loop_asked_for_may_be_any_rim_but_no_mixture_of_two():
    ring = shapes.annulus(20, 4)
    inner, outer = ring.loops
    for loop in ring.loops:
        assert certify(ring.points, ring.triangles, loop=loop, holes=1).is_as_asked
    for loop in (np.r_[inner[:10], outer[10:]], outer[:-1]):
        found = certify(ring.points, ring.triangles, loop=loop, holes=1)
        assert found.faults == ("its boundary is not the loop given",)


def of_ring(uv_of_inner):
    """Certify an annulus whose inner rim is mapped as told and whose other points lie where they are."""
    ring = shapes.annulus(24, 4)
    uv = ring.uv.copy()
    on_inner = np.linalg.norm(uv, axis=1) < 0.51
    uv[on_inner] = uv_of_inner(uv[on_inner])
    return certify(ring.points, ring.triangles, uv=uv, holes=1)


def test_the_plane_itself_maps_a_ring_one_to_one():
    proof = of_ring(lambda uv: uv)
    assert proof.simple_uv_boundary is True
    assert proof.is_one_to_one


@pytest.mark.parametrize(
    "uv_of_inner",
    [lambda uv: uv * [-1, 1], lambda uv: uv[::-1], lambda uv: uv * [1, -0.5] + [0.2, 0]],
    ids=["mirrored", "in opposite order", "mirrored and moved"],
)
def test_a_hole_that_runs_anticlockwise_is_no_hole(uv_of_inner):
    proof = of_ring(uv_of_inner)
    assert proof.is_as_asked
    assert proof.simple_uv_boundary is False
    assert not proof.is_one_to_one


def test_a_hole_whose_rim_crosses_itself_is_noticed():
    exchanged = np.arange(24)
    exchanged[[3, 8]] = [8, 3]
    proof = of_ring(lambda uv: uv[exchanged])
    assert proof.is_as_asked
    assert proof.simple_uv_boundary is False
    assert not proof.is_one_to_one


def test_two_rims_that_both_run_clockwise_bound_nothing():
    ring = shapes.annulus(24, 4)
    uv = ring.uv * [-1, 1]
    on_inner = np.linalg.norm(uv, axis=1) < 0.51
    uv[on_inner] *= [-1, 1]
    assert certify(ring.points, ring.triangles, uv=uv, holes=1).simple_uv_boundary is False


def test_a_mirrored_ring_has_simple_rims_but_folded_triangles():
    ring = shapes.annulus(24, 4)
    proof = certify(ring.points, ring.triangles, uv=ring.uv * [-1, 1], holes=1)
    assert proof.simple_uv_boundary is True
    assert proof.flat_or_folded_uv == proof.n_triangles
    assert not proof.is_one_to_one


def test_a_ring_turned_inside_out_is_one_to_one_round_its_other_rim():
    ring = shapes.annulus(24, 4)
    square = (ring.uv**2).sum(axis=1, keepdims=True)
    proof = certify(ring.points, ring.triangles, uv=ring.uv / square * [-1, 1], holes=1)
    assert proof.is_one_to_one
