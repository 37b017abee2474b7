"""When a contact began or ended: its flank followed down through the noise.

A threshold is crossed too late by an amount that depends on the threshold. Here the rise itself is
fitted. After a touch at t0 every law that starts as a power of the compression gives

    F = A u**p (1 + b u + c u**(p + 1)),   u = t - t0,

where p = 1 is a linear spring and p = 1.5 Hertz's law; the first correction stands for what else
presses or accelerates, the second is the ball's own slowing down. All of t0, p, A, b, c and the
level before the touch are unknown, and the error of t0 holds what the others leave open.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.waveform.intervals import smoothed
from stackbounce.measure.waveform.record import Array

__all__ = ["FALL", "RISE", "Flank", "fit_flank"]

RISE, FALL = (0.2, 0.25), (0.4, 0.45)
"""Logarithm of the exponent p, and its spread, before the data are seen: 1.22 and 1.5 or so.

Real contacts end more softly than they begin, because they lose energy.
"""

_CORRECTION = 0.3  # of the flank's height: spread of each correction before the data are seen
_COARSE, _FINE = (22, 9), (19, 11)  # starts, exponents
_ZOOMS = 3
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
    """Samples, or averages over blocks of them between `edges`."""

    times: Array
    edges: Array | None
    values: Array
    sigma: float
    height: float
    offset: float


def fit_flank(
    times: Array,
    values: Array,
    sigma: float,
    *,
    peak: float,
    offset: float,
    width: int = 1,
    prior: tuple[float, float] = RISE,
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
    prior : (float, float), optional
        Mean and standard deviation of ln p before the data are seen.

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
        found, chi, freedom = _fit(replace(points, height=level * peak, offset=offset), prior)
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
        return _Points(t, None, y, sigma, 0.0, 0.0)
    half = 0.5 * (t[1] - t[0])
    inner = 0.5 * (t[width - 1 : -1 : width] + t[width::width])
    edges = np.concatenate([[t[0] - half], inner, [t[-1] + half]])
    t, y = (one.reshape(-1, width).mean(axis=1) for one in (t, y))
    return _Points(t, edges, y, float(sigma / np.sqrt(width)), 0.0, 0.0)


def _fit(points: _Points, prior: tuple[float, float]) -> tuple[Flank, float, int]:
    """Return the flank, chi squared of the best curve, and its degrees of freedom."""
    times = points.times
    end = times[-1]
    low = np.flatnonzero(points.values < max(0.3 * points.height, 2.0 * points.sigma))
    latest = times[low[-1] + 1] if len(low) and low[-1] + 1 < len(times) else end
    span = end - times[0]
    starts = np.linspace(times[0], min(latest, end - 1e-6 * span), _COARSE[0])
    logs = prior[0] + prior[1] * np.linspace(-3.2, 3.2, _COARSE[1])
    for _ in range(_ZOOMS):
        weight, _, _ = _scan(points, starts, logs, prior)
        starts, logs = _around(starts, weight.sum(1), end), _around(logs, weight.sum(0), np.inf)
    weight, chi, best = _scan(points, starts, logs, prior)
    t, e = _moments(starts, weight.sum(1))
    q, r = _moments(logs, weight.sum(0))
    freedom = max(1, len(times) - 5)
    misfit = float(np.sqrt(max(1.0, chi / freedom))) if chi > freedom else 1.0
    if chi < freedom + _SLACK * np.sqrt(2.0 * freedom):
        misfit = 1.0
    curve = _curve(points, *best)
    p = float(np.exp(q))
    return Flank(t, e * misfit, p, p * r * misfit, *curve, misfit), chi, freedom


def _around(grid: Array, weight: Array, below: float) -> Array:
    """Return a finer grid around the weight on a coarse one."""
    mean, spread = _moments(grid, weight)
    step = grid[1] - grid[0]
    wide = _AROUND * max(spread, 0.5 * step)
    count = _FINE[0] if np.isfinite(below) else _FINE[1]
    top = min(mean + wide, below - 1e-9 * abs(wide)) if np.isfinite(below) else mean + wide
    return np.linspace(mean - wide, top, count)


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


def _scan(
    points: _Points, starts: Array, logs: Array, prior: tuple[float, float]
) -> tuple[Array, float, tuple[float, float, Array, float]]:
    """Return the probability of each pair of start and exponent, given the data.

    For each pair the curve is linear in the other unknowns, which are integrated over. Also chi
    squared of the best pair, and what its curve needs.
    """
    unit = float(points.times[-1] - points.times[0])
    where = points.times if points.edges is None else points.edges
    u = (where[None, :] - starts[:, None]) / unit
    rows = _basis(u[:, None, :], np.exp(logs)[None, :, None], averaged=points.edges is not None)
    heights = np.maximum(rows[..., -1:], 1e-300)  # so that each is 1 at the end of the flank
    rows = rows / heights / points.sigma
    values = points.values / points.sigma
    normal = rows @ np.swapaxes(rows, -1, -2)
    spread = _CORRECTION * points.height
    offset = max(points.offset, 1e-6 * points.height)
    normal[..., range(4), range(4)] += (1e-12, spread**-2, spread**-2, offset**-2)
    right = rows @ values
    solved = np.linalg.solve(normal, right[..., None])[..., 0]
    cost = np.sum(values**2) - np.sum(right * solved, axis=-1)
    score = -0.5 * cost - 0.5 * np.linalg.slogdet(normal)[1]
    score = score - 0.5 * ((logs - prior[0]) / prior[1]) ** 2
    weight = np.exp(score - score.max())
    weight /= weight.sum()
    i, j = np.unravel_index(int(np.argmax(score)), score.shape)
    chi = float(np.sum((values - solved[i, j] @ rows[i, j]) ** 2))
    scaled = solved[i, j] / heights[i, j, :, 0]
    return weight, chi, (float(starts[i]), float(np.exp(logs[j])), scaled, unit)


def _curve(
    points: _Points, start: float, p: float, scaled: Array, unit: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the best curve, from the touch on."""
    times = np.linspace(start, points.times[-1], 60)
    force: Array = scaled @ _basis((times - start) / unit, np.array(p), averaged=False)
    return times, force
