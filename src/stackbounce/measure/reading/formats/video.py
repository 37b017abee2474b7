"""Video analysis: AviMéca, ImageJ, Tracker, TrackMate; positions of marks in frames."""

import re

from stackbounce.measure.reading.headings import Heading, heading, is_unit
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout, line_of
from stackbounce.measure.reading.roles import POINT, column
from stackbounce.measure.reading.text import Text, number

_MEASURED = {"", "area", "mean", "label", "counter", "slice", "slice n°", "xm", "bx", "intden"}
_CLOSED_UP = (
    "blank cells were lost, so that numbers stand under Flag: points are put together to tracks by "
    "where they are"
)
_SUMMARY = re.compile(r"\n+Track\s")  # a line for each track, below all points
_NUMBERED = re.compile(r"([xy]) ?([0-9]{1,3})")
_ROLES = {
    "TRACK_ID": "track_id", "FRAME": "frame", "POSITION_X": "x", "POSITION_Y": "y",
    "POSITION_T": "time",
}  # fmt: skip


@layout
def avimeca(text: Text) -> Layout | None:
    """Recognise AviMéca: a title, ``t``, ``x``, ``y``, and their units in a line below."""
    head = text.head
    at = line_of(text, "t")
    if not at or at + 1 >= len(head) or "avim" not in text.lines[0].casefold():
        return None
    if not all(map(is_unit, filter(None, head[at + 1]))):
        return None
    columns = columns_of(head[at], len(head[at]), head[at + 1])
    why = f"its first line {text.lines[0].strip()[:40]!r} is that of AviMéca"
    return Layout("AviMéca", why, columns, first_row(text, at + 2))


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
    if pair is None or not _MEASURED & set(names):
        return None
    found = [column(names.index(name), heading(name[0].upper()), name[0]) for name in pair]
    others = [column(k, heading(cell)) for k, cell in enumerate(text.head[0]) if cell]
    if any(other.role == "time" for other in others):  # which ImageJ does not write
        return None
    others = [other for other in others if other.role in ("frame", "track_id")]
    first = first_row(text, 1, [column.index for column in found])
    why = f"{', '.join(filter(None, text.head[0][:8]))} are columns of ImageJ's results"
    return Layout("ImageJ", why, (*others, *found), first)


@layout
def tracker(text: Text) -> Layout | None:
    """Recognise Tracker: ``#multi:`` over track names, or one name over ``t``, ``x``, ``y``."""
    head = text.head
    multi = bool(head[0]) and head[0][0].startswith("#multi:")
    at = 2 if multi else 1
    if len(head) <= at or not head[at]:
        return None
    cells = [heading(cell) for cell in head[at]]
    if cells[0].name != "t" or not {"x", "y"} & {cell.name for cell in cells}:
        return None
    above = head[at - 1]
    names = [cell for cell in above if cell]
    if not multi and (len(names) != 1 or not above[0]):
        return None
    if not multi and at + 1 < len(head) and all(map(is_unit, filter(None, head[at + 1]))):
        return None  # AviMéca writes units below
    columns, track = [column(0, Heading("t", "t", "s"), "time")], names[0] if names else ""
    for k, cell in enumerate(cells[1:], 1):
        if multi and k < len(above) and above[k]:
            track = above[k]
        if cell.text:
            role = cell.name if cell.name in ("x", "y") else ""
            columns.append(column(k, cell, role, track))
    told = "its line '#multi:'" if multi else "the name of a track"
    why = f"{told} over the columns t, x, y is how Tracker exports data"
    return Layout("Tracker", why, tuple(columns), first_row(text, at + 1))


@layout
def trackmate(text: Text) -> Layout | None:
    """Recognise TrackMate's spots: ``POSITION_X`` … over longer names, short ones and units."""
    names = text.head[0]
    if not {"FRAME", "POSITION_X", "POSITION_Y"} <= set(names):
        return None
    first = first_row(text, 1, [names.index("POSITION_X"), names.index("POSITION_Y")])
    units = text.head[first - 1] if first > 1 else []
    columns = []
    for k, name in enumerate(names):
        unit = units[k].strip("() ") if k < len(units) else ""
        if name in _ROLES and not (name == "POSITION_T" and unit in ("", "frame", "frames")):
            columns.append(column(k, heading(name, unit), _ROLES[name]))
    why = "FRAME, POSITION_X, POSITION_Y are columns of TrackMate's spots"
    return Layout("TrackMate", why, tuple(columns), first)
