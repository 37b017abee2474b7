"""One cycle of a press record, analysed: fits, works, and the covariance of it all."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.kinds.press.branches import Cycle, Record
from stackbounce.measure.kinds.press.fits import (
    PowerFit,
    fit_loading,
    fit_unloading,
    power,
    rough_contact,
)
from stackbounce.measure.statistics.ar_noise import Noise

__all__ = ["MOST", "Found", "analysed"]

Array = NDArray[np.float64]

MOST = 4000
"""Points of a branch; longer ones are averaged in groups."""

_ALIKE = 1.5  # times, that the residuals of one branch may be larger than the other's
_EVEN = 0.9  # of the largest noise: above it all points weigh the same
_MARGIN = 0.03  # of the compression, which no slack point may be nearer to the contact
_TAIL = 0.05  # of the points in contact, whose mean residual corrects the peak force


@dataclass(frozen=True)
class Branch:
    """The points of a branch, and what they weigh in everything that is found."""

    x: Array
    y: Array  # force, zero not taken off
    time: Array  # place in the record, for the drift
    groups: int = 1  # points averaged in each


@dataclass(frozen=True)
class Found:
    """What one cycle gives, in the record's units, as plain numbers with a covariance.

    Parameters
    ----------
    values : dict of str to float
        By name.
    covariance : ndarray
        In the order of `values`.
    zero : tuple of float
        Force at the record's first point with nothing pressed, and its change per point.
    zeroed : str
        How the zero of the force was found: ``"line"``, ``"constant"`` or ``"given"``.
    loading, unloading : Branch
        The points, the force's zero taken off.
    residuals : tuple of ndarray
        Of both branches.
    """

    values: dict[str, float]
    covariance: Array
    zero: tuple[float, float]
    zeroed: str
    loading: Branch
    unloading: Branch
    residuals: tuple[Array, Array]


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
    up, down = (_branch(record, places) for places in (cycle.loading, cycle.unloading))
    start = rough_contact(up.x, up.y)
    zero = _zero(up, down, start[0], cycle.peak, record)
    level = [_columns(zero, branch) @ zero.values for branch in (up, down)]
    up, down = (
        replace(branch, y=branch.y - base) for branch, base in zip((up, down), level, strict=True)
    )
    fit = fit_loading(up.x, up.y, cycle.peak, start, 1.0)
    scale = _scale(record, up, cycle.peak, fit)
    if scale.min() < _EVEN * scale.max():
        fit = fit_loading(up.x, up.y, cycle.peak, start, scale)
    length = float(np.exp(fit.values[2]))
    back = _unloaded(record, down, cycle.peak, length)
    work = _Rows(len(up.x), len(down.x), zero, up, down)
    values = work.loading(fit, cycle.peak)
    residual = np.empty(0)
    back_scale = np.ones(len(down.x))
    if back is not None:
        residual, back_scale = back.residual, _scale(record, down, cycle.peak, back, length)
        values |= work.unloading(back, cycle.peak, length)
    values, rows = _ordered(values, work.rows)
    covariance = _covariance(rows, (fit, back), (scale, back_scale))
    covariance = covariance + _turning_point_covariance(values, rows[:, len(up.x) - 1], cycle)
    if zero.method != "given":
        covariance = covariance + _quantisation_covariance(rows, record, zero)
    return Found(
        values,
        covariance,
        _line(zero),
        zero.method,
        up,
        down,
        (fit.residual, residual),
    )


def _covariance(
    rows: Array, fits: tuple[PowerFit, PowerFit | None], scales: tuple[Array, Array]
) -> Array:
    """Return the covariance of rows, from the residuals of both branches, one after the other.

    They have one noise if their residuals are about as large; else one of the two does not fit as
    well as the other, and each has its own.
    """
    up, back = fits
    count = len(up.residual)
    first = (up.residual / scales[0], up.jacobian / scales[0][:, None])
    if back is None:
        return Noise(*first).covariance(rows * scales[0])
    second = (back.residual / scales[1], back.jacobian / scales[1][:, None])
    sizes = [float(np.sqrt((one[0] ** 2).mean())) for one in (first, second)]
    if max(sizes) <= _ALIKE * min(sizes):
        jacobian = np.zeros((rows.shape[1], first[1].shape[1] + second[1].shape[1]))
        jacobian[:count, : first[1].shape[1]] = first[1]
        jacobian[count:, first[1].shape[1] :] = second[1]
        noise = Noise(np.concatenate([first[0], second[0]]), jacobian)
        return noise.covariance(rows * np.concatenate(scales))
    return Noise(*first).covariance(rows[:, :count] * scales[0]) + Noise(*second).covariance(
        rows[:, count:] * scales[1]
    )


@dataclass(frozen=True)
class _Zero:
    """The force with nothing pressed: a level, or a line in time, and its weights."""

    method: str
    values: Array
    weights: Array  # (0, 1 or 2, N1 + N2)
    middle: float
    length: float
    wander: float = 0.0  # standard deviation of the force in the slack


def _branch(record: Record, places: NDArray[np.intp]) -> Branch:
    """Return the points of a branch, the last one first averaged if there are many."""
    x, y = record.compression[places], record.force[places]
    time = places.astype(float)
    size = -(-len(places) // MOST)
    if size > 1:
        edges = np.arange(0, len(places), size)
        counts = np.diff(np.append(edges, len(places)))
        x, y, time = (np.add.reduceat(one, edges) / counts for one in (x, y, time))
    return Branch(x, y, time, size)


def _zero(up: Branch, down: Branch, contact: float, peak: float, record: Record) -> _Zero:
    """Return the zero of the force from the slack before the contact, and after it."""
    edge = contact - max(_MARGIN * (peak - contact), 3.0 * record.jitter)
    count = len(up.x)
    before = np.flatnonzero(up.x < edge)
    after = np.flatnonzero(down.x < edge) + count
    time = np.concatenate([up.time, down.time])
    force = np.concatenate([up.y, down.y])
    middle, length = float(time.mean()), float(np.ptp(time))
    empty = np.empty((0, len(time)))
    slack = np.concatenate([before, after])
    if len(before) < 5:
        return _Zero("given", np.empty(0), empty, middle, length)
    columns = np.ones((len(slack), 1))
    method = "constant"
    if len(after) >= 5:
        columns = np.column_stack([columns[:, 0], (time[slack] - middle) / length])
        method = "line"
    inverse = np.linalg.pinv(columns)
    weights = np.zeros((columns.shape[1], len(time)))
    weights[:, slack] = inverse
    wander = float(force[slack].std())
    return _Zero(method, inverse @ force[slack], weights, middle, length, wander)


def _columns(zero: _Zero, branch: Branch) -> Array:
    """Return how the zero of each point follows from the values of the zero."""
    both = np.column_stack([np.ones(len(branch.time)), (branch.time - zero.middle) / zero.length])
    return both[:, : len(zero.values)]


def _line(zero: _Zero) -> tuple[float, float]:
    level, tilt = (*zero.values.tolist(), 0.0, 0.0)[:2]
    if len(zero.values) < 2:
        tilt = 0.0
    return level - tilt * zero.middle / zero.length, tilt / zero.length


def _scale(
    record: Record, branch: Branch, peak: float, fit: PowerFit, length: float | None = None
) -> Array:
    """Return the relative noise of the points: of force, and of compression by the slope."""
    top, p = float(fit.values[0]), float(np.exp(fit.values[1]))
    c = float(np.exp(fit.values[2])) if length is None else length
    ratio = np.clip(1.0 - (peak - branch.x) / c, 0.0, None)
    slope = top * p / c * power(ratio, max(p - 1.0, 0.0))
    noise = np.hypot(record.hiss, slope * record.jitter)
    unit = np.hypot(record.hiss, top / c * record.jitter)
    if unit <= 0.0 or not np.isfinite(noise).all():
        return np.ones(len(branch.x))
    return np.asarray(np.clip(noise / unit, 1e-3, 1e3))


def _unloaded(record: Record, down: Branch, peak: float, length: float) -> PowerFit | None:
    if not len(down.x):
        return None
    back = fit_unloading(down.x, down.y, peak, length, 1.0)
    scale = _scale(record, down, peak, back, length)
    return (
        back
        if scale.min() >= _EVEN * scale.max()
        else fit_unloading(down.x, down.y, peak, length, scale)
    )


class _Rows:
    """The numbers of a cycle, each with its row of weights over the noise of both branches."""

    def __init__(self, first: int, second: int, zero: _Zero, up: Branch, down: Branch) -> None:
        self.first, self.size = first, first + second
        self.zero, self.up, self.down = zero, up, down
        self.rows: dict[str, Array] = {}
        self.theta = np.empty((0, self.size))
        self.theta_back = np.empty((0, self.size))

    def loading(self, fit: PowerFit, peak: float) -> dict[str, float]:
        """Return what follows from the loading."""
        up = slice(0, self.first)
        columns = _columns(self.zero, self.up)
        theta = -(fit.weights @ columns) @ self.zero.weights
        theta[:, up] += fit.weights
        self.theta = theta
        top, p, c = _plain(fit.values)
        touched = 1.0 - (peak - self.up.x) / c
        self.rows["top"] = theta[0]
        self.rows["exponent"] = p * theta[1]
        self.rows["length"] = c * theta[2]
        self.rows["contact"] = -c * theta[2]
        tail = np.flatnonzero(touched > 0.0)
        tail = tail[-max(3, int(_TAIL * len(tail))) :]
        rest = np.zeros(self.size)
        rest[tail] += 1.0 / len(tail)
        rest -= columns[tail].mean(axis=0) @ self.zero.weights
        rest -= fit.jacobian[tail].mean(axis=0) @ theta
        lift = float(fit.residual[tail].mean())
        self.rows["peak_force"] = theta[0] + rest
        values = {"top": top, "exponent": p, "length": c, "peak_force": top + lift}
        values["contact"] = peak - c
        values["work_in"] = self._work_in(fit, peak, touched)
        values["linear"] = self._linear(peak, c, touched)
        values["zero"] = float(self.zero.values[0]) if len(self.zero.values) else 0.0
        self.rows["zero"] = self.zero.weights[0] if len(self.zero.values) else np.zeros(self.size)
        return values

    def _work_in(self, fit: PowerFit, peak: float, touched: Array) -> float:
        """Return the work from contact to peak: the trapezoids, and before them the fit."""
        begin = int(np.flatnonzero(touched > 0.0)[0]) if (touched > 0.0).any() else 0
        places = np.arange(begin, len(self.up.x) - 1)  # the last gives way to the peak itself
        x = np.append(np.maximum(self.up.x[places], peak - np.exp(fit.values[2])), peak)
        y = np.append(self.up.y[places], fit.values[0])
        weights = _trapezoid(x)
        row = np.zeros(self.size)
        row[places] = weights[:-1]
        row -= weights[:-1] @ _columns(self.zero, self.up)[places] @ self.zero.weights
        row = row + weights[-1] * self.theta[0]
        rest, slopes = _area(fit.values, peak, float(x[0]))
        self.rows["work_in"] = row + slopes @ self.theta
        return float(weights @ y) + rest

    def _linear(self, peak: float, c: float, touched: Array) -> float:
        """Return the slope of the straight line through the contact that fits the loading best."""
        places = np.flatnonzero(touched > 0.0)
        x, y = self.up.x[places] - (peak - c), self.up.y[places]
        square = float(x @ x)
        slope = float(x @ y) / square
        row = np.zeros(self.size)
        row[places] = x / square
        row -= (x / square) @ _columns(self.zero, self.up)[places] @ self.zero.weights
        # by ln C, which moves all x: dk = (Σ y - 2 k Σ x) C/Σ x² · dlnC
        self.rows["linear"] = (
            row + c * (float(y.sum()) - 2.0 * slope * float(x.sum())) / square * (self.theta[2])
        )
        return slope

    def unloading(self, fit: PowerFit, peak: float, c: float) -> dict[str, float]:
        """Return what follows from the unloading, whose contact is the loading's."""
        down = slice(self.first, self.size)
        columns = _columns(self.zero, self.down)
        top, n = float(fit.values[0]), float(np.exp(fit.values[1]))
        ratio = 1.0 - (peak - self.down.x) / c
        by_length = top * n * power(ratio, n - 1.0) * (1.0 - ratio)
        by_length[ratio <= 0.0] = 0.0
        theta = -(fit.weights @ columns) @ self.zero.weights
        theta[:, down] += fit.weights
        theta -= np.outer(fit.weights @ by_length, self.theta[2])
        self.rows["top_out"] = theta[0]
        self.rows["unloading"] = n * theta[1]
        values = {"top_out": top, "unloading": n}
        inside = np.flatnonzero(ratio > 0.0)
        inside = inside[self.down.x[inside] < peak]
        if not len(inside):
            inside = np.array([0])
        places = np.arange(inside[0], inside[-1] + 1)
        x = np.append(peak, np.maximum(self.down.x[places], peak - c))
        y = np.append(top, self.down.y[places])
        weights = -_trapezoid(x)
        row = np.zeros(self.size)
        row[self.first + places] = weights[1:]
        row -= weights[1:] @ columns[places] @ self.zero.weights
        row = row + weights[0] * theta[0]
        full = np.append(fit.values, np.log(c))
        rest, slopes = _area(full, peak, float(x[-1]))
        self.rows["work_out"] = row + slopes[:2] @ theta + slopes[2] * self.theta[2]
        return values | {"work_out": float(weights @ y) + rest}


