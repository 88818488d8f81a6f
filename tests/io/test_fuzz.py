"""Mutated files of every format end in a scan or in one sentence; ``benchmarks/fuzz.py`` does this at length."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pointchart import FormatError, read_scan, shapes, write_mesh
from pointchart.io import MESH_SUFFIXES, READABLE_SUFFIXES

CAP = shapes.hemisphere(12)
ROWS = "".join(f"{x!r} {y!r} {z!r} {i}\n" for i, (x, y, z) in enumerate(CAP.points.tolist()))
POSE = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
PCD = "VERSION 0.7\nFIELDS x y z i\nSIZE 8 8 8 8\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 12\nHEIGHT 1\nPOINTS 12\n"
BY_HAND = {".pcd": PCD + "DATA ascii\n" + ROWS, ".ptx": f"4\n3\n{POSE}{ROWS}", ".pts": f"12\n{ROWS}"}
ONLY = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in CAP.points.tolist())
BY_HAND[".vtk"] = f"# vtk DataFile Version 3.0\npoints\nASCII\nDATASET POLYDATA\nPOINTS 12 double\n{ONLY}"
for suffix, kind in ((".vtp", "PolyData"), (".vtu", "UnstructuredGrid")):
    array = f'<DataArray type="Float64" NumberOfComponents="3" format="ascii">{ONLY}</DataArray>'
    piece = f'<Piece NumberOfPoints="12"><Points>{array}</Points></Piece>'
    BY_HAND[suffix] = f'<VTKFile type="{kind}" version="0.1"><{kind}>{piece}</{kind}></VTKFile>'
FORMATS = [
    suffix for suffix in READABLE_SUFFIXES if suffix not in (".las", ".laz", ".e57", ".tif", ".tiff")
]  # of extras, by libraries
AWKWARD = st.sampled_from([b"-1", b"99999999999999999999", b"nan", b"1e999", b'"', b"\0", b"#", b"\n", b"\xff" * 8])


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder, files = tmp_path_factory.mktemp("whole"), {}
    for suffix in FORMATS:
        path = folder / f"whole{suffix}"
        if suffix in MESH_SUFFIXES:
            write_mesh(path, CAP.points, CAP.triangles)
        elif suffix == ".npy":
            np.save(path, CAP.points)
        else:
            path.write_text(BY_HAND.get(suffix, ROWS))
        files[suffix] = path.read_bytes()
    return files


@pytest.mark.parametrize("suffix", FORMATS)
@given(data=st.data())
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_mutated_file_is_read_or_refused_in_one_sentence(whole, tmp_path, suffix, data):
    content = whole[suffix]
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(content)))
        end = data.draw(st.integers(start, min(len(content), start + 40)))
        content = content[:start] + data.draw(AWKWARD | st.binary(max_size=6)) + content[end:]
    path = tmp_path / f"mutated{suffix}"
    path.write_bytes(content)
    try:
        scan = read_scan(path)
    except FormatError as refused:
        said = str(refused)
    else:
        said = str(path) if scan.points.shape == (len(scan.points), 3) else ""
    assert said.startswith(str(path))
