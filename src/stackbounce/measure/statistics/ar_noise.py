"""What the residuals of a fit say about its errors: white noise, and noise with a memory.

The points of a press curve come one after the other, and what disturbs one often disturbs the next:
a drift, a filter, steps of a converter, a law that does not quite fit. Errors that take them for
independent are then far too small. The model here is

    residual = scale · (white noise + noise with a memory of τ points),

with both shares and τ open. Each combination on a grid is weighed by its likelihood, with the
parameters of the fit integrated out (REML) and Schwarz's price of two more numbers for the memory
(G. Schwarz, Ann. Stat. 6, 461, 1978); the covariance is the mean over the grid.
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Noise", "spread"]

Array = NDArray[np.float64]

_SHARES = (0.2, 0.6, 0.9, 1.0)  # of the variance that has a memory
_MEMORIES = 7  # of them, from one point on
_LONGEST = 0.5  # of the record
_NONE = 1e-6  # a weight that does not count


class Noise:
    """The noise of a branch, learned from the residuals of a fit.

    Parameters
    ----------
    residual : ndarray
        (N,) residuals, each over its relative scale.
    jacobian : ndarray
        (N, q) derivatives of the fit by its parameters, over the same scales.
    """

    def __init__(self, residual: Array, jacobian: Array) -> None:
        self.residual = residual
        self.jacobian = jacobian

    def covariance(self, rows: Array) -> Array:
        """Return the covariance of linear combinations of the noise.

        Parameters
        ----------
        rows : ndarray
            (m, N) weights of each point's noise, times the same scales.

        Returns
        -------
        ndarray
            (m, m).
        """
        white, remembered = self._grid
        result = white * (rows @ rows.T)
        for phi, weight in remembered:
            product = _remember(rows, phi) @ rows.T
            result = result + 0.5 * weight * (product + product.T)
        return np.asarray(result)

    @cached_property
    def _grid(self) -> tuple[float, list[tuple[float, float]]]:
        """Return the mean variance of the white part, and that of the part with each memory."""
        count, width = self.jacobian.shape
        longest = max(2.0, _LONGEST * count)
        both = np.column_stack([self.residual, self.jacobian])
        free = max(1, count - width)
        found = [(1.0, 0.0, *_likelihood(both, both, 0.0, free))]

        def look(memories: Array) -> None:
            for memory in memories.tolist():
                for share in _SHARES:
                    solved, log_det = _solved(both, float(np.exp(-1.0 / memory)), share)
                    found.append((memory, share, *_likelihood(both, solved, log_det, free)))

        look(np.geomspace(1.0, longest, _MEMORIES))
        best = max(found[1:], key=lambda row: row[2])
        if best[2] - np.log(count) > found[0][2]:  # it has one: look closer
            ratio = longest ** (1.0 / (_MEMORIES - 1))
            look(best[0] * ratio ** (np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0]) / 4.0))
        return _mean(found, count)


def _mean(
    found: list[tuple[float, float, float, float]], count: int
) -> tuple[float, list[tuple[float, float]]]:
    """Return the mean over (memory, share, log-likelihood, variance), white noise being first."""
    best = max(row[2] for row in found)
    weights = np.array([np.exp(row[2] - best) for row in found])
    # all with a memory together: the best likelihood, less for two numbers more (Schwarz)
    weights[1:] *= weights[1:].max() / max(weights[1:].sum(), 1e-300) / count
    weights /= weights.sum()
    white = 0.0
    kept: dict[float, float] = {}
    for (memory, share, _, variance), weight in zip(found, weights.tolist(), strict=True):
        white += weight * variance * (1.0 - share)
        if share * weight > _NONE:
            phi = float(np.exp(-1.0 / memory))
            kept[phi] = kept.get(phi, 0.0) + weight * variance * share
    return white, list(kept.items())


def spread(values: Array) -> float:
    """Return the noise of a smooth series from point to point, by its second differences.

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(0.0, 0.1, 10_000)
    >>> round(spread(np.linspace(0.0, 5.0, 10_000) + noise), 2)
    0.1
    """
    if len(values) < 4:
        return 0.0
    bends = np.abs(np.diff(values, 2))
    # the median of a normal variable's absolute value is 0.6745 of its deviation
    return float(np.median(bends) / 0.6745 / np.sqrt(6.0))


def _likelihood(both: Array, solved: Array, log_det: float, free: int) -> tuple[float, float]:
    """Return the log-likelihood up to a constant, and the variance that goes with it."""
    gram = both.T @ solved
    inner = gram[1:, 1:]
    values, vectors = np.linalg.eigh(inner)
    values = np.maximum(values, 1e-12 * values[-1])
    explained = float((((gram[0, 1:] @ vectors) ** 2) / values).sum())
    square = max(float(gram[0, 0]) - explained, 1e-300)
    log_inner = float(np.log(values).sum())
    return -0.5 * (free * np.log(square) + log_det + log_inner), square / free


def _solved(both: Array, phi: float, share: float) -> tuple[Array, float]:
    """Return V⁻¹ times columns and ln det V, with V = (1 - share) + share R and R_ij = φ**|i-j|.

    R⁻¹ is tridiagonal, and V = ((1 - share) R⁻¹ + share) R.
    """
    from scipy.linalg import cho_solve_banded, cholesky_banded

    count = len(both)
    innovation = 1.0 - phi * phi
    band: Any = np.empty((2, count))
    band[0] = -phi / innovation
    band[1] = (1.0 + phi * phi) / innovation
    band[1, [0, -1]] = 1.0 / innovation
    inverse = band.copy()
    band *= 1.0 - share
    band[1] += share
    factor = cholesky_banded(band, check_finite=False)
    half = cho_solve_banded((factor, False), both, check_finite=False)
    solved = inverse[1][:, None] * half
    solved[1:] += inverse[0, 1:, None] * half[:-1]
    solved[:-1] += inverse[0, 1:, None] * half[1:]
    log_det = 2.0 * float(np.log(factor[1]).sum()) + (count - 1) * float(np.log(innovation))
    return solved, log_det


def _remember(rows: Array, phi: float) -> Array:
    """Return rows times R, with R_ij = φ**|i-j|."""
    from scipy.signal import lfilter

    up = lfilter([1.0], [1.0, -phi], rows, axis=1)
    down = lfilter([1.0], [1.0, -phi], rows[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(up + down - rows)
