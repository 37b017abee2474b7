"""A map: a number of the outcome over two numbers of the drop."""

import functools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.explorer.limits import LIMITS
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.run.paths import number_at, numbers_of
from stackbounce.run.result import Status
from stackbounce.sweeps import sweep
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.explorer.schema import Axis

__all__ = ["ENERGY", "OUTCOMES", "RATIOS", "RTOL", "list_paths", "map_drop"]

RTOL = 1e-8
"""The tolerance of nonlinear contacts, far finer than the colours of a map."""

RATIOS = {
    "mass_ratio": ("balls.0.mass", "balls.1.mass", "mass ratio m₁/m₂, lower over upper"),
    "stiffness_ratio": (
        "contacts.0.stiffness",
        "contacts.1.stiffness",
        "stiffness ratio k₁/k₂, floor over ball-ball",
    ),
}
"""Ratios of the lowest two: the number that is set, the one it refers to, the label."""

OUTCOMES = {
    "rebound_ratio": ("rebound speed of {ball} over v₀", ""),
    "rebound_height": ("rebound height of {ball}", "m"),
    "collisions": ("collisions of {contact}", ""),
}
"""Labels and units of what a map can show, by name."""

ENERGY = ("kinetic energy retained", "")
"""Those of the retained energy."""


def _spread(side: "Axis") -> NDArray[np.float64]:
    """Return the values along a side, with linear or logarithmic spacing."""
    for name, value in (("low", side.low), ("high", side.high)):
        if side.log and value <= 0.0:
            raise InvalidValue(f"{name} must be above 0 on a logarithmic scale, got {value:g}")
    if side.low == side.high:
        raise InvalidValue(f"high must differ from low, got {side.high:g} twice")
    spread = np.geomspace if side.log else np.linspace
    with np.errstate(all="ignore"):
        values = np.asarray(spread(side.low, side.high, side.count))
    if not np.isfinite(values).all():
        raise InvalidValue(
            f"low and high must be nearer to each other, got {side.low:g} and {side.high:g}"
        )
    return values


def map_drop(drop: Drop, x: "Axis", y: "Axis", show: str) -> str:
    """Map a number of the outcome over two numbers of a drop; return it as JSON.

    Parameters
    ----------
    drop : Drop
        The drop, with the values of the numbers that do not vary.
    x, y : Axis
        The two sides of the map: paths as in `sweep`, ``mass_ratio`` or ``stiffness_ratio``.
    show : str
        ``rebound_ratio.1``, ``rebound_height.1``, ``collisions.0`` or ``energy_retained``.

    Returns
    -------
    str
        JSON with ``values[y][x]``, null where a drop could not be finished.

    Raises
    ------
    InvalidValue
        If there is no such number, or a value makes no drop.
    """
    points = x.count * y.count
    if points > LIMITS.map_points:
        raise InvalidValue(
            f"x.count times y.count must be at most {LIMITS.map_points}, got {points}"
        )
    if x.path == y.path:
        raise InvalidValue(f"x and y must be two numbers, got {x.path} twice")
    known = [path for path, *_ in _list_numbers(drop)]
    for line in (x, y):
        if line.path not in known:
            raise InvalidValue(
                f"{shown(line.path)} is not a parameter of this drop; {nearest(line.path, known)}"
            )
    label, unit = _name_outcome(drop, show)
    data = sweep(drop, _vary(drop, x, y), rtol=RTOL, event_limit=LIMITS.events)
    data = data.transpose("y", "x", ...)
    done = data.status.values <= Status.COLLAPSED  # the other runs did not end
    values = np.where(done, _select_outcome(data, show, drop), np.nan)
    sides = {name: _describe_side(drop, line) for name, line in (("x", x), ("y", y))}
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


def list_paths(drop: Drop) -> str:
    """List, as JSON, the numbers of a drop that a map can vary and the outcomes it can show."""
    paths = [
        {"path": path, "label": label, "unit": unit, "value": value}
        for path, label, unit, value in _list_numbers(drop)
    ]
    shows = ["energy_retained"]
    for name in OUTCOMES:
        shows += [f"{name}.{i}" for i in range(len(drop.balls))]
    if drop.contacts[0] is None:
        shows.remove("collisions.0")
    named = [{"show": show, "label": _name_outcome(drop, show)[0]} for show in shows]
    return as_json({"paths": paths, "shows": named})


