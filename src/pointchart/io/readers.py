"""One door for every format that can be read."""

from collections.abc import Callable
from pathlib import Path

from ..errors import FormatError
from .arrays import read_npy, read_npz
from .glb import read_glb
from .laser import read_e57, read_las
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .scan import Scan
from .source import AnyPath
from .stl import read_stl
from .text import read_text

# In the order in which a message names them.
_READERS: dict[str, Callable[[AnyPath], Scan]] = {
    ".ply": read_ply,
    ".obj": read_obj,
    ".off": read_off,
    ".stl": read_stl,
    ".glb": read_glb,
    ".xyz": read_text,
    ".txt": read_text,
    ".csv": read_text,
    ".pts": read_text,
    ".asc": read_text,
    ".npy": read_npy,
    ".npz": read_npz,
    ".las": read_las,
    ".laz": read_las,
    ".e57": read_e57,
}
READABLE_SUFFIXES = tuple(_READERS)  # in lower case, as suffixes are compared


def read_scan(path: AnyPath, *, columns: tuple[str, str, str] | None = None) -> Scan:
    r"""Read a point cloud or the vertices and faces of a mesh.

    Point i of the result is point i of the file: nothing is merged, dropped or reordered, save that the repeated
    corners of an STL file become one point each. Polygons are cut into triangles.

    Parameters
    ----------
    path
        A file with one of the suffixes in `READABLE_SUFFIXES`.
    columns
        The columns of a text file that are x, y, z: names of its header, or numbers from 1.

    Returns
    -------
    The points, the triangles if there are any, and every further value that the file has for each point.

    Raises
    ------
    FormatError
        The file is missing, of an unknown format, damaged or without points.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "scan.csv"
    >>> _ = path.write_text("x,y,z,red\n1,2,3,255\n")
    >>> scan = read_scan(path)
    >>> scan.points, scan.attributes
    (array([[1., 2., 3.]]), {'red': array([255.])})
    """
    suffix = Path(path).suffix.lower()
    if suffix not in _READERS:
        known = ", ".join(READABLE_SUFFIXES)
        raise FormatError(f"{path}: the suffix '{suffix}' is none of the {len(_READERS)} that can be read: {known}")
    if columns is not None and _READERS[suffix] is not read_text:
        raise FormatError(f"{path}: {suffix} names its coordinates itself; choose columns of text files only")
    scan = read_text(path, columns) if columns is not None else _READERS[suffix](path)
    if not len(scan.points):
        raise FormatError(f"{path}: the file holds 0 points; export it again with its points")
    return scan
