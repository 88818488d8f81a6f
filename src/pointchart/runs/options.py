"""Options of a run: each is a field of a frozen record, described there once for the command line and the app."""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from enum import StrEnum
from types import NoneType
from typing import Any, TypeVar, get_args, get_type_hints

Record = TypeVar("Record")


class Group(StrEnum):
    """What options are about: the sections of the help, in order."""

    input = "Input"
    boundary = "Boundary and topology"
    mesh = "Mesh"
    parameters = "Parameters"
    methods = "The paper's methods"
    surface = "Surface"
    figure = "Figure"
    output = "Output"
    running = "Running"


@dataclass(frozen=True, slots=True)
class Option:
    """An option of a run, or an argument if it has no flags.

    Attributes
    ----------
    name : str
        Of the field, in the record or one that it holds.
    kind : type
        Path, str, int, float, bool or an enum of words.
    default : object
        ``dataclasses.MISSING`` if it has to be given, None if the library chooses.
    flags : tuple of str
        The long one first; ``--yes/--no`` for a switch of two words.
    help : str
    group : Group
    metavar : str or None
    least, most : float or None
        Bounds of a number, themselves allowed.
    is_input : bool
        Whether it names a file that is read.

    Examples
    --------
    >>> from pointchart.runs.mesh_run import MeshRun
    >>> holes = next(option for option in options_of(MeshRun) if option.name == "holes")
    >>> holes.flags, holes.choices, holes.default
    (('--holes',), ('bridge', 'open'), None)
    """

    name: str
    kind: type
    default: Any
    flags: tuple[str, ...]
    help: str
    group: Group
    metavar: str | None
    least: float | None
    most: float | None
    is_input: bool

    @property
    def is_required(self) -> bool:
        """Whether it has to be given."""
        return self.default is MISSING

    @property
    def is_switch(self) -> bool:
        """Whether it is given without a word."""
        return self.kind is bool

    @property
    def choices(self) -> tuple[str, ...]:
        """Its words, if not any will do."""
        return tuple(map(str, self.kind)) if issubclass(self.kind, StrEnum) else ()


def option(
    *flags: str,
    help: str,
    group: Group,
    default: Any = MISSING,
    metavar: str | None = None,
    least: float | None = None,
    most: float | None = None,
    is_input: bool = False,
) -> Any:
    """Describe a field that is an option; see `Option`. Without a default it has to be given."""
    told = {"flags": flags, "help": help, "group": group, "metavar": metavar}
    return field(default=default, metadata=told | {"least": least, "most": most, "is_input": is_input})


def argument(metavar: str, help: str, *, is_input: bool = True) -> Any:
    """Describe a field that stands on the command line without a flag."""
    return option(help=help, group=Group.input, metavar=metavar, is_input=is_input)


def options_of(record: type) -> tuple[Option, ...]:
    """Return the options of a record and of the records that it holds, in their order."""
    hints = get_type_hints(record)
    found: list[Option] = []
    for one in fields(record):
        hint = hints[one.name]
        if is_dataclass(hint):
            found += options_of(hint)  # type: ignore[arg-type]
        else:
            kind = next((kind for kind in get_args(hint) if kind is not NoneType), hint)
            found.append(Option(name=one.name, kind=kind, default=one.default, **one.metadata))
    return tuple(found)


def values_of(record: Any) -> dict[str, Any]:
    """Return the values of all options of a record by their names.

    Examples
    --------
    >>> from pointchart.runs.shared_options import ConvexDomain
    >>> values_of(ConvexDomain())["corners"] is None
    True
    """
    values: dict[str, Any] = {}
    for one in fields(record):
        value = getattr(record, one.name)
        values |= values_of(value) if is_dataclass(value) else {one.name: value}
    return values


def record_of(record: type[Record], values: Mapping[str, Any]) -> Record:
    """Return a record with the values given, defaults for the rest.

    Examples
    --------
    >>> from pointchart.runs.demo_run import DemoRun
    >>> record_of(DemoRun, {"quiet": True}).running.quiet
    True
    """
    hints, given = get_type_hints(record), {}
    for one in fields(record):  # type: ignore[arg-type]
        hint = hints[one.name]
        if is_dataclass(hint):
            given[one.name] = record_of(hint, values)  # type: ignore[arg-type]
        elif one.name in values:
            given[one.name] = values[one.name]
    return record(**given)


def changed(record: Record, **values: Any) -> Record:
    """Return a record with other values of some options, wherever it holds them.

    Examples
    --------
    >>> from pointchart.runs.demo_run import DemoRun
    >>> changed(DemoRun(), quiet=True).running.quiet
    True
    """
    return record_of(type(record), values_of(record) | values)
