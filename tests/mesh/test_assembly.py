import numpy as np
import pytest
from comparisons import as_set, mixed
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import planar_discs, rotations, seeds

from pointchart import shapes
from pointchart.agreement.agreed_surface import patchwork
from pointchart.boundary import perimeter
from pointchart.mesh.assembly import assemble
from pointchart.mesh.connectivity import half_edges
from pointchart.plane.exact_signs import orientation_signs
from pointchart.proof.certificate import certify

BENDS = {
    "flat": lambda uv: np.c_[uv, 0 * uv[:, 0]],
    "bowl": lambda uv: np.c_[uv, (uv**2).sum(axis=1)],
    "roof": lambda uv: np.c_[uv, np.abs(uv[:, 0])],
    "rolled": lambda uv: np.c_[np.cos(2 * uv[:, 0]), uv[:, 1], np.sin(2 * uv[:, 0])],
}


def steps_of(loop):
    return set(zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))


def oriented(triangles):
    turn = np.argmin(triangles, axis=1)[:, None]
    return set(map(tuple, np.take_along_axis(triangles, (turn + np.arange(3)) % 3, axis=1).tolist()))


def is_inner(shape):
    """Tell which triangles have no edge on the boundary."""
    steps = {frozenset(step) for loop in shape.loops for step in steps_of(loop)}
    return np.array([not any(face - {v} in steps for v in face) for face in map(frozenset, shape.triangles.tolist())])


def some_missing(shape, share, rng):
    """Tell which triangles are kept when inner ones go missing, few enough that the others hang together.

    Whatever would be cut off gets the triangles around it back.
    """
    kept, n = ~is_inner(shape) | (rng.random(len(shape.triangles)) >= share), len(shape.points)
    while True:
        surface = patchwork(shape.triangles[kept], n)
        is_cut_off = ~np.isin(np.arange(n), surface.triangles[surface.largest])
        is_cut_off[surface.triangles[~surface.largest]] = True
        if not is_cut_off.any():
            return kept
        kept |= is_cut_off[shape.triangles].any(axis=1)


def assert_is_disc(points, found, loop):
    """Check that a disc on all points was found, whose boundary runs along the loop."""
    assert found is not None
    proof = certify(points, found.triangles, loop=loop)
    assert proof.faults == ()
    edges = half_edges(found.triangles, len(points))
    is_rim = edges.twins < 0
    assert set(zip(edges.origins[is_rim].tolist(), edges.targets[is_rim].tolist(), strict=True)) == steps_of(loop)
    return proof


def assembled(shape, kept, loop, seed=0):
    """Assemble some triangles of a shape, shuffled and of mixed orientation."""
    surface = patchwork(mixed(shape.triangles[kept], np.random.default_rng(seed)), len(shape.points))
    return assemble(shape.points, surface, loop)


# Discs


@given(planar_discs(), seeds, st.booleans())
@settings(max_examples=30)
def test_a_complete_disc_stays_as_it_is_in_the_direction_of_the_loop(shape, seed, is_reversed):
    loop, triangles = shape.boundary, shape.triangles
    if is_reversed:
        loop, triangles = loop[::-1], triangles[:, ::-1]
    found = assembled(shape, np.full(len(triangles), True), loop, seed)
    assert found.n_pockets == 0
    assert oriented(found.triangles) == oriented(triangles)


@pytest.mark.parametrize("bend", BENDS)
@given(planar_discs(), seeds, st.floats(0, 0.5), st.booleans())
@settings(max_examples=30)
def test_a_disc_without_some_inner_triangles_is_closed_again(bend, shape, seed, share, is_reversed):
    bent = shapes.Shape(BENDS[bend](shape.uv), shape.triangles, shape.uv)
    kept = some_missing(bent, share, np.random.default_rng(seed))
    loop = bent.boundary[::-1] if is_reversed else bent.boundary
    assert_is_disc(bent.points, assembled(bent, kept, loop, seed), loop)


@pytest.mark.parametrize("share", [0.05, 0.2, 0.4])
def test_shapes_without_some_inner_triangles_are_closed_again(any_disc, share):
    kept = some_missing(any_disc, share, np.random.default_rng(1))
    assert not kept.all()
    assert_is_disc(any_disc.points, assembled(any_disc, kept, any_disc.boundary), any_disc.boundary)


@given(planar_discs(smallest=60), seeds)
@settings(max_examples=30)
def test_single_triangles_that_are_missing_come_back(shape, seed):
    kept, is_near = np.full(len(shape.triangles), True), np.full(len(shape.points), False)
    for t in np.random.default_rng(seed).permutation(np.flatnonzero(is_inner(shape))):
        kept[t] = is_near[shape.triangles[t]].any()
        is_near[shape.triangles[t]] = True
    found = assembled(shape, kept, shape.boundary, seed)
    assert found.n_pockets == (~kept).sum() > 0
    assert oriented(found.triangles) == oriented(shape.triangles)


