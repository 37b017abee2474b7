"""The options of `read`, and how they change the columns of a file."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from stackbounce.errors import InvalidType, InvalidValue, nearest, positive, shown
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.reading.headings import slug
from stackbounce.measure.reading.roles import Column
from stackbounce.units import in_si

__all__ = ["ReadOptions", "apply_options", "of_run"]

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

    def __post_init__(self) -> None:
        if self.holds is not None and not (isinstance(self.holds, str) and self.holds in KINDS):
            raise InvalidValue(
                f"holds must be what a file holds, got {shown(self.holds)}; "
                f"{nearest(self.holds, KINDS)}"
            )
        if not isinstance(self.table, str | None):
            raise InvalidType(f"table must be a name, got {shown(self.table)}")
        if isinstance(self.run, bool) or not isinstance(self.run, str | int | None):
            raise InvalidType(f"run must be a name or a number, got {shown(self.run)}")
        if not isinstance(self.decimal, str | None):
            raise InvalidType(f'decimal must be "." or ",", got {shown(self.decimal)}')
        for option, unit in (("frame_rate", "frames per second"), ("scale", "metres per pixel")):
            if getattr(self, option) is not None:
                positive(option, getattr(self, option), unit)
        for name in _checked("names", self.names):
            if not name.isidentifier():
                raise InvalidValue(f"names: {shown(name)} is no name, such as 'force'")
        for unit in _checked("units", self.units):
            if in_si(unit) is None:
                raise InvalidValue(f"units: {shown(unit)} is no unit that is known, such as 'mm'")


def _checked(option: str, given: object) -> list[str]:
    """Return the texts of an option that maps columns to text."""
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise InvalidType(f"{option} must be a mapping of columns, got {shown(given)}")
    for key, value in given.items():
        if not isinstance(key, str | int) or not isinstance(value, str):
            raise InvalidType(f"{option} must map columns to text, got {shown({key: value})}")
    return list(given.values())


def apply_options(columns: Sequence[Column], told: ReadOptions) -> list[Column]:
    """Return columns with the names and units of the options."""
    found = list(columns)
    for option, mapping in (("units", told.units), ("names", told.names)):
        for key, value in (mapping or {}).items():
            places = [k for k, one in enumerate(found) if _is(one, key)]
            if not places:
                known = [one.heading.text or str(one.index + 1) for one in found[:50]]
                raise InvalidValue(
                    f"{option}: there is no column {shown(key)}; {nearest(key, known)}"
                )
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
    runs = list(dict.fromkeys(one.heading.run for one in columns if one.heading.run))
    if len(runs) < 2:
        return list(columns), False
    if run is None:
        chosen = runs[0]
        doubts.append(f"{len(runs)} runs; {chosen!r} is read, run={runs[1]!r} reads another")
    else:
        word = str(run).casefold()
        named = [one for k, one in enumerate(runs, 1) if word in (one.casefold(), str(k))]
        if not named:
            raise InvalidValue(
                f"run must be one that is there, got {shown(run)}; {nearest(run, runs)}"
            )
        chosen = named[0]
    own = [one for one in columns if one.heading.run in (chosen, "")]
    if not any(one.role == "time" for one in own):  # one time for all runs
        own = [one for one in columns if one.role == "time"][:1] + own
    return own, True
