"""Heights against time -> free flights: parabolas of one common acceleration."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array
from stackbounce.measure.statistics.ar_noise import fit_with_ar_noise

__all__ = ["Flight", "Flights", "find_flights", "fit_flights", "unexplained"]

_PRICE = 14.0  # penalty of a piece, in variances
_SPEED = 9.0  # penalty of a flight's speed, a parameter that a rest does not have
_STRAY = 9.0  # penalty of a point that belongs to no piece
_STRAY_POINT, _FLIGHT, _REST = range(3)  # kinds of pieces
_LEAST = 3  # points of a flight
_LONGEST = 3000  # points of a piece


class Flight(NamedTuple):
    """Indices of the first point and of the one after the last; of points in free flight."""

    first: int
    last: int


class Flights(NamedTuple):
    """Flights fitted together: ``u = level + speed (t - origin) - acceleration (t - origin)²/2``.

    Attributes
    ----------
    flights : list of Flight
        N of them.
    values : ndarray
        (1 + 2 N,) acceleration, then level and speed of each.
    covariance : ndarray
        (1 + 2 N, 1 + 2 N).
    origins : ndarray
        (N,) in s, the middle of each.
    sigma : float
        Standard deviation of one point's error.
    correlation : float
        Of the errors of neighbouring points.
    residuals : ndarray
        Of each point, NaN where it is in no flight.
    freedom : int
        Points less parameters.
    """

    flights: list[Flight]
    values: Array
    covariance: Array
    origins: Array
    sigma: float
    correlation: float
    residuals: Array
    freedom: int


def find_flights(times: Array, heights: Array, sigma: float, acceleration: float) -> list[Flight]:
    """Return the free flights in a track.

    The track is cut into flights, rests and stray points at the change points that make the sum of
    squared residuals and of penalties, one for each piece, smallest (R. Bellman's dynamic
    programming).

    Parameters
    ----------
    times, heights : ndarray
        (N,) in s and m, up-positive.
    sigma : float
        Error of a height, in m.
    acceleration : float
        Of free flight, above 0 downward, in m/s².

    Returns
    -------
    list of Flight

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 20)
    >>> heights = np.where(times < 0.5, 1.25 - 5 * times**2, 0.0) + np.where(
    ...     times >= 0.5, 4 * (times - 0.5) - 5 * (times - 0.5) ** 2, 0.0
    ... )
    >>> find_flights(times, heights, 1e-3, 10.0)
    [Flight(first=0, last=10), Flight(first=10, last=20)]
    """
    _, starts, kinds = _cut(times, heights, sigma, np.array([acceleration]))
    flights, end = [], len(times)
    while end > 0:
        first = int(starts[end])
        if kinds[end] == _FLIGHT:
            flights.append(Flight(first, end))
        end = first
    return flights[::-1]


def unexplained(times: Array, heights: Array, sigma: float, accelerations: Array) -> Array:
    """Return the cost of the best segmentation for each acceleration; see `find_flights`.

    Parameters
    ----------
    times, heights, sigma
        As in `find_flights`.
    accelerations : ndarray
        (K,) in m/s², above 0 downward.

    Returns
    -------
    ndarray
        (K,) sums of squared residuals and penalties, in variances.
    """
    return _cut(times, heights, sigma, np.asarray(accelerations))[0]


def _cut(
    times: Array, heights: Array, sigma: float, accelerations: Array
) -> tuple[Array, NDArray[np.intp], NDArray[np.intp]]:
    """Return the cost of the best segmentation for each acceleration, and that for the first one.

    The segmentation is given as the start and the kind of the last segment before each point.
    """
    count = len(times)
    x = times - times.mean()
    y = (heights - heights.mean()) / sigma
    flown = y + 0.5 * accelerations[:, None] * x**2 / sigma
    flown -= flown.mean(axis=1, keepdims=True)
    # Running sums of x, x², y, y² (one row), and of the residuals of flights, times x, squared.
    single = _running(np.stack([x, x * x, y, y * y]))
    many = _running(np.stack([flown, x * flown, flown * flown]))
    best = np.zeros((len(flown), count + 1))
    starts = np.arange(count + 1) - 1
    kinds = np.full(count + 1, _STRAY_POINT)
    for end in range(1, count + 1):
        best[:, end] = best[:, end - 1] + _STRAY
        if end < _LEAST:
            continue
        first = max(0, end - _LONGEST)
        part = slice(first, end - _LEAST + 1)
        n = np.arange(end - first, _LEAST - 1, -1.0)
        sx, sxx, sy, syy = single[:, end, None] - single[:, part]
        f, xf, ff = many[:, :, end, None] - many[:, :, part]
        mean = sx / n
        flight = ff - f * f / n - (xf - mean * f) ** 2 / np.maximum(sxx - mean * sx, 1e-300)
        flight = np.maximum(flight, 0.0) + _SPEED
        rest = np.maximum(syy - sy * sy / n, 0.0)
        costs = best[:, part] + np.minimum(flight, rest) + _PRICE
        at = int(np.argmin(costs[0]))
        if costs[0, at] < best[0, end]:
            starts[end] = first + at
            kinds[end] = _FLIGHT if flight[0, at] <= rest[at] else _REST
        best[:, end] = np.minimum(best[:, end], costs.min(axis=1))
    return best[:, -1], starts, kinds


def _running(terms: Array) -> Array:
    return np.concatenate([np.zeros((*terms.shape[:-1], 1)), np.cumsum(terms, axis=-1)], axis=-1)


def fit_flights(times: Array, heights: Array, flights: list[Flight]) -> Flights:
    """Return the parabolas of flights with one common acceleration, and errors from residuals.

    The errors within a flight are modelled as AR(1) noise, which a mark that drifts on the ball
    causes; see `fit_with_ar_noise`.
    """
    rows = np.concatenate([np.arange(*flight) for flight in flights])
    owner = np.repeat(np.arange(len(flights)), [last - first for first, last in flights])
    origins = np.array([0.5 * (times[first] + times[last - 1]) for first, last in flights])
    since = times[rows] - origins[owner]
    design = np.zeros((len(rows), 1 + 2 * len(flights)))
    design[:, 0] = -0.5 * since**2
    design[np.arange(len(rows)), 1 + 2 * owner] = 1.0
    design[np.arange(len(rows)), 2 + 2 * owner] = since
    frames = np.round(times / max(float(np.median(np.diff(times))), 1e-300))[rows]
    steps = np.maximum(np.diff(frames, prepend=-np.inf), 1.0)  # uneven frames may round to one
    apart = np.where(np.diff(owner, prepend=-1) > 0, np.inf, steps)
    fit, sigma, correlation = fit_with_ar_noise(design, heights[rows], apart)
    residuals = np.full(len(times), np.nan)
    residuals[rows] = heights[rows] - design @ fit.values
    return Flights(
        flights, fit.values, fit.covariance, origins, sigma, correlation, residuals, fit.freedom
    )
