"""Posterior probabilities of the models, with the readings of the paper as nuisance.

The priors are those of `bounce_likelihood`.
"""

import functools
import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from studies.table2 import inputs
from studies.table2.bounce_likelihood import (
    CHOICES,
    MODELS,
    SCATTER,
    Draws,
    Priors,
    Size,
    draw_numbers,
    find_spans,
    likelihoods,
    tabulate,
    weigh_draws,
)
from studies.table2.evidence import Evidence, average_sets, draw_normal, sum_logs
from studies.table2.ratio_tables import SEPARATE, run_pair
from studies.table2.readings import READINGS
from studies.table2.scatter import scatter_bounces

__all__ = [
    "CERTAIN",
    "GROUPS",
    "PRIORS",
    "Case",
    "Hierarchy",
    "Likelihoods",
    "TableError",
    "check_tables",
    "compute_likelihoods",
    "describe_undecided",
    "weigh_models",
]

Array: TypeAlias = NDArray[np.float64]

CERTAIN = 0.95
"""Above this probability a model counts as decided."""

PRIORS: dict[str, Priors] = {
    "as stated": Priors(),
    "extra error: half-normal, 0.01": Priors(extra=0.01),
    "extra error: half-normal, 0.05": Priors(extra=0.05),
    "extra error: log-uniform, 0.002 to 0.3": Priors(extra=np.inf),
    "delays scatter by 0.1 or 0.3 ms": Priors(scatter=(0.5, 0.5, 0.0, 0.0, 0.0)),
    "delays scatter by 1 or 2 ms": Priors(scatter=(0.0, 0.0, 0.0, 0.5, 0.5)),
    "drop height ± 0.4 cm": Priors(speed=0.01),
    "stiffness of two balls ± 5 %": Priors(stiffness=0.05),
}
"""The priors as stated, and others for the sensitivity."""

GROUPS: dict[str, dict[str, tuple[str, ...]]] = {
    "law": {
        "separate collisions": (SEPARATE,),
        "Hunt and Crossley": ("A", "S"),
        "viscoelastic": ("V",),
        "hysteresis": ("P", "H", "H, linear", "B"),
    },
    "where energy is lost": {
        "floor only": ("A", "P"),
        "every contact, by material": ("S", "V", "H", "H, linear"),
        "every contact, balls by a number of their own": (SEPARATE, "B"),
    },
}
"""Questions, and the models that answer each in the same way."""

_SEED = 2007
_CHECKED = 6  # drops, of each table
_SMOOTH = 0.3e-3  # s


class TableError(NamedTuple):
    """Errors of mean ratios from the tables, over pairs: root of the mean square, and largest."""

    rms: float
    largest: float


class Case(NamedTuple):
    """One combination of choices: its probability, and those of the models in it."""

    choices: dict[str, str]
    probability: float
    models: dict[str, float]

    @property
    def leader(self) -> str:
        """The most probable model."""
        return max(self.models, key=self.models.__getitem__)


