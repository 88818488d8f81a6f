"""Text of the page: a command line to copy, what a command said, and why it stopped."""

from collections.abc import Sequence
from html import escape

from ..report.record import Check, RunReport

# Written into each element, as the panel shows pieces of HTML without a style sheet; paths may break anywhere.
BOX = "margin:.4em .75em;border-radius:4px;font-size:.85em;line-height:1.45;overflow-wrap:anywhere"
FRAMED = f"{BOX};padding:.5em .7em"
# Of a result, in a message and in the refusal of its export alike.
OTHERWISE = "was made by other options or another loop than those that stand now"
# Of a check that has passed, has failed, or is a measure.
MARKS = {True: ("✓", "#2f9e5b"), False: ("✗", "#d0432c"), None: ("·", "inherit")}
MOST_MINOR = 5  # notes of a list, such as the other loops that were found, that a panel has room for


def command_html(line: str) -> str:
    """Show a command line with a button that copies it.

    Examples
    --------
    >>> "a &amp; b</code>" in command_html("a & b")
    True
    """
    copy = "navigator.clipboard.writeText(this.parentElement.querySelector('code').textContent)"
    button = (
        f'<button title="copy" onclick="{copy}" style="float:right;margin-left:.6em;border:0;background:none;'
        'color:inherit;cursor:pointer;font:inherit;text-decoration:underline">copy</button>'
    )
    code = f'<code style="font-family:ui-monospace,monospace">{escape(line)}</code>'
    return f'<div class="command" style="{FRAMED};background:rgba(128,140,150,.16)">{button}{code}</div>'


def said_html(lines: Sequence[str]) -> str:
    """Show what is said, one line each.

    Examples
    --------
    >>> "a &lt; b" in said_html(["a < b"]), said_html([])
    (True, '')
    """
    return _said([_line(line) for line in lines])


def report_html(report: RunReport, out: str) -> str:
    """Show what a run came to: its checks as a checklist, then its notes, and what is in its files.

    Parameters
    ----------
    report : RunReport
    out : str
        What the file that the run was there to write is called here.

    Examples
    --------
    >>> "✓" in report_html(RunReport("mesh", checks=(Check("one part", True),)), "mesh.ply")
    True
    >>> report_html(RunReport("mesh"), "mesh.ply")
    ''
    """
    lines = [note.text for note in report.notes if not note.is_minor]
    minor = sorted((note for note in report.notes if note.is_minor), key=lambda note: -note.size)
    lines += [note.text for note in minor[:MOST_MINOR]]
    lines += [f"{len(minor) - MOST_MINOR} more"] if len(minor) > MOST_MINOR else []
    files = [(out if file.role == "out" else file.path.name, file.holds) for file in report.files if file.is_told]
    lines += [f"{name}: {holds}" if holds else name for name, holds in files]
    return _said([*map(_check, report.checks), *map(_line, lines)])


def outdated_html(html: str) -> str:
    """Show what a run came to that is no longer asked for.

    Examples
    --------
    >>> "opacity" in outdated_html("one part")
    True
    """
    return said_html([f"What follows {OTHERWISE}; run it again."]) + dimmed_html(html)


def dimmed_html(html: str) -> str:
    """Show something that holds no longer.

    Examples
    --------
    >>> dimmed_html("as before")
    '<div style="opacity:.5">as before</div>'
    """
    return f'<div style="opacity:.5">{html}</div>'


def refused_html(sentence: str) -> str:
    """Show why a step has stopped, in the very sentence of the command line."""
    return (
        f'<div class="refused" style="{FRAMED};border-left:4px solid #d0432c;background:rgba(208,67,44,.12)">'
        f"{escape(sentence)}</div>"
    )


def _said(rows: Sequence[str]) -> str:
    return f'<div class="said" style="{BOX}">{"".join(rows)}</div>' if rows else ""


def _line(text: str) -> str:
    return f"<div>{escape(text)}</div>"


def _check(check: Check) -> str:
    mark, color = MARKS[check.passed]
    sign = f'<span style="color:{color};font-weight:700;display:inline-block;width:1.2em">{mark}</span>'
    return f"<div>{sign}{escape(check.text)}</div>"
