"""Drops of two balls, and quantities that are computed from their results.

The lower ball comes first, as in the library: masses (m1, m2), contacts (floor, ball-ball).
"""

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from stackbounce.model.ball import Ball
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import ContactLaw, Rigid, Spring
from stackbounce.run.result import Result

Two = tuple[float, float]
Array = NDArray[np.float64]


def pair(masses: Two, contacts: Sequence[ContactLaw], *, speed: float, gap: float = 0.0) -> Drop:
    """Return the drop of two balls that fall with the same speed."""
    return Drop([Ball(mass) for mass in masses], contacts, gaps=[gap], impact_speed=speed)


def rigid_pair(
    masses: Two, restitution: float, *, between: float | None = None, speed: float = 1.0
) -> Drop:
    """Return a drop with separate collisions (eqs 1 to 4), one restitution for both or two."""
    contacts = [Rigid(restitution), Rigid(restitution if between is None else between)]
    return pair(masses, contacts, speed=speed)


def spring_pair(masses: Two, stiffnesses: Two, *, speed: float = 1.0, gap: float = 0.0) -> Drop:
    """Return a drop with a simultaneous collision without loss (eqs 5 and 6)."""
    return pair(masses, [Spring(stiffness) for stiffness in stiffnesses], speed=speed, gap=gap)


def after_meeting(result: Result, count: int) -> Two:
    """Return both velocities in m/s right after the balls' `count`-th rigid collision.

    They are nan where the balls do not collide that often.
    """
    met = result.events[result.events["contact"] == 1]
    if len(met) < count:
        return float("nan"), float("nan")
    return float(met[count - 1]["lower_velocity"]), float(met[count - 1]["upper_velocity"])


def force_above(result: Result, contact: int, share: float, end: float | None = None) -> Two:
    """Return when a contact's force first and last passes `share` of its peak, in s, up to `end`.

    By default that is the end of the run, which can be long after a first impact.
    """
    times = np.linspace(0.0, result.end_time if end is None else end, 401)
    force = np.asarray(result.sample(times)["force"].isel(contact=contact))
    level = share * force.max()
    above = np.flatnonzero(force > level)
    first, last = above[0], above[-1]
    rise = np.interp(level, force[first - 1 : first + 1], times[first - 1 : first + 1])
    fall = np.interp(-level, -force[last : last + 2], times[last : last + 2])
    return float(rise), float(fall)


def peak_times(result: Result, contact: int, end: float) -> Array:
    """Return when a contact's force has its maxima, in s, up to `end`."""
    times = np.linspace(0.0, end, 2001)
    force = np.asarray(result.sample(times)["force"].isel(contact=contact))
    return np.asarray(times[1:-1][(force[1:-1] > force[:-2]) & (force[1:-1] >= force[2:])])


def truncate(value: float, digits: int) -> float:
    """Return a number truncated, not rounded, after `digits` decimals.

    Examples
    --------
    >>> truncate(0.528, 2), truncate(-1.19, 1)
    (0.52, -1.1)
    """
    return math.trunc(value * 10.0**digits) / 10.0**digits


def fallen_speed(height: float) -> float:
    """Return the speed in m/s after a fall from rest, as `Drop` computes it."""
    return Drop([Ball(1.0)], [Rigid(1.0)], height=height).reference_speed


def risen_height(speed: float) -> float:
    """Return how high in m a ball rises that leaves at `speed` in m/s."""
    return speed**2 / (2.0 * STANDARD_GRAVITY)


def bisect(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes sign between `low` and `high`, by bisection.

    For a discontinuous function this is a jump. The result is exact to the last digit of a float.

    Examples
    --------
    >>> round(bisect(lambda x: x * x - 2.0, 0.0, 2.0), 12)
    1.414213562373
    """
    rising = function(high) > 0.0
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return middle
        if (function(middle) > 0.0) == rising:
            high = middle
        else:
            low = middle
