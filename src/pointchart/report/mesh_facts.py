"""Results of a run that makes a mesh as plain data for JSON."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from .._memory import peak_memory_mb
from ..boundary import Candidate, perimeter
from ..gaps.bridges import Bridge
from ..mesh.mesh_quality import MeshQuality, Spread
from ..pipeline import Reconstruction
from ..proof.certificate import Certificate
from ..proof.intersection_places import SelfIntersections
from ..solve.systems import Solution
from ..typing import Indices, Points

MOST_PLACES = 10  # of self-intersections that are named: more are counted, but nobody looks at them one by one


@dataclass(frozen=True, slots=True, eq=False)
class MeshedScan:
    """A scan with its mesh and what was measured of it.

    Attributes
    ----------
    scan : (n, 3) array
        All points that were read.
    rows : (k,) int array
        Those that were worked on.
    result : Reconstruction
        Its `rows` are places in `rows`.
    quality : MeshQuality
    intersections : SelfIntersections
    is_boundary_given : bool
    """

    scan: Points
    rows: Indices
    result: Reconstruction
    quality: MeshQuality
    intersections: SelfIntersections
    is_boundary_given: bool

    @property
    def points(self) -> Points:
        """The points of the vertices."""
        return self.scan[self.rows[self.result.rows]]


def mesh_facts(meshed: MeshedScan, options: dict[str, Any]) -> dict[str, Any]:
    """Gather what a run did."""
    result, evidence = meshed.result, meshed.result.evidence
    return {
        "points": _points(meshed),
        "options": options,
        "peak_memory_mb": peak_memory_mb(),
        "boundary": _boundary(meshed),
        "solve": solve_facts(evidence.first_solve or evidence.solve),
        "solve_uv": solve_facts(evidence.solve),
        "swaps": {
            "count": evidence.counts.n_swaps,
            "settled": evidence.counts.is_settled,
            "closed_pockets": evidence.counts.n_pockets,
            "recovered_links": evidence.counts.n_recovered,
            "relocated_points": evidence.counts.n_relocated,
        },
        "certificate": certificate_facts(result.certificate),
        "quality": quality_facts(meshed.quality) | {"self_intersections": _places(meshed.intersections)},
    }


def quality_facts(quality: MeshQuality) -> dict[str, Any]:
    """Return the quality of a mesh and its map; None is infinite."""
    return {
        "radius_ratio": {"least": quality.least_radius_ratio, "median": quality.median_radius_ratio},
        "l2_stretch": _finite(quality.l2_stretch),
        "linf_stretch": _finite(quality.linf_stretch),
        "conformal": _spread(quality.conformal),
        "area": _spread(quality.area),
        "least_uv_distance": quality.least_uv_distance,
    }


def certificate_facts(proof: Certificate) -> dict[str, Any]:
    """Return a certificate."""
    return {
        "disc": proof.is_disc,
        "holes": proof.holes,
        "as_asked": proof.is_as_asked,
        "every_point_used": proof.unused_points == 0,
        "parts": proof.parts,
        "euler": proof.euler,
        "boundary_loops": proof.boundary_loops,
        "boundary_as_given": proof.boundary_as_given,
        "uv_distinct": None if proof.coinciding_uv is None else proof.coinciding_uv == 0,
        "uv_boundary_simple": proof.simple_uv_boundary,
        "uv_positive": None if proof.flat_or_folded_uv is None else proof.flat_or_folded_uv == 0,
        "coinciding_uv": proof.coinciding_uv,
        "flat_or_folded_uv": proof.flat_or_folded_uv,
        "longest_edge_over_spacing": round(proof.longest_edge_over_spacing, 3),
        "folds": proof.folds,
        "points": proof.n_points,
        "triangles": proof.n_triangles,
    }


def solve_facts(solution: Solution) -> dict[str, Any]:
    """Return what is known of a linear solve."""
    return {
        "unknowns": solution.unknowns,
        "nonzeros": solution.nonzeros,
        "method": solution.method,
        "iterations": list(solution.iterations),
        "residual": solution.residual,
    }


def _points(meshed: MeshedScan) -> dict[str, int]:
    n_read, n_used, n_distinct = len(meshed.scan), len(meshed.rows), len(meshed.result.rows)
    return {
        "read": n_read,
        "distinct": n_distinct,
        "repeated": n_used - n_distinct,
        "left_out": n_read - n_used,
    }


def _boundary(meshed: MeshedScan) -> dict[str, Any]:
    result, evidence = meshed.result, meshed.result.evidence
    return {
        "points": len(result.loop),
        "length": perimeter(meshed.points, result.loop),
        "origin": "given" if meshed.is_boundary_given else "found",
        "loops": [_loop(candidate) for candidate in evidence.candidates],
        "gaps": [_bridge(bridge) for bridge in evidence.bridges if bridge.is_gap],
        "doubts": [_bridge(bridge) for bridge in evidence.bridges if not bridge.is_gap],
        "tried_before": [str(failure.renumbered(meshed.rows)) for failure in evidence.failures],
    }


def _loop(candidate: Candidate) -> dict[str, Any]:
    return {
        "points": len(candidate.loop),
        "length": candidate.length,
        "closed": True,
        "confidence": round(candidate.share, 4),
        "at_vertex": int(candidate.loop[0]),
    }


def _bridge(bridge: Bridge) -> dict[str, Any]:
    return {
        "points": len(bridge.points),
        "length": bridge.rim_length,
        "spacings": round(bridge.rim_in_spacings, 1),
        "at_vertex": int(bridge.points[0]),
    }


def _places(found: SelfIntersections) -> dict[str, Any]:
    places = found.places[:MOST_PLACES].tolist()
    return {"pairs": len(found.pairs), "count": len(found.places), "places": places}


def _spread(spread: Spread) -> dict[str, float | None]:
    return {name: _finite(value) for name, value in asdict(spread).items()}


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None