@given(planar_discs(smallest=60), seeds, rotations(), st.integers(-30, 30))
@settings(max_examples=20)
def test_the_disc_does_not_depend_on_pose_scale_and_the_beginning_of_the_loop(shape, seed, rotation, exponent):
    kept = some_missing(shape, 0.2, np.random.default_rng(seed))
    one = assembled(shape, kept, shape.boundary)
    moved = shapes.Shape(2.0**exponent * (shape.points @ rotation.T), shape.triangles, shape.uv)
    other = assembled(moved, kept, np.roll(shape.boundary, 3))
    assert oriented(one.triangles) == oriented(other.triangles)


# Pockets


@given(planar_discs(), seeds)
@settings(max_examples=30)
def test_an_ear_never_doubles_an_edge(shape, seed):
    # A point inside a triangle, all but at one of its edges, has three triangles: without two of them the shorter
    # diagonal of the pocket is that edge.
    rng, n = np.random.default_rng(seed), len(shape.points)
    a, b, c = rng.permutation(rng.choice(shape.triangles[is_inner(shape)]))
    points = np.r_[shape.points, [[0.45, 0.45, 0.1] @ shape.points[[a, b, c]]]]
    left = shape.triangles[as_rows(shape.triangles) != frozenset((a, b, c))]
    surface = patchwork(mixed(np.r_[left, [[a, b, n]]], rng), n + 1)
    found = assemble(points, surface, shape.boundary)
    assert_is_disc(points, found, shape.boundary)
    assert as_set(found.triangles) == as_set(np.r_[left, [[a, b, n], [b, c, n], [c, a, n]]])


def as_rows(triangles):
    rows = np.empty(len(triangles), object)
    rows[:] = list(map(frozenset, triangles.tolist()))
    return rows


@pytest.mark.parametrize("bend", BENDS)
@pytest.mark.parametrize("waves", [0, 5])
def test_a_pocket_of_two_hundred_points_is_closed_without_folds(bend, waves):
    ring = shapes.annulus(200, 12, inner_radius=0.6)
    radius, turn = np.linalg.norm(ring.uv, axis=1), np.arctan2(ring.uv[:, 1], ring.uv[:, 0])
    uv = ring.uv * (1 - 0.05 * (1 - radius) * np.sin(waves * turn))[:, None]
    outer, inner = sorted(ring.loops, key=lambda loop: radius[loop].min(), reverse=True)
    points = BENDS[bend](uv)
    surface = patchwork(mixed(ring.triangles, np.random.default_rng(1)), len(points))
    found = assemble(points, surface, outer)
    proof = assert_is_disc(points, found, outer)
    assert found.n_pockets == 1
    assert len(found.triangles) == len(ring.triangles) + len(inner) - 2
    assert proof.folds == 0
    if bend == "flat":
        assert abs(orientation_signs(uv, found.triangles).sum()) == len(found.triangles)


@pytest.mark.parametrize("angle", [30, 90, 180])
def test_a_large_gap_of_a_bent_sheet_is_closed_without_folds(angle):
    sheet = shapes.bent_sheet(angle, nx=81, ny=81)
    is_far = np.linalg.norm(sheet.uv - 40, axis=1) > 32
    triangles = (np.cumsum(is_far) - 1)[sheet.triangles[is_far[sheet.triangles].all(axis=1)]]
    scan = shapes.Shape(sheet.points[is_far], triangles, sheet.uv[is_far])
    outer, gap = sorted(scan.loops, key=lambda loop: np.ptp(scan.uv[loop, 0]), reverse=True)
    assert len(gap) > 180
    proof = assert_is_disc(scan.points, assembled(scan, slice(None), outer), outer)
    assert proof.folds == 0


def test_of_two_boundaries_the_one_that_is_not_asked_for_is_closed():
    ring = shapes.annulus(30, 5)
    inner, outer = sorted(ring.loops, key=lambda loop: perimeter(ring.points, loop))
    found = assembled(ring, slice(None), outer)
    assert_is_disc(ring.points, found, outer)
    assert found.n_pockets == 1
    # Closed from outside, the flat ring would lie under its own cap.
    assert assembled(ring, slice(None), inner) is None


# Pinches


SHEET = shapes.grid(9, 9)


def without_cells(*cells):
    """Tell which triangles of the sheet lie in none of some cells."""
    middle = np.floor(SHEET.uv[SHEET.triangles].mean(axis=1))
    return ~(middle[:, None] == np.array(cells)).all(axis=2).any(axis=1)


