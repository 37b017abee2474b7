"""Theories: models of all pairs of Table II, from a few numbers of the balls."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce import Drop, Rigid
from stackbounce.cross2007.drops import fallen_speed
from stackbounce.fitting import FitProblem, Model, Range
from studies.table2 import inputs
from studies.table2.single_ball import (
    RELAXATION,
    Numbers,
    calibrate_numbers,
    loss_unit,
)

Array: TypeAlias = NDArray[np.float64]

ELASTIC, SHARED, OWN = "elastic", "shared", "own"
"""The loss between two balls: none; that of each ball on the floor; a number of its own."""

_BOUNDS = {
    "e": (0.7, 1.0),
    "e_B1": (0.7, 0.99),
    "e_B2": (0.7, 0.99),
    "e_B3": (0.7, 0.99),
    "e_between": (0.7, 0.99),
    "loss": (0.1, 1.2),
    "between": (0.0, 4.0),
    "stiffer": (0.4, 3.0),
    "exponent": (1.0, 2.0),
    "relaxation": RELAXATION,
    "longer_B1": (-5e-4, 5e-4),
    "longer_B2": (-5e-4, 5e-4),
    "longer_B3": (-5e-4, 5e-4),
    "height": (0.16, 0.24),
}
_WIDEST = 0.03  # m: of the gaps that are searched
_GAP = 4e-3  # m: where a search begins
_SPEED = fallen_speed(inputs.HEIGHT)  # m/s: of a ball alone, at which Table I has its numbers
_RELAXES = "relaxation_time"


@dataclass(frozen=True)
class Theory:
    """A model of all pairs of superballs, with numbers that they share.

    Parameters
    ----------
    title : str
        One line for people.
    law : type
        Of every contact: `HuntCrossley`, `Viscoelastic`, `Hysteretic` or `StandardLinearSolid`.
    where : str
        The loss between two balls: `ELASTIC`, `SHARED`, or `OWN` (`Hysteretic` only).
    known : mapping of str to float
        Fixed values of the names below.
    vary : tuple of str
        The fitted numbers: ``e_B1``, the restitution of B1 alone on the floor, ``e_B2`` and
        ``e_B3`` (by default that of B2); ``e_between``, that of two balls; ``loss``, a factor on
        all losses; ``between``, a factor on the loss between two balls; ``stiffer``, a factor on
        the stiffness between them; ``exponent``; ``relaxation``, the relaxation time of a
        `StandardLinearSolid` over the contact time of each ball, by default that of `calibrate`.
    exponent : float
        Of the law.
    heavy, height : float
        B1's mass in kg, and the drop height of the pairs in m; single balls fall from 20 cm.
    longer : mapping of str to float
        Time in s that is added to the contact time of a ball, by its name.
    priors : mapping of str to (float, float)
        Numbers that are known with an error, and fitted with it: restitutions as above;
        ``longer_B1``, ``longer_B2`` and ``longer_B3``, times in s that are added to contact times;
        ``height``, the drop height of the pairs in m.
    gravity : float
        In m/s**2, during the impact.

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley
    >>> theory = Theory("nothing fitted", HuntCrossley, SHARED, {"e_B1": 0.88, "e_B2": 0.95})
    >>> floor, between = theory.drop("B2_on_B1").contacts
    >>> round(floor.stiffness / between.stiffness, 2)
    3.15
    """

    title: str
    law: Any
    where: str
    known: Mapping[str, float] = field(default_factory=dict)
    vary: tuple[str, ...] = ()
    exponent: float = 1.5
    heavy: float = inputs.HEAVY
    height: float = inputs.HEIGHT
    longer: Mapping[str, float] = field(default_factory=dict)
    priors: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    gravity: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """The numbers that a fit varies, besides the gaps."""
        return *self.vary, *self.priors

    @property
    def usual(self) -> dict[str, Any]:
        """The numbers that are neither known nor varied."""
        usual = {"e_B1": 1.0, "e_B2": 1.0, "loss": 1.0, "between": 1.0, "stiffer": 1.0}
        usual |= {f"longer_{ball}": 0.0 for ball in inputs.PRINTED}
        return {**usual, "relaxation": None, "exponent": self.exponent}

    def model(self, pairs: tuple[str, ...] = tuple(inputs.PAIRS)) -> FitProblem:
        """Return the model for `stackbounce.fitting`: drops, varied numbers and ties."""
        vary: dict[str, Any] = {name: _BOUNDS[name] for name in self.vary}
        vary |= _known_with_errors(self.priors)
        vary |= {f"{key}.gaps.0": (0.0, _WIDEST) for key in pairs}
        middle = {name: 0.5 * sum(_BOUNDS[name]) for name in self.names}
        drops = {key: self.drop(key, _GAP, middle) for key in pairs}
        return Model(drops, vary, self._ties(pairs) if self.names else None)

    def drop(self, key: str, gap: float = 0.0, varied: Mapping[str, float] | None = None) -> Drop:
        """Return one pair with a gap in m and values of the varied numbers."""
        values = self._values(varied or {})
        contacts = [self._law(values, contact) for contact in self.contacts(values)[key]]
        balls = inputs.make_balls(key, self.heavy)
        return Drop(balls, contacts, gaps=[gap], height=self.height, gravity=self.gravity)

    def contacts(self, values: Mapping[str, Any]) -> dict[str, tuple[Numbers, Numbers]]:
        """Return the numbers of each pair's contacts: the floor's, and that of the balls."""
        alone = {ball: self.alone(ball, values) for ball in inputs.PRINTED}
        return {
            key: (alone[lower], self.between(alone[lower], alone[upper], values))
            for key, (lower, upper) in inputs.PAIRS.items()
        }

    def alone(self, ball: str, values: Mapping[str, Any]) -> Numbers:
        """Return the numbers of a ball's contact with the floor."""
        mass, time = inputs.read_solo(ball, self.heavy)
        longer = self.longer.get(ball, 0.0) + values[f"longer_{ball}"]
        own = inputs.Solo(mass, time + longer)
        p = values["exponent"]
        slow = values["relaxation"]
        found = calibrate_numbers(self.law, own, _SPEED, values[f"e_{ball}"], p, slow)
        if loss_unit(self.law) == "s/m":
            found = found._replace(loss=found.loss * values["loss"])
        return found

    def between(self, lower: Numbers, upper: Numbers, values: Mapping[str, Any]) -> Numbers:
        """Return the numbers of the contact of two balls, from those of each with the floor.

        The two are in series: at equal force the compressions add, so that ``k**(-1/p)`` adds. The
        lower ball has the share f of the compression and of the work.

        A solid that relaxes is softer when it is slow: of its slow compression the share
        ``Δ/(1 + Δ)`` creeps, with the time ``(1 + Δ) τ`` at a constant force. In series the
        creeping compressions add as well. Two that creep with different times become one with the
        geometric mean of both times, weighted by what creeps. Compared with both in series, the
        restitution of two balls here is wrong by less than 0.01 with the relaxation times of
        `calibrate`, and by less than 0.02 with others.
        """
        p = values["exponent"]
        soft = lower.stiffness ** (-1.0 / p), upper.stiffness ** (-1.0 / p)
        f = soft[0] / (soft[0] + soft[1])
        stiffness = values["stiffer"] * (soft[0] + soft[1]) ** -p
        loss = self._lost(f, lower.loss, upper.loss, values)
        if self.law.fourth_number != _RELAXES:
            return Numbers(stiffness, loss, np.zeros_like(f))
        return Numbers(stiffness, loss, _creep_time(f, lower, upper) / (1.0 + loss))

    def _lost(self, f: Array, lower: Array, upper: Array, values: Mapping[str, Any]) -> Array:
        """Return the loss between two balls; the lower one has the share f of the compression."""
        if self.where == OWN:
            return np.asarray(values["e_between"])
        if self.law.loss == "restitution":  # shares of the energy, as `series.between`
            elastic = self.where == ELASTIC
            return np.ones_like(f) if elastic else np.sqrt(f * lower**2 + (1.0 - f) * upper**2)
        if self.where == ELASTIC:
            return np.zeros_like(f)
        if self.law.fourth_number == _RELAXES:
            stays = f / (1.0 + lower) + (1.0 - f) / (1.0 + upper)
            return np.asarray(values["between"] * (1.0 / stays - 1.0))
        # A ball has its share of the work; a loss proportional to the compression rate also counts
        # its share of the rate.
        power = 2 if loss_unit(self.law) == "s/m" else 1
        share = f**power * lower + (1.0 - f) ** power * upper
        return np.asarray(values["between"] * share)

    def _law(self, values: Mapping[str, Any], own: Numbers) -> Any:
        options: dict[str, Any] = {
            "stiffness": float(own.stiffness),
            self.law.loss: float(own.loss),
        }
        if self.law.fixed_exponent() is None:
            options["exponent"] = float(values["exponent"])
        if self.law.fourth_number == _RELAXES:
            options[_RELAXES] = float(own.relaxation)
        return self.law(**options)

    def _values(self, varied: Mapping[str, Any]) -> dict[str, Any]:
        """Return all numbers by name."""
        found = {**self.usual, **self.known, **{name: varied[name] for name in self.names}}
        return {"e_B3": found["e_B2"], **found}

    def _ties(self, pairs: tuple[str, ...]) -> dict[str, Any]:
        """Return the ties of all contacts; those of the latest trials are cached."""
        kept: dict[bytes, dict[str, tuple[Numbers, Numbers]]] = {}

        def contacts(varied: Mapping[str, Array]) -> dict[str, tuple[Numbers, Numbers]]:
            own = b"".join(np.ascontiguousarray(varied[name]).tobytes() for name in self.names)
            if own not in kept:
                kept.clear()
                kept[own] = self.contacts(self._values(varied))
            return kept[own]

        def tie(key: str, i: int, name: str) -> Any:
            return lambda varied: getattr(contacts(varied)[key][i], name)

        paths = {"stiffness": "stiffness", "loss": self.law.loss}
        if self.law.fourth_number == _RELAXES:
            paths["relaxation"] = _RELAXES
        ties: dict[str, Any] = {}
        for key in pairs:
            for i in (0, 1):
                for name, path in paths.items():
                    ties[f"{key}.contacts.{i}.{path}"] = tie(key, i, name)
                if "exponent" in self.vary:
                    ties[f"{key}.contacts.{i}.exponent"] = "exponent"
        return ties


