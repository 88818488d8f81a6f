"""Units of length."""

from ..errors import InputError

# All exact: the inch is 25.4 mm by definition. Those that STEP and IGES name both.
MILLIMETRES = {"um": 0.001, "mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}


def check_unit(unit: str) -> str:
    """Return a unit that `MILLIMETRES` knows.

    Raises
    ------
    InputError
        It is another one.

    Examples
    --------
    >>> MILLIMETRES[check_unit("in")]
    25.4
    """
    if unit not in tuple(MILLIMETRES):  # a file may hold what cannot be a key
        raise InputError(f"the unit '{unit}' is none of the {len(MILLIMETRES)} known; use {', '.join(MILLIMETRES)}")
    return unit
