"""Arguments for every kernel of the room `surface`."""

import numpy as np

from kernel_cases.samples import CUBICS, FAR, SHAPE, N, draft_in_plane, ints
from pointchart.surface import fit_radial

SPLINES = fit_radial(SHAPE.points, SHAPE.uv, nearby=20)

KNOTS_U = np.array([-1.0, -1, -1, -1, -0.2, 0.3, 0.3, 1, 1, 1, 1])
KNOTS_V = np.array([-1.0, -1, -1, -1, 0.1, 1, 1, 1, 1])
CONTROL = np.random.default_rng(5).normal(size=(7, 5, 3))
WEIGHTS = np.linspace(0.5, 2.0, N)


CASES = {
    "bspline_basis.basis": lambda: (KNOTS_U, 3, 4, 0.1, 2, np.zeros((3, 4)), np.zeros((4, 4)), np.zeros((2, 4))),
    "bspline_basis.basis_rows": lambda: (KNOTS_U, 3, SHAPE.uv[:, 0].copy(), 1, np.zeros((N, 4)), ints((N, 4))),
    "bspline_basis.evaluate": lambda: (KNOTS_U, KNOTS_V, 3, CONTROL, SHAPE.uv, 1, 2, 0, N, np.zeros((N, 3))),
    "bspline_basis.find_span": lambda: (KNOTS_U, 3, 0.3),
    "bspline_basis.gather": lambda: (
        KNOTS_U,
        KNOTS_V,
        3,
        SHAPE.uv,
        SHAPE.points,
        WEIGHTS,
        np.zeros((35, 7, 7)),
        np.zeros((35, 3)),
    ),
    "clough_tocher_element.contract": lambda: (SHAPE.points[:10].copy(), 3, 0.2, 0.5, 0.3),
    "clough_tocher_element.coordinates": lambda: (SHAPE.uv, SHAPE.triangles[5], 0.1, 0.2, np.zeros((3, 3))),
    "clough_tocher_element.evaluate": lambda: (
        CUBICS.uv,
        CUBICS.triangles,
        CUBICS.boxes,
        1e-15,
        CUBICS.points,
        CUBICS.gradients,
        CUBICS.crossings,
        SHAPE.uv,
        1,
        1,
        0,
        N,
        np.zeros((N, 3)),
    ),
    "clough_tocher_element.write_net": lambda: (
        CUBICS.points,
        CUBICS.gradients,
        CUBICS.uv,
        CUBICS.triangles[5],
        CUBICS.crossings[5],
        1,
        np.zeros((10, 3)),
    ),
    "constrain.constrain": lambda: (draft_in_plane(), np.where(np.arange(N) == FAR[0], FAR[1], -1)),
    "constrain.edge_before": lambda: (draft_in_plane(), *FAR),
    "constrain.insert_side": lambda: (draft_in_plane(), ints(N) - 1, *FAR),
    "constrain.turn_of": lambda: (np.array([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]), 0, 1, 2),
    "constrain.unfold": lambda: (draft_in_plane(), int(draft_in_plane().leaving[FAR[0]]), 2),
    "radial_blend.add_product": lambda: (np.arange(6.0), np.arange(24.0).reshape(6, 4), np.ones((6, 4))),
    "radial_blend.divide": lambda: (np.arange(1.0, 25.0).reshape(6, 4),),
    "radial_blend.evaluate": lambda: (
        SPLINES.domain,
        SPLINES.discs,
        SPLINES.boxes,
        SPLINES.centers,
        SPLINES.coefficients,
        SHAPE.uv,
        4,
        0,
        N,
        np.zeros((N, 3)),
    ),
    "radial_blend.start_jet": lambda: (SHAPE.points[:6], 0.1, 0.2, np.zeros((6, 4))),
    "radial_blend.surface_jet": lambda: (
        SPLINES.centers[0],
        SPLINES.coefficients[0],
        0.1,
        0.2,
        0.3,
        2,
        np.zeros((6, 4)),
    ),
    "radial_blend.weight_jet": lambda: (0.1, 0.2, 0.5, np.zeros(6)),
}
