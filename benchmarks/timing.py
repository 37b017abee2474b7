"""How long calls take, on a machine that may be busy with other things too.

Processor time of this thread, which is alone at work here; and in rounds over all calls, so that
a busy second does not fall on all tries of one of them.
"""

from collections.abc import Callable, Sequence
from time import thread_time
from typing import Any


def best(
    calls: Sequence[Callable[[], Any]],
    progress: Callable[[str], None],
    rounds: int = 4,
    least: float = 0.01,
) -> list[float]:
    """Return the shortest time in s of each call. Call all of them once before.

    Parameters
    ----------
    calls : sequence of callables
        What is timed.
    progress : callable
        Gets a line of text at times.
    rounds : int
        How often to go over all calls.
    least : float
        How long, in s, to repeat a call in each round, at least.
    """
    found = [float("inf")] * len(calls)
    for number in range(1, rounds + 1):
        progress(f"timing, round {number} of {rounds}")
        for i, call in enumerate(calls):
            begin = end = thread_time()
            while end - begin < least:
                start = end
                call()
                end = thread_time()
                found[i] = min(found[i], end - start)
    return found
