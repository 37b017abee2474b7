"""Autocorrelated noise: AR(1) noise in regressions, linear prediction, autocorrelation times.

Neighbouring points of a record are disturbed alike: by a drift, a filter, the steps of a converter,
a law that does not quite fit. Assuming independent errors makes error bars far too small.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.quantities import Array

_SHARES = (0.2, 0.6, 0.9, 1.0)  # of the variance that is AR(1) noise, on the grid
_TIMES = 7  # correlation times on the grid, from one point on
_LONGEST_TIME = 0.5  # of the record: the longest correlation time on the grid
_LEAST_WEIGHT = 1e-6  # of a noise model that counts in the mean
_LEAST_FREEDOM = 1e-9  # degrees of freedom of as many points as parameters, instead of 0
_CHUNK = 1024  # samples in a row from which a linear prediction is learned
_MOST_LAGS = 200  # of an autocorrelation that are added up, for speed
_LEAST_SAMPLES = 48  # of a series whose autocorrelation is estimated
_NORMAL_MEDIAN = 0.6745  # median absolute value of a standard normal variable


def noise_covariance(residual: Array, jacobian: Array, rows: Array) -> Array:
    """Return the covariance of linear combinations of noise that the residuals of a fit show.

    The model is white noise plus AR(1) noise of a correlation time of τ points, with both variances
    and τ unknown. Each combination on a grid is weighted by its restricted likelihood (REML), in
    which the parameters of the fit are integrated out, and by Schwarz's penalty for the two numbers
    of the AR(1) noise (G. Schwarz, Ann. Stat. 6, 461, 1978). The covariance is the mean over the
    grid.

    Parameters
    ----------
    residual : ndarray
        (N,) residuals, each over its relative scale.
    jacobian : ndarray
        (N, q) derivatives of the fit by its parameters, over the same scales.
    rows : ndarray
        (m, N) weights of each point's noise, times the same scales.

    Returns
    -------
    ndarray
        (m, m).
    """
    white, correlated = _mean(_grid(residual, jacobian), len(residual))
    result = white * (rows @ rows.T)
    for phi, weight in correlated:
        product = _correlated(rows, phi) @ rows.T
        result = result + 0.5 * weight * (product + product.T)
    return np.asarray(result)


def _grid(residual: Array, jacobian: Array) -> list[tuple[float, float, float, float]]:
    """Return noise models (time, share, log-likelihood, variance); the first is white noise."""
    count = len(residual)
    longest = max(2.0, _LONGEST_TIME * count)
    found: list[tuple[float, float, float, float]] = []

    def add(times: Array, shares: Sequence[float] = _SHARES) -> None:
        for time in times.tolist():
            for share in shares:
                phi = float(np.exp(-1.0 / time))
                found.append((time, share, *_fit(jacobian, residual, phi, share)))

    add(np.ones(1), (0.0,))
    add(np.geomspace(1.0, longest, _TIMES))
    best = max(found[1:], key=lambda row: row[2])
    if best[2] - np.log(count) > found[0][2]:  # the noise is autocorrelated: refine the grid
        ratio = longest ** (1.0 / (_TIMES - 1))
        add(best[0] * ratio ** (np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0]) / 4.0))
    return found


def _mean(
    found: list[tuple[float, float, float, float]], count: int
) -> tuple[float, list[tuple[float, float]]]:
    """Average noise models (time, share, log-likelihood, variance); the first is white noise."""
    best = max(row[2] for row in found)
    weights = np.array([np.exp(row[2] - best) for row in found])
    # all AR(1) models together get the weight of the best one, less Schwarz's penalty
    weights[1:] *= weights[1:].max() / max(weights[1:].sum(), 1e-300) / count
    weights /= weights.sum()
    white = 0.0
    kept: dict[float, float] = {}
    for (time, share, _, variance), weight in zip(found, weights.tolist(), strict=True):
        white += weight * variance * (1.0 - share)
        if share * weight > _LEAST_WEIGHT:
            phi = float(np.exp(-1.0 / time))
            kept[phi] = kept.get(phi, 0.0) + weight * variance * share
    return white, list(kept.items())


def linear_prediction_residual(
    values: NDArray[np.float32], order: int, rounding: float
) -> NDArray[np.float32]:
    """Return the linear-prediction residual of a signal, learned from its quiet half.

    The prediction removes hum and stationary noise of any spectrum; sudden changes remain.

    Parameters
    ----------
    values : ndarray
        (N,).
    order : int
        Samples that a prediction is made from.
    rounding : float
        Variance of the quantisation error, which cannot be predicted.

    Returns
    -------
    ndarray
        (N,), 0 in the first `order` samples; the values themselves where all is 0.

    Examples
    --------
    >>> hum = np.sin(np.arange(48000) * 2 * np.pi * 50 / 48000).astype(np.float32)
    >>> bool(np.abs(linear_prediction_residual(hum, 24, 0.0)[1000:]).max() < 0.01)
    True
    """
    from scipy.linalg import solve_toeplitz
    from scipy.signal import lfilter

    chunks = values[: len(values) // _CHUNK * _CHUNK].reshape(-1, _CHUNK)
    energies = np.einsum("ij,ij->i", chunks, chunks)
    middle = np.median(energies) if len(chunks) else 0.0
    quiet = chunks[energies <= middle]
    some = quiet[:: max(1, len(quiet) // 512)].astype(np.float64)
    products = [
        float(np.einsum("ij,ij->", some[:, lag:], some[:, : _CHUNK - lag]))
        for lag in range(order + 1)
    ]
    products[0] = products[0] * (1.0 + 1e-7) + some.size * rounding
    if not products[0] > 0.0:
        return values
    prediction = solve_toeplitz(products[:-1], products[1:])
    weights = np.concatenate([[1.0], -prediction]).astype(np.float32)
    residual = np.asarray(lfilter(weights, np.float32(1.0), values), dtype=np.float32)
    residual[:order] = 0.0
    return residual


def correlation_factor(residuals: Array) -> float:
    """Return the factor by which autocorrelation increases the variance of an average.

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(0.0, 1.0, 10_000)
    >>> correlation_factor(noise), round(correlation_factor(np.repeat(noise, 4)))
    (1.0, 4)
    """
    count = len(residuals)
    if count < _LEAST_SAMPLES:
        return 1.0
    power = float(np.mean(residuals**2))
    total = 1.0
    for lag in range(1, min(_MOST_LAGS, count // 4)):
        rho = float(np.mean(residuals[lag:] * residuals[:-lag])) / power if power > 0.0 else 0.0
        if rho < 2.0 / np.sqrt(count):
            break
        total += 2.0 * rho
    return total


def difference_noise(values: Array, order: int = 2) -> float:
    """Return the standard deviation of white noise on a smooth series, by its differences.

    It is the median absolute difference over that of unit noise, so that outliers do not matter.

    Parameters
    ----------
    values : ndarray
        (N,).
    order : int, optional
        Of the differences: 1 for a constant series, 2 for a linear one.

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(0.0, 0.1, 10_000)
    >>> round(difference_noise(np.linspace(0.0, 5.0, 10_000) + noise), 2)
    0.1
    """
    from math import comb

    if len(values) < 4:
        return 0.0
    middle = float(np.median(np.abs(np.diff(values, order))))
    return float(middle / _NORMAL_MEDIAN / np.sqrt(float(comb(2 * order, order))))


def _fit(design: Array, values: Array, phi: float, share: float) -> tuple[float, float]:
    """Fit ``values = design @ parameters`` by generalised least squares to white and AR(1) noise.

    Return the restricted log-likelihood of the noise, and the variance of an error.

    Parameters
    ----------
    design, values : ndarray
        (N, P) and (N,).
    phi : float
        Correlation of neighbouring points' AR(1) noise.
    share : float
        Of the variance that is AR(1) noise.
    """
    both = np.column_stack([values, design])
    solved, log_det = _solved(both, phi, share)
    gram = both.T @ solved
    sizes, vectors = np.linalg.eigh(gram[1:, 1:])
    sizes = np.maximum(sizes, 1e-12 * sizes[-1])
    along = vectors.T @ gram[1:, 0]
    square = max(float(gram[0, 0] - (along**2 / sizes).sum()), 1e-300)
    freedom = max(len(values) - design.shape[1], _LEAST_FREEDOM)
    variance = square / freedom
    likelihood = -0.5 * (freedom * np.log(variance) + log_det + float(np.log(sizes).sum()))
    return likelihood, variance


def _solved(columns: Array, phi: float, share: float) -> tuple[Array, float]:
    """Return V⁻¹ times columns and ln det V, with V = (1 - share) + share R of AR(1) noise's R.

    R⁻¹ is tridiagonal, and V = ((1 - share) R⁻¹ + share) R.
    """
    from scipy.linalg import cho_solve_banded, cholesky_banded

    innovation = 1.0 - phi**2
    beside = -phi / innovation
    diagonal = np.full(len(columns), (1.0 + phi**2) / innovation)
    diagonal[[0, -1]] = 1.0 / innovation
    half, log_det = columns, (len(columns) - 1) * float(np.log(innovation))
    if share < 1.0:
        band = np.stack([np.full_like(diagonal, beside), diagonal]) * (1.0 - share)  # upper form
        band[1] += share
        factor = cholesky_banded(band, check_finite=False)
        half = cho_solve_banded((factor, False), columns, check_finite=False)
        log_det += 2.0 * float(np.log(factor[1]).sum())
    solved = diagonal[:, None] * half
    solved[1:] += beside * half[:-1]
    solved[:-1] += beside * half[1:]
    return solved, log_det


def _correlated(rows: Array, phi: float) -> Array:
    """Return rows times R, with R_ij = φ**|i-j|."""
    from scipy.signal import lfilter

    up = lfilter([1.0], [1.0, -phi], rows, axis=1)
    down = lfilter([1.0], [1.0, -phi], rows[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(up + down - rows)
