"""Expected information: how much a measurement would say about the models, before it is made.

It is the mutual information of the model and the outcome: the entropy of the models' probabilities
now, less the mean of their entropy after the measurement. Outcomes are drawn from the posterior of
every model. The density of an outcome by a model is the mean of normal densities about the
predictions of other draws of this model. Separate collisions, which have no forces, are left out.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from studies.table2.bounce_likelihood import CHOICES
from studies.table2.hierarchy import Hierarchy
from studies.table2.measurements import MEASUREMENTS, Measurement, Outcome, Sample
from studies.table2.ratio_tables import SEPARATE

__all__ = [
    "Gain",
    "Information",
    "draw_samples",
    "expect_information",
    "measure_gain",
    "rank_measurements",
]

Array: TypeAlias = NDArray[np.float64]
Labels: TypeAlias = NDArray[np.int64]

_SEED = 1009
_EACH = 256  # draws of each model's posterior
_NOISES = 4  # outcomes of each draw
_LEAST = 1e-12  # of a density, over the largest


class Gain(NamedTuple):
    """The expected information of a measurement.

    `model` and `reading` are the bits about which model is right and about how Table I is to be
    read, means over the designs; `error` is the numerical error of `model`; `design` is the one
    that says most about the model, with `best` bits.
    """

    what: str
    precision: str
    cost: str
    model: float
    error: float
    reading: float
    design: str
    best: float


class Information(NamedTuple):
    """Entropies in bits of what is not known now, and the measurements, the best one first."""

    model: float
    reading: float
    gains: list[Gain]

    @property
    def in_minutes(self) -> Gain:
        """The best of the measurements that take minutes."""
        return next(one for one in self.gains if one.cost.startswith("minutes"))

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers as plain values, for JSON."""
        return {**self._asdict(), "gains": [one._asdict() for one in self.gains]}


def rank_measurements(
    found: Hierarchy, progress: Callable[[str], None] = lambda _: None, each: int = _EACH
) -> Information:
    """Rank the measurements by the expected information about the model.

    Parameters
    ----------
    found : Hierarchy
        The posterior.
    progress : callable, optional
        Receives a line of text for each measurement.
    each : int, optional
        How many draws of each model's posterior.
    """
    samples = draw_samples(found, each)
    shares = np.array([found.probabilities[one.name] for one in samples])
    shares = shares / shares.sum()
    rows = []
    for measurement in MEASUREMENTS:
        progress(f"study: expected information of {measurement.what}")
        rows.append(measure_gain(measurement, samples, shares))
    readings = np.array(list(found.choices[next(iter(CHOICES))].values()))
    return Information(
        _entropy(shares), _entropy(readings), sorted(rows, key=lambda one: -one.model)
    )


def _entropy(shares: Array) -> float:
    some = shares[shares > 0.0]
    return float(-np.sum(some * np.log2(some)))


def draw_samples(found: Hierarchy, each: int, seed: int = _SEED) -> list[Sample]:
    """Return equally probable draws of each model's posterior, without separate collisions."""
    random = np.random.default_rng(seed)
    draws = list(found.found.draws.values())
    samples = []
    for name in found.probabilities:
        shares = found.shares(name)
        places = (np.arange(each) + random.random()) / each
        picked = np.searchsorted(np.cumsum(shares.ravel()), places)
        picked = random.permutation(np.minimum(picked, shares.size - 1))
        reading, k = np.unravel_index(picked, shares.shape)
        normal = random.standard_normal((each, 5))
        if name == SEPARATE:
            continue
        values = {
            key: np.array([draws[i].values[key][j] for i, j in zip(reading, k, strict=True)])
            for key in draws[0].values
        }
        extra = np.array([draws[i].extra[j] for i, j in zip(reading, k, strict=True)])
        samples.append(Sample(name, values, extra, reading, normal))
    return samples


