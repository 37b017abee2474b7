"""The results of the study."""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from stackbounce.version import __version__
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
from studies.table2.hierarchy import Hierarchy, weigh_models
from studies.table2.information import Information, rank_measurements
from studies.table2.inner_mode_ranges import InnerModes, study_inner_modes
from studies.table2.predictions import Prediction, predict
from studies.table2.readings import Combination, fit_combinations
from studies.table2.records import Fact, compare_records
from studies.table2.section_v import Refit, refit_section_v
from studies.table2.sensitivity import scan_loss, vary_assumptions

__all__ = ["BOTH", "Study", "run_study"]

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
    weighed: Hierarchy
    expected: Information
    modes: InnerModes

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
            "claims": [one._asdict() for one in self.claims],
            "data": {one.name: one.data() for one in BOTH},
            "models": [{**row, "pairs": own.pairs(row["name"])} for row in self.rows],
            "choices": self.fits.as_dict(),
            "energy": [{**one._asdict(), "excesses": one.excesses} for one in self.kept],
            "inner_modes": self.modes.as_dict(),
            "readings": {
                choice: [
                    {"reading": one.reading, "law": one.law, "chi_squared": one.fit.chi_squared}
                    for one in tried
                ]
                for choice, tried in self.readings.items()
            },
            "loss_between_balls": self.between,
            "changes": self.changes,
            "held_out": self.held_out,
            "selected": self.selected,
            "records": [one._asdict() for one in self.facts],
            "predictions": [one._asdict() for one in self.predictions],
            "basketball": [one._asdict() for one in self.stacks],
            "buckling": [one._asdict() for one in self.bucklings],
            "basketball_limits": [one._asdict() for one in self.limits],
            "section_v": [
                {**one._asdict(), "numbers": [number._asdict() for number in one.numbers]}
                for one in self.refits
            ],
            "hierarchy": self.weighed.as_dict(),
            "information": self.expected.as_dict(),
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
    read = {one.name: fit_combinations(one.data()) for one in BOTH}
    progress("study: the loss between two balls, and smaller assumptions")
    scan = {one.name: scan_loss(fits[one], one) for one in BOTH}
    changed = vary_assumptions(fits[BASE])
    held = cross_validate(fits, progress)
    progress("study: force records and measurements that would decide")
    shown, said = compare_records(fits[BASE]), predict(fits[BASE])
    weighed = weigh_models(progress)
    expected = rank_measurements(weighed, progress)
    progress("study: the basketball, section V's fits, and inner vibrations")
    return Study(
        fits,
        [bound_energy(pair) for pair in inputs.PAIRS],
        read,
        scan,
        changed,
        held,
        {choice: cross_validate_selection(tried) for choice, tried in read.items()},
        shown,
        said,
        fit_stacks(),
        fit_bucklings(),
        [find_limits(one) for one in READINGS],
        refit_section_v(),
        weighed,
        expected,
        study_inner_modes(),
    )
