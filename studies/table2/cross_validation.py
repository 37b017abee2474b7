"""Each pair predicted from the others: the predictive density of its two ratios.

The shared numbers are fitted to the other pairs. The pair that is left out keeps its recorded
delay, which determines the gap. The density of both ratios is averaged over the delay's error.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from stackbounce.fitting import Fit
from studies.table2 import inputs
from studies.table2.choice_fits import MODELS, ChoiceFits
from studies.table2.choices import BASE, LATE, Choice
from studies.table2.inputs import Array
from studies.table2.readings import Combination
from studies.table2.searches import refit

_STEPS = 601  # of the gap
_SPAN = 4.0  # errors of the delay
_DRAWS = 2000  # of both ratios, for the mean score of a right model


class HeldOut(NamedTuple):
    """A pair that was left out: twice the negative logarithm of the density of its ratios.

    The score is 0 if both ratios are predicted exactly whatever the delay. `expected` is its mean
    if the model is right: 2 at a known delay, more if the ratios depend on it. `predicted` are the
    ratios at the recorded delay itself. `chosen` says which law and reading had the smallest chi
    squared for the other pairs, if they were chosen so.
    """

    pair: str
    score: float
    expected: float
    predicted: tuple[float, float]
    chosen: str = ""


def cross_validate(
    fits: ChoiceFits, progress: Callable[[str], None]
) -> dict[str, dict[str, list[HeldOut]]]:
    """Return the pairs that were left out, by the name of the choice and by model."""
    found: dict[str, dict[str, list[HeldOut]]] = {}
    for choice in (BASE, LATE):
        found[choice.name] = {}
        for name in MODELS:
            progress(f"study: each pair from the others, model '{name}', {choice.name}")
            whole = fits[choice][name]
            rows = [
                predict_held_out(whole, _left_out(choice, name, pair, whole), pair)
                for pair in choice.data()
            ]
            found[choice.name][name] = rows
    return found


def _left_out(choice: Choice, name: str, pair: str, whole: Fit) -> Mapping[str, float]:
    """Return the search coordinates of the numbers that a model shares, from the other pairs."""
    model = choice.model(name)
    if not any(name for name in model.vary if not name.endswith("gaps.0")):
        return {}
    data: dict[str, Any] = choice.data()
    data[pair] = {inputs.DELAY: data[pair][inputs.DELAY]}
    rest = refit(model, data, whole)
    return dict(zip(rest.names, rest.x, strict=True))


def predict_held_out(whole: Fit, shared: Mapping[str, float], pair: str) -> HeldOut:
    """Return the score of a pair with other shared numbers than those of a fit to all pairs."""
    objective = whole.objective
    x = np.array([shared.get(n, own) for n, own in zip(whole.names, whole.x, strict=True)])
    k = objective.names.index(f"{pair}.gaps.0")
    trials = np.tile(x, (_STEPS, 1))
    low, high = objective.spans[k].tolist()
    trials[:, k] = np.linspace(low, high, _STEPS)
    lower, upper, delay = objective.measured[pair].data
    first, second, touch = objective.predict(pair, trials).T
    order = np.argsort(touch)
    times = delay.value + delay.error * np.linspace(-_SPAN, _SPAN, _STEPS)
    curves = np.stack(
        [
            np.interp(times, touch[order], ratio[order]) / datum.error
            for ratio, datum in ((first, lower), (second, upper))
        ]
    )
    measured = np.array([[lower.value / lower.error], [upper.value / upper.error]])
    middle = curves[:, _STEPS // 2] * (lower.error, upper.error)
    return HeldOut(
        pair,
        float(_scores(curves, measured)[0]),
        float(np.mean(_scores(curves, _draw(curves)))),
        (float(middle[0]), float(middle[1])),
    )


def _scores(curves: Array, measured: Array) -> Array:
    """Return scores (n,) of both ratios (2, n), by their curves (2, steps) against the delay.

    All are in errors.
    """
    from scipy.special import logsumexp

    squares = np.sum(np.square(curves[:, None, :] - measured[:, :, None]), axis=0)
    return np.asarray(-2.0 * logsumexp(-0.5 * squares, axis=1, b=_weights()))


def _draw(curves: Array) -> Array:
    """Return both ratios (2, n) as a right model would have them, in errors."""
    random = np.random.default_rng(0)
    at = random.choice(_STEPS, _DRAWS, p=_weights())
    return np.asarray(curves[:, at] + random.standard_normal((2, _DRAWS)))


def _weights() -> Array:
    """Return the weights of the delays (steps,), by the normal distribution."""
    weights = np.exp(-0.5 * np.linspace(-_SPAN, _SPAN, _STEPS) ** 2)
    return np.asarray(weights / weights.sum())


def cross_validate_selection(tried: list[Combination]) -> list[HeldOut]:
    """Return the pairs that were left out, with law and reading chosen by the other pairs alone.

    Nothing but gaps is fitted, so that each combination has a chi squared for each pair.
    """
    rows = []
    for pair in inputs.PAIRS:
        best = min(tried, key=lambda case: case.fit.chi_squared - case.of_pair(pair))
        held = predict_held_out(best.fit, {}, pair)
        rows.append(held._replace(chosen=f"{best.law}, {best.reading}"))
    return rows
