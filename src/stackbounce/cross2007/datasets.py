"""The paper's measurements as data sets for a fit: ``stackbounce fit cross2007/B1-B2``.

A pair is named as in Table II, the bottom ball first. The error of a time from a force record is
half a unit in the last digit, but at least 0.1 ms, the error that the paper states for impact
durations. The force records and the films are of different drops, so that times and ratios belong
together only as far as the drops were equal.
"""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from stackbounce.cross2007.bench import PAPER, Bench
from stackbounce.cross2007.drops import Two, fallen_speed
from stackbounce.errors import one_of
from stackbounce.model import Ball, Drop, Hysteretic, Spring
from stackbounce.run.calibration import calibrate

PREFIX = "cross2007/"
"""What a data set's name begins with on the command line."""

_SMALLER = (0.90, 0.02)  # Table I's restitution of B2 and of B3, which no row of the audit needs
_LEAST = 1e-4  # s: the error of an impact duration
_STIFF = (1e3, 1e6)  # N/m
_WIDEST = 0.03  # m
_TIMES = {  # what the text states of a pair
    "B2_on_B1": {"first_touch.1": "superballs.delay", "durations.0": "B2_on_B1.duration"},
    "B1_on_B2": {"first_touch.1": "superballs.delay", "durations.0": "B1_on_B2.duration"},
    "B3_on_B1": {"first_touch.1": "superballs.delay"},
    "B1_on_B3": {"first_touch.1": "superballs.late_delay"},
    "B1_on_B1": {"durations.0": "superballs.twin_duration"},
}


_value = Bench(PAPER)  # the printed value of a key


class DataSet(NamedTuple):
    """A measurement of the paper, with its drop and the numbers that a fit varies by default.

    Parameters
    ----------
    drop : Drop
        The drop.
    data : dict
        The measured values, as `stackbounce.fit` takes them.
    vary : dict
        The numbers that are varied, with their bounds.
    what : str
        The place in the paper.
    """

    drop: Drop
    data: dict[str, Any]
    vary: dict[str, Any]
    what: str


def load_dataset(name: str) -> DataSet:
    """Return a measurement of the paper.

    Parameters
    ----------
    name : str
        One of `NAMES`, with or without ``cross2007/``.

    Returns
    -------
    DataSet
        The contacts are those of section V: a linear hysteretic one at the floor, with the
        restitution of the lower ball alone, and a spring between the balls.

    Raises
    ------
    InvalidValue
        If there is none of that name.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop, data, vary, what = load_dataset("B1-B2")
    >>> data["rebound_ratios"]
    [(0.28, 0.02), (1.91, 0.02)]
    >>> sb.fit(drop, data, vary).names
    ['contacts.0.stiffness', 'contacts.1.stiffness', 'gaps.0']
    """
    short = name.removeprefix(PREFIX)
    one_of(PREFIX + short, NAMES, f"{name[:60]} is no data set")
    return _MADE[short]()


def _pair(lower: str, upper: str) -> DataSet:
    """Return a pair of superballs with section V's contacts, and its row of Table II.

    B1 has 105 g, from Table II's mass ratios of 4.23 and 12.3. In the pair of two balls B1 the
    upper one has Table I's 101 g.
    """
    key = f"{upper}_on_{lower}"
    twins = lower == upper
    balls = [_ball(lower, heavier=lower == "B1"), _ball(upper, heavier=upper == "B1" and not twins)]
    floor, top = (_value(f"{ball}.dynamic_stiffness") for ball in (lower, upper))
    kept, _ = _restitution(lower)
    contacts = Hysteretic(floor, restitution=kept), Spring(floor * top / (floor + top))
    drop = Drop(balls, contacts, height=_value("superballs.drop_height"))
    data: dict[str, Any] = {
        "rebound_ratios": [_known(f"{key}.lower"), _known(f"{key}.upper")],
        **{name: _known(time) for name, time in _TIMES[key].items()},
    }
    if key == "B1_on_B2":
        data["collisions.1"] = 3
    return DataSet(drop, data, _vary(_STIFF, _STIFF), f"Table II and Sec. IV: {upper} on {lower}")


def _basketball() -> DataSet:
    balls = [Ball(_value(f"{name}.mass"), _value(f"{name}.diameter")) for name in _STACK]
    springs = [Spring(_value(f"fig9.{contact}_stiffness")) for contact in ("floor", "ball")]
    drop = Drop(balls, springs, height=_value("stack.drop_height"))
    data = {
        "rebound_heights": [_known("stack.lower_height"), _known("stack.upper_height")],
        "durations.0": _known("stack.duration"),
        "first_touch.1": _known("stack.delay"),
    }
    what = "Sec. III: tennis ball on basketball, no loss in the contacts"
    return DataSet(drop, data, _vary((3e2, 3e4), (1e2, 1e4)), what)


def _vary(floor: Two, between: Two) -> dict[str, Any]:
    """Return what is varied of a pair: both stiffnesses in N/m, and the gap."""
    stiffnesses = {"contacts.0.stiffness": floor, "contacts.1.stiffness": between}
    return stiffnesses | {"gaps.0": (0.0, _WIDEST)}


def _alone(name: str) -> DataSet:
    mass, height = _value(f"{name}.mass"), _value("superballs.drop_height")
    time, kept = _value(f"{name}.contact_time"), _restitution(name)
    known = {"mass": mass, "contact_time": time, "restitution": kept[0]}
    law = calibrate(Hysteretic, **known, impact_speed=fallen_speed(height))
    drop = Drop([_ball(name)], [law], height=height)
    data = {"durations.0": _known(f"{name}.contact_time"), "rebound_ratios": [kept]}
    vary = {"contacts.0.stiffness": _STIFF, "contacts.0.restitution": (0.3, 1.0)}
    return DataSet(drop, data, vary, f"Table I: {name} alone")


def _ball(name: str, *, heavier: bool = False) -> Ball:
    mass = _value(f"{name}.mass") * (_value("B1_on_B1.mass_ratio") if heavier else 1.0)
    return Ball(mass, _value(f"{name}.diameter"), name=name)


def _restitution(name: str) -> tuple[float, float]:
    return _known("B1.restitution") if name == "B1" else _SMALLER


def _known(key: str) -> tuple[float, float]:
    """Return a number of the paper with its error."""
    number = PAPER[key]
    error = max(number.spread, _LEAST) if number.unit == "s" else number.spread
    return number.value, error


_STACK = ("basketball", "tennis")
_PAIRS = (("B1", "B2"), ("B2", "B1"), ("B1", "B3"), ("B3", "B1"), ("B1", "B1"))
_MADE: dict[str, Callable[[], DataSet]] = {
    **{f"{lower}-{upper}": partial(_pair, lower, upper) for lower, upper in _PAIRS},
    "basketball-tennis": _basketball,
    **{name: partial(_alone, name) for name in ("B1", "B2", "B3")},
}
NAMES = tuple(PREFIX + name for name in _MADE)
"""All data sets: pairs with the bottom ball first, and balls alone."""
