"""Oscilloscopes of Rigol."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number


@layout
def rigol(text: Text) -> Layout | None:
    """Recognise Rigol: ``X,CH1,…,Start,Increment``, units, two numbers, then counted samples."""
    head = text.head
    if len(head) < 2 or head[0][:1] != ["X"] or "Increment" not in head[0]:
        return None
    names, units = head[0], head[1] + [""] * len(head[0])
    start, step = (
        number(units[names.index(key)], text.decimal) if key in names else None
        for key in ("Start", "Increment")
    )
    channels = [
        column(k, heading(name, units[k]), "voltage")
        for k, name in enumerate(names)
        if k and name and name not in ("Start", "Increment")
    ]
    counted = units[0].casefold().startswith("seq")
    if counted and (start is None or step is None or not step > 0 or not channels):
        raise FileError("it begins as a table of a Rigol but has no start and increment below them")
    clock = (start, step) if counted and start is not None and step is not None else None
    return Layout(
        "Rigol oscilloscope",
        "its first line 'X,CH1,…,Start,Increment' is that of a Rigol",
        (column(0, Heading(names[0], "X", "s"), "time"), *channels),
        first_row(text, 2),
        clock=clock,
    )
