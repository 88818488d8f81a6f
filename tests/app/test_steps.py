import re
from pathlib import Path

import numpy as np
import pytest
from windows import (
    CROSSED,
    FAILS,
    MADE,
    NAMES_ITS_LOOP,
    SLEEPS,
    WRITES,
    WRITES_SILENTLY,
    N,
    download,
    fill,
    mesh_step,
    press,
    run_as,
    tab,
)

from pointchart import InputError
from pointchart.app import boundary_step, cloud_steps, result_steps
from pointchart.app.controls import read_value
from pointchart.app.html import OTHERWISE, dimmed_html, refused_html, report_html
from pointchart.app.loop_by_hand import LoopByHand
from pointchart.app.step import Step
from pointchart.app.step_files import StepFiles
from pointchart.report.record import Check, Note, RunReport, WrittenFile
from pointchart.runs.boundary_run import BoundaryRun
from pointchart.runs.fit_run import FitRun
from pointchart.runs.mesh_run import MeshRun
from pointchart.runs.options import options_of
from pointchart.runs.param_run import ParamRun
from pointchart.runs.process import Cancelled, RunProcess


def test_parameters_are_mapped_and_exported(window, page, tmp_path):
    page.hand = LoopByHand(N)
    tab(window, "UV")
    press(window, "Map to the plane")
    window.get_by_text(f"parameters of {N} points").wait_for()
    table = np.loadtxt(download(window, "Export the parameters", tmp_path / "uv.csv"), delimiter=",", skiprows=1)
    assert np.linalg.norm(table, axis=1).max() == pytest.approx(1.0)


def test_the_surface_is_fitted_and_exported(window, page, tmp_path):
    page.hand = LoopByHand(N)
    tab(window, "Surface")
    fill(window, "Tolerance", "5%")
    press(window, "Fit the surface")
    window.get_by_text("B-spline surface of degree 3").wait_for()
    assert download(window, "Export the surface", tmp_path / "s.step").read_bytes().startswith(b"ISO-10303-21;")


def test_a_run_is_cancelled_by_the_button(window, monkeypatch):
    run_as(monkeypatch, SLEEPS)
    tab(window, "Surface")
    fill(window, "Tolerance", "7%")
    press(window, "Fit the surface")
    press(window, "Cancel")
    window.get_by_text("cancelled; run it again for a result").wait_for()
    press(window, "Export the surface")
    window.get_by_text(re.compile(f"there is no surface yet; fit it first|this surface {OTHERWISE}")).wait_for()


def test_a_result_is_exported_only_while_the_words_and_the_loop_that_made_it_stand(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, WRITES)
    step.run()
    assert step.made("mesh", "make it").read_text() == "made"
    assert [path.name for path in bare.folder.iterdir()] == [MADE]
    for change, back in (
        (lambda: step.controls.set("domain", "square"), lambda: step.controls.set("domain", "circle")),
        (lambda: bare.hand.change(CROSSED), bare.hand.undo),
    ):
        change()
        bare.loop_changed()
        assert OTHERWISE in step._said.content
        with pytest.raises(InputError, match="made by other options or another loop than those that stand now; make"):
            step.made("mesh", "make it")
        back()
        bare.loop_changed()
        assert OTHERWISE not in step._said.content
        assert step.made("mesh", "make it").exists()


def test_a_run_that_says_nothing_clears_the_refusal_of_the_run_before(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, FAILS)
    step.run()
    assert "it is refused" in step._said.content
    bare.loop_changed()
    assert "it is refused" in step._said.content
    run_as(monkeypatch, WRITES_SILENTLY)
    step.run()
    assert step._said.content == ""


def test_a_run_that_is_refused_leaves_the_result_before_to_the_words_that_made_it(bare, monkeypatch):
    step = mesh_step(bare)
    run_as(monkeypatch, WRITES)
    step.run()
    run_as(monkeypatch, FAILS)
    step.controls.set("domain", "square")
    step.run()
    assert "it is refused" in step._said.content
    assert OTHERWISE in step._said.content
    with pytest.raises(InputError, match="made by other options"):
        step.made("mesh", "make it")
    step.controls.set("domain", "circle")
    bare.loop_changed()
    assert dimmed_html(refused_html("it is refused")) in step._said.content
    assert OTHERWISE not in step._said.content
    assert step.made("mesh", "make it").read_text() == "made"
    assert [path.name for path in bare.folder.iterdir()] == [MADE]


