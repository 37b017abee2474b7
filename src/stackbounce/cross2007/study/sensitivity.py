"""Sensitivity of the result to its assumptions: delays, masses, times, and each pair."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from stackbounce.cross2007.data import PAPER
from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.catalogue import AS_HEIGHTS, THEORIES
from stackbounce.cross2007.study.comparison import FittedModels
from stackbounce.cross2007.study.searches import fit_model, refit
from stackbounce.cross2007.study.theories import Theory
from stackbounce.fitting import Fit
from stackbounce.fitting.comparison import Comparison
from stackbounce.model import STANDARD_GRAVITY
from stackbounce.run.driver import simulate

__all__ = [
    "Held",
    "hold_out",
    "loosen_delays",
    "ratios_at",
    "scan_loss",
    "score_late_delay",
    "score_with_gravity",
    "vary_assumptions",
]

_BETWEEN = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0)
_LOOSE = 1e-3  # s
_STORY = 0.5  # s: all balls have passed their apexes by then
_LOOSENED = ("A", "S", "B", "S, six")


class Held(NamedTuple):
    """A pair that was left out: measured and predicted e1 and e2, and errors of the predictions."""

    pair: str
    measured: tuple[float, float]
    predicted: tuple[float, float]
    error: tuple[float, float]

    @property
    def pulls(self) -> tuple[float, float]:
        """Predicted minus measured ratios, over their combined errors."""
        first, second = (
            (got - was) / np.hypot(off, inputs.ERROR)
            for got, was, off in zip(self.predicted, self.measured, self.error, strict=True)
        )
        return float(first), float(second)


def scan_loss(compared: FittedModels, progress: Callable[[str], None]) -> dict[float, float]:
    """Return chi squared by the factor on the loss between two balls."""
    found = {}
    near = compared["S, fitted"]
    for factor in _BETWEEN:
        progress(f"study: {factor:g} times the loss between two balls")
        theory = replace(THEORIES["S, fitted"], known={"between": factor})
        near = refit(theory.model(), inputs.MEASURED, near)
        found[factor] = near.chi_squared
    return found


def vary_assumptions(compared: FittedModels) -> dict[str, dict[str, float]]:
    """Return chi squared of models A and S for each changed assumption."""
    return {
        what: {name: _changed(compared, name, change) for name in ("A", "S")}
        for what, change in _CHANGES.items()
    }


def _changed(compared: FittedModels, name: str, change: Callable[[Theory], Theory]) -> float:
    model = change(THEORIES[name]).model()
    return refit(model, inputs.MEASURED, compared[name]).chi_squared


def _other(ball: str, sign: float) -> Callable[[Theory], Theory]:
    """Return a function that shifts Table I's COR of B1, or of B2 and B3, by `sign` errors."""
    balls = ("B1",) if ball == "B1" else ("B2", "B3")
    step = sign * PAPER["B1.restitution"].spread

    def change(theory: Theory) -> Theory:
        known = dict(theory.known)
        for one in balls:
            shown = inputs.PRINTED[one] + step
            known[f"e_{one}"] = math.sqrt(shown) if theory.known == AS_HEIGHTS else shown
        return replace(theory, known=known)

    return change


def _times(ball: str, sign: float) -> Callable[[Theory], Theory]:
    return lambda theory: replace(
        theory, longer={ball: sign * PAPER[f"{ball}.contact_time"].spread}
    )


def _stiffer(factor: float) -> Callable[[Theory], Theory]:
    return lambda theory: replace(theory, known={**theory.known, "stiffer": factor})


_CHANGES: dict[str, Callable[[Theory], Theory]] = {
    "B1 of 101 g": lambda theory: replace(theory, heavy=PAPER["B1.mass"].value),
    "B1's COR + 0.02": _other("B1", 1.0),
    "B1's COR - 0.02": _other("B1", -1.0),
    "COR of B2 and B3 + 0.02": _other("B2", 1.0),
    "COR of B2 and B3 - 0.02": _other("B2", -1.0),
    "contact time of B1 + 0.1 ms": _times("B1", 1.0),
    "contact time of B1 - 0.1 ms": _times("B1", -1.0),
    "stiffness between two balls × 0.7": _stiffer(0.7),
    "stiffness between two balls × 1.5": _stiffer(1.5),
    "pairs dropped from 18 cm": lambda theory: replace(theory, height=0.18),
    "pairs dropped from 24 cm": lambda theory: replace(theory, height=0.24),
}