def _list_numbers(drop: Drop) -> list[tuple[str, str, str, float]]:
    """List path, label, unit and present value of each number that a map can vary."""
    found = []
    numbers = numbers_of(drop)
    for name, (follows, other, label) in RATIOS.items():
        if all(path in numbers for path in (follows, other)):
            units = {numbers[path].unit for path in (follows, other)}
            if len(units) == 1:
                ratio = _read_value(drop, follows) / _read_value(drop, other)
                found.append((name, label, "", ratio))
    for path, number in numbers.items():
        value = _read_value(drop, path)
        if value is not None and number.field not in ("diameter", "young_modulus", "poisson_ratio"):
            found.append((path, _name_number(drop, path), number.unit, value))
    return found


def _read_value(drop: Drop, path: str) -> Any:
    number = number_at(drop, path)
    part = getattr(drop, number.part)[number.index] if number.part else drop
    return getattr(part, number.field) if number.field else part


def _name_number(drop: Drop, path: str) -> str:
    """Return a number's name for people, such as ``mass of basketball``."""
    number = number_at(drop, path)
    what = number.field.replace("_", " ")
    match number.part:
        case "balls":
            return f"{what} of {_name_ball(drop, number.index)}"
        case "contacts":
            return f"{what} of {_name_contact(drop, number.index)}"
        case "gaps":
            return f"gap above {_name_ball(drop, number.index)}"
        case "velocities":
            return f"velocity of {_name_ball(drop, number.index)}"
    return what


def _name_ball(drop: Drop, index: int) -> str:
    return drop.balls[index].name or f"ball {index}"


def _name_contact(drop: Drop, index: int) -> str:
    lower = "floor" if index == 0 else _name_ball(drop, index - 1)
    return f"{lower} and {_name_ball(drop, index)}"


def _name_outcome(drop: Drop, show: str) -> tuple[str, str]:
    """Return label and unit of what a map shows."""
    if show == "energy_retained":
        return ENERGY
    name, _, index = show.partition(".")
    count = len(drop.balls)
    if name not in OUTCOMES or index not in {str(i) for i in range(count)}:
        known = ["energy_retained", *(f"{name}.{i}" for name in OUTCOMES for i in range(count))]
        raise InvalidValue(f"{shown(show)} is no outcome; {nearest(show, known)}")
    words, unit = OUTCOMES[name]
    i = int(index)
    return words.format(ball=_name_ball(drop, i), contact=_name_contact(drop, i)), unit


def _vary(drop: Drop, x: "Axis", y: "Axis") -> dict[str, "xr.DataArray"]:
    """Return the values of the numbers that vary; a ratio sets the first of its two numbers."""
    import xarray as xr

    arrays = {
        line.path: xr.DataArray(_spread(line), dims=name) for name, line in (("x", x), ("y", y))
    }
    for name, (follows, other, _) in RATIOS.items():
        if name in arrays:
            if follows in arrays:
                raise InvalidValue(f"x and y must be independent, got {name} and {follows}")
            arrays[follows] = arrays.pop(name) * arrays.get(other, _read_value(drop, other))
    return arrays


def _select_outcome(data: "xr.Dataset", show: str, drop: Drop) -> Any:
    name, _, index = show.partition(".")
    if name == "energy_retained":
        return data.energy_retained.values
    if name == "collisions":
        return data.collisions.values[..., int(index)].astype(float)
    ratio = data.rebound_ratio.values[..., int(index)]
    if name == "rebound_ratio":
        return ratio
    speed = ratio * _find_reference_speeds(data, drop)
    return speed * np.abs(speed) / (2.0 * STANDARD_GRAVITY)


def _find_reference_speeds(data: "xr.Dataset", drop: Drop) -> Any:
    """Return the reference speed at each point of a map, which may vary the speed or the height."""
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


def _describe_side(drop: Drop, line: "Axis") -> dict[str, Any]:
    known = {path: (label, unit) for path, label, unit, _ in _list_numbers(drop)}
    label, unit = known[line.path]
    return {"path": line.path, "label": label, "unit": unit, "values": _spread(line)}
