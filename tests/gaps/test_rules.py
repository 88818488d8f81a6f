import numpy as np
import pytest
from scipy.spatial import cKDTree

from pointchart import (
    Candidate,
    SolveError,
    bridge_gaps,
    certify,
    leave_gaps_open,
    reconstruct,
    refuse_second_boundary,
    shapes,
    spacing,
    uv_of_points,
)
from pointchart.gaps.bridges import GAP_SHARE, BridgedPatch, find_bridges
from pointchart.gaps.rules import (
    CLEAR,
    LEAST_SPACINGS,
    MESSY_SHARE,
    MESSY_SPACINGS,
    SECOND_BOUNDARY,
    SECOND_SPACINGS,
    SURE,
    SURELY_SECOND,
    TORN_IN_ALL,
    TORN_SPACINGS,
    check_torn,
    compare_gaps,
    loop_round,
)
from pointchart.mesh.connectivity import boundary_loops, half_edges

RING = shapes.annulus()
INNER, OUTER = sorted(RING.loops, key=lambda loop: np.linalg.norm(RING.points[loop[0]]))
SQUARE = np.array([[0.0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 3, 0]])
PIERCED = {
    "disc": lambda: shapes.pierce(shapes.disc(1500, seed=1), n_gaps=3, seed=1),
    "relief": lambda: shapes.pierce(shapes.relief(2000, seed=1), n_gaps=3, seed=1),
    "rolled disc": lambda: shapes.roll(shapes.pierce(shapes.disc(2000, seed=3), n_gaps=2, seed=3), 200),
}


def lampshade():
    """Return a wide cone cut off at the top, and its narrow and its wide rim."""
    radius = np.linalg.norm(RING.points, axis=1)
    return RING.points - radius[:, None] * [0, 0, 1], INNER, OUTER


def gap(rim_length=1.0, rim_in_spacings=30.0, share=1.0, points=(0, 1, 2)):
    return BridgedPatch(np.array(points), 1, rim_length, rim_in_spacings, share, np.arange(1))


def of_square(gaps=(), others=(), scale=1.0):
    loops = [Candidate(np.array(loop), 1.0, 1.0) for loop in others]
    return compare_gaps(scale * SQUARE, np.full(4, scale), np.arange(4), list(gaps), loops)


def oriented(triangles):
    turn = np.argmin(triangles, axis=1)[:, None]
    return set(map(tuple, np.take_along_axis(triangles, (turn + np.arange(3)) % 3, axis=1).tolist()))


def farthest(points, others):
    """Return the largest distance of a point from the nearest of some others."""
    return cKDTree(others).query(points)[0].max()


def as_set(loop):
    return set(np.asarray(loop).tolist())


# The rules


@pytest.mark.parametrize("scale", [1.0, 1e-6, 1e6])
def test_the_boundary_of_a_square_is_four_sides_long(scale):
    assert of_square(scale=scale).length == pytest.approx(12 * scale)


@pytest.mark.parametrize("share", [0.99, 1.0, 3.0])
@pytest.mark.parametrize("spacings", [23.9, 24.0, 100.0])
def test_a_second_boundary_is_a_quarter_as_long_as_the_first_and_twenty_four_spacings(share, spacings):
    candidate = gap(share * SECOND_BOUNDARY * 12, spacings)
    found = of_square([gap(0.01), candidate])
    is_second = share >= 1 and spacings >= (LEAST_SPACINGS if share == 3.0 else SECOND_SPACINGS)
    if is_second:
        assert found.second_boundary[0].tolist() == candidate.points.tolist()
        assert found.second_boundary[1] == candidate.rim_length
        with pytest.raises(SolveError, match="the surface has a second boundary"):
            refuse_second_boundary(found)
    else:
        assert found.second_boundary is None
        assert refuse_second_boundary(found) == []


@pytest.mark.parametrize("share", [0.99, 1.0])
@pytest.mark.parametrize("spacings", [11.9, 12.0])
def test_a_gap_of_nearly_half_the_boundary_is_a_second_one_however_coarse_the_sampling(share, spacings):
    found = of_square([gap(share * SURELY_SECOND * 12, spacings)])
    assert (found.second_boundary is not None) == (share >= 1 and spacings >= LEAST_SPACINGS)


