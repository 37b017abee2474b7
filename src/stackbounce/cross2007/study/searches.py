"""The study's searches: those of `stackbounce.fit`, with fewer local minimisations.

Each trial of the shared numbers has its gaps chosen pair by pair, so that few minimisations
suffice. For a few models eight instead of three gave the same chi squared.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from stackbounce.fitting import Fit, FitProblem
from stackbounce.fitting.least_squares import Minimum, descend, find_minima
from stackbounce.fitting.objective import Objective

__all__ = ["fit_model", "refit"]

_RTOL = 1e-6
_SCREENED, _FOLLOWED = 32, 3


def fit_model(model: FitProblem, data: Mapping[str, Any]) -> Fit:
    """Fit a model to pairs of balls."""
    return _apart(model, data, _best)


def refit(model: FitProblem, data: Mapping[str, Any], near: Fit) -> Fit:
    """Fit a model by one local minimisation that starts from the fit of a similar model."""
    own = dict(zip(near.names, near.x, strict=True))

    def nearest(objective: Objective) -> Minimum:
        return descend(objective, np.array([own[name] for name in objective.names]))

    return _apart(model, data, nearest)


def _best(objective: Objective) -> Minimum:
    nothing = np.empty((0, len(objective.parameters)))
    return find_minima(objective, nothing, _SCREENED, 0, _FOLLOWED)[0]


def _apart(
    model: FitProblem, data: Mapping[str, Any], solve: Callable[[Objective], Minimum]
) -> Fit:
    """Return a fit; pairs that share no parameter are fitted one by one."""
    objective = replace(model, data=data, rtol=_RTOL).objective
    own = {key: [one for one in model.vary if one.startswith(f"{key}.")] for key in data}
    if sum(map(len, own.values())) < len(model.vary):
        return Fit(objective, [solve(objective)])
    found: dict[str, float] = {}
    for key, names in own.items():
        vary = {name: model.vary[name] for name in names}
        alone = FitProblem({key: model.drops[key]}, {key: data[key]}, vary, rtol=_RTOL)
        found |= dict(zip(names, solve(alone.objective).x, strict=True))
    x = np.array([found[name] for name in objective.names])
    return Fit(objective, [Minimum(x, float(objective.chi_squared(x[None])[0]), True)])
