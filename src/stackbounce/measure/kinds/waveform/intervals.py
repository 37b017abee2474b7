"""The intervals of a record in which the signal exceeds the noise: its contacts."""

from dataclasses import dataclass

import numpy as np

from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import runs

_ABOVE_NOISE = 6.0  # noise levels, which noise does not reach in a million samples
_FOLLOWED_TO = 3.0  # noise levels to which a contact is followed down
_RINGING = 0.01  # of the highest peak, below which things are ringing
_AVERAGES = 25  # moving averages over a contact
_LEAST_SAMPLES = 3  # of the shortest contact
# Of contacts, half sines to very lossy ones, and of square waves and exponentials, by hand:
_LEAST_JUDGED = 40  # samples of a stretch whose shape is judged
_BETWEEN = 0.04  # share of samples from 1/4 to 3/4 of the height; half a sine has 0.38
_EDGES = 3  # samples from 1/4 to 3/4 of the height, at least, of a contact that is clipped
_JUMP = 0.05  # of the fall's length, the longest rise of a jump
_FADED = 0.1  # of its height, to which a fall is followed
_CONVEX = 0.4  # mean of a fall over its height; at 0.5 % noise an exponential has up to 0.3985, the
# dashpot of restitution 0.1 mostly 0.402 to 0.415, and a straight line 0.55
_FALL_AVERAGES = 50  # moving averages over the samples of a fall
_MOST_SAMPLES = 20_001  # of a contact, as far as they set the width of the averages


@dataclass(frozen=True)
class Stretch:
    """Samples from `first` to `last`, both above the noise."""

    first: int
    last: int

    def __len__(self) -> int:
        """Return the number of samples."""
        return self.last - self.first + 1


def smoothed(values: Array, width: int) -> Array:
    """Return moving averages over an odd number of samples; over fewer at the ends.

    Examples
    --------
    >>> smoothed(np.array([0.0, 3.0, 0.0, 0.0]), 3)
    array([1.5, 1. , 1. , 0. ])
    """
    import pandas as pd

    return np.asarray(pd.Series(values).rolling(max(width, 1), center=True, min_periods=1).mean())


def which_sign(signal: Array, noise: float) -> int:
    """Return +1 if the larger part of the signal above the noise is upward, else -1."""
    out = np.where(np.abs(signal) > _ABOVE_NOISE * noise, signal, 0.0)
    up, down = np.sum(out[out > 0.0] ** 2), np.sum(out[out < 0.0] ** 2)
    return -1 if down > up else 1


def no_contact(force: Array, *, clipped: bool = False) -> bool:
    """Return whether a stretch is no contact of a ball: a square wave, or a jump that fades out.

    A contact that is clipped low is nearly square, but its flanks have some samples.

    Examples
    --------
    >>> phase = np.linspace(0.0, np.pi, 200)
    >>> no_contact(np.ones(200)), no_contact(np.exp(-phase)), no_contact(np.sin(phase))
    (True, True, False)
    """
    width = 2 * (int(np.sum(force > _FADED * force.max())) // _FALL_AVERAGES) + 1
    even = smoothed(force[int(np.argmax(force > 0.5 * force.max())) :], width)  # after the rise
    top = int(np.argmax(even))
    fall = even[top : int(np.flatnonzero(even >= _FADED * even[top])[-1]) + 1]
    mean = float(np.trapezoid(fall)) / max(len(fall) - 1, 1)
    fades = top <= _JUMP * len(fall) and mean < _CONVEX * even[top]
    level = float(np.quantile(force, 0.9))
    between = int(np.sum((force > 0.25 * level) & (force < 0.75 * level)))
    square = between < (_EDGES if clipped else _BETWEEN * len(force))
    return len(force) >= _LEAST_JUDGED and bool(fades or square)


def find_stretches(signal: Array, noise: float, density: float) -> tuple[list[Stretch], int]:
    """Return the stretches above the noise, and how many were too short.

    They rise above 6 noise levels and 1 % of the highest peak.

    Parameters
    ----------
    signal : ndarray
        (n,) without its baseline, contacts upward.
    noise, density : float
        Of one sample, and of averages, see `Quiet`.

    Returns
    -------
    list of Stretch
        In order.
    int
        How many peaks of one or two samples were left out.
    """
    least = _RINGING * float(signal.max())
    rough = _runs(signal, noise, max(_ABOVE_NOISE * noise, least), 2)
    wide = np.sort([len(interval) for interval in _longer(rough, _LEAST_SAMPLES)])
    if not len(wide):
        return [], len(rough)
    # the median length by samples, as noise breaks the flanks of long contacts into short pieces
    usual = int(wide[np.searchsorted(np.cumsum(wide), 0.5 * wide.sum())])
    width = 2 * (min(usual, _MOST_SAMPLES) // _AVERAGES // 2) + 1
    if width == 1:
        return _longer(rough, _LEAST_SAMPLES), len(rough) - len(wide)
    calm = density / np.sqrt(width)
    found = _runs(smoothed(signal, width), calm, max(_ABOVE_NOISE * calm, least), width)
    return _longer(found, _LEAST_SAMPLES + width), len(rough) - len(wide)


def _longer(intervals: list[Stretch], least: int) -> list[Stretch]:
    return [interval for interval in intervals if len(interval) >= least]


def _runs(signal: Array, noise: float, high: float, join: int) -> list[Stretch]:
    """Return runs above the noise that reach `high`; those up to `join` samples apart are one."""
    starts, ends = runs(signal > min(_FOLLOWED_TO * noise, 0.5 * high))
    if not len(starts):
        return []
    tops = np.maximum.reduceat(signal, np.stack([starts, ends + 1], 1).ravel()[:-1])[::2]
    kept = tops > high
    found: list[Stretch] = []
    for start, end in zip(starts[kept].tolist(), ends[kept].tolist(), strict=True):
        if found and start - found[-1].last <= join:
            found[-1] = Stretch(found[-1].first, end)
        else:
            found.append(Stretch(start, end))
    return found
