"""Remedies of errors: the library's words without options, a run's words with those that it has."""

from pathlib import Path

import numpy as np
import pytest

from pointchart import shapes
from pointchart.errors import InputError, PointchartError, Remedy, SolveError, points_called
from pointchart.runs.boundary_run import BoundaryRun
from pointchart.runs.commands import RECORDS
from pointchart.runs.fit_run import FitFiles, FitRun
from pointchart.runs.mesh_run import MeshOptions, MeshRun
from pointchart.runs.options import options_of
from pointchart.runs.param_run import ParamRun
from pointchart.runs.remedies import OPTIONS, sentence
from pointchart.runs.shared_options import GivenBoundary, ScanFile, Source

SCAN, OUT = Path("a.ply"), Path("b.ply")
MESH = MeshRun(source=Source(scan=SCAN), out=OUT)
SECOND = SolveError(
    "a second boundary",
    remedies=(Remedy.bridge_gaps, Remedy.leave_gaps_open, Remedy.name_the_outer_loop, Remedy.give_the_boundary),
)
PARTS = InputError("two parts", remedies=(Remedy.take_the_largest_part, Remedy.take_one_part))


def test_the_library_names_no_options():
    from pointchart import reconstruct

    with pytest.raises(SolveError) as raised:
        reconstruct(shapes.annulus().points)
    assert str(raised.value).endswith("; bridge it, leave it open, say which is the outer one, or give the boundary")
    assert "--" not in str(raised.value)


@pytest.mark.parametrize(
    ("error", "run", "words"),
    [
        (
            SECOND,
            MESH,
            "; bridge it (--holes bridge), leave it open (--holes open), say which is the outer one (--outer x,y,z), "
            "or give the boundary (--boundary)",
        ),
        (
            SECOND,
            MeshRun(source=Source(scan=SCAN), out=OUT, mesh=MeshOptions(holes="open")),
            "; bridge it (--holes bridge), say which is the outer one (--outer x,y,z), "
            "or give the boundary (--boundary)",
        ),
        (
            SECOND,
            BoundaryRun(source=Source(scan=SCAN), out=OUT),
            "; say which is the outer one (--outer x,y,z)",
        ),
        (PARTS, MESH, "; take the largest (--component largest), or take them one by one"),
        (PARTS, MeshRun(source=Source(scan=SCAN, component="largest"), out=OUT), "; take them one by one"),
        (PARTS, ParamRun(source=ScanFile(scan=SCAN), out=OUT), "; take them one by one"),
        (InputError("nothing helps"), MESH, ""),
        (
            SolveError("too far", remedies=(Remedy.allow_deviation, Remedy.take_the_best)),
            FitRun(source=Source(scan=SCAN), files=FitFiles(out=OUT)),
            "; take a larger tolerance (--tolerance), or take the best that there is (--best-effort)",
        ),
    ],
)
def test_a_run_names_the_options_that_it_has_and_that_are_not_in_force(error, run, words):
    assert sentence(error, run) == str(error).partition(";")[0] + words


@pytest.mark.parametrize(
    ("given", "is_named"),
    [(GivenBoundary(), True), (GivenBoundary(boundary=Path("l.txt")), False), (GivenBoundary(outer="0,0,0"), True)],
)
def test_a_boundary_that_is_given_is_no_remedy(given, is_named):
    error = SolveError("torn", remedies=(Remedy.cut_the_scan, Remedy.give_the_boundary))
    run = MeshRun(source=Source(scan=SCAN), out=OUT, given=given)
    assert ("give the boundary (--boundary)" in sentence(error, run)) == is_named


def test_every_option_of_a_remedy_is_one_of_a_run():
    known = {option.name for record in RECORDS.values() for option in options_of(record)}
    assert {name for name, _ in OPTIONS.values()} <= known


def test_remedies_stay_when_points_are_renumbered():
    with (
        pytest.raises(PointchartError, match=r"point 20; cut the scan there$") as raised,
        points_called(np.arange(0, 99, 10)),
    ):
        raise SolveError("point {here}", remedies=(Remedy.cut_the_scan,), here=2)
    assert raised.value.remedies == (Remedy.cut_the_scan,)
