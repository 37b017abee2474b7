"""Which engine solves many drops: as plain Python or compiled, two springs by their own."""

import functools
import math
import threading
from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

import numpy as np

from stackbounce.engine import codes
from stackbounce.engine.batch import Drops, Outcomes, run_many, run_many_rigid
from stackbounce.engine.codes import LOG_COLUMNS, POWER
from stackbounce.engine.kernel import compiled
from stackbounce.engine.stack import (
    as_arrays,
    in_one_room,
    new_rigid_stack,
    new_samples,
    new_stack,
)
from stackbounce.engine.two_springs import SCRATCH, scratch, two_springs
from stackbounce.model import Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.driver import Options
from stackbounce.run.paths import Number

__all__ = ["Engine", "engine_for", "ready"]

Engine: TypeAlias = Callable[[Drops, Outcomes, Options, bool], None]
"""Solves drops, as plain Python if they are so few that loading compiled code would take longer."""

_LOG_ROWS = 512
_FEW_BALLS, _FEW_EVENTS = 20, 2000  # up to which a drop is run as plain Python
_NO_ROOM: Any = ([], [])  # what is new needs no clearing
_UNLIMITED = 10_000  # events that two springs never have where their own engine is sure of them
_local = threading.local()
_lock = threading.Lock()


def engine_for(drop: Drop, numbers: Iterable[Number], options: Options) -> Engine:
    """Return what solves all drops that differ from a base in these numbers.

    It does not depend on their values, so that what comes of a drop does not depend on others.
    """
    if drop.rigid:
        return _run_rigid
    linear = all(contact_numbers(law)[::2] == (POWER, 1.0) for law in drop.contacts)
    together = len(set(drop.start_velocities)) == 1 and drop.start_velocities[0] < 0.0
    free = any(n.part == "velocities" or n.field in ("exponent", "gravity") for n in numbers)
    whole = options.until == math.inf and options.event_limit >= _UNLIMITED
    if len(drop.balls) == 2 and linear and together and drop.gravity == 0.0 and whole and not free:
        return _run_two_springs
    return _run_finite


def ready(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the compiled form of a kernel; threads that ask together take turns.

    For as long as one is made numba's cache folder is the package's own: another thread would find
    a wrong one, and leave its files in the working directory.
    """
    with _lock:
        return compiled(function)


def _run_two_springs(drops: Drops, out: Outcomes, options: Options, few: bool) -> None:
    """Run drops by the engine for two springs, and those it is not sure of by the general one."""
    go: Any = two_springs if few else ready(two_springs)
    room: Any = [0.0] * SCRATCH if few else scratch()
    speed, gap = -drops.velocity[:, 0], np.ascontiguousarray(drops.gap[:, 1])
    given = (drops.mass, drops.stiffness, gap, speed, _UNLIMITED)
    times = out.first_touch, out.last_release
    go(*given, out.velocity, out.collisions, *times, out.status, room)
    asked = np.flatnonzero(out.status == codes.ASK)
    if len(asked):
        some = Drops._make(array[asked] for array in drops)
        answers = Outcomes._make(array[asked] for array in out)
        _run_finite(some, answers, options, few)
        for array, answer in zip(out, answers, strict=True):
            array[asked] = answer


def _run_finite(drops: Drops, out: Outcomes, options: Options, few: bool) -> None:
    """Run drops on finite contacts."""
    if not few or not _run_plainly(drops, out, False, options):
        _run_compiled(drops, out, False, options)


def _run_rigid(drops: Drops, out: Outcomes, options: Options, few: bool) -> None:
    """Run drops of rigid balls."""
    if not few or not _run_plainly(drops, out, True, options):
        _run_compiled(drops, out, True, options)


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


def _run_compiled(drops: Drops, out: Outcomes, rigid: bool, options: Options) -> None:
    stack, room, samples, log = _arrays(out.velocity.shape[1], rigid)
    limit = options.event_limit
    if rigid:
        go: Any = ready(run_many_rigid)
        go(stack, room, drops, options.until, limit, samples, log, out)
    else:
        go = ready(run_many)
        go(stack, room, drops, options.until, options.rtol, limit, samples, log, out)


def _arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    """Return this thread's stack, the two arrays that its own lie in, no samples, and a log."""
    if not hasattr(_local, "made"):
        _local.made = functools.cache(_new_arrays)
    made: tuple[Any, ...] = _local.made(balls, rigid)
    return made


def _new_arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    from stackbounce.engine.structure import Structure

    stack, room = in_one_room(new_rigid_stack(balls) if rigid else new_stack(balls))
    log = np.zeros(max(_LOG_ROWS, balls) * LOG_COLUMNS)
    return Structure(stack), room, as_arrays(new_samples([], balls)), log
