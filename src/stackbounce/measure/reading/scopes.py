"""Tables that oscilloscopes write."""

import re
from collections.abc import Callable

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading, is_unit
from stackbounce.measure.reading.layouts import Layout, first_row
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number

__all__ = ["scopes"]


def rigol(text: Text) -> Layout | None:
    """Rigol: ``X,CH1,…,Start,Increment`` over units and two numbers, then counted samples."""
    head = text.head
    if len(head) < 2 or head[0][:1] != ["X"] or "Increment" not in head[0]:
        return None
    names, units = head[0], head[1] + [""] * len(head[0])
    start, step = (
        number(units[names.index(key)], text.decimal) if key in names else None
        for key in ("Start", "Increment")
    )
    channels = [
        column(k, heading(name, units[k]), "voltage")
        for k, name in enumerate(names)
        if k and name and name not in ("Start", "Increment")
    ]
    counted = units[0].casefold().startswith("seq")
    if counted and (start is None or step is None or not step > 0 or not channels):
        raise FileError("it begins as a table of a Rigol but has no start and increment below them")
    clock = (start, step) if counted and start is not None and step is not None else None
    return Layout(
        "Rigol oscilloscope",
        "its first line 'X,CH1,…,Start,Increment' is that of a Rigol",
        (column(0, Heading(names[0], "X", "s"), "time"), *channels),
        first_row(text, 2),
        clock=clock,
    )


def picoscope(text: Text) -> Layout | None:
    """PicoScope: ``Time,Channel A`` over ``(ms),(V)`` and a blank line."""
    head = text.head
    if len(head) < 3 or head[0][:1] != ["Time"] or len(head[0]) < 2 or len(head[1]) < 2:
        return None
    if not all(re.fullmatch(r"\(.*\)", cell) and is_unit(cell) for cell in head[1]):
        return None
    columns = tuple(
        column(k, heading(name, unit))
        for k, (name, unit) in enumerate(zip(head[0], head[1], strict=False))
    )
    why = f"names over units in brackets, {head[1][0]},{head[1][1]}, are how PicoScope writes"
    return Layout("PicoScope", why, columns, first_row(text, 2))


def tektronix_mdo(text: Text) -> Layout | None:
    """Tektronix MDO: lines of keys and values, then ``TIME,CH2``."""
    for k, row in enumerate(text.head):
        if k and row[:1] == ["TIME"] and len(row) > 1:
            break
    else:
        return None
    keys = {one[0]: one[1:] for one in text.head[:k] if one}
    if not {"Sample Interval", "Record Length"} & set(keys):
        return None
    units = [*keys.get("Horizontal Units", ["s"])[:1], *keys.get("Vertical Units", [])]
    columns = tuple(
        column(
            i,
            heading(name, (units[i] if i < len(units) else "") or ("s", "V")[i > 0]),
            ("time", "voltage")[i > 0],
        )
        for i, name in enumerate(row)
        if name
    )
    model = keys.get("Model", [""])[0]
    why = f"'TIME,{row[1]}' below keys and values is how a Tektronix {model or 'MDO'} writes"
    return Layout("Tektronix MDO oscilloscope", why, columns, first_row(text, k + 1))


def tektronix_tds(text: Text) -> Layout | None:
    """Tektronix TDS2000: keys and values in columns A and B, seconds and volts in D and E."""
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


scopes: tuple[Callable[[Text], Layout | None], ...] = (
    rigol,
    picoscope,
    tektronix_mdo,
    tektronix_tds,
)
"""In the order in which they are asked."""
