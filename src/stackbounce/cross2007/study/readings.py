"""Three readings of Table I's restitutions with every law; only the gaps are fitted."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.catalogue import AS_HEIGHTS, AS_PRINTED, MISPRINT
from stackbounce.cross2007.study.searches import fit_model
from stackbounce.cross2007.study.theories import SHARED, Theory
from stackbounce.model import HuntCrossley, Hysteretic, Viscoelastic

__all__ = ["LAWS", "READINGS", "Reading", "fit_readings"]

READINGS = {
    "as printed": AS_PRINTED,
    "ratios of heights": AS_HEIGHTS,
    "0.78 a slip for 0.88": MISPRINT,
}
"""The restitutions of the balls if Table I's COR is a restitution, a ratio of heights, or
misprinted for B1."""

LAWS: dict[str, Theory] = {
    "Hunt and Crossley": Theory("", HuntCrossley, SHARED),
    "viscoelastic": Theory("", Viscoelastic, SHARED),
    "hysteresis": Theory("", Hysteretic, SHARED),
    "hysteresis, lossy reloading": Theory("", Hysteretic, SHARED, reloading="lossy"),
    "the same, linear": Theory("", Hysteretic, SHARED, exponent=1.0, reloading="lossy"),
}
"""The laws, with the loss of both balls in every contact."""


class Reading(NamedTuple):
    """Chi squared of ten values and five delays with each law, by its name."""

    name: str
    restitutions: dict[str, float]
    chi_squared: dict[str, float]


def fit_readings(progress: Callable[[str], None] = lambda _: None) -> list[Reading]:
    """Fit the gaps for each reading with each law."""
    rows = []
    for name, known in READINGS.items():
        progress(f"study: Table I's restitutions {name}")
        found = {
            law: fit_model(replace(theory, known=known).model(), inputs.MEASURED).chi_squared
            for law, theory in LAWS.items()
        }
        rows.append(Reading(name, known, found))
    return rows
