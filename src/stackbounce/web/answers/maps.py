"""A map: a number of the outcome over two numbers of the drop."""

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.run.paths import number_at, numbers_of
from stackbounce.run.result import Status
from stackbounce.sweeps import sweep
from stackbounce.version import __version__
from stackbounce.web.answers.compile_all import prepared

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Line", "drop_map", "map_paths"]

_RTOL = 1e-8  # far below what a color shows
_RATIOS = {  # of the lowest two: which number follows, and of which other one
    "mass_ratio": ("balls.0.mass", "balls.1.mass", "mass ratio m₁/m₂, lower over upper"),
    "stiffness_ratio": (
        "contacts.0.stiffness",
        "contacts.1.stiffness",
        "stiffness ratio k₁/k₂, floor over ball-ball",
    ),
}
_OUTCOMES = {
    "rebound_ratio": ("rebound speed of {ball} over v₀", ""),
    "rebound_height": ("rebound height of {ball}", "m"),
    "collisions": ("collisions of {contact}", ""),
}
_ENERGY = ("kinetic energy retained", "")


@dataclass(frozen=True)
class Line:
    """The values of one number along a side of a map, in SI units."""

    path: str
    low: float
    high: float
    count: int
    log: bool

    def values(self) -> NDArray[np.float64]:
        """Return the values, evenly spread, or in even ratios."""
        for name, value in (("low", self.low), ("high", self.high)):
            if self.log and value <= 0.0:
                raise InvalidValue(f"{name} must be above 0 for even ratios, got {value:g}")
        if self.low == self.high:
            raise InvalidValue(f"high must differ from low, got {self.high:g} twice")
        spread = np.geomspace if self.log else np.linspace
        with np.errstate(all="ignore"):
            values = np.asarray(spread(self.low, self.high, self.count))
        if not np.isfinite(values).all():
            raise InvalidValue(
                f"low and high must be nearer to each other, got {self.low:g} and {self.high:g}"
            )
        return values


def drop_map(drop: Drop, x: Line, y: Line, show: str, events: int) -> str:
    """Return, as JSON, a number of the outcome over two numbers of a drop.

    Parameters
    ----------
    drop : Drop
        All numbers that do not vary.
    x, y : Line
        What varies: paths as in `sweep`, ``mass_ratio`` or ``stiffness_ratio``.
    show : str
        ``rebound_ratio.1``, ``rebound_height.1``, ``collisions.0`` or ``energy_retained``.
    events : int
        The limit of events for each drop.

    Returns
    -------
    str
        JSON with ``values[y][x]``, null where a drop could not be finished.

    Raises
    ------
    InvalidValue
        If there is no such number, or a value makes no drop.
    """
    if not prepared(wait=True):
        raise InvalidValue(
            "the fast engine is being prepared, which takes a minute or two at the first start: "
            "try again soon"
        )
    if x.path == y.path:
        raise InvalidValue(f"x and y must be two numbers, got {x.path} twice")
    for line in (x, y):
        if line.path not in {path for path, *_ in _paths(drop)}:
            known = [path for path, *_ in _paths(drop)]
            raise InvalidValue(
                f"{shown(line.path)} is no number of this drop; {nearest(line.path, known)}"
            )
    label, unit = _outcome(drop, show)
    data = sweep(drop, _varied(drop, x, y), rtol=_RTOL, event_limit=events)
    data = data.transpose("y", "x", ...)
    done = data.status.values <= Status.COLLAPSED  # the others are of runs without an end
    values = np.where(done, _shown(data, show, drop), np.nan)
    sides = {name: _side(drop, line) for name, line in (("x", x), ("y", y))}
    return as_json(
        {
            "stackbounce": __version__,
            "drop": drop.to_mapping(),
            **sides,
            "show": show,
            "label": label,
            "unit": unit,
            "values": values,
            "unfinished": int(np.sum(~done)),
        }
    )


def map_paths(drop: Drop) -> str:
    """Return, as JSON, what a map of a drop can have at its sides, and what it can show."""
    paths = [
        {"path": path, "label": label, "unit": unit, "value": value}
        for path, label, unit, value in _paths(drop)
    ]
    shows = ["energy_retained"]
    for name in _OUTCOMES:
        shows += [f"{name}.{i}" for i in range(len(drop.balls))]
    if drop.contacts[0] is None:
        shows.remove("collisions.0")
    named = [{"show": show, "label": _outcome(drop, show)[0]} for show in shows]
    return as_json({"paths": paths, "shows": named})


