"""PicoScope: oscilloscopes of Pico."""

import re

from stackbounce.measure.reading.headings import is_unit
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text


@layout
def picoscope(text: Text) -> Layout | None:
    """Recognise PicoScope: ``Time,Channel A`` over ``(ms),(V)`` and a blank line."""
    head = text.head
    if len(head) < 3 or head[0][:1] != ["Time"] or len(head[0]) < 2 or len(head[1]) < 2:
        return None
    if not all(re.fullmatch(r"\(.*\)", cell) and is_unit(cell) for cell in head[1]):
        return None
    columns = columns_of(head[0], min(len(head[0]), len(head[1])), head[1])
    if any(column.unit == "N" for column in columns):  # a press, such as Instron Bluehill's tables
        return None
    why = f"names over units in brackets, {head[1][0]},{head[1][1]}, are how PicoScope writes"
    return Layout("PicoScope", why, columns, first_row(text, 2))
