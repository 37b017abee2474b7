"""One cycle of a press record: its fits and works, and the covariance of all numbers."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.kinds.press.branches import Cycle, Record
from stackbounce.measure.kinds.press.fits import (
    PowerFit,
    fit_power_law,
    power,
    power_law,
    rough_contact,
)
from stackbounce.measure.quantities import Array
from stackbounce.measure.samples import quantisation_error, trapezoid
from stackbounce.measure.statistics.ar_noise import Noise

__all__ = ["Branch", "Found", "analysed"]

_MOST = 4000  # points of a branch; longer ones are averaged in groups
_ALIKE = 1.5  # times, that the residuals of one branch may be larger than the other's
_EVEN = 0.9  # of the largest noise: above it all points weigh the same
_MARGIN = 0.03  # of the compression, which no slack point may be nearer to the contact
_ENOUGH = 5  # slack points that tell the zero of the force
_TAIL = 0.05  # of the points in contact, whose mean residual corrects the peak force


@dataclass(frozen=True)
class Branch:
    """The points of a branch: compression, force, place in the record; their fit's residuals.

    `first` is the place of the first one among all points, those of the loading being before those
    of the unloading.
    """

    first: int
    x: Array
    y: Array
    time: Array
    residual: Array


class Found(NamedTuple):
    """What one cycle gives, in the record's units.

    Parameters
    ----------
    values : dict of str to float
        The numbers, by the names that `Press` has; and `top` and `top_out`, the forces of the two
        fits at the peak.
    covariance : ndarray
        In the order of `values`.
    level : ndarray
        (N,) the zero of the force at each point of the record.
    loading, unloading : Branch
        The points; the zero of the force is subtracted.
    """

    values: dict[str, float]
    covariance: Array
    level: Array
    loading: Branch
    unloading: Branch


class _Number(NamedTuple):
    """A number, and its derivatives (N,) by the noise of all points, those of the loading first."""

    value: float
    row: Array


def analysed(record: Record, cycle: Cycle) -> Found:
    """Return everything that follows from a cycle with a loading.

    Parameters
    ----------
    record : Record
        The whole record.
    cycle : Cycle
        With points in its loading.

    Returns
    -------
    Found
    """
    up = _branch(record, cycle.loading, 0)
    down = _branch(record, cycle.unloading, len(up.x))
    contact, exponent = rough_contact(up.x, up.y)
    zero = _zero(up, down, contact, cycle.peak, record)
    up, down = (replace(one, y=one.y - zero.level(one.time)) for one in (up, down))
    length = max(cycle.peak - contact, 1e-3 * float(np.ptp(up.x)))
    first = np.array([_top(up.y[::-1]), np.log(exponent), np.log(length)])
    fit, scale = _fit(record, up, cycle.peak, first, 3)
    numbers, theta = _loading(up, fit, cycle.peak, zero)
    fits, scales = [fit], [scale]
    if len(down.x):
        first = np.array([_top(down.y), np.log(2.0), fit.values[2]])
        back, _ = _fit(record, down, cycle.peak, first, 2)
        fits, scales = [fit, back], [scale, _scale(record, down, cycle.peak, back)]
        numbers |= _unloading(down, back, cycle.peak, zero, theta)
        down = replace(down, residual=back.residual)
    rows = np.array([one.row for one in numbers.values()])
    values = {name: one.value for name, one in numbers.items()}
    covariance = (
        _covariance(rows, fits, scales)
        + _turning_point_covariance(values, rows[:, len(up.x) - 1], cycle)
        + _quantisation_covariance(rows, record, zero)
    )
    level = zero.level(np.arange(float(len(record.force))))
    return Found(values, covariance, level, replace(up, residual=fit.residual), down)


def _branch(record: Record, places: NDArray[np.intp], first: int) -> Branch:
    """Return the points of a branch, averaged in groups if there are many."""
    x, y, time = record.compression[places], record.force[places], places.astype(float)
    size = -(-len(places) // _MOST)
    if size > 1:
        edges = np.arange(0, len(places), size)
        counts = np.diff(np.append(edges, len(places)))
        x, y, time = (np.add.reduceat(one, edges) / counts for one in (x, y, time))
    return Branch(first, x, y, time, np.empty(0))


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

    def row(self, weights: Array, branch: Branch) -> Array:
        """Return the derivatives of sums over a branch's forces by the noise of all points.

        Parameters
        ----------
        weights : ndarray
            (..., n) weight of each force, less the zero, in the sums.
        branch : Branch
            With n points.
        """
        rows = -(weights @ self.columns(branch.time)) @ self.weights
        rows[..., branch.first : branch.first + len(branch.x)] += weights
        return np.asarray(rows)


def _zero(up: Branch, down: Branch, contact: float, peak: float, record: Record) -> _Zero:
    """Fit the zero of the force: unknown without slack, a line if there is slack on both sides."""
    edge = contact - max(_MARGIN * (peak - contact), 3.0 * record.jitter)
    before = np.flatnonzero(up.x < edge)
    after = np.flatnonzero(down.x < edge) + len(up.x)
    slack = np.concatenate([before, after])
    time, force = np.append(up.time, down.time), np.append(up.y, down.y)
    count = 0 if len(before) < _ENOUGH else 1 if len(after) < _ENOUGH else 2
    empty = _Zero(float(time.mean()), float(np.ptp(time)), np.zeros(count), np.empty(0), 0.0)
    if count == 0:
        return replace(empty, weights=np.zeros((0, len(time))))
    weights = np.zeros((count, len(time)))
    weights[:, slack] = np.linalg.pinv(empty.columns(time[slack]))
    scatter = float(force[slack].std())
    return replace(empty, values=weights @ force, weights=weights, scatter=scatter)


def _top(y: Array) -> float:
    """Return a rough force at the peak; `y` starts with the point nearest to the peak."""
    return max(float(y[0]), 0.1 * float(np.ptp(y)))


def _fit(
    record: Record, branch: Branch, peak: float, first: Array, free: int
) -> tuple[PowerFit, Array]:
    """Return the fit of a branch, and the relative noise by which its points were weighted."""
    fit = fit_power_law(branch.x, branch.y, peak, first, free)
    scale = _scale(record, branch, peak, fit)
    if scale.min() < _EVEN * scale.max():
        fit = fit_power_law(branch.x, branch.y, peak, first, free, scale)
    return fit, scale


def _scale(record: Record, branch: Branch, peak: float, fit: PowerFit) -> Array:
    """Return the relative force noise of each point, with compression noise times the slope."""
    top, p, c = _plain(fit.values)
    ratio = 1.0 - (peak - branch.x) / c
    slope = top * p / c * power(ratio, max(p - 1.0, 0.0))
    noise = np.hypot(record.hiss, slope * record.jitter)
    unit = np.hypot(record.hiss, top / c * record.jitter)
    if unit <= 0.0 or not np.isfinite(noise).all():
        return np.ones(len(branch.x))
    return np.asarray(np.clip(noise / unit, 1e-3, 1e3))


def _loading(
    up: Branch, fit: PowerFit, peak: float, zero: _Zero
) -> tuple[dict[str, _Number], Array]:
    """Return the loading's numbers, and derivatives (3, N) of P, ln p and ln C by the noise."""
    theta = zero.row(fit.weights, up)
    top, p, c = _plain(fit.values)
    inside = np.flatnonzero(1.0 - (peak - up.x) / c > 0.0)
    tail = np.zeros(len(up.x))
    tail[inside[-max(3, int(_TAIL * len(inside))) :]] = 1.0
    tail /= tail.sum()
    lift = zero.row(tail, up) - tail @ fit.jacobian @ theta
    begin = inside[0] if len(inside) else 0
    places = np.arange(begin, len(up.x) - 1)  # the peak itself takes the place of the last one
    # the straight line through the contact
    x = np.zeros(len(up.x))
    x[inside] = up.x[inside] - (peak - c)
    square = float(x @ x)
    slope = float(x @ up.y) / square
    # by ln C, which moves all x: dk = (Σ y - 2 k Σ x) C/Σ x² · dlnC
    by_length = c * (float(up.y[inside].sum()) - 2.0 * slope * float(x.sum())) / square
    found = {
        "top": _Number(top, theta[0]),
        "exponent": _Number(p, p * theta[1]),
        "peak_compression": _Number(c, c * theta[2]),
        "contact": _Number(peak - c, -c * theta[2]),
        "peak_force": _Number(top + float(tail @ fit.residual), theta[0] + lift),
        "work_in": _work(up, places, fit.values, theta, peak, zero),
        "linear_stiffness": _Number(slope, zero.row(x / square, up) + by_length * theta[2]),
        "zero": _Number(0.0, np.zeros(theta.shape[1])),
    }
    if len(zero.values):
        found["zero"] = _Number(float(zero.values[0]), zero.weights[0])
    return found, theta


