"""The checks of a certificate, and the sentence that sums them up."""

import re

import numpy as np
import pytest

from pointchart import certify, shapes
from pointchart.report.as_text import check_line
from pointchart.report.checks import certificate_checks, summary
from pointchart.report.mesh_facts import certificate_facts

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
WHOLE = [[0, 1, 2], [0, 2, 3]]


def certificate_lines(proof):
    return [check_line(check) for check in certificate_checks(proof)]


def test_a_good_mesh_passes_every_line():
    proof = certify(SQUARE, WHOLE, uv=SQUARE[:, :2], loop=[0, 1, 2, 3])
    lines = certificate_lines(proof)
    assert all(line.startswith("[ok] ") for line in lines[:-1])
    assert re.fullmatch(r"\[--\] longest edge \d\.\d local spacings, 0 folds", lines[-1])
    assert summary(proof) == "a certified disc: 4 points, 2 triangles, uv one-to-one"


@pytest.mark.parametrize(
    ("triangles", "uv", "loop", "fault"),
    [
        ([[0, 1, 2]], None, None, r"\[!!\] every point used: 1 unused"),
        ([[0, 1, 2], [0, 3, 2]], None, None, r"\[!!\] edges manifold, orientation consistent: 1 edges at fault"),
        (WHOLE, None, [0, 1, 2], r"\[!!\] boundary as asked for: another loop"),
        (WHOLE, SQUARE[:, :2] * [0, 1], None, r"\[!!\] uv distinct: 4 points coincide"),
        (WHOLE, SQUARE[:, :2] * [-1, 1], None, r"\[!!\] uv one-to-one, .*: 2 triangles flat or folded"),
    ],
)
def test_every_fault_has_its_line(triangles, uv, loop, fault):
    text = "\n".join(certificate_lines(certify(SQUARE, triangles, uv=uv, loop=loop)))
    assert re.search(fault, text)


def test_the_summary_of_a_bad_mesh_names_all_faults():
    ring = shapes.annulus(12, 3)
    assert summary(certify(ring.points, ring.triangles)) == (
        "no disc: its Euler characteristic is 0 instead of 1, it has 2 boundary loops instead of 1"
    )


@pytest.mark.parametrize("holes", [0, 1, 2])
def test_holes_that_were_asked_for_are_no_fault_and_others_are(holes):
    ring = shapes.annulus(12, 3)
    proof = certify(ring.points, ring.triangles, holes=holes)
    lines, report = certificate_lines(proof), certificate_facts(proof)
    assert (report["holes"], report["as_asked"], report["disc"]) == (holes, holes == 1, False)
    if holes == 1:
        assert {"[ok] Euler characteristic 0", "[ok] 2 boundary loops, 1 of them round holes"} <= set(lines)
        assert summary(proof) == "a certified disc with a hole: 36 points, 48 triangles"
    else:
        loops = "one boundary loop" if holes == 0 else "3 boundary loops, 2 of them round holes"
        assert {f"[!!] Euler characteristic {1 - holes}: it is 0", f"[!!] {loops}: there are 2"} <= set(lines)
        assert summary(proof) == (
            f"no disc: its Euler characteristic is 0 instead of {1 - holes}, it has 2 boundary loops instead of "
            f"{1 + holes}"
        )


def test_the_summary_counts_several_holes():
    shape = shapes.pierce(shapes.disc(1200), n_gaps=3, radius_in_spacings=3.5)
    proof = certify(shape.points, shape.triangles, uv=shape.uv, holes=3)
    assert summary(proof) == (
        f"a certified disc with 3 holes: {len(shape.points)} points, {len(shape.triangles)} triangles, uv one-to-one"
    )


def test_a_folded_disc_is_called_folded():
    proof = certify(SQUARE, WHOLE, uv=SQUARE[:, :2] * [-1, 1])
    assert summary(proof) == "a certified disc: 4 points, 2 triangles, uv folded at 2 triangles"


def test_what_was_not_checked_is_null():
    report = certificate_facts(certify(SQUARE, WHOLE))
    assert report["boundary_as_given"] is None
    assert report["uv_distinct"] is None
    assert report["uv_positive"] is None
