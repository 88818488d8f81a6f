"""Every error that pointchart raises on purpose."""


class PointchartError(Exception):
    """A run that cannot go on; its message names the culprit, the number and the remedy."""


class InputError(PointchartError):
    """A precondition on the data or the options is broken."""


class SolveError(PointchartError):
    """The numbers failed: a solver, or a surface that is not the disc it should be."""


class FormatError(PointchartError):
    """A file cannot be read or written."""
