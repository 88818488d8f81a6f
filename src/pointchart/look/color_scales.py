"""From numbers to colours: where a scale begins and ends, and how it is shown."""

from typing import Any

import numpy as np

from ..errors import InputError
from ..typing import Floats, Indices
from .paint import ACCENT, FAINT, INK, STEEL, STONE

LITTLE_TO_MUCH = [FAINT, STEEL, INK]  # from light to dark, so that a print in gray tells as much
# The same for a screen, where it is shaded besides: through more hues, which are told apart in the shade, too.
PALE_TO_DARK = ["#f6ead2", "#c9d6a3", "#61a5a9", "#2a6f97", "#1d3557"]
# Blue below and red above, in tones that grow as dark on both sides: seen in gray, large stays large.
BELOW_AND_ABOVE = ["#12344f", "#2a6f97", "#8fbcd4", "#f4efe4", "#eba98f", ACCENT, "#7a2416"]
OUTERMOST = 1.0  # per cent of the values at either end that a scale from little to much leaves out: outliers
LARGE_RATIO = 30.0  # of the ends of a scale, from which on it is logarithmic, as small values would be one colour
STEPS = np.array([1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])  # numbers that read well, to end a scale at


def color_map(colors: list[str]) -> Any:
    """Return matplotlib's map through colours; that of not-a-number is stone."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("through colours", colors).with_extremes(bad=tuple(STONE.tolist()))


def sequential(values: Floats, name: str) -> Any:
    """Return a map from numbers to colours, from little to much, whose ends leave out one per cent each.

    Raises
    ------
    InputError
        If no value is finite.
    """
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    known = values[np.isfinite(values)]
    if len(known) == 0:
        raise InputError(f"none of the {len(values)} values of '{name}' is finite; choose another colour")
    low, high = np.percentile(known, [OUTERMOST, 100.0 - OUTERMOST])
    high = high if high > low else low + (abs(low) or 1.0)
    ends = LogNorm if is_logarithmic(low, high) else Normalize
    return ScalarMappable(ends(low, high), color_map(LITTLE_TO_MUCH))


def diverging(reach: float) -> Any:
    """Return a map from numbers to colours, cold below 0 and warm above."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    return ScalarMappable(Normalize(-reach, reach), color_map(BELOW_AND_ABOVE))


def is_logarithmic(low: float, high: float) -> bool:
    """Return whether a scale with these ends tells ratios rather than differences."""
    return low > 0.0 and high > LARGE_RATIO * low


def rgb(scale: Any, values: Floats) -> Floats:
    """Return the colours of numbers, (n, 3), from 0 to 1."""
    return np.asarray(scale.to_rgba(values)[:, :3])


def style_bar(bar: Any, label: str, *, size: float) -> None:
    """Give a colour bar numbers in three digits, a label and no frame; its colours are one image, not many boxes."""
    from matplotlib.ticker import FuncFormatter

    bar.formatter = FuncFormatter(lambda x, _: number(x))
    bar.set_label(label, color=INK, fontsize=size)
    for axis in (bar.ax.xaxis, bar.ax.yaxis):  # names of files' properties are no TeX
        axis.label.set_parse_math(False)
    bar.ax.tick_params(colors=INK, labelsize=size)
    bar.outline.set_visible(False)
    bar.solids.set_rasterized(True)


def number(x: float) -> str:
    """Write a number in three digits.

    Examples
    --------
    >>> number(0.012345), number(12345.6)
    ('0.0123', '12,346')
    """
    return f"{x:{'.3g' if abs(x) < 1000.0 or abs(x) >= 1e6 else ',.0f'}}".replace("-", "\N{MINUS SIGN}")


def round_up(reach: float) -> float:
    """Return the next number that reads well, from which a scale can end.

    Examples
    --------
    >>> round_up(0.0173), round_up(2.0)
    (0.02, 2.0)
    """
    power = 10.0 ** np.floor(np.log10(reach))
    return float(f"{STEPS[np.searchsorted(STEPS, reach / power * (1.0 - 1e-9))] * power:.2g}")


def counted(values: Floats, low: float, high: float, bars: int) -> tuple[Indices, Floats]:
    """Count values in bars of one width from `low` to `high`; those beyond are in the outermost.

    Returns
    -------
    counts : (bars,) int64 array
    edges : (bars + 1,) float64 array

    Examples
    --------
    >>> counted(np.array([-7.0, 0.1, 0.9, 1.0]), 0.0, 1.0, 2)
    (array([2, 2]), array([0. , 0.5, 1. ]))
    """
    counts, edges = np.histogram(np.clip(values, low, high), bins=bars, range=(low, high))
    return counts, edges
