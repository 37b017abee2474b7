"""Sensor Logger: the sensors of a phone, a file for each."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text

_UNSAID = "Sensor Logger does not write into a file which sensor it is of: "
_OTHERS = ("gyroscope", "gravity", "magnetometer", "orientation", "compass")


@layout
def sensor_logger(text: Text) -> Layout | None:
    """Recognise Sensor Logger: ``time`` since 1970, ``seconds_elapsed``, and the axes."""
    names = text.head[0]
    if not {"seconds_elapsed", "x", "y", "z"} <= set(names):
        return None
    name = text.name.casefold()
    other = next((sensor for sensor in _OTHERS if sensor in name), None)
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
        told = Heading(f"{said} {axis} (m/s^2)", f"{said} {axis}", "m/s^2")
        columns.append(column(names.index(axis), told))
    why = f"its columns {', '.join(names[:3])} … are those of Sensor Logger"
    first = first_row(text, 1)
    return Layout(f"Sensor Logger: {what}", why, tuple(columns), first, (doubt,))
