import copy
import importlib
import pkgutil

import numpy as np
import pytest
from kernel_cases import CASES

from pointchart import _kernels


def kernels():
    found = {}
    for module in pkgutil.walk_packages(_kernels.__path__, f"{_kernels.__name__}."):
        loaded = importlib.import_module(module.name)
        for name, value in vars(loaded).items():
            if hasattr(value, "py_func") and value.py_func.__module__ == loaded.__name__:
                found[f"{module.name.rpartition('.')[2]}.{name}"] = value
    return found


def test_every_kernel_has_a_case():
    assert set(kernels()) == {name.split()[0] for name in CASES}


@pytest.mark.parametrize("name", CASES)
def test_a_compiled_kernel_equals_its_python_function(name):
    kernel, arguments = kernels()[name.split()[0]], CASES[name]()
    compiled, plain = copy.deepcopy(arguments), copy.deepcopy(arguments)
    with np.errstate(over="ignore"):  # hashes wrap around
        answers = kernel(*compiled), kernel.py_func(*plain)
    assert np.allclose(*map(numbers, answers), rtol=1e-12, atol=1e-14, equal_nan=True)
    for one, other in zip(arrays(compiled), arrays(plain), strict=True):
        # Compiled sums of single numbers are of double ones.
        rtol, atol = (1e-6, 1e-7) if one.dtype == np.float32 else (1e-12, 1e-14)
        assert np.allclose(one, other, rtol=rtol, atol=atol)


def numbers(answer):
    """All numbers of an answer, which may be a tuple of tuples."""
    if isinstance(answer, tuple):
        return np.concatenate([numbers(part) for part in answer])
    return np.array(answer, dtype=float).ravel()


def arrays(arguments):
    """All arrays among arguments and in the drafts among them."""
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            yield argument
        elif isinstance(argument, tuple):
            yield from arrays(argument)
