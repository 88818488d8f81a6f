import numpy as np
import pytest

from pointchart import InputError, PointchartError, reconstruct, shapes


@pytest.mark.parametrize("closed", [shapes.sphere(1000), shapes.torus(64, 24)], ids=["sphere", "torus"])
@pytest.mark.parametrize("sigma", [0, 0.1, 0.25, 0.5])
def test_a_closed_surface_is_refused_as_closed(closed, sigma):
    with pytest.raises(
        InputError, match=r"no boundary was found: .* closed surface; give the boundary, or cut the scan open"
    ):
        reconstruct(shapes.add_noise(closed, sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("size", [(64, 24), (96, 32)])
@pytest.mark.parametrize("sigma", [0, 0.25, 0.5])
def test_a_torus_with_a_gap_is_refused(size, sigma):
    scan = shapes.pierce(shapes.torus(*size), n_gaps=1, radius_in_spacings=4)
    with pytest.raises(PointchartError, match="the surface is no disc"):
        reconstruct(shapes.add_noise(scan, sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("apart", [(0, 0, 100), (40, 0, 0)])
def test_two_sheets_are_refused_with_the_sizes_and_a_point_of_each(apart):
    points = np.r_[shapes.grid(12, 9).points, shapes.grid(8, 7).points + np.array(apart)]
    with pytest.raises(InputError, match="2 separate parts, of 108 and 56 points") as caught:
        reconstruct(points)
    first, second = caught.value.points["seeds"]
    assert first < 108 <= second


@pytest.mark.parametrize(
    "strip",
    [
        {},
        {"n_around": 64, "n_across": 7},
        {"n_around": 96, "n_across": 5, "width": 0.3},
        {"n_around": 128, "n_across": 13, "width": 0.8},
        {"n_around": 64, "n_across": 11, "width": 1.2},
        {"n_around": 80, "n_across": 16, "width": 1.6},
    ],
    ids=str,
)
@pytest.mark.parametrize("sigma", [0, 0.4])
def test_a_moebius_strip_is_refused(strip, sigma):
    with pytest.raises(PointchartError, match=r"no disc|no boundary was found"):
        reconstruct(shapes.add_noise(shapes.moebius(**strip), sigma_in_spacings=sigma).points)


@pytest.mark.parametrize("name", ["x_annulus", "x_closed_hand", "x_torus", "x_two_feet"])
def test_real_scans_of_no_disc_are_refused(name, request):
    folder = request.path.parents[3] / "shared" / "data" / name
    if not folder.is_dir():
        pytest.skip(f"the real scan {name} is not in {folder.parent}")
    from pointchart import read_scan

    with pytest.raises(PointchartError, match=r"no disc|no boundary was found|separate parts"):
        reconstruct(read_scan(folder / "points.ply").points)


@pytest.mark.parametrize(
    ("shape", "loop"),
    [
        (shapes.moebius(64, 7), shapes.moebius(64, 7).boundary),
        (shapes.torus(64, 24), 64 * np.arange(24)),
        (shapes.torus(64, 24), np.arange(64)),
    ],
    ids=["Moebius strip", "torus cut across", "torus cut along"],
)
def test_a_surface_that_is_no_disc_is_refused_even_with_a_boundary_given(shape, loop):
    with pytest.raises(PointchartError, match="no disc"):
        reconstruct(shape.points, loop)