def loosen_delays(compared: FittedModels) -> FittedModels:
    """Fit models with errors of the delays of at least 1 ms."""
    data: dict[str, Any] = {}
    for key, own in inputs.MEASURED.items():
        value, error = own[inputs.DELAY]
        data[key] = {**own, inputs.DELAY: (value, max(error, _LOOSE))}
    fits = {name: refit(THEORIES[name].model(), data, compared[name]) for name in _LOOSENED}
    return FittedModels(Comparison(fits, {}))


def score_late_delay(compared: FittedModels) -> dict[str, float]:
    """Return chi squared with the longer delay of B1 on B3, 7 ms, and unchanged shared numbers."""
    return {name: _late(compared, name) for name in _LOOSENED}


def _late(compared: FittedModels, name: str) -> float:
    theory, own = THEORIES[name], "B1_on_B3"
    known = {**theory.known, **compared.shared(name)}
    alone = replace(theory, known=known, vary=(), exponent=known.pop("exponent", theory.exponent))
    there = fit_model(alone.model((own,)), {own: inputs.delay_late()[own]}).chi_squared
    here = sum(one.pull**2 for one in compared[name].residuals if one.drop == own)
    return compared[name].chi_squared - here + there


def score_with_gravity(compared: FittedModels, name: str) -> float:
    """Return chi squared of the ten values with gravity and unchanged gaps, from the apexes.

    Final speeds cannot be used: two balls B1 separate with nearly equal speeds and touch again in
    flight.
    """
    pulls = []
    for pair in inputs.PAIRS:
        drop = replace(compared.drop(name, pair), gravity=STANDARD_GRAVITY)
        apexes = simulate(drop, until=_STORY, rtol=1e-8).apexes
        for ball, measured in enumerate(inputs.read_ratios(pair)):
            height = float(apexes[apexes["ball"] == ball]["height"][0])
            pulls.append((math.sqrt(height / inputs.HEIGHT) - measured) / inputs.ERROR)
    return sum(pull**2 for pull in pulls)


def hold_out(compared: FittedModels, name: str) -> list[Held]:
    """Predict the ratios of each pair by a model that is fitted to the four other pairs.

    The pair keeps its delay, which determines its gap. The error of a ratio is its change with the
    delay's error. (`Comparison.left_out` also leaves out the delay, so that any gap is possible.)
    """
    rows = []
    for key in inputs.PAIRS:
        rest: dict[str, Mapping[str, Any]] = dict(inputs.MEASURED)
        delay = rest[key][inputs.DELAY]
        rest[key] = {inputs.DELAY: delay}
        found = refit(THEORIES[name].model(), rest, compared[name])
        middle = ratios_at(found, key, delay[0])
        ends = [ratios_at(found, key, delay[0] + sign * delay[1]) for sign in (-1.0, 1.0)]
        errors = np.max(np.abs(np.array(ends) - middle), axis=0)
        rows.append(Held(key, inputs.read_ratios(key), _pair(middle), _pair(errors)))
    return rows


def _pair(numbers: Any) -> tuple[float, float]:
    return float(numbers[0]), float(numbers[1])


def ratios_at(found: Fit, key: str, delay: float) -> Any:
    """Return e1 and e2 of a pair that meets at a delay in s, by the numbers of a fit."""
    k = found.names.index(f"{key}.gaps.0")
    trials = np.tile(found.x, (241, 1))
    trials[:, k] = np.linspace(0.0, 0.024, len(trials))
    out, *_ = found.objective.outcomes(key, trials)
    order = np.argsort(out.first_touch[:, 1])
    touch = out.first_touch[order, 1]
    return np.array([np.interp(delay, touch, out.rebound_ratio[order, ball]) for ball in (0, 1)])
