"""Many drops at once: blocks of rows, each solved in a thread of its own."""

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine.many import Drops, Outcomes
from stackbounce.simulate import Options
from stackbounce.sweep.engines import run

__all__ = ["Outputs", "solve"]

_BLOCK = 4096  # rows
_FEW = 24  # drops that are run as plain Python


class Outputs(NamedTuple):
    """What comes of many drops: (count, balls) arrays, and (count,) energy and status."""

    rebound_ratio: NDArray[np.float64]
    collisions: NDArray[np.int64]
    first_touch: NDArray[np.float64]
    last_release: NDArray[np.float64]
    energy_retained: NDArray[np.float64]
    status: NDArray[np.int64]


def solve(
    make: Callable[[int, int], Drops], count: int, balls: int, rigid: bool, options: Options
) -> Outputs:
    """Return what comes of `count` drops.

    Parameters
    ----------
    make : callable
        Returns the drops of rows from a first one up to, and without, a last one.
    count : int
        How many rows.
    balls : int
        How many balls each drop has.
    rigid : bool
        Whether they are stacks of `Rigid` contacts.
    options : Options
        How to run them.

    Returns
    -------
    Outputs
    """
    out = Outputs(
        np.empty((count, balls)),
        np.empty((count, balls), dtype=np.int64),
        np.empty((count, balls)),
        np.empty((count, balls)),
        np.empty(count),
        np.empty(count, dtype=np.int64),
    )

    def work(block: slice) -> None:
        part = Outputs._make(array[block] for array in out)
        drops = make(block.start, block.stop)
        velocity = np.empty((len(part.status), balls))
        times = part.first_touch, part.last_release
        outcomes = Outcomes(velocity, part.collisions, *times, part.status)
        run(drops, outcomes, rigid, options, few=count <= _FEW)
        _compare(drops, velocity, part)

    if count <= _BLOCK:
        work(slice(0, count))
        return out
    work(slice(0, _BLOCK))  # what has to be compiled is compiled once, not in each thread
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for _ in pool.map(work, _blocks(_BLOCK, count)):
            pass
    return out


def _blocks(first: int, count: int) -> Iterator[slice]:
    return (slice(start, min(start + _BLOCK, count)) for start in range(first, count, _BLOCK))


def _compare(drops: Drops, velocity: NDArray[np.float64], out: Outputs) -> None:
    """Write down what a block's drops came out with, over what they came in with."""
    before, mass = np.asarray(drops.velocity), np.asarray(drops.mass)
    speed = np.max(np.abs(before), axis=1, keepdims=True)
    share = mass / np.max(mass, axis=1, keepdims=True)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        out.rebound_ratio[:] = velocity / speed
        after = np.sum(share * np.square(out.rebound_ratio), axis=1)
        out.energy_retained[:] = after / np.sum(share * np.square(before / speed), axis=1)