def _paths(drop: Drop) -> list[tuple[str, str, str, float]]:
    """Return path, label, unit and present value of each number that a map can vary."""
    found = []
    numbers = numbers_of(drop)
    for name, (follows, other, label) in _RATIOS.items():
        if all(path in numbers for path in (follows, other)):
            units = {numbers[path].unit for path in (follows, other)}
            if len(units) == 1:
                ratio = _value(drop, follows) / _value(drop, other)
                found.append((name, label, "", ratio))
    for path, number in numbers.items():
        value = _value(drop, path)
        if value is not None and number.field not in ("diameter", "young_modulus", "poisson_ratio"):
            found.append((path, _label(drop, path), number.unit, value))
    return found


def _value(drop: Drop, path: str) -> Any:
    number = number_at(drop, path)
    part = getattr(drop, number.part)[number.index] if number.part else drop
    return getattr(part, number.field) if number.field else part


def _label(drop: Drop, path: str) -> str:
    """Return a number's name for people, such as ``mass of basketball``."""
    number = number_at(drop, path)
    what = number.field.replace("_", " ")
    match number.part:
        case "balls":
            return f"{what} of {_ball(drop, number.index)}"
        case "contacts":
            return f"{what} of {_contact(drop, number.index)}"
        case "gaps":
            return f"gap above {_ball(drop, number.index)}"
        case "velocities":
            return f"velocity of {_ball(drop, number.index)}"
    return what


def _ball(drop: Drop, index: int) -> str:
    return drop.balls[index].name or f"ball {index}"


def _contact(drop: Drop, index: int) -> str:
    lower = "floor" if index == 0 else _ball(drop, index - 1)
    return f"{lower} and {_ball(drop, index)}"


def _outcome(drop: Drop, show: str) -> tuple[str, str]:
    """Return label and unit of what a map shows."""
    if show == "energy_retained":
        return _ENERGY
    name, _, index = show.partition(".")
    count = len(drop.balls)
    if name not in _OUTCOMES or index not in {str(i) for i in range(count)}:
        known = ["energy_retained", *(f"{name}.{i}" for name in _OUTCOMES for i in range(count))]
        raise InvalidValue(f"{shown(show)} is no outcome; {nearest(show, known)}")
    words, unit = _OUTCOMES[name]
    i = int(index)
    return words.format(ball=_ball(drop, i), contact=_contact(drop, i)), unit


def _varied(drop: Drop, x: Line, y: Line) -> dict[str, "xr.DataArray"]:
    """Return the values of what varies, a ratio's by the number that follows it."""
    import xarray as xr

    arrays = {
        line.path: xr.DataArray(line.values(), dims=name) for name, line in (("x", x), ("y", y))
    }
    for name, (follows, other, _) in _RATIOS.items():
        if name in arrays:
            if follows in arrays:
                raise InvalidValue(f"x and y must be independent, got {name} and {follows}")
            arrays[follows] = arrays.pop(name) * arrays.get(other, _value(drop, other))
    return arrays


def _shown(data: "xr.Dataset", show: str, drop: Drop) -> Any:
    name, _, index = show.partition(".")
    if name == "energy_retained":
        return data.energy_retained.values
    if name == "collisions":
        return data.collisions.values[..., int(index)].astype(float)
    ratio = data.rebound_ratio.values[..., int(index)]
    if name == "rebound_ratio":
        return ratio
    speed = ratio * _speeds(data, drop)
    return speed * np.abs(speed) / (2.0 * STANDARD_GRAVITY)


def _speeds(data: "xr.Dataset", drop: Drop) -> Any:
    """Return the speed that came in, which may vary itself, for each point of a map."""
    import xarray as xr

    def now(path: str, own: Any) -> Any:
        return data.coords.get(path, own)

    if drop.velocities is not None:
        given = [abs(now(f"velocities.{i}", own)) for i, own in enumerate(drop.velocities)]
        speed = functools.reduce(np.maximum, given)
    elif drop.impact_speed is not None:
        speed = now("impact_speed", drop.impact_speed)
    else:
        gravity = xr.DataArray(now("gravity", drop.gravity))
        fall = gravity.where(gravity > 0.0, STANDARD_GRAVITY)
        speed = np.sqrt(2.0 * fall * now("height", drop.height))
    return (xr.ones_like(data.status, dtype=float) * speed).transpose("y", "x").values


def _side(drop: Drop, line: Line) -> dict[str, Any]:
    known = {path: (label, unit) for path, label, unit, _ in _paths(drop)}
    label, unit = known[line.path]
    return {"path": line.path, "label": label, "unit": unit, "values": line.values()}
