"""Trials to shares: how often the truth lay within the error."""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

__all__ = ["Share", "Trial", "covered", "shares"]

Trial: TypeAlias = Callable[[int], list[tuple[str, Any, float]]]
"""From a seed to quantities, each with its estimate and the truth."""


class Share(NamedTuple):
    """How one quantity came out over many trials."""

    within_one: float
    within_two: float
    bias: float
    error: float

    def words(self) -> tuple[str, str, str, str]:
        """Return the numbers as a table shows them."""
        return (
            f"{self.within_one:.1%}",
            f"{self.within_two:.1%}",
            f"{self.bias:+.2f}",
            f"{self.error:.2g}",
        )


def covered(trial: Trial, seeds: Iterable[int]) -> float:
    """Return the share of truths within the error, of all quantities of a trial together."""
    hits = [
        abs(estimate.nominal_value - truth) <= estimate.std_dev
        for seed in seeds
        for _, estimate, truth in trial(seed)
    ]
    return sum(hits) / len(hits)


def shares(trial: Trial, seeds: Iterable[int]) -> dict[str, Share]:
    """Return for each quantity of a trial how often the truth lay within one error, and two.

    Parameters
    ----------
    trial : callable
        Seed to (quantity, estimate with error, truth), any number of them.
    seeds : iterable of int
        One trial for each.

    Returns
    -------
    dict of str to Share
    """
    off: dict[str, list[tuple[float, float]]] = {}
    for seed in seeds:
        for quantity, estimate, truth in trial(seed):
            one = ((estimate.nominal_value - truth) / estimate.std_dev, estimate.std_dev)
            off.setdefault(quantity, []).append(one)
    table = {name: np.array(pairs) for name, pairs in off.items()}
    return {
        name: Share(
            float(np.mean(np.abs(pairs[:, 0]) <= 1.0)),
            float(np.mean(np.abs(pairs[:, 0]) <= 2.0)),
            float(np.median(pairs[:, 0])),
            float(np.median(pairs[:, 1])),
        )
        for name, pairs in table.items()
    }
