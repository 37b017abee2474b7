"""Sequences of instantaneous collisions (eqs 1 to 4), event by event, for any number of balls.

The earliest collision comes first; of several at once that of the lowest approaching contact, and
where more than two contacts close at once the outcome depends on this rule.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    COLLAPSED,
    COLLISION,
    CONTACT,
    EVENT_LIMIT,
    FINISHED,
    IMPULSE,
    INVALID,
    KIND,
    LOG_COLUMNS,
    LOWER_VELOCITY,
    PEAK_COMPRESSION,
    PEAK_FORCE,
    RUNNING,
    SETTLED,
    START,
    TIME,
    TIME_REACHED,
    UPPER_VELOCITY,
)
from stackbounce.engine.collapse import find_collapse, remember
from stackbounce.engine.event_queue import clear
from stackbounce.engine.flight import (
    acceleration,
    bring_balls,
    bring_contacts,
    change_rate,
    closing_rate,
    compression_after,
    plan,
    rate_after,
    velocity_after,
    wake,
)
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.settling import earliest_other, settle
from stackbounce.engine.stack import RigidStack, Samples

_ROWS = 5  # of the log, that one collision can fill
_SMALL = 2.0**-600  # speeds below this are scaled up by its inverse: only ratios count


@kernel
def begin_collisions(stack: RigidStack) -> None:
    """Prepare a new rigid stack for its first collision."""
    size = len(stack.mass)
    stack.memory[1] = 1
    stack.resting[1] = size
    clear(stack.due, stack.heap, stack.place)
    for i in range(size):
        stack.number[2] = max(stack.number[2], abs(stack.velocity[i]) * stack.number[0])
        below = stack.velocity[i - 1] if i > 0 else 0.0
        stack.rate[i] = below - stack.velocity[i]
        if stack.law[i] != ABSENT and stack.restitution[i] < 1.0:
            stack.resting[1] = min(stack.resting[1], i)
        plan(stack, i)
    remember(stack, -1, 0.0)
    settle(stack, math.inf)


@kernel
def collide_all(
    stack: RigidStack, until: float, event_limit: int, log: Floats, samples: Samples
) -> int:
    """Follow the collisions until none is left, a time or a limit is reached, or the log is full.

    Fills ``samples`` on the way and returns the status; counter[0] tells the entries in the log.
    """
    room = len(log) // LOG_COLUMNS
    while True:
        contact = stack.heap[0]
        wait = max(0.0, stack.due[contact] - stack.now[0])
        time = stack.clock[0] + wait
        if math.isnan(time):
            return INVALID
        if _over(stack, until):
            _sample(stack, samples, math.inf)
            return _ending(stack)
        _sample(stack, samples, min(time, until))
        if time > until:
            return TIME_REACHED
        if time == math.inf:
            return _ending(stack)
        if stack.counter[1] >= event_limit:
            return EVENT_LIMIT
        if stack.counter[0] + _ROWS > room:
            return RUNNING
        stack.now[0] += wait
        stack.clock[0] = time
        _collide(stack, contact, log)
        find_collapse(stack, contact, until, log)
        settle(stack, until)
        _keep_in_range(stack)


@kernel
def rigid_velocity(stack: RigidStack, b: int, time: float) -> float:
    """Return the velocity of ball b at a time from the last collision on."""
    return velocity_after(stack, b, time - stack.clock[0]) * stack.number[0]


@kernel
def _over(stack: RigidStack, until: float) -> bool:
    """Tell, with gravity, whether all balls rest or, if no time is given, none approaches."""
    if stack.resting[0] == len(stack.mass):
        return True
    if stack.number[3] == 0.0 or until < math.inf:
        return False
    contact = stack.resting[0]
    noise = stack.rate_noise[contact]
    if stack.law[contact] != ABSENT and rate_after(stack, contact, 0.0) > noise:
        return False
    return earliest_other(stack, contact) == math.inf


@kernel
def _ending(stack: RigidStack) -> int:
    """Return how a sequence without further collisions has ended."""
    for velocity in stack.velocity:
        if not math.isfinite(velocity):
            return INVALID
    if stack.resting[0] == len(stack.mass):
        return SETTLED
    for infinite in stack.infinite:
        if infinite == 1:
            return COLLAPSED
    return FINISHED


@kernel
def _meet(stack: RigidStack, i: int) -> float:
    """Anchor what a collision of contact i concerns; return the rate at which it has closed."""
    if acceleration(stack, i) > 0.0:
        stack.rate[i] = closing_rate(stack, i)
        stack.velocity[i] = -stack.rate[i]
        stack.anchor[i] = stack.now[0]
        stack.since[i] = stack.now[0]
    bring_contacts(stack, i - 1, i + 1)
    bring_balls(stack, i - 2, i + 1)
    if i > 0:
        wake(stack, i - 1)
    return stack.rate[i]


@kernel
def _collide(stack: RigidStack, i: int, log: Floats) -> None:
    """Reverse the closing rate of contact i times its restitution, and log it.

    The heavier ball's velocity changes by the small increment; the lighter one's is then the
    heavier one's plus the reversed rate, so that no error of the relative velocity builds up.
    """
    e = stack.restitution[i]
    rate = _meet(stack, i)
    lower, upper = stack.mass[i - 1] if i > 0 else math.inf, stack.mass[i]
    up = (1.0 + e) * rate * (1.0 / (1.0 + upper / lower))
    down = (1.0 + e) * rate * (1.0 / (1.0 + lower / upper))
    impulse = up * upper
    lower_velocity = 0.0
    if i == 0:
        stack.velocity[0] = e * rate
    elif upper >= lower:
        stack.velocity[i] += up
        stack.velocity[i - 1] = stack.velocity[i] - e * rate
    else:
        stack.velocity[i - 1] -= down
        stack.velocity[i] = stack.velocity[i - 1] + e * rate
    stack.rate[i] = -e * rate
    stack.rate_noise[i] *= e
    if i > 0:
        lower_velocity = stack.velocity[i - 1]
        change_rate(stack, i - 1, down)
    if i + 1 < len(stack.mass):
        change_rate(stack, i + 1, up)
    stack.compression[i] = 0.0
    for j in range(max(i - 1, 0), min(i + 2, len(stack.mass))):
        plan(stack, j)
    factor = stack.number[0]
    at = stack.counter[0] * LOG_COLUMNS
    log[at + TIME] = stack.clock[0]
    log[at + CONTACT] = i
    log[at + KIND] = COLLISION
    log[at + LOWER_VELOCITY] = lower_velocity * factor
    log[at + UPPER_VELOCITY] = stack.velocity[i] * factor
    log[at + START] = stack.clock[0]
    log[at + PEAK_FORCE] = math.inf
    log[at + PEAK_COMPRESSION] = 0.0
    log[at + IMPULSE] = impulse * factor
    stack.counter[0] += 1
    stack.counter[1] += 1


@kernel
def _keep_in_range(stack: RigidStack) -> None:
    """Scale speeds and gaps up together, which leaves all times, once every ball is slow."""
    if stack.number[3] > 0.0:
        return
    for velocity in stack.velocity:
        if velocity == 0.0 or abs(velocity) > _SMALL:
            return
    for i in range(len(stack.mass)):
        stack.velocity[i] /= _SMALL
        stack.rate[i] /= _SMALL
        stack.rate_noise[i] /= _SMALL
        stack.compression[i] /= _SMALL
    stack.number[0] *= _SMALL
    remember(stack, -1, stack.clock[0])


@kernel
def _sample(stack: RigidStack, samples: Samples, time: float) -> None:
    """Record every ball and contact at the sample times up to a time."""
    size = len(stack.mass)
    factor = stack.number[0]
    while stack.counter[3] < len(samples.time) and samples.time[stack.counter[3]] <= time:
        moment = samples.time[stack.counter[3]]
        later = moment - stack.clock[0]
        at = stack.counter[3] * size
        position = 0.0
        for i in range(size):
            compression = compression_after(stack, i, later) * factor
            if stack.clock[0] + (stack.due[i] - stack.now[0]) == moment:
                compression = 0.0
            position -= compression
            samples.position[at + i] = position
            samples.velocity[at + i] = velocity_after(stack, i, later) * factor
            samples.compression[at + i] = compression
        stack.counter[3] += 1
