"""Where a table's columns are: by the program that wrote it, its header, or its numbers.

The format of a program is a function in `formats.py`: of the table's first lines, that returns a
`Layout`, or None if another program wrote the table.
"""

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from stackbounce.errors import FileError
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.roles import Column, column, heading, is_unit
from stackbounce.measure.reading.text import Text, count_numbers, number, word_in

_LEAST_ROWS = 5  # that tell times
_MANY_ROWS = 20  # that tell frames, or samples of a scope
_UNEVEN = 0.1  # of a step, by which rounding may move times
_LONGEST_SAMPLE = 1e-3  # s, the step of an oscilloscope or sensor
_LONGEST_FRAME = 0.2  # s, the step of a video
NOT_NAMED = Message(
    "no header names the columns: name them, as in ", OptionHint({"names": {1: "time", 2: "force"}})
)


def guess(rows: Array) -> tuple[tuple[Column, ...], str]:
    """Return what columns look like by their first rows, (rows, columns), and why.

    Counted rows with two more columns are frames with x and y in an image. Evenly rising numbers
    are times: with steps up to 1 ms beside the voltage of one channel, with longer ones beside x
    and y. Anything else stays without a meaning.

    Examples
    --------
    >>> found, _ = guess(np.stack([np.arange(30), np.ones(30), np.arange(30) ** 2], axis=1))
    >>> [column.role for column in found]
    ['frame', 'x', 'y']
    """
    width = rows.shape[1]
    known = rows[np.isfinite(rows).all(axis=1)]
    step = _step(known[:, 0]) if len(known) >= _LEAST_ROWS and width > 1 else 0.0
    many = len(known) >= _MANY_ROWS
    if many and step == 1.0 and width == 3 and (known[:, 0] == np.round(known[:, 0])).all():
        return _guessed(("frame", "x", "y"), "the first counts frames, so that x and y follow")
    said = f"the first rises in steps of {step:.4g}, so that it is taken as time in s"
    if many and 0.0 < step <= _LONGEST_SAMPLE and width == 2:
        return _guessed(("time", "voltage"), f"{said}, the other as the voltage of a scope")
    if _LONGEST_SAMPLE < step <= _LONGEST_FRAME and width == 3:
        return _guessed(("time", "x", "y"), f"{said}, the others as x and y")
    return tuple(column(k, heading("")) for k in range(width)), NOT_NAMED


def _guessed(roles: tuple[str, ...], said: str) -> tuple[tuple[Column, ...], str]:
    units = {"time": "s", "voltage": "V"}
    columns = tuple(
        column(k, heading("", units.get(role, "")), role) for k, role in enumerate(roles)
    )
    said = f"no header names the columns: {said}; if that is wrong, "
    return columns, Message(said, OptionHint({"names": None}), " tells what they are")


def _step(numbers: Array) -> float:
    """Return the step of evenly rising numbers, within their rounding; 0 of any others."""
    step = float(numbers[-1] - numbers[0]) / (len(numbers) - 1)
    even = numbers[0] + step * np.arange(len(numbers))
    rising = step > 0.0 and bool((np.diff(numbers) > 0.0).all())
    return step if rising and float(np.abs(numbers - even).max()) < _UNEVEN * step else 0.0


@dataclass(frozen=True)
class Layout:
    """Where the columns of a table are.

    Parameters
    ----------
    format : str
        The program, or the kind of table.
    why : str
        By what in the content it was recognised.
    columns : tuple of Column
        Those of interest.
    first : int
        The first row of numbers, among the first lines.
    doubts : tuple of str, optional
        What is unsure.
    clock : tuple of float, optional
        Start and step in s, where the column of times counts samples or rows.
    holds : str, optional
        The kind of measurement, if it does not follow from the columns.
    bare : bool, optional
        Whether columns have no names, so that they are what their numbers look like.
    end : int, optional
        Where in the text the table ends, if something else follows.
    """

    format: str
    why: str
    columns: tuple[Column, ...]
    first: int
    doubts: tuple[str, ...] = ()
    clock: tuple[float, float] | None = None
    holds: str = ""
    bare: bool = False
    end: int | None = None


def first_row(text: Text, start: int = 0, columns: Sequence[int] | None = None) -> int:
    """Return the index of the first row of numbers, among the first lines from `start` on.

    It has numbers only, and one at least; or one in each of some columns, whatever else it has.

    Raises
    ------
    FileError
        If there is none.
    """
    least = 1 if columns is None else len(columns)
    for index, row in enumerate(text.head[start:], start):
        cells = row if columns is None else [row[k] for k in columns if k < len(row)]
        if count_numbers(cells, text.decimal) >= least:
            return index
    why = "it has a header and no row of numbers below it"
    raise FileError(why + word_in(text.head[start:], text.decimal, start))


