"""Open CASCADE, the extra `cad`: imported on first use, silent, and its settings put back."""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from ..errors import FormatError, PointchartError
from ..io.source import AnyPath


def occ(name: str) -> Any:
    """Return a module of Open CASCADE by its name, as `Geom`."""
    return import_module(f"OCP.{name}")


def check_extra(path: AnyPath) -> None:
    """Raise a FormatError if Open CASCADE is not installed in a version that we can use."""
    try:
        is_there = hasattr(occ("collections"), "Array2_gp_Pnt")
    except ImportError:
        is_there = False
    if not is_there:
        raise FormatError(f"{path}: the package OCP 8 (Open CASCADE) is not installed; pip install 'pointchart[cad]'")


@contextmanager
def silence() -> Iterator[None]:
    """Keep Open CASCADE from printing: what it says about a transfer would come in between the user's own output."""
    messenger = occ("Message").Message.DefaultMessenger_s()
    printers = list(messenger.Printers())
    for printer in printers:
        messenger.RemovePrinter(printer)
    try:
        yield
    finally:
        for printer in printers:
            messenger.AddPrinter(printer)


@contextmanager
def failing_as(kind: type[PointchartError], message: str) -> Iterator[None]:
    """Raise an error of ours with this message where Open CASCADE raises one of its own."""
    try:
        yield
    except Exception as failure:  # those of Open CASCADE have no other class in common
        if not type(failure).__module__.startswith("OCP."):
            raise
        raise kind(message) from failure


@contextmanager
def no_stdout() -> Iterator[None]:
    """Discard what is written to the standard output below Python, which what cannot be read of a BREP file causes."""
    sys.stdout.flush()
    kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nothing, 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nothing)


@contextmanager
def settings(**values: str) -> Iterator[None]:
    """Change settings, given with _ for each dot, and put back what they were, as they are those of the process."""
    static = occ("Interface").Interface_Static
    occ("STEPControl").STEPControl_Controller.Init_s()
    occ("IGESControl").IGESControl_Controller.Init_s()
    names = {name: name.replace("_", ".") for name in values}
    before = {name: static.CVal_s(names[name]) for name in values}
    try:
        for name, value in values.items():
            static.SetCVal_s(names[name], value)
        yield
    finally:
        for name, value in before.items():
            static.SetCVal_s(names[name], value)


def array1(kind: str, values: Iterable[Any]) -> Any:
    """Return a one-dimensional array of `kind`, as `double` or `gp_Pnt`; its first index is 1."""
    items = list(values)
    array = getattr(occ("collections"), f"Array1_{kind}")(1, len(items))
    for i, item in enumerate(items, start=1):
        array.SetValue(i, item)
    return array
