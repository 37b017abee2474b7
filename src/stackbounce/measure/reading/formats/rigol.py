"""Oscilloscopes of Rigol."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number


@layout
def rigol(text: Text) -> Layout | None:
    """Recognise Rigol: ``X,CH1,…,Start,Increment``, or without X, over units and two numbers.

    X is a time in s, or counts samples; without it there is one sample in each row.
    """
    head = text.head
    if len(head) < 2 or not {"Start", "Increment"} <= set(head[0]):
        return None
    names, units = head[0], head[1] + [""] * len(head[0])
    start, step = (number(units[names.index(key)], text.decimal) for key in ("Start", "Increment"))
    timed = names[0] == "X"
    channels = [
        column(k, heading(name, units[k]), "voltage")
        for k, name in enumerate(names)
        if k >= timed and name not in ("", "Start", "Increment")
    ]
    counted = not timed or units[0].casefold().startswith("seq")
    if counted and (start is None or step is None or not step > 0 or not channels):
        raise FileError("it begins as a table of a Rigol but has no start and increment below them")
    clock = (start, step) if counted and start is not None and step is not None else None
    columns = (column(0 if timed else -1, Heading(names[0], "X", "s"), "time"), *channels)
    why = f"its first line '{names[0]},…,Start,Increment' is that of a Rigol"
    return Layout("Rigol oscilloscope", why, columns, first_row(text, 2), clock=clock)
