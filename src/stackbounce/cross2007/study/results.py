"""The results of the study."""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from stackbounce.cross2007.study import inputs
from stackbounce.cross2007.study.basketball import Stack, fit_stacks
from stackbounce.cross2007.study.comparison import FittedModels, fit_models
from stackbounce.cross2007.study.energy import EnergyBound, bound_energy
from stackbounce.cross2007.study.hierarchy import Hierarchy, weigh_models
from stackbounce.cross2007.study.information import Information, rank_measurements
from stackbounce.cross2007.study.predictions import Prediction, predict
from stackbounce.cross2007.study.readings import Reading, fit_readings
from stackbounce.cross2007.study.records import Fact, compare_records
from stackbounce.cross2007.study.section_v import Refit, refit_section_v
from stackbounce.cross2007.study.sensitivity import (
    Held,
    hold_out,
    loosen_delays,
    scan_loss,
    score_late_delay,
    score_with_gravity,
    vary_assumptions,
)
from stackbounce.version import __version__

__all__ = ["Study", "run_study"]

_HELD = ("S, fitted", "B")


@dataclass(frozen=True, eq=False)
class Study:
    """All results; each part is documented in its module.

    Examples
    --------
    >>> from stackbounce.cross2007.study.energy import bound_energy
    >>> bound_energy("B3_on_B1").excess > 6.0
    True
    """

    compared: FittedModels
    kept: list[EnergyBound]
    readings: list[Reading]
    between: dict[float, float]
    changes: dict[str, dict[str, float]]
    loose: FittedModels
    late: dict[str, float]
    falling: float
    held_out: dict[str, list[Held]]
    facts: list[Fact]
    predictions: list[Prediction]
    stacks: list[Stack]
    refits: list[Refit]
    weighed: Hierarchy
    expected: Information

    @functools.cached_property
    def rows(self) -> list[dict[str, Any]]:
        """A row for each model, the best by AICc first."""
        own = self.compared
        return [
            {
                "name": one.model,
                "title": own.titles[one.model],
                "shared": own.shared(one.model),
                "ten": own.of_ratios(one.model),
                "delays": one.chi_squared - own.of_ratios(one.model),
                "chi_squared": one.chi_squared,
                "aicc": one.aicc,
                "bic": one.bic,
                "worst": own.worst(one.model),
                "within": own.within(one.model),
            }
            for one in own.comparison.scores
        ]

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers as plain values, for JSON."""
        own = self.compared
        return {
            "stackbounce": __version__,
            "data": inputs.MEASURED,
            "models": [{**row, "pairs": own.pairs(row["name"])} for row in self.rows],
            "energy": [{**one._asdict(), "excess": one.excess} for one in self.kept],
            "readings": [one._asdict() for one in self.readings],
            "loss_between_balls": self.between,
            "changes": self.changes,
            "delays_within_1_ms": {
                name: one.chi_squared for name, one in self.loose.comparison.fits.items()
            },
            "B1_on_B3_at_7_ms": self.late,
            "S_with_gravity": self.falling,
            "held_out": {
                name: [{**one._asdict(), "pulls": one.pulls} for one in rows]
                for name, rows in self.held_out.items()
            },
            "records": [one._asdict() for one in self.facts],
            "predictions": [one._asdict() for one in self.predictions],
            "basketball": [one._asdict() for one in self.stacks],
            "section_v": [
                {**one._asdict(), "numbers": [number._asdict() for number in one.numbers]}
                for one in self.refits
            ],
            "hierarchy": self.weighed.as_dict(),
            "information": self.expected.as_dict(),
        }


def run_study(progress: Callable[[str], None] = lambda _: None) -> Study:
    """Compute the study of Table II.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each step.
    """
    own = fit_models(progress)
    read = fit_readings(progress)
    scan = scan_loss(own, progress)
    progress("study: other assumptions")
    changed, free, other = vary_assumptions(own), loosen_delays(own), score_late_delay(own)
    progress("study: each pair from the other four")
    held = {name: hold_out(own, name) for name in _HELD}
    progress("study: force records and measurements that would decide")
    shown, said = compare_records(own), predict(own)
    weighed = weigh_models(progress)
    expected = rank_measurements(weighed, progress)
    progress("study: the basketball, and section V's fits")
    return Study(
        own,
        [bound_energy(pair) for pair in inputs.PAIRS],
        read,
        scan,
        changed,
        free,
        other,
        score_with_gravity(own, "S"),
        held,
        shown,
        said,
        fit_stacks(),
        refit_section_v(),
        weighed,
        expected,
    )
