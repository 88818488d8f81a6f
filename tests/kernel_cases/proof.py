"""Arguments for every kernel of the room `proof`."""

import numpy as np

from kernel_cases.samples import SHAPE, ints
from pointchart.proof.intersections import box_tree

SPANS = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [9, 9, 0], [5, 5, 0], [6, 5, 0], [5, 6, 0]])
SPAN_BOXES = box_tree(SPANS[::3], SPANS[1::3], SPANS[2::3])


CASES = {
    "triangle_meetings.side": lambda: (SHAPE.points, 0, 1, 2, 3),
    "triangle_meetings.sides_of": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "triangle_meetings.pierces": lambda: (SPANS, (3, 4, 5), (-1, 1, 0), (0, 1, 2)),
    "triangle_meetings.is_apart_in_plane": lambda: (SPANS, (0, 1, 2), (6, 7, 8), 0, 1),
    "triangle_meetings.meet": lambda: (SPANS, (0, 1, 2), (3, 4, 5)),
    "triangle_meetings.overlap": lambda: (SPAN_BOXES, 3, (0.5, 0.5, -0.5, 2.0, 2.0, 0.5)),
    "triangle_meetings.find_meetings": lambda: (SPANS, np.arange(9).reshape(3, 3), SPAN_BOXES, 0, 3, ints((2, 3))),
}
