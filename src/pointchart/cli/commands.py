"""Records of runs as commands: their options, their help in sections, and what is said of how they end."""

import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperCommand

from ..runs.options import Group, Option, options_of, record_of
from .progress import staged

if TYPE_CHECKING:
    from ..report.record import RunReport
    from ..runs.commands import Run
    from ..runs.view_run import ViewRun

LAST = Group.running  # the section of --help itself


class SectionedCommand(TyperCommand):
    """A command whose help lists its options by what they are about."""

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write a section for each group of options."""
        rows: dict[str, list[tuple[str, str]]] = {group: [] for group in Group}
        for parameter in self.get_params(ctx):
            row = parameter.get_help_record(ctx)
            if row is not None:
                rows[getattr(parameter, "rich_help_panel", None) or LAST].append(row)
        for group, listed in rows.items():
            if listed:
                with formatter.section(group):
                    formatter.write_dl(listed)


def command_of(record: "type[Run | ViewRun]", execute: Callable[[Any], None]) -> Callable[..., None]:
    """Return the function that typer takes for a command: its parameters are the options of a record.

    Parameters
    ----------
    record : type
    execute : callable
        Called with the record that holds what was given.
    """

    def command(**values: Any) -> None:
        execute(record_of(record, values))

    parameters = [_parameter(option) for option in options_of(record)]
    command.__name__, command.__doc__ = record.command, inspect.getdoc(record)
    command.__signature__ = inspect.Signature(parameters, return_annotation=None)  # type: ignore[attr-defined]
    command.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return command


def execute(run: "Run") -> None:
    """Execute a run, show its stages as they begin, and say what came of it, unless it is to be quiet.

    Raises
    ------
    typer.BadParameter
        If options do not fit.
    PointchartError
        With the options that may help.
    """
    from ..errors import OptionError, PointchartError
    from ..runs.remedies import sentence

    try:
        with staged(run.running.quiet) as clock:
            report = run.execute(clock)
        if not run.running.quiet:
            _say(report)
        if report.failure is not None:
            raise report.failure
    except OptionError as wrong:
        raise typer.BadParameter(str(wrong), param_hint=wrong.flag) from None
    except PointchartError as reason:
        raise type(reason)(sentence(reason, run)) from reason


def _say(report: "RunReport") -> None:
    from ..report.as_text import as_text

    text = as_text(report)
    if text:
        print(text, file=sys.stderr)


def _parameter(option: Option) -> inspect.Parameter:
    info = typer.Option(*option.flags, **_told(option)) if option.flags else typer.Argument(**_told(option))
    kind: Any = option.kind if option.default is not None else option.kind | None
    default = inspect.Parameter.empty if option.is_required else option.default
    annotation: Any = Annotated[kind, info]
    return inspect.Parameter(option.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _told(option: Option) -> dict[str, Any]:
    told: dict[str, Any] = {"help": option.help, "metavar": option.metavar, "rich_help_panel": option.group}
    if option.kind is Path:
        # Files that are read are looked at by their readers, whose sentences say more.
        told["readable"] = not option.is_input
    return told | {"min": option.least, "max": option.most}
