"""Heights against time -> flights (parabolas of one common acceleration) and what is between."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Flight", "Flights", "find_flights", "fit_flights", "unexplained"]

_PRICE = 14.0  # of a further piece, in variances
_STRAY = 9.0  # of a point that belongs to no piece
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
    values: NDArray[np.float64]
    covariance: NDArray[np.float64]
    origins: NDArray[np.float64]
    sigma: float
    correlation: float
    residuals: NDArray[np.float64]
    freedom: int


def find_flights(
    times: NDArray[np.float64], heights: NDArray[np.float64], sigma: float, acceleration: float
) -> list[Flight]:
    """Return the free flights in a track.

    The track is cut into flights, rests and stray points so that the sum of squares and of prices
    is least (R. Bellman's dynamic programming).

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
    count = len(times)
    middle = times - times.mean()
    straight = heights + 0.5 * acceleration * middle**2
    sums = _Sums(middle, straight - straight.mean(), heights - heights.mean(), sigma)
    best = [0.0] + [math.inf] * count
    costs = np.array(best)
    before, kind = [0] * (count + 1), [0] * (count + 1)
    for end in range(1, count + 1):
        best[end], before[end], kind[end] = best[end - 1] + _STRAY, end - 1, 0
        if end >= _LEAST:
            first = max(0, end - _LONGEST)
            stretch = slice(first, end - _LEAST + 1)
            pieces = sums.misfits(stretch, end) + costs[stretch]
            number, i = divmod(int(np.argmin(pieces)), pieces.shape[1])
            cost = float(pieces[number, i]) + _PRICE
            if cost < best[end]:
                best[end], before[end], kind[end] = cost, first + i, 1 + number
        costs[end] = best[end]
    flights, end = [], count
    while end > 0:
        if kind[end] == 1:
            flights.append(Flight(int(before[end]), end))
        end = int(before[end])
    return flights[::-1]


def unexplained(
    times: NDArray[np.float64],
    heights: NDArray[np.float64],
    sigma: float,
    accelerations: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return how badly flights of each acceleration explain a track; see `find_flights`.

    Parameters
    ----------
    times, heights, sigma
        As in `find_flights`.
    accelerations : ndarray
        (K,) in m/s², above 0 downward.

    Returns
    -------
    ndarray
        (K,) sums of squares and prices, in variances.
    """
    count = len(times)
    x = times - times.mean()
    y = (heights - heights.mean()) / sigma
    flown = y + 0.5 * np.asarray(accelerations)[:, None] * x**2 / sigma
    flown -= flown.mean(axis=1, keepdims=True)
    # Running sums: of x, x², y, y² (one row), and of what is left of flights, times x, squared.
    single = _running(np.stack([x, x * x, y, y * y]))
    many = _running(np.stack([flown, x * flown, flown * flown]))
    best = np.zeros((len(flown), count + 1))
    counts = np.arange(count + 1, dtype=np.float64)
    for end in range(1, count + 1):
        best[:, end] = best[:, end - 1] + _STRAY
        if end < _LEAST:
            continue
        part = slice(max(0, end - _LONGEST), end - _LEAST + 1)
        n = end - counts[part]
        sx, sxx, sy, syy = single[:, end, None] - single[:, part]
        f, xf, ff = many[:, :, end, None] - many[:, :, part]
        mean = sx / n
        misfit = ff - f * f / n - (xf - mean * f) ** 2 / np.maximum(sxx - mean * sx, 1e-300)
        misfit = np.minimum(np.maximum(misfit, 0.0), np.maximum(syy - sy * sy / n, 0.0))
        cheapest = (best[:, part] + misfit).min(axis=1) + _PRICE
        best[:, end] = np.minimum(best[:, end], cheapest)
    return best[:, -1]


def _running(terms: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.concatenate([np.zeros((*terms.shape[:-1], 1)), np.cumsum(terms, axis=-1)], axis=-1)


class _Sums:
    """Running sums that give the misfit of a flight or a rest to any stretch of points."""

    def __init__(
        self,
        x: NDArray[np.float64],
        flown: NDArray[np.float64],
        held: NDArray[np.float64],
        sigma: float,
    ) -> None:
        terms = np.stack([x, flown, held, x * x, x * flown, flown * flown, held * held])
        sums = np.cumsum(
            terms / np.array([1, sigma, sigma, 1, sigma, sigma**2, sigma**2])[:, None], axis=1
        )
        self._sums = np.concatenate([np.zeros((7, 1)), sums], axis=1)
        self._counts = np.arange(len(x) + 1, dtype=np.float64)

    def misfits(self, starts: slice, end: int) -> NDArray[np.float64]:
        """Return sums of squares from each start to the end, (2, starts), in variances.

        Of a straight line through what is left of a flight, and of a constant.
        """
        n = end - self._counts[starts]
        x, y, z, xx, xy, yy, zz = self._sums[:, end, None] - self._sums[:, starts]
        spread = np.maximum(xx - x * x / n, 1e-300)
        misfits = np.empty((2, len(n)))
        misfits[0] = yy - y * y / n - (xy - x * y / n) ** 2 / spread
        misfits[1] = zz - z * z / n
        return np.maximum(misfits, 0.0, out=misfits)


def fit_flights(
    times: NDArray[np.float64], heights: NDArray[np.float64], flights: list[Flight]
) -> Flights:
    """Return the parabolas of flights with one common acceleration, and errors from residuals.

    The errors of neighbouring points may go together (a mark that drifts on the ball): their
    correlation is estimated from the residuals, allowing for what the fit takes out of them, and
    the covariance is that of least squares under it.
    """
    rows = np.concatenate([np.arange(*flight) for flight in flights])
    owner = np.repeat(np.arange(len(flights)), [last - first for first, last in flights])
    origins = np.array([0.5 * (times[first] + times[last - 1]) for first, last in flights])
    since = times[rows] - origins[owner]
    design = np.zeros((len(rows), 1 + 2 * len(flights)))
    design[:, 0] = -0.5 * since**2
    design[np.arange(len(rows)), 1 + 2 * owner] = 1.0
    design[np.arange(len(rows)), 2 + 2 * owner] = since
    values, *_ = np.linalg.lstsq(design, heights[rows], rcond=None)
    left = heights[rows] - design @ values
    residuals = np.full(len(times), np.nan)
    residuals[rows] = left
    freedom = len(rows) - design.shape[1]
    spread = np.asarray(np.linalg.pinv(design.T @ design, hermitian=True), dtype=np.float64)
    blocks = [np.flatnonzero(owner == j) for j in range(len(flights))]
    steps = np.round(times / max(float(np.median(np.diff(times))), 1e-300)).astype(np.int64)
    apart = [np.abs(np.subtract.outer(steps[rows[b]], steps[rows[b]])) for b in blocks]
    correlation = _correlation(design, left, spread, blocks, apart) if freedom > 8 else 0.0
    variance, covariance = _under(correlation, design, left, spread, blocks, apart)
    return Flights(
        flights,
        values,
        covariance,
        origins,
        math.sqrt(variance),
        correlation,
        residuals,
        freedom,
    )


_Blocks = list[NDArray[np.int64]]


def _under(
    correlation: float,
    design: NDArray[np.float64],
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
    blocks: _Blocks,
    apart: _Blocks,
) -> tuple[float, NDArray[np.float64]]:
    """Return variance of a point and covariance of the parameters under a correlation."""
    middle = np.zeros_like(spread)
    for block, steps in zip(blocks, apart, strict=True):
        part = design[block]
        middle += part.T @ (correlation**steps) @ part
    freedom = len(left) - float(np.trace(spread @ middle))
    variance = float(left @ left) / max(freedom, 1e-9)
    return variance, variance * spread @ middle @ spread


def _correlation(
    design: NDArray[np.float64],
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
    blocks: _Blocks,
    apart: _Blocks,
) -> float:
    """Return the correlation of neighbours for which residuals would go together as they do."""
    from scipy.optimize import brentq

    near = [(steps == 1).astype(np.float64) for steps in apart]
    pairs = sum(float(one.sum()) for one in near)
    if pairs < 1.0:
        return 0.0
    seen = sum(left[b] @ one @ left[b] for b, one in zip(blocks, near, strict=True))
    seen /= float(left @ left) + 1e-300

    def excess(correlation: float) -> float:
        # Of residuals M e, M = 1 - X S X': the traces of M N M Σ and of M Σ.
        beside, total = 0.0, 0.0
        middle = np.zeros_like(spread)
        sides = np.zeros_like(spread)
        cross = np.zeros_like(spread)
        for block, steps, one in zip(blocks, apart, near, strict=True):
            part, errors = design[block], correlation**steps
            total += len(block)
            beside += float((one * errors).sum())
            middle += part.T @ errors @ part
            sides += part.T @ one @ part
            cross += part.T @ one @ errors @ part
        total -= float(np.trace(spread @ middle))
        beside -= 2.0 * float(np.trace(spread @ cross))
        beside += float(np.trace(spread @ sides @ spread @ middle))
        return float(beside / max(total, 1e-9) - seen)

    if excess(0.0) >= 0.0:
        return 0.0
    return float(brentq(excess, 0.0, 0.98)) if excess(0.98) > 0.0 else 0.98
