"""The change point at which one curve departs from another: the force under a stack of balls."""

import math
from typing import NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array

_AVERAGED = 0.06  # of the contact time alone: averages before a slope or a maximum is taken
_END = 0.6  # of the largest departure: where it is reached the fit ends
_LATEST_END = 0.9  # of the contact time alone: later forces are too small
_TIMES = 110  # change points on the grid
# Priors of the departure's exponent and bend: those of simulated stacks with floors that are
# springs, Hertz's, hysteretic or viscous, restitutions from 0.7, upper masses of 0.08 to 0.6 of the
# lower one, and contacts between the balls that last 0.6 to 1.1 times as long as the floor's.
_POWERS = np.linspace(2.0, 4.8, 9)  # exponents on the grid
_POWER = 4.4  # mean exponent of a departure at the touch
_POWER_CHANGE = -2.15  # of that mean over the contact time
_POWER_ERROR = 0.4  # standard deviation
_BENDS = np.linspace(-0.85, 0.15, 6)  # bends on the grid
_BEND = -0.78  # mean bend of a departure at the touch
_BEND_CHANGE = 0.69  # of that mean over the contact time
_BEND_ERROR = 0.16  # standard deviation
_REPEATED_WITHIN = 0.02  # relative: how well the force repeats in two drops from one height
_ROUNDS = 2  # of fits, each with the shift and gain of the one before
_LATE = (0.6, 1.25)  # of the contact time alone: where a second ball changes the force most
_GAIN_ERROR = 0.005  # relative, of the force under the ball alone that is matched to the stack's
_LEAST_PRESS = 5.0  # standard errors of the force late in the contact that tell a second ball
_LEAST_GAIN = 25.0  # decrease of χ² that a departure must give


class Kink(NamedTuple):
    """The change point, in s since the stack's first touch, and the fit it comes from.

    Parameters
    ----------
    time, error : float
        Of the change point; NaN where there is none.
    shift, gain : float
        By which the force under the lowest ball alone was shifted, in s, and multiplied, to match
        that under the stack.
    pressed : bool
        Whether the force under the stack is the larger one late in the contact.
    """

    time: float
    error: float
    shift: float
    gain: float
    pressed: bool


def find_kink(
    times: Array, force: Array, alone: tuple[Array, Array], noise: float, lasting: float
) -> Kink:
    """Return when a second ball begins to act on the force under the first one.

    Parameters
    ----------
    times, force : ndarray
        (n,) of the stack's record, in s since its first touch.
    alone : (ndarray, ndarray)
        The same of the record of the lowest ball alone.
    noise : float
        Of the difference of the two, for one sample of the stack's record.
    lasting : float
        The contact time alone, in s.

    Returns
    -------
    Kink

    Notes
    -----
    Until the second ball touches, both forces are the same up to a shift in time and a gain. Then
    its force grows like ``u**p`` with the time u since its touch. Integrated twice, the
    displacement of the lower ball, and with it the floor's force, departs like ``u**(p + 2)`` at
    first and less steeply later. Change point, exponent and bend run over a grid. Gain, shift and
    size of the departure are fitted by linear regression at each grid point. The change point is
    the posterior mean over the grid.
    """
    from scipy.signal import savgol_filter

    step = float(np.median(np.diff(alone[0])))
    width = min(2 * max(2, int(0.5 * _AVERAGED * lasting / step)) + 1, len(alone[1]))
    slope = savgol_filter(alone[1], width, 2, deriv=1, delta=step)
    shift, gain = 0.0, 1.0
    time, error, until = math.nan, math.nan, lasting
    for _ in range(_ROUNDS):
        departure = force - gain * np.interp(times - shift, *alone)
        until = _until(times, departure, lasting)
        used = (times > -0.1 * lasting) & (times < until)
        at = times[used] - shift
        known = np.stack([np.interp(at, *alone), -np.interp(at, alone[0], slope)], axis=1)
        time, error, gain, moved = _search(times[used], force[used], known, noise, (until, lasting))
        shift += moved / gain
    like = gain * np.interp(times - shift, *alone)
    return Kink(time, error, shift, gain, _pressed(times / lasting, force, like, noise))


