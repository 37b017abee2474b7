"""Which program wrote a table, and where its columns are."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading, is_unit
from stackbounce.measure.reading.roles import Column, column
from stackbounce.measure.reading.text import Text, number

__all__ = ["Layout", "first_row", "generic", "tables"]

_NOT_NAMED = "no header names the columns: name them, as in names={1: 'time', 2: 'force'}"


@dataclass(frozen=True)
class Layout:
    """Where the columns of a table are.

    Parameters
    ----------
    format : str
        The program, or the kind of table.
    why : str
        What in the content told.
    columns : tuple of Column
        Those of interest.
    first : int
        The first row of numbers, among the first lines.
    doubts : tuple of str, optional
        What is unsure.
    clock : tuple of float, optional
        Start and step in s, where the column of times counts samples.
    """

    format: str
    why: str
    columns: tuple[Column, ...]
    first: int
    doubts: tuple[str, ...] = ()
    clock: tuple[float, float] | None = None


def first_row(text: Text, start: int = 0) -> int:
    """Return the first of the first lines that has nothing but numbers, from one on.

    Raises
    ------
    FileError
        If there is none.
    """
    for index in range(start, len(text.head)):
        values = [number(cell, text.decimal) for cell in text.head[index]]
        if None not in values and any(value == value for value in values):
            return index
    raise FileError("it has a header and no row of numbers below it")


def tracker(text: Text) -> Layout | None:
    """Tracker: ``#multi:`` over the tracks' names, or one track's name over ``t``, ``x``, ``y``."""
    head = text.head
    multi = bool(head[0]) and head[0][0].startswith("#multi:")
    at = 2 if multi else 1
    if len(head) <= at or not head[at] or head[at][0] != "t" or not {"x", "y"} & set(head[at]):
        return None
    above = head[at - 1]
    names = [cell for cell in above if cell]
    if not multi and (len(names) != 1 or not above[0]):
        return None
    columns, track = [column(0, Heading("t", "t", "s"), "time")], names[0] if names else ""
    for k, cell in enumerate(head[at][1:], 1):
        if multi and k < len(above) and above[k]:
            track = above[k]
        if cell:
            role = cell if cell in ("x", "y") else ""
            columns.append(column(k, Heading(cell, cell), role, track))
    told = "its line '#multi:'" if multi else "the name of a track"
    return Layout(
        "Tracker",
        f"{told} over the columns t, x, y is how Tracker exports data",
        tuple(columns),
        first_row(text, at + 1),
    )


def logger_pro(text: Text) -> Layout | None:
    """Logger Pro's text: names, short names and units on lines of their own."""
    if not text.line(0).startswith("Vernier Format"):
        return None
    first = first_row(text, 3)
    lines = [k for k in range(first) if any(text.head[k])]
    if len(lines) < 5:
        raise FileError("it begins as a text of Logger Pro but lacks the names of its columns")
    names, units = text.head[lines[-3]], text.head[lines[-1]]
    width = len(text.head[first])
    if len(lines) < 6:  # without short names
        names = text.head[lines[-2]]
    run = text.head[lines[2]][0]
    columns = [
        column(k, heading(names[k] if k < len(names) else "", units[k] if k < len(units) else ""))
        for k in range(width)
    ]
    why = f"its first line 'Vernier Format' is that of a text from Logger Pro ({run!r})"
    return Layout("Logger Pro", why, tuple(columns), first)


def phyphox(text: Text) -> Layout | None:
    """The experiments of phyphox, by the names of their columns."""
    header = text.head[0]
    names = [heading(cell).name.casefold() for cell in header if cell]
    if "bounce 0" in names and "bounce 1" in names:
        experiment = "(in)elastic collision"
    elif names[:2] == ["event time", "interval"]:
        experiment = "acoustic stopwatch"
    elif names[:2] == ["time", "recording"]:
        experiment = "audio scope"
    elif names[:2] == ["time", "acceleration x"]:
        experiment = "acceleration with g"
    elif names[:2] == ["time", "linear acceleration x"]:
        experiment = "acceleration without g"
    else:
        return None
    if experiment == "(in)elastic collision":  # its one row may be all that is there
        columns = tuple(Column(k, heading(cell)) for k, cell in enumerate(header) if cell)
    else:
        columns = _columns(header, len(header))
    why = f"its columns {header[0]!r}, {header[1]!r} are those of phyphox's {experiment}"
    return Layout(f"phyphox: {experiment}", why, columns, first_row(text, 1))


