"""Fits of simulated drops with noise: how often errors, intervals and draws cover the truth."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from uncertainties import UFloat, ufloat

import stackbounce as sb
from benchmarks.coverage.shares import Trial
from synthetic.waveform import waveform

__all__ = ["CASES"]

STARTS = 4
"""Trials to look at: few, as these surfaces have one minimum."""

DRAWS = 2560
"""From the posterior: some 300 independent ones."""

LIGHT, HEAVY = sb.Ball(0.057), sb.Ball(0.150)
MILLISECOND = 1e-3


def _stack(lower: Any, upper: Any, gap: float = 0.0, speed: float = 3.5) -> sb.Drop:
    return sb.Drop([HEAVY, LIGHT], [lower, upper], gaps=[gap], impact_speed=speed)


def _measured(
    drop: sb.Drop, errors: Mapping[str, float], random: np.random.Generator
) -> dict[str, UFloat]:
    """Return what is measured of a drop, each number with its error, once."""
    out = sb.sweep(drop, {"impact_speed": [drop.impact_speed]}).isel(impact_speed=0)
    ratios, touch, release = (
        out[name].values for name in ("rebound_ratio", "first_touch", "last_release")
    )
    truth = {f"rebound_ratios.{i}": ratio for i, ratio in enumerate(ratios)}
    truth |= {f"first_touch.{i}": time for i, time in enumerate(touch)}
    truth |= {f"durations.{i}": time for i, time in enumerate(release - touch)}
    return {
        name: ufloat(random.normal(truth[name], error), error) for name, error in errors.items()
    }


def _compared(fit: sb.Fit, truth: Mapping[str, float], whole: bool) -> list[tuple[str, Any, float]]:
    """Return errors beside what is true, and as a whole intervals and the draws' 68 % too."""
    if not whole:
        return [(name, fit[name], true) for name, true in truth.items()]
    intervals, draws = fit.intervals(), fit.sample(DRAWS, rng=1)
    found: list[tuple[str, Any, float]] = []
    for name, true in truth.items():
        low, _, high = draws.quantiles(name)
        found += [
            (name, fit[name], true),
            (f"{name}, interval", _between(*intervals[name][:2]), true),
            (f"{name}, draws", _between(low, high), true),
        ]
    return found


def _between(low: float, high: float) -> UFloat:
    return ufloat(0.5 * (low + high), 0.5 * (high - low))


def _alone(
    drop: sb.Drop,
    errors: Mapping[str, float],
    vary: Mapping[str, tuple[float, float]],
    truth: Mapping[str, float],
) -> Trial:
    def trial(seed: int, whole: bool = True) -> list[tuple[str, Any, float]]:
        data = _measured(drop, errors, np.random.default_rng(seed))
        return _compared(sb.fit(drop, data, vary, starts=STARTS), truth, whole)

    return trial


RATIOS = {"rebound_ratios.0": 0.01, "rebound_ratios.1": 0.01}

_SPRINGS = _alone(
    _stack(sb.Spring(2500.0), sb.Spring(1000.0), gap=0.002),
    {**RATIOS, "first_touch.1": 0.02 * MILLISECOND},
    {"contacts.1.stiffness": (300.0, 3000.0), "gaps.0": (0.0, 0.01)},
    {"contacts.1.stiffness": 1000.0, "gaps.0": 0.002},
)
_HERTZ = _alone(
    _stack(sb.Hertz(1e5), sb.Hertz(5e4)),
    {**RATIOS, "durations.0": 0.2 * MILLISECOND},
    {"contacts.0.stiffness": (3e4, 3e5), "contacts.1.stiffness": (1e4, 2e5)},
    {"contacts.0.stiffness": 1e5, "contacts.1.stiffness": 5e4},
)
_HYSTERETIC = _alone(
    sb.Drop([HEAVY], [sb.Hysteretic(2500.0, restitution=0.77)], impact_speed=3.5),
    {"rebound_ratios.0": 0.01, "durations.0": 0.5 * MILLISECOND},
    {"contacts.0.stiffness": (500.0, 1e4), "contacts.0.restitution": (0.3, 1.0)},
    {"contacts.0.stiffness": 2500.0, "contacts.0.restitution": 0.77},
)


