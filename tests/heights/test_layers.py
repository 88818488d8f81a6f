"""A tile of ground, trees and roofs."""

import numpy as np
import pytest

from pointchart.errors import InputError, Remedy
from pointchart.heights.height_field import Keep, reconstruct_heights
from pointchart.heights.layers import check_one_layer, layered_share

DRAW = np.random.default_rng(8)


def ground(n):
    flat = DRAW.uniform(0, 100, (n, 2))
    return np.column_stack([flat, 5 * np.sin(flat[:, 0] / 20) + 8 * np.cos(flat[:, 1] / 30)])


def trees(n):
    return ground(n) + np.column_stack([np.zeros((n, 2)), DRAW.uniform(2, 15, n)])


def test_ground_has_one_layer_and_a_wood_several():
    assert layered_share(ground(4000)) == 0.0
    assert layered_share(np.r_[ground(4000), trees(2000)]) > 0.3


def test_a_tile_of_several_layers_is_refused_with_what_helps():
    tile = np.r_[ground(4000), trees(2000)]
    with pytest.raises(
        InputError, match=r"points of classes 2 \(4000\), 5 \(2000\) over one another: \d\d%"
    ) as refused:
        check_one_layer(tile, "2 (4000), 5 (2000)")
    assert refused.value.remedies == (Remedy.choose_classes, Remedy.take_heights)
    assert reconstruct_heights(tile, keep=Keep.highest).certificate.is_one_to_one
    check_one_layer(ground(4000), "2 (3000), 9 (1000)")