def measure_gain(measurement: Measurement, samples: Sequence[Sample], shares: Array) -> Gain:
    """Return the expected information of one measurement.

    Parameters
    ----------
    measurement : Measurement
    samples : sequence of Sample
        Draws of the models' posteriors, equally many of each.
    shares : ndarray
        (models,) probabilities of the models.
    """
    outcomes = [measurement.predict(one) for one in samples]
    each = len(samples[0].extra)
    model = np.repeat(np.arange(len(samples)), each)
    reading = np.concatenate([one.reading for one in samples])
    weights = np.repeat(shares / each, each)
    rows = []
    for k in range(len(measurement.designs)):
        own = Outcome(
            np.concatenate([one.values[k] for one in outcomes]),
            np.concatenate([one.errors[k] for one in outcomes]),
        )
        rows.append(expect_information(own, weights, (model, reading)))
    bits, errors = (np.array(rows)[..., k] for k in (0, 1))
    best = int(np.argmax(bits[:, 0]))
    return Gain(
        *measurement[:3],
        float(bits[:, 0].mean()),
        float(np.sqrt(np.sum(errors[:, 0] ** 2)) / len(errors)),
        float(bits[:, 1].mean()),
        measurement.designs[best],
        float(bits[best, 0]),
    )


def expect_information(
    outcome: Outcome, weights: Array, labels: Sequence[Labels], seed: int = _SEED
) -> list[tuple[float, float]]:
    """Return the mutual information of each label and an outcome in bits, and its error.

    One half of the draws gives the densities and the other the outcomes, so that no outcome lies
    in the middle of its own density; then the halves are exchanged. The error is that of the
    finite number of outcomes and half of the difference between both.

    Parameters
    ----------
    outcome : Outcome
        Predictions and errors (n, numbers) of the draws.
    weights : ndarray
        (n,) probabilities of the draws; their sum is 1.
    labels : sequence of ndarray
        (n,) each: what the draws have in common, such as the number of their model.
    seed : int, optional
        Of the errors of the outcomes.

    Examples
    --------
    Two answers of equal probability that lie a hundred errors apart are worth one bit:

    >>> label = np.repeat([0, 1], 64)
    >>> far = Outcome(1.0 * label[:, None], np.full((128, 1), 0.01))
    >>> expect_information(far, np.full(128, 1 / 128), [label])
    [(1.0, 0.0)]
    """
    random = np.random.default_rng(seed)
    halves = np.arange(len(weights)) % 2 == 0
    runs = [_half(outcome, weights, labels, known, random) for known in (halves, ~halves)]
    (first, one), (second, other) = runs
    apart = 0.5 * (first - second)
    spread = np.sqrt(0.25 * (one**2 + other**2) + apart**2)
    middle = 0.5 * (first + second)
    return [
        (round(float(b), 9) + 0.0, round(float(e), 9)) for b, e in zip(middle, spread, strict=True)
    ]


def _half(
    outcome: Outcome,
    weights: Array,
    labels: Sequence[Labels],
    known: NDArray[np.bool_],
    random: np.random.Generator,
) -> tuple[Array, Array]:
    """Return the information of each label, and its errors, with densities by the known draws."""
    middle, error = outcome.values[~known], outcome.errors[~known]
    noise = random.standard_normal((_NOISES, *middle.shape))
    seen = (middle + error * noise).reshape(-1, middle.shape[-1])
    share = np.tile(weights[~known], _NOISES)
    share = share / share.sum()
    densities = _densities(seen, outcome.values[known], outcome.errors[known])
    found = []
    for label in labels:
        member = (label[known][:, None] == np.unique(label)) * weights[known][:, None]
        sums = member.sum(axis=0)
        parts = densities @ (member / np.where(sums > 0.0, sums, 1.0))
        whole = densities @ weights[known] / weights[known].sum()
        own = np.searchsorted(np.unique(label), np.tile(label[~known], _NOISES))
        ratio = np.maximum(parts[np.arange(len(seen)), own], _LEAST) / np.maximum(whole, _LEAST)
        bits = np.log2(ratio)
        mean = float(share @ bits)
        found.append((mean, float(np.sqrt(share**2 @ (bits - mean) ** 2))))
    first, second = np.array(found).T
    return first, second


def _densities(seen: Array, middle: Array, error: Array) -> Array:
    """Return normal densities (outcomes, draws) of outcomes about draws, the largest of a row 1."""
    inverse = error**-2.0
    squares = seen**2 @ inverse.T - 2.0 * seen @ (middle * inverse).T
    squares += np.sum(middle**2 * inverse, axis=1) + 2.0 * np.sum(np.log(error), axis=1)
    return np.asarray(np.exp(-0.5 * (squares - squares.min(axis=1, keepdims=True))))