def columns_of(
    names: Sequence[str], width: int, units: Sequence[str] | None = None
) -> tuple[Column, ...]:
    """Return the columns of a header, without those at its end that have no name.

    Parameters
    ----------
    names : sequence of str
        The header's cells.
    width : int
        Cells of a row.
    units : sequence of str, optional
        Where another line has them.
    """
    columns = []
    for k in range(width):
        name = names[k] if k < len(names) else ""
        if k < len(names) and not any(names[k:]):  # a delimiter at the end of the header
            continue
        unit = None if units is None else units[k] if k < len(units) else ""
        columns.append(column(k, heading(name, unit)))
    return tuple(columns)


def line_of(text: Text, name: str) -> int:
    """Return the first line that a name begins which has more cells; 0 where there is none."""
    return next((k for k, row in enumerate(text.head) if row[:1] == [name] and len(row) > 1), 0)


def keys_above(text: Text, until: int) -> dict[str, list[str]]:
    """Return the first lines up to some one as keys, their first cells, with the cells beside."""
    return {row[0]: row[1:] for row in text.head[:until] if row}


def told(keys: Mapping[str, Sequence[str]], key: str, index: int = 0) -> str:
    """Return one of the cells beside a key, empty where there is none."""
    return next(iter(keys.get(key, ())[index:]), "")


def general(text: Text) -> Layout:
    """Return the layout of any table of numbers, with names and units above it or not."""
    first = _body(text)
    width = _width(text, first)
    above = [k for k in range(first) if any(text.head[k])]
    if not above or first - above[-1] > 2:
        columns, doubt = guess(_numbers(text, first, width))
        why = "rows of numbers without a header"
        return Layout("table of numbers", why, columns, first, (doubt,), bare=True)
    names = _named(text, above[-1], width)
    units = None
    if len(above) > 1 and all(is_unit(cell) for cell in names if cell):
        units, names = names, _named(text, above[-2], width)
    if text.delimiter == "," and text.decimal == "." and width == 2 * len(names):
        _refuse_commas(names, text.head[first:])
    beyond = sum(any(row[len(names) :]) for row in text.head[first:])
    if 2 * beyond <= len(text.head) - first:  # a few rows that are too long make no column
        width = len(names)
    columns = columns_of(names, max(width, len(names)), units)
    shown = ", ".join(column.heading.text for column in columns[:3])
    more = " …" if len(columns) > 3 else ""
    doubts = () if len(names) >= width else (f"columns from {len(names) + 1} on have no name",)
    why = f"a header names its columns: {shown}{more}"
    return Layout("table of numbers", why, columns, first, doubts)


def _refuse_commas(names: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Refuse rows with twice as many cells as names, if their numbers may have decimal commas."""
    if len(names) > 1:
        raise FileError(
            f"its header names {len(names)} columns, its rows have {2 * len(names)} cells: numbers "
            "with a decimal comma between commas cannot be told apart; export with another "
            "delimiter"
        )
    if all("".join(row).lstrip("-").isdecimal() for row in rows if any(row)):
        said, commas = "its header names one column, its rows have 2 cells: ", {"decimal": ","}
        two = " reads decimal commas, and two columns need two names"
        raise FileError(Message(said, OptionHint(commas), two))


def _numbers(text: Text, first: int, width: int) -> Array:
    """Return the numbers of the first rows, NaN where there is none."""
    rows = [[number(cell, text.decimal) for cell in row[:width]] for row in text.head[first:]]
    return np.array([row for row in rows if len(row) == width], np.float64).reshape(-1, width)


def _body(text: Text) -> int:
    """Return the index of the first row of numbers that has the most frequent width.

    Rows above it that begin with a number and have another are of the table, too, with a remark.
    """
    first_row(text)
    rows = [row for row in text.head if count_numbers(row, text.decimal)]
    widths = Counter(map(len, rows))
    usual = max(widths, key=lambda width: (widths[width], width))
    first = next(k for k, row in enumerate(text.head) if len(row) == usual and row in rows)
    while first and _begins_with_numbers(text.head[first - 1], text.decimal):
        first -= 1
    return first


def _begins_with_numbers(row: list[str], decimal: str) -> bool:
    """Return whether a row begins with a number and has another, whatever else is in it."""
    known = [cell != "" and number(cell, decimal) is not None for cell in row]
    return known[:1] == [True] and sum(known) > 1


def _width(text: Text, first: int) -> int:
    """Return the number of columns, without trailing ones that are blank in the first rows."""
    rows = text.head[first:]
    return max((k + 1 for row in rows for k in range(len(row) - 1, -1, -1) if row[k]), default=1)


def _named(text: Text, index: int, width: int) -> list[str]:
    """Return the names in a header; if blanks delimit them, they are split into `width` names."""
    cells = text.head[index]
    if text.delimiter != " ":
        while cells and not cells[-1]:
            cells = cells[:-1]
        return cells
    line = text.lines[index].lstrip("#% ").rstrip()
    for pattern in (r"\S+", r"\S+(?: \S+)*", r"\S+(?:\s*[(\[][^)\]]*[)\]])?", r"[^,;]+"):
        found = re.findall(pattern, line)
        if len(found) == width:
            return [cell.strip() for cell in found]
    return line.split()
