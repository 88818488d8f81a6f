"""Simulated scans and surfaces with exactly known answers, for tests, benchmarks and the demo."""

from pointchart.shapes.bend import raise_bumps, roll
from pointchart.shapes.caps import hemisphere, tube
from pointchart.shapes.discs import bent_sheet, disc, dumbbell, fold, grid, relief
from pointchart.shapes.perturb import add_noise, grade, pierce, shuffle, thin
from pointchart.shapes.sculpted_face import sculpted_face
from pointchart.shapes.shape import Shape
from pointchart.shapes.simulated_laser import Surface, demo_scan, laser_scan, sculpture
from pointchart.shapes.topologies import annulus, moebius, sphere, torus

__all__ = [
    "Shape",
    "Surface",
    "add_noise",
    "annulus",
    "bent_sheet",
    "demo_scan",
    "disc",
    "dumbbell",
    "fold",
    "grade",
    "grid",
    "hemisphere",
    "laser_scan",
    "moebius",
    "pierce",
    "raise_bumps",
    "relief",
    "roll",
    "sculpted_face",
    "sculpture",
    "shuffle",
    "sphere",
    "thin",
    "torus",
    "tube",
]
