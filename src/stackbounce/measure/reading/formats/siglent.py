"""Oscilloscopes of Siglent."""

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text


@layout
def siglent(text: Text) -> Layout | None:
    """Recognise Siglent: ``Source,CH1`` over ``Second,Volt``, below or beside keys and values."""
    for k, row in enumerate(text.head[1:40], 1):
        at = next((i for i, cell in enumerate(row) if cell == "Second"), -1)
        above = text.head[k - 1]
        if 0 <= at < min(len(row), len(above)) - 1 and above[at] == "Source":
            break
    else:
        return None
    channels = [
        column(i, heading(name, row[i] if row[i] != "Value" else "V"), "voltage")
        for i, name in enumerate(above)
        if i > at and name and i < len(row)
    ]
    columns = (column(at, heading("Second", "s"), "time"), *channels)
    why = f"'Source,{above[at + 1]}' over 'Second,{row[at + 1]}' is how a Siglent writes"
    return Layout("Siglent oscilloscope", why, columns, first_row(text, k + 1, [at, at + 1]))
