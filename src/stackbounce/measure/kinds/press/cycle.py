"""One cycle of a press record: its fits and works, with the covariance of all numbers."""

import math
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Branch
from stackbounce.measure.kinds.press.record import Cycle, Record
from stackbounce.measure.kinds.press.result import Press
from stackbounce.measure.quantities import Array, Mask, known_to
from stackbounce.measure.samples import quantisation_error, trapezoid
from stackbounce.measure.statistics.ar_noise import correlation_factor

# Limits that were set by what recovered the truth in simulated records (benchmarks/coverage/press).
_MOST_POINTS = 4000  # of a branch; a longer one is averaged in groups
_SLACK_MARGIN = 0.03  # of the peak compression: slack points are further from the contact
_LEAST_SLACK = 5  # points of slack from which the zero of the force is found
_TAIL = 0.05  # of the points in contact: their mean residual corrects the peak force
_LARGEST_POWER = 350.0  # logarithm of the stiffness's C**p, whose square a float can hold
_AVERAGED = 0.1  # of a branch, over which its residuals are averaged to see a misfit
_SMALL_MISFIT = 0.01  # of the peak force, below which a misfit does not matter
_LEAST_CORRELATED = 8  # points of a branch, whose residuals can tell a misfit as autocorrelation
_CLEAR_MISFIT = 2.5  # times what noise makes of it: up to it, the curve fits

_FIRST_EXPONENTS = (0.7, 1.0, 1.5, 2.0, 3.0)  # of the grid on which the fit's start is sought
_FIRST_CONTACTS = 48  # places of the contact on the same grid
# around it: of the contact, over the range of the compression, and the logarithm of the exponent
_NEAR = (-0.6, math.log(0.6)), (0.95, math.log(4.0))
_GRID_POINTS = 300  # of the curve that are compared on that grid, for speed
_LARGEST_LOG = 20.0  # of a parameter, so that no power overflows


class _Points(NamedTuple):
    """The points of a branch: compression, force, and the columns of the force's zero, (N, 0-2)."""

    x: Array
    y: Array
    zero: Array


class _Law(NamedTuple):
    """The power law of a branch: P, ln p, ln C, and C; of each point: residual, slopes, noise.

    The slopes (N, 3) are the derivatives of the curve by P, ln p and ln C; the noise is relative.
    """

    values: Array
    length: float
    residual: Array
    slopes: Array
    noise: Array


def result_of(record: Record, cycle: Cycle) -> Press:
    """Return what one cycle with a loading gives, without its notes.

    Parameters
    ----------
    record : Record
        The whole record.
    cycle : Cycle
        With points in its loading.

    Returns
    -------
    Press
    """
    from uncertainties import correlated_values, umath

    peak = cycle.peak
    up, down, (levels, weights, unseen) = _branches(record, cycle)
    contact, exponent = _rough_contact(up.x, up.y)
    length = max(peak - contact, 1e-3 * float(np.ptp(up.x)))
    law = _fitted(record, up, peak, np.array([up.y[-1], np.log(exponent), np.log(length)]), 3)
    _refuse_strange(law, up.x > peak - law.length, record)
    # the noise of the slack is that of the whole loading, which shows its autocorrelation better
    spread = _density(law, 3) * law.noise.min() ** 2 * weights @ weights.T
    seen = correlated_values(levels, spread) if len(levels) else ()
    zero = [value + known_to(0.0, unseen) for value in seen]
    known = list(zip(up.zero.T, zero, strict=True))
    top, log_p, log_c, at_top, worked, steeper = _numbers(law, _sums_in(up, peak, law), 3, known)
    p, c = umath.exp(log_p), umath.exp(log_c)
    length = c + known_to(0.0, cycle.peak_error)
    stiffness = top / c**p
    top = stiffness * length**p
    found = {
        "stiffness": stiffness,
        "exponent": p,
        "linear_stiffness": 3.0 * top / ((p + 2.0) * length) + steeper,
        "peak_compression": length,
        "peak_force": top + at_top,
        "tangent_stiffness": p * top / length,
        "secant_stiffness": (top + at_top) / length,
        "work_in": top * length / (p + 1.0) + worked,
        "contact": peak - c,
        "zero": zero[0] if zero else known_to(0.0, 0.0),
        "loading": _curve("pressed in", up, law, peak - law.length, law.values[0]),
    }
    if not len(down.x):
        return Press(**found)
    back = _fitted(record, down, peak, np.array([down.y[0], np.log(2.0), law.values[2]]), 2)
    known = [*zip(down.zero.T, zero, strict=True), (back.slopes[:, 2], log_c)]
    end, log_n, worked = _numbers(back, _sum_out(down, peak, law), 2, known)
    n = umath.exp(log_n)
    end = end * (length / c) ** n
    kept = (end * length / (n + 1.0) + worked) / found["work_in"]
    more = {"work_out": kept * found["work_in"], "loss": 1.0 - kept, "relaxed": top - end}
    if kept.nominal_value > 0.0:
        more |= {"restitution": kept**0.5, "energy_exponent": (p + 1.0) / kept - 1.0}
    curve = _curve("let go", down, back, peak - law.length, law.values[0])
    return Press(**found, **more, unloading_exponent=n, unloading=curve)


