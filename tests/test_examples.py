import runpy
from math import pi
from pathlib import Path

import pytest
from matplotlib import pyplot as plt

EXAMPLES = Path(__file__).parents[1] / "examples"


ANSWERS = {
    "fit_surface": pytest.approx(1.0, abs=0.01),
    "gaps_of_a_scan": 3,
    "mesh_a_scan": pytest.approx(2 * 1696 - 80, abs=12),  # a disc of 1696 points, some 78 of them on the boundary
    "own_boundary": pytest.approx(2 * pi, rel=2e-3),
    "own_weights": pytest.approx(1.0, abs=1e-12),
    "paper_methods": pytest.approx(0.93, abs=0.03),
    "stage_by_stage": 1,
}


@pytest.fixture(autouse=True)
def closed():
    """Close the figures that a gallery would show."""
    yield
    plt.close("all")


def run(name):
    return runpy.run_path(str(EXAMPLES / f"{name}.py"))["main"]()


@pytest.mark.parametrize("name", ANSWERS)
def test_an_example_gives_the_number_it_promises(name, capsys):
    assert run(name) == ANSWERS[name]
    assert len(capsys.readouterr().out.splitlines()) >= 1


def test_every_example_is_tested():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(ANSWERS)