def make_rigid_model(
    *names: str,
    pairs: tuple[str, ...] = tuple(inputs.PAIRS),
    priors: Mapping[str, tuple[float, float]] | None = None,
    gravity: float = 0.0,
) -> FitProblem:
    """Return separate collisions: with one restitution, ``e``, or ``e_floor`` and ``e_between``.

    Of `priors`, as those of a `Theory`, only the drop height matters.
    """
    drops = {
        key: Drop(
            inputs.make_balls(key),
            [Rigid(0.9), Rigid(0.9)],
            gaps=[_GAP],
            height=inputs.HEIGHT,
            gravity=gravity,
        )
        for key in pairs
    }
    vary: dict[str, Any] = dict.fromkeys(names, _BOUNDS["e"])
    vary |= _known_with_errors(
        {name: prior for name, prior in (priors or {}).items() if name == "height"}
    )
    vary |= {f"{key}.gaps.0": (0.0, _WIDEST) for key in drops}
    ends = {"contacts.0.restitution": names[0], "contacts.1.restitution": names[-1]}
    return Model(drops, vary, ends)


def _creep_time(f: Array, lower: Numbers, upper: Numbers) -> Array:
    """Return the creep time ``(1 + Δ) τ`` of two solids; the lower one has the share f."""
    creeps = f * lower.loss / (1.0 + lower.loss), (1.0 - f) * upper.loss / (1.0 + upper.loss)
    times = [(1.0 + ball.loss) * ball.relaxation for ball in (lower, upper)]
    whole = creeps[0] + creeps[1]
    share = np.where(whole > 0.0, creeps[0] / np.where(whole > 0.0, whole, 1.0), f)
    return np.asarray(times[0] ** share * times[1] ** (1.0 - share))


def _known_with_errors(priors: Mapping[str, tuple[float, float]]) -> dict[str, Range]:
    """Return the ranges of numbers that are fitted with what is known of them."""
    return {name: Range(*_BOUNDS[name], prior=prior) for name, prior in priors.items()}
