"""Heights -> the free flights in them -> parabolas of one acceleration, with errors.

Flights are the pieces in which one acceleration holds. Each has a level and a speed of its own,
which are eliminated from the normal equations: the work grows with the number of points, not with
the square of the number of flights.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array

_PIECE_PENALTY = 14.0  # variances, of each piece
_SPEED_PENALTY = 9.0  # variances, of a flight's speed, a parameter that a rest does not have
_STRAY_PENALTY = 9.0  # variances, of a point that belongs to no piece: 3 standard deviations
_STRAY_POINT, _FLIGHT, _REST = range(3)  # kinds of pieces
_LEAST_POINTS = 3  # of a flight
_ANY_LENGTH = 128  # points up to which a piece can have any number of them
_LENGTH_RATIO = 1.03  # of neighbouring numbers of points that longer pieces can have
_MOST_POINTS = 1024  # of a piece; a longer flight is found as several that fit together
_BLOCK = 64  # ends of pieces whose costs are found at once
_LEAST_FREEDOM = 8  # degrees of freedom, above which residuals tell a correlation
_CORRELATIONS = np.linspace(-0.7, 0.98, 57)  # on the grid; below 0: interlaced frames
_COLUMNS, _ROWS = (part.tolist() for part in np.tril_indices(4))  # pairs of columns
_FAR = 100  # steps, beyond which errors are taken as independent
_ALMOST_NONE = 1e-9  # degrees of freedom of as many points as parameters


class Flight(NamedTuple):
    """Indices of the first point and of the one after the last; of points in free flight."""

    first: int
    last: int


def find_flights(times: Array, heights: Array, sigma: float, acceleration: float) -> list[Flight]:
    """Return the free flights in a track.

    The track is cut into flights, rests and stray points at the change points that make the sum of
    squared residuals and of penalties, one for each piece, smallest (R. Bellman's dynamic
    programming). Long pieces have only some numbers of points, so that the work for a point does
    not grow with the track.

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
    lengths = _lengths(count)
    best = np.zeros((len(accelerations), count + 1))
    starts = np.arange(count + 1) - 1
    kinds = np.full(count + 1, _STRAY_POINT)
    for begin in range(0, count if len(lengths) else 0, _BLOCK):
        ends = np.arange(begin + 1, min(begin + _BLOCK, count) + 1)
        flight, rest = _costs(times, heights, sigma, accelerations, ends, lengths)
        costs = np.minimum(flight, rest) + _PIECE_PENALTY
        froms = ends[:, None] - lengths
        usable = np.searchsorted(lengths, ends, side="right")
        for k, end in enumerate(ends.tolist()):
            best[:, end] = best[:, end - 1] + _STRAY_PENALTY
            if not (some := int(usable[k])):
                continue
            total = best[:, froms[k, :some]] + costs[:, k, :some]
            at = int(total[0].argmin())
            if total[0, at] < best[0, end]:
                starts[end] = froms[k, at]
                kinds[end] = _FLIGHT if flight[0, k, at] <= rest[k, at] else _REST
            np.minimum(best[:, end], total.min(axis=1), out=best[:, end])
    return best[:, -1], starts, kinds


def _lengths(count: int) -> NDArray[np.intp]:
    """Return the numbers of points that a piece can have, ascending."""
    longest = min(count, _MOST_POINTS)
    steps = int(np.log(_MOST_POINTS / _ANY_LENGTH) / np.log(_LENGTH_RATIO)) + 1
    long = np.round(np.geomspace(_ANY_LENGTH, _MOST_POINTS, steps)).astype(np.intp)
    every = np.concatenate([np.arange(_LEAST_POINTS, _ANY_LENGTH, dtype=np.intp), long])
    return every[every <= longest]


