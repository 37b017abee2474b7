"""Where a function of one number is zero."""

from collections.abc import Callable

__all__ = ["root"]

_MARGIN = 1e-3  # round-off at an end of a bracket must not hide the change of sign
_CLOSEST = 1e-15  # relative
_ROUNDS = 2000  # a bracket of numbers above 0 can span 600 decades


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the zero of an increasing or decreasing function, to the last digits.

    Parameters
    ----------
    function : callable
        From a float to a float.
    low, high : float
        Between which it lies, above 0; both may be as close to it as round-off allows.

    Returns
    -------
    float

    Notes
    -----
    Source: R. P. Brent, Algorithms for Minimization Without Derivatives (1973), as in scipy.

    Examples
    --------
    >>> round(root(lambda x: x * x - 2.0, 1.0, 2.0), 15)
    1.414213562373095
    """
    from scipy.optimize import brentq

    ends = low * (1.0 - _MARGIN), high * (1.0 + _MARGIN)
    return float(brentq(function, *ends, xtol=5e-324, rtol=_CLOSEST, maxiter=_ROUNDS))
