"""Heights against time -> flights (parabolas of one common acceleration) and what is between."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Flight", "Flights", "find_flights", "fit_flights", "unexplained"]

_PRICE = 14.0  # of a further piece, in variances
_SPEED = 9.0  # of a flight's speed, which a rest does not have
_STRAY = 9.0  # of a point that belongs to no piece
_LEAST = 3  # points of a flight
_LONGEST = 3000  # points of a piece
_TELLING = 8  # points more than parameters, from which residuals tell a correlation
_CORRELATIONS = np.linspace(-0.7, 0.98, 57)  # below 0: interlaced frames


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
            pieces = sums.misfits(stretch, end) + costs[stretch] + np.array([[_SPEED], [0.0]])
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
        misfit = np.minimum(np.maximum(misfit, 0.0) + _SPEED, np.maximum(syy - sy * sy / n, 0.0))
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

    The errors of neighbouring points may go together (a mark that drifts on the ball): by a factor
    that falls as a power of the frames between them. Least squares are done under each such
    correlation and averaged, weighted by its likelihood given the residuals (D. Harville, J. Am.
    Stat. Assoc. 72, 320, 1977), so that the covariance holds what is not known of it.
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
    freedom = len(rows) - design.shape[1]
    tried = _CORRELATIONS if freedom > _TELLING else np.zeros(1)
    fits = _Fits(design, heights[rows], apart, tried)
    residuals = np.full(len(times), np.nan)
    residuals[rows] = heights[rows] - design @ fits.values
    return Flights(
        flights,
        fits.values,
        fits.covariance,
        origins,
        fits.sigma,
        fits.correlation,
        residuals,
        freedom,
    )


class _Fits:
    """Least squares under each of some correlations, averaged by their likelihoods.

    `apart` is how many frames lie between a point and the one before it, infinite at the first
    point of each flight.
    """

    def __init__(
        self,
        design: NDArray[np.float64],
        heights: NDArray[np.float64],
        apart: NDArray[np.float64],
        tried: NDArray[np.float64],
    ) -> None:
        both = np.column_stack([design, heights])
        freedom = max(len(heights) - design.shape[1], 1e-9)
        shares = tried[:, None] ** apart  # of a point's error that it has from the one before
        fresh = np.sqrt(1.0 - shares**2)
        before = np.roll(both, 1, axis=0)
        own = [
            (both - share[:, None] * before) / new[:, None]
            for share, new in zip(shares, fresh, strict=True)
        ]
        products = np.stack([one.T @ one for one in own])
        normal, right = products[:, :-1, :-1], products[:, :-1, -1]
        spreads = np.linalg.pinv(normal, hermitian=True)
        values = (spreads @ right[:, :, None])[:, :, 0]
        left = [one[:, -1] - one[:, :-1] @ row for one, row in zip(own, values, strict=True)]
        variances = np.array([max(float(one @ one), 1e-300) for one in left]) / freedom
        score = -np.log(fresh).sum(axis=1) - 0.5 * np.linalg.slogdet(normal)[1]
        score -= 0.5 * freedom * np.log(variances)
        score += np.log(1.0 - tried**2)  # before the data are seen, strong ones are rare
        weights = np.exp(score - score.max())
        weights /= weights.sum()
        self.values = weights @ values
        off = values - self.values
        self.covariance = np.einsum("k,kij->ij", weights * variances, spreads)
        self.covariance += (weights * off.T) @ off
        self.sigma = math.exp(0.5 * float(weights @ np.log(variances)))
        self.correlation = float(weights @ tried)
