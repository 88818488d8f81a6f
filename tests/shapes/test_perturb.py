import numpy as np
import pytest
from measures import euler_characteristic, has_one_fan_a_point, signed_areas
from scipy.spatial import cKDTree

from pointchart import shapes
from pointchart.shapes import Shape

PIERCED = {
    "disc": lambda n_gaps: shapes.pierce(shapes.disc(1500, seed=1), n_gaps=n_gaps, seed=1),
    "relief": lambda n_gaps: shapes.pierce(shapes.relief(1500), n_gaps=n_gaps, radius_in_spacings=3),
    "graded disc": lambda n_gaps: shapes.pierce(shapes.grade(shapes.disc(1500)), n_gaps=n_gaps, radius_in_spacings=3),
    "sphere": lambda n_gaps: shapes.pierce(shapes.sphere(1000), n_gaps=n_gaps, radius_in_spacings=3),
    "torus": lambda n_gaps: shapes.pierce(shapes.torus(64, 24), n_gaps=n_gaps, radius_in_spacings=3),
}


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
