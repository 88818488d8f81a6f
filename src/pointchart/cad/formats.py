"""STEP, IGES and BREP files of one face, which Open CASCADE holds in millimetres."""

from pathlib import Path
from typing import Any

from ..errors import FormatError
from .occ import no_stdout, occ, settings

# STEP spells units out; millimetres are what Open CASCADE takes a BREP file to hold, which names no unit.
_STEP_UNITS = {"um": "UM", "mm": "MM", "cm": "CM", "m": "M", "in": "INCH", "ft": "FT"}
_STEP_NAMES = {"micrometre": "um", "millimetre": "mm", "centimetre": "cm", "metre": "m", "inch": "in", "foot": "ft"}
_IGES_FLAGS = {1: "in", 2: "mm", 4: "ft", 6: "m", 9: "um", 10: "cm"}


def write_step(path: str, shape: Any, unit: str, name: str) -> bool:
    """Write AP214, which all programs read; AP242 would add nothing to a face, and Open CASCADE writes only its draft.

    Returns
    -------
    Whether it went well.
    """
    control = occ("STEPControl")
    with settings(xstep_cascade_unit="MM", write_step_unit=_STEP_UNITS[unit], write_step_schema="AP214IS"):
        writer = control.STEPControl_Writer()
        status = writer.Transfer(shape, control.STEPControl_StepModelType.STEPControl_AsIs)
        _name_product(writer.Model(), name)
        return _is_done(status) and _is_done(writer.Write(path))


def write_iges(path: str, shape: Any, unit: str, name: str) -> bool:
    """Write a trimmed surface, entity 144, which more programs read than faces of solids; return if it went well."""
    text = occ("TCollection").TCollection_HAsciiString
    with settings(xstep_cascade_unit="MM"):
        writer = occ("IGESControl").IGESControl_Writer(unit.upper(), 0)
        is_added = writer.AddShape(shape)
        writer.ComputeModel()
        header = writer.Model().GlobalSection()
        header.SetSendName(text(name.encode("ascii", "replace").decode()))
        header.SetAuthorName(text(""))  # the login name, if we did not
        writer.Model().SetGlobalSection(header)
        return bool(is_added and writer.Write(path))


def write_brep(path: str, shape: Any, unit: str, name: str) -> bool:
    """Write in millimetres, whatever the unit, as the format names none; return if it went well."""
    return bool(occ("BRepTools").BRepTools.Write_s(shape, path))


def read_step(path: str) -> tuple[Any, str]:
    """Return the shape in millimetres and the unit of the file."""
    reader = occ("STEPControl").STEPControl_Reader()
    with settings(xstep_cascade_unit="MM"):
        if not _is_done(reader.ReadFile(path)):
            raise _damaged(path, "STEP")
        reader.TransferRoots()
    lengths, angles, solids = (occ("collections").Sequence_TCollection_AsciiString() for _ in range(3))
    reader.FileUnits(lengths, angles, solids)
    names = {name.ToCString().lower() for name in lengths}
    return reader.OneShape(), _STEP_NAMES.get(names.pop(), "mm") if len(names) == 1 else "mm"


def read_iges(path: str) -> tuple[Any, str]:
    """Return the shape in millimetres, without cutting it where it is only continuous, and the unit of the file."""
    # Reading goes on without an error where a file ends early, as far as into untrimmed surfaces.
    if Path(path).read_bytes().rstrip()[-8:-7] != b"T":
        raise _damaged(path, "IGES")
    with settings(xstep_cascade_unit="MM", read_iges_bspline_continuity="0"):
        reader = occ("IGESControl").IGESControl_Reader()
        if not _is_done(reader.ReadFile(path)):
            raise _damaged(path, "IGES")
        reader.TransferRoots()
    return reader.OneShape(), _IGES_FLAGS.get(reader.IGESModel().GlobalSection().UnitFlag(), "mm")


def read_brep(path: str) -> tuple[Any, str]:
    """Return the shape and "mm"."""
    shape = occ("TopoDS").TopoDS_Shape()
    with no_stdout():
        is_read = occ("BRepTools").BRepTools.Read_s(shape, path, occ("BRep").BRep_Builder())
    if not is_read:
        raise _damaged(path, "BREP")
    return shape, "mm"


def _name_product(model: Any, name: str) -> None:
    """Name the product: by its setting it would be numbered, by one more for each file that the process writes."""
    text = occ("TCollection").TCollection_HAsciiString(spell(name))
    products = (model.Value(i) for i in range(1, model.NbEntities() + 1))
    for product in products:
        if isinstance(product, occ("StepBasic").StepBasic_Product):
            product.SetName(text)
            product.SetId(text)


def spell(name: str) -> str:
    r"""Return a name with its letters beyond ASCII by their numbers, as STEP has it (ISO 10303-21, section 6.4.3).

    >>> print(spell("Maß"))
    Ma\X2\00DF\X0\
    """
    return "".join(letter if letter.isascii() else _numbered(letter) for letter in name)


def _numbered(letter: str) -> str:
    kind, digits = (2, 4) if ord(letter) < 0x10000 else (4, 8)
    return f"\\X{kind}\\{ord(letter):0{digits}X}\\X0\\"


def _is_done(status: Any) -> bool:
    return bool(status == occ("IFSelect").IFSelect_ReturnStatus.IFSelect_RetDone)


def _damaged(path: str, name: str) -> FormatError:
    return FormatError(f"{path}: this is no whole {name} file; copy or export it again")
