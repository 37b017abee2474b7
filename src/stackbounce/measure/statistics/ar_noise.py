"""Autocorrelated noise: linear prediction, autocorrelation times, noise on smooth series.

Neighbouring points of a record are disturbed alike: by a drift, a filter, the steps of a converter,
a law that does not quite fit. Assuming independent errors makes error bars far too small.
"""

import numpy as np

from stackbounce.measure.quantities import Array, Samples

_CHUNK = 1024  # samples in a row from which a linear prediction is learned
_ORDER = 24  # samples that a prediction is made from
_MOST_LAGS = 200  # of an autocorrelation that are added up, for speed
_LEAST_SAMPLES = 48  # of a series whose autocorrelation is estimated
_NORMAL_MEDIAN = 0.6745  # median absolute value of a standard normal variable


def whitened(values: Samples, rounding: float) -> Samples:
    """Return the linear-prediction residual of a signal, learned from its quiet half.

    The prediction removes hum and stationary noise of any spectrum; sudden changes remain.

    Parameters
    ----------
    values : ndarray
        (N,).
    rounding : float
        Variance of the quantisation error, which cannot be predicted.

    Returns
    -------
    ndarray
        (N,), 0 in the first 24 samples; the values themselves where all is 0.

    Examples
    --------
    >>> hum = np.sin(np.arange(48000) * 2 * np.pi * 50 / 48000).astype(np.float32)
    >>> bool(np.abs(whitened(hum, 0.0)[1000:]).max() < 0.01)
    True
    """
    from scipy.linalg import solve_toeplitz

    chunks = values[: len(values) // _CHUNK * _CHUNK].reshape(-1, _CHUNK)
    energies = np.einsum("ij,ij->i", chunks, chunks)
    middle = np.median(energies) if len(chunks) else 0.0
    quiet = chunks[energies <= middle]
    some = quiet[:: max(1, len(quiet) // 512)].astype(np.float64)
    lagged = ((some[:, lag:], some[:, : _CHUNK - lag]) for lag in range(_ORDER + 1))
    products = [float(np.einsum("ij,ij->", *pair)) for pair in lagged]
    products[0] = products[0] * (1.0 + 1e-7) + some.size * rounding
    if not products[0] > 0.0:
        return values
    prediction = solve_toeplitz(products[:-1], products[1:])
    weights = np.concatenate([[1.0], -prediction]).astype(np.float32)
    residual = np.convolve(weights, values)[: len(values)]
    residual[:_ORDER] = 0.0
    return residual


def correlation_factor(residuals: Array, least: int = _LEAST_SAMPLES) -> float:
    """Return the factor by which autocorrelation increases the variance of an average.

    Series of fewer than `least` residuals are taken as white.

    Examples
    --------
    >>> noise = np.random.default_rng(1).normal(0.0, 1.0, 10_000)
    >>> correlation_factor(noise), round(correlation_factor(np.repeat(noise, 4)))
    (1.0, 4)
    """
    count = len(residuals)
    if count < least:
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