def test_a_run_cancelled_when_it_has_just_ended_well_leaves_no_result(bare, monkeypatch):
    step, finish = mesh_step(bare), RunProcess.execute
    run_as(monkeypatch, WRITES)

    def cancelled_at_the_end(process, tell):
        finish(process, tell)
        raise Cancelled

    monkeypatch.setattr(RunProcess, "execute", cancelled_at_the_end)
    step.run()
    with pytest.raises(InputError, match="there is no mesh yet"):
        step.made("mesh", "make it")
    assert list(bare.folder.iterdir()) == []


def test_a_result_is_made_by_the_words_that_stood_when_its_run_began(bare, monkeypatch):
    step, finish = mesh_step(bare), RunProcess.execute
    run_as(monkeypatch, WRITES)

    def changed_meanwhile(process, tell):
        report = finish(process, tell)
        step.controls.set("domain", "square")
        return report

    monkeypatch.setattr(RunProcess, "execute", changed_meanwhile)
    step.run()
    assert OTHERWISE in step._said.content
    with pytest.raises(InputError, match="this mesh was made by other options"):
        step.made("mesh", "make it")
    step.controls.set("domain", "circle")
    assert step.made("mesh", "make it").exists()


def test_a_run_reads_the_loop_from_a_file_that_the_line_shown_does_not_tell_of(bare, monkeypatch):
    step = mesh_step(bare)
    (bare.folder / "loop.txt").write_text("as saved")
    run_as(monkeypatch, NAMES_ITS_LOOP)
    step.run()
    assert ">loop.txt</div>" in step._said.content
    assert (bare.folder / "loop.txt").read_text() == "as saved"


def test_every_control_is_an_option_of_its_command():
    for record, labels in (
        (ParamRun, cloud_steps.METHODS + result_steps.DOMAIN),
        (MeshRun, result_steps.MESH),
        (FitRun, result_steps.SURFACE),
        (BoundaryRun, boundary_step.LABELS),
    ):
        known = {option.name: option for option in options_of(record)}
        assert all(known[name].flags and known[name].help for name, _ in labels)


@pytest.mark.parametrize(
    ("word", "sentence"),
    [("3.7", "-k is '3.7'; a whole number is needed"), ("0", "-k is 0; it has to be at least 1")],
)
def test_a_word_that_is_no_value_of_its_option_is_refused_with_its_flag(word, sentence):
    (k,) = (option for option in options_of(ParamRun) if option.name == "k")
    with pytest.raises(InputError) as refused:
        read_value(k, word)
    assert str(refused.value) == sentence


def test_the_line_of_a_step_that_cannot_be_is_the_reason(bare):
    step = mesh_step(bare)
    step.refresh()
    assert "-o mesh.ply --boundary loop.txt" in step._line.content
    fit = Step(bare, FitRun, "Stub", result_steps.SURFACE, files=StepFiles("s.json", "s.step"), take=lambda: None)
    fit.controls.set("degree", "9")
    fit.refresh()
    assert "--degree is 9; it has to be from 2 to 5" in fit._line.content


def test_a_report_is_shown_as_a_checklist_with_the_largest_of_its_minor_notes():
    notes = [Note("first"), *(Note(f"{k} long", is_minor=True, size=k) for k in (3, 1, 40, 7, 9, 2))]
    checks = Check("whole", True), Check("simple", False, "it crosses"), Check("longest edge", None, "2.0 spacings")
    files = WrittenFile(Path("mesh.ply"), "out", "a disc"), WrittenFile(Path("run.json"), "report", is_told=False)
    shown = re.sub("<[^>]*>", "|", report_html(RunReport("mesh", checks, tuple(notes), files=files), "mesh.obj"))
    said = [part for part in shown.split("|") if part]
    assert said[:6] == ["✓", "whole", "✗", "simple: it crosses", "·", "longest edge 2.0 spacings"]
    assert said[6:] == ["first", "40 long", "9 long", "7 long", "3 long", "2 long", "1 more", "mesh.obj: a disc"]