def vernier(text: Text) -> Layout | None:
    """Vernier's CSV: each column's name with its run before it."""
    header = text.head[0]
    headings = [heading(cell) for cell in header if cell]
    runs = [one.run for one in headings]
    if len(runs) < 2 or not all(runs) or "#" in runs[0] or not headings[0].text.startswith(runs[0]):
        return None
    why = f"each column's name has its run before it, as in {header[0]!r}"
    return Layout("Vernier", why, _columns(header, len(header)), first_row(text, 1))


def capstone(text: Text) -> Layout | None:
    """PASCO Capstone: each column's name has ``Run #1`` after it; lines above that are skipped."""
    for k, row in enumerate(text.head):
        cells = [cell for cell in row if cell]
        if len(cells) > 1 and all(
            re.search(r"(Run|Set|Lauf|Ensayo|Essai) #\d+$", cell) for cell in cells
        ):
            why = f"each column's name has its run after it, as in {cells[0]!r}"
            columns = _columns(row, len(row))
            return Layout("PASCO Capstone", why, columns, first_row(text, k + 1))
    return None


def generic(text: Text) -> Layout:
    """Any table of numbers, with names and units above it or not."""
    first = _body(text)
    width = _width(text, first)
    above = [k for k in range(first) if any(text.head[k])]
    if not above or first - above[-1] > 2:
        why = "rows of numbers without a header"
        return Layout("table of numbers", why, _columns([], width), first, (_NOT_NAMED,))
    names = _named(text, above[-1], width)
    units = None
    if len(above) > 1 and all(is_unit(cell) for cell in names if cell):
        units, names = names, _named(text, above[-2], width)
    if text.delimiter == "," and text.decimal == "." and width == 2 * len(names) > 2:
        raise FileError(
            f"its header names {len(names)} columns, its rows have {width} cells: numbers with a "
            "decimal comma between commas cannot be told apart; export with another delimiter"
        )
    beyond = sum(any(row[len(names) :]) for row in text.head[first:])
    if 2 * beyond <= len(text.head) - first:  # a few rows that are too long make no column
        width = len(names)
    columns = _columns(names, max(width, len(names)), units)
    shown = ", ".join(one.heading.text for one in columns[:3])
    more = " …" if len(columns) > 3 else ""
    doubts = () if len(names) >= width else (f"columns from {len(names) + 1} on have no name",)
    return Layout(
        "table of numbers", f"a header names its columns: {shown}{more}", columns, first, doubts
    )


def _columns(
    names: Sequence[str], width: int, units: Sequence[str] | None = None
) -> tuple[Column, ...]:
    """Return the columns of a header; those at its end that have no name are none."""
    columns = []
    for k in range(width):
        name = names[k] if k < len(names) else ""
        if k < len(names) and not any(names[k:]):  # a delimiter at the end of the header
            continue
        unit = None if units is None else units[k] if k < len(units) else ""
        columns.append(column(k, heading(name, unit)))
    return tuple(columns)


def _body(text: Text) -> int:
    """Return the first of rows of numbers as wide as most of them are."""
    rows: list[int] = []
    start = 0
    while start < len(text.head):
        try:
            start = first_row(text, start) + 1
        except FileError:
            break
        rows.append(start - 1)
    if not rows:
        raise FileError("it has a header and no row of numbers below it")
    widths = [len(text.head[k]) for k in rows]
    usual = max(set(widths), key=lambda width: (widths.count(width), width))
    return next(k for k, width in zip(rows, widths, strict=True) if width == usual)


def _width(text: Text, first: int) -> int:
    """Return how many cells rows have, without those that are blank in all of the first ones."""
    rows = text.head[first:]
    return max((k + 1 for row in rows for k in range(len(row) - 1, -1, -1) if row[k]), default=1)


def _named(text: Text, index: int, width: int) -> list[str]:
    """Return the cells of a header; between blanks, names can have blanks themselves."""
    cells = text.head[index]
    if text.delimiter != " ":
        while cells and not cells[-1]:
            cells = cells[:-1]
        return cells
    line = text.line(index).lstrip("#% ").rstrip()
    for pattern in (r"\S+", r"\S+(?: \S+)*", r"\S+(?:\s*[(\[][^)\]]*[)\]])?", r"[^,;]+"):
        found = re.findall(pattern, line)
        if len(found) == width:
            return [one.strip() for one in found]
    return line.split()


tables: tuple[Callable[[Text], Layout | None], ...] = (
    logger_pro,
    tracker,
    phyphox,
    capstone,
    vernier,
)
"""Those that know a program, in the order in which they are asked."""
