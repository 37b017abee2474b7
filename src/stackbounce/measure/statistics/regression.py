"""Linear regression with correlated errors and excess scatter; error bars from few points."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from stackbounce.measure.quantities import Array, Number, spread_of

_REPORTED_BELOW = 0.01  # p-value of chi squared: then an excess scatter is reported
_LEAST_SCATTER = 0.1  # of the smallest error: the smallest excess scatter on the grid
_SCATTERS = 20  # excess scatters on the grid
_ODDS_OF_NONE = 4.0  # prior odds of no excess scatter
_WITHIN_ONE = 0.6826894921370859  # probability of a normal variable within one sigma


class Fit(NamedTuple):
    """Parameters (P,), their covariance (P, P), χ² and its degrees of freedom."""

    values: Array
    covariance: Array
    chi_squared: float
    freedom: int


def covariance_of(values: Sequence[Number]) -> Array:
    """Return the covariance matrix of numbers with errors, (N, N).

    `uncertainties.covariance_matrix` sums over a set, whose order differs from run to run, and so
    do the last bits of its sums. Here the sums have one order.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> x = ufloat(1.0, 0.5)
    >>> covariance_of([x, 2.0 * x])
    array([[0.25, 0.5 ],
           [0.5 , 1.  ]])
    """
    spread = spread_of(values)
    return np.array([[float(np.sum(column * other)) for other in spread] for column in spread])


def least_squares(design: Array, values: Array, covariance: Array) -> Fit:
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


def _fits(design: Array, values: Array, covariances: Array) -> tuple[Array, Array, Array]:
    """Return parameters (K, P), their covariances (K, P, P) and χ² (K,) for each covariance."""
    inverses = np.linalg.pinv(covariances, hermitian=True)
    spreads = np.asarray(np.linalg.inv(design.T @ inverses @ design), dtype=np.float64)
    parameters = spreads @ design.T @ inverses @ values
    residuals = values - parameters @ design.T
    return parameters, spreads, np.einsum("ki,kij,kj->k", residuals, inverses, residuals)


def fit_with_excess_scatter(
    design: Array, values: Array, covariance: Array, most: float
) -> tuple[Fit, float]:
    """Return the fit to values that may scatter by more than their errors, and the excess scatter.

    The prior of the excess scatter has odds of four to one for none; else it is log-uniform from a
    tenth of the smallest error to `most`. The parameters are posterior means, and an error is half
    the width of the interval around the mean that holds 68.3 % of the posterior; for a large
    scatter this is Student's t. Few values cannot distinguish an excess scatter slightly above the
    errors from none, and then the error bars are too short.

    Parameters
    ----------
    design, values, covariance : ndarray
        As in `least_squares`.
    most : float
        The largest scatter that there can be, in the unit of the values.

    Returns
    -------
    fit : Fit
        With χ² of the given errors alone.
    scatter : float
        The posterior median of the excess scatter where the p-value of χ² is below 0.01; else 0.

    Examples
    --------
    >>> one, values = np.ones((4, 1)), np.array([0.1, 0.2, 0.3, 0.4])
    >>> fit, scatter = fit_with_excess_scatter(one, values, 1e-6 * np.eye(4), 1.0)
    >>> round(float(fit.covariance[0, 0] ** 0.5), 2), round(scatter, 2)
    (0.08, 0.14)
    >>> fit_with_excess_scatter(one, values, 0.01 * np.eye(4), 1.0)[1]
    0.0
    """
    from scipy.special import chdtrc

    plain = least_squares(design, values, covariance)
    least = _LEAST_SCATTER * float(np.sqrt(np.diag(covariance).min()))
    if plain.freedom < 1 or not 0.0 < least < most:
        return plain, 0.0
    scatters = np.concatenate([[0.0], np.geomspace(least, most, _SCATTERS)])
    every = covariance + scatters[:, None, None] ** 2 * np.eye(len(values))
    means, spreads, squares = _fits(design, values, every)
    evidence = np.linalg.slogdet(spreads)[1] - np.linalg.slogdet(every)[1] - squares
    prior = [_ODDS_OF_NONE * _SCATTERS, *[1.0] * _SCATTERS]
    weights = np.exp(0.5 * (evidence - evidence.max())) * prior
    weights /= weights.sum()
    mean = weights @ means
    off = means - mean
    total = np.einsum("k,kij->ij", weights, spreads) + (weights[:, None] * off).T @ off
    errors = np.sqrt(np.diagonal(spreads, axis1=1, axis2=2))
    halves = [half_width(weights, off[:, i], errors[:, i]) for i in range(len(mean))]
    stretch = np.array(halves) / np.sqrt(np.diag(total))
    fit = Fit(mean, total * np.outer(stretch, stretch), plain.chi_squared, plain.freedom)
    if chdtrc(plain.freedom, plain.chi_squared) > _REPORTED_BELOW:
        return fit, 0.0
    share = np.cumsum(weights[1:]) / weights[1:].sum()
    return fit, float(scatters[1 + np.searchsorted(share, 0.5)])


def half_width(weights: Array, off: Array, errors: Array) -> float:
    """Return half the width of the interval around 0 that holds 68.3 % of a normal mixture."""
    from scipy.optimize import brentq
    from scipy.special import ndtr

    def excess(half: float) -> float:
        inside = ndtr((half - off) / errors) - ndtr((-half - off) / errors)
        return float(weights @ inside) - _WITHIN_ONE

    return float(brentq(excess, 0.0, 10.0 * float((errors + np.abs(off)).max())))


def widening(freedom: float) -> float:
    """Return the factor by which an error bar grows if sigma itself was estimated: Student's t.

    Parameters
    ----------
    freedom : float
        The degrees of freedom of the estimate, above 0.

    Returns
    -------
    float
        With it the error bar covers the truth in 68.3 % of all cases.

    Examples
    --------
    >>> round(widening(1), 2), round(widening(4), 2), round(widening(100), 2)
    (1.84, 1.14, 1.01)
    """
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 0.8413447460685429))
