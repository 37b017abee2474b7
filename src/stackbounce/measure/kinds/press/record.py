"""A press record: its signs, noise and cycles, each with loading and unloading."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue
from stackbounce.library_types import Dataset
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import columns, resolution
from stackbounce.measure.statistics.ar_noise import difference_noise

_LEAST_POINTS = 6  # of a branch that is fitted, which has three parameters
_LEAST_REVERSAL = 0.15  # of the range of compressions: smaller reversals belong to a branch
_HELD_WITHIN = 1e-3  # of the range of compressions, by which one that is held may change
_LEAST_SLOPE = 5.0  # standard errors of the force's slope, which noise does not reach


@dataclass(frozen=True)
class Record:
    """Compression and force; both increase as the ball is pressed.

    Parameters
    ----------
    compression, force : ndarray
        (N,) in m and N, in the order in which they were recorded, without gaps.
    jitter, hiss : float
        White noise of the compression in m and of the force in N, not less than their quantisation
        noise.
    step : float
        Quantisation step of the force in N, 0 if none is seen.
    notes : tuple of str
        On the changes that were made to it.
    """

    compression: Array
    force: Array
    jitter: float
    hiss: float
    step: float
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Cycle:
    """The points of a loading and of the unloading after it.

    Parameters
    ----------
    loading, unloading : ndarray of int
        Their places in the record; either may be empty.
    peak, peak_error : float
        The compression in m of the turning point, and its standard error.
    """

    loading: NDArray[np.intp]
    unloading: NDArray[np.intp]
    peak: float
    peak_error: float


def record_of(data: Dataset | Any) -> Record:
    """Return a press curve's record; see `press`.

    Raises
    ------
    InvalidType
        If `data` is neither a Dataset with `compression` and `force` nor a pair of arrays.
    InvalidValue
        If there are too few points, or the force does not rise with the compression.
    """
    compression, force = columns(data, ("compression", "force"))
    notes = []
    good = np.isfinite(compression) & np.isfinite(force)
    if not good.all():
        notes.append(f"{int((~good).sum())} points without a number were left out.")
    compression, force = compression[good], force[good]
    if len(force) < _LEAST_POINTS:
        raise InvalidValue(
            f"a press curve must have at least {_LEAST_POINTS} points with numbers, "
            f"got {len(force)}"
        )
    if np.ptp(compression) == 0.0 or np.ptp(force) == 0.0:
        constant = "compression" if np.ptp(compression) == 0.0 else "force"
        raise InvalidValue(f"{constant} must change in a press curve, got one value throughout")
    compression, force, turned = _oriented(compression, force)
    notes += turned
    step = resolution(force)
    jitter = max(difference_noise(compression), resolution(compression) / np.sqrt(12.0))
    hiss = max(difference_noise(force), step / np.sqrt(12.0))
    return Record(compression, force, jitter, hiss, step, tuple(notes))


def cycles(record: Record) -> list[Cycle]:
    """Return the cycles of a record, in order; the first may lack its loading, the last its end."""
    from scipy.signal import find_peaks

    path = record.compression
    low, high = float(path.min()), float(path.max())
    deep = max(_LEAST_REVERSAL * (high - low), 8.0 * record.jitter)
    # an end of the record can be a peak
    padded = np.pad(path, 1, constant_values=low - 10.0 * (high - low))
    peaks = find_peaks(padded, prominence=min(deep, 0.9 * (high - low)))[0] - 1
    valleys = [int(a + path[a : b + 1].argmin()) for a, b in pairwise(peaks)]
    edges = [0, *valleys, len(path) - 1]
    return [_cycle(record, edges[k], int(peak), edges[k + 1]) for k, peak in enumerate(peaks)]


def _oriented(compression: Array, force: Array) -> tuple[Array, Array, list[str]]:
    """Return both columns with signs by which they increase with the load, and notes on that."""
    from scipy.stats import linregress

    notes = []
    quiet = float(np.median(np.sort(np.abs(force))[: max(1, len(force) // 10)]))
    if force.max() - quiet < -force.min() - quiet:
        force = -force
        notes.append("The sign of the force was reversed, so that compression is positive.")
    line = linregress(compression, force)
    if abs(line.slope) < _LEAST_SLOPE * line.stderr:
        raise InvalidValue(
            "force must rise with the compression beyond its noise, "
            f"got a slope of ({line.slope:.3g} ± {line.stderr:.2g}) N/m"
        )
    if line.slope < 0.0:
        compression = -compression
        notes.append("The sign of the compression was reversed: the force fell as it grew.")
    return compression, force, notes


def _cycle(record: Record, start: int, peak: int, end: int) -> Cycle:
    """Return a cycle around a peak, between the valleys (or ends) before and after it."""
    path = record.compression[start : end + 1]
    reach = max(_HELD_WITHIN * float(np.ptp(record.compression)), 4.0 * record.jitter)
    near = np.flatnonzero(path >= record.compression[peak] - reach) + start
    first, last = int(near[0]), int(near[-1])
    steps = np.abs(np.diff(path))
    step = float(np.median(steps)) or float(np.mean(steps))  # of a scale that shows coarse steps
    # points near the peak of a press that never stands still
    ramp = 2.0 * reach / step + 3.0 if step > 0.0 else 3.0
    if last - first + 1 > max(2.0 * ramp, _LEAST_POINTS - 1):
        held = record.compression[first : last + 1]
        level, error = float(np.median(held)), record.jitter / np.sqrt(len(held))
    else:
        first, last = peak, peak + 1
        level, error = _turn(path, peak - start, record.jitter)
    loading, unloading = (
        places if len(places) >= _LEAST_POINTS else places[:0]
        for places in (np.arange(start, first + 1), np.arange(last, end + 1))
    )
    return Cycle(loading, unloading, level, error)


def _turn(path: Array, peak: int, jitter: float) -> tuple[float, float]:
    """Return the compression at the turning point of a cycle, and its standard error.

    It is the peak point. If the noise exceeds half of the travel per point, it is where two
    straight lines meet, fitted to the points near the peak.
    """
    from scipy.ndimage import uniform_filter1d

    step = max(path[peak] - path[0], path[peak] - path[-1]) / max(peak, len(path) - 1 - peak)
    if jitter < 0.5 * step or step <= 0.0:
        return float(path[peak]), jitter
    reach = int(np.clip(8.0 * jitter / step, 4, 400))
    peak = int(np.argmax(uniform_filter1d(path, reach)))
    near = path[max(peak - reach, 0) : peak + reach + 1]
    since = np.arange(len(near)) - min(peak, reach)
    lines = np.stack([np.ones(len(near)), np.minimum(since, 0), np.maximum(since, 0)], axis=1)
    weights = np.linalg.pinv(lines)[0]
    return float(weights @ near), float(jitter * np.linalg.norm(weights))
