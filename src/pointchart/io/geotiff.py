"""Heights of GeoTIFF as points, by tifffile, which is small and reads every kind of TIFF; an extra."""

import logging

import numpy as np

from ..errors import FormatError
from .extras import extra_module
from .grids import grid_scan
from .scan import Scan
from .source import AnyPath, check_readable

# Numbers of tags (OGC GeoTIFF 1.1, annex B, and GDAL's own): size of a pixel, a pixel with its place, and no height.
_PIXEL, _TIEPOINT, _NO_DATA = 33550, 33922, 42113
_GEO_KEYS, _RASTER_TYPE, _IS_POINT = 34735, 1025, 2  # whether places are those of the middles of pixels, or corners
_MOST = 1 << 31  # pixels: a header may announce any number of them


def read_geotiff(path: AnyPath) -> Scan:
    """Read the first band of the first image: a point at the middle of each pixel, row by row."""
    check_readable(path)
    tifffile = extra_module(path, "tifffile", "tif")
    logging.getLogger("tifffile").setLevel(logging.CRITICAL)  # what it says of damaged files is said below
    try:
        with tifffile.TiffFile(path) as file:
            page = file.pages[0]
            if page.size > _MOST:
                raise FormatError(
                    f"{path}: it announces {page.size} pixels; cut it into tiles by gdal_translate -srcwin"
                )
            tags = {number: page.tags[number].value for number in _TAGS if number in page.tags}
            heights = np.asarray(page.asarray(), np.float64)
    except FormatError:
        raise
    except Exception as error:
        raise FormatError(
            f"{path}: this is no TIFF that can be read ({error}); gdal_translate -co COMPRESS=NONE writes one"
        ) from None
    heights = heights[..., 0] if heights.ndim == 3 else heights
    if heights.ndim != 2 or _PIXEL not in tags or _TIEPOINT not in tags:
        raise FormatError(
            f"{path}: an image of shape {heights.shape} without size and place of its pixels; gdal_translate -of XYZ "
            "makes a grid with them text"
        )
    column, row, _, west, north = tags[_TIEPOINT][:5]
    keys = tags.get(_GEO_KEYS, ())
    is_point = any(keys[i] == _RASTER_TYPE and keys[i + 3] == _IS_POINT for i in range(4, len(keys) - 3, 4))
    middle = 0.0 if is_point else 0.5
    x = west + tags[_PIXEL][0] * (np.arange(heights.shape[1]) - column + middle)
    y = north - tags[_PIXEL][1] * (np.arange(heights.shape[0]) - row + middle)
    return grid_scan(x, y, heights, _number(str(tags.get(_NO_DATA, ""))))


_TAGS = (_PIXEL, _TIEPOINT, _NO_DATA, _GEO_KEYS)


def _number(text: str) -> float | None:
    try:
        return float(text.strip("\0 "))
    except ValueError:
        return None
