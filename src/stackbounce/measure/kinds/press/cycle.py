"""One cycle of a press record: its fits and works, with the covariance of all numbers."""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds.press.branches import Cycle, Record
from stackbounce.measure.kinds.press.fits import (
    PowerFit,
    fit_power_law,
    power,
    power_law,
    rough_contact,
)
from stackbounce.measure.kinds.press.result import Curve, Press
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import quantisation_error, trapezoid
from stackbounce.measure.statistics.ar_noise import noise_covariance

# Limits that were set by what recovered the truth in simulated records (benchmarks/coverage/press).
_MOST_POINTS = 4000  # of a branch; a longer one is averaged in groups
_SHARED_NOISE = 1.5  # largest ratio of the residuals of two branches that share one noise model
_EQUAL_WEIGHTS = 0.9  # smallest over largest noise of the points, above which all weigh the same
_SLACK_MARGIN = 0.03  # of the peak compression: slack points are further from the contact
_LEAST_SLACK = 5  # points of slack from which the zero of the force is found
_TAIL = 0.05  # of the points in contact: their mean residual corrects the peak force
_LARGEST_LOG = 700.0  # of the stiffness's C**p, whose size a float can hold
_WAVES = 9  # degree of the polynomial that makes up the smooth part of residuals
_SMALL_MISFIT = 0.01  # of the peak force, below which the smooth part does not matter
_CLEAR_MISFIT = 5.0  # times what noise adds to the smooth part: up to it, the curve fits


class _Branch(NamedTuple):
    """The points of a branch: compression, force, place in the record.

    `first` is the place of the first one among all points, those of the loading being before those
    of the unloading.
    """

    first: int
    x: Array
    y: Array
    time: Array


class _Number(NamedTuple):
    """A number, and its derivatives (N,) by the noise of all points, those of the loading first."""

    value: float
    row: Array


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
    up = _branch(record, cycle.loading, 0)
    down = _branch(record, cycle.unloading, len(up.x))
    contact, exponent = rough_contact(up.x, up.y)
    zero = _zero(up, down, contact, cycle.peak, record)
    up, down = (branch._replace(y=branch.y - zero.level(branch.time)) for branch in (up, down))
    length = max(cycle.peak - contact, 1e-3 * float(np.ptp(up.x)))
    first = np.array([_top(up.y[::-1]), np.log(exponent), np.log(length)])
    fit, scale = _fit(record, up, cycle.peak, first, 3)
    numbers, theta = _loading(up, fit, zero)
    fits, scales = [fit], [scale]
    if len(down.x):
        first = np.array([_top(down.y), np.log(2.0), fit.values[2]])
        back, _ = _fit(record, down, cycle.peak, first, 2)
        fits, scales = [fit, back], [scale, _scale(record, down, back)]
        numbers |= _unloading(down, back, zero, theta)
    rows = np.array([number.row for number in numbers.values()])
    values = {name: number.value for name, number in numbers.items()}
    covariance = (
        _covariance(rows, fits, scales)
        + _turning_point_covariance(values, rows[:, len(up.x) - 1], cycle)
        + _quantisation_covariance(rows, record, zero)
    )
    contact, peak = values["contact"], values["peak_force"]
    curves = [_curve(*fitted, contact, peak) for fitted in zip((up, down), fits, strict=False)]
    return Press(
        **_derived(_correlated(values, covariance)),
        loading=curves[0],
        unloading=curves[1] if len(curves) > 1 else None,
        record=(
            record.compression - contact,
            record.force - zero.level(np.arange(float(len(record.force)))),
        ),
    )


def _derived(numbers: dict[str, Any]) -> dict[str, Any]:
    """Return the numbers of a result, from those of the fits and works."""
    top, top_out = numbers.pop("top"), numbers.pop("top_out", None)
    p, length = numbers["exponent"], numbers["peak_compression"]
    numbers |= {
        "stiffness": top / length**p,
        "tangent_stiffness": p * top / length,
        "secant_stiffness": numbers["peak_force"] / length,
    }
    work, back = numbers["work_in"], numbers.get("work_out")
    if back is not None and work.nominal_value > 0.0:
        kept = back / work
        numbers |= {"loss": 1.0 - kept, "relaxed": top - top_out}
        if kept.nominal_value > 0.0:
            numbers |= {"restitution": kept**0.5, "energy_exponent": (p + 1.0) / kept - 1.0}
    return numbers


