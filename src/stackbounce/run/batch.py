"""Many drops at once: block by block, in threads.

A grid of drops is cut into blocks, which several threads work on. For each block, the parameters of
the base drop are repeated, and those that vary are replaced (`paths.fill`). The engine's batch
kernel then runs the drops of the block one after the other and writes their rows of `Outcomes`. It
returns after a slice of work, so that an interruption (Ctrl+C) is answered at once: in the main
thread by Python itself, in the others because they look at a flag.
"""

import functools
import itertools
import math
import os
import time
from _thread import start_new_thread
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from itertools import accumulate
from queue import Empty, SimpleQueue
from typing import TypeAlias

import numpy as np

from stackbounce.engine import codes
from stackbounce.engine.memory import (
    FINITE,
    OUT_OF_RANGE,
    RIGID,
    Engine,
    kernel_named,
    lane_workspace,
    memory,
)
from stackbounce.engine.records import Drops, Outcomes
from stackbounce.engine.tables import Table
from stackbounce.engine.work import ASKED_RTOL, LANE_EVENTS
from stackbounce.model import Drop
from stackbounce.run.engines import choose_compiled, choose_engine, choose_lanes
from stackbounce.run.options import Options, check_room
from stackbounce.run.paths import Rows, base_rows, drop_pieces, fill

Block: TypeAlias = tuple[slice, ...]
"""A range of each dimension."""
_BLOCKS = range(1024, 16384)  # drops in a block: enough for the lanes, few enough for the caches
_EACH = 8  # blocks per thread of a large grid, so that all threads end at about the same time

_SOON = 1e-3  # s: how often it looks whether threads that were told to stop have done so
_LOOK = 0.1  # s: how often the main thread looks for an interruption; Windows needs that

_Pause: TypeAlias = Callable[[], None]
"""Is called now and then; it raises an exception if the work is to be stopped."""

_Runner: TypeAlias = Callable[[Drops, Outcomes, Options, bool, _Pause], None]
"""Runs drops and writes their outcomes."""


def sides(shape: Sequence[int], most: int) -> tuple[int, ...]:
    """Return the sides of a block of at most ``most`` drops, filled from the last dimension on.

    Examples
    --------
    >>> sides((400, 300, 20), 1000)
    (1, 50, 20)
    """
    found, left = [], most
    for length in reversed(shape):
        side = max(1, min(length, left))
        left //= side
        found.append(side)
    return tuple(reversed(found))


def blocks(shape: Sequence[int], sides: Sequence[int]) -> Iterator[Block]:
    """Yield all blocks of a shape, in the order of memory; the last ones may be smaller.

    Examples
    --------
    >>> [size(block) for block in blocks((2, 5), (1, 3))]
    [3, 2, 3, 2]
    """
    ranges = [
        [slice(start, min(start + side, length)) for start in range(0, length, side)]
        for length, side in zip(shape, sides, strict=True)
    ]
    return itertools.product(*ranges)


def size(block: Block) -> int:
    """Return the number of drops in a block."""
    return math.prod(side.stop - side.start for side in block)


class _StoppedError(Exception):
    """Ends a thread, because the main thread was interrupted or another one failed."""


