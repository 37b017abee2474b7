"""Programs that log sensors: LabVIEW, Logger Pro, PASCO Capstone, Vernier."""

import re

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import (
    Layout,
    columns_of,
    first_row,
    keys_above,
    layout,
    line_of,
    told,
)
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text, number

_RUN = re.compile(r"(Run|Set|Lauf|Ensayo|Essai|Ajo|Kørsel|Körning|Serie) #\d+$")
_AUTO = re.compile(r"\s+Auto$")  # times that Capstone counts itself, the same in all runs
_LABEL = re.compile(r"[0-9]+[.,][0-9]{6}\t[0-9]+[.,][0-9]{6}\t(?![-+0-9.,]+$)[^\t]*")
_END = "***End_of_Header***"


@layout
def capstone(text: Text) -> Layout | None:
    """Recognise PASCO Capstone: names end in ``Run #1``, a time's perhaps in ``Auto``."""
    for k, row in enumerate(text.head):
        cells = [cell for cell in row if cell]
        runs = [cell for cell in cells if _RUN.search(cell)]
        if len(cells) > 1 and runs and all(cell in runs or _AUTO.search(cell) for cell in cells):
            row = [_AUTO.sub("", cell) for cell in row]
            why = f"each column's name has its run after it, as in {runs[0]!r}"
            columns = columns_of(row, len(row))
            return Layout("PASCO Capstone", why, columns, first_row(text, k + 1))
    return None


@layout
def audacity(text: Text) -> Layout | None:
    """Recognise labels of Audacity: start and end in s to six digits, then a text; no header."""
    for line in filter(None, text.lines):
        label = _LABEL.fullmatch(line)
        start, end = map(float, label[0].replace(",", ".").split("\t")[:2]) if label else (1.0, 0.0)
        if start > end:
            return None
    why = "start, end and a text between tabs are how Audacity exports labels"
    starts = (column(0, Heading("start", "start", "s"), "knock_time"),)
    return Layout("Audacity: labels", why, starts, 0)


@layout
def labview(text: Text) -> Layout | None:
    """Recognise LabVIEW: two headers of keys and values, then ``X_Value`` beside the channels."""
    if not text.head[0] or text.head[0][0] != "LabVIEW Measurement":
        return None
    at = line_of(text, "X_Value")
    if not at:
        raise FileError(f"it begins as a file of LabVIEW and has no 'X_Value' below {_END}")
    keys = keys_above(text, at)
    units = [*keys.get("Y_Unit_Label", []), *[None] * len(text.head[at])]
    channels = [
        column(k, heading(name, units[k - 1]))
        for k, name in enumerate(text.head[at])
        if k and name not in ("", "X_Value", "Comment")
    ]
    first = first_row(text, at + 1)
    clock, index = None, 0
    if not text.head[first][0]:  # X_Columns No: the times follow from their step
        start, step = (number(told(keys, key), text.decimal) for key in ("X0", "Delta_X"))
        if start is None or step is None or not step > 0.0:
            raise FileError("it is a file of LabVIEW without times and without their step Delta_X")
        clock, index = (start, step), -1
    time = column(index, Heading("X_Value", "X_Value", "s"), "time")
    why = "its first line is 'LabVIEW Measurement'"
    return Layout("LabVIEW", why, (time, *channels), first, clock=clock)


@layout
def logger_pro(text: Text) -> Layout | None:
    """Recognise Logger Pro: names, short names and units stand on separate lines."""
    if not text.lines[0].startswith("Vernier Format"):
        return None
    first = first_row(text, 3)
    above = [row for row in text.head[:first] if any(row)]
    if len(above) < 5:
        raise FileError("it begins as a text of Logger Pro but lacks the names of its columns")
    names = above[-3] if len(above) > 5 else above[-2]  # the latter without short names
    columns = columns_of(names, len(text.head[first]), above[-1])
    why = f"its first line 'Vernier Format' is that of a text from Logger Pro ({above[2][0]!r})"
    return Layout("Logger Pro", why, columns, first)


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
