"""What may be claimed of Table II: each claim is checked with every choice of the analysis."""

from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from studies.table2 import inputs
from studies.table2.catalogue import FLOOR_ONLY, NAMES
from studies.table2.choice_fits import Cell, ChoiceFits
from studies.table2.choices import CHOICES
from studies.table2.predictions import predict_restitutions

FITS = 0.05
"""A model gives the data if so large a chi squared has at least this probability."""

EXCLUDED = 1e-3
"""A model is excluded if so large a chi squared has less than this probability."""

POSITIVE = 2.0
"""The difference in BIC that is called positive evidence (Kass and Raftery 1995)."""

DECISIVE = 6.0
"""The difference in BIC that is called strong evidence (Kass and Raftery 1995)."""

NEAR = 10.0
"""A model whose BIC is so far above the smallest one is very much worse (Kass and Raftery 1995)."""

_PLAIN = 0.82  # Table I's 0.78 for B1, and two of its errors


class Claim(NamedTuple):
    """A claim, and the names of the choices with which it holds and fails."""

    text: str
    holds: list[str]
    fails: list[str]

    @property
    def survives(self) -> bool:
        """Whether it holds with every choice."""
        return not self.fails


def check_claims(fits: ChoiceFits) -> list[Claim]:
    """Return all claims, each checked with every choice."""
    found = []
    for text, is_true in _CLAIMS.items():
        true = {choice: is_true(fits, choice) for choice in fits.columns}
        holds = [choice for choice, holds_there in true.items() if holds_there]
        found.append(Claim(text, holds, [choice for choice in true if choice not in holds]))
    return found


def state_headline(fits: ChoiceFits, claims: list[Claim]) -> str:
    """Return the conclusion that holds with every choice, in a few sentences.

    Gravity acts, whatever the paper assumes: choices with it and without it are counted apart.
    """
    falling = [choice.name for choice in CHOICES if choice.gravity and choice.name in fits.leaders]
    others = [name for name in fits.leaders if name not in falling]
    if len(set(fits.leaders.values())) == 1:
        leader = next(iter(fits.leaders.values()))
        first = f"Model “{leader}” has the smallest BIC with every choice of the analysis."
    else:
        first = "Which model describes Table II is undecided."
        counted = {"With gravity, which is a fact,": falling, "Without gravity": others}
        for what, names in counted.items():
            if names:
                often = Counter(fits.leaders[name] for name in names).most_common()
                named = ", ".join(f"“{model}” with {count}" for model, count in often)
                first += f" {what} the smallest BIC belongs to {named} of {len(names)} choices."
    kept = [claim.text for claim in claims if claim.survives]
    if not kept:
        return f"{first} No claim holds with every choice."
    headline = f"{first} With every choice, and among these models: {'; '.join(kept)}."
    more = [claim.text for claim in claims if claim.fails and not set(claim.fails) & set(falling)]
    return f"{headline} With gravity also: {'; '.join(more)}." if falling and more else headline


def _excluded(*names: str) -> Callable[[ChoiceFits, str], bool]:
    """Return a function of whether all these models are excluded with a choice."""
    return lambda fits, choice: all(
        fits.cells[name][choice].score.probability < EXCLUDED for name in names
    )


def _column(fits: ChoiceFits, choice: str) -> dict[str, Cell]:
    return {name: row[choice] for name, row in fits.cells.items()}


def _none_fits(fits: ChoiceFits, choice: str) -> bool:
    return all(cell.score.probability < FITS for cell in _column(fits, choice).values())


def _decided(fits: ChoiceFits, choice: str) -> bool:
    return sorted(cell.behind for cell in _column(fits, choice).values())[1] > DECISIVE


def _leads(*names: str) -> Callable[[ChoiceFits, str], bool]:
    """Return a function of whether one of these models has the smallest BIC."""
    return lambda fits, choice: fits.leaders[choice] in names


def _behind(limit: float, *names: str) -> Callable[[ChoiceFits, str], bool]:
    """Return a function of whether the BIC of all these models is too large."""
    return lambda fits, choice: all(fits.cells[name][choice].behind > limit for name in names)


def _beats(better: str, worse: str) -> Callable[[ChoiceFits, str], bool]:
    """Return a function of whether a model has a smaller BIC than another."""
    return lambda fits, choice: fits.cells[better][choice].behind < fits.cells[worse][choice].behind


def _bounces(fits: ChoiceFits, choice: str) -> bool:
    """Return whether B1 alone has a restitution above 0.82 in every model near the smallest BIC."""
    near = [name for name, cell in _column(fits, choice).items() if cell.behind <= NEAR]
    fall = np.array([inputs.HEIGHT])
    return all(predict_restitutions(fits.columns[choice], name, fall)[0] > _PLAIN for name in near)


_CLAIMS: dict[str, Callable[[ChoiceFits, str], bool]] = {
    "elastic balls are excluded": _excluded("Hertz"),
    "a loss at the floor only is behind another model by more than 2 in BIC": _behind(
        POSITIVE, *FLOOR_ONLY
    ),
    "a loss at the floor only is behind another model by more than 10 in BIC": _behind(
        NEAR, *FLOOR_ONLY
    ),
    "B1's restitution is above 0.82 in every model within 10 of the smallest BIC": _bounces,
    "separate collisions are excluded": _excluded(*NAMES),
    "a loss at the floor only is excluded": _excluded(*FLOOR_ONLY),
    "no model gives all values": _none_fits,
    "S has a smaller BIC than B": _beats("S", "B"),
    "a hysteresis in every contact has the smallest BIC": _leads("H", "H, fitted", "H, linear"),
    "one model's BIC is smaller than that of all others by more than 6": _decided,
}
