import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import clouds, seeds

from pointchart import shapes
from pointchart.points.cloud import prepare
from pointchart.points.surroundings import explore
from pointchart.points.ties import break_ties, tie_keys

HALO = 12  # spacings: the 20 nearest of the 20 nearest of every neighbour lie within

SCANS = {
    "grid": shapes.grid(60, 40).points,
    "oblong grid": shapes.grid(60, 40).points * [0.5, 1, 1],
    "noisy relief": shapes.add_noise(shapes.relief(1500, seed=2), sigma_in_spacings=0.3).points,
    "laser scan in UTM": 1e-3 * shapes.sculpture(2000).points + [5e5, 5.4e6, 120],
    "tube": shapes.tube(30, n_around=24).points,
}


def stars_of(scan, rows):
    """Return the 20 nearest, the spacing and the star of each of some rows of a scan, in these rows."""
    cloud = prepare(scan[rows])
    found, name = explore(cloud.points, keys=cloud.keys), rows[cloud.rows]
    near, star = found.around, found.star
    return {
        int(name[i]): (
            name[near.indices[near.indptr[i] : near.indptr[i + 1]]].tolist(),
            cloud.scale * found.spacing[i],
            name[star.indices[star.indptr[i] : star.indptr[i + 1]]].tolist(),
        )
        for i in range(len(name))
    }


def in_one_turn(star):
    """Begin a star with its smallest number, and go the way on which the smaller of its neighbours comes next."""
    at = star.index(min(star)) if star else 0
    turned = star[at:] + star[:at]
    return min(turned, turned[:1] + turned[:0:-1])


@pytest.mark.parametrize("name", SCANS)
@pytest.mark.parametrize("rank", [1, 2])
def test_a_part_of_a_scan_gives_the_stars_of_the_whole_to_points_whose_surroundings_it_holds(name, rank):
    scan = np.random.default_rng(0).permutation(SCANS[name])
    whole = stars_of(scan, np.arange(len(scan)))
    halo = HALO * np.median([spacing for _, spacing, _ in whole.values()])
    along = scan[:, np.argsort(np.ptp(scan, axis=0))[-rank]] if name != "tube" else scan[:, 2]
    beyond = along - np.median(along)
    for side in (beyond, -beyond):
        part = stars_of(scan, np.random.default_rng(1).permutation(np.flatnonzero(side > -halo)))
        inside = np.flatnonzero(side > 0).tolist()
        assert len(part) < len(scan)
        assert [part[i][:2] for i in inside] == [whole[i][:2] for i in inside]
        assert [in_one_turn(part[i][2]) for i in inside] == [in_one_turn(whole[i][2]) for i in inside]


@pytest.mark.parametrize("name", SCANS)
def test_stars_do_not_depend_on_the_order_of_the_rows(name):
    scan = SCANS[name]
    one = stars_of(scan, np.arange(len(scan)))
    assert stars_of(scan, np.random.default_rng(2).permutation(len(scan))) == one


@settings(max_examples=40)
@given(clouds(), seeds, st.integers(-60, 60))
def test_keys_are_of_the_point_alone_whatever_the_unit_by_powers_of_two(points, seed, exponent):
    order = np.random.default_rng(seed).permutation(len(points))[:20]
    assert np.array_equal(tie_keys(np.ldexp(points[order], exponent)), tie_keys(points)[order])


def test_positive_and_negative_zeros_have_the_same_key():
    assert len(set(tie_keys(np.array([[0.0, 2, 0], [-0.0, 2, 0], [0, 2, -0.0], [-0.0, 2, -0.0]])).tolist())) == 1


def test_keys_tell_points_apart_to_the_last_bit_and_by_the_order_of_their_coordinates():
    corner = np.stack(np.meshgrid(*[range(-9, 10, 3)] * 3), axis=-1).reshape(-1, 3) + 0.5
    points = np.r_[corner, np.nextafter(corner, 99)]
    assert len(set(tie_keys(points).tolist())) == len(points)


def test_only_points_in_one_direction_at_powers_of_two_have_one_key():
    whole = np.stack(np.meshgrid(*[range(-4, 5)] * 3), axis=-1).reshape(-1, 3)
    directions = {tuple((point // (np.gcd.reduce(point) & -np.gcd.reduce(point) or 1)).tolist()) for point in whole}
    assert len(set(tie_keys(1.0 * whole).tolist())) == len(directions)


def test_ways_are_even_in_the_cube_and_those_of_neighbours_on_a_grid_are_independent():
    points = shapes.grid(200, 200).points + 0.5
    ways = 100 * (break_ties(points, np.ones(len(points))) - points)
    assert np.abs(ways.mean(axis=0)).max() < 0.02
    assert np.allclose(np.cov(ways.T), np.eye(3) / 3, atol=0.01)
    for step in (1, 200):
        assert np.abs(np.corrcoef(ways[step:].T, ways[:-step].T)[:3, 3:]).max() < 0.03
    counts = np.histogramdd(ways, bins=[np.linspace(-1, 1, 5)] * 3)[0]
    assert counts.sum() == len(points)
    assert ((counts - counts.mean()) ** 2 / counts.mean()).sum() < 120  # chi-squared of 63 degrees, five sigma
