"""ImageJ: the results table, manual tracking, MTrack2; positions by slice or frame of a stack."""

import re

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import POINT, column
from stackbounce.measure.reading.text import Text, number

_MEASURED = {"", "area", "mean", "label", "counter", "slice", "slice n°", "xm", "bx", "intden"}
_CLOSED_UP = (
    "blank cells were lost, so that numbers stand under Flag: points are put together to tracks by "
    "where they are"
)
_SUMMARY = re.compile(r"\n+Track\s")  # a line for each track, below all points
_NUMBERED = re.compile(r"([xy]) ?([0-9]{1,3})")


@layout
def mtrack2(text: Text) -> Layout | None:
    """Recognise MTrack2: ``Frame, X1, Y1, Flag1, X2 …``, often over ``Tracks 1 to 6``."""
    names = [cell.casefold() for cell in text.head[0]]
    if names[:1] != ["frame"] or not {"x1", "y1"} <= set(names):
        return None
    first, doubts = first_row(text, 1), list[str]()
    places = [(k, place) for k, name in enumerate(names) if (place := _NUMBERED.fullmatch(name))]
    found = [column(k, heading(one[1].upper()), one[1], f"track {one[2]}") for k, one in places]
    if _closed_up(text, first, len(names)):
        doubts.append(_CLOSED_UP)
        found = [
            column(k, heading("XY"[k % 2 == 0]), "xy"[k % 2 == 0], f"{POINT}{(k + 1) // 2}")
            for k in range(1, 1 + 2 * sum(one[1] == "x" for _, one in places))
        ]
    why = "Frame, X1, Y1 are the columns of MTrack2, a plugin of ImageJ"
    columns = (column(0, heading("Frame"), "frame"), *found)
    summary = _SUMMARY.search(text.content, text.starts[first])
    end = summary.start() if summary else None
    return Layout("ImageJ: MTrack2", why, columns, first, tuple(doubts), end=end)


def _closed_up(text: Text, first: int, width: int) -> bool:
    """Return whether numbers stand where flags should: a spreadsheet loses blank cells."""
    flags = [row[3] for row in text.head[first:] if 4 < len(row) <= width and row[3]]
    numbers = sum(number(cell, text.decimal) is not None and cell != "*" for cell in flags)
    return 2 * numbers > len(flags)


@layout
def results(text: Text) -> Layout | None:
    """Recognise a results table of ImageJ, or of its manual tracking: X and Y, by slice or row."""
    names = [cell.casefold() for cell in text.head[0]]
    pair = next((pair for pair in (("x", "y"), ("xm", "ym")) if set(pair) <= set(names)), None)
    if pair is None or not _MEASURED & set(names) or {"t", "time"} & set(names):
        return None
    found = [column(names.index(name), heading(name[0].upper()), name[0]) for name in pair]
    others = [column(k, heading(cell)) for k, cell in enumerate(text.head[0]) if cell]
    others = [other for other in others if other.role in ("frame", "track_id")]
    first = first_row(text, 1, [column.index for column in found])
    why = f"{', '.join(filter(None, text.head[0][:8]))} are columns of ImageJ's results"
    return Layout("ImageJ", why, (*others, *found), first)
