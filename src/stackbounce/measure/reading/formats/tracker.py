"""Tracker: positions of marks in a video."""

from stackbounce.measure.reading.headings import Heading, heading, is_unit
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text


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
