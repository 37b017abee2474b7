"""Straight fits to values whose errors go together, and error bars from few points."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Fit", "extra_scatter", "least_squares", "widening"]

_RARE = 0.01
"""How improbable a scatter must be before it is taken for more than the errors that were given."""


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
    inverse = np.linalg.pinv(covariance, hermitian=True)
    spread = np.asarray(np.linalg.inv(design.T @ inverse @ design), dtype=np.float64)
    parameters = spread @ design.T @ inverse @ values
    residuals = values - design @ parameters
    chi_squared = float(residuals @ inverse @ residuals)
    return Fit(parameters, spread, chi_squared, len(values) - design.shape[1])


def extra_scatter(
    design: NDArray[np.float64], values: NDArray[np.float64], covariance: NDArray[np.float64]
) -> float:
    """Return the scatter that values have beyond their errors, 0 where these explain it.

    It is what makes χ² equal to its degrees of freedom when it is added to each error (R. Mandel
    and R. Paule, Anal. Chem. 42, 1194, 1970); looked for only where χ² would be as large in one
    case of a hundred.

    Parameters
    ----------
    design, values, covariance : ndarray
        As in `least_squares`.

    Returns
    -------
    float
        In the unit of the values.

    Examples
    --------
    >>> round(extra_scatter(np.ones((4, 1)), np.array([0.0, 1, 2, 3]), 1e-4 * np.eye(4)), 2)
    1.29
    """
    from scipy.optimize import brentq
    from scipy.stats import chi2

    fit = least_squares(design, values, covariance)
    if fit.freedom < 1 or chi2.sf(fit.chi_squared, fit.freedom) > _RARE:
        return 0.0

    def excess(scatter: float) -> float:
        wider = covariance + scatter**2 * np.eye(len(values))
        return least_squares(design, values, wider).chi_squared - fit.freedom

    most = 10.0 * float(np.ptp(values)) + 1e-300
    return float(brentq(excess, 0.0, most, xtol=1e-6 * most))


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