def _unloading(
    down: Branch, fit: PowerFit, peak: float, zero: _Zero, theta: Array
) -> dict[str, _Number]:
    """Return the unloading's numbers; the contact and its derivatives `theta` are the loading's."""
    by_length = power_law(down.x, peak, fit.values)[1][:, 2]
    own = zero.row(fit.weights, down) - np.outer(fit.weights @ by_length, theta[2])
    top, n, c = _plain(fit.values)
    inside = np.flatnonzero((1.0 - (peak - down.x) / c > 0.0) & (down.x < peak))
    ends = (inside[0], inside[-1] + 1) if len(inside) else (0, 1)
    places = np.arange(*ends)[::-1]
    rows = np.vstack([own, theta[2]])
    return {
        "top_out": _Number(top, own[0]),
        "unloading_exponent": _Number(n, n * own[1]),
        "work_out": _work(down, places, fit.values, rows, peak, zero),
    }


def _work(
    branch: Branch, places: NDArray[np.intp], values: Array, rows: Array, peak: float, zero: _Zero
) -> _Number:
    """Return the work between contact and peak, by the trapezoidal rule.

    From the contact to the first point the fit is integrated.

    Parameters
    ----------
    branch : Branch
        The points.
    places : ndarray of int
        Those that are used, from the contact to the peak, at which the force is that of the fit.
    values, rows : ndarray
        (3,) P, ln p and ln C of the fit, and (3, N) their derivatives by the noise.
    peak : float
        Where the force is P.
    zero : _Zero
        Of the force.
    """
    top, p, c = _plain(values)
    x = np.append(np.maximum(branch.x[places], peak - c), peak)
    each = trapezoid(x)
    weights = np.zeros(len(branch.x))
    weights[places] = each[:-1]
    # the integral of the fit from the contact to the first point, by P, ln p and ln C
    t = max(0.0, 1.0 - (peak - float(x[0])) / c)
    area, slopes = 0.0, np.zeros(3)
    if t > 0.0:
        area = c / (p + 1.0) * t ** (p + 1.0)
        by_p = top * area * p * (float(np.log(t)) - 1.0 / (p + 1.0))
        slopes = np.array([area, by_p, top * (area + c * t**p * (1.0 - t))])
    slopes[0] += each[-1]
    total = float(weights @ branch.y) + top * float(slopes[0])
    return _Number(total, zero.row(weights, branch) + slopes @ rows)


def _plain(values: Array) -> tuple[float, float, float]:
    """Return P, p and C of the values of a fit."""
    return float(values[0]), float(np.exp(values[1])), float(np.exp(values[2]))


def _covariance(rows: Array, fits: list[PowerFit], scales: list[Array]) -> Array:
    """Return the covariance of rows, from the residuals of the branches, one after the other.

    Branches with residuals of about the same size share one noise model; otherwise one of them fits
    worse, and each has a noise model of its own.
    """
    from scipy.linalg import block_diag

    noises = [
        Noise(fit.residual / scale, fit.jacobian / scale[:, None])
        for fit, scale in zip(fits, scales, strict=True)
    ]
    sizes = [float(np.sqrt((one.residual**2).mean())) for one in noises]
    if len(noises) > 1 and max(sizes) <= _ALIKE * min(sizes):
        residual = np.concatenate([one.residual for one in noises])
        noises = [Noise(residual, block_diag(*(one.jacobian for one in noises)))]
    ends = np.cumsum([len(one.residual) for one in noises])[:-1]
    parts = np.split(rows * np.concatenate(scales), ends, axis=1)
    each = [one.covariance(part) for one, part in zip(noises, parts, strict=True)]
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
