import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import planar_discs, seeds

from pointchart._kernels.solve import cycles as kernels
from pointchart._kernels.unsigned import unsigned
from pointchart._parallel import on_threads
from pointchart.errors import SolveError
from pointchart.map.weights import mean_value
from pointchart.mesh.connectivity import one_rings
from pointchart.shapes import disc, relief
from pointchart.solve.algebraic_multigrid import TOLERANCE, multigrid
from pointchart.solve.factors import direct
from pointchart.solve.hierarchy import _in_singles, split
from pointchart.solve.systems import solve_fixed

# More than the coarsest level holds, so that there are levels at all.
LARGE_DISCS = planar_discs(smallest=400, largest=1500)


def graph_of(shape, weights):
    rings = one_rings(shape.triangles, len(shape.points))
    return sp.csr_array((weights(shape.points, rings), rings.indices, rings.indptr), shape=(len(shape.points),) * 2)


def laplacian(side):
    """Return the five-point stencil on a square of side**2 unknowns."""
    line = sp.diags_array([-np.ones(side - 1), np.full(side, 2.0), -np.ones(side - 1)], offsets=[-1, 0, 1])
    one = sp.eye_array(side)
    return sp.csr_array(sp.kron(line, one) + sp.kron(one, line))


def random_system(seed, n, *, n_sides=2):
    """Return an M-matrix without symmetry, of 1 less the weights of a random graph, and right sides."""
    rng = np.random.default_rng(seed)
    points = np.sort(rng.random(n))
    near = np.clip(np.arange(n)[:, None] + rng.integers(-9, 10, (n, 6)), 0, n - 1)
    graph = sp.csr_array((rng.uniform(0.1, 1, near.size), (np.repeat(np.arange(n), 6), near.ravel())), shape=(n, n))
    graph = sp.csr_array(graph - sp.diags_array(graph.diagonal()))
    diagonal = graph.sum(axis=1) + 0.05 * points
    return sp.csr_array(sp.diags_array(diagonal) - graph), rng.normal(size=(n, n_sides))


def residuals(left, right, solution):
    return np.linalg.norm(right - left @ solution, axis=0) / np.linalg.norm(right, axis=0)


# The solution


@settings(max_examples=10)
@given(LARGE_DISCS, st.integers(1, 3), seeds)
def test_mean_value_maps_are_those_of_the_direct_solver(shape, n_sides, seed):
    graph, values = graph_of(shape, mean_value), np.random.default_rng(seed).normal(size=(len(shape.boundary), n_sides))
    found, exact = (solve_fixed(graph, shape.boundary, values, solver=solver) for solver in (multigrid, direct))
    assert np.abs(found.values - exact.values).max() < 1e-9
    assert len(found.iterations) == n_sides
    assert found.residual < 10 * TOLERANCE


@settings(max_examples=10)
@given(LARGE_DISCS)
def test_the_mean_value_map_of_a_plane_to_its_own_boundary_is_the_plane(shape):
    found = solve_fixed(graph_of(shape, mean_value), shape.boundary, shape.uv[shape.boundary], solver=multigrid)
    assert np.abs(found.values - shape.uv).max() < 1e-9


@settings(max_examples=10)
@given(LARGE_DISCS, seeds)
def test_convex_combinations_stay_within_their_boundary_values(shape, seed):
    def weights(points, rings):
        found = np.random.default_rng(seed).uniform(0.01, 1, len(rings.indices))
        return found / np.bincount(rings.rows, found)[rings.rows]

    values = np.random.default_rng(seed).normal(size=(len(shape.boundary), 2))
    found = solve_fixed(graph_of(shape, weights), shape.boundary, values, solver=multigrid).values
    assert (found >= values.min(axis=0) - 1e-9).all()
    assert (found <= values.max(axis=0) + 1e-9).all()


@settings(max_examples=10)
@given(seeds, st.integers(2, 2000), st.integers(1, 3))
def test_systems_without_symmetry_are_solved_as_by_the_direct_solver(seed, n, n_sides):
    left, right = random_system(seed, n, n_sides=n_sides)
    found, exact = multigrid(left, right)[0], direct(left, right)[0]
    assert np.abs(found - exact).max() < 1e-9 * np.abs(exact).max()


