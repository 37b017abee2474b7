"""Many drops one after the other in the arrays of one stack.

Rows of drops, columns of balls or of the contacts below them; a row's outcome depends on nothing
but that row.
"""

import math
from typing import Any, NamedTuple, TypeAlias

from stackbounce.engine import codes
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.kernel import Floats, Integers, kernel
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.prepare import prepare, prepare_rigid
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance, start, write_unfinished
from stackbounce.engine.stack import RigidStack, Samples, Stack

Table: TypeAlias = Any  # a numpy array of rows


class Drops(NamedTuple):
    """What is dropped: (rows, balls) numbers, and (rows,) gravity; see `prepare`."""

    mass: Table
    kind: Table  # of law, an integer
    stiffness: Table
    exponent: Table
    extra: Table
    gap: Table  # below each ball; the lowest one's is 0
    velocity: Table
    gravity: Table


class Outcomes(NamedTuple):
    """What comes of it: (rows, balls) numbers, and (rows,) energy and status."""

    velocity: Table  # afterwards; `compare` makes rebound ratios of them
    collisions: Table  # -1 where infinitely many
    first_touch: Table  # nan where none
    last_release: Table  # nan where none, infinity where the run stopped before
    energy: Table  # kinetic energy afterwards over the one that came in; by `compare`
    status: Table


@kernel
def run_many(
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
    """Run drops on finite contacts in one stack, whose arrays lie in ``room``."""
    size = len(stack.mass)
    for row in range(len(out.status)):
        clear(room)
        unit = prepare(
            stack,
            drops.mass[row],
            drops.kind[row],
            drops.stiffness[row],
            drops.exponent[row],
            drops.extra[row],
            drops.gap[row],
            drops.velocity[row],
            drops.gravity[row],
            rtol,
        )
        start(stack)
        _forget(out, row, size)
        status = codes.RUNNING
        while status == codes.RUNNING:
            stack.counter[0] = 0
            status = advance(stack, until / unit, event_limit, log, samples)
            _read(log, stack.counter[0], unit, out, row)
        end = stack.clock[0]
        if status != codes.FINISHED:
            end = until / unit if status == codes.TIME_REACHED else max(end, stack.clock[1])
            stack.counter[0] = 0
            write_unfinished(stack, end, log)
            _read(log, stack.counter[0], unit, out, row)
        for b in range(size):
            out.velocity[row, b] = velocity_at(stack, b, end) / unit
        out.status[row] = status


@kernel
def run_many_rigid(
    stack: RigidStack,
    room: tuple[Floats, Integers],
    drops: Drops,
    until: float,
    event_limit: int,
    samples: Samples,
    log: Floats,
    out: Outcomes,
) -> None:
    """Run drops of rigid balls in one stack, whose arrays lie in ``room``."""
    size = len(stack.mass)
    for row in range(len(out.status)):
        clear(room)
        prepare_rigid(
            stack,
            drops.mass[row],
            drops.kind[row],
            drops.extra[row],
            drops.gap[row],
            drops.velocity[row],
            drops.gravity[row],
        )
        begin_collisions(stack)
        _forget(out, row, size)
        status = codes.RUNNING
        while status == codes.RUNNING:
            stack.counter[0] = 0
            status = collide_all(stack, until, event_limit, log, samples)
            _read(log, stack.counter[0], 1.0, out, row)
        end = stack.clock[0]
        if status != codes.FINISHED:
            end = until if status == codes.TIME_REACHED else max(end, stack.clock[1])
        for b in range(size):
            out.velocity[row, b] = rigid_velocity(stack, b, end)
            if stack.infinite[b] == 1:
                out.collisions[row, b] = -1
        out.status[row] = status


@kernel
def compare(drops: Drops, out: Outcomes) -> None:
    """Turn velocities into rebound ratios, and find the share of the energy that is left."""
    for row in range(len(out.status)):
        before, after = drops.velocity[row], out.velocity[row]
        out.energy[row] = energy_kept(drops.mass[row], before, after)
        speed = _fastest(before)
        for b in range(len(after)):
            after[b] = after[b] / speed


@kernel
def energy_kept(mass: Floats, before: Floats, after: Floats) -> float:
    """Return the kinetic energy of balls after over that before, velocities in m/s."""
    heaviest, speed = 0.0, _fastest(before)
    for m in mass:
        heaviest = max(heaviest, m)
    came, left = 0.0, 0.0
    for b in range(len(mass)):
        share, start, end = mass[b] / heaviest, before[b] / speed, after[b] / speed
        came += share * (start * start)
        left += share * (end * end)
    return left / came if came > 0.0 else math.nan


@kernel
def _fastest(velocity: Floats) -> float:
    """Return v0, the largest speed."""
    speed = 0.0
    for v in velocity:
        speed = max(speed, abs(v))
    return speed


@kernel
def clear(room: tuple[Floats, Integers]) -> None:
    """Forget the drop before."""
    floats, integers = room
    for k in range(len(floats)):
        floats[k] = 0.0
    for k in range(len(integers)):
        integers[k] = 0


@kernel
def _forget(out: Outcomes, row: int, size: int) -> None:
    for i in range(size):
        out.collisions[row, i] = 0
        out.first_touch[row, i] = math.nan
        out.last_release[row, i] = math.nan


@kernel
def _read(log: Floats, lines: int, unit: float, out: Outcomes, row: int) -> None:
    """Count the contact intervals of a part of a log, and keep its first and last times in s."""
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
