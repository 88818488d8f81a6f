"""Ink, paper and light: what a scan, a mesh or an image looks like on matplotlib's axes, and how it is written."""

from pathlib import Path
from typing import Any

import numpy as np

from ..io import replacing
from ..mesh.quality import unit_normals
from ..typing import UV, Floats, Mask, Points, Triangles
from .raster import Box

# Ground, thin lines, what is shown, text, and what stands out: of pictures, figures, pages and the site.
PAPER, FAINT, STEEL, INK, ACCENT = "#fbfaf7", "#ccd6d8", "#3a8fb7", "#22303c", "#c8553d"
# Of a surface without a meaning of its colour, outside and inside: unlike in tone, as bright as plaster.
STONE, INSIDE = np.array([0.83, 0.77, 0.68]), np.array([0.78, 0.49, 0.40])

LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])  # from the upper left, as maps are lit
BRIGHTEST = 0.85  # cosine of the angle to the light within which places have their full colour
BEHIND = 0.6  # brightness of what turns its back to us over that of what faces us
# Light that reaches what faces away from it, of the whole: the more a colour means, the less light may change it.
SHAPED, COLORED, STRIPED = 0.4, 0.62, 0.8

MOST_SHAPES = 20_000  # points or triangles of a drawing; more become an image in it, so that files stay small
# What makes a file the same on each run: by itself, matplotlib writes when it was made.
UNDATED: dict[str, dict[str, None]] = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
PICTURE_SUFFIXES = tuple(UNDATED)
# Ids that are the same twice, text that can be searched, and fonts as outlines that journals take (TrueType).
WRITTEN: dict[Any, Any] = {"svg.hashsalt": "pointchart", "svg.fonttype": "none", "pdf.fonttype": 42}
SCREEN = 110.0  # pixels an inch of pictures that are looked at on a screen: 15 inches fill one


def paint_wires(axes: Any, uv: UV, triangles: Triangles, *, line_width: float) -> None:
    """Draw the edges of a triangulation of the plane."""
    lines, _ = axes.triplot(*uv.T, triangles, color=INK, linewidth=line_width, solid_capstyle="butt")
    lines.set_rasterized(len(triangles) > MOST_SHAPES)


def paint_loop(axes: Any, corners: UV, *, line_width: float, color: str = ACCENT) -> None:
    """Draw a closed polygon of the plane."""
    closed = np.append(corners, corners[:1], axis=0)
    axes.plot(closed[:, 0], closed[:, 1], color=color, linewidth=line_width)


def paint_triangles(
    axes: Any, turned: Points, triangles: Triangles, colors: Floats, *, line_width: float, line_tint: float = 1.0
) -> None:
    """Paint triangles from back to front, of one colour or each of its own; edges are darker by `line_tint`."""
    from matplotlib.collections import PolyCollection

    order = np.argsort(turned[triangles, 2].mean(axis=1))
    corner = turned[triangles[order]]
    faces = shaded(unit_normals(turned, triangles[order]), colors[order] if colors.ndim == 2 else colors)
    painted = PolyCollection(
        list(corner[:, :, :2]), facecolors=faces, edgecolors=line_tint * faces, linewidths=line_width
    )
    painted.set_rasterized(len(triangles) > MOST_SHAPES)
    axes.add_collection(painted)


def paint_image(axes: Any, is_seen: Mask, colors: Floats, box: Box) -> None:
    """Show an image by the colours, (k, 3), of its pixels that are seen, (h, w); the others are transparent.

    Its first row is the lowest; the box is left, right, bottom and top.
    """
    image = np.zeros((*is_seen.shape, 4))
    image[is_seen, :3] = np.clip(colors, 0.0, 1.0)
    image[is_seen, 3] = 1.0
    axes.imshow(image, extent=box, origin="lower", interpolation="hanning", interpolation_stage="rgba")
    axes.set_axis_off()


def shaded(turned: Points, colors: Floats) -> Floats:
    """Return colours as they are lit on places of given normals, (k, 3); what turns its back to us is `INSIDE`.

    Colours that differ, (k, 3), mean something, so that they are shaded less than one for all places, (3,).
    """
    is_back = turned[:, 2:] < 0.0
    brightness = lit(np.where(is_back, -turned, turned), ambient=COLORED if colors.ndim == 2 else SHAPED)
    return np.asarray(np.where(is_back, INSIDE, colors) * brightness[:, None])


def lit(turned: Floats, *, ambient: float) -> Floats:
    """Return the brightness of places by their normals, (k,); the back is darker, and places without one are dark.

    Examples
    --------
    >>> lit(np.array([LIGHT, [0.0, 0.0, -1.0]]), ambient=0.5).tolist()
    [1.0, 0.3]
    """
    shade = ambient + (1.0 - ambient) * np.clip(turned @ LIGHT / BRIGHTEST, 0.0, 1.0)
    return np.asarray(np.where(turned[:, 2] < 0.0, BEHIND, 1.0) * np.nan_to_num(shade, nan=ambient))


def mixed(share: Floats, one: Any, other: Any) -> Floats:
    """Mix two colours, (n, 3), by the share of the first, (n,).

    Examples
    --------
    >>> mixed(np.array([1.0, 0.5]), "white", "black").tolist()
    [[1.0, 1.0, 1.0], [0.5, 0.5, 0.5]]
    """
    from matplotlib.colors import to_rgb

    part = share[:, None]
    return np.asarray(part * np.array(to_rgb(one)) + (1.0 - part) * np.array(to_rgb(other)))


def save(figure: Any, path: Path, *, dpi: float = SCREEN) -> None:
    """Write a picture, whole or not at all, in the format of the suffix; text stays text, and bytes are the same twice.

    Parameters
    ----------
    figure : Figure
    path : Path
        A file of one of `PICTURE_SUFFIXES`.
    dpi : float
        Pixels an inch of a PNG, and of the images in the other formats.
    """
    from matplotlib import rc_context

    kind = path.suffix.lower()
    with replacing(path) as temporary, rc_context(WRITTEN):
        figure.savefig(temporary, dpi=dpi, format=kind.removeprefix("."), metadata=UNDATED[kind])
