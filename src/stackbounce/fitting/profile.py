"""The profile of chi squared over one parameter, with all others refitted, and its intervals."""

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from stackbounce.errors import between
from stackbounce.fitting.least_squares import Minimum, descend, spread_trials
from stackbounce.fitting.parameters import Parameter
from stackbounce.run.quantities import Array

if TYPE_CHECKING:
    from stackbounce.fitting.result import Fit

_FIRST = 0.2  # of the expected distance of the limit: the first step
_GROWTH = 1.6  # of each step over the one before
_MOST = 60  # steps outwards
_EXACT = 1e-4  # of the last step: how exactly a limit is found
_SCREENED = 16  # trials at each value of a profile


class Interval(NamedTuple):
    """The confidence interval of a parameter.

    Parameters
    ----------
    low, high : float
        The limits in SI units.
    low_is_bound, high_is_bound : bool
        Whether the limit is a bound of the search because the data set none.
    """

    low: float
    high: float
    low_is_bound: bool
    high_is_bound: bool


@dataclass(frozen=True, eq=False)
class Profile:
    """Chi squared as a function of one parameter, with all others refitted.

    Parameters
    ----------
    fit : Fit
        With the best minimum.
    k : int
        The index of the parameter.
    """

    fit: "Fit"
    k: int

    @property
    def parameter(self) -> Parameter:
        """The parameter that is moved."""
        return self.fit.objective.parameters[self.k]

    def at(self, x: float, start: Array) -> Minimum:
        """Return the minimum at one coordinate of the parameter.

        The others start from a trial (parameters,), moved as if chi squared were quadratic.
        """
        objective = self.fit.objective
        along = self.fit.covariance.values[self.k] / objective.value_slopes(self.fit.x)
        along = along / along[self.k]
        spans = objective.spans
        trial = np.clip(start + (x - start[self.k]) * along, spans[:, 0], spans[:, 1])
        trial[self.k] = x
        return descend(objective, trial, fixed=self.k)

    def evaluate(self, values: Array) -> Array:
        """Return chi squared (n,) at values of the parameter (n,); see `Fit.profile`.

        Each descent starts at the end of the one before, or at the best of some trials spread over
        the bounds of the others, as a profile may pass from one valley into another.
        """
        objective, k, best = self.fit.objective, self.k, self.fit.x
        found = np.empty(len(values))
        spread = spread_trials(objective, _SCREENED, 0)[: 0 if objective.records else _SCREENED]
        for side in (-1.0, 1.0):
            start = best
            for j in np.argsort(side * values, kind="stable"):
                one = self.parameter
                x = one.coordinate(between(one.name, values[j], one.low, one.high))
                if (x - best[k]) * side < 0.0:
                    continue
                trials = np.concatenate([start[None], spread])
                trials[:, k] = x
                end = self.at(x, trials[np.argmin(objective.chi_squared(trials))])
                found[j], start = end.chi_squared, end.x
        return found

    def interval(self, sigma: float) -> Interval:
        """Return where chi squared has risen by `sigma` squared; see `Fit.intervals`."""
        (low, low_is_bound), (high, high_is_bound) = (self._limit(sigma, side) for side in (-1, 1))
        values = self.parameter.value(np.array([low, high]))
        return Interval(float(values[0]), float(values[1]), low_is_bound, high_is_bound)

    def _limit(self, sigma: float, side: int) -> tuple[float, bool]:
        """Return the coordinate of one limit, and whether it is a bound.

        The square root of the rise of chi squared is nearly linear. Each descent starts at the end
        of the last one below the limit.
        """
        from scipy.optimize import brentq

        (low, high), least = self.parameter.span, self.fit.chi_squared
        start, inner = self.fit.x, float(self.fit.x[self.k])

        @functools.cache
        def beyond(x: float) -> float:
            nonlocal start
            end = self.at(x, start)
            above = math.sqrt(max(end.chi_squared - least, 0.0)) - sigma
            if above < 0.0:
                start = end.x
            return above

        deviation = self.fit[self.parameter.name].std_dev / self.parameter.slope(inner)
        step = min(max(_FIRST * sigma * deviation, 1e-6 * (high - low)), 0.1 * (high - low))
        for _ in range(_MOST):
            outer = min(max(inner + side * step, low), high)
            if beyond(outer) >= 0.0:
                return float(brentq(beyond, inner, outer, xtol=_EXACT * abs(outer - inner))), False
            if outer in (low, high):
                break
            inner, step = outer, _GROWTH * step
        return (low if side < 0 else high), True