class Likelihoods(NamedTuple):
    """The likelihoods of all models.

    `logs` has their logarithms by model, as `bounce_likelihood.likelihoods` returns them; `draws`
    has the draws (sets × draws,) by reading.
    """

    logs: dict[str, Array]
    draws: dict[str, Draws]


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """The posterior probabilities.

    Parameters
    ----------
    found : Likelihoods
        Of all models.
    tables : mapping of str to TableError
        The interpolation errors by model, if they were computed.
    """

    found: Likelihoods
    tables: Mapping[str, TableError]

    @functools.cached_property
    def evidence(self) -> dict[str, Evidence]:
        """The marginal likelihood of each model, averaged over all choices."""
        return {name: average_sets(self._averaged(name, Priors())) for name in self.found.logs}

    def _averaged(self, name: str, priors: Priors) -> Array:
        """Return the logarithms (sets, draws) of the likelihood, averaged over all choices."""
        whole = self._weighed(name, priors)
        cases = int(np.prod(whole.shape[:-2]))
        every = np.moveaxis(whole.reshape(cases, *whole.shape[-2:]), 0, -1)
        return np.asarray(sum_logs(every) - np.log(cases))

    def _weighed(self, name: str, priors: Priors) -> Array:
        """Return logarithms (readings, delays, rows, sets, draws), over the scatter."""
        logs = self.found.logs[name]
        with np.errstate(divide="ignore"):
            shares = np.log(np.array(priors.scatter))
        whole = sum_logs(np.moveaxis(logs + shares[:, None, None], 3, -1))
        ratios = [weigh_draws(one, priors) for one in self.found.draws.values()]
        return whole + np.reshape(ratios, (len(ratios), 1, 1, *logs.shape[-2:]))

    def _masses(self, priors: Priors) -> Array:
        """Return posterior shares (models, readings, delays, rows, sets)."""
        logs = np.array([self._weighed(name, priors) for name in self.found.logs])
        found = np.exp(logs - logs.max()).mean(axis=-1)
        return np.asarray(found / found.sum(axis=(0, 1, 2, 3)).mean())

    @functools.cached_property
    def _shares(self) -> Array:
        return np.asarray(self._masses(Priors()).mean(axis=-1))

    def _named(self, shares: Array) -> dict[str, float]:
        """Return probabilities of the models by name, from numbers that are proportional."""
        return dict(zip(self.found.logs, (shares / shares.sum()).tolist(), strict=True))

    @functools.cached_property
    def probabilities(self) -> dict[str, float]:
        """The probability of each model, averaged over all choices."""
        return self._named(self._shares.sum(axis=(1, 2, 3)))

    @functools.cached_property
    def errors(self) -> dict[str, float]:
        """The numerical error of each probability, from the independent sets of draws."""
        own = self._masses(Priors()).sum(axis=(1, 2, 3))  # (models, sets)
        own = own / own.sum(axis=0)
        spread = own.std(axis=1, ddof=1) / np.sqrt(own.shape[1])
        return dict(zip(self.found.logs, spread.tolist(), strict=True))

    @functools.cached_property
    def choices(self) -> dict[str, dict[str, float]]:
        """The posterior probability of each value of each choice."""
        found = {}
        for k, (choice, values) in enumerate(CHOICES.items()):
            others = tuple(axis for axis in range(4) if axis != k + 1)
            own = self._shares.sum(axis=others) / self._shares.sum()
            found[choice] = dict(zip(values, own.tolist(), strict=True))
        return found

    @functools.cached_property
    def by_choice(self) -> dict[str, dict[str, dict[str, float]]]:
        """The probabilities of the models for each value of each choice."""
        found = {}
        for k, (choice, values) in enumerate(CHOICES.items()):
            others = tuple(axis for axis in range(1, 4) if axis != k + 1)
            own = self._shares.sum(axis=others)
            found[choice] = {value: self._named(own[:, i]) for i, value in enumerate(values)}
        return found

    @functools.cached_property
    def cases(self) -> list[Case]:
        """All combinations of choices, the most probable first."""
        flat = self._shares.reshape(len(self.found.logs), -1)
        whole, found = self._shares.sum(), []
        for number, index in enumerate(itertools.product(*map(range, self._shares.shape[1:]))):
            names = {
                choice: values[i]
                for i, (choice, values) in zip(index, CHOICES.items(), strict=True)
            }
            own = flat[:, number]
            found.append(Case(names, float(own.sum() / whole), self._named(own)))
        return sorted(found, key=lambda one: -one.probability)

    @functools.cached_property
    def by_prior(self) -> dict[str, dict[str, float]]:
        """The probabilities of the models for each of `PRIORS`."""
        return {
            what: self._named(self._masses(priors).sum(axis=(1, 2, 3, 4)))
            for what, priors in PRIORS.items()
        }

    @property
    def groups(self) -> dict[str, dict[str, float]]:
        """The probability of each answer of `GROUPS`: the sum over its models."""
        return {
            question: {
                answer: sum(self.probabilities[name] for name in names)
                for answer, names in answers.items()
            }
            for question, answers in GROUPS.items()
        }

    @functools.cached_property
    def numbers(self) -> dict[str, dict[str, tuple[float, float]]]:
        """Mean and standard deviation of each model's numbers, averaged over all choices.

        Restitutions at 20 cm, ``stiffer`` (a factor), ``e_between`` where the model has it,
        ``speed`` (relative error), ``extra`` (of a ratio) and ``scatter`` (of delays, in s).
        """
        return {name: self._numbers(name) for name in self.found.logs}

    def _numbers(self, name: str) -> dict[str, tuple[float, float]]:
        shares = self.shares(name)
        draws = self.found.draws.values()
        columns = {key: np.array([one.values[key] for one in draws]) for key in _RESTITUTIONS}
        if name != SEPARATE:
            columns["stiffer"] = np.exp([one.values["log_stiffer"] for one in draws])
        if name in GROUPS["where energy is lost"][_OWN]:
            columns["e_between"] = np.array([one.values["e_between"] for one in draws])
        columns["speed"] = np.array([one.speed for one in draws])
        columns["extra"] = np.array([one.extra for one in draws])
        found = {key: _moments(values, shares) for key, values in columns.items()}
        logs = np.moveaxis(self.found.logs[name], 3, 0)
        ratios = np.array([weigh_draws(one, Priors()) for one in draws])
        logs = logs + ratios.reshape(len(ratios), 1, 1, *logs.shape[-2:])
        own = np.exp(logs - logs.max()).reshape(len(SCATTER), -1).sum(axis=1)
        return {**found, "scatter": _moments(SCATTER, own / own.sum())}

    def shares(self, name: str) -> Array:
        """Return the posterior shares (readings, n) of a model's draws; their sum is 1."""
        logs = self._weighed(name, Priors())
        found = np.exp(logs - logs.max()).sum(axis=(1, 2)).reshape(len(logs), -1)
        return np.asarray(found / found.sum())

    @property
    def undecided(self) -> str:
        """What remains undecided, in a sentence."""
        return describe_undecided(self.probabilities, [one.models for one in self.cases])

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers as plain values, for JSON."""
        return {
            "probabilities": self.probabilities,
            "errors": self.errors,
            "evidence": {name: one._asdict() for name, one in self.evidence.items()},
            "groups": self.groups,
            "choices": self.choices,
            "by_choice": self.by_choice,
            "cases": [{**one._asdict(), "leader": one.leader} for one in self.cases],
            "by_prior": self.by_prior,
            "numbers": self.numbers,
            "tables": {name: one._asdict() for name, one in self.tables.items()},
            "undecided": self.undecided,
        }


_RESTITUTIONS = ("e_B1", "e_B2", "e_B3")
_OWN = "every contact, balls by a number of their own"


def _moments(values: Array, shares: Array) -> tuple[float, float]:
    mean = float(np.sum(shares * values))
    return mean, float(np.sqrt(np.sum(shares * (values - mean) ** 2)))


def describe_undecided(whole: Mapping[str, float], cases: list[dict[str, float]]) -> str:
    """Return what remains undecided, from probabilities over all choices and in each case.

    Examples
    --------
    >>> describe_undecided({"S": 0.6, "H": 0.4}, [{"S": 0.97, "H": 0.03}, {"S": 0.2, "H": 0.8}])
    'Which model is right remains undecided: over all choices S has the probability 0.60, and H has
    0.40. In 1 of 2 combinations of choices a model (S) exceeds 0.95.'
    """
    (first, p), (second, q), *_ = sorted(whole.items(), key=lambda one: -one[1])
    if p > CERTAIN:
        said = f"{first} is decided: over all choices it has the probability {p:.3f}."
    else:
        said = (
            f"Which model is right remains undecided: over all choices {first} has the "
            f"probability {p:.2f}, and {second} has {q:.2f}."
        )
    sure = [name for one in cases for name, value in one.items() if value > CERTAIN]
    names = "; ".join(dict.fromkeys(sure))
    count = f"In {len(sure) or 'none'} of {len(cases)} combinations of choices"
    does = f"a model ({names}) exceeds" if sure else "does a model exceed"
    return f"{said} {count} {does} {CERTAIN}."


def compute_likelihoods(
    size: Size, progress: Callable[[str], None] = lambda _: None, seed: int = _SEED
) -> Likelihoods:
    """Return the likelihoods of all models; see `bounce_likelihood`."""
    normal = draw_normal(7, size.sets, size.each, seed)
    return Likelihoods(
        {name: likelihoods(name, size, seed, progress) for name in MODELS},
        {reading: draw_numbers(normal, reading) for reading in READINGS},
    )


def check_tables(name: str, size: Size) -> TableError:
    """Compare mean ratios from the tables of a model with those of drops at drawn numbers.

    Without gravity, for Table I's ratios of heights; delays of 1 to 4 ms that scatter by 0.3 ms.
    """
    reading = "ratios of heights"
    draws = draw_numbers(draw_normal(7, 1, 1024, _SEED), reading)
    values = {key: array[:_CHECKED] for key, array in draws.values.items()}
    off = []
    for pair in inputs.PAIRS:
        table = tabulate(name, pair, find_spans(reading), size)
        exact = run_pair(name, pair, values, table.delays)
        middles = np.clip(np.linspace(1e-3, 4e-3, 31), table.delays[0], table.delays[-1])
        means = scatter_bounces(table, middles, _SMOOTH, 0.0).parts[:, :2]
        direct = exact.reshape(_CHECKED, 1, *exact.shape[1:])
        for k in range(_CHECKED):
            own = table._replace(axes=(), nodes=(), ratios=direct[k])
            there = scatter_bounces(own, middles, _SMOOTH, 0.0).parts[0, :2]
            here = np.tensordot(
                table.weights({a: v[k : k + 1] for a, v in values.items()}), means, 1
            )
            off.append(here[0] - there)
    return TableError(float(np.sqrt(np.mean(np.square(off)))), float(np.max(np.abs(off))))


def weigh_models(
    progress: Callable[[str], None] = lambda _: None, size: Size | None = None
) -> Hierarchy:
    """Compute the posterior probabilities of the models.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each step.
    size : Size, optional
        How fine.
    """
    size = size or Size()
    found = compute_likelihoods(size, progress)
    progress("study: interpolation in the tables")
    return Hierarchy(found, {name: check_tables(name, size) for name in MODELS})