def _branches(record: Record, cycle: Cycle) -> tuple[_Points, _Points, tuple[Array, Array, float]]:
    """Return loading and unloading less the force's zero, and that.

    It is the mean of the slack, or a line in time with slack before and after. Without slack it is
    taken as recorded. The numbers of the zero come with the weights of the slack's points in them,
    and with the error of their rounding.
    """
    time = np.arange(float(len(record.force)))
    both = [
        [_averaged(column[places]) for column in (record.compression, record.force, time)]
        for places in (cycle.loading, cycle.unloading)
    ]
    (x, y, time), count = np.concatenate(both, axis=1), len(both[0][0])
    contact, _ = _rough_contact(x[:count], y[:count])
    slack = x < contact - max(_SLACK_MARGIN * (cycle.peak - contact), 3.0 * record.jitter)
    before, after = (part.sum() >= _LEAST_SLACK for part in (slack[:count], slack[count:]))
    line = np.stack([np.ones(len(x)), (time - time.mean()) / np.ptp(time)], axis=1)
    line = line[:, : int(before) + int(before and after)]
    weights = np.linalg.pinv(line[slack])
    levels = weights @ y[slack]
    y = y - line @ levels
    unseen = quantisation_error(record.step, float(y[slack].std())) if len(levels) else 0.0
    up = _Points(x[:count], y[:count], line[:count])
    return up, _Points(x[count:], y[count:], line[count:]), (levels, weights, unseen)


