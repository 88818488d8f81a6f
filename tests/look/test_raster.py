"""What is under each pixel."""

import numpy as np
import pytest

from pointchart import shapes
from pointchart.look.raster import rasterize

CAP = shapes.hemisphere(400)


def test_a_pixel_interpolates_the_place_that_it_shows():
    raster = rasterize(CAP.points, CAP.triangles, 20_000)
    height, width = raster.is_seen.shape
    left, right, bottom, top = raster.box
    row, column = np.nonzero(raster.is_seen)
    middle = np.column_stack(
        [left + (column + 0.5) * (right - left) / width, bottom + (row + 0.5) * (top - bottom) / height]
    )
    assert raster.interpolated(CAP.points)[:, :2] == pytest.approx(middle, abs=1e-9)
