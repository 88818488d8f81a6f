"""The house rules of CONTRIBUTING.md and docs/developers.md, each as a law over every file."""

import ast
import re
import runpy
import tokenize
from collections import Counter
from pathlib import Path

import pytest

import pointchart

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "pointchart"
SOURCES = sorted(PACKAGE.rglob("*.py"))
KERNELS = PACKAGE / "_kernels"
MODULES = [path for path in SOURCES if path.name not in ("__init__.py", "__main__.py")]
ROOMS = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
MOST_FLAT, LONGEST_FILE, LONGEST_TEST, LONGEST_BODY, MOST_PARAMETERS = 10, 250, 500, 40, 8
# Public functions whose keyword options are the interface.
MANY_OPTIONS = {"reconstruct", "fit_scan", "fit_bspline", "laser_scan"}


@pytest.fixture(scope="module")
def rooms():
    """Return what the script that draws the rooms defines."""
    return runpy.run_path(str(ROOT / "docs" / "rooms.py"))


def called(path):
    """Return the dotted name of a module below the package."""
    return ".".join(path.relative_to(PACKAGE).with_suffix("").parts)


def functions(path):
    """Yield every function of a module with its dotted name, those inside others included."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.FunctionDef):
            yield f"{called(path)}.{node.name}", node


def body_lines(function):
    """Count the lines of a body, the docstring left out."""
    body = function.body[ast.get_docstring(function) is not None :]
    return body[-1].end_lineno - body[0].lineno + 1 if body else 0


def n_parameters(function):
    taken = function.args
    return sum(map(len, (taken.posonlyargs, taken.args, taken.kwonlyargs))) + bool(taken.vararg) + bool(taken.kwarg)


def bare_constants(path):
    """Yield the public constants of a module that neither a comment beside them nor one above their block explains."""
    with path.open("rb") as file:
        commented = {token.start[0] for token in tokenize.tokenize(file.readline) if token.type == tokenize.COMMENT}
    explained = 0  # the line up to which a comment above, and constants without a line between, reach
    for node in ast.parse(path.read_text()).body:
        targets = getattr(node, "targets", [getattr(node, "target", None)])
        names = (
            [part.id for target in targets for part in ast.walk(target) if isinstance(part, ast.Name)]
            if targets[0]
            else []
        )
        lines = range(node.lineno, node.end_lineno + 1)
        if node.lineno - 1 in commented | {explained}:
            explained = node.end_lineno
        if explained != node.end_lineno and not commented.intersection(lines):
            yield from (name for name in names if name.isupper() and not name.startswith("_"))


def check_none_over(most, counts):
    """Fail with all that are over a limit."""
    over = [f"{name}: {count}" for name, count in counts.items() if count > most]
    assert not over, "\n".join(over)


def test_no_two_modules_have_one_name():
    names = Counter(path.stem for path in MODULES if path.parent.name != "cli")
    assert [name for name, count in names.items() if count > 1] == []


def test_no_module_is_named_as_a_public_function():
    assert {path.stem for path in MODULES} & set(pointchart.__all__) == set()


def test_few_modules_lie_flat_beside_the_rooms():
    flat = sorted(path.name for path in PACKAGE.glob("*.py"))
    assert len(flat) <= MOST_FLAT, " ".join(flat)


@pytest.mark.parametrize(("folder", "files"), [(KERNELS, "*.py"), (ROOT / "tests", "test_*.py")])
def test_kernels_and_tests_lie_in_folders_that_are_named_as_rooms(folder, files):
    assert {part for path in folder.rglob(files) for part in path.relative_to(folder).parts[:-1]} <= ROOMS


def test_files_of_the_package_are_short():
    counts = {called(path): len(path.read_text().splitlines()) for path in SOURCES}
    check_none_over(LONGEST_FILE, counts)


def test_files_of_tests_are_short():
    counts = {path.name: len(path.read_text().splitlines()) for path in (ROOT / "tests").rglob("*.py")}
    check_none_over(LONGEST_TEST, counts)


def test_bodies_of_functions_are_short():
    counts = {name: body_lines(node) for path in SOURCES for name, node in functions(path)}
    check_none_over(LONGEST_BODY, counts)


def test_functions_take_few_parameters_but_for_those_whose_options_are_the_interface():
    outside = [path for path in MODULES if KERNELS not in path.parents]
    counts = {name: n_parameters(node) for path in outside for name, node in functions(path)}
    check_none_over(MOST_PARAMETERS, {k: n for k, n in counts.items() if k.rpartition(".")[2] not in MANY_OPTIONS})
    assert {name.rpartition(".")[2] for name, n in counts.items() if n > MOST_PARAMETERS} >= MANY_OPTIONS


def test_every_public_constant_has_a_comment():
    bare = [f"{called(path)}.{name}" for path in MODULES for name in bare_constants(path)]
    assert not bare, "\n".join(bare)


def test_every_module_says_in_one_line_what_it_is(rooms):
    assert [called(path) for path in MODULES if not rooms["purpose"](path)] == []


def test_the_rooms_are_drawn_as_they_are(rooms):
    remedy = "rooms have changed: run `make rooms`, look at docs/figures/rooms.svg and commit what it wrote"
    assert rooms["page"](rooms["PAGE"].read_text()) == rooms["PAGE"].read_text(), remedy
    assert rooms["drawing"]() == rooms["PICTURE"].read_text(), remedy


def test_every_file_that_the_docs_name_is_there():
    folders = [ROOT / name for name in ("benchmarks", "docs", "examples", "src", "tests")]
    there = [f"/{path.relative_to(ROOT)}" for folder in folders for path in folder.rglob("*")]
    for page in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]:
        named = re.findall(r"`((?:[a-z_]+/)+[a-z_]+|[\w./]+\.py)`", page.read_text())
        gone = {name for name in named if not any(path.endswith((f"/{name}", f"/{name}.py")) for path in there)}
        assert not gone, f"{page.name} names {sorted(gone)}"
