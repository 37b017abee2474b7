"""Oscilloscopes of Rigol."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number


@layout
def rigol(text: Text) -> Layout | None:
    """Recognise Rigol: ``X,CH1,…,Start,Increment`` or the same without X, units, two numbers."""
    head = text.head
    if len(head) < 2 or not {"Start", "Increment"} <= set(head[0]):
        return None
    names, units = head[0], head[1] + [""] * len(head[0])
    start, step = (number(units[names.index(key)], text.decimal) for key in ("Start", "Increment"))
    counted = names[0] != "X"
    channels = [
        column(k, heading(name, units[k]), "voltage")
        for k, name in enumerate(names)
        if (k or counted) and name and name not in ("Start", "Increment")
    ]
    clock = (start, step) if start is not None and step is not None and step > 0 else None
    indexed = not counted and units[0].casefold().startswith("seq")
    if (counted or indexed) and (clock is None or not channels):
        raise FileError("it begins as a table of a Rigol but has no start and increment below them")
    return Layout(
        "Rigol oscilloscope",
        f"its first line '{names[0]},…,Start,Increment' is that of a Rigol",
        (column(-counted, Heading("X", "X", "s"), "time"), *channels),
        first_row(text, 2),
        clock=clock if counted or indexed else None,
    )
