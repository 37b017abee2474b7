"""How long a drop of two balls on springs takes in a sweep: `python -m benchmarks.two_springs`.

Random drops with mass ratios from 0.05 to 50 and stiffness ratios from 0.02 to 50, logarithms
uniform; half of them without a gap, half with gaps up to 2 v0/omega.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from time import perf_counter
from typing import Any

import numpy as np
from rich.console import Console

from stackbounce.engine import codes
from stackbounce.engine.kernel import compiled
from stackbounce.engine.two_springs import SCRATCH, two_springs

_LIMIT = 10**6


def draw(count: int, seed: int = 1) -> tuple[Any, Any, Any, Any]:
    """Return masses, stiffnesses, gaps and speeds of random drops, in SI units."""
    random = np.random.default_rng(seed)

    def log_uniform(low: float, high: float) -> Any:
        return low * (high / low) ** random.random(count)

    lower, floor, speed = log_uniform(0.01, 1.0), log_uniform(1e3, 1e5), log_uniform(0.1, 10.0)
    mass = np.stack([lower, lower / log_uniform(0.05, 50.0)], axis=1)
    stiffness = np.stack([floor, floor / log_uniform(0.02, 50.0)], axis=1)
    reach = 2.0 * random.random(count) * (random.random(count) < 0.5)
    return mass, stiffness, reach * speed * np.sqrt(lower / floor), speed


def job(count: int, seed: int = 1) -> tuple[Callable[[], None], Any]:
    """Return what solves random drops when it is called, and where their statuses will be."""
    drops = draw(count, seed)
    pairs = [np.empty((count, 2)) for _ in range(3)]
    collisions, status = np.empty((count, 2), np.int64), np.empty(count, np.int64)
    out = pairs[0], collisions, *pairs[1:], np.empty(count), status
    scratch = np.zeros(SCRATCH)
    solve = compiled(two_springs)

    def call() -> None:
        solve(*drops, _LIMIT, *out, scratch)

    return call, status


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
