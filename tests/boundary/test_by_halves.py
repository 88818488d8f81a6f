import numpy as np
import pytest

from pointchart import InputError, delaunay_star, hull_test, nearest, order_by_halves, shapes

WAVES = {
    "circle": lambda t: np.c_[np.cos(t), np.sin(t), 0 * t],
    "ellipse": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0 * t],
    "saddle": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0.3 * np.sin(3 * t)],
    "wavy ellipse": lambda t: np.c_[2 * np.cos(t), np.sin(t), 0.3 * np.sin(5 * t)],
}


def shares_of_steps(order, n):
    """Return the share of steps of a cyclic order of 0..n-1 that go one forward, or one back, the larger one."""
    steps = np.diff(np.r_[order, order[:1]]) % n
    return max((steps == 1).mean(), (steps == n - 1).mean())


@pytest.mark.parametrize("curve", WAVES)
@pytest.mark.parametrize("n", [40, 41, 200])
def test_ordering_by_halves_restores_the_order_of_a_closed_curve(curve, n):
    turn = 2 * np.pi * np.arange(n) / n
    members = np.random.default_rng(n).permutation(n)
    assert shares_of_steps(order_by_halves(WAVES[curve](turn), members), n) == 1.0


def test_ordering_by_halves_takes_the_plane_it_is_given():
    turn = 2 * np.pi * np.arange(60) / 60
    for normal in ([0, 1, 0], [1, 1, 0], [1, 0, 0]):
        loop = order_by_halves(WAVES["circle"](turn), np.arange(60), normal=normal)
        assert shares_of_steps(loop, 60) == 1.0


def test_ordering_by_halves_returns_its_members_once():
    shape = shapes.hemisphere(300)
    members = shape.boundary[::2]
    assert sorted(order_by_halves(shape.points, members)) == sorted(members)


def test_a_half_without_points_is_refused():
    points = np.array([[0.0, 0, 0], [0.1, 1, 0], [0.2, 2, 0], [0.1, 3, 0], [-9.0, 1.5, 0], [0.0, 4, 0]])
    with pytest.raises(InputError, match="the plane leaves 1 boundary points on one side; each half needs at least 3"):
        order_by_halves(points, np.arange(6), normal=[1, 0, 0])
    with pytest.raises(InputError, match="5 boundary points cannot be put in order by halves"):
        order_by_halves(points, np.arange(5), normal=[1, 0, 0])


def test_boundary_points_in_clusters_ask_for_a_larger_k():
    turn = np.deg2rad([0, 1, 2, 3, 50, 51, 52, 53, 140, 141, 142, 200, 201, 202, 300, 301, 302])
    with pytest.raises(InputError, match="have no path to both ends of their half; use a larger k"):
        order_by_halves(WAVES["circle"](turn), np.arange(len(turn)), k=2)


def test_paper_boundary_of_the_bunny_by_hull_test_and_halves(scan):
    points, _, truth = scan("bunny30571")
    is_found = hull_test(delaunay_star(points, nearest(points, 20)))
    members = truth[is_found[truth]]
    assert 0.2 <= len(members) / len(truth) <= 0.35
    place = np.full(len(points), -1)
    place[members] = np.arange(len(members))
    order = order_by_halves(points, np.sort(members))
    assert shares_of_steps(place[order], len(members)) == 1.0
