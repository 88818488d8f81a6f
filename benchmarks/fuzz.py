"""Read mutated files of every format, and name each input that ends in anything but a scan or one sentence.

    python benchmarks/fuzz.py [--seconds 600] [--seed 0] [--keep FOLDER] [--formats .ply .pcd ...]

A whole file of each format is changed at random: bytes flipped, cut off, repeated, put in, numbers in its text
exchanged for awkward ones. An input fails if reading it raises anything but an error of ours, takes over two seconds,
or over a gigabyte; what ends the process is seen by the file that is left in the folder. Prints a table of how many
inputs of each format were tried. LAZ is unpacked in a process of its own, a few times a second.
"""

import argparse
import sys
import tempfile
import time
import tracemalloc
import warnings
from pathlib import Path

import numpy as np
from paper import markdown

import pointchart as pc
from pointchart import shapes
from pointchart.io import READABLE_SUFFIXES

SLOW, LARGE = 2.0, 1 << 30  # seconds and bytes that no small file may take
AWKWARD = [b"-1", b"0", b"4294967295", b"99999999999999999999", b"nan", b"1e999", b"1.5", b"", b"x", b'"', b"\0", b"#"]
CAP = shapes.hemisphere(40)
COLORS = {name: np.arange(40, dtype=np.uint8) for name in ("red", "green", "blue")}
POSE = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
GRID = "ncols 8\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n"


def whole_files(folder: Path) -> dict[str, list[bytes]]:
    """Return whole files of each suffix, written by the library or by hand."""
    rows = "".join(f"{x!r} {y!r} {z!r} {i} {i} {i}\n" for i, (x, y, z) in enumerate(CAP.points.tolist()))
    files: dict[str, list[bytes]] = {
        suffix: [rows.encode(), b"//X Y Z R G B\n" + rows.encode(), rows.replace(" ", ";").replace(".", ",").encode()]
        for suffix in (".xyz", ".txt", ".csv", ".dat", ".xyzn", ".xyzrgb", ".xyzi")
    }
    files[".csv"].append(b'name,x,y,z\n"a, b","1,234.5","2","3"\nc,4,5,6\n')
    files[".asc"] = [rows.encode(), (GRID + " ".join(map(str, range(40)))).encode()]
    files[".pts"] = [f"40\n{rows}".encode(), f"20\n{''.join(rows.splitlines(True)[:20])}5\n{rows}".encode()]
    files[".ptx"] = [f"8\n5\n{POSE}{rows}".encode()]
    for suffix in (".ply", ".obj", ".off", ".stl", ".glb", ".npz"):
        path = folder / f"whole{suffix}"
        attributes = COLORS if suffix in (".ply", ".npz") else None
        pc.write_mesh(path, CAP.points, CAP.triangles, uv=CAP.uv if suffix != ".stl" else None, attributes=attributes)
        files[suffix] = [path.read_bytes()]
    text = "".join(f"3 {a} {b} {c}\n" for a, b, c in CAP.triangles.tolist())
    corners = f"element face {len(CAP.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    axes = "".join(f"property float {name}\n" for name in ("x", "y", "z", "a", "b", "c"))
    files[".ply"].append(f"ply\nformat ascii 1.0\nelement vertex 40\n{axes}{corners}{rows}{text}".encode())
    np.save(folder / "whole.npy", CAP.points)
    files[".npy"] = [(folder / "whole.npy").read_bytes()]
    fields = "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 40\nHEIGHT 1\nPOINTS 40\nDATA {}\n"
    packed = b"".join(bytes([31]) + block for block in _blocks(np.ascontiguousarray(CAP.points.T).tobytes(), 32))
    sizes = np.array([len(packed), 960], "<u4").tobytes()
    only = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in CAP.points.tolist())
    files[".pcd"] = [
        fields.format("ascii").encode() + only.encode(),
        fields.format("binary").encode() + CAP.points.tobytes(),
        fields.format("binary_compressed").encode() + sizes + packed,
    ]
    head = f"# vtk DataFile Version 3.0\npoints\nASCII\nDATASET POLYDATA\nPOINTS 40 double\n{only}"
    files[".vtk"] = [head.encode()]
    array = f'<DataArray type="Float64" NumberOfComponents="3" format="ascii">{only}</DataArray>'
    piece = f'<Piece NumberOfPoints="40"><Points>{array}</Points></Piece>'
    for suffix, kind in ((".vtp", "PolyData"), (".vtu", "UnstructuredGrid")):
        files[suffix] = [f'<VTKFile type="{kind}" version="0.1"><{kind}>{piece}</{kind}></VTKFile>'.encode()]
    import tifffile

    place = [(33550, 12, 3, (2.0, 2.0, 0.0)), (33922, 12, 6, (0.0, 0.0, 0.0, 100.0, 200.0, 0.0))]
    tifffile.imwrite(folder / "whole.tif", CAP.points[:, 2].reshape(8, 5), extratags=place)
    files[".tif"] = [(folder / "whole.tif").read_bytes()]
    return files | _laser_files(folder)


