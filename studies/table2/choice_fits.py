"""Every model of the catalogue fitted with every choice of the analysis."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from stackbounce.fitting import Comparison, Fit
from stackbounce.fitting.least_squares import Minimum
from studies.table2.catalogue import NAMES, THEORIES
from studies.table2.choices import BASE, CHOICES, LATE, Choice
from studies.table2.comparison import FittedModels, Score, score
from studies.table2.observed import observe
from studies.table2.searches import fit_model, fit_near
from studies.table2.workers import spread

MODELS = (*NAMES, *THEORIES)
"""The names of all models."""


class Cell(NamedTuple):
    """A model with a choice: its goodness, and how far its BIC is above the smallest one."""

    score: Score
    behind: float


@dataclass(frozen=True, eq=False)
class ChoiceFits:
    """The fits of all models, by the name of the choice.

    Parameters
    ----------
    columns : dict of str to FittedModels
        In the order of `CHOICES`.
    """

    columns: dict[str, FittedModels]

    def __getitem__(self, choice: Choice) -> FittedModels:
        """The fits with one choice."""
        return self.columns[choice.name]

    @functools.cached_property
    def cells(self) -> dict[str, dict[str, Cell]]:
        """The cells of the table, by model and by the name of the choice."""
        found: dict[str, dict[str, Cell]] = {name: {} for name in self[BASE].order}
        for choice, fits in self.columns.items():
            scores = {name: score(fits[name]) for name in found}
            least = min(score.bic for score in scores.values())
            for name, own in scores.items():
                found[name][choice] = Cell(own, own.bic - least)
        return found

    @functools.cached_property
    def leaders(self) -> dict[str, str]:
        """The model with the smallest BIC, by the name of the choice."""
        return {choice: fits.order[0] for choice, fits in self.columns.items()}

    def as_dict(self) -> dict[str, Any]:
        """Return the table as plain values, for JSON."""
        return {
            "choices": {choice.name: choice._asdict() for choice in CHOICES},
            "leaders": self.leaders,
            "cells": {
                name: {
                    choice: {
                        **cell.score._asdict(),
                        "behind_in_bic": cell.behind,
                        "fitted": self.columns[choice].shared(name),
                    }
                    for choice, cell in row.items()
                }
                for name, row in self.cells.items()
            },
        }


def fit_choices(progress: Callable[[str], None] = lambda _: None, workers: int = 1) -> ChoiceFits:
    """Fit all models with all choices.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each step.
    workers : int, optional
        Processes that share the models; the result does not depend on it.
    """
    rows: dict[str, list[list[float]]] = {}
    for name, found in zip(MODELS, spread(fit_row, MODELS, workers), strict=True):
        progress(f"study: model '{name}', {len(CHOICES)} choices")
        rows[name] = found
    return ChoiceFits(
        {
            choice.name: FittedModels(
                Comparison({name: _rebuild(name, choice, rows[name][k]) for name in MODELS}, {})
            )
            for k, choice in enumerate(CHOICES)
        }
    )


def fit_row(name: str) -> list[list[float]]:
    """Return the best trial of a model with each choice.

    The base and the later delay are searched from nothing, the others start from these two, and
    with gravity also from the first fit that has it. Equal inputs are fitted once.
    """
    fits: dict[str, tuple[Choice, Fit]] = {}
    for choice in CHOICES:
        known = next((fit for other, fit in fits.values() if choice.same(other, name)), None)
        if known is None:
            model, data = choice.model(name), choice.data()
            if choice in (BASE, LATE):
                known = fit_model(model, data)
            else:
                near = [fits[searched.name][1] for searched in (BASE, LATE)]
                falling = [fit for other, fit in fits.values() if choice.gravity and other.gravity]
                known = fit_near(model, data, near + falling[:1])
        fits[choice.name] = choice, known
    return [fit.x.tolist() for _, fit in fits.values()]


def _rebuild(name: str, choice: Choice, x: list[float]) -> Fit:
    """Return a fit from its best trial."""
    objective = observe(replace(choice.model(name), data=choice.data()))
    trial = np.array(x)
    return Fit(objective, [Minimum(trial, float(objective.chi_squared(trial[None])[0]), True)])