def with_flap(kept, *flaps):
    """Assemble some triangles of the sheet together with further ones, given by their places."""
    corners = [[9 * y + x for x, y in flap] for flap in flaps]
    surface = patchwork(mixed(np.r_[SHEET.triangles[kept], corners], np.random.default_rng(2)), 81)
    assert len(surface.triangles) == kept.sum() + len(flaps)
    return assemble(SHEET.points, surface, SHEET.boundary)


def test_pockets_that_touch_in_a_point_are_closed_each():
    kept = without_cells((3, 3), (4, 4))
    found = assembled(SHEET, kept, SHEET.boundary)
    assert_is_disc(SHEET.points, found, SHEET.boundary)
    assert found.n_pockets == 2


def test_points_on_an_island_are_not_lost():
    around = [(2, 3), (3, 2), (3, 4), (4, 3), (2, 2), (4, 4), (2, 4), (4, 2)]
    assert assembled(SHEET, without_cells(*around), SHEET.boundary) is None


FLAPS = {
    "an inner point": ((6, 6),),
    "a boundary point": ((8, 4),),
    "the rim of another pocket": ((6, 2),),
    "the rim of its own pocket": ((5, 4),),
    "two inner points": ((6, 6), (7, 5)),
}


@pytest.mark.parametrize("name", FLAPS)
def test_a_flap_that_touches_the_surface_in_a_point_is_cleared_away(name):
    kept = without_cells((2, 3), (3, 3), (4, 3), (5, 1), (6, 1))
    # Flaps hang on the edge of the first pocket from (3, 3) to (4, 3), one on the other.
    ends, flaps = ((3, 3), (4, 3)), []
    for tip in FLAPS[name]:
        flaps.append((*ends, tip))
        ends = (ends[1], tip)
    found = with_flap(kept, *flaps)
    assert_is_disc(SHEET.points, found, SHEET.boundary)
    corners = {frozenset(9 * y + x for x, y in flap) for flap in flaps}
    assert name == "the rim of its own pocket" or not corners & as_set(found.triangles)


def test_a_band_between_two_pockets_is_a_handle_and_no_disc():
    kept = without_cells((2, 3), (3, 3), (5, 3), (6, 3))
    band = [((2, 3), (3, 3), (6, 3)), ((2, 3), (6, 3), (7, 3))]
    assert with_flap(kept, *band) is None


# What is no disc


@pytest.mark.parametrize("seed", range(3))
def test_a_torus_with_a_hole_is_no_disc(seed):
    scan = shapes.pierce(shapes.torus(48, 20), n_gaps=1, radius_in_spacings=3, seed=seed)
    assert assembled(scan, slice(None), scan.boundary) is None


@pytest.mark.parametrize("seed", range(3))
def test_a_moebius_strip_is_no_disc(seed):
    strip = shapes.moebius(30, 5)
    assert assembled(strip, slice(None), strip.boundary, seed) is None


@given(planar_discs(smallest=60), seeds)
@settings(max_examples=20)
def test_a_loop_that_is_no_rim_is_not_given(shape, seed):
    rng, b = np.random.default_rng(seed), shape.boundary
    inner = np.setdiff1d(np.arange(len(shape.points)), b)
    k = int(rng.integers(1, len(b) - 1))
    for loop in (np.delete(b, k), np.insert(b, k, rng.choice(inner)), rng.permutation(inner)[:5]):
        assert assembled(shape, slice(None), loop, seed) is None
    crossed = b.copy()
    crossed[[k, k - 1]] = crossed[[k - 1, k]]
    assert assembled(shape, slice(None), crossed, seed) is None


@given(planar_discs(smallest=60), seeds)
@settings(max_examples=10)
def test_a_point_in_no_triangle_is_not_lost(shape, seed):
    inner = np.setdiff1d(np.arange(len(shape.points)), shape.boundary)
    lost = np.random.default_rng(seed).choice(inner)
    assert assembled(shape, (shape.triangles != lost).all(axis=1), shape.boundary, seed) is None
    surface = patchwork(shape.triangles, len(shape.points) + 1)
    assert assemble(np.r_[shape.points, [[0, 0, 9]]], surface, shape.boundary) is None


def test_two_surfaces_or_none_are_no_disc():
    shape = shapes.disc(60)
    both = patchwork(np.r_[shape.triangles, shape.triangles + 60], 120)
    assert assemble(np.r_[shape.points, shape.points + 9], both, shape.boundary) is None
    assert assemble(shape.points, patchwork([], 60), shape.boundary) is None
