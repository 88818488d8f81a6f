import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import pointchart

PACKAGE = Path(pointchart.__file__).parent
HEAVY = {"numpy", "scipy", "numba", "matplotlib", "trimesh", "rich", "typer"}


def said(code):
    """Return what another interpreter prints."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()


def test_the_package_is_imported_without_the_libraries_it_uses():
    assert not HEAVY & set(said("import sys, pointchart; print(*{name.partition('.')[0] for name in sys.modules})"))


def test_every_public_name_is_there_and_listed():
    namespace = {}
    exec("from pointchart import *", namespace)
    assert set(pointchart.__all__) <= set(dir(pointchart))
    assert set(pointchart.__all__) <= set(namespace)
    for name in pointchart.__all__:
        assert namespace[name] is getattr(pointchart, name)


def test_type_checkers_see_the_names_that_are_there_at_run_time():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    lines = [line for line in tree.body if isinstance(line, ast.ImportFrom)]
    assert sorted(alias.asname for line in lines for alias in line.names) == sorted(pointchart.__all__)
    for line in lines:
        module = import_module(f"pointchart.{line.module}")
        assert all(getattr(module, alias.name) is getattr(pointchart, alias.asname) for alias in line.names)


def test_a_name_that_there_is_not_is_an_attribute_error():
    with pytest.raises(AttributeError, match="No pointchart attribute nonsense"):
        pointchart.nonsense  # noqa: B018
