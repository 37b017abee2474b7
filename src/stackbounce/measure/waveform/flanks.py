"""When a contact began or ended: its flank followed down through the noise.

A threshold is crossed too late by an amount that depends on the threshold. Here the rise itself is
fitted, by the curves of `stackbounce.measure.waveform.shapes`. Start, shape, all else of the curve
and the level before the touch are unknown, and the error of the start holds what the others leave
open.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from stackbounce.measure.waveform.intervals import smoothed
from stackbounce.measure.waveform.record import Array
from stackbounce.measure.waveform.scan import Found, Points, scan
from stackbounce.measure.waveform.shapes import Shape

__all__ = ["Flank", "Tried", "fit_flank"]

_MOST, _QUIET = 36, 6  # points on and before a flank; more are averaged
_LEVELS = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1)
_FEW = 8  # points on a flank, below which it is not cut shorter
_CLEAR, _FEWEST = 3.0, 3  # noise levels of the lowest level; samples
_SLACK = 3.0  # standard deviations of chi squared
_ONE = (0.1587, 0.8413)  # of the probability: below minus one error, and below plus one


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

    def reversed(self) -> "Flank":
        """Return the same with time running the other way."""
        back = -self.times[::-1], self.force[::-1]
        return replace(self, time=-self.time, times=back[0], force=back[1])


@dataclass(frozen=True, eq=False)
class Tried:
    """A flank as each of several shapes tells it, and the number of degrees of freedom."""

    found: tuple[Found, ...]
    freedom: int

    @property
    def evidence(self) -> Array:
        """Logarithm of how probable the record is with each shape, but for a common number."""
        return np.array([one.evidence for one in self.found])

    def only(self, which: Sequence[int]) -> "Tried":
        """Return the same of some shapes."""
        return replace(self, found=tuple(self.found[k] for k in which))

    def flank(self, shares: Array) -> Flank:
        """Return the flank, each shape having a share of the probability; the shares' sum is 1."""
        best = self.found[int(np.argmax(shares))]
        starts, powers = (
            np.concatenate([getattr(one, name) for one in self.found])
            for name in ("starts", "powers")
        )
        weights = np.concatenate(
            [share * one.weights for share, one in zip(shares, self.found, strict=True)]
        )
        coarse = sum(
            share * one.coarse**2 / 12.0 for share, one in zip(shares, self.found, strict=True)
        )
        misfit = 1.0
        if best.chi > _most(self.freedom):
            misfit = float(np.sqrt(best.chi / self.freedom))
        time, spread = _moments(starts, weights)
        error = misfit * max(float(np.hypot(spread, np.sqrt(coarse))), _half(starts, weights))
        power, spread = _moments(powers, weights)
        return Flank(time, error, power, spread * misfit, best.times, best.force, misfit)


def _most(freedom: int) -> float:
    """Return the largest chi squared that is not held against a curve."""
    return freedom + _SLACK * float(np.sqrt(2.0 * freedom))


def _moments(grid: Array, weight: Array) -> tuple[float, float]:
    mean = float(np.sum(grid * weight))
    return mean, float(np.sqrt(np.sum((grid - mean) ** 2 * weight)))


def _half(grid: Array, weight: Array) -> float:
    """Return half of the range that holds 68 %; it is more than the spread for a jump.

    A jump between two samples is as probable anywhere between them.
    """
    order = np.argsort(grid)
    below = np.cumsum(weight[order]) - 0.5 * weight[order]
    low, high = np.interp(_ONE, below, grid[order])
    return 0.5 * float(high - low)


def fit_flank(
    times: Array,
    values: Array,
    sigma: float,
    shapes: Sequence[Shape],
    *,
    peak: float,
    offset: float,
    length: float,
    width: int = 1,
) -> Tried | None:
    """Return what shapes make of a rise from the baseline, or None where nothing rises.

    Parameters
    ----------
    times : ndarray
        (n,) ascending, in s, from well before the rise to its peak.
    values : ndarray
        (n,) without baseline.
    sigma : float
        Standard deviation of a value.
    shapes : sequence of Shape
        How the force may begin.
    peak : float
        The height of the first peak.
    offset : float
        How far the baseline may be off, one standard deviation.
    length : float
        Of the contact, in s, roughly.
    width : int, optional
        How many samples are averaged to see where the rise is; odd.

    Returns
    -------
    Tried or None

    Examples
    --------
    >>> from stackbounce.measure.waveform.shapes import power
    >>> times = np.arange(0.0, 1.0, 0.01)
    >>> values = np.sin(np.maximum(times - 0.314, 0.0))
    >>> tried = fit_flank(times, values, 1e-3, [power(1.0, 1.5)], peak=0.6, offset=0.0, length=1.4)
    >>> flank = tried.flank(np.ones(1))
    >>> abs(flank.time - 0.314) < 2 * flank.error < 0.02
    True
    """
    tried: Tried | None = None
    even = smoothed(values, width)
    calm = sigma / np.sqrt(width)
    for level in _LEVELS:
        cut = _cut(times, even, calm, level * peak)
        if cut is None or (tried is not None and (cut.stop - cut.foot) // width < _FEW):
            break
        bare = _points(times, values, sigma, cut)
        points = replace(bare, height=level * peak, level=level, offset=offset, length=length)
        tried = Tried(tuple(scan(points, shape) for shape in shapes), max(1, len(points.times) - 5))
        if tried.found[int(np.argmax(tried.evidence))].chi < _most(tried.freedom):
            break
    return tried


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


def _points(times: Array, values: Array, sigma: float, cut: _Cut) -> Points:
    """Return the samples of a cut, averaged over blocks: long ones where it is quiet for sure."""
    near = max(cut.start, cut.foot - (cut.stop - cut.foot) // 2 - 1)
    width = max(1, (cut.stop - near) // _MOST)
    near += (cut.stop - near) % width
    wide = max(width, -(-(near - cut.start) // _QUIET))
    first = near - (near - cut.start) // wide * wide
    starts = np.concatenate([np.arange(first, near, wide), np.arange(near, cut.stop, width)])
    counts = np.diff(starts, append=cut.stop)
    t, y = (np.add.reduceat(one[: cut.stop], starts) / counts for one in (times, values))
    noise = sigma / np.sqrt(counts)
    if width == 1:
        return Points(t, None, y, noise)
    between = 0.5 * (times[starts[1:] - 1] + times[starts[1:]])
    half = (
        0.5 * (times[first + 1] - times[first]),
        0.5 * (times[cut.stop - 1] - times[cut.stop - 2]),
    )
    edges = np.concatenate([[times[first] - half[0]], between, [times[cut.stop - 1] + half[1]]])
    return Points(t, edges, y, noise, step=2.0 * half[1])