def _blocks(data: bytes, size: int) -> list[bytes]:
    return [data[start : start + size] for start in range(0, len(data), size)]


def _laser_files(folder: Path) -> dict[str, list[bytes]]:
    import laspy

    files = {}
    for suffix in (".las", ".laz"):
        cloud = laspy.LasData(laspy.LasHeader(point_format=3, version="1.2"))
        cloud.header.scales = np.full(3, 1e-3)
        cloud.x, cloud.y, cloud.z = CAP.points.T
        cloud.write(folder / f"whole{suffix}")
        files[suffix] = [(folder / f"whole{suffix}").read_bytes()]
    return files


def mutated(data: bytes, draw: np.random.Generator) -> bytes:
    """Change a file in one to four ways."""
    for _ in range(draw.integers(1, 5)):
        at = int(draw.integers(len(data) + 1))
        kind = int(draw.integers(6))
        if kind == 0:
            data = data[:at] + bytes(draw.integers(0, 256, int(draw.integers(1, 5)), dtype=np.uint8)) + data[at + 1 :]
        elif kind == 1:
            data = data[:at]
        elif kind == 2:
            end = at + int(draw.integers(1, 200))
            data = data[:end] + data[at:end] + data[end:]
        elif kind == 3:
            data = data[:at] + data[at + int(draw.integers(1, 60)) :]
        elif kind == 4:
            words = data.split(b" ")
            words[int(draw.integers(len(words)))] = AWKWARD[int(draw.integers(len(AWKWARD)))]
            data = b" ".join(words)
        else:
            value = [0, 1, 2**31 - 1, 2**32 - 1, 2**63 - 1][int(draw.integers(5))]
            data = data[:at] + int(value).to_bytes(8, "little")[: int(draw.integers(1, 9))] + data[at + 8 :]
    return data


def fault(path: Path) -> str | None:
    """Say what is wrong with reading a file; None if it ends in a scan or in one sentence of ours."""
    begun = time.perf_counter()
    tracemalloc.reset_peak()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            pc.read_scan(path)
    except pc.PointchartError:
        pass
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    taken, peak = time.perf_counter() - begun, tracemalloc.get_traced_memory()[1]
    if taken > SLOW:
        return f"{taken:.1f} s"
    return f"{peak / 1e6:.0f} MB" if peak > LARGE else None


def main() -> None:
    """Try inputs for so many seconds, one format after the other."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, default=Path("fuzz"), help="folder of inputs that failed")
    parser.add_argument("--formats", nargs="*", default=[s for s in READABLE_SUFFIXES if s not in (".e57", ".tiff")])
    options = parser.parse_args()
    options.keep.mkdir(exist_ok=True)
    draw, tried, failed = np.random.default_rng(options.seed), dict.fromkeys(options.formats, 0), []
    tracemalloc.start()
    with tempfile.TemporaryDirectory() as folder:
        files = whole_files(Path(folder))
        for suffix in options.formats:  # once, so that nothing is compiled or imported while time is taken
            for whole in files[suffix]:
                path = options.keep / f"input{suffix}"
                path.write_bytes(whole)
                pc.read_scan(path)
                path.unlink()
        end = time.monotonic() + options.seconds
        while time.monotonic() < end:
            for suffix in options.formats:
                wholes = files[suffix]
                for _ in range(1 if suffix == ".laz" else 50):
                    path = options.keep / f"input{suffix}"
                    path.write_bytes(mutated(wholes[int(draw.integers(len(wholes)))], draw))
                    tried[suffix] += 1
                    if (said := fault(path)) is not None:
                        kept = path.rename(options.keep / f"failed-{len(failed)}{suffix}")
                        failed.append((kept, said))
                        print(kept, said, file=sys.stderr, flush=True)
                    else:
                        path.unlink()
    print(markdown(["format", "inputs"], [[suffix, f"{n:,}"] for suffix, n in tried.items()]))
    print(f"{sum(tried.values()):,} inputs, {len(failed)} failed")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()
