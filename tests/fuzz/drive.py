"""Kernels that load random drops into one stack's arrays, run them, and check what came out."""

import math
from typing import Any

from stackbounce.engine import codes
from stackbounce.engine.batch import clear_arrays, end_of_run
from stackbounce.engine.codes import EPSILON, FINISHED, LOG_COLUMNS, RUNNING, TIME_REACHED
from stackbounce.engine.flight import compression_after
from stackbounce.engine.forces import held_energy
from stackbounce.engine.kernels import kernel
from stackbounce.engine.motion import compression_at, creep_at, velocity_at
from stackbounce.engine.preparation import prepare, prepare_rigid
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance_contacts, begin_contacts
from stackbounce.engine.slots import (
    EVENTS,
    GRAVITY,
    LAST_CHECK,
    LAST_EVENT,
    LOG_ROWS,
    NONLINEAR,
    UNIT,
)
from stackbounce.engine.work import WORK_LIMIT

# laws of random drops
NONE, SPRING, HERTZ, POWER, DASHPOT, VISCOELASTIC, HUNT_CROSSLEY = range(7)
HYSTERETIC, RIGID, RELAXING = range(7, 10)

# what can be wrong with a run, as bits
BAD_NUMBER, GAINS_ENERGY, LOSES_MOMENTUM, OUT_OF_TURN, OUT_OF_ORDER = 1, 2, 4, 8, 16
STILL_CLOSED, APPROACHES, GAINS_IN_BETWEEN, SPLIT_DIFFERS, IS_INVALID = 32, 64, 128, 256, 512
FAULTS = {
    BAD_NUMBER: "a number is not finite",
    GAINS_ENERGY: "energy rises",
    LOSES_MOMENTUM: "momentum changes",
    OUT_OF_TURN: "touch and release do not alternate",
    OUT_OF_ORDER: "a contact's events go back in time",
    STILL_CLOSED: "finished with a closed contact",
    APPROACHES: "finished while a contact approaches",
    GAINS_IN_BETWEEN: "energy rises in between",
    SPLIT_DIFFERS: "a run stopped in between ends otherwise",
    IS_INVALID: "invalid, though the clock could tell",
}
STATUS, EVENT_COUNT, END, ENERGY, MOMENTUM, APPROACH, FAULT = range(7)
COLUMNS = 7  # of what is found, before the balls' velocities and the contacts' counts
_LOOSE = 10.0  # times rtol, and a tenth of it per event: a rise of the energy, a rate of approach
_ROUND = 1e-12  # and more than that of the first energy
_SHAKE = 64.0 * EPSILON  # of the largest momentum, per event


@kernel
def run(
    stack: Any, room: Any, drops: Any, row: int, samples: Any, log: Any, turns: Any, out: Any
) -> None:
    """Run one drop of finite contacts and write into ``out`` what is found."""
    size = len(stack.mass)
    clear_arrays(room[0], room[1])
    unit = prepare(stack, drops, row, drops.rtol[row])
    begin_contacts(stack)
    first, reference = energy_at(stack, 0.0)
    status, fault = RUNNING, 0
    while status == RUNNING:
        stack.counter[LOG_ROWS] = 0
        status = advance_contacts(
            stack, drops.until[row] / unit, drops.limit[row], WORK_LIMIT, log, samples
        )
        fault |= read(log, stack.counter[LOG_ROWS], turns, out)
    if status == codes.INVALID and comes_too_late(stack):
        out[STATUS], out[EVENT_COUNT] = status, stack.counter[EVENTS]
        out[END] = stack.clock[LAST_CHECK] * unit
        out[FAULT] = fault
        return
    end = end_of_run(stack.clock, status, drops.until[row] / unit)
    last, terms = energy_at(stack, end)
    allowed = _ROUND * (1.0 + 0.1 * stack.counter[EVENTS])
    if stack.setting[NONLINEAR] == 1:
        allowed += _LOOSE * drops.rtol[row] * (1.0 + 0.1 * stack.counter[EVENTS])
    out[ENERGY] = (last - first) / (reference + terms)
    if not out[ENERGY] <= allowed:
        fault |= GAINS_ENERGY
    out[STATUS], out[EVENT_COUNT], out[END] = status, stack.counter[EVENTS], end * unit
    for b in range(size):
        out[COLUMNS + b] = velocity_at(stack, b, end) / unit
        if status == FINISHED and stack.phase[b] != codes.OPEN:
            fault |= STILL_CLOSED
    fault |= last_faults(stack, drops, row, allowed, out)
    if status == codes.INVALID:
        fault |= IS_INVALID  # not because the clock could not tell the times of an event apart
    if drops.stops[row, 0] > 0.0 and end > 0.0:
        clear_arrays(room[0], room[1])
        fault |= in_parts(stack, drops, row, samples, log, allowed * (reference + terms), out)
    out[FAULT] = fault


