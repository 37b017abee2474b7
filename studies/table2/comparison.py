"""Fits of all models of the catalogue to the same data, side by side."""

import functools
import math
from dataclasses import dataclass
from typing import NamedTuple

from stackbounce import Drop
from stackbounce.fitting import Comparison, Fit, Residual
from studies.table2 import inputs
from studies.table2.catalogue import THEORIES

_MISS = 2.0  # errors


@dataclass(frozen=True, eq=False)
class FittedModels:
    """The fits of all models.

    Parameters
    ----------
    comparison : Comparison
        The fits, as `stackbounce.fitting.compare` returns them.
    """

    comparison: Comparison

    @functools.cached_property
    def order(self) -> list[str]:
        """The names of the models, that with the smallest BIC first."""
        fits = self.comparison.fits
        return sorted(fits, key=lambda name: score(fits[name]).bic)

    @property
    def data(self) -> int:
        """The number of measurements, without what is known of the fitted numbers."""
        objective = next(iter(self.comparison.fits.values())).objective
        return objective.size - len(objective.priors)

    def __getitem__(self, name: str) -> Fit:
        """The fit of one model."""
        return self.comparison[name]

    def ratios(self, name: str) -> list[Residual]:
        """Return the residuals of the values of Table II, without those of the delays."""
        return [residual for residual in self[name].residuals if residual.name in inputs.RATIOS]

    def of_ratios(self, name: str) -> float:
        """Return chi squared of the values of Table II alone."""
        return sum(ratio.pull**2 for ratio in self.ratios(name))

    def worst(self, name: str) -> list[Residual]:
        """Return the values of Table II that a model misses by more than two errors."""
        missed = [ratio for ratio in self.ratios(name) if abs(ratio.pull) > _MISS]
        return sorted(missed, key=lambda residual: -abs(residual.pull))

    def within(self, name: str) -> int:
        """Return how many of these values lie within the printed error of 0.02."""
        return sum(abs(ratio.pull) <= 1.0 for ratio in self.ratios(name))

    def pairs(self, name: str) -> dict[str, dict[str, float]]:
        """Return each pair's ratios, their pulls, gap in m and delay in s, by a fitted model."""
        found = {}
        for pair in inputs.PAIRS:
            lower, upper, delay = (
                residual for residual in self[name].residuals if residual.drop == pair
            )
            found[pair] = {
                "e1": lower.fitted,
                "e2": upper.fitted,
                "pull1": lower.pull,
                "pull2": upper.pull,
                "gap": self[name].best[f"{pair}.gaps.0"],
                "delay": delay.fitted,
                "delay_pull": delay.pull,
            }
        return found

    def shared(self, name: str) -> dict[str, float]:
        """Return the fitted numbers that all pairs share, by name."""
        return {key: value for key, value in self[name].best.items() if not key.endswith("gaps.0")}

    def drop(self, name: str, pair: str) -> Drop:
        """Return a pair with the fitted contacts and gap of a model."""
        return self[name].drops[pair]

    @functools.cached_property
    def titles(self) -> dict[str, str]:
        """The title of each model."""
        rigid_ones = {
            "rigid, one": "separate collisions, one restitution",
            "rigid, two": "separate collisions, of the floor and of balls",
        }
        return {**rigid_ones, **{name: theory.title for name, theory in THEORIES.items()}}


class Score(NamedTuple):
    """Goodness of a fit; `probability` is that of so large a chi squared if the model is right.

    A number that is known with an error counts as a datum and a parameter in the degrees of
    freedom, and as neither in BIC.
    """

    chi_squared: float
    degrees_of_freedom: int
    probability: float
    bic: float


def score(found: Fit) -> Score:
    """Return the goodness of a fit."""
    known = len(found.objective.priors)
    free, data = found.free - known, found.objective.size - known
    bic = found.chi_squared + free * math.log(data)
    return Score(found.chi_squared, found.degrees_of_freedom, found.probability, bic)
