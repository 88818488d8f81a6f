"""A small scan, meshes of it and empty arrays, which kernels are tried on."""

import numpy as np

from pointchart._kernels.mesh import put_back
from pointchart.agreement.agreed_surface import patchwork
from pointchart.mesh.connectivity import editable_mesh
from pointchart.points.neighbors import nearest, spacing
from pointchart.points.planes import normals
from pointchart.points.stars import delaunay_star
from pointchart.shapes import disc, relief
from pointchart.surface import interpolate_clough_tocher

SHAPE = relief(60, seed=3)
N = len(SHAPE.points)
AROUND = nearest(SHAPE.points, 9)
NORMALS = normals(SHAPE.points, AROUND)
STAR = delaunay_star(SHAPE.points, AROUND)
M = len(SHAPE.triangles)
STEP = spacing(SHAPE.points)
RAGGED = patchwork(SHAPE.triangles[7:], N)
WITHIN = np.setdiff1d(np.arange(N), SHAPE.boundary)
ASTRAY = int(WITHIN[7])
CUBICS = interpolate_clough_tocher(SHAPE.points, SHAPE.uv, SHAPE.triangles)
FAR = int(WITHIN[0]), int(WITHIN[np.argmax(((SHAPE.uv - SHAPE.uv[WITHIN[0]]) ** 2).sum(axis=1)[WITHIN])])


def ints(n):
    return np.zeros(n, np.int64)


def bools(n):
    return np.zeros(n, np.bool_)


def int32s(n):
    return np.zeros(n, np.int32)


def draft():
    return editable_mesh(SHAPE.points, SHAPE.triangles, journal=put_back.JOURNAL)


def draft_in_plane():
    return editable_mesh(SHAPE.uv, SHAPE.triangles, journal=2)


def mixed_draft():
    return editable_mesh(SHAPE.points, disc(60, seed=1).triangles, journal=put_back.JOURNAL)
