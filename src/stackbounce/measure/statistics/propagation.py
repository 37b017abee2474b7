"""The error of a function of measured numbers, to first order."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

_STEP = 1e-4  # relative, of the central differences; runs repeat to about 1e-10
_ANY = (-np.inf, np.inf)


def propagate(
    function: Callable[..., Any],
    given: Mapping[str, Any],
    bounds: Mapping[str, tuple[float, float]] | None = None,
) -> list[Any]:
    """Return the values of a function with their errors, by central differences.

    Parameters
    ----------
    function : callable
        Takes the nominal values by name, and returns a sequence of floats.
    given : mapping of str to float or UFloat
        Numbers, those with an error as UFloat.
    bounds : mapping of str to (float, float), optional
        The range of a number, in which the difference is one-sided at its ends.

    Returns
    -------
    list of UFloat
        Correlated with the numbers that were given.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> print(*propagate(lambda x, y: [x * y, x], {"x": ufloat(2.0, 0.1), "y": 3.0}))
    6.00+/-0.30 2.00+/-0.10
    """
    from uncertainties import nominal_value

    from stackbounce.measure.quantities import known_to

    at = {name: nominal_value(value) for name, value in given.items()}
    result: Any = [known_to(value, 0.0) for value in function(**at)]
    for name, one in given.items():
        if getattr(one, "std_dev", 0.0) > 0.0:
            x = at[name]
            step = min(max(_STEP * abs(x), 1e-3 * one.std_dev), 0.1 * abs(x))
            low, high = np.clip((x - step, x + step), *(bounds or {}).get(name, _ANY)).tolist()
            if high <= low:  # a number that is 0
                high = low + _STEP
            ends = (function(**(at | {name: value})) for value in (low, high))
            for k, (below, above) in enumerate(zip(*ends, strict=True)):
                result[k] = result[k] + (above - below) / (high - low) * (one - x)
    return list(result)
