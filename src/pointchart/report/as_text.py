"""A report in the lines that the command line says."""

from .record import Check, RunReport, WrittenFile

MARKS = {True: "[ok]", False: "[!!]", None: "[--]"}  # passed, at fault, measured only; of ASCII, for any terminal


def as_text(report: RunReport) -> str:
    """Write the checks, the notes and the files of a run, one a line.

    Examples
    --------
    >>> print(as_text(RunReport("check", checks=(Check("one part", True), Check("longest edge", None, "9 spacings")))))
    [ok] one part
    [--] longest edge 9 spacings
    """
    checks = [check_line(check) for check in report.checks]
    files = [_file_line(file) for file in report.files if file.is_told]
    return "\n".join([*checks, *(note.text for note in report.notes), *files])


def check_line(check: Check) -> str:
    """Write a check with its mark: passed, at fault or measured only."""
    return f"{MARKS[check.passed]} {check.text}"


def _file_line(file: WrittenFile) -> str:
    return f"{file.path}: {file.holds}" if file.holds else str(file.path)
