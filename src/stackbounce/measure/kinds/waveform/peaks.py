"""The peaks of a contact, their heights, and its impulse."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.waveform.intervals import smoothed
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import runs, trapezoid

_AVERAGES = 60  # moving averages over a contact, at least
_CLEAR_DIP = 7.0  # noise levels between a peak and the dip beside it
_LEAST_DIP = 0.02  # of the highest peak, between a peak and the dip beside it
_CAP = 0.82  # of a peak's height, above which its cap is fitted
_DEGREE = 4  # of the polynomial through a cap
_FLAT = 3  # equal samples that make a flat top
_JUST_BELOW = 0.15  # of the number of samples of a clipped top, at most, are one step below it


class Peak(NamedTuple):
    """A maximum of the force: time in s, height and its error in the record's unit."""

    time: float
    time_error: float
    force: float
    force_error: float


def find_peaks(times: Array, values: Array, noise: float, density: float) -> list[Peak]:
    """Return the peaks of one contact, from its touch to its release, in order.

    Parameters
    ----------
    times, values : ndarray
        (n,) of the contact with a little of the baseline on both sides, contacts upward.
    noise, density : float
        See `Quiet`.

    Returns
    -------
    list of Peak
        At least one. A dip between two peaks is at least 7 noise levels of the averages deep, and
        2 % of the highest peak.

    Examples
    --------
    >>> times = np.linspace(0.0, 1.0, 101)
    >>> found = find_peaks(times, np.sin(np.pi * times) ** 2, 1e-3, 1e-3)
    >>> [(round(peak.time, 2), round(peak.force, 2)) for peak in found]
    [(0.5, 1.0)]
    """
    from scipy.signal import find_peaks as maxima

    width = 2 * (len(values) // _AVERAGES // 2) + 1
    even = np.maximum(smoothed(values, width), 0.0)  # noise below zero is no dip
    calm = density / np.sqrt(width)
    padded = np.concatenate([[0.0], even, [0.0]])
    stand_out = max(_CLEAR_DIP * max(calm, noise / width), _LEAST_DIP * float(even.max()))
    tops = maxima(padded, prominence=stand_out)[0] - 1
    if not len(tops):
        tops = np.array([int(np.argmax(even))])
    dips = [int(a + np.argmin(even[a:b])) for a, b in pairwise(tops)]
    edges = [0, *dips, len(even) - 1]
    rooms = zip(tops.tolist(), pairwise(edges), strict=True)
    return [_cap(times, values, even, top, room, density) for top, room in rooms]


def _cap(
    times: Array, values: Array, even: Array, top: int, room: tuple[int, int], density: float
) -> Peak:
    """Return time and height of a peak by a polynomial through its cap."""
    starts, ends = runs(even > _CAP * even[top])
    k = int(np.searchsorted(starts, top, "right")) - 1
    low, high = max(int(starts[k]), room[0]), min(int(ends[k]), room[1])
    if high - low < 2:  # one sample on each side at least
        low, high = max(top - 1, 0), min(top + 1, len(even) - 1)
    count = high + 1 - low
    middle, half = times[top], max(0.5 * (times[high] - times[low]), 1e-300)
    degree = min(_DEGREE, max(2, (count - 1) // 2), count - 1)
    if degree < 2:
        return Peak(float(middle), float(half), float(values[top]), density)
    u = (times[low : high + 1] - middle) / half
    part = values[low : high + 1]
    weights, cover = np.polyfit(u, part, degree, cov="unscaled")
    freedom = count - degree - 1
    rest = part - np.polyval(weights, u)
    sigma = max(density, float(np.sqrt(np.sum(rest**2) / freedom)) if freedom > 4 else 0.0)
    fine = np.linspace(u[0], u[-1], 401)
    curve = np.polyval(weights, fine)
    best = int(np.argmax(curve))
    at = np.vander(fine[[best]], degree + 1)[0]
    slope = np.append(np.arange(degree, 0, -1) * at[1:], 0.0)
    bend = float(np.polyval(np.polyder(weights, 2), fine[best]))
    shift = sigma * np.sqrt(slope @ cover @ slope) / max(abs(bend), 1e-300)
    return Peak(
        float(middle + half * fine[best]),
        float(half * min(shift, 1.0)),
        float(curve[best]),
        float(sigma * np.sqrt(at @ cover @ at)),
    )


def impulse_of(
    times: Array, values: Array, density: float, offset: float, ends: tuple[float, float]
) -> tuple[float, float]:
    """Return the area under the force between two times, and its error.

    Parameters
    ----------
    times, values : ndarray
        (n,) of the contact and a little more, contacts upward.
    density, offset : float
        Noise of one sample as in `Quiet`; error of the baseline.
    ends : (float, float)
        From the touch to the release, in s.

    Returns
    -------
    (float, float)
        In s times the values' unit. The error includes that of the trapezoidal rule at the kinks
        where the force begins and ends.

    Examples
    --------
    >>> times = np.linspace(-0.1, 1.1, 121)
    >>> force = np.sin(np.pi * np.clip(times, 0.0, 1.0))
    >>> area, error = impulse_of(times, force, 0.0, 0.0, (0.0, 1.0))
    >>> abs(area - 2.0 / np.pi) < 2.0 * error < 1e-4
    True
    """
    # from the last sample before the touch to the first one after the release
    first = max(int(np.searchsorted(times, ends[0], "right")) - 1, 0)
    last = max(first, min(int(np.searchsorted(times, ends[1], "left")), len(times) - 1))
    t, f = times[first : last + 1], values[first : last + 1]
    steps = np.diff(t)
    weights = trapezoid(t)
    slopes = np.abs(np.diff(f)) / np.maximum(steps, 1e-300)
    bends = (slopes[:2].max(), slopes[-2:].max()) if len(slopes) > 1 else (0.0, 0.0)
    rule = np.square(np.max(steps)) / 12.0 * np.hypot(*bends) if len(steps) else 0.0
    own = density * np.sqrt(np.sum(weights**2))
    level = offset * (t[-1] - t[0])
    return float(np.sum(weights * f)), float(np.sqrt(own**2 + level**2 + rule**2))


def flat_top(values: Array, quantum: float) -> bool:
    """Return whether a contact is clipped: its top samples are equal, with hardly any just below.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, np.pi, 50))
    >>> flat_top(wave, 0.0), flat_top(np.minimum(wave, 0.8), 0.0)
    (False, True)
    """
    top = float(values.max())
    step = quantum or 1e-9 * abs(top)
    at = values >= top - 0.5 * step  # the top itself, however small the step is
    first, last = runs(at)
    if (last - first + 1).max() < _FLAT:
        return False
    below = (values > top - 1.5 * step) & ~at
    return bool(below.sum() <= _JUST_BELOW * at.sum())
