"""The comparison: every model of the catalogue fitted to the same ten values and five delays."""

import functools
from collections.abc import Callable
from dataclasses import dataclass

from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.catalogue import NAMES, THEORIES
from stackbounce.cross2007.study.searches import fit_model
from stackbounce.cross2007.study.theories import make_rigid_model
from stackbounce.fitting import Fit, Residual
from stackbounce.fitting.comparison import Comparison
from stackbounce.model import Drop

__all__ = ["FittedModels", "fit_models"]

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

    def __getitem__(self, name: str) -> Fit:
        """The fit of one model."""
        return self.comparison[name]

    def ratios(self, name: str) -> list[Residual]:
        """Return the residuals of the ten values of Table II, without those of the delays."""
        return [one for one in self[name].residuals if one.name in inputs.RATIOS]

    def of_ratios(self, name: str) -> float:
        """Return chi squared of the ten values of Table II alone."""
        return sum(one.pull**2 for one in self.ratios(name))

    def worst(self, name: str) -> list[Residual]:
        """Return the values of Table II that a model misses by more than two errors."""
        missed = [one for one in self.ratios(name) if abs(one.pull) > _MISS]
        return sorted(missed, key=lambda one: -abs(one.pull))

    def within(self, name: str) -> int:
        """Return how many of the ten values lie within the printed error of 0.02."""
        return sum(abs(one.pull) <= 1.0 for one in self.ratios(name))

    def pairs(self, name: str) -> dict[str, dict[str, float]]:
        """Return each pair's ratios, their pulls, gap in m and delay in s, by a fitted model."""
        found = {}
        for pair in inputs.PAIRS:
            lower, upper, delay = (one for one in self[name].residuals if one.drop == pair)
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
        return {**rigid_ones, **{name: one.title for name, one in THEORIES.items()}}


def fit_models(progress: Callable[[str], None] = lambda _: None) -> FittedModels:
    """Fit each model of the catalogue to all five pairs of superballs together."""
    models = {name: make_rigid_model(*numbers) for name, numbers in NAMES.items()}
    models |= {name: theory.model() for name, theory in THEORIES.items()}
    fits: dict[str, Fit] = {}
    for name, model in models.items():
        progress(f"study: model '{name}'")
        fits[name] = fit_model(model, inputs.MEASURED)
    return FittedModels(Comparison(fits, {}))
