"""Text of the page: a command line to copy, what a command said, and why it stopped."""

import re
from collections.abc import Sequence
from html import escape

BOX = "margin:.4em .75em;border-radius:4px;font-size:.85em;line-height:1.45;overflow-wrap:anywhere"
FRAMED = f"{BOX};padding:.5em .7em"
OTHER_LOOP = re.compile(r"another loop of \d+ points?, (\S+) long")
OTHERWISE = "was made by other options or another loop than those that stand now"
MARKS = {"[ok] ": ("✓", "#2f9e5b"), "[!!] ": ("✗", "#d0432c"), "[--] ": ("·", "inherit")}


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
    """Show what a command said, one line each; the lines of a certificate as a checklist.

    Examples
    --------
    >>> "✓" in said_html(["[ok] one part"]), said_html([])
    (True, '')
    """
    rows = []
    for line in lines:
        mark, color = MARKS.get(line[:5], ("", "inherit"))
        text = line[5:] if mark else line
        sign = f'<span style="color:{color};font-weight:700;display:inline-block;width:1.2em">{mark}</span>'
        rows.append(f"<div>{sign if mark else ''}{escape(text)}</div>")
    return f'<div class="said" style="{BOX}">{"".join(rows)}</div>' if rows else ""


def outdated_html(lines: Sequence[str]) -> str:
    """Show what a command said of what is no longer asked for.

    Examples
    --------
    >>> "opacity" in outdated_html(["[ok] one part"])
    True
    """
    return said_html([f"What follows {OTHERWISE}; run it again."]) + dimmed_html(said_html(lines))


def dimmed_html(html: str) -> str:
    """Show something that holds no longer.

    Examples
    --------
    >>> dimmed_html("as before")
    '<div style="opacity:.5">as before</div>'
    """
    return f'<div style="opacity:.5">{html}</div>'


def shortened(lines: Sequence[str], most: int = 5) -> list[str]:
    """Leave the longest of the other loops that were found, and count the rest.

    Examples
    --------
    >>> shortened([f"another loop of 9 points, {k} long" for k in (3, 1, 40)], most=2)
    ['another loop of 9 points, 40 long', 'another loop of 9 points, 3 long', '1 more']
    """
    found = {line: OTHER_LOOP.match(line) for line in lines}
    others = sorted((line for line in lines if found[line]), key=lambda line: -float((found[line] or "0")[1]))
    if len(others) <= most:
        return list(lines)
    return [line for line in lines if not found[line]] + others[:most] + [f"{len(others) - most} more"]


def refused_html(sentence: str) -> str:
    """Show why a step has stopped, in the very sentence of the command line."""
    return (
        f'<div class="refused" style="{FRAMED};border-left:4px solid #d0432c;background:rgba(208,67,44,.12)">'
        f"{escape(sentence)}</div>"
    )
