"""Power laws fitted to a press record by least squares, with the sensitivity to each point's noise.

To first order every number found is a linear function of the noise of the points. Its weights are
kept as a row, so that all errors and correlations follow from one covariance of the noise.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PowerFit", "fit_loading", "fit_unloading", "power", "rough_contact"]

Array = NDArray[np.float64]

_EXPONENTS = (0.7, 1.0, 1.5, 2.0, 3.0)  # tried first
_PLACES = 48  # of the touch, tried first
_FEW = 300  # points, which are enough for that
_WIDEST = 20.0  # ln of a parameter stays within ±this, so that no power overflows


@dataclass(frozen=True)
class PowerFit:
    """A power of the compression, fitted to a branch: ``F = P ((c - c0)/C)**p``, 0 below c0.

    Parameters
    ----------
    values : ndarray
        P, ln p, and for the loading ln C, where c0 is the given peak less C.
    weights : ndarray
        (q, N) how much each of them moves with the noise of each point.
    jacobian : ndarray
        (N, q) how much the fit moves with each of them.
    residual : ndarray
        (N,) force less fit.
    """

    values: Array
    weights: Array
    jacobian: Array
    residual: Array


def power(ratio: Array, exponent: float) -> Array:
    """Return a ratio to a power, 0 where it is not above 0.

    Examples
    --------
    >>> power(np.array([-1.0, 0.0, 0.25]), 1.5)
    array([0.   , 0.   , 0.125])
    """
    result = np.zeros_like(ratio)
    above = ratio > 0.0
    result[above] = ratio[above] ** exponent
    return result


def rough_contact(x: Array, y: Array) -> tuple[float, float]:
    """Return about where the force begins to rise, and the exponent, whatever the force's zero.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression and force of a loading.

    Returns
    -------
    tuple of float
    """
    some = np.linspace(0, len(x) - 1, min(len(x), _FEW)).astype(int)
    x, y = x[some], y[some]
    low, high = float(x.min()), float(x.max())
    places = np.linspace(low - 0.5 * (high - low), high - 0.1 * (high - low), _PLACES)
    best = (np.inf, low, 1.0)
    dy = y - y.mean()
    for p in _EXPONENTS:
        rise = power((x[None, :] - places[:, None]) / (high - low), p)
        rise -= rise.mean(axis=1, keepdims=True)
        square = (rise**2).sum(axis=1) + 1e-300
        along = rise @ dy
        rest = dy @ dy - np.where(along > 0.0, along**2 / square, 0.0)
        i = int(rest.argmin())
        if rest[i] < best[0]:
            best = (float(rest[i]), float(places[i]), p)
    return best[1], best[2]


def fit_loading(
    x: Array, y: Array, peak: float, start: tuple[float, float], scale: Any
) -> PowerFit:
    """Fit ``P ((x - peak + C)/C)**p``, with P, ln p and ln C open.

    Parameters
    ----------
    x, y : ndarray
        (N,) compression and force, its zero taken off.
    peak : float
        Where the force is P.
    start : (float, float)
        Contact and exponent to start from.
    scale : ndarray or float
        Relative noise of the points.

    Returns
    -------
    PowerFit
    """

    def curve(values: Array) -> tuple[Array, Array]:
        top, p, c = values[0], *np.exp(np.clip(values[1:], -_WIDEST, _WIDEST))
        ratio = 1.0 - (peak - x) / c
        unit = power(ratio, p)
        log = np.log(np.where(ratio > 0.0, ratio, 1.0))
        by_length = top * p * power(ratio, p - 1.0) * (1.0 - ratio)
        by_length[ratio <= 0.0] = 0.0
        return top * unit, np.column_stack([unit, top * p * unit * log, by_length])

    first = np.array([max(float(y[-1]), 0.1 * float(np.ptp(y))), np.log(start[1]), 0.0])
    first[2] = np.log(max(peak - start[0], 1e-3 * float(np.ptp(x))))
    return _least_squares(curve, first, y, scale)


def fit_unloading(x: Array, y: Array, peak: float, length: float, scale: Any) -> PowerFit:
    """Fit ``P ((x - peak + C)/C)**n``, with P and ln n open, and C known as `length`."""
    ratio = 1.0 - (peak - x) / length
    log = np.log(np.where(ratio > 0.0, ratio, 1.0))

    def curve(values: Array) -> tuple[Array, Array]:
        top, n = values[0], np.exp(np.clip(values[1], -_WIDEST, _WIDEST))
        unit = power(ratio, n)
        return top * unit, np.column_stack([unit, top * n * unit * log])

    first = np.array([max(float(y[0]), 0.1 * float(np.ptp(y))), np.log(2.0)])
    return _least_squares(curve, first, y, scale)


def _least_squares(curve: Any, first: Array, y: Array, scale: Any) -> PowerFit:
    from scipy.optimize import least_squares

    weight: Array = np.broadcast_to(1.0 / np.asarray(scale, float), y.shape)
    solved = least_squares(
        lambda values: (curve(values)[0] - y) * weight,
        first,
        jac=lambda values: curve(values)[1] * weight[:, None],
        method="lm",
        xtol=1e-10,
        ftol=1e-12,
        max_nfev=300,
    )
    fitted, jacobian = curve(solved.x)
    # weights = (JᵀWJ)⁻¹ JᵀW
    inverse = np.linalg.pinv(jacobian * weight[:, None], rcond=1e-11)
    return PowerFit(solved.x, inverse * weight, jacobian, y - fitted)
