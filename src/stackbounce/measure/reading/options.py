"""The options of `read`, how they change the columns of a file, and which part they choose."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from stackbounce.errors import InvalidType, InvalidValue, nearest, positive, shown
from stackbounce.library_types import Dataset
from stackbounce.measure.kinds import KINDS, kind_named
from stackbounce.measure.messages import PART, Message, OptionHint, about_option
from stackbounce.measure.reading.roles import Column, slug
from stackbounce.units import in_si, quantity, unit_written

_Key = str | int


@dataclass(frozen=True)
class ReadOptions:
    """The options of `read`, checked as far as they can be without a file."""

    holds: str | None = None
    table: str | None = None
    run: str | int | None = None
    names: Mapping[_Key, str] | None = None
    units: Mapping[_Key, str] | None = None
    decimal: str | None = None
    frame_rate: float | None = None
    scale: float | None = None
    start: float | str | None = None
    stop: float | str | None = None

    def __post_init__(self) -> None:
        if self.holds is not None:
            holds = kind_named(self.holds) if isinstance(self.holds, str) else None
            if holds is None:
                near = nearest(self.holds, KINDS)
                wrong = f" must be what a file holds, got {shown(self.holds)}; {near}"
                raise about_option("holds", wrong)
            object.__setattr__(self, "holds", holds)
        if self.decimal not in (None, ".", ","):
            raise about_option("decimal", f' must be "." or ",", got {shown(self.decimal)}')
        for option, unit in (("frame_rate", "frames per second"), ("scale", "metres per pixel")):
            if getattr(self, option) is not None:
                positive(option, getattr(self, option), unit)
        for name in _checked("names", self.names).values():
            if not name.isidentifier():
                wrong = f" must give a column its meaning, such as 2=force, got {shown(name)}"
                raise about_option("names", wrong)
        for unit in _checked("units", self.units).values():
            if in_si(unit) is None:
                wrong = f": {shown(unit)} is no unit that is known, such as 'mm'"
                raise about_option("units", wrong)


def _checked(option: str, given: object) -> Mapping[_Key, str]:
    """Return an option that maps columns to texts."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        wrong = f" must be a mapping of columns, got {shown(given)}"
        raise about_option(option, wrong, InvalidType)
    for key, value in given.items():
        if not isinstance(key, str | int) or not isinstance(value, str):
            wrong = f" must map columns to text, got {shown({key: value})}"
            raise about_option(option, wrong, InvalidType)
    return given


def apply_options(columns: Sequence[Column], options: ReadOptions) -> list[Column]:
    """Return columns with the names and units that options give them."""
    found = list(columns)
    for option, mapping in (("units", options.units or {}), ("names", options.names or {})):
        for key, value in mapping.items():
            places = [k for k, column in enumerate(found) if _is(column, key)]
            if not places:
                known = [column.heading.text or str(column.index + 1) for column in found[:50]]
                wrong = f": there is no column {shown(key)}; {nearest(key, known)}"
                raise about_option(option, wrong)
            for k in places:
                name, unit = (value, None) if option == "names" else ("", value)
                found[k] = found[k].called(name, unit)
    return found


def _is(column: Column, key: _Key) -> bool:
    if str(key).isascii() and str(key).isdigit():
        return column.index + 1 == int(str(key)[:9])
    word = str(key).strip().casefold()
    said = column.heading
    return word in (said.text.casefold(), said.name.casefold(), slug(said.name), column.variable)


def of_run(
    columns: Sequence[Column], run: str | int | None, doubts: list[str]
) -> tuple[list[Column], bool]:
    """Return the columns of one run, and whether there are several of them side by side."""
    runs = list(dict.fromkeys(column.heading.run for column in columns if column.heading.run))
    if len(runs) < 2:
        return list(columns), False
    if run is None:
        chosen = runs[0]
        other = OptionHint({"run": runs[1]})
        doubts.append(Message(f"{len(runs)} runs; {chosen!r} is read, ", other, " reads another"))
    else:
        word = str(run).casefold()
        named = [name for k, name in enumerate(runs, 1) if word in (name.casefold(), str(k))]
        if not named:
            wrong = f" must be one that is there, got {shown(run)}; {nearest(run, runs)}"
            raise about_option("run", wrong)
        chosen = named[0]
    return [column for column in columns if column.heading.run in (chosen, "")], True


def part_of(
    data: Dataset, start: float | str | None = None, stop: float | str | None = None
) -> Dataset:
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
        If nothing lies between them, one is neither a time nor a number, or a time is given where
        rows or frames are counted.
    """
    name = next(n for n in ("time", "knock_time", *map(str, data.dims)) if n in data.variables)
    along = data[name]
    unit = along.attrs.get("units", "row")
    frame = float(along.attrs.get("frame", unit == "row"))  # of a frame or row; 0 of times

    def end(option: str, given: float | str, half: float) -> float:
        written = unit_written(str(given))
        if written is None or (written and (in_si(written) or ("", ""))[1] != "s"):
            wrong = " must be a time, such as 1.2s, or a frame or row, such as 120"
            raise about_option(option, f"{wrong}, got {shown(given)}")
        if frame and not written:
            return (float(given) + half) * frame
        if unit != "s":
            wrong = f" must be the number of a {unit}, as the file has no times, got {shown(given)}"
            raise about_option(option, wrong)
        return quantity(given, "s", option)

    low = float("-inf") if start is None else end("start", start, -0.5)
    high = float("inf") if stop is None else end("stop", stop, 0.5)
    kept = ((along.values >= low) & (along.values <= high)).nonzero()[0]
    if not kept.size:
        first, last = float(along.min()), float(along.max())
        got = f" must leave some of the record, which goes from {first:.6g} to {last:.6g} {unit}"
        raise InvalidValue(Message(PART, f"{got}, got {shown(start)} to {shown(stop)}"))
    if kept.size == along.size:
        return data
    return data.isel({dim: kept for dim in data.dims if dim != "track"})
