"""The motion in a flight: its numbers with errors, and height and speed at a time, in air too."""

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.track.flights import Flight
from stackbounce.measure.kinds.track.parabolas import Parabolas
from stackbounce.measure.kinds.track.shape import OWN, Shape, own_noise
from stackbounce.measure.quantities import Array, nominal
from stackbounce.measure.statistics.regression import widening
from stackbounce.model.drag import flown

_MOST_ROUNDS = 30  # of taking the drag away; each leaves a tenth of the change or less
_SETTLED = 1e-10  # relative change of all numbers of the flights in the last of these rounds
_STRANGE = 7.0  # times the median residual, 4.7 standard deviations: a point of another flight
_LEAST_POINTS = 5  # of a flight whose ends are cut off where they are strange
_NEWTON_ROUNDS = 3  # from the middle between two flights to where they meet

Numbers: TypeAlias = tuple[Any, Any, Any]
"""Acceleration, level and speed of a flight at its middle: numbers with errors."""


def flight_numbers(fit: Parabolas, shape: Shape) -> Sequence[Numbers]:
    """Return the numbers of each flight.

    All flights have one acceleration, unless their own differ by more than chance makes them, as
    where a lens, or the distance to the camera, changes the scale from one place to another. Speeds
    at the floor are then right only with the curvature that each flight has: its acceleration is
    its own, drawn to the mean by as much as the accelerations are seen to scatter.
    """
    from uncertainties import correlated_values

    wider = widening(max(fit.freedom, 1)) ** 2
    if shape.widening <= 1.0:
        numbers = correlated_values(fit.values, wider * fit.covariance)
        return [(numbers[0], *numbers[1 + 2 * k : 3 + 2 * k]) for k in range(len(fit.flights))]
    noise = own_noise(fit.times, fit.heights, fit.flights)
    mean, scatter = float(fit.values[0]), shape.scatter * float(fit.values[0])
    found: list[Numbers] = []
    for k, flight in enumerate(fit.flights):
        if flight.last - flight.first < OWN:
            some = [0, 1 + 2 * k, 2 + 2 * k]
            values = fit.values[some]
            covariance = shape.widening**2 * fit.covariance[np.ix_(some, some)]
        else:
            alone = Parabolas(fit.times, fit.heights, [flight])
            values = alone.values
            covariance = (noise / max(alone.sigma, 1e-300)) ** 2 * alone.covariance
            share = covariance[0] / (covariance[0, 0] + scatter**2)
            values = values + share * (mean - values[0])
            covariance = covariance - np.outer(share, covariance[0])
        found.append(tuple(correlated_values(values, wider * covariance)))
    return found


def straightened(fit: Parabolas, drag: Drag) -> Parabolas:
    """Return the parabolas through heights without what the drag does to them.

    A flight in air and its parabola have height, velocity and gravity in common at the middle of
    the flight. What is between them is computed from these numbers, which a fit to what is left
    improves.

    Examples
    --------
    >>> from stackbounce.measure.kinds.track.flights import Flight
    >>> from stackbounce.model.drag import flown
    >>> times = np.linspace(-0.3, 0.3, 30)
    >>> heights = np.array([flown(0.1, 1.0, time, 9.81)[0] for time in times])
    >>> fit = Parabolas(times, heights, [Flight(0, 30)])
    >>> air = Drag(np.pi / 8, 1.0, 0.1, 1.0)  # k = 0.1 / m
    >>> [round(float(part.values[2]), 6) for part in (fit, straightened(fit, air))]
    [1.033092, 1.0]
    """
    times, heights = fit.times, fit.heights
    for _ in range(_MOST_ROUNDS):
        before = fit.values
        flat = heights.copy()
        for j, (first, last) in enumerate(fit.flights):
            at = times[first:last]
            flat[first:last] -= curve(fit, j, at, drag) - curve(fit, j, at, None)
        fit = Parabolas(times, flat, fit.flights)
        if np.abs(fit.values - before).max() > _SETTLED * np.abs(before).max():
            continue
        flights = [_without_strange_ends(flight, fit.residuals) for flight in fit.flights]
        if flights == fit.flights:
            break
        fit = Parabolas(times, flat, flights)
    return fit


def _without_strange_ends(flight: Flight, residuals: Array) -> Flight:
    """Return a flight without end points of other flights, which a parabola took for its own."""
    first, last = flight
    off = np.abs(residuals[first:last])
    fits = np.flatnonzero(off < _STRANGE * np.median(off))
    if len(fits) < _LEAST_POINTS:
        return flight
    return Flight(first + int(fits[0]), first + int(fits[-1]) + 1)


def curve(fit: Parabolas, flight: int, times: Array, drag: Drag | None) -> Array:
    """Return the heights of a flight at some times, in air or on its parabola."""
    level, speed = fit.values[1 + 2 * flight : 3 + 2 * flight]
    fall, since = fit.values[0], times - fit.origins[flight]
    if drag is None:
        return np.asarray(level + speed * since - 0.5 * fall * since**2)
    rate = nominal(drag.rate)
    ways = [flown(rate, float(speed), time, float(fall))[0] for time in since.tolist()]
    return np.asarray(level + np.array(ways))


def state(numbers: Numbers, since: float, drag: Drag | None) -> tuple[Any, Any, Any]:
    """Return height, velocity and downward acceleration of a flight, a time after its middle.

    Examples
    --------
    >>> state((10.0, 1.0, 2.0), 0.1, None)
    (1.15, 1.0, 10.0)
    """
    fall, level, speed = numbers
    if drag is None:
        return level + speed * since - 0.5 * fall * since**2, speed - fall * since, fall
    from uncertainties import wrap

    rate = nominal(drag.rate)
    way = wrap(lambda speed, fall: flown(rate, speed, since, fall)[0])
    then = wrap(lambda speed, fall: flown(rate, speed, since, fall)[1])
    later = then(speed, fall)
    return level + way(speed, fall), later, fall + rate * later * abs(nominal(later))


def meeting(flights: Sequence[Numbers], middles: Array, near: float, drag: Drag | None) -> float:
    """Return how much later than some time two flights in air meet, in s.

    Parabolas meet where straight lines do whose speeds differ as much: for them it is 0.

    Examples
    --------
    >>> meeting([(10.0, 0.0, -1.0), (10.0, 0.5, 1.0)], np.array([0.0, 0.2]), 0.1, None)
    0.0
    """
    later = 0.0
    for _ in range(0 if drag is None else _NEWTON_ROUNDS):
        (low, before, _), (high, after, _) = (
            state(flight, float(near - middle) + later, drag)
            for flight, middle in zip(flights, middles, strict=True)
        )
        later += nominal((low - high) / (after - before))
    return later


def fallen(speed: Any, fall: Any, drag: Drag | None) -> tuple[Any, Any]:
    """Return height and time of the fall from rest to a speed; no time without drag."""
    if drag is None:
        return speed**2 / (2.0 * fall), None
    height = drag.fall_height(speed, fall)
    if height is None:
        raise OverflowError("faster than the terminal speed")
    return height, drag.fall_time(height, fall)


def risen(speed: Any, fall: Any, drag: Drag | None) -> Any:
    """Return the height to which a ball rises at a speed, below 0 for one that moves down."""
    if drag is None:
        return math.copysign(0.5, speed.nominal_value) * speed**2 / fall
    return drag.risen(speed, fall) if speed.nominal_value > 0.0 else -drag.risen(-speed, fall)