def _plain(values: Array) -> tuple[float, float, float]:
    """Return P, p and C of the values of a fit."""
    return float(values[0]), float(np.exp(values[1])), float(np.exp(values[2]))


def _trapezoid(x: Array) -> Array:
    """Return the weights with which values at x add up to their integral along the path."""
    weights = np.zeros(len(x))
    steps = 0.5 * np.diff(x)
    weights[:-1] += steps
    weights[1:] += steps
    return weights


def _area(values: Array, peak: float, end: float) -> tuple[float, Array]:
    """Return the fit's integral from the contact to `end`, and its derivatives by the values."""
    top, p, c = _plain(values)
    t = max(0.0, 1.0 - (peak - end) / c)
    if t == 0.0:
        return 0.0, np.zeros(3)
    unit = c / (p + 1.0) * t ** (p + 1.0)
    log = float(np.log(t))
    by_p = top * unit * p * (log - 1.0 / (p + 1.0))
    by_c = top * (unit + c * t**p * (1.0 - t))
    return top * unit, np.array([unit, by_p, by_c])


def _ordered(values: dict[str, float], rows: dict[str, Array]) -> tuple[dict[str, float], Array]:
    """Return values and rows in one order."""
    ordered = {name: values[name] for name in rows}
    return ordered, np.array(list(rows.values()))


