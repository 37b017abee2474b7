"""Counting how often error bars cover the truth."""

from collections.abc import Callable
from typing import Any

__all__ = ["covered"]


def covered(trial: Callable[[int], list[tuple[str, Any, float]]], seeds: int) -> float:
    """Return the fraction of estimates whose truth lies within one standard deviation."""
    hits = [
        abs(estimate.nominal_value - truth) <= estimate.std_dev
        for seed in range(seeds)
        for _, estimate, truth in trial(seed)
    ]
    return sum(hits) / len(hits)
