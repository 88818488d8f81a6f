"""
Gaps of a scan
==============

A scan with gaps is meshed: bridged by long triangles, or left open. The parameters are one-to-one either way.
"""

from matplotlib import pyplot as plt

from pointchart import leave_gaps_open, reconstruct, shapes


def draw(points, bridged, opened):
    """Draw both meshes from above."""
    panels = plt.subplots(1, 2, figsize=(9, 4.4), layout="constrained")[1]
    for axes, disc, title in zip(panels, (bridged, opened), ("bridged", "left open"), strict=True):
        axes.triplot(*points[:, :2].T, disc.triangles, color="#22303c", linewidth=0.4)
        axes.set(title=title, aspect="equal")
        axes.set_axis_off()


def main() -> int:
    """Return the number of holes that are left open: that of the gaps."""
    points = shapes.pierce(shapes.relief(2000), n_gaps=3).points
    bridged = reconstruct(points)
    opened = reconstruct(points, gaps=leave_gaps_open)
    print(f"a disc: {bridged.certificate.is_disc}, over {len(bridged.evidence.bridges)} gaps")
    print(f"a disc with {opened.certificate.holes} holes, one-to-one: {opened.certificate.is_one_to_one}")
    draw(points, bridged, opened)
    return opened.certificate.holes


if __name__ == "__main__":
    main()
    plt.show()
