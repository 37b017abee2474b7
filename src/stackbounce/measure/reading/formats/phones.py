"""Apps of phones: phyphox, Sensor Logger."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading, heading
from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.roles import Column, column
from stackbounce.measure.reading.text import Text

_EXPERIMENTS: dict[tuple[str, ...], str] = {
    ("event time", "interval"): "acoustic stopwatch",
    ("time", "recording"): "audio scope",
    ("time", "acceleration x"): "acceleration with g",
    ("time", "linear acceleration x"): "acceleration without g",
}
_UNSAID = "Sensor Logger does not write into a file which sensor it is of: "
_OTHERS = ("gyroscope", "gravity", "magnetometer", "orientation", "compass")


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
