"""The memory in which drops are run: lists for plain Python, arrays and their tables otherwise.

Compiled code is run wherever there is some for this machine (`native`). Plain Python gives the same
bits, about a hundred times slower.
"""

import functools
import math
import threading
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from stackbounce.engine import codes, native
from stackbounce.engine.records import (
    AFTER,
    CONTINUE,
    END,
    SCRATCH,
    UNIT,
    Drops,
    Outcomes,
    Workspace,
)
from stackbounce.engine.slots import LAST_EVENT, LOG_ROWS
from stackbounce.engine.stack import (
    MOST_PIECES,
    PIECE_NUMBERS,
    Samples,
    as_arrays,
    in_one_room,
    new_rigid_stack,
    new_samples,
    new_stack,
)
from stackbounce.engine.tables import Table

Kernel: TypeAlias = Callable[..., Any]

OUT_OF_RANGE = (OverflowError, ZeroDivisionError, ValueError)
"""What plain Python raises where compiled code goes on with inf or nan.

``1.0 / 0.0``, ``math.sqrt(-1.0)`` and ``int(math.nan)`` are such cases. Any other exception in a
kernel is a programming error and is not caught.
"""

_ROWS = 512  # of the log, besides one for each ball
_LINE = 8  # numbers in a cache line
_MOST = 16  # stacks of different height that a thread keeps
_local = threading.local()


class Engine(NamedTuple):
    """What solves stacks of one kind: how a stack is made, and the names of the kernels.

    Parameters
    ----------
    new_stack : callable
        Returns an empty stack for a number of balls.
    run_drop : str
        The kernel that runs one drop until it ends or the log is full.
    run_batch : str
        The kernel that runs many drops one after the other.
    """

    new_stack: Callable[[int], Any]
    run_drop: str
    run_batch: str


FINITE = Engine(new_stack, "run_drop", "run_batch")
RIGID = Engine(new_rigid_stack, "run_rigid_drop", "run_rigid_batch")


def kernel_named(name: str, compiled: bool) -> Kernel:
    """Return a kernel as compiled code or in plain Python, which is imported only then."""
    if compiled:
        return native.compiled(name)
    from stackbounce.engine.entries import ENTRIES

    return ENTRIES[name]


class Memory(NamedTuple):
    """The memory of runs of stacks of one height, by one engine."""

    compiled: bool
    stack: Any
    space: Workspace
    drop: Drops  # room for one drop
    arguments: tuple[Any, ...]  # stack, space and drop as a kernel takes them
    nothing: Samples  # no samples
    no_samples: Any  # the same as a kernel takes them
    run: functools.partial[Any]  # the engine's run_drop on all of these: takes stage and options

    def put(self, numbers: Drops) -> None:
        """Set the parameters of the one drop."""
        for room, values in zip(self.drop, numbers, strict=True):
            room[0] = values

    def put_pieces(self, pieces: Iterable[Sequence[float]]) -> None:
        """Set the pieces of the curves of contacts that are given by tables, of others nothing."""
        for i, numbers in enumerate(pieces):
            if numbers:
                at = i * MOST_PIECES * PIECE_NUMBERS
                self.stack.pieces[at : at + len(numbers)] = numbers

    def sampled(self, times: Sequence[float]) -> tuple[Samples, Kernel]:
        """Return room for samples at times in s, in ascending order, and `run` that fills it."""
        if not times:
            return self.nothing, self.run
        samples: Any = new_samples(times, len(self.stack.mass))
        table: Any = samples
        if self.compiled:
            samples = as_arrays(samples)
            table = Table(samples)
        return samples, functools.partial(self.run.func, *self.arguments, table, 0)

    def follow(self, run: Kernel, stage: int, options: Sequence[float]) -> tuple[int, list[float]]:
        """Run the one drop to its end, from a stage on; return its status and its log."""
        status, log = codes.RUNNING, []
        try:
            while status == codes.RUNNING:
                status = run(stage, *options)
                log += self._take_log()
                stage = CONTINUE
        except OUT_OF_RANGE:
            log += self._take_log()
            status, after = codes.INVALID, self.space.after
            unit = after[UNIT] or 1.0
            after[END] = self.stack.number[LAST_EVENT] * unit
            after[AFTER:] = [math.nan] * len(self.stack.mass)
        return status, log

    def run_batch(
        self,
        entry: str,
        drops: Drops,
        options: Sequence[float],
        out: Outcomes,
        pause: Callable[[], None] = lambda: None,
    ) -> None:
        """Run many drops by compiled code, and write their outcomes; call `pause` now and then."""
        stack, space, _ = self.arguments
        run, row = kernel_named(entry, compiled=True), 0
        out.status[:] = codes.ASK  # none is under way
        given, written = Table(drops), Table(out)
        while row < len(out.status):
            row = run(stack, space, given, self.no_samples, *options, written, row)
            pause()

    def _take_log(self) -> list[float]:
        """Return the rows of the log in a flat list."""
        return self.numbers(self.space.log[: self.stack.counter[LOG_ROWS] * codes.LOG_COLUMNS])

    def numbers(self, values: Any) -> list[Any]:
        """Return an array or a list as a list."""
        return list(values.tolist() if self.compiled else values)


