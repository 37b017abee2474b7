"""Predictions of the competing models for measurements that have not been made."""

from dataclasses import replace
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce import Drop, simulate, sweep
from stackbounce.cross2007.drops import fallen_speed, risen_height
from studies.table2 import inputs
from studies.table2.catalogue import CHOSEN
from studies.table2.comparison import FittedModels

Array: TypeAlias = NDArray[np.float64]

_LOW, _HIGH = 0.05, 0.80  # m: of other falls
_GAP = 2e-3  # m
_REBOUND = "B1 alone from 20 cm: rebound height", "cm"
_PENDULUMS = "two B1 as pendulums, closing at 2.0 m/s: restitution", ""


class Prediction(NamedTuple):
    """A measurement, its unit, and the prediction of each model."""

    what: str
    unit: str
    values: dict[str, float]

    @property
    def spread(self) -> float:
        """The difference of the largest and the smallest prediction."""
        return max(self.values.values()) - min(self.values.values())


def predict(compared: FittedModels) -> list[Prediction]:
    """Predict measurements that would discriminate between the chosen models."""
    speed = fallen_speed(inputs.HEIGHT)
    rows: dict[tuple[str, str], list[float]] = {}
    for name in CHOSEN:
        alone = {height: _alone(compared, name, height) for height in (_LOW, inputs.HEIGHT, _HIGH)}
        usual, low = _stack(compared, name, inputs.HEIGHT), _stack(compared, name, _LOW)
        for what, value in (
            (_REBOUND, 100.0 * risen_height(alone[inputs.HEIGHT] * speed)),
            (("B1 alone from 5 cm: restitution", ""), alone[_LOW]),
            (("B1 alone from 80 cm: restitution", ""), alone[_HIGH]),
            (_PENDULUMS, _meeting(compared, name, speed)),
            (("B1 on B2, gap set to 2.0 mm: e1", ""), usual[0]),
            (("B1 on B2, gap set to 2.0 mm: e2", ""), usual[1]),
            (("B1 on B2, 2.0 mm, from 5 cm: e1", ""), low[0]),
        ):
            rows.setdefault(what, []).append(float(value))
    return [
        Prediction(what, unit, dict(zip(CHOSEN, values, strict=True)))
        for (what, unit), values in rows.items()
    ]


def predict_restitutions(compared: FittedModels, name: str, heights: Array) -> Array:
    """Return the restitution of B1 alone after falls from heights in m."""
    return np.array([_alone(compared, name, height) for height in heights.tolist()])


def sweep_gap(
    compared: FittedModels, name: str, pair: str, gaps: Array
) -> tuple[Array, Array, Array]:
    """Return e1, e2 and the delay in s of a pair for gaps in m."""
    found = sweep(compared.drop(name, pair), {"gaps.0": gaps}, rtol=1e-8)
    ratios = found["rebound_ratio"]
    touch = found["first_touch"].isel(contact=1)
    return (
        np.asarray(ratios.isel(ball=0)),
        np.asarray(ratios.isel(ball=1)),
        np.asarray(touch),
    )


def _alone(compared: FittedModels, name: str, height: float) -> float:
    drop = compared.drop(name, "B2_on_B1")
    own = Drop(drop.balls[:1], drop.contacts[:1], height=height)
    return float(simulate(own, rtol=1e-8).rebound_ratios[0])


def _meeting(compared: FittedModels, name: str, speed: float) -> float:
    """Return the restitution of two balls B1 that meet at a speed in m/s."""
    drop = compared.drop(name, "B1_on_B1")
    own = Drop(drop.balls, [None, drop.contacts[1]], velocities=[speed, 0.0])
    lower, upper = simulate(own, rtol=1e-8).rebound_speeds
    return float((upper - lower) / speed)


def _stack(compared: FittedModels, name: str, height: float) -> Array:
    drop = replace(compared.drop(name, "B1_on_B2"), gaps=(_GAP,), height=height)
    return np.asarray(simulate(drop, rtol=1e-8).rebound_ratios)