def _correlated(values: dict[str, float], covariance: Array) -> dict[str, Any]:
    """Return numbers with their errors and correlations."""
    from uncertainties import correlated_values_norm

    scale = np.sqrt(np.clip(np.diag(covariance), 0.0, None))
    scale = np.where(scale > 0.0, scale, 0.0)
    both = np.outer(scale, scale)
    correlations = np.eye(len(scale))
    np.divide(covariance, both, out=correlations, where=both > 0.0)
    known = list(zip(values.values(), scale.tolist(), strict=True))
    return dict(zip(values, correlated_values_norm(known, correlations), strict=True))


def _curve(branch: _Branch, fit: PowerFit, contact: float, peak: float) -> Curve:
    """Return a branch with its fit; its residuals are divided into a smooth part and noise."""
    residual = fit.residual
    count = len(residual)
    waves = min(_WAVES, count // 3)
    basis = np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, count), waves)
    smooth = float(((np.linalg.qr(basis)[0].T @ residual) ** 2).sum())
    rest = max(float(residual @ residual) - smooth, 0.0) / max(1, count - waves - 1)
    expected = rest * (waves + 1)
    misfit = float(np.sqrt(max(smooth - expected, 0.0) / count))
    share = misfit / peak if peak > 0.0 else float("inf")
    fits = share < _SMALL_MISFIT or smooth <= _CLEAR_MISFIT * expected
    noise = float(np.sqrt(rest))
    return Curve(branch.x - contact, branch.y, branch.y - residual, share, noise, fits)


