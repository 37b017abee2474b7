"""Which engine solves a block of drops: as plain Python or compiled, two springs by their own."""

import functools
import math
import threading
from typing import Any

import numpy as np

from stackbounce.engine import codes
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.kernel import compiled
from stackbounce.engine.many import Drops, Outcomes, run_many, run_many_rigid
from stackbounce.engine.prepare import POWER_LAW
from stackbounce.engine.stack import (
    as_arrays,
    in_one_room,
    new_rigid_stack,
    new_samples,
    new_stack,
)
from stackbounce.engine.two_springs import SCRATCH, two_springs
from stackbounce.simulate import Options

__all__ = ["run"]

_LOG_ROWS = 512
_FEW_BALLS, _FEW_EVENTS = 20, 2000  # up to which a drop is run as plain Python
_NO_ROOM: Any = ([], [])  # what is new needs no clearing
_UNLIMITED = 10_000  # events that two springs never have where their own engine is sure of them
_local = threading.local()


def run(drops: Drops, out: Outcomes, rigid: bool, options: Options, *, few: bool) -> None:
    """Solve a block of drops, as plain Python if they are few.

    Parameters
    ----------
    drops : Drops
        The drops.
    out : Outcomes
        Gets what comes of them.
    rigid : bool
        Whether they are stacks of `Rigid` contacts.
    options : Options
        How to run them.
    few : bool
        Whether loading compiled code would take longer than running them as plain Python.
    """
    if not rigid and _are_two_springs(drops, options):
        _run_two_springs(drops, out, few)
        asked = np.flatnonzero(out.status == codes.ASK)
        if len(asked):
            some = Drops._make(array[asked] for array in drops)
            answers = Outcomes._make(array[asked] for array in out)
            _run_any(some, answers, rigid, options, few)
            for array, answer in zip(out, answers, strict=True):
                array[asked] = answer
    else:
        _run_any(drops, out, rigid, options, few)


def _are_two_springs(drops: Drops, options: Options) -> bool:
    """Tell whether all drops are of two balls on springs that come in at one speed."""
    return bool(
        drops.mass.shape[1] == 2
        and options.until == math.inf
        and options.event_limit >= _UNLIMITED
        and (drops.kind == POWER_LAW).all()
        and (drops.exponent == 1.0).all()
        and (drops.gravity == 0.0).all()
        and (drops.velocity[:, 0] == drops.velocity[:, 1]).all()
        and (drops.velocity[:, 0] < 0.0).all()
    )


def _run_two_springs(drops: Drops, out: Outcomes, few: bool) -> None:
    """Run drops by the engine for two springs, or have it ask for the general one."""
    go: Any = two_springs if few else compiled(two_springs)
    scratch: Any = [0.0] * SCRATCH if few else np.zeros(SCRATCH)
    speed, gap = -drops.velocity[:, 0], drops.gap[:, 1]
    energy = np.empty(len(speed))
    given = (drops.mass, drops.stiffness, np.ascontiguousarray(gap), speed, _UNLIMITED)
    times = (out.first_touch, out.last_release)
    go(*given, out.velocity, out.collisions, *times, energy, out.status, scratch)


def _run_any(drops: Drops, out: Outcomes, rigid: bool, options: Options, few: bool) -> None:
    """Run drops by the general engines."""
    if not few or not _run_plainly(drops, out, rigid, options):
        _run_compiled(drops, out, rigid, options)


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
        go: Any = compiled(run_many_rigid)
        go(stack, room, drops, options.until, limit, samples, log, out)
    else:
        go = compiled(run_many)
        go(stack, room, drops, options.until, options.rtol, limit, samples, log, out)


def _arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    """Return this thread's stack, the two arrays that its own lie in, no samples, and a log."""
    if not hasattr(_local, "made"):
        _local.made = functools.cache(_new_arrays)
    made: tuple[Any, ...] = _local.made(balls, rigid)
    return made


def _new_arrays(balls: int, rigid: bool) -> tuple[Any, ...]:
    from stackbounce.engine.structure import structure

    stack, room = in_one_room(new_rigid_stack(balls) if rigid else new_stack(balls))
    log = np.zeros(max(_LOG_ROWS, balls) * LOG_COLUMNS)
    return structure(stack), room, as_arrays(new_samples([], balls)), log
