import pickle
from dataclasses import replace
from functools import partial, wraps

import numpy as np
import pytest

from pointchart import (
    Chart,
    InputError,
    SolveError,
    Swaps,
    keep_edges,
    nearest,
    reciprocal_distance,
    reconstruct,
    shapes,
    swap_to_delaunay,
    swap_to_least_turn,
    uv_free_boundary,
    uv_low_stretch,
    uv_of_points,
    uv_on_mesh,
)
from pointchart.chart.rule import as_chart
from pointchart.mesh.swap_rule import as_swaps

CAP = shapes.hemisphere(500)
RELIEF = shapes.relief(500, seed=2)


def wrapped(rule):
    """Return a plain function that does what a rule does."""
    return lambda *arguments: rule(*arguments)


def folded(points, loop, boundary_uv, meshed, solver):
    """Map a mesh, and turn one of its triangles over."""
    mapped = uv_on_mesh(points, loop, boundary_uv, meshed, solver)
    a, b, c = meshed.swapped.triangles[~np.isin(meshed.swapped.triangles, loop).any(axis=1)][0]
    uv = mapped.uv.copy()
    uv[a] = uv[b] + uv[c] - uv[a]
    return replace(mapped, uv=uv)


@pytest.mark.parametrize("rule", [uv_on_mesh, uv_low_stretch, uv_free_boundary])
def test_a_rule_that_is_wrapped_gives_what_it_gives_itself(rule):
    ours, theirs = (reconstruct(CAP.points, chart=chart) for chart in (rule, wrapped(rule)))
    assert np.array_equal(ours.uv, theirs.uv)
    assert np.array_equal(ours.triangles, theirs.triangles)
    assert theirs.certificate.is_one_to_one


def test_a_rule_of_the_users_own_that_folds_is_refused_unless_it_promises_less():
    with pytest.raises(SolveError, match="the parameters are not one-to-one"):
        reconstruct(CAP.points, chart=folded)
    with pytest.raises(SolveError, match="the parameters are not one-to-one"):
        reconstruct(CAP.points, chart=Chart(folded, name="of mine"))
    assert not reconstruct(CAP.points, chart=Chart(folded, is_one_to_one=False)).certificate.is_one_to_one


def test_a_rule_that_needs_a_map_gets_a_mesh_with_one_though_it_is_wrapped():
    mine = Chart(wrapped(uv_of_points), needs_map=True, is_one_to_one=False)
    ours, theirs = (reconstruct(RELIEF.points, chart=chart) for chart in (uv_of_points, mine))
    assert theirs.evidence.first_solve is not None
    assert np.array_equal(ours.uv, theirs.uv)
    assert reconstruct(RELIEF.points, chart=wrapped(uv_on_mesh)).evidence.first_solve is None


def test_swaps_that_are_wrapped_go_on_from_the_delaunay_mesh():
    roof = shapes.fold(4.0, nx=21, ny=11)
    ours, theirs = (reconstruct(roof.points, swap=swap) for swap in (swap_to_least_turn, wrapped(swap_to_least_turn)))
    assert np.array_equal(ours.triangles, theirs.triangles)
    plain, same = (reconstruct(roof.points, swap=swap) for swap in (swap_to_delaunay, wrapped(keep_edges)))
    assert np.array_equal(plain.triangles, same.triangles)


@pytest.mark.parametrize("wrap", [partial, lambda rule: wraps(rule)(lambda *arguments: rule(*arguments))])
def test_what_wraps_a_rule_by_functools_promises_what_the_rule_does(wrap):
    ours, theirs = (reconstruct(RELIEF.points, chart=chart) for chart in (uv_of_points, wrap(uv_of_points)))
    assert np.array_equal(ours.uv, theirs.uv)
    ours, theirs = (reconstruct(RELIEF.points, swap=swap) for swap in (keep_edges, wrap(keep_edges)))
    assert np.array_equal(ours.triangles, theirs.triangles)


def test_a_rule_that_needs_a_map_says_what_to_promise_where_it_gets_none():
    with pytest.raises(InputError, match=r"made without a map.* promise needs_map=True"):
        reconstruct(RELIEF.points, chart=wrapped(uv_of_points))


@pytest.mark.parametrize("rule", [uv_on_mesh, uv_low_stretch, uv_free_boundary, uv_of_points])
def test_a_chart_comes_back_from_a_pickle_as_itself(rule):
    assert pickle.loads(pickle.dumps(rule)) is rule
    mine = pickle.loads(pickle.dumps(Chart(folded, name="of mine")))
    assert (mine.map, mine.name) == (folded, "of mine")


@pytest.mark.parametrize("rule", [swap_to_delaunay, swap_to_least_turn, keep_edges])
def test_swaps_come_back_from_a_pickle_as_themselves(rule):
    assert pickle.loads(pickle.dumps(rule)) is rule


def test_swaps_from_the_triangulation_of_the_parameters_get_it_though_they_are_wrapped():
    mine = Swaps(wrapped(keep_edges), from_delaunay=False)
    method = {"connect": partial(nearest, k=20), "weights": reciprocal_distance}
    for options in ({}, method):
        ours, theirs = (reconstruct(RELIEF.points, swap=swap, **options) for swap in (keep_edges, mine))
        assert np.array_equal(ours.triangles, theirs.triangles)


@pytest.mark.parametrize("rule", [uv_on_mesh, uv_low_stretch, uv_free_boundary, uv_of_points])
def test_a_chart_is_documented_as_the_function_it_decorates(rule):
    assert rule.__doc__ == rule.map.__doc__
    assert as_chart(rule) is rule


@pytest.mark.parametrize("rule", [swap_to_delaunay, keep_edges])
def test_swaps_are_documented_as_the_function_they_decorate(rule):
    assert rule.__doc__ == rule.swap.__doc__
    assert as_swaps(rule) is rule
