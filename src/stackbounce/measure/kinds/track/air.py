"""A track in air: its flights as parabolas, and back."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.track.flight_numbers import Numbers
from stackbounce.measure.kinds.track.flights import Flight
from stackbounce.measure.kinds.track.parabolas import Flights, fit_flights
from stackbounce.measure.quantities import Array, Number, nominal
from stackbounce.model.drag import flown

__all__ = ["curve", "fall_at", "meeting", "state", "straightened"]

_ROUNDS = 30  # at most; each leaves a tenth of the change or less
_STRANGE = 7.0  # times the median residual: 4.7 standard deviations
_LEAST = 5  # points of a flight that tell what is strange
_NEWTON = 3  # rounds from the middle between two flights to where they meet
_SAME = 1e-10  # relative change of all numbers of the flights


def straightened(times: Array, heights: Array, fit: Flights, drag: Drag) -> tuple[Array, Flights]:
    """Return heights without what the drag does to them, and the parabolas through these.

    A flight in air and its parabola have height, velocity and gravity in common at the middle of
    the flight. What is between them is computed from these numbers, which a fit to what is left
    improves.

    Examples
    --------
    >>> from stackbounce.measure.kinds.track.flights import Flight
    >>> from stackbounce.model.drag import flown
    >>> times = np.linspace(-0.3, 0.3, 30)
    >>> heights = np.array([flown(0.1, 1.0, time, 9.81)[0] for time in times])
    >>> fit = fit_flights(times, heights, [Flight(0, 30)])
    >>> air = Drag(np.pi / 8, 1.0, 0.1, 1.0)  # k = 0.1 / m
    >>> [round(float(one.values[2]), 6) for one in (fit, straightened(times, heights, fit, air)[1])]
    [1.033092, 1.0]
    """
    flat = heights
    for _ in range(_ROUNDS):
        before = fit.values
        flat = heights.copy()
        for j, (first, last) in enumerate(fit.flights):
            at = times[first:last]
            flat[first:last] -= curve(fit, j, at, drag) - curve(fit, j, at, None)
        fit = fit_flights(times, flat, fit.flights)
        if np.abs(fit.values - before).max() > _SAME * np.abs(before).max():
            continue
        flights = [_without_strange_ends(one, fit.residuals) for one in fit.flights]
        if flights == fit.flights:
            break
        fit = fit_flights(times, flat, flights)
    return flat, fit


def _without_strange_ends(flight: Flight, residuals: Array) -> Flight:
    """Return a flight without end points of other flights, which a parabola took for its own."""
    first, last = flight
    off = np.abs(residuals[first:last])
    fits = np.flatnonzero(off < _STRANGE * np.median(off))
    if len(fits) < _LEAST:
        return flight
    return Flight(first + int(fits[0]), first + int(fits[-1]) + 1)


def curve(fit: Flights, flight: int, times: Array, drag: Drag | None) -> Array:
    """Return the heights of a flight at some times, in air or on its parabola."""
    level, speed = fit.values[1 + 2 * flight : 3 + 2 * flight]
    fall, since = fit.values[0], times - fit.origins[flight]
    if drag is None:
        return np.asarray(level + speed * since - 0.5 * fall * since**2)
    rate = nominal(drag.rate)
    ways = [flown(rate, float(speed), one, float(fall))[0] for one in since.tolist()]
    return np.asarray(level + np.array(ways))


def state(numbers: Numbers, since: float, drag: Drag | None) -> tuple[Any, Any]:
    """Return height and velocity of a flight, a time after its middle.

    Examples
    --------
    >>> state((10.0, 1.0, 2.0), 0.1, None)
    (1.15, 1.0)
    """
    fall, level, speed = numbers
    if drag is None:
        return level + speed * since - 0.5 * fall * since**2, speed - fall * since
    from uncertainties import wrap

    rate = nominal(drag.rate)
    way = wrap(lambda speed, fall: flown(rate, speed, since, fall)[0])
    then = wrap(lambda speed, fall: flown(rate, speed, since, fall)[1])
    return level + way(speed, fall), then(speed, fall)


def meeting(flights: Sequence[Numbers], middles: Array, near: float, drag: Drag | None) -> float:
    """Return how much later than some time two flights in air meet, in s.

    Parabolas meet where straight lines do whose speeds differ as much: for them it is 0.

    Examples
    --------
    >>> meeting([(10.0, 0.0, -1.0), (10.0, 0.5, 1.0)], np.array([0.0, 0.2]), 0.1, None)
    0.0
    """
    later = 0.0
    for _ in range(0 if drag is None else _NEWTON):
        (low, before), (high, after) = (
            state(one, float(near - middle) + later, drag)
            for one, middle in zip(flights, middles, strict=True)
        )
        later += nominal((low - high) / (after - before))
    return later


def fall_at(fall: Number, speed: Any, drag: Drag | None) -> Any:
    """Return the acceleration, downward, at an up-positive speed.

    Examples
    --------
    >>> fall_at(10.0, -3.0, None)
    10.0
    """
    return fall if drag is None else fall + nominal(drag.rate) * speed * abs(nominal(speed))
