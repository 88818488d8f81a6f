"""How far the points of a scan lie from a surface."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from .._check import check_points, check_uv
from ..errors import InputError
from ..typing import Floats
from .derivatives import Surface, evaluate, normals


@dataclass(frozen=True, slots=True, eq=False)
class Deviation:
    """Distances of the points of a scan from their feet on a surface.

    Attributes
    ----------
    signed : (n,) float64
        In the unit of the scan, positive on the side to which the normal s_u x s_v points.

    Examples
    --------
    >>> deviation = Deviation(np.array([3.0, -4.0, 0.0, 0.0]))
    >>> deviation.rms, deviation.largest(), deviation.largest(outliers=0.25), deviation.percentile(50)
    (2.5, 4.0, 3.0, 1.5)
    """

    signed: Floats

    @property
    def rms(self) -> float:
        """Root of the mean square."""
        largest = self.largest()
        # Squares of the share of the largest one neither overflow nor vanish.
        return largest * float(np.sqrt(np.mean((self.signed / (largest or 1.0)) ** 2)))

    def largest(self, outliers: float = 0.0) -> float:
        """Return the largest absolute deviation but for a share of the points, those that deviate most.

        As many points are left out as the share makes, rounded down. The share counts as the decimal that is written:
        0.29 of 100 points are 29.

        Raises
        ------
        InputError
            If the share is not from 0 up to but not including 1.
        """
        if not 0.0 <= outliers < 1.0:
            raise InputError(f"the share of outliers is {outliers}; take at least 0 and less than 1")
        place = len(self.signed) - 1 - int(Fraction(str(outliers)) * len(self.signed))
        return float(np.partition(np.abs(self.signed), place)[place])

    def percentile(self, q: float) -> float:
        """Return what `q` per cent of the absolute deviations do not exceed, by linear interpolation between two."""
        return float(np.percentile(np.abs(self.signed), q))


def measure_deviation(points: ArrayLike, surface: Surface, uv: ArrayLike) -> Deviation:
    r"""Measure the signed distance of points from their feet on a surface.

    .. math:: d_i = \pm |x_i - s(u_i, v_i)|, \quad \text{negative where } (x_i - s) \cdot (s_u \times s_v) < 0

    It is the distance from the surface if the feet are the closest points. Where the surface is singular and has no
    normal, it counts as positive.

    Parameters
    ----------
    points : (n, 3) array
        The scan.
    surface : Surface
    uv : (n, 2) array
        Parameters of the foot of each point.

    Returns
    -------
    Deviation

    Raises
    ------
    InputError
        If there are not as many feet as points, or some are NaN or infinite.

    Examples
    --------
    >>> from pointchart.surface import BSplineSurface
    >>> corners = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    >>> square = BSplineSurface(1, np.array([0.0, 0, 1, 1]), np.array([0.0, 0, 1, 1]), corners)
    >>> feet = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])
    >>> measure_deviation([[0, 0, 2], [1, 0, -3], [0, 1, 0], [1, 1, 1]], square, feet).signed
    array([ 2., -3.,  0.,  1.])
    """
    cloud = check_points(points)
    feet = check_uv(uv, len(cloud))
    offsets = cloud - evaluate(surface, feet)
    distance = np.linalg.norm(offsets, axis=1)
    is_behind = (offsets * normals(surface, feet)).sum(axis=1) < 0.0
    return Deviation(np.where(is_behind, -distance, distance))


def deviation_table(deviation: Deviation, outliers: float = 0.0, *, tolerance: float) -> list[tuple[str, float]]:
    """Return the figures of a deviation by name, in the unit of the scan but for the last, a share from 0 to 1.

    Parameters
    ----------
    deviation : Deviation
    outliers : float
        Share of the points that the second row leaves out.
    tolerance : float
        Absolute deviation that is allowed, itself included.

    Returns
    -------
    list of (str, float)

    Examples
    --------
    >>> deviation = Deviation(np.array([3.0, -4.0, 0.0, 0.0]))
    >>> for name, figure in deviation_table(deviation, 0.25, tolerance=3.0):
    ...     print(f"{name}: {figure:.2f}")
    max: 4.00
    max but for 25 %: 3.00
    95 %: 3.85
    RMS: 2.50
    mean: -0.25
    within 3: 0.75
    """
    return [
        ("max", deviation.largest()),
        (f"max but for {100.0 * outliers:g} %", deviation.largest(outliers)),
        ("95 %", deviation.percentile(95.0)),
        ("RMS", deviation.rms),
        ("mean", float(deviation.signed.mean())),
        (f"within {tolerance:g}", float(np.mean(np.abs(deviation.signed) <= tolerance))),
    ]
