"""Runs a batch of random drops compiled, in arrays that are made once for each height."""

import functools
import time
from typing import Any, NamedTuple

import numpy as np

from fuzz import drive
from fuzz.draw import BATCH, Drops, balls_of, drops_of, is_rigid
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.kernel import compiled
from stackbounce.engine.stack import as_arrays, new_rigid_stack, new_samples, new_stack
from stackbounce.engine.structure import structure

_LOG_ROWS = 256


class Batch(NamedTuple):
    """What came of a batch: a row per drop, and how long it took."""

    index: int
    drops: Drops
    found: np.ndarray  # drive.COLUMNS, then the balls' velocities and the contacts' counts
    seconds: float


@functools.cache
def _room(balls: int, rigid: bool) -> tuple[Any, ...]:
    """Return a stack whose arrays lie in one of floats and one of integers, and these two."""
    given = as_arrays((new_rigid_stack if rigid else new_stack)(balls))
    rooms = {}
    for kind in (np.float64, np.int64):
        sizes = [len(array) for array in given if array.dtype == kind]
        room = np.zeros(sum(sizes), dtype=kind)
        rooms[kind] = room, iter(np.split(room, np.cumsum(sizes)[:-1]))
    stack = type(given)(*(next(rooms[array.dtype.type][1]) for array in given))
    samples = as_arrays(new_samples([], balls))
    return structure(stack), rooms[np.float64][0], rooms[np.int64][0], samples


def run_batch(seed: int, index: int, count: int = BATCH) -> Batch:
    """Run a batch and return what was found."""
    begun = time.perf_counter()
    drops = drops_of(seed, index, count)
    balls, rigid = balls_of(index), is_rigid(index)
    stack, floats, integers, samples = _room(balls, rigid)
    found = np.zeros((count, drive.COLUMNS + 2 * balls))
    log = np.zeros(_LOG_ROWS * LOG_COLUMNS)
    go = compiled(drive.run_all_rigid if rigid else drive.run_all)
    go(stack, floats, integers, drops, samples, log, found)
    return Batch(index, drops, found, time.perf_counter() - begun)
