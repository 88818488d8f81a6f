"""Arguments for every kernel of the room `io`."""

import numpy as np

CASES = {"lzf.unpack": lambda: (np.array([1, 7, 9, 32, 1], np.uint8), np.empty(5, np.uint8))}