def _costs(
    times: Array,
    heights: Array,
    sigma: float,
    accelerations: Array,
    ends: NDArray[np.intp],
    lengths: NDArray[np.intp],
) -> tuple[Array, Array]:
    """Return the costs of flights (K, E, L) and of rests (E, L) that end before E points.

    Those that would begin before the track are of no use.
    """
    low = max(0, int(ends[0]) - int(lengths[-1]))
    part = slice(low, int(ends[-1]))
    x = times[part] - times[part].mean()
    y = (heights[part] - heights[part].mean()) / sigma
    flown = y + 0.5 * accelerations[:, None] * x**2 / sigma
    flown -= flown.mean(axis=1, keepdims=True)
    # Running sums of x, x², y, y² (one row), and of the residuals of flights, times x, squared.
    single = _running(np.stack([x, x * x, y, y * y]))
    many = _running(np.stack([flown, x * flown, flown * flown]))
    n = lengths[:, None].astype(np.float64)
    sx, sxx, sy, syy = _sums(single, len(ends), lengths)
    f, xf, ff = _sums(many, len(ends), lengths)
    mean = sx / n
    xf -= mean * f
    ff -= f * f / n
    ff -= xf * xf / np.maximum(sxx - mean * sx, 1e-300)
    flight = np.maximum(ff, 0.0) + _SPEED_PENALTY
    rest = np.maximum(syy - sy * sy / n, 0.0)
    return np.ascontiguousarray(np.swapaxes(flight, 1, 2)), np.ascontiguousarray(rest.T)


def _sums(running: Array, count: int, lengths: NDArray[np.intp]) -> Array:
    """Return the sums (..., L, E) over the last points before each of the last E ends."""
    lacking = max(int(lengths[-1]) + count - running.shape[-1], 0)
    padded = np.pad(running, [(0, 0)] * (running.ndim - 1) + [(lacking, 0)])
    windows = np.lib.stride_tricks.sliding_window_view(padded, count, axis=-1)
    before = windows[..., padded.shape[-1] - count - lengths, :]
    return np.asarray(running[..., None, -count:] - before)


def _running(terms: Array) -> Array:
    return np.concatenate([np.zeros((*terms.shape[:-1], 1)), np.cumsum(terms, axis=-1)], axis=-1)


class _Fits(NamedTuple):
    """Least squares fits for each of K correlations.

    Attributes
    ----------
    fall, own : ndarray
        (K,) acceleration; (K, N, 2) level and speed of each flight.
    inverse, slope : ndarray
        (K, N, 2, 2) covariance of level and speed at a known acceleration, in variances; (K, N, 2)
        their change with the acceleration, negative.
    strength : ndarray
        (K,) inverse variance of the acceleration, in variances.
    likelihood, variance : ndarray
        (K,) restricted log-likelihood; variance of an error.
    """

    fall: Array
    own: Array
    inverse: Array
    slope: Array
    strength: Array
    likelihood: Array
    variance: Array


