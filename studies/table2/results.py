"""The results of the study."""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from stackbounce import __version__
from studies.table2 import inputs
from studies.table2.basketball import (
    READINGS,
    Limits,
    Stack,
    find_limits,
    fit_bucklings,
    fit_stacks,
)
from studies.table2.choice_fits import ChoiceFits, fit_choices
from studies.table2.choices import BASE, LATE
from studies.table2.claims import Claim, check_claims, state_headline
from studies.table2.comparison import FittedModels
from studies.table2.cross_validation import (
    HeldOut,
    cross_validate,
    cross_validate_selection,
)
from studies.table2.energy import EnergyBound, bound_energy
from studies.table2.predictions import Prediction, predict
from studies.table2.readings import Combination, fit_combinations
from studies.table2.records import Fact, compare_records
from studies.table2.section_v import Refit, refit_section_v
from studies.table2.sensitivity import scan_loss, vary_assumptions

BOTH = (BASE, LATE)
"""The two delays of B1 on B3: nothing in the paper decides which one belongs to Table II."""


@dataclass(frozen=True, eq=False)
class Study:
    """All results; each part is documented in its module.

    `readings`, `between`, `held_out` and `selected` are by the name of the choice, for both delays
    of B1 on B3.

    Examples
    --------
    >>> from studies.table2.energy import bound_energy
    >>> bound_energy("B3_on_B1").excesses["drop height"] > 3.0
    True
    """

    fits: ChoiceFits
    kept: list[EnergyBound]
    readings: dict[str, list[Combination]]
    between: dict[str, dict[float, float]]
    changes: dict[str, dict[str, float]]
    held_out: dict[str, dict[str, list[HeldOut]]]
    selected: dict[str, list[HeldOut]]
    facts: list[Fact]
    predictions: list[Prediction]
    stacks: list[Stack]
    bucklings: list[Stack]
    limits: list[Limits]
    refits: list[Refit]

    @property
    def compared(self) -> FittedModels:
        """The fits of the base."""
        return self.fits[BASE]

    @functools.cached_property
    def claims(self) -> list[Claim]:
        """What may be claimed, and with which choices it holds."""
        return check_claims(self.fits)

    @functools.cached_property
    def headline(self) -> str:
        """The conclusion that holds with every choice."""
        return state_headline(self.fits, self.claims)

    @functools.cached_property
    def rows(self) -> list[dict[str, Any]]:
        """A row for each model with the base, the smallest BIC first."""
        own = self.compared
        return [
            {
                "name": name,
                "title": own.titles[name],
                "shared": own.shared(name),
                "ten": own.of_ratios(name),
                "delays": own[name].chi_squared - own.of_ratios(name),
                **self.fits.cells[name][BASE.name].score._asdict(),
                "behind": self.fits.cells[name][BASE.name].behind,
                "worst": own.worst(name),
                "within": own.within(name),
            }
            for name in own.order
        ]

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers as plain values, for JSON."""
        own = self.compared
        return {
            "stackbounce": __version__,
            "headline": self.headline,
            "claims": [claim._asdict() for claim in self.claims],
            "data": {choice.name: choice.data() for choice in BOTH},
            "models": [{**row, "pairs": own.pairs(row["name"])} for row in self.rows],
            "choices": self.fits.as_dict(),
            "energy": [{**bound._asdict(), "excesses": bound.excesses} for bound in self.kept],
            "readings": {
                choice: [
                    {"reading": case.reading, "law": case.law, "chi_squared": case.fit.chi_squared}
                    for case in tried
                ]
                for choice, tried in self.readings.items()
            },
            "loss_between_balls": self.between,
            "changes": self.changes,
            "held_out": self.held_out,
            "selected": self.selected,
            "records": [fact._asdict() for fact in self.facts],
            "predictions": [prediction._asdict() for prediction in self.predictions],
            "basketball": [stack._asdict() for stack in self.stacks],
            "buckling": [buckling._asdict() for buckling in self.bucklings],
            "basketball_limits": [limit._asdict() for limit in self.limits],
            "section_v": [
                {**refit._asdict(), "numbers": [number._asdict() for number in refit.numbers]}
                for refit in self.refits
            ],
        }


def run_study(progress: Callable[[str], None] = lambda _: None, workers: int = 1) -> Study:
    """Compute the study of Table II.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each step.
    workers : int, optional
        Processes that share the fits of all choices; the result does not depend on it.
    """
    fits = fit_choices(progress, workers)
    progress("study: readings of Table I with every law")
    read = {choice.name: fit_combinations(choice.data()) for choice in BOTH}
    progress("study: the loss between two balls, and smaller assumptions")
    scan = {choice.name: scan_loss(fits[choice], choice) for choice in BOTH}
    changed = vary_assumptions(fits[BASE])
    held = cross_validate(fits, progress)
    progress("study: force records and measurements that would decide")
    facts, predictions = compare_records(fits[BASE]), predict(fits[BASE])
    progress("study: the basketball, and section V's fits")
    return Study(
        fits,
        [bound_energy(pair) for pair in inputs.PAIRS],
        read,
        scan,
        changed,
        held,
        {choice: cross_validate_selection(tried) for choice, tried in read.items()},
        facts,
        predictions,
        fit_stacks(),
        fit_bucklings(),
        [find_limits(reading) for reading in READINGS],
        refit_section_v(),
    )
