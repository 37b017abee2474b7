"""Vernier's CSV files."""

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text


@layout
def vernier(text: Text) -> Layout | None:
    """Recognise Vernier: each column's name begins with its run."""
    header = text.head[0]
    headings = [heading(cell) for cell in header if cell]
    runs = [heading.run for heading in headings]
    if len(runs) < 2 or not all(runs) or "#" in runs[0] or not headings[0].text.startswith(runs[0]):
        return None
    why = f"each column's name has its run before it, as in {header[0]!r}"
    return Layout("Vernier", why, columns_of(header, len(header)), first_row(text, 1))
