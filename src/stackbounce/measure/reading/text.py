"""Bytes -> text -> delimiter, decimal mark and the cells of the first lines."""

import csv
import re
from collections import Counter
from dataclasses import dataclass
from itertools import accumulate

from stackbounce.errors import FileError, shown
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.reading.limits import COLUMNS, LINE

HEAD = 200
"""Lines from which the layout of a table is recognised."""

_DELIMITERS = "\t;, "
MISSING = frozenset(
    ["", "nan", "na", "n/a", "#n/a", "-", "--", "---", "–", "—", "null", "none", "*", "#div/0!"]
)
"""What stands in a cell without a number, in lower case."""
_INFINITE = frozenset(["inf", "infinity", "∞", "1.#inf"])
_EXPONENT = r"(?:[eE][+-]?[0-9]{1,4})?"
_NUMBER = re.compile(rf"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+){_EXPONENT}")
SPACES = "\u00a0\u202f\u2009'\u2019"
"""What stands between thousands besides points, commas and blanks."""
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1a\x1c-\x1f]")
_CENTRAL = re.compile(r"[^\W\d_][¹³¿\x9a\x9c\x9e\x9f][^\W\d_]|\bÈ[a-z]")  # cp1250 as Latin-1
_BINARY = "it is no text but a program's own bytes, which are not known here: export them as CSV"
_CLOCK = re.compile(r"(?:([0-9]{1,3}):)?([0-5]?[0-9]):([0-5][0-9][.,][0-9]{1,6})")


@dataclass(frozen=True)
class Text:
    """A table as text, with its delimiter and decimal mark.

    Parameters
    ----------
    content : str
        All of it, lines ended by a line feed.
    delimiter : str
        A tab, ``;``, ``,`` or a space for any run of blanks.
    decimal : str
        The decimal mark, ``.`` or ``,``.
    lines, head : list of str, list of list of str
        The first lines, and their cells.
    starts : list of int
        Where each of these begins in `content`.
    doubts : list of str
        What is unsure about delimiter and decimal mark.
    name : str
        That of the file, for programs that tell by it what they wrote.
    """

    content: str
    delimiter: str
    decimal: str
    lines: list[str]
    head: list[list[str]]
    starts: list[int]
    doubts: list[str]
    name: str


def decode(content: bytearray) -> str:
    """Return bytes as text with plain line ends; the encoding follows from its mark or is tried.

    The bytes are emptied, so that a large file is not in memory twice.

    Raises
    ------
    FileError
        If they are no text in UTF-8, marked UTF-16, Latin-1 or cp1250.
    """
    marks = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
    encoding = next((name for mark, name in marks if content.startswith(mark)), "utf-8")
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        if encoding == "utf-16":
            raise FileError(_BINARY) from error
        text = content.decode("latin-1")
        if _CENTRAL.search(text[:1000]):
            text = content.decode("cp1250", errors="replace")
    content.clear()
    strange = len(_CONTROL.findall(text[:100_000]))
    if strange > len(text[:100_000]) / 1000:
        raise FileError(_BINARY)
    return text.replace("\r\n", "\n").replace("\r", "\n")


