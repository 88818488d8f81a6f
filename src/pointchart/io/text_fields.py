"""The fields of rows of text: comments, quotes, commas, numbers that are none, and columns of words."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..errors import FormatError
from .source import AnyPath
from .table import is_number

COMMENT = re.compile(r"(?:^|(?<=[\s,;]))(?:#|//).*", re.MULTILINE)  # begins a field: 1.#QNAN holds none
# Not-a-number as C libraries write it, Microsoft's before 2015 with a #, and as R and databases call what is missing.
_NO_NUMBER = re.compile(
    r"(?<![^\s,;])(?:[+-]?\d*\.?#(?:QNAN|SNAN|IND|INF)\w*|[+-]?nan\([^)\s]*\)|NA|N/A|NULL|none)(?![^\s,;])",
    re.IGNORECASE,
)
_MARKS = ("#", "nan(", "N", "null", "none")  # one of them is in every such word, and is quickly looked for
# A number whose comma is a decimal one: where all fields between blanks are such, no comma separates them.
_DECIMAL_COMMA = re.compile(r"[+-]?\d*(,\d+)?([eE][+-]?\d+)?")
_QUOTED = re.compile(r'"([^"\n]*)"')
_GROUPED = re.compile(r"[+-]?\d{1,3}(,\d{3})+(\.\d*)?")
_DECIMAL = re.compile(r"[+-]?\d+,\d+")
_SAMPLE = 1000  # rows that tell which columns hold words: as many as one would look through


@dataclass(frozen=True, slots=True)
class Fields:
    """Rows whose fields blanks separate.

    Attributes
    ----------
    rows : list of str
    words : dict of int to str
        Places of the columns that hold words and are left out of the rows, with a word of each.
    n_columns : int
        Columns of the file, with those.
    """

    rows: list[str]
    words: dict[int, str]
    n_columns: int


def separator_of(row: str) -> str | None:
    """Return ';' or ',', or None for blanks and tabs.

    >>> separator_of("1;2;3"), separator_of("1, 2, 3"), separator_of("1,5 2,5 3")
    (';', ',', None)
    """
    row = _QUOTED.sub("0", row)
    if ";" in row:
        return ";"
    fields = row.split()
    are_decimal = len(fields) >= 2 and all(_DECIMAL_COMMA.fullmatch(field) for field in fields if "," in field)
    return "," if "," in row and not are_decimal else None


def split_fields(row: str, separator: str | None) -> list[str]:
    """Split a row without quotes; a separator behind the last field is nothing.

    >>> split_fields("a b; 2;", ";"), split_fields(" 1  2", None)
    (['a b', '2'], ['1', '2'])
    """
    if separator is None:
        return row.split()
    return [field.strip() for field in row.strip().removesuffix(separator).split(separator)]


def rough_fields(row: str) -> list[str]:
    """Split a line whose layout is not known yet, to tell rows from what stands above them.

    >>> rough_fields('"694,385.5", 1.#QNAN,GRD')
    ['694385.5', 'nan', 'GRD']
    """
    unquoted = _QUOTED.sub(lambda match: match[1].replace(",", ""), row).replace('"', "")
    return re.split(r"[\s,;]+", _NO_NUMBER.sub("nan", unquoted).strip(" \t,;"))


def plain_text(path: AnyPath, text: str) -> str:
    """Take comments and quotes away, and call every kind of not-a-number nan.

    Inside quotes a comma groups thousands or is decimal, as the file as a whole tells, and separates nothing.
    """
    if "#" in text or "//" in text:
        text = COMMENT.sub("", text)
    if '"' in text:
        text = _QUOTED.sub(_unquoting(path, text), text).replace('"', "")
    return _NO_NUMBER.sub("nan", text) if any(mark in text for mark in _MARKS) else text


def blank_separated(text: str, separator: str | None) -> Fields:
    """Bring rows of plain text to fields that blanks separate, columns of words left out."""
    rows = text.split("\n")
    first = next((row for row in rows if row.strip()), "")
    n_columns = len(split_fields(first, separator))
    words = _word_columns(rows, separator, n_columns) if n_columns > 3 else {}
    if words:
        text = "\n".join(_without(row, separator, words, n_columns) for row in rows)
    elif separator is not None:
        if re.search(rf"{separator}[ \t]*{separator}", text):
            text = re.sub(rf"(?<={separator})[ \t]*(?={separator})", "nan", text)
        text = text.replace(separator, " ")
    return Fields((text.replace(",", ".") if separator != "," else text).split("\n"), words, n_columns)


def _unquoting(path: AnyPath, text: str) -> Callable[[re.Match[str]], str]:
    """Return what replaces a quoted field: a number without a comma, or one word."""
    with_comma = [field for field in _QUOTED.findall(text) if "," in field]
    grouped = [field for field in with_comma if _GROUPED.fullmatch(field)]
    decimal = [field for field in with_comma if _DECIMAL.fullmatch(field) and not _GROUPED.fullmatch(field)]
    sure = [field for field in grouped if "." in field or field.count(",") > 1]
    if grouped and bool(sure) == bool(decimal):
        raise FormatError(
            f'{path}: in "{(decimal or grouped)[0]}" and "{grouped[-1]}" a comma may group thousands or be decimal; '
            "write the numbers with a point and without groups"
        )

    def replaced(match: re.Match[str]) -> str:
        field = match[1].strip()
        if sure and _GROUPED.fullmatch(field):
            return field.replace(",", "")
        if decimal and _DECIMAL.fullmatch(field):
            return field.replace(",", ".")
        return re.sub(r"[\s,;#]+", "_", field)

    return replaced


def _word_columns(rows: Sequence[str], separator: str | None, n_columns: int) -> dict[int, str]:
    """Find the columns of words: the first row has one there, or most of a sample have; less than three are left."""
    sample = [split_fields(row, separator) for row in rows[:: max(1, len(rows) // _SAMPLE)] if row.strip()]
    sample = [fields for fields in sample if len(fields) == n_columns]
    words: dict[int, str] = {}
    for place in range(n_columns):
        found = [fields[place] for fields in sample if fields[place] and not _is_value(fields[place], separator)]
        if len(found) > len(sample) / 2:
            words[place] = found[0]
    return words if n_columns - len(words) >= 3 else {}


def _is_value(field: str, separator: str | None) -> bool:
    return is_number(field if separator == "," else field.replace(",", "."))


def _without(row: str, separator: str | None, words: dict[int, str], n_columns: int) -> str:
    """Leave the words of a row out; one that has not as many fields as it should stays, and is named as faulty."""
    fields = split_fields(row, separator)
    if len(fields) != n_columns:
        return row
    return " ".join(field or "nan" for place, field in enumerate(fields) if place not in words)