def solve(
    drop: Drop, rows: Rows, shape: Sequence[int], options: Options, *, compiled: bool | None = None
) -> Outcomes:
    """Run all drops of a grid, which differ from a base drop in some parameters.

    Parameters
    ----------
    drop : Drop
        The base drop, with all parameters that do not vary.
    rows : mapping
        The values of the parameters that vary, by `Number`. They broadcast to `shape`.
    shape : sequence of int
        The shape of the grid; its size is `count`.
    options : Options
        The end time, tolerance and event limit of each run.
    compiled : bool, optional
        Whether to run compiled code; by default wherever there is some for this machine. The
        results are the same bit for bit.

    Returns
    -------
    Outcomes
        Arrays (count, balls), and (count,) energy and status, in row-major order of the grid.
    """
    count, balls = math.prod(shape), len(drop.balls)
    chosen = choose_compiled(compiled)
    run: _Runner = functools.partial(_run_rows, choose_engine(drop), drop_pieces(drop))
    lanes = choose_lanes(drop, rows, options)
    if lanes:
        run = functools.partial(run_lanes, lanes)
    wide = {number: np.broadcast_to(values, shape) for number, values in rows.items()}
    threads = os.cpu_count() or 1
    most = min(max(count // (_EACH * threads), _BLOCKS.start), _BLOCKS.stop)
    out, stopped = new_outcomes(count, balls), False

    def pause() -> None:
        if stopped:
            raise _StoppedError

    def work(todo: Iterable[tuple[Block, int]]) -> None:
        room = base_rows(drop, min(count, most))
        for block, stop in todo:
            sizes = [side.stop - side.start for side in block]
            start = stop - math.prod(sizes)
            drops = Drops._make(array[: stop - start] for array in room)
            shaped = (array.reshape((*sizes, *array.shape[1:])) for array in drops)
            varied = {number: values[block] for number, values in wide.items()}
            fill(Drops._make(shaped), drop, varied)
            part = Outcomes._make(array[start:stop] for array in out)
            run(drops, part, options, chosen, pause)

    cut = list(blocks(shape, sides(shape, most)))
    todo = iter(list(zip(cut, accumulate(map(size, cut)), strict=True)))
    if len(cut) == 1:
        work(todo)
        return out
    begun: list[None] = []
    ended: list[BaseException | None] = []
    wake: SimpleQueue[None] = SimpleQueue()

    def work_on() -> None:  # each thread takes the next block
        begun.append(None)
        error = None
        try:
            work(todo)
        except BaseException as raised:
            error = raised
        ended.append(error)
        wake.put(None)

    # No futures, threads or events of the library: an interruption of the main thread while it
    # holds a lock of theirs would leave that closed, and the thread that needs it waiting for ever.
    try:
        for _ in range(threads):
            start_new_thread(work_on, ())
        while len(ended) < threads:
            with suppress(Empty):
                wake.get(timeout=_LOOK)
            for error in filter(None, ended):
                raise error
    finally:
        stopped = True
        while len(ended) < len(begun):
            time.sleep(_SOON)
    return out


def new_outcomes(count: int, balls: int) -> Outcomes:
    """Return room for the outcomes of so many drops; refuse more than fit into memory."""
    way = "write a sweep to a file, block by block (stackbounce.sweeps.write), or take fewer"
    check_room((4 * balls + 3) * count, f"the results of {count} drops", way)
    return Outcomes(
        rebound_ratio=np.empty((count, balls)),
        collisions=np.empty((count, balls), dtype=np.int64),
        first_touch=np.empty((count, balls)),
        last_release=np.empty((count, balls)),
        energy_retained=np.empty(count),
        status=np.empty(count, dtype=np.int64),
        work=np.zeros(count, dtype=np.int64),
    )


def run_lanes(
    lanes: str, drops: Drops, out: Outcomes, options: Options, compiled: bool, pause: _Pause
) -> None:
    """Run drops by an engine in lanes, and those that it is not sure of by the general engine."""
    space, run = lane_workspace(compiled), kernel_named(lanes, compiled)
    rtol = options.rtol if lanes == "run_pairs" else LANE_EVENTS
    if compiled:
        run(Table(drops), rtol, Table(out), space)
    else:
        with np.errstate(all="ignore"):
            run(drops, rtol, out, space)
    pause()
    rows = np.flatnonzero(out.status == codes.ASK)
    if len(rows):
        some = Drops._make(array[rows] for array in drops)
        answers = Outcomes._make(array[rows] for array in out)
        near = options._replace(rtol=min(options.rtol, ASKED_RTOL))
        engine = RIGID if lanes == "run_two_rigid" else FINITE
        _run_rows(engine, (), some, answers, near, compiled, pause)
        for array, answer in zip(out, answers, strict=True):
            array[rows] = answer


def _run_rows(
    engine: Engine,
    pieces: Sequence[Sequence[float]],
    drops: Drops,
    out: Outcomes,
    options: Options,
    compiled: bool,
    pause: _Pause,
) -> None:
    """Run drops by one engine; the pieces of tables do not vary."""
    balls = drops.mass.shape[1]
    if compiled:
        room = memory(engine, balls, compiled)
        room.put_pieces(pieces)
        room.run_batch(engine.run_batch, drops, options, out, pause)
        return
    run = kernel_named(engine.run_batch, compiled)
    for row in range(len(out.status)):
        room = memory(engine, balls, compiled)
        room.put_pieces(pieces)
        stack, space, _ = room.arguments
        one = Drops._make(array[row : row + 1].tolist() for array in drops)
        outcome = Outcomes._make(array[row : row + 1] for array in out)
        outcome.status[0] = codes.ASK  # it is not under way
        try:
            while run(stack, space, one, room.no_samples, *options, outcome, 0) == 0:
                pause()
        except OUT_OF_RANGE:
            outcome.status[0] = codes.INVALID
            outcome.rebound_ratio[0] = outcome.energy_retained[0] = math.nan
