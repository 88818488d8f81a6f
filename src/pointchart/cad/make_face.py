"""Faces of Open CASCADE from surfaces and trim curves."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.interpolate import BSpline

from ..surface import BSplineSurface
from ..typing import Floats
from .occ import array1, occ
from .space_curves import lift
from .trims import Edge

CONFUSION = 1e-7  # millimetres: what Open CASCADE holds for one place
LIFTED = 1e-7  # of the size: how near curves in space follow the trim curves, a tenth of what a file may be off
_ROUNDED = 16.0 * np.finfo(np.float64).eps  # of the largest coordinate: what evaluation may be off


def make_face(surface: BSplineSurface, loops: Sequence[Sequence[Edge]]) -> Any:
    """Return the face of a surface in millimetres that the edges bound; its normal is s_u x s_v.

    An outer loop that is the border of the domain becomes the natural bounds, whose edges are curves of the surface.
    """
    carrier, builder = make_surface(surface), occ("BRep").BRep_Builder()
    least = max(CONFUSION, _ROUNDED * float(np.abs(surface.control).max()))
    if _is_border(surface.domain, loops[0]):
        face, loops = occ("BRepBuilderAPI").BRepBuilderAPI_MakeFace(carrier, least).Face(), loops[1:]
    else:
        face = occ("TopoDS").TopoDS_Face()
        builder.MakeFace(face, carrier, least)
    for edges in loops:
        builder.Add(face, _wire(builder, surface, carrier, edges, least))
    occ("ShapeFix").ShapeFix_ShapeTolerance().LimitTolerance(face, least)
    return face


def size_of(surface: BSplineSurface) -> float:
    """Return the diagonal of the box around the control points, in the unit of the surface."""
    return float(np.linalg.norm(np.ptp(surface.control.reshape(-1, 3), axis=0)))


def _is_border(domain: Floats, edges: Sequence[Edge]) -> bool:
    if len(edges) != 4 or any(edge.curve.k != 1 for edge in edges):
        return False
    corners = {tuple(edge.curve.c[0].tolist()) for edge in edges}
    return corners == {(u, v) for u in domain[:, 0].tolist() for v in domain[:, 1].tolist()}


def _wire(builder: Any, surface: BSplineSurface, carrier: Any, edges: Sequence[Edge], least: float) -> Any:
    lifted = [lift(surface, edge.curve, max(least, LIFTED * size_of(surface))) for edge in edges]
    # Twice the distance at the checks, as it may be larger between them.
    tolerances = [max(least, 2.0 * error) for _, error in lifted]
    vertices = [_vertex(builder, spline.c[0], max(tolerances)) for spline, _ in lifted]
    wire = occ("TopoDS").TopoDS_Wire()
    builder.MakeWire(wire)
    for i, (edge, (spline, _), tolerance) in enumerate(zip(edges, lifted, tolerances, strict=True)):
        ends = vertices[i], vertices[(i + 1) % len(vertices)]
        builder.Add(wire, _edge(builder, carrier, edge.curve, spline, ends, tolerance))
    return wire


def _vertex(builder: Any, place: Floats, tolerance: float) -> Any:
    vertex = occ("TopoDS").TopoDS_Vertex()
    builder.MakeVertex(vertex, occ("gp").gp_Pnt(*place.tolist()), tolerance)
    return vertex


def _edge(builder: Any, carrier: Any, flat: BSpline, spline: BSpline, ends: tuple[Any, Any], tolerance: float) -> Any:
    edge, orientation = occ("TopoDS").TopoDS_Edge(), occ("TopAbs").TopAbs_Orientation
    builder.MakeEdge(edge, _curve("Geom", "Pnt", spline), tolerance)
    builder.UpdateEdge(edge, _curve("Geom2d", "Pnt2d", flat), carrier, occ("TopLoc").TopLoc_Location(), tolerance)
    builder.Range(edge, float(flat.t[0]), float(flat.t[-1]))
    for vertex, sense in zip(ends, (orientation.TopAbs_FORWARD, orientation.TopAbs_REVERSED), strict=True):
        builder.Add(edge, vertex.Oriented(sense))
    return edge


def _curve(module: str, kind: str, spline: BSpline) -> Any:
    point = getattr(occ("gp"), f"gp_{kind}")
    poles = array1(f"gp_{kind}", [point(*pole) for pole in spline.c.tolist()])
    return getattr(occ(module), f"{module}_BSplineCurve")(poles, *_knots(spline.t), spline.k)


def make_surface(surface: BSplineSurface) -> Any:
    """Return the same surface as an object of Open CASCADE."""
    rows, columns, _ = surface.control.shape
    poles = occ("collections").Array2_gp_Pnt(1, rows, 1, columns)
    for i, row in enumerate(surface.control.tolist(), start=1):
        for j, pole in enumerate(row, start=1):
            poles.SetValue(i, j, occ("gp").gp_Pnt(*pole))
    (in_u, times_u), (in_v, times_v) = _knots(surface.knots_u), _knots(surface.knots_v)
    degree = surface.degree
    return occ("Geom").Geom_BSplineSurface(poles, in_u, in_v, times_u, times_v, degree, degree)


def _knots(knots: Floats) -> tuple[Any, Any]:
    values, counts = np.unique(knots, return_counts=True)
    return array1("double", values.tolist()), array1("int", counts.tolist())