@pytest.mark.parametrize("n_sides", [1, 2, 3, 4])
def test_every_right_side_is_solved_as_if_it_were_alone(n_sides):
    left, right = random_system(1, 900, n_sides=n_sides)
    together, counts = multigrid(left, right)
    for k in range(n_sides):
        alone, (count,) = multigrid(left, right[:, k : k + 1])
        assert np.array_equal(alone[:, 0], together[:, k])
        assert count == counts[k]


def test_a_side_that_is_a_thousandth_of_the_other_is_solved_as_well():
    left, right = random_system(2, 900)
    assert residuals(left, right * [1, 2.0**-10], multigrid(left, right * [1, 2.0**-10])[0]).max() < 10 * TOLERANCE


def test_powers_of_two_of_the_right_side_scale_the_solution_exactly():
    left, right = random_system(3, 900)
    assert np.array_equal(multigrid(left, 2.0**20 * right)[0], 2.0**20 * multigrid(left, right)[0])


@pytest.mark.parametrize("exponents", [[60, 60], [-60, -60], [60, -60]])
def test_right_sides_may_be_large_or_small_each_on_its_own(exponents):
    left, right = random_system(3, 900)
    units = 10.0 ** np.array(exponents)
    found, plain = multigrid(left, units * right)[0], multigrid(left, right)[0]
    assert np.abs(found / units - plain).max() < 1e-10 * np.abs(plain).max()
    units = 2.0 ** np.array(exponents)
    assert np.array_equal(multigrid(left, units * right)[0], units * plain)


@pytest.mark.parametrize("unit", [2.0**-60, 2.0**60])
def test_the_unit_of_the_equations_does_not_matter(unit):
    left, right = random_system(3, 900)
    scaled, counts = multigrid(sp.csr_array(unit * left), unit * right)
    plain, wanted = multigrid(left, right)
    assert counts == wanted
    assert np.array_equal(scaled, plain)


@settings(max_examples=10)
@given(seeds)
def test_the_numbering_does_not_matter(seed):
    left, right = random_system(4, 900)
    order = np.random.default_rng(seed).permutation(900)
    renumbered = multigrid(sp.csr_array(left[order][:, order]), right[order])[0]
    assert np.abs(renumbered - multigrid(left, right)[0][order]).max() < 1e-9


def test_the_system_and_the_start_are_left_as_they_are():
    left, right = random_system(5, 900)
    start = np.ones_like(right)
    before = [x.copy() for x in (left.data, left.indices, left.indptr, right, start)]
    multigrid(left, right, start=start)
    assert all(map(np.array_equal, before, (left.data, left.indices, left.indptr, right, start)))


# Threads


def test_the_solution_is_the_same_to_the_last_bit_on_any_number_of_threads(monkeypatch):
    monkeypatch.setattr("pointchart._parallel.FEWEST", 1)
    left = laplacian(102)
    right = np.random.default_rng(0).normal(size=(102**2, 3))
    assert len(right) > 5 * kernels.BLOCK
    answers = []
    for threads in (1, 2, 3):
        with on_threads(threads):
            answers.append(multigrid(left, right, tolerance=1e-8))
    assert all(np.array_equal(solution, answers[0][0]) for solution, _ in answers)
    assert all(counts == answers[0][1] for _, counts in answers)


def swept(left, known, n_blocks, order):
    """Sweep forwards and backwards over ranges of blocks in some order; return what is found, left over and better."""
    rows, n = _in_singles(split(left)), len(known)
    found, rest, better = (np.full_like(known, np.nan) for _ in range(3))
    ranges = [(first, min(first + n_blocks * kernels.BLOCK, n)) for first in range(0, n, n_blocks * kernels.BLOCK)]
    for kernel, arrays in (
        (kernels.sweep_forward, (*rows, known, found)),
        (kernels.find_rest, (*rows[:4], found, rest)),
        (kernels.sweep_backward, (*rows, known, found, better)),
    ):
        for k in order.permutation(len(ranges)):
            kernel(*arrays, *ranges[k])
    return found, rest, better


@pytest.fixture(scope="module")
def long_system():
    left, right = random_system(11, 3 * kernels.BLOCK + 100)
    return left, right.astype(np.float32)


