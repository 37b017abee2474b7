"""Numerical integration of functions that are not smooth at the ends of their range."""

import functools
import math
from collections.abc import Callable

_STEP = 1.0 / 32.0
_REACH = 116  # steps to either side, where the weights are below 1e-17 of the largest


def integral(function: Callable[[float], float]) -> float:
    """Return the integral of a bounded function of ln(z) over z from 0 to 1.

    Parameters
    ----------
    function : callable
        Its argument is ln(z), which resolves z near 1 to the last digit. It must be analytic
        between the ends.

    Returns
    -------
    float

    Notes
    -----
    Double-exponential quadrature: the trapezoidal rule in t, ``z = 1/(1 + exp(-π sinh(t)))``.
    The step is fixed; there is no tolerance.

    Source: H. Takahasi and M. Mori, Publ. RIMS 9, 721 (1974).

    Examples
    --------
    >>> round(integral(lambda log_z: math.exp(1.5 * log_z)), 14)
    0.4
    """
    return math.fsum(weight * function(log_z) for log_z, weight in _nodes())


@functools.cache
def _nodes() -> list[tuple[float, float]]:
    nodes = []
    for i in range(-_REACH, _REACH + 1):
        t = i * _STEP
        s = math.pi * math.sinh(t)
        log_z = -math.log1p(math.exp(-s))
        log_rest = -math.log1p(math.exp(s))  # of 1 - z
        weight = _STEP * math.pi * math.cosh(t) * math.exp(log_z + log_rest)
        nodes.append((log_z, weight))
    return nodes
