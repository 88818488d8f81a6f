from functools import partial

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import assume, given, settings
from strategies import systems

from pointchart.errors import SolveError
from pointchart.map.weights import mean_value, reciprocal_distance, uniform
from pointchart.mesh.connectivity import one_rings
from pointchart.points.neighbors import ball, nearest
from pointchart.shapes import disc, relief, shuffle
from pointchart.solve.algebraic_multigrid import multigrid
from pointchart.solve.factors import Direct, cholesky, direct, nested_dissection
from pointchart.solve.krylov import bicgstab, conjugate_gradient
from pointchart.solve.symmetric_form import symmetrize
from pointchart.solve.systems import solve_fixed

GENERAL = [direct, Direct(), bicgstab, multigrid]
SYMMETRIC = [cholesky, conjugate_gradient]
ITERATIVE = [bicgstab, multigrid, conjugate_gradient]


def named(solvers):
    return {
        "argvalues": solvers,
        "ids": [solver.__name__ + ("*" if isinstance(solver, Direct) else "") for solver in solvers],
    }


def matrix_of(shape, around, scheme):
    values = scheme(shape.points, around)
    return sp.csr_array((values, around.indices, around.indptr), shape=(len(shape.points),) * 2)


@pytest.fixture(scope="module")
def patch():
    return relief(1000, seed=8)


@pytest.fixture(scope="module")
def values(patch):
    return patch.uv[patch.boundary] ** 2 + [0.5, -1]


@pytest.fixture(scope="module")
def symmetric_matrix(patch):
    return matrix_of(patch, ball(patch.points, 2.7 * patch.spacing), reciprocal_distance)


@pytest.fixture(scope="module")
def general_matrix(patch):
    return matrix_of(patch, one_rings(patch.triangles, len(patch.points)), mean_value)


@pytest.fixture(scope="module")
def dense(patch, values):
    """Solve with dense matrices, by numpy alone."""

    def solve(matrix):
        n, full = matrix.shape[0], np.zeros((matrix.shape[0], 2))
        full[patch.boundary] = values
        free = np.setdiff1d(np.arange(n), patch.boundary)
        weights = matrix.toarray()
        full[free] = np.linalg.solve(np.eye(len(free)) - weights[np.ix_(free, free)], weights[free] @ full)
        return full

    return solve


@pytest.mark.parametrize("solver", **named([*GENERAL, *SYMMETRIC]))
def test_all_solvers_agree_on_a_symmetric_system(patch, values, symmetric_matrix, dense, solver):
    found = solve_fixed(symmetric_matrix, patch.boundary, values, solver=solver)
    assert np.abs(found.values - dense(symmetric_matrix)).max() < 1e-9
    assert found.residual < 1e-11
    assert found.method == solver.__name__


@pytest.mark.parametrize("solver", **named(GENERAL))
def test_general_solvers_agree_on_a_system_without_symmetry(patch, values, general_matrix, dense, solver):
    found = solve_fixed(general_matrix, patch.boundary, values, solver=solver)
    assert np.abs(found.values - dense(general_matrix)).max() < 1e-9
    assert found.residual < 1e-11


@pytest.mark.parametrize("solver", **named([*GENERAL, *SYMMETRIC]))
def test_fixed_values_come_back_untouched_and_bound_the_others(patch, values, symmetric_matrix, solver):
    found = solve_fixed(symmetric_matrix, patch.boundary, values, solver=solver).values
    assert np.array_equal(found[patch.boundary], values)
    assert (found >= values.min(axis=0) - 1e-12).all()
    assert (found <= values.max(axis=0) + 1e-12).all()


@pytest.mark.parametrize("solver", **named(ITERATIVE))
def test_iterations_are_counted_for_each_right_side(patch, values, symmetric_matrix, solver):
    found = solve_fixed(symmetric_matrix, patch.boundary, values, solver=solver)
    assert len(found.iterations) == 2
    assert all(count > 1 for count in found.iterations)
    one = solve_fixed(symmetric_matrix, patch.boundary, values[:, 1:], solver=solver)
    assert one.iterations == found.iterations[1:]


