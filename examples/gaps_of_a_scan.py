"""Mesh a scan with gaps: bridged, or left open, with the parameters one-to-one either way."""

from pointchart import leave_gaps_open, reconstruct, shapes


def main() -> int:
    """Return the number of holes that are left open: that of the gaps."""
    points = shapes.pierce(shapes.relief(2000), n_gaps=3).points
    bridged = reconstruct(points)
    opened = reconstruct(points, gaps=leave_gaps_open)
    print(f"a disc: {bridged.certificate.is_disc}, over {len(bridged.evidence.bridges)} gaps")
    print(f"a disc with {opened.certificate.holes} holes, one-to-one: {opened.certificate.is_one_to_one}")
    return opened.certificate.holes


if __name__ == "__main__":
    main()
