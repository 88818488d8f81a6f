import numpy as np
from kernel_cases.samples import FAR, SHAPE, N, draft_in_plane, ints

from pointchart._kernels.surface import constrain
from pointchart.mesh.connectivity import editable_mesh
from pointchart.mesh.planar_delaunay import triangulate
from pointchart.plane.exact_signs import orientation_signs


def test_a_far_side_becomes_an_edge_and_no_triangle_turns_over():
    changed = draft_in_plane()
    assert constrain.insert_side(changed, ints(N) - 1, *FAR) == -1
    triangles = changed.corners.reshape(-1, 3)
    assert np.isin(triangles, FAR).sum(axis=1).tolist().count(2) == 2
    assert (orientation_signs(SHAPE.uv, triangles) == 1).all()


def test_a_side_stops_at_a_point_on_it_and_at_a_side_across_it():
    places = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1], [-0.5, 0], [0.5, 0], [0, 0.0]])
    ahead = ints(7) - 1
    ahead[4] = 5
    for middle, found in ((0.0, [6]), (0.1, [-1])):
        places[6, 1] = middle
        mesh = editable_mesh(places, triangulate(places, np.arange(4)), journal=2)
        assert constrain.insert_side(mesh, ahead, 4, 5) in found
    ahead[6] = 1
    places[6, 1] = 0.2
    mesh = editable_mesh(places, triangulate(places, np.arange(4)), journal=2)
    assert constrain.constrain(mesh, ahead) != (-1, -1)