class Parabolas:
    """The parabolas of flights with one common acceleration, and errors from residuals.

    The errors within a flight are modelled as AR(1) noise, which a mark that drifts on the ball
    causes. Generalised least squares are done for each correlation on a grid and averaged, weighted
    by its restricted likelihood (D. Harville, J. Am. Stat. Assoc. 72, 320, 1977), so that the
    covariance includes the uncertainty of the correlation. Few points are taken as uncorrelated.

    Parameters
    ----------
    times, heights : ndarray
        (n,) in s and m, up-positive.
    flights : list of Flight
        N of them, with three points or more each:
        ``u = level + speed (t - origin) - acceleration (t - origin)²/2``.

    Attributes
    ----------
    origins : ndarray
        (N,) in s, the middle of each.
    freedom : int
        Points less parameters.
    """

    def __init__(self, times: Array, heights: Array, flights: list[Flight]) -> None:
        self.times, self.heights, self.flights = times, heights, flights
        self.firsts, self.lasts = np.array(flights).T
        counts = self.lasts - self.firsts
        self.rows = np.concatenate([np.arange(*flight) for flight in flights])
        self.owner = np.repeat(np.arange(len(flights)), counts)
        self.origins = 0.5 * (times[self.firsts] + times[self.lasts - 1])
        self.since = times[self.rows] - self.origins[self.owner]
        self.begins = np.concatenate([[0], np.cumsum(counts)[:-1]])
        self.freedom = len(self.rows) - 1 - 2 * len(flights)

    @property
    def fall(self) -> float:
        """The acceleration, above 0 downward."""
        return float(self.rough.fall[0] + self.weights @ self.fits.fall)

    @property
    def sigma(self) -> float:
        """Standard deviation of one point's error."""
        return float(np.exp(0.5 * (self.weights @ np.log(self.fits.variance))))

    @cached_property
    def tried(self) -> Array:
        """The correlations on the grid, (K,)."""
        return _CORRELATIONS if self.freedom > _LEAST_FREEDOM else np.zeros(1)

    @cached_property
    def rough(self) -> _Fits:
        """The fit without a correlation."""
        return self._fits(self.heights[self.rows], np.zeros(1))

    @cached_property
    def fits(self) -> _Fits:
        """The fits for each correlation, to what the fit without one leaves."""
        modelled = self._modelled(self.rough.fall[0], self.rough.own[0])
        return self._fits(self.heights[self.rows] - modelled, self.tried)

    @cached_property
    def weights(self) -> Array:
        """The posterior probability of each correlation, (K,)."""
        score = self.fits.likelihood + np.log(1.0 - self.tried**2)  # strong ones are rare
        weights = np.exp(score - score.max())
        return np.asarray(weights / weights.sum())

    def jumps(self) -> tuple[Array, Array, Array]:
        """Return the jump of the velocity after each flight but the last, its error, and before.

        The third is the velocity before the jump. Each is (N - 1,).
        """
        middles = 0.5 * (self.times[self.lasts[:-1] - 1] + self.times[self.firsts[1:]])
        since, until = middles - self.origins[:-1], middles - self.origins[1:]
        fits, weights = self.fits, self.weights
        falls = (self.rough.fall + fits.fall)[:, None]
        speeds = self.rough.own[:, :, 1] + fits.own[:, :, 1]
        each = speeds[:, 1:] - speeds[:, :-1] + falls * (since - until)
        slopes, own = fits.slope[:, :, 1], fits.inverse[:, :, 1, 1]
        by_fall = since - until + slopes[:, :-1] - slopes[:, 1:]
        unsure = own[:, :-1] + own[:, 1:] + by_fall**2 / fits.strength[:, None]
        spread = fits.variance[:, None] * unsure
        jump = weights @ each
        error = np.sqrt(weights @ (spread + (each - jump) ** 2))
        return jump, error, weights @ (speeds[:, :-1] - falls * since)

    @cached_property
    def values(self) -> Array:
        """Acceleration, then level and speed of each flight, (1 + 2 N,)."""
        return np.concatenate([self.rough.fall, self.rough.own.ravel()]) + self.weights @ self._each

    @cached_property
    def covariance(self) -> Array:
        """The covariance of these values, (1 + 2 N, 1 + 2 N)."""
        fits, weights = self.fits, self.weights
        along = np.column_stack([np.ones(len(weights)), -fits.slope.reshape(len(weights), -1)])
        off = self._each - weights @ self._each
        covariance = (along * (weights * fits.variance / fits.strength)[:, None]).T @ along
        covariance += (off * weights[:, None]).T @ off
        blocks = np.einsum("k,knij->nij", weights * fits.variance, fits.inverse)
        at = 1 + np.arange(2 * len(self.flights)).reshape(-1, 2)
        covariance[at[:, :, None], at[:, None, :]] += blocks
        return np.asarray(covariance)

    @cached_property
    def residuals(self) -> Array:
        """The residual of each point, NaN where it is in no flight."""
        residuals = np.full(len(self.times), np.nan)
        flown = self._modelled(self.values[0], self.values[1:].reshape(-1, 2))
        residuals[self.rows] = self.heights[self.rows] - flown
        return residuals

    @cached_property
    def _each(self) -> Array:
        """The values of the fit for each correlation, less those of the one without."""
        return np.column_stack([self.fits.fall, self.fits.own.reshape(len(self.tried), -1)])

    def _modelled(self, fall: float, flights: Array) -> Array:
        own = flights[self.owner]
        return np.asarray(own[:, 0] + own[:, 1] * self.since - 0.5 * fall * self.since**2)

    @cached_property
    def _apart(self) -> Array:
        """Steps between a point and the one before it, infinite where a flight begins."""
        usual = max(float(np.median(np.diff(self.times))), 1e-300)
        frames = np.round(self.times / usual)[self.rows]
        steps = np.maximum(np.diff(frames, prepend=-np.inf), 1.0)  # uneven frames may round to one
        begins = np.diff(self.owner, prepend=-1) > 0
        return np.where(begins | (steps > _FAR), np.inf, steps)

    def _fits(self, values: Array, correlations: Array) -> _Fits:
        """Return the fits to values of all points for each of K correlations."""
        total, log_innovations = self._whitened(values, correlations)
        ones, firsts, seconds, bent_ones, bent, bends, seen_ones, seen, both, squares = total
        sizes = np.maximum(ones * seconds - firsts**2, 1e-300)
        inverse = np.stack([seconds, -firsts, -firsts, ones], axis=-1) / sizes[..., None]
        inverse = inverse.reshape(*sizes.shape, 2, 2)
        own_bent, own_seen = np.stack([bent_ones, bent], axis=-1), np.stack([seen_ones, seen], -1)
        slope = np.einsum("knij,knj->kni", inverse, own_bent)
        strength = np.maximum(bends.sum(axis=1) - (own_bent * slope).sum(axis=(1, 2)), 1e-300)
        told = both.sum(axis=1)
        fall = (told - (own_seen * slope).sum(axis=(1, 2))) / strength
        own = np.einsum("knij,knj->kni", inverse, own_seen) - fall[:, None, None] * slope
        square = squares.sum(axis=1) - fall * told - (own_seen * own).sum(axis=(1, 2))
        freedom = max(self.freedom, _ALMOST_NONE)
        variance = np.maximum(square, 1e-300) / freedom
        log_det = log_innovations + np.log(sizes).sum(axis=1) + np.log(strength)
        likelihood = -0.5 * (freedom * np.log(variance) + log_det)
        return _Fits(fall, own, inverse, slope, strength, likelihood, variance)

    def _whitened(self, values: Array, correlations: Array) -> tuple[Array, Array]:
        """Return the sums of products of columns over each flight, (10, K, N), and ln det, (K,).

        The columns are 1, t, -t²/2 and the values, less the correlated part of the point before.
        The sums over points that are equally many steps from that point serve all correlations.
        """
        since = self.since
        now = np.stack([np.ones(len(since)), since, -0.5 * since**2, values])
        last = np.roll(now, 1, axis=1)
        products = np.stack(
            [now[_ROWS] * now[_COLUMNS],
             now[_ROWS] * last[_COLUMNS] + last[_ROWS] * now[_COLUMNS],
             last[_ROWS] * last[_COLUMNS]]
        )  # fmt: skip
        total = np.zeros((len(_ROWS), len(correlations), len(self.flights)))
        log_det = np.zeros(len(correlations))
        for steps in np.unique(self._apart):
            so_far = self._apart == steps
            here, cross, before = np.add.reduceat(products * so_far, self.begins, axis=2)
            kept = (correlations**steps)[:, None]
            innovation = 1.0 - kept**2
            part = here[:, None] - kept * cross[:, None] + kept**2 * before[:, None]
            total += part / innovation
            log_det += so_far.sum() * np.log(innovation[:, 0])
        return total, log_det
