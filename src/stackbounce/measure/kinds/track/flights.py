"""Heights against time -> free flights: the pieces in which one acceleration holds."""

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
