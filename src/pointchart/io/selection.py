"""Which rows of a scan are points of the surface: no no-returns, and of the classes that are asked for."""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..errors import InputError, Remedy, name_some
from ..typing import Indices
from .scan import Scan

# The origin is away from a surface if it is farther from its nearest point than this many times the distance from there
# to the sixth neighbour, which are as many as surround a point of an even sample.
_AWAY, _AROUND = 2.0, 7
# What programs call the class of a point: LAS dimensions, and scalar fields of CloudCompare.
CLASS_NAMES = ("classification", "scalar_classification", "raw_classification", "class")


def usable_rows(
    scan: Scan, *, classes: Collection[int] | None = None, drop_invalid: bool = False
) -> tuple[Indices, list[str]]:
    """Choose the rows of a scan that are points, and say in a sentence each what is left out.

    Parameters
    ----------
    scan : Scan
    classes : collection of int, optional
        The classes of points to keep, such as 2 for ground in LAS; all, if not given.
    drop_invalid : bool
        Leave out rows with coordinates that are no numbers, and rows of exactly 0 0 0 if there are several and the
        origin is away from all others, whatever the format. Rows that the format itself calls no points are always
        left out.

    Returns
    -------
    rows : (k,) int64
        In the order of the scan.
    notes : list of str

    Raises
    ------
    InputError
        If rows are no points and are not to be left out, if no row is left, or the scan has no classes.

    Examples
    --------
    >>> points = np.array([[1.0, 2.0, 3.0], [np.nan, 0.0, 0.0], [4.0, 5.0, 6.0]])
    >>> rows, notes = usable_rows(Scan(points, np.empty((0, 3), np.int64), {}), drop_invalid=True)
    >>> rows.tolist(), notes
    ([0, 2], ['1 row without coordinates left out'])
    """
    keep, notes = np.ones(len(scan.points), bool), []
    if scan.valid is not None:
        keep &= scan.valid
    for is_none, what in ((_without_coordinates(scan), "without coordinates"), (_no_returns(scan), "of exactly 0 0 0")):
        which = np.flatnonzero(is_none & keep)
        if len(which) and not drop_invalid:
            raise InputError(
                f"there {'is' if len(which) == 1 else 'are'} {_count(len(which))} {what}, the first is row {which[0]}, "
                "as where nothing was measured",
                remedies=[Remedy.leave_out_invalid],
            )
        if len(which):
            notes.append(f"{_count(len(which))} {what} left out")
        keep[which] = False
    of_class, said = _of_classes(scan, keep, classes)
    keep &= of_class
    if len(keep) and not keep.any():
        raise InputError(
            f"none of the {len(keep)} rows is a point to keep ({'; '.join(notes + said) or 'all invalid'})"
        )
    return np.flatnonzero(keep), notes + said


def classes_in(scan: Scan, rows: Indices) -> str | None:
    """Write the classes of rows with their numbers, as 2 (751), 5 (250); None if there is one or none is told."""
    name = _class_name(scan)
    if name is None:
        return None
    found, counts = np.unique(scan.attributes[name][rows], return_counts=True)
    listed = ", ".join(f"{value:g} ({count})" for value, count in zip(found.tolist(), counts.tolist(), strict=True))
    return listed if len(found) > 1 else None


def _class_name(scan: Scan) -> str | None:
    return next((name for name in scan.attributes if name.lower() in CLASS_NAMES), None)


def _without_coordinates(scan: Scan) -> NDArray[np.bool_]:
    return np.asarray(~np.isfinite(scan.points).all(axis=1))


def _no_returns(scan: Scan) -> NDArray[np.bool_]:
    """Tell which rows are exactly 0 0 0, if several are and the origin is away from all others: as no-returns are."""
    is_zero = np.asarray((scan.points == 0.0).all(axis=1))
    others = scan.points[~is_zero & np.isfinite(scan.points).all(axis=1)]
    if np.count_nonzero(is_zero) < 2 or len(others) < 2:
        return np.zeros_like(is_zero)
    tree = cKDTree(others)
    to_nearest, nearest = tree.query(np.zeros(3))
    spacing = tree.query(others[nearest], k=[min(_AROUND, len(others))])[0][0]
    return np.asarray(is_zero & (to_nearest > _AWAY * spacing))


def _count(n_rows: int) -> str:
    return "1 row" if n_rows == 1 else f"{n_rows} rows"


def _of_classes(
    scan: Scan, keep: NDArray[np.bool_], classes: Collection[int] | None
) -> tuple[NDArray[np.bool_], list[str]]:
    """Tell which rows are of the classes asked for; without a question, name the classes if there are several."""
    name = _class_name(scan)
    everything = np.ones(len(keep), bool)
    if name is None:
        if classes is not None:
            raise InputError(
                f"the scan has no classes among what it carries ({', '.join(scan.attributes) or 'nothing'}); "
                "choose no classes"
            )
        return everything, []
    rows = np.flatnonzero(keep)
    listed = classes_in(scan, rows)
    if classes is None:
        return everything, [] if listed is None else [f"the scan holds points of classes {listed}"]
    chosen = np.isin(scan.attributes[name], list(classes))
    missing = [one for one in classes if not (chosen & (scan.attributes[name] == one) & keep).any()]
    held = listed or f"{scan.attributes[name][rows[0]]:g} alone"
    if missing:
        raise InputError(f"the scan has no point of class {name_some(missing)}; it has classes {held}")
    return chosen, [f"{np.count_nonzero(keep & ~chosen)} points of other classes left out; the scan holds {held}"]