def memory(engine: Engine, balls: int, compiled: bool) -> Memory:
    """Return the memory for stacks of one height: new for plain Python, else this thread's own."""
    if not compiled:
        return _new_memory(engine, balls, compiled)
    if not hasattr(_local, "known"):
        _local.known = functools.lru_cache(_MOST)(_new_memory)
    known: Memory = _local.known(engine, balls, compiled)
    return known


def lane_workspace(compiled: bool) -> Any:
    """Return scratch space as an engine in lanes takes it: new for plain Python, else the thread's.

    It begins at a cache line: loading a vector that spans two lines takes longer. Plain Python
    needs an array, too: dividing numbers of numpy by 0 raises nothing.
    """
    if compiled and hasattr(_local, "lanes"):
        return _local.lanes
    room: Any = np.zeros(SCRATCH + _LINE)
    start = -(room.ctypes.data // room.itemsize) % _LINE
    space = Workspace([], [], [], [])._replace(floats=room[start : start + SCRATCH])
    if not compiled:
        return space
    _local.lanes = Table(_arrays(space)._replace(floats=space.floats))
    return _local.lanes


def _new_memory(engine: Engine, balls: int, compiled: bool) -> Memory:
    stack, samples = engine.new_stack(balls), new_samples([], balls)
    log, after = [0.0] * ((_ROWS + balls) * codes.LOG_COLUMNS), [0.0] * (AFTER + balls)
    space = Workspace([], [], log, after)
    drop = Drops._make([[0.0] * balls] for _ in Drops._fields)._replace(gravity=[0.0])
    if not compiled:
        arguments: Any = stack, space, drop
        none: Any = samples
    else:
        stack, (floats, integers) = in_one_room(stack)
        space = _arrays(space)._replace(floats=floats, integers=integers)
        drop = Drops._make(map(np.array, drop))
        drop = drop._replace(form=np.zeros((1, balls), dtype=np.int64))
        arguments, none = (Table(stack), Table(space), Table(drop)), Table(as_arrays(samples))
    kernel = kernel_named(engine.run_drop, compiled)
    # addresses, which the Tables keep valid, are taken faster than Tables
    tables = [*arguments, none]
    given = [table.address for table in tables] if compiled else tables
    run = functools.partial(kernel, *given, 0)
    return Memory(compiled, stack, space, drop, arguments, samples, none, run)


def _arrays(space: Workspace) -> Any:
    """Return a workspace of lists as one of arrays."""
    integers: Any = np.array(space.integers, dtype=np.int64)
    return Workspace._make(map(np.array, space))._replace(integers=integers)
