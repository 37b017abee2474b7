"""All datasets beside all laws."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from stackbounce import datasets
from stackbounce.validation.comparison import (
    REFUTED_BELOW,
    Comparison,
    Outcome,
    compare_laws,
)
from stackbounce.validation.series import make_series, why_not

__all__ = ["Validation", "validate"]


@dataclass(frozen=True)
class Validation:
    """What the published measurements say of the contact laws.

    Parameters
    ----------
    comparisons : tuple of Comparison
        One for each dataset that has a quantity as a function of the speed.
    left_out : dict of str to str
        The other datasets, and why.
    """

    comparisons: tuple[Comparison, ...]
    left_out: dict[str, str]

    @property
    def summary(self) -> str:
        """How many verdicts there are, and how many series rest on errors that are assumed."""
        verdicts = sum(len(one.outcomes) for one in self.comparisons)
        shaky = sum(not one.steady for one in self.comparisons)
        return (
            f"{len(self.comparisons)} series have {verdicts} verdicts; if all laws were true, "
            f"chance alone would refute {REFUTED_BELOW * verdicts:.1f} of them. {shaky} of the "
            "series are not steady: half or twice the assumed errors change a verdict."
        )

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain values."""
        return {
            "summary": self.summary,
            "datasets": [_as_dict(one) for one in self.comparisons],
            "left_out": self.left_out,
        }


def validate(progress: Callable[[str], None] = lambda _: None) -> Validation:
    """Compare each contact law with each published measurement that depends on the speed.

    Each law is calibrated at the highest speed of a series and asked for the others, and it is
    fitted to all of them. Both are judged by χ², with all errors and their correlations.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each dataset.

    Returns
    -------
    Validation
    """
    found: list[Comparison] = []
    left_out: dict[str, str] = {}
    for name in datasets.names():
        data = datasets.load(name)
        reason = why_not(data)
        if reason:
            left_out[name] = reason
            continue
        progress(name)
        series = make_series(data)
        without_air = make_series(data, air=False) if series.drag else None
        found.append(compare_laws(series, without_air))
    return Validation(tuple(found), left_out)


def _as_dict(comparison: Comparison) -> dict[str, Any]:
    series = comparison.series
    errors = [float(one) ** 0.5 for one in series.covariance().diagonal()]
    return {
        "name": series.name,
        "title": series.title,
        "ball": series.ball,
        "quantity": series.quantity,
        "drag": series.drag,
        "speeds": series.speeds.tolist(),
        "values": series.values.tolist(),
        "errors": errors,
        "assumed_errors": series.has_assumed_errors,
        "freedom_of_errors": None if math.isinf(series.freedom()) else series.freedom(),
        "exponent": comparison.exponent,
        "exponent_error": comparison.exponent_error,
        "p_power": comparison.p_power,
        "laws": [_law_as_dict(name, one) for one in comparison.outcomes for name in one.laws],
        "skipped": comparison.skipped,
        "tells_apart": comparison.tells_apart,
        "steady": comparison.steady,
        "summary": comparison.summary,
    }


def _law_as_dict(name: str, outcome: Outcome) -> dict[str, Any]:
    numbers = {key: value for key, value in vars(outcome).items() if key != "laws"}
    return {"law": name} | numbers | {"verdict": outcome.verdict, "steady": outcome.steady}