@pytest.mark.parametrize("share", [0.74, 0.75])
@pytest.mark.parametrize("step", [0.5, 0.6])
def test_a_loop_that_no_long_edge_bridges_is_a_second_boundary_if_it_is_half_as_long_and_sure(share, step):
    other = Candidate(np.arange(4), 12.0, share)
    found = compare_gaps(SQUARE, np.full(4, step), np.arange(4), [], [other])
    is_second = share >= SURE and 12 / step >= SECOND_SPACINGS
    assert (found.second_boundary is not None) == is_second
    assert not found.is_outgrown


def test_a_boundary_is_outgrown_by_a_longer_gap():
    assert of_square([gap(12.1, 30.0)]).is_outgrown
    assert not of_square([gap(11.9, 30.0)]).is_outgrown


def test_a_second_boundary_is_refused_with_lengths_and_places_of_both():
    with pytest.raises(SolveError) as caught:
        refuse_second_boundary(
            compare_gaps(SQUARE, np.ones(4), np.array([1, 2, 3, 0]), [gap(3.5, points=(2, 3, 1))], [])
        )
    message = str(caught.value)
    assert "besides the loop of 4 points, 12 long, through point 1 at (3, 0, 0)," in message
    assert "of 3 points, 3.5 long, through point 2 at (3, 3, 0);" in message
    assert message.endswith("; bridge it, leave it open, say which is the outer one, or give the boundary")
    renamed = str(caught.value.renumbered(np.array([10, 11, 12, 13])))
    assert "through point 11 at" in renamed
    assert "through point 12 at" in renamed


def test_a_second_boundary_is_told_by_the_loop_that_was_found_around_it():
    found = of_square([gap(4.0, points=(0, 1, 2))], others=[[3, 1], [2, 1, 3, 0]])
    with pytest.raises(SolveError, match=r"of 4 points, 14.49 long, through point 2 at \(3, 3, 0\)"):
        refuse_second_boundary(found)


@pytest.mark.parametrize(
    ("others", "found"),
    [([], None), ([[3, 4, 5]], None), ([[0, 1, 9, 8]], None), ([[5, 0, 1, 2], [0, 1, 2, 3, 4]], 1), ([[3, 2, 1]], 0)],
)
def test_the_loop_round_a_gap_holds_most_corners_of_its_bridge(others, found):
    loop = loop_round(gap(points=(0, 1, 2, 3)), [Candidate(np.array(other), 1.0, 1.0) for other in others])
    assert (None if loop is None else loop.tolist()) == (None if found is None else others[found])


def test_bridging_opens_no_gap_and_leaving_open_all():
    gaps = [gap(9.0), gap(0.1)]
    assert bridge_gaps(of_square(gaps)) == []
    assert leave_gaps_open(of_square(gaps)) == gaps


@pytest.mark.parametrize(
    ("disputes", "share", "limit"),
    [(0, 0.99, TORN_SPACINGS), (1, 0.99, MESSY_SPACINGS), (1, 1.0, TORN_SPACINGS), (0, 1.0, TORN_SPACINGS)],
)
def test_a_bridge_without_a_gap_is_torn_from_a_length_on_that_disputed_links_raise(disputes, share, limit):
    disputed, length = np.full(4, disputes), share * MESSY_SHARE * 12
    assert (disputes > CLEAR) == bool(disputes)
    check_torn(of_square(), [gap(length, limit - 0.1, share=0.0)], disputed, is_given=False)
    with pytest.raises(SolveError, match=rf"3 points round point 1 at \(3, 0, 0\) are .* {limit:.0f} spacings round"):
        check_torn(of_square(), [gap(length, limit, share=0.0, points=(1, 2, 3))], disputed, is_given=False)


@pytest.mark.parametrize("n", [3, 4])
def test_small_torn_places_of_a_clear_surface_count_together(n):
    torn = [gap(0.1, TORN_IN_ALL / 4, share=0.0)] * n
    check_torn(of_square(), torn, np.ones(4), is_given=False)
    if n < 4:
        check_torn(of_square(), torn, np.zeros(4), is_given=False)
    else:
        with pytest.raises(SolveError, match="although the scan has no gap there"):
            check_torn(of_square(), torn, np.zeros(4), is_given=False)


