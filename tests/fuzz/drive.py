"""Kernels that load random drops into one stack's arrays, run them, and check what came out."""

import math
from typing import Any

import numpy as np

from draw import (
    DASHPOT,
    HUNT_CROSSLEY,
    HYSTERETIC,
    LOSSY,
    NONE,
    STOPS,
    VISCOELASTIC,
    Drops,
)
from stackbounce.engine.codes import (
    ABSENT,
    COLLAPSED,
    CONTACT,
    DAMPED,
    EPSILON,
    FINISHED,
    INVALID,
    KIND,
    LOG_COLUMNS,
    OPEN,
    POWER,
    RELEASE,
    RUNNING,
    TIME,
    TIME_REACHED,
    TOUCH,
)
from stackbounce.engine.codes import HYSTERETIC as ENGINE_HYSTERETIC
from stackbounce.engine.codes import LOSSY as ENGINE_LOSSY
from stackbounce.engine.contacts import stored_energy
from stackbounce.engine.kernel import kernel
from stackbounce.engine.motion import compression_at, velocity_at
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.series import ORDER
from stackbounce.engine.simultaneous import advance, start
from stackbounce.simulate import _FAINT, _FAINTEST, _LEAST_ORDER, _ROUND_OFF, _STEP

# what can be wrong with a run, as bits
BAD_NUMBER, GAINS_ENERGY, LOSES_MOMENTUM, OUT_OF_TURN, OUT_OF_ORDER = 1, 2, 4, 8, 16
STILL_CLOSED, APPROACHES, GAINS_IN_BETWEEN, SPLIT_DIFFERS, IS_INVALID = 32, 64, 128, 256, 512
FAULTS = {
    BAD_NUMBER: "a number that is not finite",
    GAINS_ENERGY: "energy rises",
    LOSES_MOMENTUM: "momentum is not conserved",
    OUT_OF_TURN: "touch and release do not alternate",
    OUT_OF_ORDER: "events of a contact go back in time",
    STILL_CLOSED: "finished with a closed contact",
    APPROACHES: "finished while a contact approaches",
    GAINS_IN_BETWEEN: "energy rises in between",
    SPLIT_DIFFERS: "a run stopped in between ends otherwise",
    IS_INVALID: "invalid",
}
STATUS, EVENT_COUNT, END, ENERGY, MOMENTUM, APPROACH, FAULT = range(7)
COLUMNS = 7  # of what is found, before the balls' velocities and the contacts' counts
_LOOSE = 10.0  # times rtol: a rise of the energy, or a rate of approach
_ROUND = 1e-12  # and more than that of the first energy
_SHAKE = 64.0 * EPSILON  # of the largest momentum, per event


@kernel
def load(stack: Any, drops: Drops, row: int) -> None:
    """Put one drop into a stack's arrays, as `simulate` does, and clear its state."""
    size = len(stack.mass)
    speed = 0.0
    for i in range(size):
        speed = max(speed, abs(drops.velocity[row, i]))
    tolerance = max(_STEP * drops.rtol[row], _ROUND_OFF)
    stack.number[0] = drops.gravity[row]
    stack.number[1] = speed
    stack.number[2] = tolerance
    stack.number[3] = max(tolerance * _FAINT, _FAINTEST)
    order = int(round(1.0 - 0.5 * math.log(tolerance)))
    stack.setting[0] = min(ORDER, max(_LEAST_ORDER, order))
    stack.setting[1] = 0
    for i in range(size):
        _load_contact(stack, drops, row, i)
        mass = drops.mass[row, i]
        stack.mass[i] = mass
        stack.velocity[i] = drops.velocity[row, i]
        stack.velocity_noise[i] = 0.0
        stack.compression[i] = -drops.gap[row, i] if i > 0 else 0.0
        if i > 0:
            mass = drops.mass[row, i - 1] * mass / (drops.mass[row, i - 1] + mass)
        power = 1.0 / (stack.exponent[i] + 1.0)
        energy = 0.5 * (stack.exponent[i] + 1.0) * mass / stack.stiffness[i]
        stack.scale[i] = energy**power * speed ** (2.0 * power)
        if stack.unloading[i] != 1.0 or stack.factor_exponent[i] != 0.0:
            stack.setting[1] = 1
    for k in range(len(stack.counter)):
        stack.counter[k] = 0
    stack.clock[0] = 0.0
    stack.clock[1] = 0.0


