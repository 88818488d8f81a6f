"""Options of runs: each described once, for the command line and for whoever renders it."""

import ast
import re
from dataclasses import fields
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.main import get_command

import pointchart
from pointchart.cli import app
from pointchart.runs.command_line import words_of
from pointchart.runs.commands import RECORDS
from pointchart.runs.options import Group, changed, options_of, record_of, values_of

PACKAGE = Path(pointchart.__file__).parent
COMMANDS = get_command(app).commands
MOST_PARAMETERS = 8
WORDS = st.text(st.characters(codec="ascii", min_codepoint=33), min_size=1, max_size=8)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


def parsed(words):
    """Return the run that words on the command line amount to."""
    name, *rest = words
    return record_of(RECORDS[name], COMMANDS[name].make_context(name, rest).params)


def values(option):
    """Return all values that an option can have."""
    if option.choices:
        every = st.sampled_from(list(option.kind))
    elif option.kind is int:
        every = st.integers(int(option.least), None if option.most is None else int(option.most))
    elif option.kind is float:
        every = NUMBERS if option.least is None else st.floats(option.least, option.most)
    else:
        every = {bool: st.booleans(), str: WORDS, Path: WORDS.map(Path)}[option.kind]
    is_left_out = option.default is None
    # Of a switch of one word, nobody can say that it is off.
    return st.one_of(st.none(), every) if is_left_out else every


@st.composite
def runs(draw, record):
    """Draw a run with some of its options given."""
    options = options_of(record)
    drawn = [option for option in options if option.is_required or draw(st.booleans())]
    return record_of(record, {option.name: draw(values(option)) for option in drawn})


@pytest.mark.parametrize("name", RECORDS)
@given(data=st.data())
def test_the_words_of_a_run_give_the_run_again(name, data):
    run = data.draw(runs(RECORDS[name]))
    assert parsed(words_of(run)) == run


@pytest.mark.parametrize("name", RECORDS)
def test_a_run_by_its_defaults_has_no_words_but_its_command_and_what_has_to_be_given(name):
    required = [option for option in options_of(RECORDS[name]) if option.is_required]
    run = record_of(RECORDS[name], {o.name: next(iter(o.kind)) if o.choices else Path("a.ply") for o in required})
    n_named = sum(bool(option.flags) for option in required)
    assert len(words_of(run)) == 1 + len(required) + n_named


@pytest.mark.parametrize("name", RECORDS)
def test_values_that_are_changed_are_those_of_the_option_wherever_it_is_held(name):
    record = RECORDS[name]
    run = record_of(
        record, {o.name: o.kind("cloud" if o.choices else "a") for o in options_of(record) if o.is_required}
    )
    path = next(option.name for option in options_of(record) if option.kind is Path)
    assert values_of(changed(run, **{path: Path("b")})) == values_of(run) | {path: Path("b")}


@pytest.mark.parametrize("name", RECORDS)
def test_every_option_has_help_a_group_and_a_name_of_its_own(name):
    options = options_of(RECORDS[name])
    assert all(isinstance(option.group, Group) and option.help.endswith((".", "...")) for option in options)
    assert len({option.name for option in options}) == len(options)
    flags = [flag for option in options for flag in option.flags]
    assert len(set(flags)) == len(flags)


@pytest.mark.parametrize("name", RECORDS)
def test_the_help_lists_every_option_in_the_section_of_its_group(name, command_line):
    _, out, _ = command_line(name, "--help")
    sections = dict(re.findall(r"^(\S[^\n]*):\n((?:(?:  [^\n]*)?\n)+)", out, flags=re.M))
    groups = [group for group in Group if group in sections]
    assert [section for section in sections if section in list(Group)] == groups
    for option in options_of(RECORDS[name]):
        said = option.flags[0].partition("/")[0] if option.flags else option.metavar
        assert re.search(rf"(^|\s){re.escape(said)}\b", sections[option.group]), said
    assert "--help" in sections[Group.running]


@pytest.mark.parametrize(
    "path",
    sorted([path for room in ("cli", "report", "runs") for path in PACKAGE.glob(f"{room}/**/*.py")]),
    ids=lambda p: p.name,
)
def test_no_function_has_more_parameters_than_one_can_keep_in_mind(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            told = node.args
            n = len([*told.posonlyargs, *told.args, *told.kwonlyargs]) + bool(told.vararg) + bool(told.kwarg)
            assert n <= MOST_PARAMETERS, f"{node.name} has {n}"


@pytest.mark.parametrize("name", RECORDS)
def test_no_record_holds_more_than_one_can_keep_in_mind(name):
    assert len(fields(RECORDS[name])) <= MOST_PARAMETERS
