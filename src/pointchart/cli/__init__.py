"""The command line: read, call, write; a command imports what it needs when it runs, so that help comes at once."""

import sys
from typing import Annotated

import typer

from . import boundary, check, demo, figure, fit, mesh, param, view

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


app.command()(mesh.mesh)
app.command()(param.param)
app.command()(boundary.boundary)
app.command()(fit.fit)
app.command()(figure.figure)
app.command()(check.check)
app.command()(view.view)
app.command()(demo.demo)


def main() -> None:
    """Run the command line: exit 0 done, 1 one sentence on stderr, 2 wrong usage, 130 interrupted."""
    try:
        app()
    except MemoryError:
        _leave("not enough memory for this scan; thin it, or use a machine with more")
    except Exception as error:
        from ..errors import PointchartError

        if not isinstance(error, PointchartError):
            raise
        _leave(str(error))


def _leave(sentence: str) -> None:
    print(f"pointchart: {sentence}", file=sys.stderr)
    sys.exit(1)