@pytest.mark.parametrize("solver", **named([direct, cholesky]))
def test_direct_solvers_report_no_iterations(patch, values, symmetric_matrix, solver):
    assert solve_fixed(symmetric_matrix, patch.boundary, values, solver=solver).iterations == ()


@pytest.mark.parametrize("tolerance", [1e-2, 1e-6, 1e-10])
@pytest.mark.parametrize("solver", **named(ITERATIVE))
def test_the_residual_keeps_the_tolerance(patch, values, symmetric_matrix, solver, tolerance):
    found = solve_fixed(symmetric_matrix, patch.boundary, values, solver=partial(solver, tolerance=tolerance))
    # Conjugate gradients measure the residual of the scaled rows.
    assert found.residual < 3 * tolerance
    tight = solve_fixed(symmetric_matrix, patch.boundary, values, solver=solver)
    assert all(a < b for a, b in zip(found.iterations, tight.iterations, strict=True))


@pytest.mark.parametrize("solver", **named([bicgstab, multigrid]))
def test_a_good_start_saves_iterations(patch, values, general_matrix, solver):
    cold = solve_fixed(general_matrix, patch.boundary, values, solver=solver)
    free = np.setdiff1d(np.arange(len(patch.points)), patch.boundary)
    start = cold.values[free] + 1e-9
    warm = solve_fixed(general_matrix, patch.boundary, values, solver=partial(solver, start=start))
    assert sum(warm.iterations) < sum(cold.iterations)
    assert np.abs(warm.values - cold.values).max() < 1e-9


def test_multigrid_needs_far_fewer_iterations_than_the_plain_method(patch, values, general_matrix):
    plain, levels = (solve_fixed(general_matrix, patch.boundary, values, solver=s) for s in (bicgstab, multigrid))
    assert max(levels.iterations) < min(plain.iterations) / 3


def test_rows_of_fixed_unknowns_are_not_used(patch, values, general_matrix):
    other = sp.lil_array(general_matrix)
    other[patch.boundary] = 7.0
    found, plain = (
        solve_fixed(sp.csr_array(matrix), patch.boundary, values).values for matrix in (other, general_matrix)
    )
    assert np.array_equal(found, plain)


def test_the_size_of_the_system_is_reported(patch, values, general_matrix):
    found = solve_fixed(general_matrix, patch.boundary, values)
    free = np.setdiff1d(np.arange(len(patch.points)), patch.boundary)
    assert found.unknowns == len(free)
    assert found.nonzeros == general_matrix[free][:, free].nnz + len(free)


def test_nothing_is_left_to_solve_where_all_is_fixed():
    found = solve_fixed(sp.csr_array((3, 3)), [0, 1, 2], [[1.0], [2.0], [3.0]])
    assert found.values.ravel().tolist() == [1, 2, 3]
    assert (found.unknowns, found.residual, found.method) == (0, 0.0, "none")


@pytest.mark.parametrize("solver", **named([*GENERAL, *SYMMETRIC]))
def test_a_single_unknown_is_the_mean_of_its_neighbours(solver):
    mean = sp.csr_array([[0, 0.25, 0.75], [0, 0, 0], [0, 0, 0]])
    assert np.allclose(solve_fixed(mean, [1, 2], [[4.0], [8.0]], solver=solver).values[0], 7, rtol=1e-14)


@pytest.mark.parametrize("solver", **named([*GENERAL, *SYMMETRIC]))
def test_all_is_zero_where_the_fixed_values_are(patch, symmetric_matrix, solver):
    zeros = np.zeros((len(patch.boundary), 2))
    assert not solve_fixed(symmetric_matrix, patch.boundary, zeros, solver=solver).values.any()