def _branch(record: Record, places: NDArray[np.intp], first: int) -> _Branch:
    """Return the points of a branch, averaged in groups if there are many."""
    x, y, time = record.compression[places], record.force[places], places.astype(float)
    size = -(-len(places) // _MOST_POINTS)
    if size > 1:
        edges = np.arange(0, len(places), size)
        counts = np.diff(np.append(edges, len(places)))
        x, y, time = (np.add.reduceat(array, edges) / counts for array in (x, y, time))
    return _Branch(first, x, y, time)


@dataclass(frozen=True)
class _Zero:
    """The zero of the force, in the slack: unknown, a constant, or a straight line in time.

    Parameters
    ----------
    middle, length : float
        Of the points' places in the record.
    values : ndarray
        (q,) the level, and the slope times `length`; q is 0, 1 or 2.
    weights : ndarray
        (q, N) derivatives of the values by the noise of all points, those of the loading first.
    scatter : float
        Standard deviation of the force in the slack.
    """

    middle: float
    length: float
    values: Array
    weights: Array
    scatter: float

    def columns(self, time: Array) -> Array:
        """Return the derivatives of the zero at some places by the values."""
        line = np.column_stack([np.ones(len(time)), (time - self.middle) / self.length])
        return line[:, : len(self.values)]

    def level(self, time: Array) -> Array:
        """Return the zero at some places in the record."""
        return self.columns(time) @ self.values

    def row(self, weights: Array, branch: _Branch) -> Array:
        """Return the derivatives of sums over a branch's forces by the noise of all points.

        Parameters
        ----------
        weights : ndarray
            (..., n) weight of each force, less the zero, in the sums.
        branch : _Branch
            With n points.
        """
        rows = -(weights @ self.columns(branch.time)) @ self.weights
        rows[..., branch.first : branch.first + len(branch.x)] += weights
        return np.asarray(rows)


def _zero(up: _Branch, down: _Branch, contact: float, peak: float, record: Record) -> _Zero:
    """Fit the zero of the force: unknown without slack, a line if there is slack on both sides."""
    edge = contact - max(_SLACK_MARGIN * (peak - contact), 3.0 * record.jitter)
    before = np.flatnonzero(up.x < edge)
    after = np.flatnonzero(down.x < edge) + len(up.x)
    slack = np.concatenate([before, after])
    time, force = np.append(up.time, down.time), np.append(up.y, down.y)
    count = 0 if len(before) < _LEAST_SLACK else 1 if len(after) < _LEAST_SLACK else 2
    weights = np.zeros((count, len(time)))
    unknown = _Zero(float(time.mean()), float(np.ptp(time)), np.zeros(count), weights, 0.0)
    if count == 0:
        return unknown
    weights[:, slack] = np.linalg.pinv(unknown.columns(time[slack]))
    return replace(unknown, values=weights @ force, scatter=float(force[slack].std()))


def _top(y: Array) -> float:
    """Return a rough force at the peak; `y` starts with the point nearest to the peak."""
    return max(float(y[0]), 0.1 * float(np.ptp(y)))


def _fit(
    record: Record, branch: _Branch, peak: float, first: Array, free: int
) -> tuple[PowerFit, Array]:
    """Return the fit of a branch, and the relative noise by which its points were weighted."""
    fit = _finite(fit_power_law(branch.x, branch.y, peak, first, free), branch, record)
    scale = _scale(record, branch, fit)
    if scale.min() < _EQUAL_WEIGHTS * scale.max():
        again = fit_power_law(branch.x, branch.y, peak, first, free, scale)
        fit = _finite(again, branch, record)
    return fit, scale


def _finite(fit: PowerFit, branch: _Branch, record: Record) -> PowerFit:
    """Return a fit; refuse a loading of no point in contact, or whose ``C**p`` no float holds."""
    _, log_p, log_c = fit.values
    if fit.jacobian.shape[1] < 3 or (
        abs(log_c) * max(1.0, np.exp(log_p)) < _LARGEST_LOG and (fit.ratio(branch.x) > 0.0).any()
    ):
        return fit
    span = f"{np.ptp(record.compression):.3g} m and {np.ptp(record.force):.3g} N"
    raise InvalidValue(
        f"a press curve must follow a power law in numbers of a finite size, got {span}: are "
        "the columns and their units right?"
    )


def _scale(record: Record, branch: _Branch, fit: PowerFit) -> Array:
    """Return the relative force noise of each point, with compression noise times the slope."""
    top, p, c = fit.plain
    slope = top * p / c * power(fit.ratio(branch.x), max(p - 1.0, 0.0))
    noise = np.hypot(record.hiss, slope * record.jitter)
    unit = np.hypot(record.hiss, top / c * record.jitter)
    if unit <= 0.0 or not np.isfinite(noise).all():
        return np.ones(len(branch.x))
    return np.asarray(np.clip(noise / unit, 1e-3, 1e3))


def _loading(up: _Branch, fit: PowerFit, zero: _Zero) -> tuple[dict[str, _Number], Array]:
    """Return the loading's numbers, and derivatives (3, N) of P, ln p and ln C by the noise."""
    theta = zero.row(fit.weights, up)
    top, p, c = fit.plain
    inside = np.flatnonzero(fit.ratio(up.x) > 0.0)
    tail = np.zeros(len(up.x))
    tail[inside[-max(3, int(_TAIL * len(inside))) :]] = 1.0
    tail /= tail.sum()
    lift = zero.row(tail, up) - tail @ fit.jacobian @ theta
    begin = inside[0] if len(inside) else 0
    places = np.arange(begin, len(up.x) - 1)  # the peak itself takes the place of the last one
    # the straight line through the contact
    x = np.zeros(len(up.x))
    x[inside] = up.x[inside] - (fit.peak - c)
    square = float(x @ x)
    slope = float(x @ up.y) / square
    # by ln C, which moves all x: dk = (Σ y - 2 k Σ x) C/Σ x² · dlnC
    by_length = c * (float(up.y[inside].sum()) - 2.0 * slope * float(x.sum())) / square
    level = zero.values[0] if len(zero.values) else 0.0
    return {
        "top": _Number(top, theta[0]),
        "exponent": _Number(p, p * theta[1]),
        "peak_compression": _Number(c, c * theta[2]),
        "contact": _Number(fit.peak - c, -c * theta[2]),
        "peak_force": _Number(top + float(tail @ fit.residual), theta[0] + lift),
        "work_in": _work(up, places, fit, theta, zero),
        "linear_stiffness": _Number(slope, zero.row(x / square, up) + by_length * theta[2]),
        "zero": _Number(float(level), zero.weights[:1].sum(axis=0)),
    }, theta


def _unloading(down: _Branch, fit: PowerFit, zero: _Zero, theta: Array) -> dict[str, _Number]:
    """Return the unloading's numbers; the contact and its derivatives `theta` are the loading's."""
    by_length = power_law(down.x, fit.peak, fit.values)[1][:, 2]
    own = zero.row(fit.weights, down) - np.outer(fit.weights @ by_length, theta[2])
    top, n, _ = fit.plain
    inside = np.flatnonzero((fit.ratio(down.x) > 0.0) & (down.x < fit.peak))
    ends = (inside[0], inside[-1] + 1) if len(inside) else (0, 1)
    places = np.arange(*ends)[::-1]
    return {
        "top_out": _Number(top, own[0]),
        "unloading_exponent": _Number(n, n * own[1]),
        "work_out": _work(down, places, fit, np.vstack([own, theta[2]]), zero),
    }


def _work(
    branch: _Branch, places: NDArray[np.intp], fit: PowerFit, rows: Array, zero: _Zero
) -> _Number:
    """Return the work between contact and peak, by the trapezoidal rule.

    From the contact to the first point the fit is integrated.

    Parameters
    ----------
    branch : _Branch
        The points.
    places : ndarray of int
        Those that are used, from the contact to the peak, at which the force is that of the fit.
    fit : PowerFit
        Of the branch.
    rows : ndarray
        (3, N) derivatives of P, ln p and ln C of the fit by the noise.
    zero : _Zero
        Of the force.
    """
    top, p, c = fit.plain
    x = np.append(np.maximum(branch.x[places], fit.peak - c), fit.peak)
    each = trapezoid(x)
    weights = np.zeros(len(branch.x))
    weights[places] = each[:-1]
    # the integral of the fit from the contact to the first point, by P, ln p and ln C
    t = max(0.0, fit.ratio(float(x[0])))
    area, slopes = 0.0, np.zeros(3)
    if t > 0.0:
        area = c / (p + 1.0) * t ** (p + 1.0)
        by_p = top * area * p * (float(np.log(t)) - 1.0 / (p + 1.0))
        slopes = np.array([area, by_p, top * (area + c * t**p * (1.0 - t))])
    slopes[0] += each[-1]
    total = float(weights @ branch.y) + top * float(slopes[0])
    return _Number(total, zero.row(weights, branch) + slopes @ rows)


def _covariance(rows: Array, fits: list[PowerFit], scales: list[Array]) -> Array:
    """Return the covariance of rows, from the residuals of the branches, one after the other.

    Branches with residuals of about the same size share one noise model; otherwise one of them fits
    worse, and each has a noise model of its own.
    """
    from scipy.linalg import block_diag

    noises = [
        (fit.residual / scale, fit.jacobian / scale[:, None])
        for fit, scale in zip(fits, scales, strict=True)
    ]
    sizes = [float(np.sqrt((residual**2).mean())) for residual, _ in noises]
    if len(noises) > 1 and max(sizes) <= _SHARED_NOISE * min(sizes):
        residuals, jacobians = zip(*noises, strict=True)
        noises = [(np.concatenate(residuals), block_diag(*jacobians))]
    ends = np.cumsum([len(residual) for residual, _ in noises])[:-1]
    parts = np.split(rows * np.concatenate(scales), ends, axis=1)
    each = [noise_covariance(*noise, part) for noise, part in zip(noises, parts, strict=True)]
    return np.asarray(sum(each))


def _turning_point_covariance(values: dict[str, float], last: Array, cycle: Cycle) -> Array:
    """Return the covariance that follows from the error of the turning point's compression."""
    length = values["peak_compression"]
    slope = values["top"] * values["exponent"] / length
    moves: dict[str, float] = {
        "peak_compression": 1.0,
        "top": slope,  # keeps the stiffness top/length**p constant
        "peak_force": slope,
        "work_in": values["top"],
    }
    if "work_out" in values:
        moves["work_out"] = values["top_out"]
        moves["top_out"] = values["top_out"] * values["unloading_exponent"] / length
    row = np.array([moves.get(name, 0.0) for name in values])
    result = np.outer(row, row)
    if cycle.sampled:  # the last force then has minus the slope times the same error
        shared = -slope * np.outer(row, last)
        result += shared + shared.T
    return np.asarray(result * cycle.peak_error**2)


def _quantisation_covariance(rows: Array, record: Record, zero: _Zero) -> Array:
    """Return the covariance from the force's quantisation, if the zero's noise is below a step."""
    error = quantisation_error(record.step, zero.scatter) if len(zero.values) else 0.0
    moved = rows[:, np.abs(zero.weights).sum(axis=0) > 0.0].sum(axis=1)
    return np.outer(moved, moved) * error**2
