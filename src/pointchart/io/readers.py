"""One door for every format that can be read."""

from collections.abc import Callable

from ..errors import FormatError
from .advice import advice_on
from .arrays import read_npy, read_npz
from .geotiff import read_geotiff
from .glb import read_glb
from .grids import read_asc
from .laser import read_e57, read_las
from .obj import read_obj
from .off import read_off
from .pcd import read_pcd
from .ply import read_ply
from .scan import Scan
from .scanner_text import read_pts, read_ptx
from .source import AnyPath, split_suffix
from .stl import read_stl
from .text import read_text
from .vtk_points import read_vtk
from .vtk_xml import read_vtk_xml

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
    ".dat": read_text,
    ".xyzn": read_text,
    ".xyzi": read_text,
    ".xyzrgb": read_text,
    ".asc": read_asc,
    ".pts": read_pts,
    ".ptx": read_ptx,
    ".pcd": read_pcd,
    ".vtk": read_vtk,
    ".vtp": read_vtk_xml,
    ".vtu": read_vtk_xml,
    ".tif": read_geotiff,
    ".tiff": read_geotiff,
    ".npy": read_npy,
    ".npz": read_npz,
    ".las": read_las,
    ".laz": read_las,
    ".e57": read_e57,
}
_FROM_DISK = (
    read_npy,
    read_npz,
    read_las,
    read_e57,
    read_geotiff,
)  # by libraries that open the file themselves: not packed
_TEXT = (read_text, read_asc, read_pts)
READABLE_SUFFIXES = tuple(_READERS)  # in lower case, as suffixes are compared


def read_scan(path: AnyPath, *, columns: tuple[str, str, str] | None = None) -> Scan:
    r"""Read a point cloud or the vertices and faces of a mesh.

    Point i of the result is point i of the file: nothing is merged, dropped or reordered, save that the repeated
    corners of an STL file become one point each. Polygons are cut into triangles.

    Parameters
    ----------
    path
        A file with one of the suffixes in `READABLE_SUFFIXES`; behind those of text, PLY, PCD and their like may stand
        .gz, .bz2 or .xz.
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
    >>> from pathlib import Path
    >>> path = Path(tempfile.mkdtemp()) / "scan.csv"
    >>> _ = path.write_text("x,y,z,red\n1,2,3,255\n")
    >>> scan = read_scan(path)
    >>> scan.points, scan.attributes
    (array([[1., 2., 3.]]), {'red': array([255.])})
    """
    suffix, packing = split_suffix(path)
    if suffix not in _READERS:
        raise FormatError(f"{path}: {advice_on(suffix, READABLE_SUFFIXES)}")
    read = _READERS[suffix]
    if packing and read in _FROM_DISK:
        raise FormatError(f"{path}: {suffix} is read from the disk as it is; unpack it first")
    if columns is not None and read not in _TEXT:
        raise FormatError(f"{path}: {suffix} names its coordinates itself; choose columns of text files only")
    scan = read_text(path, columns) if columns is not None else read(path)
    if not len(scan.points):
        raise FormatError(f"{path}: the file holds 0 points; export it again with its points")
    return scan
