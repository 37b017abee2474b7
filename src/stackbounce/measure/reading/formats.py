"""The layouts of programs: a function for each, in the order in which they are tried.

Programs that log sensors (Audacity, LabVIEW, Logger Pro), oscilloscopes (GW Instek, LeCroy, Rigol,
Siglent, Tektronix), apps of phones (phyphox, Sensor Logger) and video analysis (ImageJ, Tracker,
TrackMate). A program whose header says all needs none: its tables are read as any others.
"""

import re
from collections.abc import Sequence

from stackbounce.errors import FileError
from stackbounce.measure.reading.layouts import (
    Layout,
    columns_of,
    first_row,
    general,
    keys_above,
    line_of,
    told,
)
from stackbounce.measure.reading.roles import POINT, Column, Heading, column, heading, is_unit
from stackbounce.measure.reading.text import Text, number

_LABEL = re.compile(r"[0-9]+[.,][0-9]{6}\t[0-9]+[.,][0-9]{6}\t(?![-+0-9.,]+$)[^\t]*")
_KNOCK = re.compile(r"bounce [0-9]+")  # its time
_UNSAID = "Sensor Logger does not write into a file which sensor it is of: "
_OTHER_SENSORS = ("gyroscope", "gravity", "magnetometer", "orientation", "compass")
_IMAGEJ = {"", "area", "label", "slice", "slice n°"}  # beside which X and Y are pixels
_CLOSED_UP = (
    "blank cells were lost, so that numbers stand under Flag: points are put together to tracks by "
    "where they are"
)
_SUMMARY = re.compile(r"\n+Track\s")  # a line for each track, below all points
_NUMBERED = re.compile(r"([xy]) ?([0-9]{1,3})")
_SPOT = ("TRACK_ID", "FRAME", "POSITION_X", "POSITION_Y", "POSITION_T")


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


def labview(text: Text) -> Layout | None:
    """Recognise LabVIEW: two headers of keys and values, then ``X_Value`` beside the channels."""
    if not text.head[0] or text.head[0][0] != "LabVIEW Measurement":
        return None
    at = line_of(text, "X_Value")
    if not at:
        raise FileError("it begins as a file of LabVIEW and has no 'X_Value' below its header")
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


def _traces(names: Sequence[str], units: Sequence[str], first: int = 0) -> tuple[Column, ...]:
    """Return the columns of a time, the first one, and of the channels beside it.

    A column without a name is left out. A blank unit is s or V.
    """
    return tuple(
        column(k, heading(names[k], unit or "sV"[k > first]), ("time", "voltage")[k > first])
        for k, unit in enumerate(units)
        if first <= k < len(names) and names[k]
    )


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


def lecroy(text: Text) -> Layout | None:
    """Recognise LeCroy: its name, segments, then ``Time,Ampl`` over seconds and volts."""
    k = line_of(text, "Time")
    if not k or not "".join(text.head[0][:1]).casefold().startswith("lecroy"):
        return None
    columns = _traces(text.head[k], [""] * len(text.head[k]))
    why = f"its first cell {text.head[0][0]!r} is that of a LeCroy"
    return Layout("LeCroy oscilloscope", why, columns, first_row(text, k + 1))


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


def phyphox(text: Text) -> Layout | None:
    """Recognise the (in)elastic collision of phyphox; its one row may be all that is there."""
    header = text.head[0]
    cells = [heading(cell) for cell in header]
    knocks = tuple(
        Column(k, cell, "knock_time")
        for k, cell in enumerate(cells)
        if _KNOCK.fullmatch(cell.name.casefold())
    )
    if len(knocks) < 2:
        return None
    why = f"its columns {header[0]!r}, {header[1]!r} are those of phyphox's (in)elastic collision"
    return Layout("phyphox: (in)elastic collision", why, knocks, first_row(text, 1), holds="knocks")


def sensor_logger(text: Text) -> Layout | None:
    """Recognise Sensor Logger: ``time`` since 1970, ``seconds_elapsed``, and the axes."""
    names = text.head[0]
    if not {"seconds_elapsed", "x", "y", "z"} <= set(names):
        return None
    name = text.name.casefold()
    other = next((sensor for sensor in _OTHER_SENSORS if sensor in name), None)
    if other is not None:
        raise FileError(f"it is the {other} of Sensor Logger: take its Accelerometer.csv")
    if "total" in name:
        said, what = "Acceleration", "acceleration with g"
        doubt = f"{_UNSAID}by its name it is an acceleration with g"
    else:
        said, what = "Linear Acceleration", "acceleration without g"
        doubt = f"{_UNSAID}taken as an acceleration without g; TotalAcceleration.csv has g in it"
    columns = [column(names.index("seconds_elapsed"), Heading("seconds_elapsed", "time", "s"))]
    for axis in "xyz":
        named = Heading(f"{said} {axis} (m/s^2)", f"{said} {axis}", "m/s^2")
        columns.append(column(names.index(axis), named))
    why = f"its columns {', '.join(names[:3])} … are those of Sensor Logger"
    return Layout(f"Sensor Logger: {what}", why, tuple(columns), first_row(text, 1), (doubt,))


