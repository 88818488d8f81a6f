"""How far a run usually is when a stage begins."""

# In percent of the whole time, as measured on scans of 100,000 points; each loop that is tried begins them again.
OVER_BY = {
    "prepare": 0,
    "neighbours": 4,
    "boundary": 31,
    "assemble": 44,
    "map": 45,
    "triangulate": 47,
    "recover": 48,
    "swap": 49,
    "relocate": 52,
    "parameters": 55,
    "certify": 90,
    "fit": 95,
    "quality": 95,
    "self-intersections": 96,
    "page": 98,
}


def share_over(stage: str) -> int:
    """Return the usual share of the time, in percent, that is over when a stage begins.

    >>> share_over("prepare"), share_over("parameters")
    (0, 55)
    """
    return OVER_BY.get(stage, 0)
