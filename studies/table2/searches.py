"""The study's searches: those of `stackbounce.fit`, with fewer local minimisations.

Each trial of the shared numbers has its gaps chosen pair by pair, so that few minimisations
suffice. For a few models eight instead of three gave the same chi squared.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from stackbounce.fitting import Fit, FitProblem
from stackbounce.fitting.least_squares import Minimum, descend, find_minima
from studies.table2.inputs import Array
from studies.table2.observed import Observed, observe

_SCREENED, _FOLLOWED = 32, 3
_GAPS = 48  # trials of a gap at known shared numbers
_ROUNDS, _GAIN = 3, 1e-2  # of descents from better gaps; the gain in chi squared that is worth one


def fit_model(model: FitProblem, data: Mapping[str, Any]) -> Fit:
    """Fit a model to pairs of balls."""
    return _apart(model, data, _best)


def refit(model: FitProblem, data: Mapping[str, Any], near: Fit) -> Fit:
    """Fit a model by one local minimisation that starts from the fit of a similar model."""
    own = dict(zip(near.names, near.x, strict=True))

    def nearest(objective: Observed) -> Minimum:
        return descend(objective, np.array([own[name] for name in objective.names]))

    return _apart(model, data, nearest)


def fit_near(model: FitProblem, data: Mapping[str, Any], near: Iterable[Fit]) -> Fit:
    """Fit a model by one local minimisation from each of the fits of similar models; the best.

    Numbers that are new start from what is known of them, and each gap from the best of many.
    """
    starts = [dict(zip(fit.names, fit.x, strict=True)) for fit in near]

    def best(objective: Observed) -> Minimum:
        ends = [_descend(objective, _start(objective, known)) for known in starts]
        return min(ends, key=lambda end: end.chi_squared)

    return _apart(model, data, best)


def _descend(objective: Observed, x: Array) -> Minimum:
    """Return the end of descents that go on as long as other gaps are better."""
    end = descend(objective, x)
    for _ in range(_ROUNDS):
        x = _start(objective, dict(zip(objective.names, end.x, strict=True)))
        if objective.chi_squared(x[None])[0] > end.chi_squared - _GAIN:
            break
        end = descend(objective, x)
    return end


def _start(objective: Observed, known: Mapping[str, float]) -> Array:
    """Return a trial with the shared numbers of a similar fit, and the best gaps for them."""
    x = np.array(
        [
            known.get(parameter.name, parameter.prior[0] if parameter.prior else np.nan)
            for parameter in objective.parameters
        ]
    )
    for key in objective.measured:
        for k in objective.own(key):
            low, high = objective.spans[k].tolist()
            gaps = np.append(np.linspace(low, high, _GAPS), x[k])
            trials = np.tile(x, (len(gaps), 1))
            trials[:, k] = gaps
            x[k] = gaps[np.argmin(objective.alone(key).chi_squared(trials))]
    return x


def _best(objective: Observed) -> Minimum:
    nothing = np.empty((0, len(objective.parameters)))
    return find_minima(objective, nothing, _SCREENED, 0, _FOLLOWED)[0]


def _apart(model: FitProblem, data: Mapping[str, Any], solve: Callable[[Observed], Minimum]) -> Fit:
    """Return a fit; pairs that share no parameter are fitted one by one."""
    objective = observe(replace(model, data=data))
    own = {key: [name for name in model.vary if name.startswith(f"{key}.")] for key in data}
    if sum(map(len, own.values())) < len(model.vary):
        return Fit(objective, [solve(objective)])
    found: dict[str, float] = {}
    for key, names in own.items():
        vary = {name: model.vary[name] for name in names}
        alone = FitProblem({key: model.drops[key]}, {key: data[key]}, vary)
        found |= dict(zip(names, solve(observe(alone)).x, strict=True))
    x = np.array([found[name] for name in objective.names])
    return Fit(objective, [Minimum(x, float(objective.chi_squared(x[None])[0]), True)])
