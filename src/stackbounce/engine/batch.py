"""Many drops one after the other in the arrays of one stack.

Each row is a drop; columns are its balls, or the contacts below them. The outcome of a row depends
on that row only.
"""

import math
from typing import Any, NamedTuple, TypeAlias

from stackbounce.engine import codes
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.compiler import Floats, Integers, kernel, with_callees
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.preparation import prepare, prepare_rigid
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance_contacts, begin_contacts, log_unfinished
from stackbounce.engine.slots import LAST_CHECK, LAST_EVENT, LOG_ROWS
from stackbounce.engine.stack import RigidStack, Samples, Stack

Table: TypeAlias = Any  # a numpy array of rows


class Drops(NamedTuple):
    """The numbers of drops: (rows, balls) arrays, and (rows,) gravity; see `preparation`."""

    mass: Table
    kind: Table  # of law, see `preparation`
    stiffness: Table
    exponent: Table
    law_parameter: Table
    gap: Table  # below each ball; the lowest one's is 0
    velocity: Table
    gravity: Table


class Outcomes(NamedTuple):
    """The results of drops: (rows, balls) arrays, and (rows,) energy and status.

    `run_batch` and `run_rigid_batch` fill in all fields except the rebound ratios and the retained
    energies, which `find_ratios` computes.
    """

    velocity: Table  # after, m/s
    rebound_ratio: Table  # velocity over the impact speed v0
    collisions: Table  # -1 where infinitely many
    first_touch: Table  # s; nan where none
    last_release: Table  # s; nan where none, infinity where the run stopped during an interval
    energy_retained: Table  # kinetic energy after over that before
    status: Table


@kernel
def is_infinite(stack: Stack, i: int) -> bool:  # noqa: ARG001 - see `run_rigid_batch`
    """Tell whether a contact had infinitely many intervals: a finite one never has."""
    return False


@kernel
def run_batch(
    stack: Stack,
    room: tuple[Floats, Integers],
    drops: Drops,
    until: float,
    rtol: float,
    event_limit: int,
    samples: Samples,
    log: Floats,
    out: Outcomes,
) -> None:
    """Run drops with finite contacts one after the other and write their results to ``out``.

    The same stack is used for all drops. Its arrays are views of the two arrays in ``room``.
    """
    size = len(stack.mass)
    for row in range(len(out.status)):
        clear_arrays(room)
        unit = prepare(
            stack,
            drops.mass[row],
            drops.kind[row],
            drops.stiffness[row],
            drops.exponent[row],
            drops.law_parameter[row],
            drops.gap[row],
            drops.velocity[row],
            drops.gravity[row],
            rtol,
        )
        begin_contacts(stack)
        _reset(out, row, size)
        status = codes.RUNNING
        while status == codes.RUNNING:
            stack.counter[LOG_ROWS] = 0
            status = advance_contacts(stack, until / unit, event_limit, log, samples)
            _read_log(log, stack.counter[LOG_ROWS], unit, out, row)
        end = stack.clock[LAST_EVENT]
        if status != codes.FINISHED:
            end = (
                until / unit if status == codes.TIME_REACHED else max(end, stack.clock[LAST_CHECK])
            )
            stack.counter[LOG_ROWS] = 0
            log_unfinished(stack, end, log)
            _read_log(log, stack.counter[LOG_ROWS], unit, out, row)
        for b in range(size):
            out.velocity[row, b] = velocity_at(stack, b, end) / unit
            if is_infinite(stack, b):
                out.collisions[row, b] = -1
        out.status[row] = status


@kernel
def find_ratios(drops: Drops, out: Outcomes) -> None:
    """Compute rebound ratios and retained energies from the velocities before and after."""
    for row in range(len(out.status)):
        before, after = drops.velocity[row], out.velocity[row]
        out.energy_retained[row] = energy_kept(drops.mass[row], before, after)
        speed = _largest_speed(before)
        for b in range(len(after)):
            out.rebound_ratio[row, b] = after[b] / speed


@kernel
def energy_kept(mass: Floats, before: Floats, after: Floats) -> float:
    """Return the ratio of the kinetic energies after and before the impact; nan if it was 0."""
    heaviest, speed = 0.0, _largest_speed(before)
    for m in mass:
        heaviest = max(heaviest, m)
    came, left = 0.0, 0.0
    for b in range(len(mass)):
        share, start, end = mass[b] / heaviest, before[b] / speed, after[b] / speed
        came += share * (start * start)
        left += share * (end * end)
    return left / came if came > 0.0 else math.nan


@kernel
def _largest_speed(velocity: Floats) -> float:
    """Return the largest absolute velocity: the impact speed v0, the unit of rebound ratios."""
    speed = 0.0
    for v in velocity:
        speed = max(speed, abs(v))
    return speed


@kernel
def clear_arrays(room: tuple[Floats, Integers]) -> None:
    """Set all numbers of a stack to zero; ``room`` holds its floats and its integers."""
    floats, integers = room
    for k in range(len(floats)):
        floats[k] = 0.0
    for k in range(len(integers)):
        integers[k] = 0


@kernel
def _reset(out: Outcomes, row: int, size: int) -> None:
    for i in range(size):
        out.collisions[row, i] = 0
        out.first_touch[row, i] = math.nan
        out.last_release[row, i] = math.nan


@kernel
def _read_log(log: Floats, lines: int, unit: float, out: Outcomes, row: int) -> None:
    """Add the contact intervals in a part of a log to the counts and times of one drop."""
    for line in range(lines):
        at = line * LOG_COLUMNS
        kind = int(log[at + codes.KIND])
        if kind not in (codes.RELEASE, codes.COLLISION):
            continue
        i = int(log[at + codes.CONTACT])
        begin, end = log[at + codes.START] * unit, log[at + codes.TIME] * unit
        out.collisions[row, i] += 1
        if not out.first_touch[row, i] <= begin:
            out.first_touch[row, i] = begin
        if not out.last_release[row, i] >= end:
            out.last_release[row, i] = end


@kernel
def _log_nothing(stack: RigidStack, end: float, log: Floats) -> None:
    """Stand in for `log_unfinished` where no contact interval has a duration."""


@kernel
def _collided_infinitely(stack: RigidStack, i: int) -> bool:
    """Tell whether a rigid contact has collided infinitely often."""
    return stack.infinite[i] == 1


run_rigid_batch = with_callees(
    run_batch,
    "run_rigid_batch",
    prepare=prepare_rigid,
    begin_contacts=begin_collisions,
    advance_contacts=collide_all,
    log_unfinished=_log_nothing,
    velocity_at=rigid_velocity,
    is_infinite=_collided_infinitely,
)
"""`run_batch` of rigid balls; its `stack` is a `RigidStack`."""
