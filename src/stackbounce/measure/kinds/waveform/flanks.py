"""Touch and release of a contact: a Bayesian fit of its flanks.

The force crosses a threshold later than the touch, the more so the higher the threshold. Therefore
the rise is fitted by the curve of a shape (`shapes`). The start, the shape's unknown, the other
coefficients of the curve and the level before the touch are free, and the error of the start is
marginalised over all of them.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.waveform.intervals import smoothed
from stackbounce.measure.kinds.waveform.peaks import Peak
from stackbounce.measure.kinds.waveform.shapes import Shape
from stackbounce.measure.quantities import Array, Number, Pair, known_to

_STARTS = 21  # of the force, on the grid
_ZOOMS = 7  # of the grid
_SETTLED = 3  # of these zooms, after which each unknown has its best start
_REACH = 4.5  # standard deviations, from the middle of a finer grid to its ends
_MOST_POINTS = 36  # that are fitted; more are averaged
_AVERAGES = 80  # moving averages over a contact, by which its flanks are found
_LEVELS = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1)  # of the peak: how far up a flank is fitted, in turn
_FEW_POINTS = 8  # on a flank, below which it is not cut shorter
_LOWEST_LEVEL = 3.0  # noise levels
_LEAST_SAMPLES = 3  # of a flank
_WITHIN_ONE = (0.1587, 0.8413)  # probability below minus and below plus one standard error
_FITS_WITHIN = 3.0  # standard deviations of chi squared above its mean, for a curve that fits


@dataclass(frozen=True, eq=False)
class Flank:
    """The beginning of a contact or, with time reversed, its end.

    Parameters
    ----------
    time : UFloat
        When the force began, in s.
    exponent : UFloat
        The power with which it began.
    times, force : ndarray
        The fitted curve, for a picture: in s and in the record's unit.
    misfit : float
        Root of chi squared per degree of freedom; above 1 it multiplies the errors.
    """

    time: Number
    exponent: Number
    times: Array
    force: Array
    misfit: float

    def reversed(self) -> "Flank":
        """Return the flank with time reversed."""
        times, force = -self.times[::-1], self.force[::-1]
        return replace(self, time=-self.time, times=times, force=force)


@dataclass(frozen=True, eq=False)
class Part:
    """The samples around a contact, with the local baseline subtracted.

    `offset` is the baseline's standard error. The noise is that beside the contact, where there are
    enough samples.
    """

    times: Array
    values: Array
    first: int
    last: int
    offset: float
    noise: float
    density: float


class _Points(NamedTuple):
    """Samples, or averages over blocks of them between `edges`; `height` is about the last one.

    `level` is `height` over that of the peak, `offset` the standard error of the baseline, `length`
    that of the contact and `step` that between averaged samples, in s; `unit` is the duration of
    all, in s.
    """

    times: Array
    edges: Array | None
    values: Array
    sigma: float
    unit: float
    step: float
    height: float
    level: float
    offset: float
    length: float


def fit_flank(part: Part, peak: Peak, shape: Shape, *, forward: bool) -> Flank | None:
    """Return the fit of the flank before a peak, or of that after it; None where nothing rises.

    Parameters
    ----------
    part : Part
        The samples around the contact.
    peak : Peak
        The first one of the contact, or the last one for the flank after it.
    shape : Shape
        The curve and the prior of its unknown.
    forward : bool
        Whether it is the flank before the peak; the other one is fitted with time reversed.

    Examples
    --------
    >>> times = np.arange(0.0, 4.0, 0.01)
    >>> values = np.sin(np.clip(times - 0.314, 0.0, np.pi))
    >>> part, peak = Part(times, values, 31, 345, 0.0, 1e-3, 1e-3), Peak(1.885, 0.0, 1.0, 0.0)
    >>> flank = fit_flank(part, peak, Shape(1.0, 1.5), forward=True)
    >>> abs(flank.time.n - 0.314) < 2 * flank.time.s < 0.02
    True
    """
    top = int(np.searchsorted(part.times, peak.time))
    if forward:
        times, values = part.times[: top + 1], part.values[: top + 1]
    else:
        times, values = -part.times[top - 1 :][::-1], part.values[top - 1 :][::-1]
    width = 2 * ((part.last - part.first) // _AVERAGES // 2) + 1
    even = smoothed(values, width)
    calm = part.density / np.sqrt(width)
    length = float(part.times[part.last] - part.times[part.first])
    found: Flank | None = None
    for level in _LEVELS:
        high = level * peak.force
        start, foot, stop = _cut(times, even, calm, high)
        if stop == 0 or (found is not None and (stop - foot) // width < _FEW_POINTS):
            break
        samples = _averages(times[start:stop], values[start:stop], part.density)
        found = _fit(_Points(*samples, high, level, part.offset, length), shape)
        if found.misfit == 1.0:
            break
    return found if found is None or forward else found.reversed()


def _cut(times: Array, even: Array, calm: float, level: float) -> tuple[int, int, int]:
    """Return three indices of a rise: well before its foot, its foot, and its end above a level.

    The end is 0 if there is no significant rise.
    """
    over = even >= level
    above = np.flatnonzero(over[:-1] & over[1:])  # one may be noise
    if level < _LOWEST_LEVEL * calm or len(even) < _LEAST_SAMPLES or (len(above) and above[0] == 0):
        return 0, 0, 0
    last = int(above[0]) if len(above) else len(even) - 1
    low = np.flatnonzero(even[: last + 1] < max(0.1 * level, 2.0 * calm))
    foot = int(low[-1]) if len(low) else 0
    rise = max(times[last] - times[foot], times[last] - times[last - 1])
    start = min(int(np.searchsorted(times, times[foot] - 2.0 * rise)), max(0, foot - 4))
    return start, foot, last + 1


def _averages(
    t: Array, y: Array, sigma: float
) -> tuple[Array, Array | None, Array, float, float, float]:
    """Return the first fields of `_Points`: samples, averaged over blocks where they are many."""
    width = max(1, len(t) // _MOST_POINTS)
    if width == 1:
        return t, None, y, sigma, float(t[-1] - t[0]), 0.0
    t, y = t[len(t) % width :], y[len(y) % width :]
    half = 0.5 * (t[1] - t[0])
    inner = 0.5 * (t[width - 1 : -1 : width] + t[width::width])
    edges = np.concatenate([[t[0] - half], inner, [t[-1] + half]])
    t, y = (array.reshape(-1, width).mean(axis=1) for array in (t, y))
    return t, edges, y, float(sigma / np.sqrt(width)), float(t[-1] - t[0]), 2.0 * half


def _fit(points: _Points, shape: Shape) -> Flank:
    """Return the flank, by the posterior on a grid of starts and unknowns of the shape."""
    times = points.times
    end = times[-1]
    low = np.flatnonzero(points.values < max(0.3 * points.height, 2.0 * points.sigma))
    latest = times[low[-1] + 1] if len(low) and low[-1] + 1 < len(times) else end
    logs = shape.grid()
    first = np.linspace(times[0], min(latest, end - 1e-6 * points.unit), _STARTS)
    starts = np.tile(first, (len(logs), 1))
    for k in range(_ZOOMS):
        score = _scan(points, shape, starts, logs)[0]
        finer = k >= _SETTLED and not shape.known  # first each unknown gets its best start
        starts, logs = _closer(starts, logs, score, end, finer=finer)
    score, chi, best = _scan(points, shape, starts, logs)
    weight = np.exp(score - score.max())
    weight /= weight.sum()
    t, e = _moments(starts, weight)
    if shape.kind == "jump":
        e = max(float(np.hypot(e, points.step / np.sqrt(12.0))), _half(starts, weight))
    p, r = shape.begins(*_moments(logs, weight.sum(axis=1)))
    freedom = max(1, len(times) - 5)
    fits = chi < freedom + _FITS_WITHIN * np.sqrt(2.0 * freedom)
    misfit = 1.0 if fits else float(np.sqrt(chi / freedom))
    start, exponent = known_to(t, e * misfit), known_to(p, r * misfit)
    return Flank(start, exponent, *_curve(points, shape, *best), misfit)


def _closer(starts: Array, logs: Array, score: Array, end: float, *, finer: bool) -> Pair:
    """Return a finer grid around the posterior on a coarse one.

    Start and exponent are correlated: the larger the exponent, the earlier the start. At low noise
    the posterior is a narrow ridge, so each exponent has its own grid of starts.
    """
    best = score.max(axis=1)
    own = np.exp(score - best[:, None])
    rows = np.exp(best - best.max()) * own.sum(axis=1)
    rows /= rows.sum()
    own /= own.sum(axis=1)[:, None]
    middles = np.sum(starts * own, axis=1)
    spreads = np.sqrt(np.sum((starts - middles[:, None]) ** 2 * own, axis=1))
    wide = _REACH * np.maximum(spreads, 0.5 * (starts[:, 1] - starts[:, 0]))
    powers = logs
    if finer:
        mean, spread = _moments(logs, rows)
        reach = _REACH * max(spread, 0.5 * (logs[1] - logs[0]))
        powers = np.linspace(mean - reach, mean + reach, len(logs))
    middle, half = (np.interp(powers, logs, array) for array in (middles, wide))
    top = np.minimum(middle + half, end - 1e-9 * half)
    return np.linspace(middle - half, top, starts.shape[1], axis=1), powers


def _moments(grid: Array, weight: Array) -> tuple[float, float]:
    mean = float(np.sum(grid * weight))
    return mean, float(np.sqrt(np.sum((grid - mean) ** 2 * weight)))


def _half(grid: Array, weight: Array) -> float:
    """Return half the width of the central 68 %, which exceeds the standard deviation for a jump.

    The posterior of a jump is uniform between two samples.
    """
    order = np.argsort(grid, axis=None)
    share, places = weight.ravel()[order], grid.ravel()[order]
    low, high = np.interp(_WITHIN_ONE, np.cumsum(share) - 0.5 * share, places)
    return 0.5 * float(high - low)


def _scan(
    points: _Points, shape: Shape, starts: Array, logs: Array
) -> tuple[Array, float, tuple[float, float, Array]]:
    """Return the log-posterior of each pair of start and unknown.

    For each pair the curve is linear in its other coefficients, which are integrated out. Also
    return chi squared of the best pair, and its start, unknown and coefficients.
    """
    where = points.times if points.edges is None else points.edges
    u = (where - starts[:, :, None]) / points.unit
    unknown = shape.unknown(logs, points.length / points.unit)
    rows = shape.rows(u, unknown[:, None, None], averaged=points.edges is not None)
    heights = np.maximum(rows[..., -1:], 1e-300)  # so that each is 1 at the end of the flank
    rows = rows / heights / points.sigma
    values = points.values / points.sigma
    normal = rows @ np.swapaxes(rows, -1, -2)
    spreads: Array = np.array([shape.others, shape.slowing]) * points.height
    offset = max(points.offset, 1e-6 * points.height)
    normal[..., range(4), range(4)] += (1e-12, *spreads**-2, offset**-2)
    right = rows @ values
    means = np.stack(shape.corrections(logs, points.level), axis=-1)[:, None] * points.height
    right[..., 1:3] += means / spreads**2
    solved = np.linalg.solve(normal, right[..., None])[..., 0]
    cost = np.sum((means / spreads) ** 2, axis=-1) - np.sum(right * solved, axis=-1)
    score = -0.5 * cost - 0.5 * np.linalg.slogdet(normal)[1] + shape.prior(logs)[:, None]
    score = score + np.log(starts[:, 1:2] - starts[:, :1])
    i, j = np.unravel_index(int(np.argmax(score)), score.shape)
    chi = float(np.sum((values - solved[i, j] @ rows[i, j]) ** 2))
    scaled = solved[i, j] / heights[i, j, :, 0]
    return score, chi, (float(starts[i, j]), float(unknown[i]), scaled)


def _curve(points: _Points, shape: Shape, start: float, unknown: float, scaled: Array) -> Pair:
    """Return the best curve, from the touch on."""
    times = np.linspace(start, points.times[-1], 60)
    u = (times - start) / points.unit
    return times, scaled @ shape.rows(u, np.array(unknown), averaged=False)
