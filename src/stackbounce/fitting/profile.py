"""The profile of chi squared over one parameter, with all others refitted, and its intervals."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from stackbounce.errors import between
from stackbounce.fitting.least_squares import Minimum, descend, spread_trials
from stackbounce.fitting.objective import Objective
from stackbounce.fitting.parameters import Parameter
from stackbounce.fitting.quantities import Array

_FIRST = 0.2  # of the expected distance of the limit: the first step
_GROWTH = 1.6  # of each step over the one before
_MOST = 60  # steps outwards, and inwards
_EXACT = 1e-3  # of the rise of chi squared: how exactly a limit is found
_NOTHING = 1e-12  # of a coordinate: chi squared jumps there
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
    objective : Objective
        What is fitted.
    best : Minimum
        The best minimum.
    covariance : ndarray
        (parameters, parameters) of the values there.
    k : int
        The index of the parameter.
    """

    objective: Objective
    best: Minimum
    covariance: Array
    k: int

    @property
    def parameter(self) -> Parameter:
        """The parameter that is moved."""
        return self.objective.parameters[self.k]

    def at(self, x: float, start: Array) -> Minimum:
        """Return the minimum at one coordinate of the parameter.

        The others start from a trial (parameters,), moved as if chi squared were quadratic.
        """
        slopes = self.objective.value_slopes(self.best.x)
        along = self.covariance[self.k] / slopes
        along = along / along[self.k]
        spans = self.objective.spans
        trial = np.clip(start + (x - start[self.k]) * along, spans[:, 0], spans[:, 1])
        trial[self.k] = x
        return descend(self.objective, trial, fixed=self.k)

    def evaluate(self, values: Array) -> Array:
        """Return chi squared (n,) at values of the parameter (n,); see `Fit.profile`.

        Each descent starts at the end of the one before, or at the best of some trials spread over
        the bounds of the others, as a profile may pass from one valley into another.
        """
        objective, k, best = self.objective, self.k, self.best.x
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
        rise = sigma**2
        slope = abs(self.parameter.slope(float(self.best.x[self.k])))
        expected = float(np.sqrt(self.covariance[self.k, self.k] * rise)) / slope
        ends = [self._limit(rise, expected, side) for side in (-1, 1)]
        (low, low_bound), (high, high_bound) = ends
        values = self.parameter.value(np.array([low, high]))
        return Interval(float(values[0]), float(values[1]), low_bound, high_bound)

    def _limit(self, rise: float, expected: float, side: int) -> tuple[float, bool]:
        """Return the coordinate of one limit, and whether it is a bound."""
        low, high = self.parameter.span
        bound = low if side < 0 else high
        step = min(max(_FIRST * expected, 1e-6 * (high - low)), 0.1 * (high - low))
        inner, start = (float(self.best.x[self.k]), 0.0), self.best.x
        for _ in range(_MOST):
            x = inner[0] + side * step
            beyond = (x - bound) * side >= 0.0
            x = bound if beyond else x
            end = self.at(x, start)
            outer = (x, end.chi_squared - self.best.chi_squared)
            if outer[1] >= rise:
                return self._root(rise, inner, outer, start), False
            if beyond:
                break
            inner, start, step = outer, end.x, _GROWTH * step
        return bound, True

    def _root(
        self, rise: float, inner: tuple[float, float], outer: tuple[float, float], start: Array
    ) -> float:
        """Return where chi squared has risen so far, between two coordinates with their rises.

        The square root of the rise is nearly linear; every third step halves the distance.
        """
        x = outer[0]
        for count in range(_MOST):
            roots = [math.sqrt(max(end[1], 0.0)) for end in (inner, outer)]
            share = (math.sqrt(rise) - roots[0]) / (roots[1] - roots[0])
            x = inner[0] + (0.5 if count % 3 == 2 else share) * (outer[0] - inner[0])
            end = self.at(x, start)
            now = (x, end.chi_squared - self.best.chi_squared)
            if abs(now[1] - rise) < _EXACT * rise or abs(outer[0] - inner[0]) < _NOTHING * abs(x):
                break
            if now[1] < rise:
                inner, start = now, end.x
            else:
                outer = now
        return x
