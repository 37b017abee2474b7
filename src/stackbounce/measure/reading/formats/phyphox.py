"""The experiments of phyphox, a phone's sensors."""

from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.roles import Column
from stackbounce.measure.reading.text import Text

_EXPERIMENTS: dict[tuple[str, ...], str] = {
    ("event time", "interval"): "acoustic stopwatch",
    ("time", "recording"): "audio scope",
    ("time", "acceleration x"): "acceleration with g",
    ("time", "linear acceleration x"): "acceleration without g",
}


@layout
def phyphox(text: Text) -> Layout | None:
    """Recognise the experiments of phyphox by the names of their columns."""
    header = text.head[0]
    names = [heading(cell).name.casefold() for cell in header if cell]
    collision = {"bounce 0", "bounce 1"} <= set(names)
    experiment = "(in)elastic collision" if collision else _EXPERIMENTS.get(tuple(names[:2]))
    if experiment is None:
        return None
    columns = columns_of(header, len(header))
    if collision:  # its one row may be all that is there
        columns = tuple(Column(k, heading(cell)) for k, cell in enumerate(header) if cell)
    why = f"its columns {header[0]!r}, {header[1]!r} are those of phyphox's {experiment}"
    holds = "bounces" if collision else ""
    return Layout(f"phyphox: {experiment}", why, columns, first_row(text, 1), holds=holds)
