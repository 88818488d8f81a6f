"""The checks of a certificate, each once, and what they come to in a sentence."""

from ..proof.certificate import Certificate
from .record import Check

# Of what there must be none: what is said, the field of the certificate that counts, what is said of some.
COUNTS = (
    ("every point used", "unused_points", "{} unused"),
    ("edges manifold, orientation consistent", "overfull_edges", "{} edges at fault"),
    ("one fan a vertex", "pinched_points", "{} pinched vertices"),
)


def certificate_checks(proof: Certificate) -> list[Check]:
    """Return what a certificate checks, then what it only measures."""
    euler, loops = 1 - proof.holes, 1 + proof.holes
    name = "one boundary loop" if loops == 1 else f"{loops} boundary loops, {proof.holes} of them round holes"
    checks = [_none(name, getattr(proof, field), fault) for name, field, fault in COUNTS]
    checks += [
        Check("one part", proof.parts == 1, f"there are {proof.parts}"),
        Check(f"Euler characteristic {euler}", proof.euler == euler, f"it is {proof.euler}"),
        Check(name, proof.boundary_loops == loops, f"there are {proof.boundary_loops}"),
    ]
    if proof.boundary_as_given is not None:
        checks.append(Check("boundary as asked for", proof.boundary_as_given, "another loop"))
    if proof.coinciding_uv is not None and proof.flat_or_folded_uv is not None:
        checks.append(_none("uv distinct", proof.coinciding_uv, "{} points coincide"))
        name = "uv one-to-one, every triangle exactly positive"
        checks.append(_none(name, proof.flat_or_folded_uv, "{} triangles flat or folded"))
    if proof.simple_uv_boundary is not None:
        checks.append(Check("boundary simple in the plane", proof.simple_uv_boundary, "it crosses itself"))
    measure = f"{proof.longest_edge_over_spacing:.1f} local spacings, {counted(proof.folds, 'fold')}"
    return [*checks, Check("longest edge", None, measure)]


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


def counted(n: int, noun: str) -> str:
    """Write a number of things.

    >>> counted(1, "gap"), counted(3, "gap")
    ('1 gap', '3 gaps')
    """
    return f"{n} {noun}" if n == 1 else f"{n} {noun}s"


def _none(name: str, count: int, fault: str) -> Check:
    return Check(name, count == 0, fault.format(count))
