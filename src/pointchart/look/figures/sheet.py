"""The sheet of a figure: its size in millimetres, its one panel, its scale of colours."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ...io import check_output
from ...io.source import AnyPath
from ...typing import Floats
from ..color_scales import is_logarithmic, sequential, style_bar
from ..paint import FAINT, PICTURE_SUFFIXES

MILLIMETRE = 1.0 / 25.4  # in inches
MARGIN, BAR_ROOM, MOST_HEIGHT = 1.0, 11.0, 240.0  # in millimetres: a page of most journals is 240 high within its rims
FLATTEST = 0.05  # height of a panel over its width: below, a line of text is higher
MOST_PIXELS = 3_000_000  # of an image, which has up to twice as many each way as are printed
LABEL = 7.0  # points: the least that most journals ask for


@dataclass(frozen=True, slots=True)
class Sheet:
    """What a figure is drawn on.

    Attributes
    ----------
    width : float
        In millimetres: 85 is a column of most journals, 170 a page.
    dpi : float
        Pixels an inch of a PNG, and of the images in SVG and PDF.
    is_transparent : bool
        Whether the figure has no white ground.
    """

    width: float = 85.0
    dpi: float = 300.0
    is_transparent: bool = False


COLUMN = Sheet()  # of a journal: what is drawn on where nothing else is said


@dataclass(frozen=True, slots=True)
class Panel:
    """The figure and its places: where to draw, how many points (1/72 inch) wide and high that is, the colour bar."""

    figure: Any
    axes: Any
    size: tuple[float, float]
    bar: Any


def check_sheet(path: AnyPath, sheet: Sheet) -> None:
    """Check before the work that a figure can be written.

    Raises
    ------
    FormatError
        If the file is none of `PICTURE_SUFFIXES`, or its folder is missing or cannot be written to.
    InputError
        If the sheet is too small or too large.
    """
    check_output(path, suffixes=PICTURE_SUFFIXES)
    if not 20.0 <= sheet.width <= 1000.0:
        raise InputError(f"the figure is {sheet.width:g} mm wide; take 20 to 1000, such as 85 for a column")
    if not 50.0 <= sheet.dpi <= 2400.0:
        raise InputError(f"the figure has {sheet.dpi:g} pixels an inch; take 50 to 2400, such as 300 for print")


def lay_out(sheet: Sheet, seen: Floats, *, has_bar: bool = False) -> Panel:
    """Make a figure that frames places of the plane, (n, 2), as wide as the sheet and as high as they need.

    What would be higher than a page is drawn smaller.
    """
    from matplotlib.figure import Figure

    low, high = seen.min(axis=0), seen.max(axis=0)
    sides = np.maximum(high - low, FLATTEST * (high - low).max())
    middle, room = (low + high) / 2.0, sheet.width - 2.0 * MARGIN
    tall = min(room * float(sides[1] / sides[0]), MOST_HEIGHT)
    below = BAR_ROOM if has_bar else 0.0
    height = tall + 2.0 * MARGIN + below
    # A hundredth of a pixel more, since the number of pixels is rounded down.
    wide, high = ((round(side * MILLIMETRE * sheet.dpi) + 0.01) / sheet.dpi for side in (sheet.width, height))
    figure = Figure(figsize=(wide, high), facecolor="none" if sheet.is_transparent else "white")
    axes = figure.add_axes((0.0, below / height, 1.0, 1.0 - below / height))
    scale = float(max(sides[0] / room, sides[1] / tall))
    reach = scale * np.array([sheet.width, height - below]) / 2.0
    axes.set(xlim=middle[0] + [-reach[0], reach[0]], ylim=middle[1] + [-reach[1], reach[1]])
    axes.set_axis_off()
    bar = figure.add_axes((0.2, (below - 2.0) / height, 0.6, 2.0 / height)) if has_bar else None
    return Panel(figure, axes, (72.0 * room * MILLIMETRE, 72.0 * tall * MILLIMETRE), bar)


def image_pixels(panel: Panel, sheet: Sheet) -> int:
    """Return how many pixels an image that fills a panel has."""
    wide, high = (2.0 * side * sheet.dpi / 72.0 for side in panel.size)
    return round(min(wide * high, MOST_PIXELS))


def show_scale(panel: Panel, scale: Any, label: str, ticks: list[float] | None = None) -> None:
    """Draw a scale of colours into its place, with ticks where they are given."""
    from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator

    bar = panel.figure.colorbar(scale, cax=panel.bar, orientation="horizontal", extend="both")
    low, high = scale.get_clim()
    bar.ax.xaxis.set_minor_locator(NullLocator())
    if ticks is not None:
        bar.set_ticks(ticks)
    else:
        bar.locator = LogLocator(numticks=4) if is_logarithmic(low, high) else MaxNLocator(4)
    style_bar(bar, label, size=LABEL)
    bar.update_ticks()
    bar.ax.tick_params(length=2.0, width=0.4, pad=1.5, color=FAINT)
    bar.ax.xaxis.labelpad = 1.5


def show_values(panel: Panel, values: Floats, label: str) -> Any:
    """Choose a scale of colours for values, and draw it into its place."""
    scale = sequential(values, label)
    show_scale(panel, scale, label)
    return scale


def check_values(values: ArrayLike, n_points: int, label: str) -> Floats:
    """Return the values of points as (n,) float64; not-a-number is allowed.

    Raises
    ------
    InputError
        If they are no numbers, or there is not one for each point.
    """
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError) as reason:
        raise InputError(f"'{label}' is no array of numbers ({reason}); choose another colour") from None
    if array.shape != (n_points,):
        raise InputError(f"'{label}' has shape {array.shape}, but there are {n_points} points; give one value for each")
    return array