def _pressed(share: Array, force: Array, like: Array, noise: float) -> bool:
    """Return whether a force is significantly larger than another late in the contact."""
    late = (share > _LATE[0]) & (share < _LATE[1])
    own = noise / math.sqrt(max(late.sum(), 1))
    error = math.hypot(own, _GAIN_ERROR * float(like[late].mean()))
    return float((force - like)[late].mean()) > _LEAST_PRESS * error


def _until(times: Array, departure: Array, lasting: float) -> float:
    """Return when the departure has grown to a part of its largest value."""
    width = max(1, int(_AVERAGED * lasting / (times[1] - times[0])))
    even = np.convolve(departure, np.ones(width) / width, mode="same")
    inside = (times > 0.0) & (times < 1.2 * lasting)
    top = float(even[inside].max())
    large = np.flatnonzero(inside & (even >= _END * top))
    return float(np.clip(times[large[0]], 0.3 * lasting, _LATEST_END * lasting))


def _search(
    times: Array, force: Array, known: Array, noise: float, ends: tuple[float, float]
) -> tuple[float, float, float, float]:
    """Search the grid; return the change point, its error, the gain, and shift times gain."""
    rows = np.concatenate([known / noise, [[1.0 / _REPEATED_WITHIN, 0.0]]])
    base, _ = np.linalg.qr(rows)
    right = np.append(force / noise, 1.0 / _REPEATED_WITHIN)
    left = right - base @ (base.T @ right)
    without = float(left @ left)
    until, lasting = ends
    tried = np.linspace(0.0, 0.95 * until, _TIMES)
    since = np.maximum(times[:, None] - tried, 0.0) / (until - tried)
    powers = _POWER + _POWER_CHANGE * tried / lasting
    bends = _BEND + _BEND_CHANGE * tried / lasting
    bend = _BENDS[:, None]
    decreases = []
    for power in _POWERS:
        rise = since**power / noise
        both = _padded(np.hstack([rise, rise * since]))
        plain, bent = np.hsplit(both - base @ (base.T @ both), 2)  # beside gain and shift
        along = left @ plain, left @ bent
        size = np.sum(plain**2, axis=0), np.sum(plain * bent, axis=0), np.sum(bent**2, axis=0)
        prior = ((power - powers) / _POWER_ERROR) ** 2 + ((bend - bends) / _BEND_ERROR) ** 2
        pressing = np.maximum(along[0] + bend * along[1], 0.0)
        whole = size[0] + 2.0 * bend * size[1] + bend**2 * size[2]
        decreases.append(pressing**2 / np.maximum(whole, 1e-300) - prior)
    table = without - np.array(decreases)  # (exponents, bends, times)
    least = float(table.min())
    i, j, k = (int(place) for place in np.unravel_index(int(table.argmin()), table.shape))
    best = _padded(since[:, [k]] ** _POWERS[i] * (1.0 + _BENDS[j] * since[:, [k]]) / noise)
    seen = without - least > _LEAST_GAIN
    gain, moved, *_ = np.linalg.lstsq(np.hstack([rows, best][: 1 + seen]), right, rcond=None)[0]
    if not seen:
        return math.nan, math.nan, float(gain), float(moved)
    weights = np.exp(-0.5 * (table - least) / max(1.0, least / max(len(times) - 6, 1)))
    each = weights.sum((0, 1)) / weights.sum()
    mean = float(each @ tried)
    error = math.hypot(math.sqrt(each @ (tried - mean) ** 2), (tried[1] - tried[0]) / math.sqrt(12))
    return mean, error, float(gain), float(moved)


def _padded(columns: Array) -> Array:
    """Return columns with a row of zeros, which stands for the prior of the gain."""
    return np.concatenate([columns, np.zeros((1, columns.shape[1]))])
