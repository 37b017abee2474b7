"""Logger Pro's text files."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text


@layout
def logger_pro(text: Text) -> Layout | None:
    """Recognise Logger Pro: names, short names and units stand on separate lines."""
    if not text.line(0).startswith("Vernier Format"):
        return None
    first = first_row(text, 3)
    lines = [k for k in range(first) if any(text.head[k])]
    if len(lines) < 5:
        raise FileError("it begins as a text of Logger Pro but lacks the names of its columns")
    names, units = text.head[lines[-3]], text.head[lines[-1]]
    width = len(text.head[first])
    if len(lines) < 6:  # without short names
        names = text.head[lines[-2]]
    run = text.head[lines[2]][0]
    columns = columns_of(names, width, units)
    why = f"its first line 'Vernier Format' is that of a text from Logger Pro ({run!r})"
    return Layout("Logger Pro", why, columns, first)
