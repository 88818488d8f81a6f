"""Measures of simulated shapes."""

import numpy as np


def signed_areas(uv, triangles):
    a, b, c = uv[triangles.T]
    return np.linalg.det(np.stack([b - a, c - a], axis=1)) / 2


def sorted_edges(triangles):
    return np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)


def edge_lengths(shape):
    edges = np.unique(sorted_edges(shape.triangles), axis=0)
    return np.linalg.norm(shape.points[edges[:, 0]] - shape.points[edges[:, 1]], axis=1)


def euler_characteristic(shape):
    n_edges = len(np.unique(sorted_edges(shape.triangles), axis=0))
    return len(np.unique(shape.triangles)) - n_edges + len(shape.triangles)


def has_one_fan_a_point(shape):
    """Tell whether the link of every point is one path or one cycle, so that the mesh is a manifold there."""
    links = {}
    for a, b, c in shape.triangles.tolist():
        for corner, link in ((a, (b, c)), (b, (c, a)), (c, (a, b))):
            links.setdefault(corner, []).append(link)
    for link in links.values():
        parts = {end: end for edge in link for end in edge}
        for start, end in link:
            first, second = parts[start], parts[end]
            parts = {point: second if part == first else part for point, part in parts.items()}
        if len(set(parts.values())) > 1:
            return False
    return True


def normals_of(shape):
    a, b, c = shape.points[shape.triangles.T]
    return np.cross(b - a, c - a)


def point_normals(shape):
    normals = np.zeros_like(shape.points)
    np.add.at(normals, shape.triangles, normals_of(shape)[:, None, :])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)
