"""Surfaces and loops out of shapes of Open CASCADE."""

from typing import Any

import numpy as np

from ..errors import FormatError
from ..io.source import AnyPath
from ..plane.polygons import signed_area
from ..surface import BSplineSurface
from ..typing import UV, Floats
from .occ import occ

SAMPLES = 8  # points on each span of a trim curve that is no line


def only_face(path: AnyPath, shape: Any) -> Any:
    """Return the face of a shape that has one, whose surface is a polynomial B-spline."""
    faces = [] if shape is None or shape.IsNull() else _parts(shape, "FACE")
    if len(faces) != 1:
        raise FormatError(f"{path}: the file holds {len(faces)} faces, but one is needed; export that face alone")
    (face,) = faces
    carrier = occ("BRep").BRep_Tool.Surface_s(face)
    if not isinstance(carrier, occ("Geom").Geom_BSplineSurface):
        kind = type(carrier).__name__.removeprefix("Geom_")
        raise FormatError(f"{path}: the face lies on a {kind}, not on a B-spline surface; convert it to one")
    if carrier.IsURational() or carrier.IsVRational():
        raise FormatError(f"{path}: the B-spline surface is rational; approximate it by one without weights")
    return face


def split(face: Any) -> tuple[BSplineSurface, list[UV]]:
    """Return the surface of a face in its unit and the loops, the outer one first and anticlockwise.

    Where a face is turned against its surface, u and v change places, so that s_u x s_v is always its normal.
    """
    surface = _surface(occ("BRep").BRep_Tool.Surface_s(face))
    loops = [_loop(wire, face) for wire in _parts(face, "WIRE")]
    if face.Orientation() == occ("TopAbs").TopAbs_Orientation.TopAbs_REVERSED:
        turned = np.ascontiguousarray(surface.control.transpose(1, 0, 2))
        surface = BSplineSurface(surface.degree, surface.knots_v, surface.knots_u, turned)
        loops = [loop[:, ::-1] for loop in loops]
    return surface, sorted(loops, key=signed_area, reverse=True)


def _surface(carrier: Any) -> BSplineSurface:
    carrier = carrier.Copy()
    carrier.SetUNotPeriodic()
    carrier.SetVNotPeriodic()
    degree = max(carrier.UDegree(), carrier.VDegree())
    carrier.IncreaseDegree(degree, degree)
    rows, columns = range(1, carrier.NbUPoles() + 1), range(1, carrier.NbVPoles() + 1)
    poles = ([carrier.Pole(i, j) for j in columns] for i in rows)
    control = np.array([[(pole.X(), pole.Y(), pole.Z()) for pole in row] for row in poles])
    knots_u = _knots(carrier.NbUKnots(), carrier.UKnot, carrier.UMultiplicity)
    return BSplineSurface(degree, knots_u, _knots(carrier.NbVKnots(), carrier.VKnot, carrier.VMultiplicity), control)


def _knots(count: int, knot: Any, multiplicity: Any) -> Floats:
    return np.array([knot(i) for i in range(1, count + 1) for _ in range(multiplicity(i))])


def _loop(wire: Any, face: Any) -> UV:
    explorer = occ("BRepTools").BRepTools_WireExplorer(wire, face)
    runs = []
    while explorer.More():
        runs.append(_run(explorer.Current(), face))
        explorer.Next()
    return np.concatenate(runs) if runs else np.empty((0, 2))


def _run(edge: Any, face: Any) -> UV:
    """Return places on an edge in the sense in which its wire passes it, without the last one."""
    curve = occ("BRepAdaptor").BRepAdaptor_Curve2d(edge, face)
    first, last = curve.FirstParameter(), curve.LastParameter()
    is_line = curve.GetType() == occ("GeomAbs").GeomAbs_CurveType.GeomAbs_Line or _is_chord(curve)
    bounds = np.array([first, last]) if is_line else _bounds(curve, first, last)
    at = bounds[:1] if is_line else np.linspace(bounds[:-1], bounds[1:], SAMPLES, endpoint=False, axis=1).ravel()
    at = np.append(at, last)
    at = at[::-1] if edge.Orientation() == occ("TopAbs").TopAbs_Orientation.TopAbs_REVERSED else at
    return np.array([(place.X(), place.Y()) for place in map(curve.Value, at[:-1].tolist())])


def _is_chord(curve: Any) -> bool:
    is_spline = curve.GetType() == occ("GeomAbs").GeomAbs_CurveType.GeomAbs_BSplineCurve
    return bool(is_spline and curve.Degree() == 1 and curve.NbKnots() == 2)


def _bounds(curve: Any, first: float, last: float) -> Floats:
    """Return the ends of the spans on which a curve is smooth."""
    continuity = occ("GeomAbs").GeomAbs_Shape.GeomAbs_CN
    count = curve.NbIntervals(continuity)
    array = occ("collections").Array1_double(1, count + 1)
    curve.Intervals(array, continuity)
    return np.clip(np.array([array.Value(i) for i in range(1, count + 2)], np.float64), first, last)


def _parts(shape: Any, kind: str) -> list[Any]:
    explorer = occ("TopExp").TopExp_Explorer(shape, getattr(occ("TopAbs").TopAbs_ShapeEnum, f"TopAbs_{kind}"))
    narrow, parts = getattr(occ("TopoDS").TopoDS, kind.capitalize()), []
    while explorer.More():
        parts.append(narrow(explorer.Current()))
        explorer.Next()
    return parts