@kernel
def comes_too_late(stack: Any) -> bool:
    """Return whether the clock cannot tell a contact's parts apart: stated to be invalid."""
    for i in range(len(stack.mass)):
        speed = abs(stack.velocity[i]) + (abs(stack.velocity[i - 1]) if i > 0 else 0.0)
        if 4.0 * EPSILON * stack.clock[LAST_CHECK] * speed > 1e-5 * stack.scale[i]:
            return True
    return False


@kernel
def in_parts(
    stack: Any, drops: Any, row: int, samples: Any, log: Any, allowed: float, out: Any
) -> int:
    """Run a drop again, stopping in between: no rise of energy, the same end."""
    fault, status = 0, TIME_REACHED
    unit = prepare(stack, drops, row, drops.rtol[row])
    begin_contacts(stack)
    before, _ = energy_at(stack, 0.0)
    stops = drops.stops.shape[1]
    for k in range(stops + 1):
        # with gravity a run to a given time need not end with the last release
        final = k == stops
        if status != TIME_REACHED or (final and drops.gravity[row] > 0.0):
            return fault
        stop = drops.until[row] if final else drops.stops[row, k] * out[END]
        status = RUNNING
        while status == RUNNING:
            stack.counter[LOG_ROWS] = 0
            status = advance_contacts(
                stack, stop / unit, drops.limit[row], WORK_LIMIT, log, samples
            )
        if status == TIME_REACHED:
            energy, _ = energy_at(stack, stop / unit)
            if not energy - before <= allowed:
                fault |= GAINS_IN_BETWEEN
            before = min(before, energy)
    same = status == out[STATUS] and stack.counter[EVENTS] == out[EVENT_COUNT]
    for b in range(len(stack.mass)):
        same = same and velocity_at(stack, b, out[END] / unit) / unit == out[COLUMNS + b]
    return fault if same else fault | SPLIT_DIFFERS


@kernel
def read(log: Any, lines: int, turns: Any, out: Any) -> int:
    """Count the touches in a part of a log, and return what is wrong with it."""
    fault = 0
    size = len(turns) // 2
    for line in range(lines):
        at = line * LOG_COLUMNS
        i = int(log[at + codes.CONTACT])
        for column in range(LOG_COLUMNS):
            if math.isnan(log[at + column]):
                fault |= BAD_NUMBER
        if log[at + codes.KIND] == codes.JOINED:
            continue
        if log[at + codes.KIND] == codes.COLLISION:
            out[COLUMNS + size + i] += 1.0
        else:
            touches = log[at + codes.KIND] == codes.TOUCH
            if touches == (turns[2 * i] == 1.0):
                fault |= OUT_OF_TURN
            turns[2 * i] = 1.0 if touches else 0.0
            out[COLUMNS + size + i] += turns[2 * i]
        if log[at + codes.TIME] < turns[2 * i + 1] or log[at + codes.START] > log[at + codes.TIME]:
            fault |= OUT_OF_ORDER
        turns[2 * i + 1] = log[at + codes.TIME]
    return fault


@kernel
def energy_at(stack: Any, time: float) -> Any:
    """Return the energy at a time and the sizes of the terms it is made of."""
    total, terms, position = 0.0, 0.0, 0.0
    for b in range(len(stack.mass)):
        compression = compression_at(stack, b, time)
        velocity = velocity_at(stack, b, time)
        position -= compression
        kinetic = 0.5 * stack.mass[b] * velocity * velocity
        height = stack.mass[b] * stack.number[GRAVITY] * position
        stored = 0.0
        if stack.law[b] != codes.ABSENT:
            stored = held_energy(stack, b, compression, creep_at(stack, b, time))
        total += kinetic + height + stored
        terms += kinetic + abs(height) + stored
    return total, terms


