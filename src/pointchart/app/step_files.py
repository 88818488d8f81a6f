"""The files of a step."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class StepFiles:
    """The files of a step.

    Attributes
    ----------
    works_on : str
        What the page reads, in the folder between steps.
    out : str
        The file that the command line names.
    beside : tuple of (option, file)
        Files that the run writes as well, for the page to draw.

    Examples
    --------
    >>> StepFiles("mesh-made.ply", "mesh.obj").written
    'mesh.ply'
    """

    works_on: str
    out: str
    beside: tuple[tuple[str, str], ...] = ()

    @property
    def written(self) -> str:
        """What the run writes: the file that the command line names, in the format that the page reads."""
        return Path(self.out).with_suffix(Path(self.works_on).suffix).name
