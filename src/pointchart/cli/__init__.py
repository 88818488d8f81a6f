"""The command line: read, call, write."""

import sys

import typer

from ..errors import PointchartError
from . import boundary, check, demo, mesh, param

app = typer.Typer(
    help="From a point cloud of one surface patch to planar parameters and a triangle mesh, certified to be a disc.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)
app.command()(mesh.mesh)
app.command()(param.param)
app.command()(boundary.boundary)
app.command()(check.check)
app.command()(demo.demo)


def main() -> None:
    """Run the command line: exit 0 done, 1 one sentence on stderr, 2 wrong usage, 130 interrupted."""
    try:
        app()
    except PointchartError as error:
        _leave(str(error))
    except MemoryError:
        _leave("not enough memory for this scan; thin it, or use a machine with more")


def _leave(sentence: str) -> None:
    print(f"pointchart: {sentence}", file=sys.stderr)
    sys.exit(1)
