"""Results as text and as the JSON of a run; computes nothing but counts and percentiles."""

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

import numpy as np

from .boundary import Candidate, perimeter
from .clock import StageClock
from .gaps.bridges import Bridge
from .gaps.rules import place_of
from .io import replacing
from .mesh.distortion import area_distortions, conformal_distortions, l2_stretch, least_distance, linf_stretch
from .mesh.quality import areas, radius_ratios
from .pipeline import Reconstruction
from .proof.certificate import Certificate
from .proof.intersections import places_of, self_intersections
from .solve.systems import Solution
from .typing import UV, Floats, Indices, Points, Triangles

MOST_PLACES = 10
CHECKS = (
    ("every point used", "unused_points", "{} unused"),
    ("edges manifold, orientation consistent", "overfull_edges", "{} edges at fault"),
    ("one fan a vertex", "pinched_points", "{} pinched vertices"),
)


def certificate_lines(proof: Certificate) -> list[str]:
    """Write a certificate as a checklist, one check a line."""
    lines = [_line(getattr(proof, field) == 0, name, text, getattr(proof, field)) for name, field, text in CHECKS]
    lines.append(_line(proof.parts == 1, "one part", "there are {}", proof.parts))
    euler, loops = 1 - proof.holes, 1 + proof.holes
    lines.append(_line(proof.euler == euler, f"Euler characteristic {euler}", "it is {}", proof.euler))
    name = "one boundary loop" if loops == 1 else f"{loops} boundary loops, {proof.holes} of them round holes"
    lines.append(_line(proof.boundary_loops == loops, name, "there are {}", proof.boundary_loops))
    if proof.boundary_as_given is not None:
        lines.append(_line(proof.boundary_as_given, "boundary as asked for", "another loop", 0))
    if proof.coinciding_uv is not None:
        lines.append(_line(proof.coinciding_uv == 0, "uv distinct", "{} points coincide", proof.coinciding_uv))
        lines.append(
            _line(
                proof.flat_or_folded_uv == 0,
                "uv one-to-one, every triangle exactly positive",
                "{} triangles flat or folded",
                proof.flat_or_folded_uv,
            )
        )
    if proof.simple_uv_boundary is not None:
        lines.append(_line(proof.simple_uv_boundary, "boundary simple in the plane", "it crosses itself", None))
    lines.append(
        f"[--] longest edge {proof.longest_edge_over_spacing:.1f} local spacings, {_counted(proof.folds, 'fold')}"
    )
    return lines


def boundary_lines(result: Reconstruction, points: Points, *, found: bool) -> list[str]:
    """Say what the boundary is and what was bridged, one thing a line; `points` are those of the vertices."""
    lines = [f"boundary of {len(result.loop)} points, {'found' if found else 'as given'}"]
    failed, n = len(result.evidence.failures), len(result.evidence.candidates)
    if failed:
        lines[0] += f", loop {failed + 1} of {n} by its scores: no mesh stood with {failed} before it"
    gaps = [bridge for bridge in result.evidence.bridges if bridge.is_gap]
    doubts = [bridge for bridge in result.evidence.bridges if not bridge.is_gap]
    holes = result.certificate.holes
    if gaps:
        done = f"{holes} left open" if holes else "bridged"
        if 0 < holes < len(gaps):
            done += " and the others, which touch the boundary or another gap, bridged"
        widest = f"the largest {gaps[0].rim_in_spacings:.0f} spacings round"
        lines.append(f"{_counted(len(gaps), 'gap')} of the scan, {done}, {widest}")
    if doubts:
        lines.append(
            f"look at {_counted(len(doubts), 'place')} that the mesh spans by edges of over four spacings although the "
            f"scan has no gap there, the largest at vertex {doubts[0].points[0]} "
            f"{place_of(points, doubts[0].points[0])}"
        )
    return lines


def summary(proof: Certificate) -> str:
    """Say in one sentence what was proved."""
    if not proof.is_as_asked:
        return f"no disc: {', '.join(proof.faults)}"
    holes = {0: "", 1: " with a hole"}.get(proof.holes, f" with {proof.holes} holes")
    text = f"a certified disc{holes}: {proof.n_points} points, {proof.n_triangles} triangles"
    if proof.coinciding_uv is None:
        return text
    if proof.is_one_to_one:
        return text + ", uv one-to-one"
    return text + (
        f", uv folded at {proof.flat_or_folded_uv} triangles" if proof.flat_or_folded_uv else ", uv overlaps"
    )


def intersection_lines(run: dict[str, Any]) -> list[str]:
    """Say where the mesh of a run passes through itself, given its report; no line if it does not."""
    found = run["quality"]["self_intersections"]
    if not found["count"]:
        return []
    first = place_of(np.array(found["places"]), 0)
    return [f"look at {_counted(found['count'], 'place')} where the mesh passes through itself, the first at {first}"]


