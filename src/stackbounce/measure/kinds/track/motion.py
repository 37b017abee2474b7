"""The motion in a flight: its shape, its numbers with errors, height and speed, in air too.

The shape tells whether flights are parabolas of one acceleration.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.track.parabolas import Flight, Parabolas
from stackbounce.measure.quantities import Array, nominal
from stackbounce.measure.statistics.ar_noise import correlation_factor
from stackbounce.measure.statistics.regression import widening
from stackbounce.model.drag import flown

OWN = 5  # points of a flight that tell its own acceleration
_BENT = 8  # points of a flight that tell how its acceleration changes
_CLEARLY_BENT = 0.05  # of the acceleration within a flight: a smaller change is not clear
_DIFFERENT_BELOW = 5e-4  # p-value of accelerations that differ
_MOST_ROUNDS = 30  # of taking the drag away; each leaves a tenth of the change or less
_SETTLED = 1e-10  # relative change of all numbers of the flights in the last of these rounds
_STRANGE = 7.0  # times the median residual, 4.7 standard deviations: a point of another flight
_LEAST_POINTS = 5  # of a flight whose ends are cut off where they are strange

Numbers: TypeAlias = tuple[Any, Any, Any]
"""Acceleration, level and speed of a flight at its middle: numbers with errors."""


class Shape(NamedTuple):
    """How far flights are from parabolas of one acceleration.

    Attributes
    ----------
    scatter : float
        Of the flights' own accelerations beyond their errors, over their mean.
    widening : float
        How many times as large as their errors the accelerations' differences are; 1 where they may
        be chance.
    change, change_error : float
        Of the acceleration from the middle of a flight to its ends, over that in the middle: 0 for
        a parabola, -1 for half a sine. The error is infinite where the flights do not tell.
    """

    scatter: float
    widening: float
    change: float
    change_error: float

    @property
    def bent(self) -> float:
        """The size of that change where it is clear, else 0."""
        size = abs(self.change)
        return size if size > max(_CLEARLY_BENT, 4.0 * self.change_error) else 0.0


def shape_of(times: Array, heights: Array, flights: Sequence[Flight]) -> Shape:
    """Return how far flights are from parabolas of one acceleration.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 100)
    >>> noise = np.random.default_rng(1).normal(0.0, 1e-3, 100)
    >>> round(shape_of(times, np.sin(np.pi * times) + noise, [Flight(0, 100)]).change, 1)
    -1.1
    >>> abs(shape_of(times, 4 * times * (1 - times) + noise, [Flight(0, 100)]).change) < 0.1
    True
    """
    return Shape(*_scatter(times, heights, flights), *_change(times, heights, flights))


def own_noise(times: Array, heights: Array, flights: Sequence[Flight]) -> float:
    """Return the scatter around parabolas of each flight's own acceleration; infinite if unknown.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 1000)
    >>> noise = np.random.default_rng(1).normal(0.0, 1e-3, 1000)
    >>> round(own_noise(times, 3.0 * times**2 + noise, [Flight(0, 1000)]), 4)
    0.001
    """
    own = [flight for flight in flights if flight.last - flight.first >= OWN]
    rests = [_polynomial(times, heights, flight, 2)[-1] for flight in own]
    freedom = sum(len(rest) - 3 for rest in rests)
    return math.sqrt(sum(float(rest @ rest) for rest in rests) / freedom) if own else math.inf


def _scatter(times: Array, heights: Array, flights: Sequence[Flight]) -> tuple[float, float]:
    from scipy.special import fdtrc

    rows = _polynomials(times, heights, flights, 2, OWN)
    if len(rows) < 2:
        return 0.0, 1.0
    halves = np.array([half for *_, half in rows])
    falls = np.array([-2.0 * terms[2] for terms, *_ in rows]) / halves**2
    errors = np.array([2.0 * error[2] for _, error, _ in rows]) / halves**2
    weights = 1.0 / errors**2
    mean = float(np.average(falls, weights=weights))
    square = float((weights * (falls - mean) ** 2).sum())
    freedom = len(rows) - 1
    points = sum(last - first - 3 for first, last in flights if last - first >= OWN)
    if mean == 0.0 or fdtrc(freedom, max(points, 1), square / freedom) > _DIFFERENT_BELOW:
        return 0.0, 1.0
    # R. DerSimonian and N. Laird, Controlled Clinical Trials 7, 177 (1986), eq 9
    variance = (square - freedom) / float(weights.sum() - (weights**2).sum() / weights.sum())
    mean = float(np.average(falls, weights=1.0 / (errors**2 + variance)))
    scatter = math.sqrt(variance)
    return scatter / max(abs(mean), 1e-300), math.sqrt(square / freedom)


def _change(times: Array, heights: Array, flights: Sequence[Flight]) -> tuple[float, float]:
    rows = _polynomials(times, heights, flights, 4, _BENT)
    bends = np.array([terms[2] for terms, *_ in rows])
    quartic = np.array([terms[4] for terms, *_ in rows])
    weights = 1.0 / np.array([error[4] for _, error, _ in rows]) ** 2
    strength = float((weights * bends**2).sum())
    if strength <= 0.0:
        return 0.0, math.inf
    return 6.0 * float((weights * bends * quartic).sum()) / strength, 6.0 / math.sqrt(strength)


def _polynomials(
    times: Array, heights: Array, flights: Sequence[Flight], degree: int, least: int
) -> list[tuple[Array, Array, float]]:
    """Return terms, errors and half the duration of each flight with enough points.

    The time runs from -1 to 1 in each flight.
    """
    own = [flight for flight in flights if flight.last - flight.first >= least]
    found = [_polynomial(times, heights, flight, degree) for flight in own]
    if not found:
        return []
    rest = np.concatenate([one for *_, one in found])
    freedom = len(rest) - len(own) * (degree + 1)
    sigma = math.sqrt(float(rest @ rest) / max(freedom, 1) * correlation_factor(rest))
    sigma = max(sigma, 1e-9 * float(np.ptp(heights)))
    return [(terms, sigma * error, half) for terms, error, half, _ in found]


def _polynomial(
    times: Array, heights: Array, flight: Flight, degree: int
) -> tuple[Array, Array, float, Array]:
    """Return terms, their errors over that of a point, half the duration, and residuals."""
    part = slice(*flight)
    half = 0.5 * float(times[part][-1] - times[part][0])
    z = (times[part] - times[part][0]) / half - 1.0
    level = heights[part] - heights[part].mean()
    terms, covariance = np.polyfit(z, level, degree, cov="unscaled")
    return terms[::-1], np.sqrt(np.diag(covariance))[::-1], half, level - np.polyval(terms, z)


def accelerations(times: Array, heights: Array, wide: int, least: float = -1.0) -> Array:
    """Return the accelerations of parabolas through windows of points, where it moves by more."""
    if len(heights) < wide:
        return np.zeros(0)
    windows = np.lib.stride_tricks.sliding_window_view
    times, heights = windows(times, wide), windows(heights, wide)
    moves = np.ptp(heights, axis=1) > least
    times, heights = times[moves], heights[moves]
    since = times - times.mean(axis=1, keepdims=True)
    # Least squares of 1, t, t² in each window, by making t² orthogonal to the others.
    square = since**2
    slope = (square * since).sum(axis=1) / np.maximum((since**2).sum(axis=1), 1e-300)
    square = square - square.mean(axis=1, keepdims=True) - slope[:, None] * since
    curve = (square * heights).sum(axis=1) / np.maximum((square**2).sum(axis=1), 1e-300)
    return np.asarray(2.0 * curve)


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
    >>> from stackbounce.measure.kinds.track.parabolas import Flight
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
    fall, level, speed = fit.values[[0, 1 + 2 * flight, 2 + 2 * flight]].tolist()
    rate = nominal(drag.rate) if drag else 0.0
    since = (times - fit.origins[flight]).tolist()
    return np.asarray([level + flown(rate, speed, time, fall)[0] for time in since])


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


def fallen(speed: Any, fall: Any, drag: Drag | None) -> tuple[Any, Any]:
    """Return height and time of the fall from rest to a speed."""
    if drag is None:
        return speed**2 / (2.0 * fall), speed / fall
    height = drag.fall_height(speed, fall)
    if height is None:
        raise OverflowError("faster than the terminal speed")
    return height, drag.fall_time(height, fall)


def risen(speed: Any, fall: Any, drag: Drag | None) -> Any:
    """Return the height to which a ball rises at a speed, below 0 for one that moves down."""
    if drag is None:
        return math.copysign(0.5, speed.nominal_value) * speed**2 / fall
    return drag.risen(speed, fall) if speed.nominal_value > 0.0 else -drag.risen(-speed, fall)
