"""Sensitivity of the result to smaller assumptions: masses, times, and the loss of two balls."""

import math
from collections.abc import Callable
from dataclasses import replace

from stackbounce.cross2007 import PAPER
from studies.table2 import inputs
from studies.table2.catalogue import AS_HEIGHTS, THEORIES
from studies.table2.choices import Choice
from studies.table2.comparison import FittedModels
from studies.table2.searches import fit_near, refit
from studies.table2.theories import Theory

_BETWEEN = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0)
_SCANNED = "S, fitted"


def scan_loss(compared: FittedModels, choice: Choice) -> dict[float, float]:
    """Return chi squared by the factor on the loss between two balls, with the choice's data."""
    found = {}
    near = compared[_SCANNED]
    for factor in _BETWEEN:
        theory = replace(THEORIES[_SCANNED], known={"between": factor})
        near = fit_near(theory.model(), choice.data(), [near, compared[_SCANNED]])
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
        for ball in balls:
            shown = inputs.PRINTED[ball] + step
            known[f"e_{ball}"] = math.sqrt(shown) if theory.known == AS_HEIGHTS else shown
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