def run_report(
    scan: Points,
    rows: Indices,
    result: Reconstruction,
    clock: StageClock,
    options: dict[str, Any],
    *,
    boundary_given: bool,
) -> dict[str, Any]:
    """Gather what a run did, as plain data for JSON.

    Parameters
    ----------
    scan : (N, 3) array
        The points as read.
    rows : (k,) int array
        Those that were worked on.
    result : Reconstruction
    clock : StageClock
    options : dict
        As the user gave them.
    boundary_given : bool

    Returns
    -------
    dict
    """
    points = scan[rows[result.rows]]
    evidence = result.evidence
    return {
        "points": {
            "read": len(scan),
            "distinct": len(points),
            "repeated": len(rows) - len(points),
            "left_out": len(scan) - len(rows),
        },
        "options": options,
        "stages": stages_report(clock),
        "peak_memory_mb": peak_memory_mb(),
        "boundary": {
            "points": len(result.loop),
            "length": perimeter(points, result.loop),
            "origin": "given" if boundary_given else "found",
            "loops": [_loop(candidate) for candidate in result.evidence.candidates],
            "gaps": [_bridge(bridge) for bridge in result.evidence.bridges if bridge.is_gap],
            "doubts": [_bridge(bridge) for bridge in result.evidence.bridges if not bridge.is_gap],
            "tried_before": [str(failure.renumbered(rows)) for failure in result.evidence.failures],
        },
        "solve": solve_report(evidence.first_solve or evidence.solve),
        "solve_uv": solve_report(evidence.solve),
        "swaps": {
            "count": evidence.counts.n_swaps,
            "settled": evidence.counts.is_settled,
            "closed_pockets": evidence.counts.n_pockets,
            "recovered_links": evidence.counts.n_recovered,
            "relocated_points": evidence.counts.n_relocated,
        },
        "certificate": certificate_report(result.certificate),
        "quality": quality_report(points, result.triangles, result.uv),
    }


def quality_report(points: Points, triangles: Triangles, uv: UV) -> dict[str, Any]:
    """Return the shape of the triangles and the distortion of the map as plain data for JSON; None is infinite.

    `mean` and `percentile_95` weigh triangles by their area in space.
    """
    ratios = radius_ratios(points, triangles)
    area = areas(points, triangles)
    return {
        "radius_ratio": {"least": float(ratios.min()), "median": float(np.median(ratios))},
        "l2_stretch": _finite(l2_stretch(points, triangles, uv)),
        "linf_stretch": _finite(linf_stretch(points, triangles, uv)),
        "conformal": _spread(conformal_distortions(points, triangles, uv), area),
        "area": _spread(area_distortions(points, triangles, uv), area),
        "least_uv_distance": least_distance(uv),
        "self_intersections": _self_intersections(points, triangles),
    }


def certificate_report(proof: Certificate) -> dict[str, Any]:
    """Return a certificate as plain data for JSON."""
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


def stages_report(clock: StageClock) -> list[dict[str, Any]]:
    """Return the time of each stage as plain data for JSON."""
    return [{"name": name, "seconds": round(seconds, 4)} for name, seconds in clock.seconds.items()]


def solve_report(solution: Solution) -> dict[str, Any]:
    """Return what is known of a linear solve as plain data for JSON."""
    return {
        "unknowns": solution.unknowns,
        "nonzeros": solution.nonzeros,
        "method": solution.method,
        "iterations": list(solution.iterations),
        "residual": solution.residual,
    }


def write_json(path: Path, report: dict[str, Any]) -> None:
    """Write a report as JSON."""
    with writing_json(path, report):
        pass


@contextmanager
def writing_json(path: Path | None, report: dict[str, Any]) -> Iterator[None]:
    """Write a report as JSON, if a path is given; it is in its place when the block has ended well."""
    with nullcontext() if path is None else replacing(path) as temporary:
        if temporary is not None:
            temporary.write_text(json.dumps(report, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        yield


def peak_memory_mb() -> int | None:
    """Return the largest resident memory of this process so far, in MiB; None where the system does not tell."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return int(peak // (1024 * 1024 if sys.platform == "darwin" else 1024))


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _spread(values: Floats, weights: Floats) -> dict[str, float | None]:
    # Triangles without area in space have no shape that a map could keep.
    values, weights = values[weights > 0.0], weights[weights > 0.0]
    order = np.argsort(values)
    up_to = np.cumsum(weights[order])
    place = min(int(np.searchsorted(up_to, 0.95 * up_to[-1])), len(values) - 1)
    return {
        "mean": _finite(float(values @ weights / up_to[-1])),
        "percentile_95": _finite(values[order[place]]),
        "largest": _finite(values.max()),
    }


def _counted(n: int, noun: str) -> str:
    return f"{n} {noun}" if n == 1 else f"{n} {noun}s"


def _line(passed: bool, name: str, fault: str, count: int | None) -> str:
    return f"[ok] {name}" if passed else f"[!!] {name}: {fault.format(count)}"


def _self_intersections(points: Points, triangles: Triangles) -> dict[str, Any]:
    pairs = self_intersections(points, triangles)
    places = places_of(points, triangles, pairs)
    return {"pairs": len(pairs), "count": len(places), "places": places[:MOST_PLACES].tolist()}


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
