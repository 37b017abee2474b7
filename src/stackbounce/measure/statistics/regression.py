"""Straight fits to values whose errors go together, and error bars from few points."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Fit", "least_squares", "scattered", "widening"]

_RARE = 0.01
"""How improbable a scatter must be before it is taken for more than the errors that were given."""
_LEAST, _SCATTERS = 0.1, 20  # the least scatter in errors, and how many are tried
_NONE = 4.0  # odds, before the values are seen, that there is no scatter
_ONE = 0.6826894921370859  # what one sigma holds


class Fit(NamedTuple):
    """Parameters (P,), their covariance (P, P), χ² and its degrees of freedom."""

    values: NDArray[np.float64]
    covariance: NDArray[np.float64]
    chi_squared: float
    freedom: int


def least_squares(
    design: NDArray[np.float64], values: NDArray[np.float64], covariance: NDArray[np.float64]
) -> Fit:
    """Return the generalised least squares fit of ``values = design @ parameters``.

    Parameters
    ----------
    design : ndarray
        (N, P), of full rank.
    values : ndarray
        (N,).
    covariance : ndarray
        (N, N) of the values' errors.

    Returns
    -------
    Fit

    Examples
    --------
    >>> fit = least_squares(np.ones((4, 1)), np.array([1.0, 2.0, 2.0, 3.0]), np.eye(4))
    >>> float(fit.values[0]), float(fit.covariance[0, 0]), fit.chi_squared, fit.freedom
    (2.0, 0.25, 2.0, 3)
    """
    (parameters,), (spread,), (chi_squared,) = _fits(design, values, covariance[None])
    return Fit(parameters, spread, float(chi_squared), len(values) - design.shape[1])


def _fits(
    design: NDArray[np.float64], values: NDArray[np.float64], covariances: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return parameters (K, P), their covariances (K, P, P) and χ² (K,) for each covariance."""
    inverses = np.linalg.pinv(covariances, hermitian=True)
    spreads = np.asarray(np.linalg.inv(design.T @ inverses @ design), dtype=np.float64)
    parameters = spreads @ design.T @ inverses @ values
    residuals = values - parameters @ design.T
    return parameters, spreads, np.einsum("ki,kij,kj->k", residuals, inverses, residuals)


def scattered(
    design: NDArray[np.float64],
    values: NDArray[np.float64],
    covariance: NDArray[np.float64],
    most: float,
) -> tuple[Fit, float]:
    """Return the fit to values that may scatter beyond their errors, and by how much they do.

    How much is not known beforehand: with odds of four to one not at all, else by any amount from a
    tenth of the least error to `most`, each power of ten being equally likely. The parameters are
    their posterior's means; their errors are half as wide as what holds 68.3 % of it, as Student's
    t would have it where the scatter is large. A scatter that is somewhat larger than the errors
    cannot be told from none by few values; error bars are too short then.

    Parameters
    ----------
    design, values, covariance : ndarray
        As in `least_squares`.
    most : float
        The largest scatter that there can be, in the unit of the values.

    Returns
    -------
    fit : Fit
        With χ² of the errors alone.
    scatter : float
        Its median where χ² would be as large in less than one case of a hundred; else 0.

    Examples
    --------
    >>> one = np.ones((4, 1))
    >>> fit, scatter = scattered(one, np.array([0.1, 0.2, 0.3, 0.4]), 1e-6 * np.eye(4), 1.0)
    >>> round(float(fit.covariance[0, 0] ** 0.5), 2), round(scatter, 2)
    (0.08, 0.14)
    >>> scattered(one, np.array([0.1, 0.2, 0.3, 0.4]), 0.01 * np.eye(4), 1.0)[1]
    0.0
    """
    from scipy.stats import chi2

    plain = least_squares(design, values, covariance)
    least = _LEAST * float(np.sqrt(np.diag(covariance).min()))
    if plain.freedom < 1 or not 0.0 < least < most:
        return plain, 0.0
    scatters = np.concatenate([[0.0], np.geomspace(least, most, _SCATTERS)])
    every = covariance + scatters[:, None, None] ** 2 * np.eye(len(values))
    means, spreads, squares = _fits(design, values, every)
    evidence = np.linalg.slogdet(spreads)[1] - np.linalg.slogdet(every)[1] - squares
    weights = np.exp(0.5 * (evidence - evidence.max())) * [_NONE * _SCATTERS, *[1.0] * _SCATTERS]
    weights /= weights.sum()
    mean = weights @ means
    off = means - mean
    total = np.einsum("k,kij->ij", weights, spreads) + (weights[:, None] * off).T @ off
    errors = np.sqrt(np.diagonal(spreads, axis1=1, axis2=2))
    halves = [_half(weights, off[:, i], errors[:, i]) for i in range(len(mean))]
    stretch = np.array(halves) / np.sqrt(np.diag(total))
    fit = Fit(mean, total * np.outer(stretch, stretch), plain.chi_squared, plain.freedom)
    if chi2.sf(plain.chi_squared, plain.freedom) > _RARE:
        return fit, 0.0
    share = np.cumsum(weights[1:]) / weights[1:].sum()
    return fit, float(scatters[1 + np.searchsorted(share, 0.5)])


def _half(
    weights: NDArray[np.float64], off: NDArray[np.float64], errors: NDArray[np.float64]
) -> float:
    """Return half the width of what holds 68.3 % of a sum of normal distributions, around 0."""
    from scipy.optimize import brentq
    from scipy.special import ndtr

    def excess(half: float) -> float:
        return float(weights @ (ndtr((half - off) / errors) - ndtr((-half - off) / errors))) - _ONE

    return float(brentq(excess, 0.0, 10.0 * float((errors + np.abs(off)).max())))


def widening(freedom: float) -> float:
    """Return how much wider one sigma is when it was itself estimated, by Student's t.

    Parameters
    ----------
    freedom : float
        The degrees of freedom of the estimate, above 0.

    Returns
    -------
    float
        So that the error bar still covers the truth in 68.3 % of all cases.

    Examples
    --------
    >>> round(widening(1), 2), round(widening(4), 2), round(widening(100), 2)
    (1.84, 1.14, 1.01)
    """
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 0.8413447460685429))
