"""LabVIEW's measurement files (.lvm)."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import Column, column
from stackbounce.measure.reading.text import Text, number

_END = "***End_of_Header***"


@layout
def labview(text: Text) -> Layout | None:
    """Recognise LabVIEW: two headers of keys and values, then ``X_Value`` beside the channels."""
    if not text.head[0] or text.head[0][0] != "LabVIEW Measurement":
        return None
    at = next((k for k, row in enumerate(text.head) if row[:1] == ["X_Value"]), 0)
    if not at:
        raise FileError(f"it begins as a file of LabVIEW and has no 'X_Value' below {_END}")
    keys = {row[0]: row[1:] for row in text.head[:at] if row}
    units = keys.get("Y_Unit_Label", [])
    channels: list[Column] = []
    for k, name in enumerate(text.head[at]):
        unit = units[k - 1] if 0 < k <= len(units) else None
        if k and name and name not in ("X_Value", "Comment"):
            channels.append(column(k, heading(name, unit)))
    first = first_row(text, at + 1)
    clock, index = None, 0
    if not text.head[first][0]:  # X_Columns No: the times follow from their step
        start, step = (
            number((keys.get(key) or [""])[0], text.decimal) for key in ("X0", "Delta_X")
        )
        if start is None or step is None or not step > 0.0:
            raise FileError("it is a file of LabVIEW without times and without their step Delta_X")
        clock, index = (start, step), -1
    time = column(index, Heading("X_Value", "X_Value", "s"), "time")
    why = "its first line is 'LabVIEW Measurement'"
    return Layout("LabVIEW", why, (time, *channels), first, clock=clock)
