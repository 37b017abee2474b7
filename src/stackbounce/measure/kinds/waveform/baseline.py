"""The quiet parts of a record: level, drift, mains hum, noise."""

import math
from dataclasses import dataclass

import numpy as np

from stackbounce.measure.kinds.waveform.hum import Base, find_hum, fit_quiet
from stackbounce.measure.kinds.waveform.record import Record
from stackbounce.measure.quantities import Array, Mask
from stackbounce.measure.samples import quantisation_error
from stackbounce.measure.statistics.ar_noise import correlation_factor, difference_noise

_LEAST_QUIET = 0.25  # of a record that is quiet
_FAR = 0.2  # of a record's range: a clipped level that differs more from the ends is no baseline
_SPANNED = 0.8  # of a record that its quiet samples span, so that they tell of a drift
_FIFTH = 0.2  # of normal deviates that are within `_WITHIN_FIFTH`
_WITHIN_FIFTH = 0.2533  # standard deviations
_WITHIN_ONE = 0.683  # share of normal deviates within one standard deviation
_CLIPPED_BEYOND = 4.0  # standard deviations, in sigma clipping
_CLIPPING_ROUNDS = 4  # of sigma clipping


@dataclass(frozen=True, eq=False)
class Quiet:
    """The baseline of a record, and the noise around it.

    Parameters
    ----------
    base : Base
        A line, and the hum of the mains.
    noise : float
        Standard deviation of one sample.
    density : float
        Standard deviation of independent samples whose averages have the same error as averages of
        these: `noise` times the root of `correlation_factor`.
    error : float
        Of the baseline's level, one standard deviation.
    """

    base: Base
    noise: float
    density: float
    error: float


def first_guess(record: Record) -> tuple[float, float]:
    """Return a first estimate of level and noise of the quiet part, without knowing the contacts.

    The level is the median of the shortest interval that holds a quarter of all values.
    """
    values = record.values
    level = _densest(values)
    ends = np.concatenate([side[: max(3, len(values) // 50)] for side in (values, values[::-1])])
    limits = (values == values.max()) | (values == values.min())
    at_limit = level in (values.max(), values.min())
    if at_limit and not limits.all() and abs(np.median(ends) - level) > _FAR * np.ptp(values):
        level = _densest(values[~limits])  # clipped samples are as constant as a baseline
    fast = difference_noise(values, 1)
    slow = float(np.quantile(np.abs(values - level), _FIFTH)) / _WITHIN_FIFTH
    return level, max(fast, slow, _floor(record))


def _densest(values: Array) -> float:
    """Return the middle of the shortest range that holds a quarter of the values."""
    ordered = np.sort(values)
    count = min(max(3, int(_LEAST_QUIET * len(ordered))), len(ordered))
    widths = ordered[count - 1 :] - ordered[: len(ordered) - count + 1]
    at = int(np.argmin(widths))
    return float(np.median(ordered[at : at + count]))


def quiet_parts(record: Record, quiet: Mask, *, hum: bool) -> Quiet:
    """Return baseline and noise from the samples that are marked as quiet.

    Parameters
    ----------
    record : Record
        What was measured.
    quiet : ndarray of bool
        (n,) which samples belong to no contact.
    hum : bool
        Whether to look for hum.

    Returns
    -------
    Quiet
    """
    if quiet.sum() < 3:
        level, noise = first_guess(record)
        flat = Base(np.full(len(quiet), level), 1, np.zeros(len(quiet)))
        return Quiet(flat, noise, noise, noise)
    times = record.times - record.times[0]
    span = max(float(times[-1]), record.step)
    line = np.stack([np.ones_like(times), times / span - 0.5], axis=1)
    if np.ptp(np.flatnonzero(quiet)) < _SPANNED * len(quiet):
        line = line[:, :1]
    found = Base(fit_quiet(line, record.values, quiet), line.shape[1], np.zeros(len(quiet)))
    if hum:
        found = find_hum(line, times, record, quiet) or found
    rest = (record.values - found.values)[quiet]
    noise, density = scatter(rest, found.fitted, record.quantum)
    floor = _floor(record)
    noise, density = max(noise, floor), max(density, floor)
    error = float(np.hypot(density / np.sqrt(len(rest)), quantisation_error(record.quantum, noise)))
    return Quiet(found, noise, density, error)


def scatter(rest: Array, fitted: int, quantum: float) -> tuple[float, float]:
    """Return noise and density, see `Quiet`, from the residuals of a fit.

    Parameters
    ----------
    rest : ndarray
        (n,) quiet samples without their baseline.
    fitted : int
        How many numbers were fitted to them.
    quantum : float
        The step of the converter, 0 where none is seen.

    Returns
    -------
    (float, float)
    """
    noise = _robust(rest, quantum) * float(np.sqrt(len(rest) / max(1, len(rest) - fitted)))
    noise = max(noise, quantum / np.sqrt(12.0))
    return float(noise), float(noise * np.sqrt(correlation_factor(rest)))


def _robust(rest: Array, quantum: float) -> float:
    """Return the standard deviation after sigma clipping."""
    scale = float(np.quantile(np.abs(rest), _WITHIN_ONE)) + 0.5 * quantum
    for _ in range(_CLIPPING_ROUNDS):
        inside = rest[np.abs(rest) <= _CLIPPED_BEYOND * scale]
        if not len(inside) or not inside.any():
            break
        scale = float(np.sqrt(np.mean(inside**2)))
    return scale if rest.any() else 0.0


def _floor(record: Record) -> float:
    """Return the smallest possible noise: that of quantisation, or round-off."""
    return max(record.quantum / math.sqrt(12.0), 1e-6 * float(np.ptp(record.values)), 1e-300)
