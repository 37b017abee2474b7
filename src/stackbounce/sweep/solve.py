"""Many drops at once: blocks of rows, each solved by the compiled engine in a thread of its own."""

import functools
import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine import codes
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.kernel import compiled
from stackbounce.engine.many import Drops, Outcomes, run_many, run_many_rigid
from stackbounce.engine.stack import as_arrays, new_rigid_stack, new_samples, new_stack
from stackbounce.simulate import Options

__all__ = ["Outputs", "solve"]

_BLOCK = 1024  # rows
_LOG_ROWS = 512
_FEW, _FEW_BALLS, _FEW_EVENTS = 24, 20, 2000  # drops that are run as plain Python
_NO_ROOM: Any = ([], [])  # what is new needs no clearing
_local = threading.local()


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
        if count > _FEW or not _run_plainly(drops, outcomes, rigid, options):
            _run(drops, outcomes, rigid, options)
        _compare(drops, velocity, part)

    if count <= _BLOCK:
        work(slice(0, count))
        return out
    compiled(run_many_rigid if rigid else run_many)  # once, not in each thread
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for _ in pool.map(work, _blocks(count)):
            pass
    return out


def _blocks(count: int) -> Iterator[slice]:
    return (slice(start, min(start + _BLOCK, count)) for start in range(0, count, _BLOCK))


def _compare(drops: Drops, velocity: NDArray[np.float64], out: Outputs) -> None:
    """Write down what a block's drops came out with, over what they came in with."""
    before, mass = np.asarray(drops.velocity), np.asarray(drops.mass)
    speed = np.max(np.abs(before), axis=1, keepdims=True)
    share = mass / np.max(mass, axis=1, keepdims=True)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        out.rebound_ratio[:] = velocity / speed
        after = np.sum(share * np.square(out.rebound_ratio), axis=1)
        out.energy_retained[:] = after / np.sum(share * np.square(before / speed), axis=1)


def _run_plainly(drops: Drops, out: Outcomes, rigid: bool, options: Options) -> bool:
    """Run a few drops as plain Python, sooner done than compiled code is loaded, if they are short.

    Returns whether they were.
    """
    balls = drops.mass.shape[1]
    if balls > _FEW_BALLS:
        return False
    limit = min(options.event_limit, _FEW_EVENTS)
    samples, log = new_samples([], balls), [0.0] * (_LOG_ROWS * LOG_COLUMNS)
    for row in range(len(out.status)):
        one = Drops._make(array[row : row + 1].tolist() for array in drops)
        outcome = Outcomes._make(array[row : row + 1] for array in out)
        try:
            if rigid:
                pebbles = new_rigid_stack(balls)
                run_many_rigid(pebbles, _NO_ROOM, one, options.until, limit, samples, log, outcome)
            else:
                stack = new_stack(balls)
                run_many(stack, _NO_ROOM, one, *options[:2], limit, samples, log, outcome)
        except (ArithmeticError, TypeError, ValueError):  # where compiled code has inf or nan
            return False
        if out.status[row] == codes.EVENT_LIMIT and limit < options.event_limit:
            return False
    return True


def _run(drops: Drops, out: Outcomes, rigid: bool, options: Options) -> None:
    stack, room, samples, log = _arrays(out.velocity.shape[1], rigid)
    limit = options.event_limit
    if rigid:
        run: Any = compiled(run_many_rigid)
        run(stack, room, drops, options.until, limit, samples, log, out)
    else:
        run = compiled(run_many)
        run(stack, room, drops, options.until, options.rtol, limit, samples, log, out)


def _arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    """Return this thread's stack, the two arrays that its own lie in, no samples, and a log."""
    if not hasattr(_local, "made"):
        _local.made = functools.cache(_new_arrays)
    made: tuple[Any, ...] = _local.made(balls, rigid)
    return made


def _new_arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    from stackbounce.engine.structure import structure

    given = as_arrays(new_rigid_stack(balls) if rigid else new_stack(balls))
    rooms: dict[Any, Any] = {}
    for kind in (np.float64, np.int64):
        sizes = [len(array) for array in given if array.dtype == kind]
        room: NDArray[Any] = np.zeros(sum(sizes), dtype=kind)
        rooms[kind] = room, iter(np.split(room, np.cumsum(sizes)[:-1]))
    stack = type(given)(*(next(rooms[array.dtype.type][1]) for array in given))
    log = np.zeros(max(_LOG_ROWS, balls) * LOG_COLUMNS)
    room_of_both = rooms[np.float64][0], rooms[np.int64][0]
    return structure(stack), room_of_both, as_arrays(new_samples([], balls)), log
