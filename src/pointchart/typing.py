"""Names of the arrays that travel between stages.

============  ==========  =======  ===========================================================
name          shape       dtype    meaning
============  ==========  =======  ===========================================================
`Points`      (n, 3)      float64  the scan, in the unit of the file
`UV`          (n, 2)      float64  planar parameters, dimensionless
`Triangles`   (m, 3)      integer  point indices, anticlockwise seen from the outside
`Loop`        (b,)        int64    boundary points in order, anticlockwise, not closed
`Weights`     (nnz,)      float64  one convex weight for each neighbour, dimensionless
============  ==========  =======  ===========================================================
"""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[Any]  # of int64, or of int32 inside the pipeline
Mask: TypeAlias = NDArray[np.bool_]
Points: TypeAlias = Floats
UV: TypeAlias = Floats  # dimensionless
Weights: TypeAlias = Floats
Triangles: TypeAlias = Indices
Loop: TypeAlias = Indices
Attributes: TypeAlias = dict[str, NDArray[Any]]