def mtrack2(text: Text) -> Layout | None:
    """Recognise MTrack2: ``Frame, X1, Y1, Flag1, X2 …``, often over ``Tracks 1 to 6``."""
    names = [cell.casefold() for cell in text.head[0]]
    if names[:1] != ["frame"] or not {"x1", "y1"} <= set(names):
        return None
    first, doubts = first_row(text, 1), list[str]()
    places = [(k, place) for k, name in enumerate(names) if (place := _NUMBERED.fullmatch(name))]
    found = [column(k, heading(one[1].upper()), one[1], f"track {one[2]}") for k, one in places]
    if _closed_up(text, first, len(names)):
        doubts.append(_CLOSED_UP)
        found = [
            column(k, heading("XY"[k % 2 == 0]), "xy"[k % 2 == 0], f"{POINT}{(k + 1) // 2}")
            for k in range(1, 1 + 2 * sum(one[1] == "x" for _, one in places))
        ]
    why = "Frame, X1, Y1 are the columns of MTrack2, a plugin of ImageJ"
    columns = (column(0, heading("Frame"), "frame"), *found)
    summary = _SUMMARY.search(text.content, text.starts[first])
    end = summary.start() if summary else None
    return Layout("ImageJ: MTrack2", why, columns, first, tuple(doubts), end=end)


def _closed_up(text: Text, first: int, width: int) -> bool:
    """Return whether numbers stand where flags should: a spreadsheet loses blank cells."""
    flags = [row[3] for row in text.head[first:] if 4 < len(row) <= width and row[3]]
    numbers = sum(number(cell, text.decimal) is not None and cell != "*" for cell in flags)
    return 2 * numbers > len(flags)


def results(text: Text) -> Layout | None:
    """Recognise a results table of ImageJ, or of its manual tracking: X and Y, by slice or row."""
    names = [cell.casefold() for cell in text.head[0]]
    pair = next((pair for pair in (("x", "y"), ("xm", "ym")) if set(pair) <= set(names)), None)
    if pair is None or not _IMAGEJ & set(names):
        return None
    found = [column(names.index(name), heading(name[0].upper()), name[0]) for name in pair]
    others = [column(k, heading(cell)) for k, cell in enumerate(text.head[0]) if cell]
    if any(other.role == "time" for other in others):  # which ImageJ does not write
        return None
    others = [other for other in others if other.role in ("frame", "track_id")]
    first = first_row(text, 1, [column.index for column in found])
    why = f"{', '.join(filter(None, text.head[0][:8]))} are columns of ImageJ's results"
    return Layout("ImageJ", why, (*others, *found), first)


def tracker(text: Text) -> Layout | None:
    """Recognise Tracker: ``#multi:`` over track names, or one name over ``t``, ``x``, ``y``."""
    head = text.head
    multi = bool(head[0]) and head[0][0].startswith("#multi:")
    at = 2 if multi else 1
    if len(head) <= at or not head[at]:
        return None
    cells = [heading(cell) for cell in head[at]]
    if cells[0].name != "t" or not {"x", "y"} & {cell.name for cell in cells}:
        return None
    above = head[at - 1]
    names = [cell for cell in above if cell]
    if not multi and (len(names) != 1 or not above[0]):
        return None
    if not multi and at + 1 < len(head) and all(map(is_unit, filter(None, head[at + 1]))):
        return None  # AviMéca writes units below
    columns, track = [column(0, Heading("t", "t", "s"), "time")], names[0] if names else ""
    for k, cell in enumerate(cells[1:], 1):
        if multi and k < len(above) and above[k]:
            track = above[k]
        if cell.text:
            role = cell.name if cell.name in ("x", "y") else ""
            columns.append(column(k, cell, role, track))
    seen = "its line '#multi:'" if multi else "the name of a track"
    why = f"{seen} over the columns t, x, y is how Tracker exports data"
    return Layout("Tracker", why, tuple(columns), first_row(text, at + 1))


def trackmate(text: Text) -> Layout | None:
    """Recognise TrackMate's spots: ``POSITION_X`` … over longer names, short ones and units."""
    names = text.head[0]
    if not {"FRAME", "POSITION_X", "POSITION_Y"} <= set(names):
        return None
    first = first_row(text, 1, [names.index("POSITION_X"), names.index("POSITION_Y")])
    units = text.head[first - 1] if first > 1 else []
    columns = []
    for k, name in enumerate(names):
        unit = units[k].strip("() ") if k < len(units) else ""
        if name in _SPOT and not (name == "POSITION_T" and unit in ("", "frame", "frames")):
            columns.append(column(k, heading(name, unit)))
    why = "FRAME, POSITION_X, POSITION_Y are columns of TrackMate's spots"
    return Layout("TrackMate", why, tuple(columns), first)


_LAYOUTS = (
    audacity, labview, logger_pro, gwinstek, lecroy, rigol, siglent, tektronix_mdo, tektronix_tds,
    phyphox, sensor_logger, mtrack2, results, tracker, trackmate,
)  # fmt: skip
"""The functions that recognise the table of a program, in the order in which they are tried."""


def layout_of(text: Text) -> Layout:
    """Return the layout of a table: that of the first program that knows it, or a general one."""
    return next(filter(None, (recognise(text) for recognise in _LAYOUTS)), None) or general(text)
