"""Many drops at once: block by block, in threads.

A grid of drops is cut into blocks, which several threads work on. For each block, the parameters of
the base drop are repeated, and those that vary are replaced (`columns.fill`). The engine's batch
kernel then runs the drops of the block one after the other and writes their rows of `Outcomes`.
"""

import functools
import math
import os
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import accumulate, islice
from typing import Any, TypeAlias

import numpy as np

from stackbounce.engine import codes
from stackbounce.engine.batch import Drops, Outcomes, find_ratios
from stackbounce.engine.compiler import compile_kernel
from stackbounce.engine.stack import as_arrays, in_one_room, new_samples
from stackbounce.engine.two_springs import SCRATCH, new_scratch, run_two_springs
from stackbounce.model import Drop
from stackbounce.run.blocks import Block, blocks, sides, size
from stackbounce.run.columns import Rows, base_rows, fill
from stackbounce.run.driver import LOG_ROWS_AT_ONCE
from stackbounce.run.engines import (
    FINITE,
    OUT_OF_RANGE,
    TWO_SPRINGS_EVENTS,
    Engine,
    Mode,
    choose_engine,
    choose_mode,
    suits_two_springs,
)
from stackbounce.run.options import Options

__all__ = ["solve"]

_BLOCKS = range(1024, 16384)  # drops in a block: enough for the lanes, few enough for the caches
_EACH = 8  # blocks per thread of a large grid, so that all threads end at about the same time
_NO_ROOM: Any = ([], [])  # a new stack needs no clearing
_local = threading.local()

_Runner: TypeAlias = Callable[[Drops, Outcomes, Options, Mode], None]
"""Runs drops and writes their outcomes, except rebound ratios and retained energies."""


def solve(
    drop: Drop,
    rows: Rows,
    shape: Sequence[int],
    options: Options,
    *,
    compiled: bool | None = None,
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
        Whether to run compiled code; by default if there are many drops. The results are the same
        bit for bit.

    Returns
    -------
    Outcomes
        Arrays (count, balls), and (count,) energy and status, in row-major order of the grid.
    """
    count, balls = math.prod(shape), len(drop.balls)
    mode = choose_mode(compiled, count, balls)
    run: _Runner = functools.partial(_run_rows, choose_engine(drop))
    if suits_two_springs(drop, rows, options):
        run = _run_two_springs
    relate = compile_kernel(find_ratios) if mode is Mode.COMPILED else find_ratios
    wide = {number: np.broadcast_to(values, shape) for number, values in rows.items()}
    threads = os.cpu_count() or 1
    most = min(max(count // (_EACH * threads), _BLOCKS.start), _BLOCKS.stop)
    out = _new_outcomes(count, balls)

    def work(todo: Iterable[tuple[Block, int]]) -> None:
        room = base_rows(drop, min(count, most))
        for block, stop in todo:
            drops = Drops._make(array[: size(block)] for array in room)
            sizes = [side.stop - side.start for side in block]
            shaped = (array.reshape((*sizes, *array.shape[1:])) for array in drops)
            fill(Drops._make(shaped), drop, {one: values[block] for one, values in wide.items()})
            part = Outcomes._make(array[stop - size(block) : stop] for array in out)
            run(drops, part, options, mode)
            with np.errstate(all="ignore"):
                relate(drops, part)

    cut = list(blocks(shape, sides(shape, most)))
    todo = iter(list(zip(cut, accumulate(map(size, cut)), strict=True)))
    work(islice(todo, 1))  # compiles the kernels once, not in each thread
    if len(cut) > 1:
        with ThreadPoolExecutor(threads) as pool:  # each takes the next block
            list(pool.map(work, [todo] * threads))
    return out


def _new_outcomes(count: int, balls: int) -> Outcomes:
    """Return room for the outcomes of so many drops."""
    return Outcomes(
        velocity=np.empty((count, balls)),
        rebound_ratio=np.empty((count, balls)),
        collisions=np.empty((count, balls), dtype=np.int64),
        first_touch=np.empty((count, balls)),
        last_release=np.empty((count, balls)),
        energy_retained=np.empty(count),
        status=np.empty(count, dtype=np.int64),
    )


def _run_two_springs(drops: Drops, out: Outcomes, options: Options, mode: Mode) -> None:
    """Run drops by the engine for two springs, and those with the status ASK by the general one."""
    run, scratch = compile_kernel(run_two_springs), new_scratch
    if mode is not Mode.COMPILED:
        run, scratch = run_two_springs, functools.partial(_zeros, SCRATCH)
    speed, gap = -drops.velocity[:, 0], np.ascontiguousarray(drops.gap[:, 1])
    given = (drops.mass, drops.stiffness, gap, speed, TWO_SPRINGS_EVENTS)
    times = out.first_touch, out.last_release
    run(*given, out.velocity, out.collisions, *times, out.status, scratch())
    asked = np.flatnonzero(out.status == codes.ASK)
    if len(asked):
        some = Drops._make(array[asked] for array in drops)
        answers = Outcomes._make(array[asked] for array in out)
        _run_rows(FINITE, some, answers, options, mode)
        for array, answer in zip(out, answers, strict=True):
            array[asked] = answer


def _run_rows(engine: Engine, drops: Drops, out: Outcomes, options: Options, mode: Mode) -> None:
    """Run drops by one engine.

    If plain Python reaches its limit of events, or a number out of range, all drops start again in
    compiled code.
    """
    if mode is Mode.COMPILED or not _run_plainly(engine, drops, out, options, mode):
        stack, room, samples, log = _arrays(engine, drops.mass.shape[1])
        compile_kernel(engine.run_batch)(stack, room, drops, *options, samples, log, out)


def _run_plainly(engine: Engine, drops: Drops, out: Outcomes, options: Options, mode: Mode) -> bool:
    """Run drops as plain Python; return False if compiled code must run all of them again."""
    balls = drops.mass.shape[1]
    limit = mode.event_limit(options.event_limit)
    samples, log = new_samples([], balls), _zeros(_log_size(balls))
    for row in range(len(out.status)):
        one = Drops._make(array[row : row + 1].tolist() for array in drops)
        outcome = Outcomes._make(array[row : row + 1] for array in out)
        stack, cut = engine.new_stack(balls), options._replace(event_limit=limit)
        try:
            engine.run_batch(stack, _NO_ROOM, one, *cut, samples, log, outcome)
        except OUT_OF_RANGE:
            return False
        if out.status[row] == codes.EVENT_LIMIT and limit < options.event_limit:
            return False
    return True


def _arrays(engine: Engine, balls: int) -> tuple[Any, ...]:
    """Return this thread's stack, its two underlying arrays, empty samples and a log."""
    if not hasattr(_local, "made"):
        _local.made = functools.cache(_new_arrays)
    made: tuple[Any, ...] = _local.made(engine, balls)
    return made


def _new_arrays(engine: Engine, balls: int) -> tuple[Any, ...]:
    from stackbounce.engine.structure import Structure

    stack, room = in_one_room(engine.new_stack(balls))
    return Structure(stack), room, as_arrays(new_samples([], balls)), np.zeros(_log_size(balls))


def _log_size(balls: int) -> int:
    return max(LOG_ROWS_AT_ONCE, balls) * codes.LOG_COLUMNS


def _zeros(count: int) -> list[float]:
    return [0.0] * count
