"""AviMéca: positions of marks in a video."""

from stackbounce.measure.reading.headings import is_unit
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text


@layout
def avimeca(text: Text) -> Layout | None:
    """Recognise AviMéca: a title, ``t``, ``x``, ``y``, and their units in a line below."""
    head = text.head
    at = next((k for k, row in enumerate(head[:10]) if row[:1] == ["t"] and len(row) > 1), 0)
    if not at or at + 1 >= len(head) or "avim" not in text.line(0).casefold():
        return None
    if not all(map(is_unit, filter(None, head[at + 1]))):
        return None
    columns = columns_of(head[at], len(head[at]), head[at + 1])
    why = f"its first line {text.line(0).strip()[:40]!r} is that of AviMéca"
    return Layout("AviMéca", why, columns, first_row(text, at + 2))
