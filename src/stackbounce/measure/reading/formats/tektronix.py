"""Oscilloscopes of Tektronix."""

from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number


@layout
def tektronix_mdo(text: Text) -> Layout | None:
    """Recognise Tektronix MDO: lines of keys and values, then ``TIME,CH2``."""
    k = next((k for k, row in enumerate(text.head) if row[:1] == ["TIME"] and len(row) > 1), 0)
    keys = {row[0]: row[1:] for row in text.head[:k] if row}
    if not {"Sample Interval", "Record Length"} & set(keys):
        return None
    row = text.head[k]
    units = [*keys.get("Horizontal Units", ["s"])[:1], *keys.get("Vertical Units", [])]
    units += [""] * len(row)
    columns = tuple(
        column(i, heading(name, units[i] or "sV"[i > 0]), ("time", "voltage")[i > 0])
        for i, name in enumerate(row)
        if name
    )
    model = (keys.get("Model") or [""])[0]
    why = f"'TIME,{row[1]}' below keys and values is how a Tektronix {model or 'MDO'} writes"
    return Layout("Tektronix MDO oscilloscope", why, columns, first_row(text, k + 1))


@layout
def tektronix_tds(text: Text) -> Layout | None:
    """Recognise Tektronix TDS2000: keys and values in columns A and B, s and V in D and E."""
    keys = {row[0]: row[1] for row in text.head if len(row) > 4 and row[0]}
    if not {"Record Length", "Sample Interval"} <= set(keys):
        return None
    if any(number(cell, text.decimal) is None for cell in text.head[0][3:5]):
        return None
    source, unit = keys.get("Source") or "CH1", keys.get("Vertical Units") or "V"
    columns = (
        column(3, Heading("D", "time", keys.get("Horizontal Units") or "s"), "time"),
        column(4, Heading(source, source, unit), "voltage"),
    )
    why = "keys from 'Record Length' on beside the numbers are how a Tektronix TDS2000 writes"
    return Layout("Tektronix TDS2000 oscilloscope", why, columns, 0)
