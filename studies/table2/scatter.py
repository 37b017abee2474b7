"""Means and covariances of a pair's ratios over bounces that differ from each other."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from studies.table2.ratio_tables import RatioTable, weigh

__all__ = ["Moments", "scatter_bounces"]

Array: TypeAlias = NDArray[np.float64]

_POINTS = 3  # of the Gauss-Hermite rule for a restitution


class Moments(NamedTuple):
    """Moments of single bounces at the nodes of a table.

    `middles` (m,) are mean delays in s. `parts` (nodes, 5, m) are the mean e1 and e2 and the
    variances of both and their covariance.
    """

    middles: Array
    parts: Array


def scatter_bounces(table: RatioTable, middles: Array, delay: float, restitution: float) -> Moments:
    """Return the moments of bounces whose delays and restitutions scatter.

    Parameters
    ----------
    table : RatioTable
    middles : ndarray
        (m,) mean delays in s.
    delay : float
        The standard deviation of the delays in s; a normal distribution, cut at the table's ends.
    restitution : float
        The standard deviation of each restitution.

    Examples
    --------
    Of ratios that are linear in the delay the variances are those of the slopes:

    >>> delays = np.arange(1, 101) * 1e-4
    >>> ratios = np.stack([100.0 * delays, -50.0 * delays], axis=-1)[None]
    >>> spans = {"log_stiffer": (-1.0, 1.0)}
    >>> table = RatioTable(("log_stiffer",), spans, (np.zeros(1),), delays, ratios)
    >>> found = scatter_bounces(table, np.array([5e-3]), 1e-3, 0.01)
    >>> found.parts[0, :, 0].round(4)
    array([ 0.5   , -0.25  ,  0.01  ,  0.0025, -0.005 ])
    """
    sums = _over_restitutions(table, restitution)  # (nodes, d, 5)
    apart = (middles[:, None] - table.delays) / delay
    weights = np.exp(-0.5 * apart**2)
    weights /= weights.sum(axis=1, keepdims=True)
    found = np.moveaxis(weights @ sums, -1, 1)  # (nodes, 5, m)
    first, second = found[:, 0], found[:, 1]
    found[:, 2] -= first**2
    found[:, 3] -= second**2
    found[:, 4] -= first * second
    return Moments(middles, found)


def _over_restitutions(table: RatioTable, spread: float) -> Array:
    """Return the means (nodes, d, 5) of e1, e2, their squares and product over restitutions."""
    points, shares = np.polynomial.hermite_e.hermegauss(_POINTS)
    shares = shares / shares.sum()
    trials = [(1.0, table.ratios)]
    for k, (axis, nodes) in enumerate(zip(table.axes, table.nodes, strict=True)):
        if not axis.startswith("e_"):
            continue
        moved = [weigh(nodes, table.spans[axis], nodes + spread * point) for point in points]
        trials = [
            (weight * float(share), np.moveaxis(np.tensordot(matrix, ratios, (1, k)), 0, k))
            for weight, ratios in trials
            for share, matrix in zip(shares, moved, strict=True)
        ]
    sums = np.zeros((*table.ratios.shape[:-1], 5))
    for weight, ratios in trials:
        first, second = ratios[..., 0], ratios[..., 1]
        parts = (first, second, first**2, second**2, first * second)
        sums += weight * np.stack(parts, axis=-1)
    return sums.reshape(-1, *sums.shape[-2:])