def split(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line, without the quotes and blanks around them.

    Examples
    --------
    >>> split('"Time (s)", 1.5,', ",")
    ['Time (s)', '1.5', '']
    """
    if delimiter == " ":
        return line.split()
    if '"' in line:
        try:
            (cells,) = csv.reader([line], delimiter=delimiter, skipinitialspace=True)
        except (csv.Error, ValueError):
            pass
        else:
            return [cell.strip() for cell in cells]
    return [cell.strip(' "') for cell in line.split(delimiter)]


def number(cell: str, decimal: str) -> float | None:
    """Return a cell as a number: NaN where it is missing, None where it is something else.

    Examples
    --------
    >>> number("1.5e-3", "."), number("1 234,5", ","), number("n/a", "."), number("x", ".")
    (0.0015, 1234.5, nan, None)
    """
    cell = cell.strip().replace("−", "-")
    if not _NUMBER.fullmatch(cell):
        if clock := _CLOCK.fullmatch(cell):  # 0:00:00.01 of Kinovea
            hours, minutes, seconds = clock.groups("0")
            return 3600.0 * int(hours) + 60.0 * int(minutes) + float(seconds.replace(",", "."))
        word = cell.casefold()
        if word in MISSING:
            return float("nan")
        if word.lstrip("+-") in _INFINITE:
            return float("-inf" if word.startswith("-") else "inf")
        cell = _plain(cell, decimal)
    elif decimal == "," and _POINTS.fullmatch(cell):
        cell = cell.replace(".", "")
    return float(cell) if _NUMBER.fullmatch(cell) else None


def _plain(cell: str, decimal: str) -> str:
    """Return a number without separators between thousands, and with a decimal point."""
    other = "." if decimal == "," else ","
    if len(cell) > 60 or not _GROUPED[decimal].fullmatch(cell):
        return cell.replace(",", ".", 1) if decimal == "," and "." not in cell else ""
    for mark in other + SPACES + " ":
        cell = cell.replace(mark, "")
    return cell.replace(",", ".")


_GROUPED = {
    decimal: re.compile(
        rf"[+-]?[0-9]{{1,3}}(?:([{other} {SPACES}])[0-9]{{3}})(?:\1[0-9]{{3}})*"
        rf"(?:{re.escape(decimal)}[0-9]*)?{_EXPONENT}"
    )
    for decimal, other in ((".", ","), (",", "."))
}
_POINTS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:\.[0-9]{3})+")


def tabulate(content: str, decimal: str | None, name: str) -> Text:
    """Find the delimiter and the decimal mark of a table in its first lines.

    Raises
    ------
    FileError
        If a line is too long, there are too many columns, or there is no row of numbers.
    """
    starts, lines = _head(content)
    scores = {delimiter: _score(lines, delimiter, decimal or ".,") for delimiter in _DELIMITERS}
    if decimal == "," and not any('"' in line for line in lines):
        del scores[","]  # it is a delimiter only where cells are quoted
    delimiter = max(scores, key=scores.__getitem__)
    head = [split(line, delimiter) for line in lines]
    wide = max(map(len, head), default=0)
    if wide > COLUMNS:
        raise FileError(f"it has a line of {wide} cells: at most {COLUMNS} columns are read")
    mark, doubts = (decimal, []) if decimal else _decimal(head, delimiter)
    if not any(count_numbers(row, mark) or _labelled(row, mark) for row in head):
        raise FileError(
            f"it has no row of numbers in its first {len(head)} lines; "
            f"it begins with {shown(next((line for line in lines if line.strip()), ''))}"
            f"{word_in(head[1:], mark, 1)}"
        )
    return Text(content, delimiter, mark, lines, head, starts, doubts, name)


def _head(content: str) -> tuple[list[int], list[str]]:
    lines = content[:LINE].split("\n", HEAD)[:HEAD]
    if len(content) > LINE and len(lines) < HEAD:
        lines.pop()  # it is cut off
    if not lines:
        raise FileError(f"its first line has more than {LINE} characters")
    return [0, *accumulate(len(line) + 1 for line in lines[:-1])], lines


def count_numbers(row: list[str], decimal: str) -> int:
    """Return how many numbers a row has; 0 if any cell is something else."""
    values = [number(cell, decimal) for cell in row[:COLUMNS]]
    return 0 if None in values else sum(value == value for value in values)  # NaN is not itself


def word_in(rows: list[list[str]], decimal: str, start: int) -> str:
    """Return which cell has words, in the row of the most cells that begin as numbers."""
    begins = [sum(cell[:1].isdigit() for cell in row) for row in rows]
    if not any(begins):
        return ""
    line = begins.index(max(begins))
    word = next((cell for cell in rows[line] if number(cell, decimal) is None), "")
    return f": in line {start + line + 1} the cell {shown(word)} is no number" * bool(word)


def _labelled(row: list[str], decimal: str) -> bool:
    """Return whether a row has numbers beside words, such as the label of a point."""
    values = [number(cell, decimal) for cell in row[:COLUMNS]]
    return len(row) > 2 and sum(value is not None and value == value for value in values) > 1


def _score(lines: list[str], delimiter: str, decimals: str) -> tuple[int, int]:
    """Return how many rows of numbers, and how many numbers, a delimiter makes of lines."""
    rows = cells = 0
    widths: Counter[int] = Counter()
    for line in lines:
        row = split(line[: LINE // 8], delimiter)[:COLUMNS]
        if len(row) < 2:
            continue
        marks = [mark for mark in decimals if not (mark == delimiter == "," and '"' not in line)]
        count = max((count_numbers(row, mark) for mark in marks), default=0)
        rows += count > 0
        widths[len(row)] += count > 0
        if not rows:
            cells += sum(
                1 for cell in row if cell and any(number(cell, mark) is not None for mark in marks)
            )
    return max(widths.values(), default=0), 0 if rows else cells


def _decimal(head: list[list[str]], delimiter: str) -> tuple[str, list[str]]:
    """Return the decimal mark, and a doubt where commas could separate thousands as well."""
    cells = [cell for row in head for cell in row if "," in cell]
    commas = [cell for cell in cells if re.fullmatch(rf"[+-]?[0-9]*,[0-9]+{_EXPONENT}", cell)]
    point = re.compile(rf"[+-]?[0-9]*\.[0-9]+{_EXPONENT}")
    points = any(point.fullmatch(cell) for row in head for cell in row)
    grouped = [comma for comma in commas if re.fullmatch(r"[+-]?[1-9][0-9]{0,2},[0-9]{3}", comma)]
    if not commas or (points and len(grouped) == len(commas)):
        mixed = [cell for cell in cells if re.fullmatch(r"[+-]?[0-9]+\.[0-9.]*,[0-9]+", cell)]
        return ("," if mixed and delimiter != "," else "."), []
    if len(grouped) == len(commas):
        said, hint = f"{grouped[0]!r} is read with a decimal comma: ", OptionHint({"decimal": "."})
        return ",", [Message(said, hint, " if it is not one")]
    return ",", []
