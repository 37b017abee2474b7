"""Profiles of chi squared, and confidence intervals: one parameter moves, all others follow."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import between, positive
from stackbounce.fit.search import descend, starts

if TYPE_CHECKING:
    from stackbounce.fit.found import Fit

__all__ = ["Interval", "along", "intervals"]

Array: TypeAlias = NDArray[np.float64]

_FIRST = 0.2  # of the expected distance: the first step
_GROWTH = 1.6
_MOST = 40  # steps outwards, and halvings
_EXACT = 1e-3  # of chi squared's rise
_SCREENED = 16  # trials at each value of a profile, where they are solved together


class Interval(NamedTuple):
    """Where a parameter may lie.

    Parameters
    ----------
    low, high : float
        The limits in SI units.
    low_is_bound, high_is_bound : bool
        Whether one is a bound of the search, and the data set no limit.
    """

    low: float
    high: float
    low_is_bound: bool
    high_is_bound: bool


def intervals(fit: "Fit", sigma: float) -> dict[str, Interval]:
    """Return the profile's interval of each parameter; see `Fit.intervals`."""
    rise = positive("sigma", sigma) ** 2
    return {name: _interval(fit, k, rise) for k, name in enumerate(fit.names)}


def profile(fit: "Fit", k: int) -> Callable[[float, Array], tuple[float, Array]]:
    """Return chi squared as a function of one coordinate, all others fitted from a trial."""

    def at(x: float, start: Array) -> tuple[float, Array]:
        trial = start.copy()
        trial[k] = x
        end = descend(fit.problem, trial, fixed=k)
        return end.chi_squared, end.x

    return at


def along(fit: "Fit", k: int, values: Array) -> Array:
    """Return chi squared (n,) at values of one parameter; see `Fit.profile`.

    Each descent begins at the end of the one before, or at the best of some trials spread over the
    bounds of the others: a profile may pass from one valley into another.
    """
    one, at, found = fit.problem.parameters[k], profile(fit, k), np.empty(len(values))
    spread = starts(fit.problem, _SCREENED, 0)[: 0 if fit.problem.records else _SCREENED]
    for side in (-1.0, 1.0):
        start = fit.x
        for j in np.argsort(side * values, kind="stable"):
            x = one.coordinate(between(one.name, values[j], one.low, one.high))
            if (x - fit.x[k]) * side < 0.0:
                continue
            trials = np.concatenate([start[None], spread])
            trials[:, k] = x
            best = trials[np.argmin(fit.problem.chi_squared(trials))]
            found[j], start = at(x, best)
    return found


def _interval(fit: "Fit", k: int, rise: float) -> Interval:
    parameter, best = fit.problem.parameters[k], fit.x
    slope = abs(parameter.slope(float(best[k])))
    expected = float(np.sqrt(fit.covariance.values[k, k] * rise)) / slope
    ends = [_limit(fit, k, rise, expected, side) for side in (-1, 1)]
    (low, low_bound), (high, high_bound) = ends
    values = parameter.value(np.array([low, high]))
    return Interval(float(values[0]), float(values[1]), low_bound, high_bound)


def _limit(fit: "Fit", k: int, rise: float, expected: float, side: int) -> tuple[float, bool]:
    """Return the coordinate of one limit, and whether it is a bound."""
    at, best = profile(fit, k), fit.x
    low, high = fit.problem.parameters[k].span
    bound = low if side < 0 else high
    wanted = fit.chi_squared + rise
    step = min(max(_FIRST * expected, 1e-6 * (high - low)), 0.1 * (high - low))
    inner, start = float(best[k]), best
    for _ in range(_MOST):
        outer = inner + side * step
        beyond = (outer - bound) * side >= 0.0
        outer = bound if beyond else outer
        chi, end = at(outer, start)
        if chi >= wanted:
            return _between(at, inner, outer, start, wanted, rise), False
        if beyond:
            return bound, True
        inner, start, step = outer, end, _GROWTH * step
    return bound, True


def _between(
    at: Callable[[float, Array], tuple[float, Array]],
    inner: float,
    outer: float,
    start: Array,
    wanted: float,
    rise: float,
) -> float:
    """Return where chi squared crosses a value between two coordinates."""
    for _ in range(_MOST):
        middle = 0.5 * (inner + outer)
        chi, end = at(middle, start)
        if abs(chi - wanted) < _EXACT * rise:
            return middle
        if chi < wanted:
            inner, start = middle, end
        else:
            outer = middle
    return 0.5 * (inner + outer)
