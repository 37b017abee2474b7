"""Oscilloscopes of Siglent."""

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number


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
    first = k + 1
    while first < len(text.head) - 1 and not _sample(text, first, at):
        first += 1
    channels = [
        column(i, heading(name, row[i] if row[i] != "Value" else "V"), "voltage")
        for i, name in enumerate(above)
        if i > at and name and i < len(row)
    ]
    columns = (column(at, heading("Second", "s"), "time"), *channels)
    why = f"'Source,{above[at + 1]}' over 'Second,{row[at + 1]}' is how a Siglent writes"
    return Layout("Siglent oscilloscope", why, columns, first)


def _sample(text: Text, index: int, at: int) -> bool:
    cells = text.head[index][at : at + 2]
    return len(cells) > 1 and all(number(cell, text.decimal) is not None for cell in cells)
