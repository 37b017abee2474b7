"""Many drops at once: block by block, in threads."""

import math
import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import accumulate, islice

import numpy as np

from stackbounce.engine.batch import Drops, Outcomes, compare
from stackbounce.model import Drop
from stackbounce.run.blocks import Block, blocks, sides, size
from stackbounce.run.columns import Rows, base_rows, fill
from stackbounce.run.driver import Options
from stackbounce.run.engines import engine_for, ready

__all__ = ["solve"]

_BLOCKS = range(1024, 16384)  # drops in one: enough to fill the lanes, few enough for the caches
_EACH = 8  # blocks for each thread where there are so many, so that all end at about one time
_FEW = 24  # drops that are run as plain Python


def solve(
    drop: Drop,
    rows: Rows,
    shape: Sequence[int],
    options: Options,
    *,
    compiled: bool | None = None,
) -> Outcomes:
    """Return what comes of a drop with other numbers.

    Parameters
    ----------
    drop : Drop
        The base.
    rows : mapping
        The numbers that vary: they broadcast to `shape`.
    shape : sequence of int
        How many drops, by dimension.
    options : Options
        How to run them.
    compiled : bool, optional
        Whether to run compiled code; by default where the drops are many. The bits are the same.

    Returns
    -------
    Outcomes
        Arrays (count, balls), and (count,) energy and status, with rebound ratios for velocities.
    """
    count, balls = math.prod(shape), len(drop.balls)
    out = Outcomes(
        np.empty((count, balls)),
        np.empty((count, balls), dtype=np.int64),
        np.empty((count, balls)),
        np.empty((count, balls)),
        np.empty(count),
        np.empty(count, dtype=np.int64),
    )
    threads = os.cpu_count() or 1
    most = min(max(count // (_EACH * threads), _BLOCKS.start), _BLOCKS.stop)
    few = count <= _FEW if compiled is None else not compiled
    engine = engine_for(drop, rows, options)
    relate = compare if few else ready(compare)
    wide = {number: np.broadcast_to(values, shape) for number, values in rows.items()}

    def work(todo: Iterable[tuple[Block, int]]) -> None:
        room = base_rows(drop, min(count, most))
        for block, stop in todo:
            drops = Drops._make(array[: size(block)] for array in room)
            sizes = [side.stop - side.start for side in block]
            shaped = (array.reshape((*sizes, *array.shape[1:])) for array in drops)
            fill(Drops._make(shaped), drop, {one: values[block] for one, values in wide.items()})
            part = Outcomes._make(array[stop - size(block) : stop] for array in out)
            engine(drops, part, options, few)
            with np.errstate(all="ignore"):
                relate(drops, part)

    cut = list(blocks(shape, sides(shape, most)))
    todo = iter(list(zip(cut, accumulate(map(size, cut)), strict=True)))
    work(islice(todo, 1))  # what has to be compiled is compiled once, not in each thread
    if len(cut) > 1:
        with ThreadPoolExecutor(threads) as pool:  # each takes the next block that is left
            list(pool.map(work, [todo] * threads))
    return out