def _averaged(values: Array) -> Array:
    """Return the points of a branch, averaged in groups if there are many."""
    edges = np.arange(0, len(values), max(1, -(-len(values) // _MOST_POINTS)))
    return np.asarray(np.add.reduceat(values, edges) / np.diff(np.append(edges, len(values))))


def _fitted(record: Record, branch: _Points, peak: float, first: Array, free: int) -> _Law:
    """Return the fit of a branch, in which points weigh as their noise.

    That is the noise of the force, and that of the compression times the slope.
    """
    values, scale = first, np.ones(len(branch.x))
    values[0] = max(values[0], 0.1 * float(np.ptp(branch.y)))
    for _ in range(2):
        values = _fit_power_law(branch.x, branch.y, peak, values, free, scale)
        top, (p, c) = values[0], np.exp(values[1:])
        slope = top * p / c * _power(1.0 - (peak - branch.x) / c, max(p - 1.0, 0.0))
        noise = np.hypot(record.hiss, slope * record.jitter)
        if 0.0 < noise.max() < np.inf:
            scale = np.maximum(noise / noise.max(), 1e-3)
    force, slopes = _power_law(branch.x, peak, values)
    return _Law(values, float(np.exp(values[2])), branch.y - force, slopes, scale)


def _refuse_strange(law: _Law, touched: Mask, record: Record) -> None:
    """Refuse a loading of no point in contact, or whose ``C**p`` no float holds."""
    _, log_p, log_c = np.abs(law.values)
    held = max(log_p, log_c) < _LARGEST_LOG and log_c * np.exp(law.values[1]) < _LARGEST_POWER
    if held and touched.any():
        return
    span = f"{np.ptp(record.compression):.3g} m and {np.ptp(record.force):.3g} N"
    raise InvalidValue(
        f"a press curve must follow a power law in numbers of a finite size, got {span}: are "
        "the columns and their units right?"
    )


def _numbers(law: _Law, sums: Array, free: int, known: list[tuple[Array, Any]]) -> Any:
    """Return the fitted parameters and sums over the residuals, with errors and correlations.

    To first order each is a linear function of the noise of the points; its weights are a row. The
    noise is that of the residuals, with their autocorrelation. Numbers that were `known` before,
    each with the derivatives of the curve by it, have errors of their own.
    """
    from uncertainties import correlated_values

    jacobian, noise = law.slopes[:, :free], law.noise
    rows = np.linalg.pinv(jacobian / noise[:, None], rcond=1e-11) / noise
    rows = np.concatenate([rows, sums - (sums @ jacobian) @ rows])
    covariance = _density(law, free) * (rows * noise) @ (rows * noise).T
    values = np.append(law.values[:free], sums @ law.residual)
    found = np.array(correlated_values(values, covariance))
    for slopes, number in known:
        found = found - (rows @ slopes) * (number - number.nominal_value)
    return found


def _density(law: _Law, free: int) -> float:
    """Return the variance of independent noise, relative to `noise`, that has the same effect."""
    left = law.residual / law.noise
    variance = float(left @ left) / max(len(left) - free, 1)
    return variance * correlation_factor(left, _LEAST_CORRELATED)


def _sums_in(up: _Points, peak: float, law: _Law) -> Array:
    """Return weights of the residuals that correct the loading's law, (3, N).

    They correct the force at the peak, the work, and the slope of the straight line through the
    contact.
    """
    inside = np.flatnonzero(up.x > peak - law.length)
    tail = inside[-max(3, int(_TAIL * len(inside))) :]
    sums = np.zeros((3, len(up.x)))
    sums[0, tail] = 1.0 / len(tail)
    sums[1, inside[0] :] = trapezoid(up.x[inside[0] :])
    sums[2] = sums[1] * (up.x - peak + law.length) * 3.0 / law.length**3
    return sums


def _sum_out(down: _Points, peak: float, law: _Law) -> Array:
    """Return weights of the residuals that correct the work of the unloading's law, (1, N)."""
    sums = np.zeros((1, len(down.x)))
    inside = np.flatnonzero((down.x > peak - law.length) & (down.x < peak))
    if len(inside):
        part = slice(inside[0], inside[-1] + 1)
        sums[0, part] = -trapezoid(down.x[part])
    return sums


def _curve(label: str, branch: _Points, law: _Law, contact: float, peak: float) -> Branch:
    """Return a branch with its fit, and by how much that is off beyond the noise."""
    from scipy.ndimage import uniform_filter1d

    width = max(3, int(_AVERAGED * len(branch.x)))
    smooth = uniform_filter1d(law.residual, width)
    off, rest = (float(np.sqrt(np.mean(part**2))) for part in (smooth, law.residual - smooth))
    share = off / peak if peak > 0.0 else np.inf
    fits = share < _SMALL_MISFIT or off < _CLEAR_MISFIT * rest / np.sqrt(width)
    return Branch(label, branch.x - contact, branch.y, branch.y - law.residual, share, fits)


def _power(ratio: Array, exponent: float) -> Array:
    """Return a ratio to a power, 0 where it is not above 0.

    Examples
    --------
    >>> _power(np.array([-1.0, 0.0, 0.25]), 1.5)
    array([0.   , 0.   , 0.125])
    """
    return np.power(ratio, exponent, out=np.zeros_like(ratio), where=ratio > 0.0)


def _rough_contact(x: Array, y: Array) -> tuple[float, float]:
    """Return rough values of the contact and the exponent, independent of the force's zero.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression and force of a loading.

    Returns
    -------
    tuple of float
    """
    some = np.linspace(0, len(x) - 1, min(len(x), _GRID_POINTS)).astype(int)
    x, y = x[some], y[some]
    low, high = float(x.min()), float(x.max())
    places = np.linspace(low - 0.5 * (high - low), high - 0.1 * (high - low), _FIRST_CONTACTS)
    best = (np.inf, low, 1.0)
    dy = y - y.mean()
    for p in _FIRST_EXPONENTS:
        rise = _power((x[None, :] - places[:, None]) / (high - low), p)
        rise -= rise.mean(axis=1, keepdims=True)
        square = (rise**2).sum(axis=1) + 1e-300
        along = rise @ dy
        rest = dy @ dy - np.where(along > 0.0, along**2 / square, 0.0)
        i = int(rest.argmin())
        if rest[i] < best[0]:
            best = (float(rest[i]), float(places[i]), p)
    _, contact, exponent = best
    if exponent < 1.0:  # a curve that bends down is no power law from the contact on
        return contact, exponent
    return _refined_contact(x, y, contact, exponent)


def _refined_contact(x: Array, y: Array, contact: float, exponent: float) -> tuple[float, float]:
    """Return the contact and the exponent that fit best, near rough ones."""
    from scipy.optimize import least_squares

    start, span = float(x.min()), float(np.ptp(x))
    places, heights = (x - start) / span, (y - y.mean()) / np.ptp(y)

    def rest(unknown: Array) -> Array:
        rise = _power(places - unknown[0], math.exp(unknown[1]))
        basis = np.column_stack([np.ones_like(rise), rise])
        return np.asarray(heights - basis @ np.linalg.lstsq(basis, heights, rcond=None)[0])

    first = (contact - start) / span, math.log(exponent)
    found = least_squares(rest, first, bounds=_NEAR, x_scale=0.1)
    return start + span * float(found.x[0]), math.exp(found.x[1])


def _power_law(x: Array, peak: float, values: Array) -> tuple[Array, Array]:
    """Return ``P ((x - peak + C)/C)**p``, and its derivatives by P, ln p and ln C.

    Parameters
    ----------
    x : ndarray
        (N,) compression.
    peak : float
        Where the force is P.
    values : ndarray
        P, ln p and ln C.

    Returns
    -------
    force : ndarray
        (N,).
    jacobian : ndarray
        (N, 3).
    """
    top, p, c = values[0], *np.exp(np.clip(values[1:], -_LARGEST_LOG, _LARGEST_LOG))
    ratio = 1.0 - (peak - x) / c
    unit = _power(ratio, p)
    by_exponent = top * p * unit * np.log(np.where(ratio > 0.0, ratio, 1.0))
    by_length = top * p * _power(ratio, p - 1.0) * (1.0 - ratio)
    return top * unit, np.column_stack([unit, by_exponent, by_length])


def _fit_power_law(x: Array, y: Array, peak: float, first: Array, free: int, scale: Array) -> Array:
    """Return P, ln p and ln C of the `_power_law` that fits points best.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression, and force less its zero.
    peak : float
        Where the force is P.
    first : ndarray
        P, ln p and ln C to start from.
    free : int
        How many of them are fitted: 3, or 2 where C is known.
    scale : ndarray
        (N,) relative noise of the points.
    """
    from scipy.optimize import least_squares

    def curve(values: Array) -> tuple[Array, Array]:
        return _power_law(x, peak, np.append(values, first[free:]))

    solved = least_squares(
        lambda values: (curve(values)[0] - y) / scale,
        first[:free],
        jac=lambda values: curve(values)[1][:, :free] / scale[:, None],
        method="lm",
        xtol=1e-10,
        ftol=1e-12,
        max_nfev=300,
    )
    values = np.append(solved.x, first[free:])
    return np.append(values[0], np.clip(values[1:], -_LARGEST_LOG, _LARGEST_LOG))
