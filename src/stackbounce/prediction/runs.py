"""Runs of a drop one by one, for what a batch does not give: forces, apexes, curves in time."""

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from stackbounce.prediction.draws import ROUND_OFF
from stackbounce.prediction.inputs import Inputs, of_draws
from stackbounce.run.driver import solve_one
from stackbounce.run.options import Options
from stackbounce.run.quantities import Array
from stackbounce.run.result import Result

_ONE_SIGMA = (0.159, 0.841)


@dataclass(frozen=True, eq=False)
class Runs:
    """Runs of a drop whose numbers have errors, each a `Result`.

    Parameters
    ----------
    inputs : Inputs
        The numbers with errors.
    options : Options
        Of each run.
    drawn : ndarray or None
        (n, numbers) draws; None for derivatives.
    """

    inputs: Inputs
    options: Options
    drawn: Array | None

    @functools.cached_property
    def best(self) -> Result:
        """The run with the values of the numbers."""
        return self._simulate(self.inputs.values)

    @functools.cached_property
    def results(self) -> list[Result]:
        """The runs of draws; or the best one, those with each number larger, those with smaller."""
        rows = self.inputs.neighbours if self.drawn is None else self.drawn
        return [self._simulate(x) for x in rows]

    def carry(self, function: Callable[[Result], Mapping[Any, float]]) -> dict[Any, Any]:
        """Return numbers of the results with errors, and the share of the results with each."""
        answers = [function(result) for result in self.results]
        found = {}
        for name in dict.fromkeys(name for answer in answers for name in answer):
            column = np.array([float(answer.get(name, np.nan)) for answer in answers])
            column[~np.isfinite(column)] = np.nan
            share = float(np.mean(np.isfinite(column)))
            if self.drawn is None and share == 1.0:
                if np.ptp(column) <= ROUND_OFF * np.max(np.abs(column)):
                    column[:] = column[0]
                found[name] = (
                    self.inputs.linear(float(column[0]), self.inputs.slopes(column)),
                    share,
                )
            else:
                found[name] = of_draws(column), share
        return found

    def band(self, times: Any, name: str) -> tuple[Array, Array]:
        """Return the ends of one standard deviation of a curve; see `Prediction.band`."""
        within = np.minimum(times, self.options.until)
        curves = np.array([result.sample(within)[name].values for result in self.results])
        if self.drawn is not None:
            low, high = np.nanquantile(curves, _ONE_SIGMA, axis=0)
            return low, high
        each = np.tensordot(self.inputs.spread.T, self.inputs.slopes(curves), axes=1)
        deviation = np.sqrt(np.sum(each**2, axis=0))
        return curves[0] - deviation, curves[0] + deviation

    def _simulate(self, x: Array) -> Result:
        return solve_one(self.inputs.drop_at(x), self.options)
