"""The study's input: the superballs and the measurements of their pairs.

The five pairs of superballs are fitted together. B1 has 105 g, from Table II's mass ratios (4.23,
12.3, 1.040); only the upper ball of the pair of two balls B1 has Table I's 101 g.
"""

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce import Ball
from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.datasets import load_dataset

Array: TypeAlias = NDArray[np.float64]

PAIRS: dict[str, tuple[str, str]] = {
    "B2_on_B1": ("B1", "B2"),
    "B1_on_B2": ("B2", "B1"),
    "B3_on_B1": ("B1", "B3"),
    "B1_on_B3": ("B3", "B1"),
    "B1_on_B1": ("B1", "B1"),
}
"""The lower and the upper ball of each pair, in the order of Table II."""

HEAVY = PAPER["B1_on_B1.mass_ratio"].value * PAPER["B1.mass"].value
"""The mass of the heavier B1 in kg."""

HEIGHT = PAPER["superballs.drop_height"].value
"""The drop height in m."""

PRINTED = {"B1": PAPER["B1.restitution"].value, "B2": 0.90, "B3": 0.90}
"""Table I's column COR, taken as the coefficient of restitution."""

DELAY = "first_touch.1"
RATIOS = ("rebound_ratios.0", "rebound_ratios.1")

ERROR = PAPER["B2_on_B1.lower"].spread
"""The error of every value of Table II."""

_TWINS = (3e-3, 2e-3)  # s: from the shortest delay, 1 ms, to just after the lower ball has left
LATE = (PAPER["superballs.late_delay"].value, PAPER["superballs.delay"].spread)
"""The later of the two delays that were recorded for B1 on B3."""


class Solo(NamedTuple):
    """A ball alone on the floor: mass in kg, contact time in s, as Table I has them."""

    mass: float
    contact_time: float


def read_solo(ball: str, heavy: float = HEAVY) -> Solo:
    """Return mass and contact time of a ball from Table I; `heavy` is the mass of B1 in kg."""
    mass = heavy if ball == "B1" else PAPER[f"{ball}.mass"].value
    return Solo(mass, PAPER[f"{ball}.contact_time"].value)


def make_balls(key: str, heavy: float = HEAVY) -> list[Ball]:
    """Return the balls of a pair, the lower one first; two B1 keep their printed ratio."""
    lower, upper = PAIRS[key]
    masses = [read_solo(lower, heavy).mass, read_solo(upper, heavy).mass]
    if lower == upper:
        masses = [HEAVY, PAPER["B1.mass"].value]
    return [Ball(mass, name=name) for mass, name in zip(masses, (lower, upper), strict=True)]


def _measured(key: str) -> dict[str, Any]:
    """Return Table II's row of a pair, and the delay of its force record."""
    data = load_dataset("-".join(PAIRS[key])).data
    usual = PAPER["superballs.delay"]
    delay = _TWINS if key == "B1_on_B1" else (usual.value, usual.spread)
    return {"rebound_ratios": data["rebound_ratios"], DELAY: delay}


MEASURED: dict[str, dict[str, Any]] = {key: _measured(key) for key in PAIRS}
"""By pair: the ten values of Table II, each ± 0.02, and the delays in s, as `stackbounce.fit` takes
them. Of the two delays that were recorded for B1 on B3 it is the shorter one."""


def delay_late() -> dict[str, dict[str, Any]]:
    """Return `MEASURED` with the longer delay of B1 on B3, 7 ms."""
    return {**MEASURED, "B1_on_B3": {**MEASURED["B1_on_B3"], DELAY: LATE}}


def read_ratios(key: str) -> tuple[float, float]:
    """Return e1 and e2 of a pair in Table II."""
    (lower, _), (upper, _) = MEASURED[key]["rebound_ratios"]
    return lower, upper