@kernel
def _load_contact(stack: Any, drops: Drops, row: int, i: int) -> None:
    law, extra, p = drops.law[row, i], drops.extra[row, i], drops.exponent[row, i]
    stack.law[i] = POWER
    stack.stiffness[i] = drops.stiffness[row, i]
    stack.exponent[i] = p
    stack.unloading[i] = p
    stack.factor_exponent[i] = 0.0
    stack.gain_constant[i] = 0.0
    stack.gain_slope[i] = 0.0
    stack.gain_rate[i] = 0.0
    if law == NONE:
        stack.law[i] = ABSENT
        stack.stiffness[i] = 1.0
        stack.exponent[i] = 1.0
        stack.unloading[i] = 1.0
    elif law == HYSTERETIC or law == LOSSY:
        stack.law[i] = ENGINE_LOSSY if law == LOSSY else ENGINE_HYSTERETIC
        stack.unloading[i] = extra
    elif law == DASHPOT:
        stack.law[i] = DAMPED
        stack.gain_slope[i] = 1.0
        stack.gain_rate[i] = extra / stack.stiffness[i]
    elif law == VISCOELASTIC:
        stack.law[i] = DAMPED
        stack.factor_exponent[i] = 0.5
        stack.gain_slope[i] = 1.0
        stack.gain_rate[i] = 1.5 * extra
    elif law == HUNT_CROSSLEY:
        stack.law[i] = DAMPED
        stack.factor_exponent[i] = p
        stack.gain_constant[i] = 1.0
        stack.gain_rate[i] = extra


@kernel
def load_rigid(stack: Any, drops: Drops, row: int) -> None:
    """Put one drop of rigid balls into a stack's arrays and clear its state."""
    for i in range(len(stack.mass)):
        stack.mass[i] = drops.mass[row, i]
        stack.law[i] = ABSENT if drops.law[row, i] == NONE else POWER
        stack.restitution[i] = 0.0 if drops.law[row, i] == NONE else drops.extra[row, i]
        stack.velocity[i] = drops.velocity[row, i]
        stack.compression[i] = -drops.gap[row, i] if i > 0 else 0.0
        stack.rate_noise[i] = 0.0
        stack.infinite[i] = 0
        stack.last_hit[i] = 0
    for k in range(3):
        stack.number[k] = 0.0
        stack.memory[k] = 0
    for k in range(len(stack.counter)):
        stack.counter[k] = 0
    stack.clock[0] = 0.0
    stack.clock[1] = 0.0


@kernel
def run(stack: Any, drops: Drops, row: int, samples: Any, log: Any, turns: Any, out: Any) -> None:
    """Run one drop of finite contacts and write into ``out`` what is found."""
    size = len(stack.mass)
    load(stack, drops, row)
    start(stack)
    first, reference = energy_at(stack, 0.0)
    begin_turns(turns)
    status, fault = _go_on(stack, drops, row, samples, log, turns, out)
    end = _time_of(stack, status, drops.until[row])
    last, round_off = energy_at(stack, end)
    allowed = _LOOSE * drops.rtol[row] + _ROUND
    out[ENERGY] = (last - first - _ROUND * round_off) / reference
    if not out[ENERGY] <= allowed:
        fault |= GAINS_ENERGY
    out[STATUS], out[EVENT_COUNT], out[END] = status, stack.counter[1], end
    for b in range(size):
        out[COLUMNS + b] = velocity_at(stack, b, end)
    out[FAULT] = fault | common_faults(stack, drops, row, allowed, out)
    if status == FINISHED:
        for i in range(size):
            if stack.phase[i] != OPEN:
                out[FAULT] = int(out[FAULT]) | STILL_CLOSED
    if drops.stops[row, STOPS - 1] > 0.0 and end > 0.0:
        out[FAULT] = int(out[FAULT]) | _in_parts(
            stack, drops, row, samples, log, first, allowed * reference, out
        )


@kernel
def _in_parts(
    stack: Any,
    drops: Drops,
    row: int,
    samples: Any,
    log: Any,
    first: float,
    allowed: float,
    out: Any,
) -> int:
    """Run a drop again, stopping in between: no rise of energy, the same end."""
    fault = 0
    load(stack, drops, row)
    start(stack)
    status = RUNNING
    for k in range(STOPS):
        stop = drops.stops[row, k] * out[END]
        status = RUNNING
        while status == RUNNING:
            stack.counter[0] = 0
            status = advance(stack, stop, drops.limit[row], log, samples)
        if status != TIME_REACHED:
            break
        energy, round_off = energy_at(stack, stop)
        if not energy - first <= allowed + _ROUND * round_off:
            fault |= GAINS_IN_BETWEEN
        first = min(first, energy)
    if drops.gravity[row] > 0.0:
        return fault  # it need not end with the same release
    while status == RUNNING or status == TIME_REACHED:
        stack.counter[0] = 0
        status = advance(stack, drops.until[row], drops.limit[row], log, samples)
        if status == TIME_REACHED:
            break
    same = status == out[STATUS] and stack.counter[1] == out[EVENT_COUNT]
    for b in range(len(stack.mass)):
        same = same and velocity_at(stack, b, out[END]) == out[COLUMNS + b]
    return fault if same else fault | SPLIT_DIFFERS


