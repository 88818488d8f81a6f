"""The command line: words to a run, and what came of it to words; a run imports what it needs when it is executed."""

import sys
from typing import Annotated

import typer

from ..runs.commands import RECORDS
from ..runs.view_run import ViewRun
from .commands import SectionedCommand, command_of, execute
from .view import open_view

app = typer.Typer(
    help="From a point cloud of one surface patch to planar parameters, a certified disc mesh and a CAD surface.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _show_version(is_asked: bool) -> None:
    if is_asked:
        from importlib.metadata import version

        print(f"pointchart {version('pointchart')}")
        raise typer.Exit


@app.callback()
def common(
    show_version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Take the options that stand before a command."""


for record in RECORDS.values():
    run = open_view if record is ViewRun else execute
    app.command(record.command, cls=SectionedCommand)(command_of(record, run))


def main() -> None:
    """Run the command line: exit 0 done, 1 one sentence on stderr, 2 wrong usage, 130 interrupted."""
    try:
        app()
    except MemoryError:
        from ..errors import NO_MEMORY

        _leave(NO_MEMORY)
    except Exception as error:
        from ..errors import PointchartError

        if not isinstance(error, PointchartError):
            raise
        _leave(str(error))


def _leave(sentence: str) -> None:
    print(f"pointchart: {sentence}", file=sys.stderr)
    sys.exit(1)
