"""Hard drops of two balls in sweeps: wrong numbers of contacts, and errors over the tolerance.

The drops are those of `batches.pairs` in tests: masses and stiffnesses over three decades each, all
laws and pairs of laws, losses from weak to strong, gaps from none to ten compressions, a fifth of
the drops under gravity. The truth is what the general engine finds drop by drop at `TRUTH`. Run
`PYTHONPATH=tests python -m benchmarks.hard_pairs`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from batches import numbers_of, pairs, swept, swept_in_lanes
from benchmarks.pairs import show
from stackbounce.engine import codes
from stackbounce.engine.memory import FINITE
from stackbounce.engine.records import Drops
from stackbounce.engine.work import EVENT_LIMIT
from stackbounce.run.options import Options

COUNT, GRAVITY, SEED = 100_000, 0.2, 31
TOLERANCES, TRUTH = (1e-3, 1e-4, 1e-6, 1e-9, 1e-12), 1e-13
WORK = 10**6  # of a drop: under gravity some swing on for long
HEADS = ["laws", "rtol", "drops", "asked", "unfinished", "wrong", "median", "99 %", "worst"]


@dataclass(frozen=True)
class Check:
    """What a sweep made of hard drops at one tolerance; nan: there is none.

    ``asked`` is the number of drops that the lanes left to the general engine, ``wrong`` that of
    drops with another number of contacts. The ``errors`` are those of the velocities over v0: the
    median, that which 1 % exceed, and the worst.
    """

    laws: str
    rtol: float
    drops: int
    asked: int
    unfinished: int
    wrong: int
    errors: tuple[float, float, float]


def measure(progress: Callable[[str], None], count: int = COUNT, seed: int = SEED) -> list[Check]:
    """Return what sweeps made of random hard drops; those on two linear contacts apart."""
    heavy = round(GRAVITY * count)
    checks = []
    for some, place in ((count - heavy, ""), (heavy, ", gravity")):
        drops = pairs(some, seed, gravity=bool(place))
        linear = np.isin(drops.form, codes.LINEAR_FORMS) & (drops.second == 1.0)
        linear = linear.all(axis=1)
        for laws, kernel, rows in (
            (f"one or both nonlinear{place}", "run_pairs", ~linear),
            (f"linear{place}", "run_linear", linear),
        ):
            progress(f"hard pairs: {laws}")
            checks += _checked(laws, kernel, numbers_of(drops, rows))
    return checks


def _checked(laws: str, kernel: str, drops: Drops) -> list[Check]:
    right = swept(FINITE, drops, (math.inf, TRUTH, EVENT_LIMIT, WORK))
    checks = []
    for rtol in TOLERANCES if kernel == "run_pairs" else (math.nan,):
        out, asked = swept_in_lanes(kernel, drops, Options(math.inf, rtol, EVENT_LIMIT, WORK))
        ended = (right.status == codes.FINISHED) & (out.status == codes.FINISHED)
        wrong = (out.collisions != right.collisions).any(axis=1)[ended]
        error = np.abs(out.rebound_ratio - right.rebound_ratio).max(axis=1)[ended]
        errors = tuple(map(float, np.quantile(error, [0.5, 0.99, 1.0])))
        count = len(ended)
        checks.append(
            Check(laws, rtol, count, asked, int(count - ended.sum()), int(wrong.sum()), errors)
        )
    return checks


def rows(checks: list[Check]) -> list[list[str]]:
    """Return the checks as rows of text."""
    return [
        [
            *(check.laws, "–" if math.isnan(check.rtol) else f"{check.rtol:g}"),
            *map(str, (check.drops, check.asked, check.unfinished, check.wrong)),
            *(f"{error:.1e}" for error in check.errors),
        ]
        for check in checks
    ]


if __name__ == "__main__":
    show(HEADS, lambda progress: rows(measure(progress)))
