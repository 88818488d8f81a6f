import pytest

from pointchart._kernels.mesh import half_edges


@pytest.mark.parametrize("h", range(9))
def test_following_and_preceding_half_edges_are_inverse(h):
    assert half_edges.following(half_edges.preceding(h)) == h
    assert half_edges.following(h) // 3 == h // 3
