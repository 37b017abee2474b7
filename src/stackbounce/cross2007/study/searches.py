"""The study's searches: those of `stackbounce.fit`, with fewer local minimisations.

Each trial of the shared numbers has its gaps chosen pair by pair, so that few minimisations
suffice. For a few models eight instead of three gave the same chi squared.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from stackbounce.fitting import Fit, Model
from stackbounce.fitting.problem import Problem
from stackbounce.fitting.question import read_problem
from stackbounce.fitting.search import Minimum, descend, search

__all__ = ["fit_model", "refit"]

_RTOL = 1e-6
_SCREENED, _FOLLOWED = 32, 3


def fit_model(model: Model, data: Mapping[str, Any]) -> Fit:
    """Fit a model to pairs of balls."""
    return _apart(model, data, _best)


def refit(model: Model, data: Mapping[str, Any], near: Fit) -> Fit:
    """Fit a model by one local minimisation that starts from the fit of a similar model."""
    own = dict(zip(near.names, near.x, strict=True))

    def nearest(problem: Problem) -> Minimum:
        return descend(problem, np.array([own[one.name] for one in problem.parameters]))

    return _apart(model, data, nearest)


def _best(problem: Problem) -> Minimum:
    nothing = np.empty((0, len(problem.parameters)))
    return search(problem, nothing, _SCREENED, 0, _FOLLOWED)[0]


def _apart(model: Model, data: Mapping[str, Any], solve: Callable[[Problem], Minimum]) -> Fit:
    """Return a fit; pairs that share no varied number are fitted one by one."""
    problem = read_problem(model.drop, data, model.vary, model.tie, _RTOL)
    own = {key: [one for one in model.vary if one.startswith(f"{key}.")] for key in data}
    if sum(map(len, own.values())) < len(model.vary):
        return Fit(problem, [solve(problem)])
    found: dict[str, float] = {}
    drops: Any = model.drop
    for key, names in own.items():
        vary = {name: model.vary[name] for name in names}
        alone = read_problem({key: drops[key]}, {key: data[key]}, vary, None, _RTOL)
        found |= dict(zip(names, solve(alone).x, strict=True))
    x = np.array([found[one.name] for one in problem.parameters])
    return Fit(problem, [Minimum(x, float(problem.chi_squared(x[None])[0]), True)])
