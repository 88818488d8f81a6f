"""The look of the figures that the examples draw."""

import matplotlib as mpl

from pointchart.look.paint import INK, PAPER


def on_paper(conf: object, name: str) -> None:
    """Draw on the paper of the site; called before each example."""
    mpl.rcParams["figure.facecolor"] = mpl.rcParams["axes.facecolor"] = PAPER
    for part in ("axes.titlecolor", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color"):
        mpl.rcParams[part] = INK
