"""Unpack LAZ in a process of its own: ``python -m pointchart.io.unpack_laz IN.laz OUT.las``.

The decoder may end its process on damaged input, or take any memory; here it ends this one, within bounds.
"""

import sys

_ROOM = 4 << 30  # bytes of addresses that it may take: a block of points, and the libraries with their threads
_BLOCK = 1_000_000  # points at a time: tens of megabytes


def unpack(source: str, out: str) -> None:
    """Write the points of a LAZ file as LAS, block by block."""
    import laspy

    with laspy.open(source) as reader, laspy.open(out, mode="w", header=reader.header, do_compress=False) as writer:
        for block in reader.chunk_iterator(_BLOCK):
            writer.write_points(block)


def _limit() -> None:
    try:
        import resource
    except ImportError:  # Windows has no such limits
        return
    resource.setrlimit(resource.RLIMIT_AS, (_ROOM, _ROOM))


if __name__ == "__main__":
    _limit()
    try:
        unpack(*sys.argv[1:])
    except Exception as error:
        sys.exit(f"{type(error).__name__}: {error}")