def _three(law: Callable[[float, float], sb.Drop]) -> dict[str, sb.Drop]:
    """Return three drops that share what is to be found, of other mass ratios."""
    return {f"drop{k}": law(*masses) for k, masses in enumerate(_MASSES)}


_MASSES = [(0.150, 0.057), (0.300, 0.030), (0.100, 0.080)]


def _rigid(seed: int, whole: bool = True) -> list[tuple[str, Any, float]]:
    """Three rigid stacks with one restitution between the balls."""
    random = np.random.default_rng(seed)
    contacts = [sb.Rigid(0.9), sb.Rigid(0.7)]
    drops = _three(
        lambda m, n: sb.Drop([sb.Ball(m), sb.Ball(n)], contacts, gaps=[0.01], impact_speed=2.0)
    )
    data = {key: _measured(drop, RATIOS, random) for key, drop in drops.items()}
    found = sb.fit(drops, data, {"contacts.1.restitution": (0.1, 1.0)}, starts=STARTS)
    return _compared(found, {"contacts.1.restitution": 0.7}, whole)


def _tied(seed: int, whole: bool = True) -> list[tuple[str, Any, float]]:
    """Three stacks of springs that share a stiffness; the other is tied to it by a factor."""
    random = np.random.default_rng(seed)
    springs = [sb.Spring(2500.0), sb.Spring(1000.0)]
    drops = _three(lambda m, n: sb.Drop([sb.Ball(m), sb.Ball(n)], springs, impact_speed=3.5))
    errors = {**RATIOS, "durations.0": 0.3 * MILLISECOND}
    data = {key: _measured(drop, errors, random) for key, drop in drops.items()}
    found = sb.fit(
        drops,
        data,
        {"contacts.0.stiffness": (500.0, 1e4), "softer": (0.1, 1.0)},
        tie={"contacts.1.stiffness": "softer * contacts.0.stiffness"},
        starts=STARTS,
    )
    return _compared(found, {"contacts.0.stiffness": 2500.0, "softer": 0.4}, whole)


def _known(seed: int, whole: bool = True) -> list[tuple[str, Any, float]]:
    """One duration tells mass or stiffness: the mass was weighed, too."""
    random = np.random.default_rng(seed)
    drop = sb.Drop([HEAVY], [sb.Spring(2500.0)], impact_speed=3.5)
    data = _measured(drop, {"durations.0": 0.5 * MILLISECOND}, random)
    weighed = (random.normal(0.150, 0.002), 0.002)
    vary = {
        "contacts.0.stiffness": (500.0, 1e4),
        "balls.0.mass": sb.Range(0.1, 0.2, prior=weighed),
    }
    truth = {"contacts.0.stiffness": 2500.0, "balls.0.mass": 0.150}
    return _compared(sb.fit(drop, data, vary, starts=STARTS), truth, whole)


def _volts(seed: int, whole: bool = True) -> list[tuple[str, Any, float]]:
    """The floor's force under one ball, in volts of an unknown sensor: its shape tells k.

    Errors alone, as a record takes long to be followed.
    """
    del whole
    drop = sb.Drop([HEAVY], [sb.Hertz(1e5)], impact_speed=3.5)
    record = waveform(drop, rate=10_000.0, sensitivity=0.01, noise=0.1, seed=seed, before=0.01)
    vary = {"contacts.0.stiffness": (3e4, 3e5)}
    found = sb.fit(drop, {"force.0": record.voltage}, vary, starts=STARTS)
    return _compared(found, {"contacts.0.stiffness": 1e5}, whole=False)


CASES: dict[str, Callable[..., list[tuple[str, Any, float]]]] = {
    "two springs with a gap": _SPRINGS,
    "Hertz": _HERTZ,
    "Hysteretic": _HYSTERETIC,
    "Rigid, three drops": _rigid,
    "springs tied, three drops": _tied,
    "a duration and a weighed mass": _known,
    "a force record in volts": _volts,
}
"""Case name to a trial: seed to (quantity, estimate, truth); intervals and draws if `whole`."""
