import numpy as np
import pytest
from measures import euler_characteristic, has_one_fan_a_point, signed_areas, sorted_edges

from pointchart import shapes
from pointchart.errors import InputError

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


@pytest.mark.parametrize("make", DISCS.values(), ids=DISCS)
def test_the_true_mesh_is_a_manifold_disc_with_every_point(make):
    shape = make()
    counts = np.unique(sorted_edges(shape.triangles), axis=0, return_counts=True)[1]
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


@pytest.mark.parametrize("make", SEEDED.values(), ids=SEEDED)
def test_the_seed_alone_decides_the_result(make):
    first, again, other = make(1), make(1), make(2)
    assert np.array_equal(first.points, again.points)
    assert np.array_equal(first.triangles, again.triangles)
    assert not np.array_equal(first.points, other.points)


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