@kernel
def last_faults(stack: Any, drops: Any, row: int, loose: float, out: Any) -> int:
    """Return what is wrong with the last velocities in ``out``."""
    fault, size = 0, len(stack.mass)
    fastest, before, after, momentum = 0.0, 0.0, 0.0, 0.0
    for b in range(size):
        velocity = out[COLUMNS + b]
        if not math.isfinite(velocity):
            fault |= BAD_NUMBER
        fastest = max(fastest, abs(velocity), abs(drops.velocity[row, b]))
        before += stack.mass[b] * drops.velocity[row, b]
        after += stack.mass[b] * velocity
        momentum += stack.mass[b] * max(abs(velocity), abs(drops.velocity[row, b]))
    out[MOMENTUM] = 0.0
    if drops.law[row, 0] == NONE and drops.gravity[row] == 0.0:
        out[MOMENTUM] = abs(after - before) / momentum
        if out[MOMENTUM] > _SHAKE * (10.0 + out[EVENT_COUNT]):
            fault |= LOSES_MOMENTUM
    out[APPROACH] = 0.0
    if out[STATUS] == FINISHED or out[STATUS] == codes.COLLAPSED:
        for i in range(size):
            below = out[COLUMNS + i - 1] if i > 0 else 0.0
            rate = below - out[COLUMNS + i] if drops.law[row, i] != NONE else 0.0
            out[APPROACH] = max(out[APPROACH], rate / fastest)
        if out[APPROACH] > loose:
            fault |= APPROACHES
    return fault


@kernel
def run_rigid(
    stack: Any, room: Any, drops: Any, row: int, samples: Any, log: Any, turns: Any, out: Any
) -> None:
    """Run one drop of rigid balls and write into ``out`` what is found."""
    clear_arrays(room[0], room[1])
    prepare_rigid(stack, drops, row)
    begin_collisions(stack)
    first, reference = rigid_energy(stack, drops, row, 0.0)
    fault, status = 0, RUNNING
    while status == RUNNING:
        stack.counter[LOG_ROWS] = 0
        status = collide_all(stack, drops.until[row], drops.limit[row], log, samples)
        fault |= read(log, stack.counter[LOG_ROWS], turns, out)
    end = end_of_run(stack.clock, status, drops.until[row])
    last, terms = rigid_energy(stack, drops, row, end)
    for b in range(len(stack.mass)):
        out[COLUMNS + b] = rigid_velocity(stack, b, end)
    out[STATUS], out[EVENT_COUNT], out[END] = status, stack.counter[EVENTS], end
    out[ENERGY] = (last - first) / (reference + terms)
    if not out[ENERGY] <= _ROUND * (1.0 + 0.1 * stack.counter[EVENTS]):
        fault |= GAINS_ENERGY
    if status == codes.INVALID:
        fault |= IS_INVALID
    out[FAULT] = fault | last_faults(stack, drops, row, _ROUND, out)


@kernel
def rigid_energy(stack: Any, drops: Any, row: int, time: float) -> Any:
    """Return the energy of rigid balls at a time and the sizes of the terms it is made of."""
    total, terms, position = 0.0, 0.0, 0.0
    for b in range(len(stack.mass)):
        velocity = rigid_velocity(stack, b, time)
        if drops.gravity[row] > 0.0:
            position -= (
                compression_after(stack, b, time - stack.clock[LAST_EVENT]) * stack.number[UNIT]
            )
        kinetic = 0.5 * stack.mass[b] * velocity * velocity
        height = stack.mass[b] * drops.gravity[row] * position
        total += kinetic + height
        terms += kinetic + abs(height)
    return total, terms


@kernel
def run_all(
    stack: Any, room: Any, drops: Any, samples: Any, log: Any, turns: Any, out: Any
) -> None:
    """Run all drops of a batch."""
    for row in range(len(out)):
        run(stack, room, drops, row, samples, log, turns[row], out[row])


@kernel
def run_all_rigid(
    stack: Any, room: Any, drops: Any, samples: Any, log: Any, turns: Any, out: Any
) -> None:
    """Run all drops of a batch of rigid stacks."""
    for row in range(len(out)):
        run_rigid(stack, room, drops, row, samples, log, turns[row], out[row])