@pytest.mark.parametrize("n_blocks", [1, 2])
def test_blocks_of_rows_are_swept_in_any_order_with_the_same_result(long_system, n_blocks):
    whole = swept(*long_system, 4, np.random.default_rng(0))
    parts = swept(*long_system, n_blocks, np.random.default_rng(1))
    assert all(map(np.array_equal, whole, parts))


def test_what_a_sweep_leaves_of_the_right_side_is_the_residual(long_system):
    left, right = long_system
    found, rest, better = swept(left, right, 1, np.random.default_rng(0))
    assert np.abs(rest - (right - left @ found)).max() < 1e-5 * np.abs(right).max()
    assert (residuals(left, right, better) < residuals(left, right, found)).all()


def test_a_sweep_solves_a_triangular_system_of_one_block():
    left, right = random_system(12, kernels.BLOCK)
    for matrix, k in ((sp.csr_array(sp.tril(left)), 0), (sp.csr_array(sp.triu(left)), 2)):
        answer = swept(matrix, right.astype(np.float32), 1, np.random.default_rng(0))[k]
        assert residuals(matrix, right, answer).max() < 1e-5


def test_sums_of_a_product_are_those_of_its_blocks(long_system):
    left, right = long_system
    n_rows = len(right)
    vector, other, product = right.astype(np.float64), np.cos(right), np.zeros(right.shape)
    sums = np.full((-(-n_rows // kernels.BLOCK), 4), np.nan)
    rows = unsigned(left.indptr), unsigned(left.indices), left.data
    for first in range(0, n_rows, kernels.BLOCK):
        kernels.multiply(*rows, vector, product, other, sums, first, min(first + kernels.BLOCK, n_rows))
    assert np.allclose(product, left @ vector, rtol=0, atol=1e-12)
    expected = np.r_[(other * product).sum(axis=0), (product * product).sum(axis=0)]
    assert np.allclose(sums.sum(axis=0), expected, rtol=1e-9)


# Residual and iterations


@pytest.mark.parametrize("tolerance", [1e-2, 1e-5, 1e-8, 1e-11])
def test_the_residual_of_each_right_side_keeps_the_tolerance(tolerance):
    left, right = random_system(6, 3000, n_sides=3)
    assert (residuals(left, right, multigrid(left, right, tolerance=tolerance)[0]) <= 1.01 * tolerance).all()


def test_a_tighter_tolerance_takes_more_iterations():
    left, right = random_system(7, 3000)
    counts = [multigrid(left, right, tolerance=tolerance)[1] for tolerance in (1e-2, 1e-5, 1e-8, 1e-11)]
    assert (np.diff(counts, axis=0) > 0).all()


def test_a_start_that_is_the_solution_takes_no_iteration():
    left, right = random_system(8, 3000)
    solution = multigrid(left, right, tolerance=1e-13)[0]
    again, counts = multigrid(left, right, start=solution)
    assert counts == (0, 0)
    assert np.array_equal(again, solution)


def test_the_nearer_the_start_is_to_the_solution_the_fewer_iterations_are_left():
    left, right = random_system(8, 3000)
    rough = multigrid(left, right, tolerance=1e-6)[0]
    finer = multigrid(left, right, tolerance=1e-9, start=rough)[0]
    counts = [max(multigrid(left, right, start=start)[1]) for start in (None, rough, finer)]
    assert counts[0] > counts[1] > counts[2] > 0


def test_where_the_right_side_is_zero_so_is_the_solution_at_once():
    left, right = random_system(9, 3000)
    right[:, 1] = 0.0
    solution, counts = multigrid(left, right)
    assert counts[0] > 0 == counts[1]
    assert not solution[:, 1].any()


def test_iterations_do_not_grow_with_the_size_of_a_grid():
    counts = [max(multigrid(laplacian(side), np.ones((side**2, 2)))[1]) for side in (45, 90, 173)]
    assert max(counts) <= 10
    assert counts[-1] <= counts[0] + 3


@pytest.mark.parametrize("sheet", [disc, relief])
def test_iterations_do_not_grow_with_the_size_of_a_mesh(sheet):
    counts = []
    for n in (2_000, 8_000, 30_000):
        shape = sheet(n, seed=1)
        graph, rim = graph_of(shape, mean_value), shape.boundary
        counts.append(max(solve_fixed(graph, rim, shape.uv[rim], solver=multigrid).iterations))
    assert max(counts) <= 15
    assert counts[-1] <= counts[0] + 4


# Unusual systems


def test_a_system_in_parts_is_solved_as_its_parts():
    systems = [random_system(seed, n) for seed, n in ((1, 700), (2, 3), (3, 900), (4, 1))]
    left = sp.csr_array(sp.block_diag([left for left, _ in systems]))
    solution = multigrid(left, np.concatenate([right for _, right in systems]))[0]
    apart = np.concatenate([direct(left, right)[0] for left, right in systems])
    assert np.abs(solution - apart).max() < 1e-9 * np.abs(apart).max()


@pytest.mark.parametrize("n", [5, 900])
def test_unknowns_without_neighbours_are_divided_by_their_diagonal(n):
    left, right = random_system(1, n)
    alone = np.arange(0, n, 3)
    coupled = sp.diags_array(np.where(np.arange(n) % 3, 1.0, 0.0))
    left = sp.csr_array(coupled @ left @ coupled + sp.diags_array(np.where(np.arange(n) % 3, 0.0, 4.0)))
    solution = multigrid(left, right)[0]
    assert np.allclose(solution[alone], right[alone] / 4, rtol=0, atol=1e-11)
    assert np.abs(solution - direct(left, right)[0]).max() < 1e-9 * np.abs(solution).max()


@pytest.mark.parametrize("n", [1, 2, 300])
def test_a_diagonal_system_is_divided(n):
    diagonal = np.arange(1.0, n + 1)
    solution, counts = multigrid(sp.csr_array(sp.diags_array(diagonal)), np.ones((n, 3)))
    assert np.allclose(solution, 1 / diagonal[:, None], rtol=1e-11)
    assert max(counts) <= 1


def test_a_single_unknown_is_a_quotient():
    assert multigrid(sp.csr_array([[2.0]]), np.array([[4.0, 6.0, 8.0]]))[0].tolist() == [[2, 3, 4]]


def test_rows_need_not_be_sorted():
    left, right = random_system(1, 900)
    order = np.lexsort([-left.indices, np.repeat(np.arange(900), np.diff(left.indptr))])
    turned = sp.csr_array((left.data[order], left.indices[order], left.indptr))
    assert not turned.has_sorted_indices
    assert np.allclose(multigrid(turned, right)[0], multigrid(left, right)[0], rtol=1e-9, atol=1e-9)


@settings(max_examples=5)
@given(seeds, st.integers(500, 1500))
def test_graphs_of_no_surface_whose_levels_fill_up_are_solved_too(seed, n):
    rng = np.random.default_rng(seed)
    graph = sp.random_array((n, n), density=4 / n, rng=rng)
    graph = sp.csr_array(graph - sp.diags_array(graph.diagonal()))
    left = sp.csr_array(sp.diags_array(graph.sum(axis=1) + 0.1) - graph)
    right = rng.normal(size=(n, 2))
    assert np.abs(multigrid(left, right)[0] - direct(left, right)[0]).max() < 1e-9


# Failures


def test_a_tolerance_that_is_missed_is_told_with_the_number_of_unknowns():
    """A matrix that turns rather than damps is far from what the levels are made for."""
    n = 600
    turn = sp.random_array((n, n), density=0.02, rng=np.random.default_rng(0))
    left = sp.csr_array(sp.eye_array(n) + 30 * (turn - turn.T))
    message = rf"a relative residual of 1e-08 in \d+ iterations \({n} unknowns\); use the direct solver"
    with pytest.raises(SolveError, match=message):
        multigrid(left, np.ones((n, 2)), tolerance=1e-8)


def test_a_right_side_that_is_no_number_is_not_solved():
    with pytest.raises(SolveError, match=r"norms \[nan\]; give finite ones"):
        multigrid(laplacian(20), np.full((400, 1), np.nan))


def test_a_right_side_without_a_finite_norm_is_refused():
    with pytest.raises(SolveError, match=r"norms \[inf, 1.0\].*scaled down if"):
        multigrid(laplacian(2), np.array([[1e200, 1.0], [1e200, 0], [1e200, 0], [1e200, 0]]))


def test_a_right_side_of_zeros_is_solved_by_zeros_from_any_start():
    solution, counts = multigrid(laplacian(20), np.zeros((400, 2)), start=np.ones((400, 2)))
    assert not solution.any()
    assert counts == (0, 0)
