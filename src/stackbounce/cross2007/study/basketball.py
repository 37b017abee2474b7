"""The sixth row of Table II, the tennis ball on the basketball, fitted separately.

For the hollow ball only the restitution and the impact duration are known. Stiffness, stiffness
ratio and gap are fitted to three values, with loss at the floor only or in both contacts.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from stackbounce.calibration import calibrate
from stackbounce.cross2007.data import PAPER
from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.searches import fit_model
from stackbounce.cross2007.study.theories import ELASTIC, SHARED
from stackbounce.fitting import FitProblem, Model
from stackbounce.model import Ball, Drop, HuntCrossley

__all__ = ["Stack", "fit_stacks"]

_EXPONENTS = (1.0, 1.5)
_SOFT = {1.0: (5e2, 2e4), 1.5: (5e3, 2e5)}  # N/m**exponent, of the basketball on the floor
_RATIOS = (1.0, 6.0)


class Stack(NamedTuple):
    """A fit of the basketball's row; `where` says whether the ball-ball contact loses energy.

    `ratio` is the stiffness ratio, floor over ball-ball; `gap` is in m; `ratios` are the fitted
    rebound ratios; `chi_squared` is that of three values.
    """

    exponent: float
    where: str
    ratio: float
    gap: float
    ratios: tuple[float, float]
    chi_squared: float


def fit_stacks() -> list[Stack]:
    """Fit linear and Hertzian contacts, with loss at the floor only and in both contacts."""
    return [_fitted(p, where) for where in (ELASTIC, SHARED) for p in _EXPONENTS]


def read_restitution(name: str) -> float:
    """Return the restitution of a single ball, from the heights that the paper gives."""
    return math.sqrt(PAPER[f"{name}.rebound_height"].value / PAPER["stack.drop_height"].value)


def _fitted(exponent: float, where: str) -> Stack:
    model, data = _model(exponent, where), _data()
    found = fit_model(model, {"stack": data})
    lower, upper = (one.fitted for one in found.residuals[:2])
    best = found.best
    own = best["ratio"], best["gaps.0"], (lower, upper)
    return Stack(exponent, where, *own, found.chi_squared)


def _data() -> dict[str, Any]:
    ratios = [
        (PAPER[f"tennis_on_basketball.{one}"].value, inputs.ERROR) for one in ("lower", "upper")
    ]
    return {
        "rebound_ratios": ratios,
        "durations.0": (PAPER["stack.duration"].value, PAPER["stack.duration"].spread),
    }


def _model(p: float, where: str) -> FitProblem:
    speed = PAPER["stack.impact_speed"].value
    tennis = calibrate(
        HuntCrossley,
        mass=PAPER["tennis.mass"].value,
        contact_time=PAPER["tennis.contact_time"].value,
        restitution=read_restitution("tennis"),
        impact_speed=speed,
        exponent=p,
    )
    # dissipation times speed depends on the restitution only, so the contact time is arbitrary
    floor = calibrate(
        HuntCrossley,
        mass=1.0,
        contact_time=1.0,
        restitution=read_restitution("basketball"),
        impact_speed=speed,
        exponent=p,
    ).dissipation

    def lost(values: Mapping[str, Any]) -> Any:
        soft = (values["contacts.0.stiffness"] / values["ratio"]) ** (-1.0 / p)
        f = np.clip(1.0 - tennis.stiffness ** (-1.0 / p) / soft, 0.0, 1.0)
        return f**2 * floor + (1.0 - f) ** 2 * tennis.dissipation

    balls = [Ball(PAPER[f"{name}.mass"].value) for name in ("basketball", "tennis")]
    contacts = [HuntCrossley(_SOFT[p][0], p, floor), HuntCrossley(_SOFT[p][0], p, 0.0)]
    drop = Drop(balls, contacts, gaps=[1e-3], impact_speed=speed)
    vary = {
        "contacts.0.stiffness": _SOFT[p],
        "ratio": _RATIOS,
        "gaps.0": (0.0, PAPER["stack.gap"].value),
    }
    tie: dict[str, Any] = {"contacts.1.stiffness": "contacts.0.stiffness / ratio"}
    if where == SHARED:
        tie["contacts.1.dissipation"] = lost
    return Model({"stack": drop}, vary, tie)
