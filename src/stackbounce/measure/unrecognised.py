"""A table of an unknown kind: what its columns look like, and how to go on."""

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array

if TYPE_CHECKING:
    import xarray as xr

_LISTED = 6  # columns that are described
_EVENLY = "rises evenly, like times"
_FILMED = 2e-3  # s between frames, at least; steps below are a sensor's
_PLAIN = re.compile(r"[^\W\d][\w .()/-]{0,30}")  # a header that can be typed as it is


class _Look(NamedTuple):
    """A column: its number in the file, its name, its numbers and what these look like."""

    number: int
    name: str
    values: Array
    look: str


def unrecognised(data: "xr.Dataset", kinds: Iterable[str]) -> Message:
    """Return why a table cannot be analysed: its columns, their first numbers, and what to type.

    Parameters
    ----------
    data : xarray.Dataset
        A table as `read` gives it.
    kinds : iterable of str
        What a file can hold.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> columns = {"CH1": ("row", np.array([3.0, 1.0]), {"column": 1, "long_name": "CH1"})}
    >>> data = xr.Dataset(columns, attrs={"source": "a.txt"})
    >>> print(unrecognised(data, ["track", "sound"]))
    its columns do not tell ... kind of measurement: 'CH1' (3, 1). If these are heights: ...
    """
    looks = [_look(column) for column in data.data_vars.values()]
    shown = ", ".join(map(_described, looks[:_LISTED]))
    more = f" and {len(looks) - _LISTED} more" if len(looks) > _LISTED else ""
    beginning = f"its columns do not tell a kind of measurement: {shown}{more}. "
    file = str(data.attrs.get("source", "")) or "FILE"
    words, holds, names = _guess(looks)
    hint = OptionHint({"holds": holds, "names": names}, file)
    others = ", ".join(name for name in kinds if name not in (holds, "bounces", "table"))
    return Message(beginning, words, hint, f"; other kinds: {others}")


def _look(one: "xr.DataArray") -> _Look:
    values = np.asarray(one.values, dtype=np.float64).ravel()
    text = str(one.attrs.get("long_name", ""))
    number = int(one.attrs.get("column", 0))
    known = values[np.isfinite(values)]
    steps = np.diff(known)
    look = ""
    if known.size > 1 and not np.ptp(known) > 0.0:
        look = "constant"
    elif known.size > 2 and (steps >= 0.0).all() and np.ptp(known) > 0.0:
        mean = float(np.mean(steps))
        even = bool((np.abs(steps - mean) < 0.1 * mean).all())
        look = _EVENLY if even else "rises"
    return _Look(number, "" if re.fullmatch(r"column \d+", text) else text, known, look)


def _described(one: _Look) -> str:
    first = ", ".join(f"{value:.5g}" for value in one.values[:3])
    name = f"{one.name[:40]!r}" if one.name else f"column {one.number}"
    return f"{name} ({first}{'; ' * bool(one.look)}{one.look})"


def _guess(looks: list[_Look]) -> tuple[str, str, dict[str | int, str]]:
    """Return what a table may be, in words and as the options that say so."""
    clocks = [look for look in looks if look.look.startswith("rises")]  # can be times
    clock = next((look for look in clocks if look.look == _EVENLY), clocks[0] if clocks else None)
    moving = [look for look in looks if look is not clock and look.look != "constant"]
    others = [look for look in moving if look.look != _EVENLY] or moving
    if clock is None:
        if len(looks) < 2:
            return "If these are heights: ", "table", _named(looks, ["y"])
        words = "None of them rises like times. If one is a force and one a length: "
        return words, "press curve", _named(looks, ["force", "compression"])
    if not others:
        return "If these are times of knocks: ", "knocks", _named([clock], ["knock_time"])
    what, kind, roles = "a force or the voltage of a sensor", "waveform", ["voltage"]
    if np.median(np.diff(clock.values)) >= _FILMED:
        flat = len(others) > 1
        what, roles = ("positions", ["x", "y"]) if flat else ("heights", ["y"])
        what, kind = f"{what} of a ball", "track"
    return f"If these are times and {what}: ", kind, _named([clock, *others], ["time", *roles])


def _named(looks: list[_Look], roles: list[str]) -> dict[str | int, str]:
    """Return roles by columns: by headers where these are plain and differ, else by numbers."""
    names = [look.name for look in looks]
    return {
        look.name
        if _PLAIN.fullmatch(look.name) and names.count(look.name) == 1
        else look.number: role
        for look, role in zip(looks, roles, strict=False)
    }