@kernel
def _go_on(
    stack: Any, drops: Drops, row: int, samples: Any, log: Any, turns: Any, out: Any
) -> Any:
    """Advance to the end, checking the log; return the status and what was wrong with the log."""
    fault = 0
    size = len(stack.mass)
    for i in range(size):
        out[COLUMNS + size + i] = 0.0
    while True:
        stack.counter[0] = 0
        status = advance(stack, drops.until[row], drops.limit[row], log, samples)
        for line in range(stack.counter[0]):
            at = line * LOG_COLUMNS
            i = int(log[at + CONTACT])
            touches = log[at + KIND] == TOUCH
            for column in range(LOG_COLUMNS):
                if not math.isfinite(log[at + column]):
                    fault |= BAD_NUMBER
            if touches == (turns[2 * i] == 1.0) or not (touches or log[at + KIND] == RELEASE):
                fault |= OUT_OF_TURN
            if log[at + TIME] < turns[2 * i + 1]:
                fault |= OUT_OF_ORDER
            turns[2 * i] = 1.0 if touches else 0.0
            turns[2 * i + 1] = log[at + TIME]
            out[COLUMNS + size + i] += 1.0 if touches else 0.0
        if status != RUNNING:
            return status, fault


@kernel
def _time_of(stack: Any, status: int, until: float) -> float:
    if status == FINISHED:
        return float(stack.clock[0])
    return until if status == TIME_REACHED else float(max(stack.clock[0], stack.clock[1]))


@kernel
def begin_turns(turns: Any) -> None:
    """Let every contact be open and without an event."""
    for k in range(len(turns)):
        turns[k] = 0.0


@kernel
def energy_at(stack: Any, time: float) -> Any:
    """Return the energy at a time and the sizes of the terms it is made of."""
    total, terms, position = 0.0, 0.0, 0.0
    for b in range(len(stack.mass)):
        compression = compression_at(stack, b, time)
        velocity = velocity_at(stack, b, time)
        position -= compression
        kinetic = 0.5 * stack.mass[b] * velocity * velocity
        height = stack.mass[b] * stack.number[0] * position
        stored = stored_energy(stack, b, compression) if stack.law[b] != ABSENT else 0.0
        total += kinetic + height + stored
        terms += kinetic + abs(height) + stored
    return total, terms


@kernel
def common_faults(stack: Any, drops: Drops, row: int, loose: float, out: Any) -> int:
    """Return what is wrong with the last velocities in ``out``."""
    fault = 0
    size = len(stack.mass)
    fastest, before, after, momentum = 0.0, 0.0, 0.0, 0.0
    if out[STATUS] == INVALID:
        fault |= IS_INVALID
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
    if out[STATUS] == FINISHED or out[STATUS] == COLLAPSED:
        for i in range(size):
            below = out[COLUMNS + i - 1] if i > 0 else 0.0
            rate = below - out[COLUMNS + i] if drops.law[row, i] != NONE else 0.0
            out[APPROACH] = max(out[APPROACH], rate / fastest)
        if out[APPROACH] > loose:
            fault |= APPROACHES
    return fault


@kernel
def run_rigid(stack: Any, drops: Drops, row: int, samples: Any, log: Any, out: Any) -> None:
    """Run one drop of rigid balls and write into ``out`` what is found."""
    size = len(stack.mass)
    load_rigid(stack, drops, row)
    begin_collisions(stack)
    fault, status, before = 0, RUNNING, 0.0
    for i in range(size):
        out[COLUMNS + size + i] = 0.0
    while status == RUNNING:
        stack.counter[0] = 0
        status = collide_all(stack, drops.until[row], drops.limit[row], log, samples)
        for line in range(stack.counter[0]):
            at = line * LOG_COLUMNS
            out[COLUMNS + size + int(log[at + CONTACT])] += 1.0
            if not math.isfinite(log[at + TIME]):
                fault |= BAD_NUMBER
            if log[at + TIME] < before:
                fault |= OUT_OF_ORDER
            before = log[at + TIME]
    first, last = 0.0, 0.0
    end = stack.clock[0]
    for b in range(size):
        velocity = rigid_velocity(stack, b, end)
        out[COLUMNS + b] = velocity
        first += stack.mass[b] * drops.velocity[row, b] * drops.velocity[row, b]
        last += stack.mass[b] * velocity * velocity
    out[STATUS], out[EVENT_COUNT], out[END] = status, stack.counter[1], end
    out[ENERGY] = last / first - 1.0
    if not out[ENERGY] <= _ROUND:
        fault |= GAINS_ENERGY
    out[FAULT] = fault | common_faults(stack, drops, row, _ROUND, out)


@kernel
def run_all(stack: Any, drops: Drops, samples: Any, log: Any, out: np.ndarray) -> None:
    """Run all drops of a batch."""
    turns = np.zeros(2 * len(stack.mass))
    for row in range(len(out)):
        run(stack, drops, row, samples, log, turns, out[row])


@kernel
def run_all_rigid(stack: Any, drops: Drops, samples: Any, log: Any, out: np.ndarray) -> None:
    """Run all drops of a batch of rigid stacks."""
    for row in range(len(out)):
        run_rigid(stack, drops, row, samples, log, out[row])
