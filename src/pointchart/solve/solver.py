"""What a solver is: a function of a matrix and right sides."""

from collections.abc import Callable
from typing import TypeAlias

import scipy.sparse as sp

from ..typing import Floats

Solved: TypeAlias = tuple[Floats, tuple[int, ...]]
Solver: TypeAlias = Callable[[sp.csr_array, Floats], Solved]
