"""A part of a record: between two times, or frames or rows where these are what a file counts."""

from typing import TYPE_CHECKING

from stackbounce.errors import InvalidValue, shown
from stackbounce.measure.messages import Message, OptionHint, about_option
from stackbounce.units import in_si, quantity, unit_written

if TYPE_CHECKING:
    import xarray as xr


def checked(option: str, given: object) -> None:
    """Raise `InvalidValue` where an end of a part is neither a time nor a number."""
    unit = None if isinstance(given, bool) else unit_written(str(given))
    if unit is None or (unit and (in_si(unit) or ("", ""))[1] != "s"):
        wrong = f" must be a time, such as 1.2s, or a frame or row, such as 120, got {shown(given)}"
        raise InvalidValue(about_option(option, wrong))


def part_of(
    data: "xr.Dataset", start: float | str | None = None, stop: float | str | None = None
) -> "xr.Dataset":
    """Return the part of a Dataset from one time, frame or row to another, both included.

    Parameters
    ----------
    data : xarray.Dataset
        With a time, the times of knocks, or rows that are counted from 1.
    start, stop : float or str, optional
        Numbers without a unit are frames where the file counts frames, rows where it counts
        neither frames nor times, and else seconds.

    Raises
    ------
    InvalidValue
        If nothing lies between them, or a time is given where rows or frames are counted.
    """
    if start is None and stop is None:
        return data
    name = next(n for n in ("time", "knock_time", *map(str, data.dims)) if n in data.variables)
    along = data[name]
    unit = along.attrs.get("units", "row")
    frame = float(along.attrs.get("frame", unit == "row"))  # of a frame or row; 0 of times

    def end(option: str, given: float | str, half: float) -> float:
        if frame and not unit_written(str(given)):
            return (float(given) + half) * frame
        if unit != "s":
            wrong = f" must be the number of a {unit}, as the file has no times, got {shown(given)}"
            raise InvalidValue(about_option(option, wrong))
        return quantity(given, "s", option)

    low = float("-inf") if start is None else end("start", start, -0.5)
    high = float("inf") if stop is None else end("stop", stop, 0.5)
    kept = ((along >= low) & (along <= high)).values.nonzero()[0]
    if not kept.size:
        first, last = float(along.min()), float(along.max())
        got = f" must leave some of the record, which goes from {first:.6g} to {last:.6g} {unit}"
        hint = OptionHint({"start": None, "stop": None})
        raise InvalidValue(Message(hint, f"{got}, got {shown(start)} to {shown(stop)}"))
    return data.isel({dim: kept for dim in data.dims if dim != "track"})
