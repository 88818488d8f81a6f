"""What a mesh can be coloured by: one number a point."""

from dataclasses import dataclass

import numpy as np

from ...boundary.bounded import survey_scan
from ...mesh.distortion import vertex_stretches
from ...mesh.quality import heights
from ...typing import UV, Floats, Loop, Points, Triangles

SAME = 1e-9  # of the values: what measures differ by on a plane or an even grid, which would fill the whole scale
OUTERMOST = 2.0  # per cent of the points at either end, which colours do not tell apart


@dataclass(frozen=True, slots=True, eq=False)
class Shade:
    """A measure at each point, and how it is shown.

    Attributes
    ----------
    name, meaning : str
    values : (n,) float64
    is_signed : bool
        Whether 0 is in the middle of the colours.
    is_log : bool
        Whether equal ratios look equally far apart.
    """

    name: str
    meaning: str
    values: Floats
    is_signed: bool = False
    is_log: bool = False

    @property
    def placed(self) -> Floats:
        """The values on the scale that is shown, (n,): themselves, or their logarithms."""
        return np.log(np.maximum(self.values, 1e-300)) if self.is_log else self.values

    @property
    def reach(self) -> tuple[float, float]:
        """Where on that scale the colours begin and end.

        >>> Shade("height", "", np.array([-1.0, 0.0, 3.0]), is_signed=True).reach[0] < -2.8
        True
        """
        low, high = np.percentile(self.placed, [OUTERMOST, 100.0 - OUTERMOST]).tolist()
        if self.is_signed:
            high = max(abs(low), abs(high))
            low = -high
        # Values that differ by rounding alone are one colour.
        room = SAME * max(abs(low), abs(high), 1e-300)
        return (low, high) if high - low > room else (low - max(room, 0.5), high + max(room, 0.5))


def mesh_shades(
    points: Points, triangles: Triangles, uv: UV, loop: Loop, *, deviation: Floats | None = None
) -> list[Shade]:
    """Measure what a mesh is coloured by: deviation, stretch, spacing and boundary score.

    Parameters
    ----------
    points : (n, 3) array
        Distinct points.
    triangles : (m, 3) int array
    uv : (n, 2) array
    loop : (b,) int array
    deviation : (n,) array, optional
        Signed, from a surface that was fitted; from the plane of a point's neighbours, if not given.

    Returns
    -------
    list of Shade

    Examples
    --------
    >>> from pointchart import reconstruct, shapes
    >>> sheet = shapes.grid(12, 9).points
    >>> made = reconstruct(sheet)
    >>> deviation, *others = mesh_shades(sheet, made.triangles, made.uv, made.loop)
    >>> bool(abs(deviation.values).max() < 1e-12), [shade.name for shade in others]
    (True, ['stretch', 'spacing', 'boundary score'])
    """
    survey = survey_scan(points, loop)
    near, places, scale = survey.vicinity, survey.cloud.places, survey.cloud.scale
    meaning = "from the surface, positive on the side of its normal"
    if deviation is None:
        off = scale * (survey.cloud.points - near.smoothed)[places]
        deviation = heights(points, triangles, off)
        meaning = "height over the plane of its neighbours"
    return [
        Shade("deviation", meaning, deviation, is_signed=True),
        Shade(
            "stretch",
            "of the map from the plane to space, logarithmic; 1 is none",
            vertex_stretches(points, triangles, uv),
            is_log=True,
        ),
        Shade(
            "spacing",
            "median distance to the six nearest points, logarithmic",
            scale * near.spacing[places],
            is_log=True,
        ),
        Shade("boundary score", "0 inside, 1 on the boundary", survey.score().total[places]),
    ]