def test_a_bridge_over_a_gap_is_never_torn():
    check_torn(of_square(), [gap(9.0, 1e3, share=GAP_SHARE)], np.zeros(4), is_given=False)
    with pytest.raises(SolveError, match="although the scan has no gap there"):
        check_torn(of_square(), [gap(9.0, 1e3, share=0.99 * GAP_SHARE)], np.zeros(4), is_given=False)


def test_a_boundary_that_was_given_bears_bridges_of_a_quarter_of_its_length():
    short, long = (gap(factor * SECOND_BOUNDARY * 12, 1e3, share=0.0) for factor in (0.99, 1.0))
    check_torn(of_square(), [short], np.zeros(4), is_given=True)
    for bridge, is_given in ((long, True), (short, False)):
        with pytest.raises(SolveError, match=r"cut the scan there"):
            check_torn(of_square(), [bridge], np.zeros(4), is_given=is_given)


# A second boundary


@pytest.mark.parametrize("size", [{}, {"n_around": 60, "n_rings": 10}, {"inner_radius": 0.3}])
def test_an_annulus_is_refused_by_naming_both_loops(size):
    ring = shapes.annulus(**size)
    inner, outer = sorted(ring.loops, key=lambda loop: np.linalg.norm(ring.points[loop[0]]))
    with pytest.raises(SolveError, match="the surface has a second boundary, so it is no disc") as caught:
        reconstruct(ring.points)
    assert caught.value.points["here"][0] in outer
    assert caught.value.points["there"][0] in inner
    n, radius = len(outer), np.linalg.norm(ring.points[inner[0]])
    chords = 2 * n * np.sin(np.pi / n)
    assert f"besides the loop of {n} points, {chords:.4g} long, through" in str(caught.value)
    assert f"there is one of {n} points, {radius * chords:.4g} long, through" in str(caught.value)


def test_the_second_boundary_of_an_annulus_is_bridged_where_asked():
    result = reconstruct(RING.points, gaps=bridge_gaps)
    assert result.certificate.is_disc
    assert result.certificate.is_one_to_one
    assert as_set(result.loop) == as_set(OUTER)
    (bridge,) = result.evidence.bridges
    assert as_set(bridge.points) <= as_set(INNER)
    assert bridge.is_gap
    assert bridge.rim_length == pytest.approx(np.pi, rel=1e-2)


def test_the_second_boundary_of_an_annulus_is_left_open_where_asked():
    result = reconstruct(RING.points, gaps=leave_gaps_open)
    proof = result.certificate
    assert (proof.euler, proof.holes, proof.boundary_loops) == (0, 1, 2)
    assert proof.is_as_asked
    assert not proof.is_disc
    assert proof.is_one_to_one
    found = boundary_loops(half_edges(result.triangles, len(result.rows)))
    assert sorted(map(sorted, found)) == sorted(map(sorted, (OUTER, INNER)))


@pytest.mark.parametrize(("rule", "holes"), [(None, 0), (bridge_gaps, 0), (leave_gaps_open, 1)])
@pytest.mark.parametrize("rim", ["narrow", "wide"])
def test_either_rim_of_a_lampshade_is_the_boundary_if_a_place_says_so(rim, rule, holes):
    points, narrow, wide = lampshade()
    wanted, other = (narrow, wide) if rim == "narrow" else (wide, narrow)
    result = reconstruct(points, outer=points[wanted[0]], gaps=rule)
    assert as_set(result.loop) == as_set(wanted)
    assert result.certificate.is_one_to_one
    assert (result.certificate.holes, result.certificate.euler) == (holes, 1 - holes)
    (bridge,) = result.evidence.bridges
    assert as_set(bridge.points) <= as_set(other)
    found = boundary_loops(half_edges(result.triangles, len(result.rows)))
    assert sorted(map(sorted, found)) == sorted(map(sorted, [wanted, other][: 1 + holes]))


