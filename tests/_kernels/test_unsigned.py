import numpy as np
import pytest

from pointchart._kernels.unsigned import unsigned


@pytest.mark.parametrize(("kind", "wanted"), [(np.int32, np.uint32), (np.int64, np.uint64)])
def test_an_unsigned_view_shares_memory_and_keeps_values(kind, wanted):
    signed = np.array([0, 7, np.iinfo(kind).max], kind)
    for array in (signed, signed[::2], signed[:0]):
        view = unsigned(array)
        assert view.dtype == wanted
        assert view.tolist() == array.tolist()
    unsigned(signed)[1] = 5
    assert signed[1] == 5


@pytest.mark.parametrize("kind", [np.uint32, np.uint64, np.bool_, np.float64])
def test_what_has_no_sign_to_lose_stays_as_it_is(kind):
    array = np.arange(3).astype(kind)
    assert unsigned(array).dtype == array.dtype
    assert np.shares_memory(unsigned(array), array)
