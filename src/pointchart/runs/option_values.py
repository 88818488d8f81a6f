"""The values that options of a run can have, as words."""

from enum import StrEnum


class Neighbors(StrEnum):
    """Kinds of neighbourhoods."""

    delaunay = "delaunay"
    nearest = "nearest"
    ball = "ball"


class Weighting(StrEnum):
    """Kinds of weights."""

    mean_value = "mean-value"
    shape_preserving = "shape-preserving"
    reciprocal = "reciprocal"
    uniform = "uniform"


class Domain(StrEnum):
    """Kinds of convex domains."""

    circle = "circle"
    square = "square"


class SurfaceDomain(StrEnum):
    """Kinds of domains of a fitted surface."""

    free = "free"
    square = "square"


class Spacing(StrEnum):
    """Kinds of spacing along the boundary."""

    chord = "chord"
    uniform = "uniform"
    centripetal = "centripetal"


class KeptPoint(StrEnum):
    """Which of the points at one place of a plane stays."""

    highest = "highest"
    lowest = "lowest"


class Holes(StrEnum):
    """What becomes of gaps of the scan."""

    bridge = "bridge"
    open = "open"


class Component(StrEnum):
    """Which part of a scan that falls into several."""

    largest = "largest"


class Swap(StrEnum):
    """Kinds of edge swaps."""

    delaunay = "delaunay"
    normals = "normals"
    mean_curvature = "mean-curvature"
    gaussian_curvature = "gaussian-curvature"
    curvature = "curvature"
    none = "none"


class Chart(StrEnum):
    """Kinds of parameters."""

    mesh = "mesh"
    low_stretch = "low-stretch"
    free = "free"
    paper = "paper"


class Unit(StrEnum):
    """Units of length."""

    mm = "mm"
    cm = "cm"
    m = "m"
    um = "um"
    inch = "in"
    ft = "ft"


class Figure(StrEnum):
    """Kinds of figures."""

    cloud = "cloud"
    plane = "plane"
    mesh = "mesh"
    deviation = "deviation"
    zebra = "zebra"


class Axis(StrEnum):
    """Axes of the file."""

    x = "x"
    y = "y"
    z = "z"
