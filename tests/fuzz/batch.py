"""Runs a batch of random drops, in arrays that are made once for each height."""

import functools
import time
from typing import Any, NamedTuple

import numpy as np
from kernel_build.jit import compile_kernel

from fuzz import drive
from fuzz.draw import BATCH, Drops, balls_of, drops_of, is_rigid
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.stack import as_arrays, in_one_room, new_rigid_stack, new_samples, new_stack
from stackbounce.engine.tables import Table

_LOG_ROWS = 256


class Batch(NamedTuple):
    """What came of a batch: a row per drop, and how long it took."""

    index: int
    drops: Drops
    found: np.ndarray  # drive.COLUMNS, then the balls' velocities and the contacts' counts
    seconds: float


@functools.cache
def _arrays(balls: int, rigid: bool, compiled: bool) -> tuple[Any, ...]:
    """Return a stack, the arrays that its own lie in, and no samples."""
    stack, room = in_one_room((new_rigid_stack if rigid else new_stack)(balls))
    samples = as_arrays(new_samples([], balls))
    return (Table(stack), room, Table(samples)) if compiled else (stack, room, samples)


def run_batch(seed: int, index: int, count: int = BATCH, *, compiled: bool = True) -> Batch:
    """Run a batch and return what was found; to compile takes a minute in each process."""
    drops = drops_of(seed, index, count)
    balls, rigid = balls_of(index), is_rigid(index)
    stack, room, samples = _arrays(balls, rigid, compiled)
    found = np.zeros((count, drive.COLUMNS + 2 * balls))
    log, turns = np.zeros(_LOG_ROWS * LOG_COLUMNS), np.zeros((count, 2 * balls))
    go = drive.run_all_rigid if rigid else drive.run_all
    if compiled:
        go = compile_kernel(go)
        go(stack, room, drops, samples, log, turns[:0], found[:0])  # compiles, runs nothing
    begun = time.perf_counter()
    with np.errstate(all="ignore"):
        go(stack, room, drops, samples, log, turns, found)
    return Batch(index, drops, found, time.perf_counter() - begun)