def test_a_second_boundary_may_be_refused_though_the_outer_loop_is_known():
    with pytest.raises(SolveError, match="the surface has a second boundary"):
        reconstruct(RING.points, outer=[1, 0, 0], gaps=refuse_second_boundary)
    with pytest.raises(SolveError, match="the surface has a second boundary"):
        reconstruct(RING.points, OUTER, gaps=refuse_second_boundary)


@pytest.mark.parametrize("rim", ["narrow", "wide"])
def test_a_boundary_that_was_given_is_not_doubted_for_a_second_one(rim):
    points, narrow, wide = lampshade()
    wanted = narrow if rim == "narrow" else wide
    result = reconstruct(points, wanted)
    assert result.certificate.is_disc
    assert as_set(result.loop) == as_set(wanted)
    assert reconstruct(points, wanted, gaps=leave_gaps_open).certificate.holes == 1


# Gaps left open


@pytest.mark.parametrize("name", PIERCED)
def test_every_gap_that_is_left_open_is_a_hole_and_else_the_mesh_is_the_same(name):
    scan = PIERCED[name]()
    whole, opened = (reconstruct(scan.points, gaps=rule) for rule in (bridge_gaps, leave_gaps_open))
    gaps = [bridge for bridge in whole.evidence.bridges if bridge.is_gap]
    proof = opened.certificate
    assert proof.holes == len(gaps) == len(scan.loops) - 1
    assert (proof.euler, proof.boundary_loops, proof.unused_points) == (1 - len(gaps), 1 + len(gaps), 0)
    assert proof.is_one_to_one
    assert np.array_equal(whole.uv, opened.uv)
    assert np.array_equal(whole.loop, opened.loop)
    assert oriented(opened.triangles) < oriented(whole.triangles)
    patches = find_bridges(scan.points, whole.triangles, spacing(scan.points), lambda: np.ones(len(scan.points), bool))
    assert [patch.n_triangles for patch in patches] == [gap.n_triangles for gap in gaps]
    bridged = np.concatenate([whole.triangles[patch.triangles] for patch in patches])
    assert not oriented(bridged) & oriented(opened.triangles)


@pytest.mark.parametrize("name", PIERCED)
def test_holes_lie_where_the_scan_has_its_gaps(name):
    scan = PIERCED[name]()
    result = reconstruct(scan.points, gaps=leave_gaps_open)
    _, *holes = boundary_loops(half_edges(result.triangles, len(result.rows)))
    away = [[farthest(scan.points[hole], scan.points[loop]) for loop in scan.loops[1:]] for hole in holes]
    assert sorted(np.argmin(away, axis=1)) == list(range(len(holes)))
    assert np.min(away, axis=1).max() < 1.5 * scan.spacing


def test_the_certificate_of_a_mesh_with_holes_comes_back_from_its_arrays():
    scan = PIERCED["relief"]()
    result = reconstruct(scan.points, gaps=leave_gaps_open)
    again = certify(scan.points, result.triangles, uv=result.uv, loop=result.loop, holes=result.certificate.holes)
    assert again.faults == ()
    assert again.is_one_to_one
    assert not certify(scan.points, result.triangles, uv=result.uv, loop=result.loop).is_as_asked


def test_a_scan_without_gaps_has_no_hole():
    result = reconstruct(shapes.relief(600, seed=2).points, gaps=leave_gaps_open)
    assert result.certificate.is_disc


def test_a_rule_of_the_users_own_is_asked_once_a_mesh_in_the_unit_of_the_scan():
    scan, asked = PIERCED["disc"](), []

    def longest(found):
        asked.append(found)
        return found.gaps[:1]

    result = reconstruct(1000 * scan.points, gaps=longest)
    (found,) = asked
    assert found.length == pytest.approx(2000 * np.pi, rel=1e-2)
    assert found.gaps[0].rim_length == max(bridge.rim_length for bridge in result.evidence.bridges)
    assert result.certificate.holes == 1
    assert result.certificate.is_one_to_one


def test_the_papers_parameters_go_with_holes_too():
    result = reconstruct(PIERCED["disc"]().points, gaps=leave_gaps_open, chart=uv_of_points)
    assert result.certificate.is_as_asked
    assert result.certificate.holes == 3
