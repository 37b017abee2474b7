"""How probable each start and each unknown of a flank are, on grids that close in."""

from dataclasses import dataclass

import numpy as np

from stackbounce.measure.waveform.record import Array
from stackbounce.measure.waveform.shapes import Shape

__all__ = ["Found", "Points", "scan"]

_STARTS, _FEWER = 21, 17  # for powers, whose starts lie on thin lines; for others
_ZOOMS = 8
_SLIGHT = 1e-3  # a share of the weight that need not be told well
_AROUND = 4.5  # standard deviations on the fine grid


@dataclass(frozen=True, eq=False)
class Points:
    """Samples of a flank, or averages over blocks of them between `edges`.

    `height` is the flank's, `level` the share that it has of the peak, `offset` what the baseline
    may be off, `length` that of the contact in s,
    `step` the time between averaged samples.
    """

    times: Array
    edges: Array | None
    values: Array
    sigma: Array
    height: float = 0.0
    level: float = 0.0
    offset: float = 0.0
    length: float = 0.0
    step: float = 0.0

    @property
    def unit(self) -> float:
        """The whole time in s."""
        return float(self.times[-1] - self.times[0])


@dataclass(frozen=True, eq=False)
class Found:
    """What the points tell if the force has a shape.

    Parameters
    ----------
    starts, weights : ndarray
        (n,) possible starts in s, and their probabilities, of sum 1.
    powers : ndarray
        (n,) with which power the force begins.
    coarse : float
        The time in s within which a start may lie anywhere besides, as averages cannot tell.
    evidence : float
        Logarithm of how probable the points are, but for what is the same in all shapes.
    chi : float
        Chi squared of the best curve.
    times, force : ndarray
        The best curve from its start on.
    """

    starts: Array
    weights: Array
    powers: Array
    coarse: float
    evidence: float
    chi: float
    times: Array
    force: Array


def scan(points: Points, shape: Shape) -> Found:
    """Return what the points tell if the force has a shape.

    Each value of the unknown has starts of its own: the larger a power is, the earlier the touch,
    and where noise is low the weight lies on a line between the two that is much thinner than it is
    long.
    """
    times = points.times
    end = times[-1]
    low = np.flatnonzero(points.values < np.maximum(0.3 * points.height, 2.0 * points.sigma))
    latest = times[low[-1] + 1] if len(low) and low[-1] + 1 < len(times) else end
    logs = shape.grid()
    count = _STARTS if shape.kind == "power" else _FEWER
    first = np.linspace(times[0], min(latest, end - 1e-6 * points.unit), count)
    starts = np.tile(first, (len(logs), 1))
    finer = False  # each unknown needs its best start before they compare
    for _ in range(_ZOOMS):
        score = _score(points, shape, starts, logs)[0]
        last = finer or shape.known
        starts, logs, settled = _closer(starts, logs, score, end, finer=finer)
        if settled and last:
            break
        finer = not shape.known and (finer or settled)
    score, solved, heights = _score(points, shape, starts, logs)
    top = float(score.max())
    weights = np.exp(score - top)
    total = float(weights.sum())
    i, j = np.unravel_index(int(np.argmax(score)), score.shape)
    scaled = solved[i, j] / heights[i, j, :, 0]
    start, unknown = float(starts[i, j]), _unknown(points, shape, logs[i : i + 1])[0]
    at = points.times if points.edges is None else points.edges
    u = (at - start) / points.unit
    curve = scaled @ shape.rows(u, unknown, averaged=points.edges is not None)
    fine = np.linspace(start, end, 60)
    force = scaled @ shape.rows((fine - start) / points.unit, unknown, averaged=False)
    apart = 1.0 if shape.known else float(logs[1] - logs[0])
    return Found(
        starts=starts.ravel(),
        weights=weights.ravel() / total,
        powers=np.repeat(shape.begins(logs), starts.shape[1]),
        coarse=points.step if shape.kind == "jump" else 0.0,
        evidence=top + float(np.log(total * apart)),
        chi=float(np.sum(((points.values - curve) / points.sigma) ** 2)),
        times=fine,
        force=force,
    )


def _closer(
    starts: Array, logs: Array, score: Array, end: float, *, finer: bool
) -> tuple[Array, Array, bool]:
    """Return a finer grid around the weight on a coarse one, and if that was told well enough."""
    best = score.max(axis=1)
    own = np.exp(score - best[:, None])
    rows = np.exp(best - best.max()) * own.sum(axis=1)
    rows /= rows.sum()
    own /= own.sum(axis=1)[:, None]
    middles = np.sum(starts * own, axis=1)
    spreads = np.sqrt(np.sum((starts - middles[:, None]) ** 2 * own, axis=1))
    least = 0.5 * (starts[:, 1] - starts[:, 0])
    settled = bool(np.all((spreads > least)[rows > _SLIGHT]))
    wide = _AROUND * np.maximum(spreads, least)
    unknowns = logs
    if finer:
        mean = float(np.sum(logs * rows))
        spread = float(np.sqrt(np.sum((logs - mean) ** 2 * rows)))
        step = 0.5 * (logs[1] - logs[0])
        settled = settled and bool(spread > step)
        reach = _AROUND * max(spread, step)
        unknowns = np.linspace(mean - reach, mean + reach, len(logs))
    middle, half = (np.interp(unknowns, logs, one) for one in (middles, wide))
    top = np.minimum(middle + half, end - 1e-9 * half)
    return np.linspace(middle - half, top, starts.shape[1], axis=1), unknowns, settled


def _unknown(points: Points, shape: Shape, logs: Array) -> Array:
    """Return p, or a in units of the points' whole time."""
    unknown: Array = np.exp(logs)
    return unknown if shape.kind == "power" else unknown * points.length / points.unit


def _score(points: Points, shape: Shape, starts: Array, logs: Array) -> tuple[Array, Array, Array]:
    """Return the logarithm of the probability of each pair of start and unknown.

    For each pair the curve is linear in all else, which is integrated over. Also the best of that,
    and what each row of the curve was divided by.
    """
    where = points.times if points.edges is None else points.edges
    u = (where - starts[:, :, None]) / points.unit
    unknown = _unknown(points, shape, logs)[:, None, None]
    rows = shape.rows(u, unknown, averaged=points.edges is not None)
    heights = np.maximum(rows[..., -1:], 1e-300)  # so that each is 1 at the end of the flank
    rows = rows / heights / points.sigma
    values = points.values / points.sigma
    normal = rows @ np.swapaxes(rows, -1, -2)
    means = np.stack(shape.corrections(logs, points.level), axis=-1)[:, None] * points.height
    spreads: Array = np.array([shape.others, shape.slowing]) * points.height
    offset = max(points.offset, 1e-6 * points.height)
    normal[..., range(4), range(4)] += (1e-12, *spreads**-2, offset**-2)
    right = rows @ values
    right[..., 1:3] += means / spreads**2
    solved = np.linalg.solve(normal, right[..., None])[..., 0]
    cost = np.sum((means / spreads) ** 2, axis=-1) - np.sum(right * solved, axis=-1)
    score = -0.5 * cost - 0.5 * np.linalg.slogdet(normal)[1] - np.log(spreads).sum()
    score = score + shape.prior(logs)[:, None]
    wanted: Array = score + np.log(starts[:, 1:2] - starts[:, :1])
    best: Array = np.asarray(solved, dtype=np.float64)
    return wanted, best, heights
