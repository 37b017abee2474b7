"""Whether flights are parabolas of one acceleration: their own accelerations, and their shape."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.track.flights import Flight
from stackbounce.measure.quantities import Array
from stackbounce.measure.statistics.ar_noise import correlation_factor

OWN = 5  # points of a flight that tell its own acceleration
_BENT = 8  # points of a flight that tell how its acceleration changes
_CLEARLY_BENT = 0.05  # of the acceleration within a flight: a smaller change is not clear
_DIFFERENT_BELOW = 5e-4  # p-value of accelerations that differ


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
        return (
            abs(self.change)
            if abs(self.change) > max(_CLEARLY_BENT, 4.0 * self.change_error)
            else 0.0
        )


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
    square, freedom = 0.0, 0
    for first, last in flights:
        if last - first >= OWN:
            *_, rest = _polynomial(times, heights, Flight(first, last), 2)
            square += float(rest @ rest)
            freedom += last - first - 3
    return math.sqrt(square / freedom) if freedom else math.inf


def _scatter(times: Array, heights: Array, flights: Sequence[Flight]) -> tuple[float, float]:
    from scipy.stats import f

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
    if mean == 0.0 or f.sf(square / freedom, freedom, max(points, 1)) > _DIFFERENT_BELOW:
        return 0.0, 1.0
    # R. DerSimonian and N. Laird, Controlled Clinical Trials 7, 177 (1986), eq 9
    variance = (square - freedom) / float(weights.sum() - (weights**2).sum() / weights.sum())
    mean = float(np.average(falls, weights=1.0 / (errors**2 + variance)))
    scatter = math.sqrt(variance)
    return scatter / max(abs(mean), 1e-300), math.sqrt(square / freedom)


def _change(times: Array, heights: Array, flights: Sequence[Flight]) -> tuple[float, float]:
    rows = _polynomials(times, heights, flights, 4, _BENT)
    if not rows:
        return 0.0, math.inf
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
    design = np.vander(z, degree + 1, increasing=True)
    inverse = np.linalg.pinv(design)
    level = heights[part] - heights[part].mean()
    terms = inverse @ level
    return terms, np.sqrt((inverse**2).sum(axis=1)), half, level - design @ terms


def curvatures(times: Array, heights: Array) -> Array:
    """Return the second derivatives of parabolas through windows of points, (N, n) both."""
    since = times - times.mean(axis=1, keepdims=True)
    # Least squares of 1, t, t² in each window, by making t² orthogonal to the others.
    square = since**2
    slope = (square * since).sum(axis=1) / np.maximum((since**2).sum(axis=1), 1e-300)
    square = square - square.mean(axis=1, keepdims=True) - slope[:, None] * since
    curve = (square * heights).sum(axis=1) / np.maximum((square**2).sum(axis=1), 1e-300)
    return np.asarray(2.0 * curve)