def _turning_point_covariance(values: dict[str, float], last: Array, cycle: Cycle) -> Array:
    """Return the covariance that follows from the error of the turning point's compression."""
    slope = values["top"] * values["exponent"] / values["length"]
    moves: dict[str, float] = {
        "length": 1.0,
        "top": slope,  # so that top/length**p, which is the stiffness, stays what it is
        "peak_force": slope,
        "work_in": values["top"],
    }
    if "work_out" in values:
        moves["work_out"] = values["top_out"]
        moves["top_out"] = values["top_out"] * values["unloading"] / values["length"]
    row = np.array([moves.get(name, 0.0) for name in values])
    result = np.outer(row, row)
    if cycle.sampled:  # whose force is then too small by the slope times the same error
        shared = -slope * np.outer(row, last)
        result += shared + shared.T
    return np.asarray(result * cycle.peak_error**2)


def _quantisation_covariance(rows: Array, record: Record, zero: _Zero) -> Array:
    """Return the covariance from the force's quantisation, if the zero's noise is below a step."""
    slack = np.abs(zero.weights).sum(axis=0) > 0.0
    if not record.step or zero.wander >= 0.4 * record.step:
        return np.zeros((len(rows), len(rows)))
    moved = rows[:, slack].sum(axis=1)
    return np.outer(moved, moved) * record.step**2 / 12.0