def test_an_order_of_elimination_serves_again_for_other_weights_of_the_same_size(patch, values, general_matrix, dense):
    again = Direct()
    solve_fixed(general_matrix, patch.boundary, values, solver=again)
    other = matrix_of(patch, nearest(patch.points, 9), uniform)
    assert np.abs(solve_fixed(other, patch.boundary, values, solver=again).values - dense(other)).max() < 1e-9
    small = sp.csr_array([[0, 0.5, 0.5], [0, 0, 0], [0, 0, 0]])
    assert solve_fixed(small, [1, 2], [[0.0], [1.0]], solver=again).values[0] == 0.5


def test_nested_dissection_lists_every_unknown_once(general_matrix):
    order = nested_dissection(sp.csr_array(sp.eye_array(1000) - general_matrix))
    assert np.array_equal(np.sort(order), np.arange(1000))


@settings(max_examples=40)
@given(systems())
def test_solutions_of_random_systems_solve_them(system):
    assume(all(system.reaches(i) for i in system.inner))
    found = solve_fixed(system.matrix, system.loop, system.layout, solver=direct)
    mean = system.matrix @ found.values
    assert np.abs(mean - found.values)[system.inner].max() < 1e-12
    assert found.residual < 1e-11


@pytest.mark.parametrize("scheme", [uniform, reciprocal_distance])
def test_balls_of_one_radius_have_a_symmetric_form(patch, scheme):
    matrix = matrix_of(patch, ball(patch.points, 2.7 * patch.spacing), scheme)
    free = np.setdiff1d(np.arange(1000), patch.boundary)
    left = sp.csr_array(sp.eye_array(len(free)) - matrix[free][:, free])
    symmetric, scale = symmetrize(left)
    assert (scale > 0).all()
    assert abs(symmetric - symmetric.T).max() < 1e-9 * abs(symmetric).max()
    assert abs(symmetric - sp.diags_array(scale) @ left).max() == 0
    assert np.diag(np.linalg.cholesky(symmetric.toarray())).min() > 0, "the form is not positive definite"


@pytest.mark.parametrize("solver", **named(SYMMETRIC))
def test_symmetric_solvers_refuse_weights_that_do_not_come_from_one_number_a_pair(
    patch, values, general_matrix, solver
):
    with pytest.raises(SolveError, match=r"no symmetric form \(4\.5\): those of points \d+, \d+ for each other differ"):
        solve_fixed(general_matrix, patch.boundary, values, solver=solver)


@pytest.mark.parametrize("solver", **named(SYMMETRIC))
def test_symmetric_solvers_name_a_pair_that_is_no_pair_in_return(solver):
    shape = shuffle(disc(400, seed=3))
    around = nearest(shape.points, 6)
    matrix = matrix_of(shape, around, uniform)
    with pytest.raises(SolveError, match=r"points \d+ and \d+ are not neighbours of each other") as failure:
        solve_fixed(matrix, shape.boundary, shape.uv[shape.boundary], solver=solver)
    i, j = (failure.value.points[name][0] for name in ("one", "other"))
    assert (matrix[i, j] > 0) != (matrix[j, i] > 0)


def test_a_solver_that_misses_its_tolerance_says_so(patch, values, general_matrix):
    with pytest.raises(SolveError, match=r"bicgstab did not reach a relative residual of 1e-300 in \d+ iterations"):
        solve_fixed(general_matrix, patch.boundary, values, solver=partial(bicgstab, tolerance=1e-300))


def test_a_solver_without_a_finite_answer_is_named(patch, values, general_matrix):
    def hopeless(left, right):
        return np.full_like(right, np.nan), ()

    with pytest.raises(SolveError, match=r"hopeless gave no finite solution of \d+ unknowns; try another solver"):
        solve_fixed(general_matrix, patch.boundary, values, solver=hopeless)


def test_a_singular_system_is_refused():
    pair = sp.csr_array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    with pytest.raises(SolveError, match=r"the factorization of 2 unknowns failed .*; use a larger neighbourhood"):
        solve_fixed(pair, [2], [[1.0]])
