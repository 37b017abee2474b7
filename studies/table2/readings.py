"""Three readings of Table I's restitutions with every law; only the gaps are fitted."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from stackbounce import HuntCrossley, Hysteretic, StandardLinearSolid, Viscoelastic
from stackbounce.fitting import Fit
from studies.table2.catalogue import AS_HEIGHTS, AS_PRINTED, MISPRINT
from studies.table2.searches import fit_model
from studies.table2.theories import SHARED, Theory

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
    "hysteresis, linear": Theory("", Hysteretic, SHARED, exponent=1.0),
    "a solid that relaxes": Theory("", StandardLinearSolid, SHARED, exponent=1.0),
}
"""The laws, with the loss of both balls in every contact."""


class Combination(NamedTuple):
    """A law with a reading of Table I, and the fit of its gaps."""

    reading: str
    law: str
    fit: Fit

    def of_pair(self, pair: str) -> float:
        """Return chi squared of one pair."""
        return sum(residual.pull**2 for residual in self.fit.residuals if residual.drop == pair)


def fit_combinations(data: Mapping[str, Any]) -> list[Combination]:
    """Fit the gaps for each reading with each law."""
    return [
        Combination(reading, law, fit_model(replace(theory, known=known).model(), data))
        for reading, known in READINGS.items()
        for law, theory in LAWS.items()
    ]


def penalty(tried: int) -> float:
    """Return what the choice of one among several equally likely models costs in chi squared.

    It is twice the logarithm of their number: the prior probability of each is one over it.

    Examples
    --------
    >>> round(penalty(15), 1)
    5.4
    """
    return 2.0 * math.log(tried)
