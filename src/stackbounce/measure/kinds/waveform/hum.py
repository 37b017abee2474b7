"""Hum of the mains in the quiet parts of a record: whether there is one, and its fit."""

import math
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.waveform.record import Record
from stackbounce.measure.quantities import Array, Mask
from stackbounce.measure.statistics.ar_noise import correlation_factor

_MAINS = (50.0, 60.0)  # Hz
_SPREAD = 0.1  # Hz, standard deviation of the frequency
_LARGEST = 0.25  # of the largest value; what is higher is a contact
_BLOCK = 1e-3  # s, over which a hum hardly changes
_BLOCKS = 100  # of a short record
_LEAST_BLOCKS = 12  # quiet ones
_FALSE = 0.005  # probability of a hum in white noise
_DROOPS = np.geomspace(1e-4, 0.5, 60)  # of a force in a block, that are tried


class Base(NamedTuple):
    """A baseline: a line, alone or with a hum of half the range `height`, of `frequency` in Hz.

    `values` (n,) are those at each sample, and `leverage` (n,) is their standard error by the hum
    over that of a sample, 0 without a hum. `fitted` counts the unknowns.
    """

    values: Array
    fitted: int
    leverage: Array
    height: float = 0.0
    frequency: float = 0.0


def find_hum(line: Array, times: Array, record: Record, quiet: Mask) -> Base | None:
    """Return the baseline with its hum; None if the quiet samples show no significant one.

    Parameters
    ----------
    line : ndarray
        (n, k) columns of the baseline without hum.
    times : ndarray
        (n,) in s from the record's begin.
    record : Record
        What was measured.
    quiet : ndarray of bool
        (n,) which samples belong to no contact.

    Returns
    -------
    Base or None
    """
    tone = _tone(times, record, quiet)
    if not tone:
        return None
    columns, rows, weights = _fitted(line, times, tone, record.values, quiet)
    tone += float(weights[-1])
    columns, rows, weights = _fitted(line, times, tone, record.values, quiet)
    base = columns @ weights
    height = 0.5 * float(np.ptp(base - fit_quiet(line, base, quiet)))
    if height > _LARGEST * np.max(np.abs(record.values - base)):
        return None
    return Base(base, columns.shape[1], leverage(columns, rows), height, tone)


def _fitted(
    line: Array, times: Array, tone: float, values: Array, quiet: Mask
) -> tuple[Array, Array, Array]:
    """Return columns of line and hum at all samples, the rows of a fit of them, and their weights.

    The last column is the change with the frequency, the last row what is known of that.
    """
    main = min(_MAINS, key=lambda main: abs(main - tone))
    since = times - times[quiet].mean()
    columns = np.concatenate([line, _waves(since, tone)], axis=1)
    weights, rest = regression(columns[quiet], values[quiet])
    turned = columns[:, -1] * weights[-2] - columns[:, -2] * weights[-1]
    columns = np.column_stack([columns, 2.0 * np.pi * since * turned])
    known = np.append(np.zeros(columns.shape[1] - 1), np.std(rest) / _SPREAD)
    rows = np.vstack([columns[quiet], known])
    told = np.append(values[quiet], known[-1] * (main - tone))
    return columns, rows, regression(rows, told)[0]


def fit_quiet(columns: Array, values: Array, quiet: Mask) -> Array:
    """Return the linear regression on columns at all samples, fitted to the quiet ones."""
    return np.asarray(columns @ regression(columns[quiet], values[quiet])[0])


def regression(columns: Array, values: Array) -> tuple[Array, Array]:
    """Return the weights of a linear regression and its residuals."""
    weights = np.asarray(np.linalg.lstsq(columns, values, rcond=None)[0], dtype=np.float64)
    return weights, values - columns @ weights


def leverage(columns: Array, fitted: Array) -> Array:
    """Return the standard error of a regression over that of a sample, at rows of columns.

    `fitted` has the rows to which it is fitted.

    Examples
    --------
    >>> leverage(np.ones((2, 1)), np.ones((4, 1)))
    array([0.5, 0.5])
    """
    inverse = np.linalg.pinv(fitted.T @ fitted, hermitian=True)
    return np.asarray(np.sqrt(np.sum(columns * (columns @ inverse), axis=1)))


def _tone(times: Array, record: Record, quiet: Mask) -> float:
    """Return the frequency in Hz of a significant hum that no droop explains better, or 0."""
    span = float(times[-1])
    tones = _tones(span, record.step)
    width = max(1, int(min(_BLOCK, span / _BLOCKS) / record.step))
    count = len(times) // width * width
    t, y = (array[:count].reshape(-1, width).mean(axis=1) for array in (times, record.values))
    calm = np.asarray(quiet[:count].reshape(-1, width).all(axis=1))
    if not tones or calm.sum() < _LEAST_BLOCKS:
        return 0.0
    line = np.stack([np.ones_like(t), t], axis=1)
    best, rest = 0.0, regression(line[calm], y[calm])[1]
    straight = float(rest @ rest)
    for tone in tones:
        waves = np.concatenate([line, _waves(t, tone)], axis=1)
        left = regression(waves[calm], y[calm])[1]
        if left @ left < rest @ rest:
            best, rest = tone, left
    gain = 2.0 * math.log(len(tones) / _FALSE) * correlation_factor(rest)
    clear = rest @ rest < straight / (1.0 + gain / (len(rest) - 4))
    return best if clear and rest @ rest < _left_by_droop(line, y, calm) else 0.0


def _tones(span: float, step: float) -> list[float]:
    """Return the mains frequencies in Hz to try, in steps that the record resolves."""
    if step > 0.2 / _MAINS[1]:
        return []
    fine = np.linspace(-0.3, 0.3, int(min(31, 3 + 12 * span)))
    return [float(main + off) for main in _MAINS for off in fine]


def _left_by_droop(line: Array, values: Array, calm: Mask) -> float:
    """Return the least sum of squares that the droop of a piezo sensor leaves on a line."""
    from scipy.signal import lfilter

    force = np.where(calm, 0.0, values - np.median(values[calm]))
    lags = (lfilter([share], [1.0, share - 1.0], force) for share in _DROOPS)
    rests = (regression(line[calm], (values + lag)[calm])[1] for lag in lags)
    return min(float(rest @ rest) for rest in rests)


def _waves(times: Array, tone: float) -> Array:
    angle = 2.0 * np.pi * tone * times
    return np.stack([np.sin(angle), np.cos(angle)], axis=1)
