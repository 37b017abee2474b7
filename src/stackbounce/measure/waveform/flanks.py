"""When a contact began or ended: its flank followed down through the noise.

A threshold is crossed too late by an amount that depends on the threshold. Here the rise itself is
fitted. After a touch at t0 every law that starts as a power of the compression gives

    F = A u**p (1 + b u + c u**(p + 1)),   u = t - t0,

where p = 1 is a linear spring and p = 1.5 Hertz's law; the first correction stands for what else
presses or accelerates, the second is the ball's own slowing down, which Newton's law ties to p: see
`_slowing`.

All of t0, p, A, b, c and the level before the touch are unknown, and the error of t0 holds what the
others leave open. A force that begins with a jump (a dashpot's) or as the root of the time (a
viscoelastic one's) is no such power: its touch comes out too early, by more than its error.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.waveform.intervals import smoothed
from stackbounce.measure.waveform.record import Array

__all__ = ["FALL", "RISE", "Flank", "fit_flank"]

RISE, FALL = (1.0, 1.5), (1.0, 2.5)
"""Between which exponents p each is as probable, on a log scale, before the data are seen.

A linear spring has 1, Hertz's law 1.5; larger ones are rarer, 2 (a cone) to 2.5. A contact that
loses energy ends more softly than it begins: with an exponent of (p + 1) / e**2 - 1 where it
unloads along a power law of its own, which is 2.5 for p = 1.25 and a restitution e of 0.8.
"""

_EDGES = (
    0.1,
    0.25,
)  # of ln p: spreads of the normals that follow below and above, 2.5 being at two
_OTHERS, _SLOWING = 0.3, 0.15  # of the flank's height: spreads of the corrections b and c
_STARTS, _EXPONENTS = 21, 13
_ZOOMS, _SETTLED = 7, 3
_MOST = 36  # points; more are averaged
_AROUND = 4.5  # standard deviations on the fine grid
_LEVELS = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1)
_FEW = 8  # points on a flank, below which it is not cut shorter
_CLEAR, _FEWEST = 3.0, 3  # noise levels of the lowest level; samples
_SLACK = 3.0  # standard deviations of chi squared


@dataclass(frozen=True, eq=False)
class Flank:
    """The beginning of a contact, or with time reversed its end.

    Parameters
    ----------
    time, error : float
        When the force began, in s, and one standard deviation.
    exponent, exponent_error : float
        The power with which it began.
    times, force : ndarray
        The fitted curve, for a picture: in s and in the record's unit.
    misfit : float
        Root of chi squared per degree of freedom; the error holds it if it exceeds 1.
    """

    time: float
    error: float
    exponent: float
    exponent_error: float
    times: Array
    force: Array
    misfit: float


@dataclass(frozen=True, eq=False)
class _Points:
    """Samples, or averages over blocks of them between `edges`; `level` is that of the last."""

    times: Array
    edges: Array | None
    values: Array
    sigma: float
    height: float = 0.0
    level: float = 0.0
    offset: float = 0.0


def fit_flank(
    times: Array,
    values: Array,
    sigma: float,
    *,
    peak: float,
    offset: float,
    width: int = 1,
    exponents: tuple[float, float] = RISE,
) -> Flank | None:
    """Return the beginning of a rise from the baseline, or None where nothing rises.

    Parameters
    ----------
    times : ndarray
        (n,) ascending, in s, from well before the rise to its peak.
    values : ndarray
        (n,) without baseline.
    sigma : float
        Standard deviation of a value.
    peak : float
        The height of the first peak.
    offset : float
        How far the baseline may be off, one standard deviation.
    width : int, optional
        How many samples are averaged to see where the rise is; odd.
    exponents : (float, float), optional
        Between which p is before the data are seen.

    Returns
    -------
    Flank or None

    Examples
    --------
    >>> times = np.arange(0.0, 1.0, 0.01)
    >>> values = np.sin(np.maximum(times - 0.314, 0.0))
    >>> flank = fit_flank(times, values, 0.001, peak=0.6, offset=0.0)
    >>> abs(flank.time - 0.314) < 2 * flank.error < 0.02
    True
    """
    found: Flank | None = None
    even = smoothed(values, width)
    calm = sigma / np.sqrt(width)
    for level in _LEVELS:
        cut = _cut(times, even, calm, level * peak)
        if cut is None or (found is not None and (cut.stop - cut.foot) // width < _FEW):
            break
        points = _points(times, values, sigma, cut)
        found, chi, freedom = _fit(
            replace(points, height=level * peak, level=level, offset=offset), exponents
        )
        if chi < freedom + _SLACK * np.sqrt(2.0 * freedom):
            break
    return found


class _Cut(NamedTuple):
    start: int
    foot: int
    stop: int


def _cut(times: Array, even: Array, calm: float, level: float) -> _Cut | None:
    """Return where a rise is: from well before its foot to the first two values above a level."""
    if level < _CLEAR * calm or len(even) < _FEWEST:
        return None
    over = even >= level
    above = np.flatnonzero(over[:-1] & over[1:])  # one may be noise
    if len(above) and above[0] == 0:
        return None
    last = int(above[0]) if len(above) else len(even) - 1
    low = np.flatnonzero(even[: last + 1] < max(0.1 * level, 2.0 * calm))
    foot = int(low[-1]) if len(low) else 0
    rise = max(times[last] - times[foot], times[last] - times[last - 1])
    start = min(int(np.searchsorted(times, times[foot] - 2.0 * rise)), max(0, foot - 4))
    return _Cut(start, foot, last + 1)


def _points(times: Array, values: Array, sigma: float, cut: _Cut) -> _Points:
    """Return the samples of a cut, averaged over blocks where they are many."""
    width = max(1, (cut.stop - cut.start) // _MOST)
    first = cut.start + (cut.stop - cut.start) % width
    t, y = times[first : cut.stop], values[first : cut.stop]
    if width == 1:
        return _Points(t, None, y, sigma)
    half = 0.5 * (t[1] - t[0])
    inner = 0.5 * (t[width - 1 : -1 : width] + t[width::width])
    edges = np.concatenate([[t[0] - half], inner, [t[-1] + half]])
    t, y = (one.reshape(-1, width).mean(axis=1) for one in (t, y))
    return _Points(t, edges, y, float(sigma / np.sqrt(width)))


def _fit(points: _Points, exponents: tuple[float, float]) -> tuple[Flank, float, int]:
    """Return the flank, chi squared of the best curve, and its degrees of freedom."""
    times = points.times
    end = times[-1]
    low = np.flatnonzero(points.values < max(0.3 * points.height, 2.0 * points.sigma))
    latest = times[low[-1] + 1] if len(low) and low[-1] + 1 < len(times) else end
    span = end - times[0]
    least, most = np.log(exponents)
    logs = np.linspace(least - 3.0 * _EDGES[0], most + 3.0 * _EDGES[1], _EXPONENTS)
    first = np.linspace(times[0], min(latest, end - 1e-6 * span), _STARTS)
    starts = np.tile(first, (_EXPONENTS, 1))
    for k in range(_ZOOMS):
        score, _, _ = _scan(points, starts, logs, exponents)
        finer = k >= _SETTLED  # each exponent needs its best start before exponents compare
        starts, logs = _closer(starts, logs, score, end, finer=finer)
    score, chi, best = _scan(points, starts, logs, exponents)
    weight = np.exp(score - score.max())
    weight /= weight.sum()
    t, e = _moments(starts, weight)
    q, r = _moments(logs, weight.sum(axis=1))
    freedom = max(1, len(times) - 5)
    misfit = float(np.sqrt(max(1.0, chi / freedom))) if chi > freedom else 1.0
    if chi < freedom + _SLACK * np.sqrt(2.0 * freedom):
        misfit = 1.0
    curve = _curve(points, *best)
    p = float(np.exp(q))
    return Flank(t, e * misfit, p, p * r * misfit, *curve, misfit), chi, freedom


def _closer(
    starts: Array, logs: Array, score: Array, end: float, *, finer: bool
) -> tuple[Array, Array]:
    """Return a finer grid around the weight on a coarse one.

    Each exponent has starts of its own: the larger it is, the earlier the touch, and where noise is
    low the weight lies on a line between the two that is much thinner than it is long.
    """
    best = score.max(axis=1)
    own = np.exp(score - best[:, None])
    rows = np.exp(best - best.max()) * own.sum(axis=1)
    rows /= rows.sum()
    own /= own.sum(axis=1)[:, None]
    middles = np.sum(starts * own, axis=1)
    spreads = np.sqrt(np.sum((starts - middles[:, None]) ** 2 * own, axis=1))
    wide = _AROUND * np.maximum(spreads, 0.5 * (starts[:, 1] - starts[:, 0]))
    powers = logs
    if finer:
        mean, spread = _moments(logs, rows)
        reach = _AROUND * max(spread, 0.5 * (logs[1] - logs[0]))
        powers = np.linspace(mean - reach, mean + reach, len(logs))
    middle, half = (np.interp(powers, logs, one) for one in (middles, wide))
    top = np.minimum(middle + half, end - 1e-9 * half)
    return np.linspace(middle - half, top, starts.shape[1], axis=1), powers


def _moments(grid: Array, weight: Array) -> tuple[float, float]:
    mean = float(np.sum(grid * weight))
    return mean, float(np.sqrt(np.sum((grid - mean) ** 2 * weight)))


def _basis(u: Array, p: Array, *, averaged: bool) -> Array:
    """Return the rows u**p, u**(p+1), u**(2p+1) and 1, where u is 0 before the touch.

    They are taken at each u, or averaged between each and the next.
    """
    wide = np.diff(u, axis=-1) if averaged else None
    u = np.maximum(u, 0.0)
    first = u**p
    if wide is not None:
        one = first * u
        areas = (one / (p + 1.0), one * u / (p + 2.0), one * one / (2.0 * p + 2.0))
        rows = [np.diff(area, axis=-1) / wide for area in areas]
    else:
        rows = [first, first * u, first * first * u]
    return np.stack([*rows, np.ones_like(rows[0])], axis=-2)


def _slowing(p: Array, level: float) -> Array:
    """Return by how much a ball's slowing down lowers the force, as a share of what it then is.

    At a level, a share of the peak force, the compression is x = level**(1/p) of the largest, and
    the time since the touch that in which the impact speed would make it ξ, the integral of
    ``(1 - y**(p + 1))**-0.5`` from 0 to x. Without slowing the force would be ``(ξ / x)**p`` times
    as large.

    Examples
    --------
    >>> round(float(_slowing(np.array(1.0), 0.5)), 3)  # 1 - (π / 6) / sin(π / 6)
    -0.047
    """
    from scipy.special import hyp2f1

    part = 1.0 / (p + 1.0)
    longer: Array = hyp2f1(0.5, part, 1.0 + part, level ** ((p + 1.0) / p))
    return 1.0 - longer**p


def _scan(
    points: _Points, starts: Array, logs: Array, exponents: tuple[float, float]
) -> tuple[Array, float, tuple[float, float, Array, float]]:
    """Return the logarithm of the probability of each pair of start and exponent.

    For each pair the curve is linear in the other unknowns, which are integrated over. Also chi
    squared of the best pair, and what its curve needs.
    """
    unit = float(points.times[-1] - points.times[0])
    where = points.times if points.edges is None else points.edges
    u = (where - starts[:, :, None]) / unit
    p = np.exp(logs)
    rows = _basis(u, p[:, None, None], averaged=points.edges is not None)
    heights = np.maximum(rows[..., -1:], 1e-300)  # so that each is 1 at the end of the flank
    rows = rows / heights / points.sigma
    values = points.values / points.sigma
    normal = rows @ np.swapaxes(rows, -1, -2)
    others, spread = _OTHERS * points.height, _SLOWING * points.height
    offset = max(points.offset, 1e-6 * points.height)
    normal[..., range(4), range(4)] += (1e-12, others**-2, spread**-2, offset**-2)
    right = rows @ values
    slowing = _slowing(p, points.level)[:, None] * points.height
    right[..., 2] += slowing / spread**2
    solved = np.linalg.solve(normal, right[..., None])[..., 0]
    cost = (slowing / spread) ** 2 - np.sum(right * solved, axis=-1)
    score = -0.5 * cost - 0.5 * np.linalg.slogdet(normal)[1]
    least, most = np.log(exponents)
    beyond = np.maximum((least - logs) / _EDGES[0], (logs - most) / _EDGES[1])
    score = score - 0.5 * np.maximum(beyond, 0.0)[:, None] ** 2
    score = score + np.log(starts[:, 1:2] - starts[:, :1])
    i, j = np.unravel_index(int(np.argmax(score)), score.shape)
    chi = float(np.sum((values - solved[i, j] @ rows[i, j]) ** 2))
    scaled = solved[i, j] / heights[i, j, :, 0]
    return score, chi, (float(starts[i, j]), float(np.exp(logs[i])), scaled, unit)


def _curve(
    points: _Points, start: float, p: float, scaled: Array, unit: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the best curve, from the touch on."""
    times = np.linspace(start, points.times[-1], 60)
    force: Array = scaled @ _basis((times - start) / unit, np.array(p), averaged=False)
    return times, force
