"""``pointchart view``: a local page with the pipeline as steps."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin, get_type_hints

import typer

from . import options as given

if TYPE_CHECKING:
    from ..app.command import Commands, Option
    from ..app.one_neighborhood import Connect
    from ..map.weights import WeightScheme


def view(
    scan: given.ScanArgument,
    boundary: given.BoundaryOption = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser, or print its address only.")
    ] = True,
) -> None:
    """Open a page of this machine only, with the pipeline as steps and the boundary by hand; Ctrl-C ends it."""
    from importlib.util import find_spec
    from threading import Event

    from .._check import check_loop, check_points
    from ..errors import InputError
    from ..io import read_loop, read_scan
    from .aside import at_interrupt

    if find_spec("viser") is None:
        raise InputError("view needs viser; install it by: pip install 'pointchart[view]'")
    read = read_scan(scan)
    check_points(read.points)
    loop = None if boundary is None else check_loop(read_loop(boundary), len(read.points))

    from ..app.browser_app import open_page

    page = open_page(scan, read, commands(), loop=loop, tell_close=at_interrupt.append)
    print(f"{page.address}\nthe page of {scan}; Ctrl-C ends it", file=sys.stderr, flush=True)
    if browser:
        import webbrowser

        webbrowser.open(page.entrance)
    Event().wait()


def commands() -> Commands:
    """Return what the page knows of the command line: the options of the commands that it runs."""
    from ..app.command import Commands
    from . import boundary, fit, mesh, param

    run: dict[str, Callable[..., None]] = {
        "boundary": boundary.boundary,
        "param": param.param,
        "mesh": mesh.mesh,
        "fit": fit.fit,
    }
    return Commands({name: _options(command) for name, command in run.items()}, _rules)


def _options(command: Callable[..., None]) -> list[Option]:
    parameters = inspect.signature(command).parameters
    hints = get_type_hints(command, include_extras=True)
    return [_option(hint, parameters[name].default) for name, hint in hints.items() if _is_option(hint)]


def _is_option(hint: Any) -> bool:
    return get_origin(hint) is Annotated and type(hint.__metadata__[0]).__name__ == "OptionInfo"


def _option(hint: Any, default: Any) -> Option:
    from ..app.command import Option

    info, kinds = hint.__metadata__[0], get_args(hint.__origin__) or (hint.__origin__,)
    words = tuple(str(word) for kind in kinds if issubclass(kind, StrEnum) for word in kind)
    text = "" if default in (None, inspect.Parameter.empty) else str(default)
    # In an annotation, typer keeps the first name where a default would be.
    flag = next(name for name in (info.default, *info.param_decls) if isinstance(name, str))
    return Option(flag, info.help or "", words, text, kinds == (bool,))


def _rules(neighbors: str, k: str, radius: str, weights: str) -> tuple[Connect, WeightScheme]:
    """Return the functions that the words of options name; Delaunay stars of the 20 nearest, if nothing is said."""
    from ..errors import InputError
    from ..map.weights import mean_value
    from .choices import connect_rule, weights_rule
    from ..runs.option_values import Neighbors, Weighting

    kind = Neighbors(neighbors) if neighbors else None
    try:
        connect = connect_rule(kind or Neighbors.delaunay, int(k) if k else None, float(radius) if radius else None)
        assert connect is not None, "a kind is given"
    except typer.BadParameter as wrong:
        raise InputError(str(wrong)) from None
    return connect, weights_rule(Weighting(weights) if weights else None, kind) or mean_value
