"""What people and programs call the columns of a scan, and which of them are its coordinates."""

import re
from collections.abc import Iterable, Sequence

# A unit behind a name: in brackets of any kind, or a suffix.
_UNIT = re.compile(r"[\s_]*(?:\[.*\]|\(.*\)|(?<=[\s_])(?:m|mm|cm|km|ft|in|um|µm|meters?|metres?|feet))$")
# x alone, or with a word of place before or behind it; ParaView numbers the components of `Points`.
_PLACE = r"(?:p|pos|position|points?|coords?|coordinates?|loc|location|cartesian|vertex|scan|utm|local|global|world)"
_CARTESIAN = re.compile(rf"(?:{_PLACE}[\s_:.-]*)?([xyz])(?:[\s_:.-]*{_PLACE})?")
_COMPONENT = re.compile(rf"{_PLACE}[\s_:.-]*([012])")
# Words of surveyors, English and German; the last two rows are angles.
_SURVEY = {
    "x": ("easting", "eastings", "east", "e", "rechtswert", "ostwert"),
    "y": ("northing", "northings", "north", "n", "hochwert", "nordwert"),
    "z": ("elevation", "elev", "height", "altitude", "alt", "up", "h", "höhe", "hoehe", "depth"),
    "longitude": ("longitude", "long", "lon", "lng"),
    "latitude": ("latitude", "lat"),
}
_AXES = {word: axis for axis, words in _SURVEY.items() for word in words}


def axis_of(name: str) -> str | None:
    """Return the axis that a column is named after: x, y, z, longitude or latitude; None for any other name.

    >>> [axis_of(name) for name in ("X(mm)", "Y [m]", "z_m", "pos_x", "Points:1", "Easting", "Lat", "nx", "red")]
    ['x', 'y', 'z', 'x', 'y', 'x', 'latitude', None, None]
    """
    word = _UNIT.sub("", name.strip().lower().removeprefix("//").strip())
    if match := _CARTESIAN.fullmatch(word):
        return match[1]
    if match := _COMPONENT.fullmatch(word):
        return "xyz"[int(match[1])]
    return _AXES.get(word)


def coordinates_among(names: Sequence[str]) -> tuple[int, int, int] | None:
    """Find the columns that are named x, y and z, or after them; None unless there is just one of each.

    Names that are x, y, z to the letter go before all others.

    >>> coordinates_among(["id", "X", "Y", "Z"]), coordinates_among(["t", "North [m]", "East [m]", "Height"])
    ((1, 2, 3), (2, 1, 3))
    >>> coordinates_among(["a", "b", "c"])
    """
    for axes in ([name.strip().lower() for name in names], [axis_of(name) for name in names]):
        if all(axes.count(axis) == 1 for axis in "xyz"):
            return axes.index("x"), axes.index("y"), axes.index("z")
    return None


def angles_among(names: Sequence[str]) -> tuple[int, int] | None:
    """Find the columns that are named longitude and latitude; None unless there is one of each.

    >>> angles_among(["lat", "lon", "height"])
    (1, 0)
    """
    axes = [axis_of(name) for name in names]
    both = all(axes.count(angle) == 1 for angle in ("longitude", "latitude"))
    return (axes.index("longitude"), axes.index("latitude")) if both else None


def named_columns(coordinates: Sequence[int], names: Iterable[str]) -> list[str]:
    """Name the columns of the coordinates x, y, z, each other as given or by its number, and no two alike.

    >>> named_columns((1, 2, 3), ["id", "X", "Y", "Z"]), named_columns((0, 1, 2), [""] * 5)
    (['id', 'x', 'y', 'z'], ['x', 'y', 'z', 'column_4', 'column_5'])
    >>> named_columns((0, 1, 2), ["east", "north", "up", "x"])
    ['x', 'y', 'z', 'x_4']
    """
    axes = dict(zip(coordinates, "xyz", strict=True))
    unique: list[str] = []
    taken = set("xyz")
    for place, given in enumerate(names):
        name = given.strip() or f"column_{place + 1}"
        if place in axes:
            unique.append(axes[place])
            continue
        unique.append(f"{name}_{place + 1}" if name in taken else name)
        taken.add(unique[-1])
    return unique
