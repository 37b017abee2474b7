"""Profiles of chi squared, and confidence intervals: one parameter moves, all others follow."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import between, positive
from stackbounce.fitting.search import descend, starts

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

__all__ = ["Interval", "along", "intervals"]

Array: TypeAlias = NDArray[np.float64]

_FIRST = 0.2  # of the expected distance: the first step
_GROWTH = 1.6
_MOST = 60  # steps outwards, and inwards
_EXACT = 1e-3  # of chi squared's rise
_NOTHING = 1e-12  # of a coordinate: chi squared jumps there
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
    """Return chi squared as a function of one coordinate, all others fitted from a trial.

    The others begin where they would go were chi squared a parabola.
    """
    spans = fit.problem.spans
    slope = [one.slope(x) for one, x in zip(fit.problem.parameters, fit.x, strict=True)]
    along = fit.covariance.values[k] / slope
    along = along / along[k]

    def at(x: float, start: Array) -> tuple[float, Array]:
        trial = np.clip(start + (x - start[k]) * along, spans[:, 0], spans[:, 1])
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
    step = min(max(_FIRST * expected, 1e-6 * (high - low)), 0.1 * (high - low))
    inner, start = (float(best[k]), 0.0), best
    for _ in range(_MOST):
        x = inner[0] + side * step
        beyond = (x - bound) * side >= 0.0
        chi, end = at(bound if beyond else x, start)
        outer = (bound if beyond else x, chi - fit.chi_squared)
        if outer[1] >= rise:
            return _between(at, fit.chi_squared, rise, inner, outer, start), False
        if beyond:
            break
        inner, start, step = outer, end, _GROWTH * step
    return bound, True


def _between(
    at: Callable[[float, Array], tuple[float, Array]],
    least: float,
    rise: float,
    inner: tuple[float, float],
    outer: tuple[float, float],
    start: Array,
) -> float:
    """Return where chi squared has risen so far, between two coordinates with their rises.

    The root of the rise is nearly straight; where it is not, steps of a half help.
    """
    x = outer[0]
    for count in range(_MOST):
        roots = [math.sqrt(max(one[1], 0.0)) for one in (inner, outer)]
        share = (math.sqrt(rise) - roots[0]) / (roots[1] - roots[0])
        x = inner[0] + (0.5 if count % 3 == 2 else share) * (outer[0] - inner[0])
        chi, end = at(x, start)
        if abs(chi - least - rise) < _EXACT * rise or abs(outer[0] - inner[0]) < _NOTHING * abs(x):
            break
        if chi - least < rise:
            inner, start = (x, chi - least), end
        else:
            outer = (x, chi - least)
    return x
