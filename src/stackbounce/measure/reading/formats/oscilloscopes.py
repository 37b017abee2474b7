"""Oscilloscopes: GW Instek, LeCroy, PicoScope, Rigol, Siglent, Tektronix."""

import re
from collections.abc import Sequence

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading, is_unit
from stackbounce.measure.reading.layouts import (
    Layout,
    columns_of,
    first_row,
    keys_above,
    layout,
    line_of,
    told,
)
from stackbounce.measure.reading.roles import Column, column
from stackbounce.measure.reading.text import Text, number


def _traces(names: Sequence[str], units: Sequence[str], first: int = 0) -> tuple[Column, ...]:
    """Return the columns of a time, the first one, and of the channels beside it.

    A column without a name is left out. A blank unit is s or V.
    """
    return tuple(
        column(k, heading(names[k], unit or "sV"[k > first]), ("time", "voltage")[k > first])
        for k, unit in enumerate(units)
        if first <= k < len(names) and names[k]
    )


@layout
def gwinstek(text: Text) -> Layout | None:
    """Recognise GW Instek: keys and values, ``Waveform Data``, then pairs of time and voltage."""
    keys = keys_above(text, len(text.head))
    if not {"Memory Length", "Sampling Period", "Waveform Data"} <= set(keys):
        return None
    if told(keys, "Mode").casefold() == "fast":
        raise FileError(
            "it is a file of a GW Instek in the mode Fast, with counts instead of volts: save it "
            "in the mode Detail"
        )
    names, units = ["time"], [told(keys, "Horizontal Units")]
    for k in range(1 + keys.get("Source", []).count("Source")):  # channels beside each other
        names += [told(keys, "Source", 2 * k) or f"CH{k + 1}", ""]
        units += [told(keys, "Vertical Units", 2 * k), ""]
    why = "'Memory Length' … 'Waveform Data' over pairs of numbers are how a GW Instek writes"
    first = first_row(text, [row[:1] for row in text.head].index(["Waveform Data"]) + 1)
    return Layout("GW Instek oscilloscope", why, _traces(names, units), first)


@layout
def lecroy(text: Text) -> Layout | None:
    """Recognise LeCroy: its name, segments, then ``Time,Ampl`` over seconds and volts."""
    k = line_of(text, "Time")
    if not k or not "".join(text.head[0][:1]).casefold().startswith("lecroy"):
        return None
    columns = _traces(text.head[k], [""] * len(text.head[k]))
    why = f"its first cell {text.head[0][0]!r} is that of a LeCroy"
    return Layout("LeCroy oscilloscope", why, columns, first_row(text, k + 1))


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


@layout
def rigol(text: Text) -> Layout | None:
    """Recognise Rigol: ``X,CH1,…,Start,Increment``, or without X, over units and two numbers.

    X is a time in s, or counts samples; without it there is one sample in each row.
    """
    head = text.head
    if len(head) < 2 or not {"Start", "Increment"} <= set(head[0]):
        return None
    names, units = head[0], head[1] + [""] * len(head[0])
    start, step = (number(units[names.index(key)], text.decimal) for key in ("Start", "Increment"))
    timed = names[0] == "X"
    channels = [
        column(k, heading(name, units[k]), "voltage")
        for k, name in enumerate(names)
        if k >= timed and name not in ("", "Start", "Increment")
    ]
    counted = not timed or units[0].casefold().startswith("seq")
    if counted and (start is None or step is None or not step > 0 or not channels):
        raise FileError("it begins as a table of a Rigol but has no start and increment below them")
    clock = (start, step) if counted and start is not None and step is not None else None
    columns = (column(0 if timed else -1, Heading(names[0], "X", "s"), "time"), *channels)
    why = f"its first line '{names[0]},…,Start,Increment' is that of a Rigol"
    return Layout("Rigol oscilloscope", why, columns, first_row(text, 2), clock=clock)


@layout
def siglent(text: Text) -> Layout | None:
    """Recognise Siglent: ``Source,CH1`` over ``Second,Volt``, below or beside keys and values."""
    for k, row in enumerate(text.head[1:40], 1):
        at = row.index("Second") if "Second" in row else len(row)
        above = text.head[k - 1]
        if at < min(len(row), len(above)) - 1 and above[at] == "Source":
            break
    else:
        return None
    units = [*row[:at], "s", *("V" if cell == "Value" else cell for cell in row[at + 1 :])]
    columns = _traces([*row[: at + 1], *above[at + 1 :]], units, at)
    why = f"'Source,{above[at + 1]}' over 'Second,{row[at + 1]}' is how a Siglent writes"
    return Layout("Siglent oscilloscope", why, columns, first_row(text, k + 1, [at, at + 1]))


@layout
def tektronix_mdo(text: Text) -> Layout | None:
    """Recognise Tektronix MDO: lines of keys and values, then ``TIME,CH2``."""
    k = line_of(text, "TIME")
    keys = keys_above(text, k)
    if not {"Sample Interval", "Record Length"} & set(keys):
        return None
    row = text.head[k]
    units = [told(keys, "Horizontal Units"), *keys.get("Vertical Units", [])]
    columns = _traces(row, units + [""] * len(row))
    model = told(keys, "Model") or "MDO"
    why = f"'TIME,{row[1]}' below keys and values is how a Tektronix {model} writes"
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
