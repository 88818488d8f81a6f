"""How far a run usually is when a stage begins."""

# In percent of the whole time, as measured on a face of 500,000 points that is meshed without a page. Each loop that is
# tried begins the stages again, and whoever shows a share never goes back.
OVER_BY = {
    "prepare": 0,
    "neighbours": 7,
    "boundary": 31,
    "assemble": 41,
    "map": 42,
    "triangulate": 43,
    "recover": 44,
    "swap": 46,
    "relocate": 47,
    "parameters": 49,
    "certify": 69,
    "quality": 73,
    "fit": 75,
    "self-intersections": 87,
    "page": 97,
}


def share_over(stage: str) -> int:
    """Return the usual share of the time, in percent, that is over when a stage begins.

    >>> share_over("prepare"), share_over("parameters")
    (0, 49)
    """
    return OVER_BY.get(stage, 0)
