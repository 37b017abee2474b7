"""Sensor Logger: the sensors of a phone, a file for each."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text

_WITH_G, _WITHOUT = "total", "accelerometer"
_OTHERS = ("gyroscope", "gravity", "magnetometer", "orientation", "compass")


@layout
def sensor_logger(text: Text) -> Layout | None:
    """Recognise Sensor Logger: ``time`` since 1970, ``seconds_elapsed``, and the axes."""
    names = text.head[0]
    if not {"seconds_elapsed", "x", "y", "z"} <= set(names):
        return None
    name = text.name.casefold()
    other = next((one for one in _OTHERS if one in name), None)
    if other is not None:
        raise FileError(f"it is the {other} of Sensor Logger: take its Accelerometer.csv")
    with_g = _WITH_G in name
    said = "Acceleration" if with_g else "Linear Acceleration"
    doubt = (
        "Sensor Logger does not write into a file what it is: by its name it has g in it"
        if with_g
        else "Sensor Logger does not write into a file what it is: taken as an acceleration "
        "without g, that of TotalAcceleration.csv has g in it"
    )
    columns = [column(names.index("seconds_elapsed"), Heading("seconds_elapsed", "time", "s"))]
    for axis in "xyz":
        text_of = f"{said} {axis} (m/s^2)"
        columns.append(column(names.index(axis), Heading(text_of, f"{said} {axis}", "m/s^2")))
    why = f"its columns {', '.join(names[:3])} … are those of Sensor Logger"
    what = "acceleration with g" if with_g else "acceleration without g"
    doubts = (doubt,)
    return Layout(f"Sensor Logger: {what}", why, tuple(columns), first_row(text, 1), doubts)
