"""Contact times: how often the error bars of a law's constants cover the truth."""

from collections.abc import Callable
from typing import Any

import numpy as np
from uncertainties import UFloat, ufloat

import stackbounce as sb
from stackbounce.measure import dynamic_stiffness, law_constants

__all__ = ["CASES"]

Trial = list[tuple[str, UFloat, float]]

ERRORS = {"mass": 0.0005, "contact_time": 0.1e-3, "restitution": 0.02, "impact_speed": 0.02}
"""Of Table I's kind, in SI units."""


def _measured(law: Any, mass: float, speed: float, seed: int) -> dict[str, UFloat]:
    """Return what is measured of a law with errors, once."""
    generator = np.random.default_rng(seed)
    truth = {
        "mass": mass,
        "contact_time": sb.contact_time(law, mass, speed),
        "restitution": sb.restitution(law, mass, speed),
        "impact_speed": speed,
    }
    return {
        name: ufloat(generator.normal(value, ERRORS[name]), ERRORS[name])
        for name, value in truth.items()
    }


def _case(law: Any, mass: float, speed: float) -> Callable[[int], Trial]:
    names = [
        name
        for name in ("stiffness", "damping", "dissipation", "dissipative_time")
        if hasattr(law, name)
    ]

    def trial(seed: int) -> Trial:
        measured = _measured(law, mass, speed, seed)
        if isinstance(law, sb.Spring | sb.Hertz | sb.PowerLaw):
            del measured["restitution"]
        exponent = law.exponent if isinstance(law, sb.PowerLaw) else None
        found = law_constants(type(law), **measured, exponent=exponent)
        return [(name, found.constants[name], getattr(law, name)) for name in names]

    return trial


def _dynamic(seed: int) -> Trial:
    """The dynamic stiffness of two superballs."""
    found, truth = [], (5.4e4, 3.6e4)
    for k, mass, own in zip(truth, (0.101, 0.0248), (2 * seed, 2 * seed + 1), strict=True):
        measured = _measured(sb.Spring(k), mass, 2.0, own)
        found.append(dynamic_stiffness(measured["mass"], measured["contact_time"]))
    return [("B1", found[0], truth[0]), ("B2", found[1], truth[1])]


CASES: dict[str, Callable[[int], Trial]] = {
    "dynamic stiffness": _dynamic,
    "Hertz": _case(sb.Hertz(8e5), 0.101, 2.0),
    "PowerLaw": _case(sb.PowerLaw(2e5, 1.25), 0.101, 2.0),
    "Dashpot": _case(sb.Dashpot(5.4e4, damping=15.0), 0.101, 2.0),
    "HuntCrossley": _case(sb.HuntCrossley(8e5, 1.5, dissipation=0.12), 0.101, 2.0),
    "Hysteretic": _case(sb.Hysteretic(5.4e4, restitution=0.78), 0.101, 2.0),
}
