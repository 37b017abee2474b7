"""Oscilloscopes of LeCroy."""

from stackbounce.measure.reading.headings import Heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text


@layout
def lecroy(text: Text) -> Layout | None:
    """Recognise LeCroy: its name, segments, then ``Time,Ampl`` over seconds and volts."""
    if not text.head[0] or not text.head[0][0].casefold().startswith("lecroy"):
        return None
    k = next((k for k, row in enumerate(text.head) if row[:1] == ["Time"] and len(row) > 1), 0)
    if not k:
        return None
    columns = [
        column(i, Heading(name, name, "V" if i else "s"), "voltage" if i else "time")
        for i, name in enumerate(text.head[k])
        if name
    ]
    why = f"its first cell {text.head[0][0]!r} is that of a LeCroy"
    return Layout("LeCroy oscilloscope", why, tuple(columns), first_row(text, k + 1))
