import numpy as np

from pointchart.look.page.pack import packed, quantized, steps


def test_numbers_are_rounded_to_half_a_level():
    values = np.random.default_rng(0).uniform(-3.0, 5.0, 1000)
    back = -3.0 + quantized(values, -3.0, 8.0) * (8.0 / 65535)
    assert np.abs(back - values).max() <= 4.0 / 65535 * (1 + 1e-9)


def test_steps_add_up_to_the_indices():
    indices = np.random.default_rng(0).integers(0, 2**31, 1000)
    coded = steps(indices).astype(np.int64)
    assert np.array_equal(np.cumsum(np.where(coded % 2, -(coded + 1) // 2, coded // 2)), indices)


def test_arrays_of_a_page_lie_one_after_the_other():
    table, _ = packed({"a": np.zeros((4, 3), np.uint16), "b": np.zeros(2, np.float32)})
    assert [(row["offset"], row["length"]) for row in table] == [(0, 12), (24, 2)]
