"""How long the engine for two springs takes on the random drops of `random_drops`.

Run `python -m benchmarks.two_springs`.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter
from typing import Any

import numpy as np
from rich.console import Console

from benchmarks.random_drops import random
from stackbounce.engine import codes, native
from stackbounce.engine.memory import lane_workspace
from stackbounce.engine.records import Drops
from stackbounce.engine.tables import Table
from stackbounce.run.batch import new_outcomes

_LIMIT = 10**6


def job(count: int, seed: int = 1) -> tuple[Callable[[], None], Any]:
    """Return what solves random drops when it is called, and where their statuses will be."""
    drawn, table = random(count, seed), (count, 2)
    drops = Drops(
        mass=np.ascontiguousarray(drawn.masses),
        form=np.full(table, codes.POWER),
        first=np.ascontiguousarray(drawn.stiffnesses),
        second=np.ones(table),
        third=np.zeros(table),
        fourth=np.zeros(table),
        gap=np.column_stack([np.zeros(count), drawn.gaps]),
        velocity=np.full(table, -1.0),
        gravity=np.zeros(count),
    )
    out = new_outcomes(count, 2)
    solve = native.compiled("run_two_springs")
    given = Table(drops), _LIMIT, Table(out)

    def call() -> None:
        solve(*given, lane_workspace(compiled=True))  # that of the thread which calls

    return call, out.status


def time_per_drop(threads: int, count: int = 40_000, rounds: int = 30) -> float:
    """Return the shortest time in s a drop, of some rounds of so many drops in each thread."""
    calls = [job(count, seed)[0] for seed in range(1, threads + 1)]
    calls[0]()
    best = float("inf")
    with ThreadPoolExecutor(threads) as pool:
        for _ in range(rounds):
            start = perf_counter()
            for done in [pool.submit(call) for call in calls]:
                done.result()
            best = min(best, perf_counter() - start)
    return best / (threads * count)


def main() -> None:
    """Measure and print."""
    console = Console(highlight=False)
    call, status = job(1_000_000)
    call()
    left = int((status == codes.ASK).sum())
    for threads in (1, 2):
        time = 1e6 * time_per_drop(threads)
        console.print(f"{time:.3f} µs a drop on {threads} thread{'s' if threads > 1 else ''}")
    console.print(f"{left} of {len(status)} drops are left to the general engine")


if __name__ == "__main__":
    main()
