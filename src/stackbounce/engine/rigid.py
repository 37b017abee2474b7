"""Sequences of instantaneous collisions (eqs 1 to 4), event by event, for any number of balls.

The earliest collision comes first; of several at the same time, that of the lowest approaching
contact. If more than two contacts close at the same time the outcome depends on this rule.
"""

import math

from stackbounce.engine import codes, slots
from stackbounce.engine.collapse import find_collapse, keep_state
from stackbounce.engine.event_queue import clear_queue
from stackbounce.engine.flight import (
    acceleration,
    anchor_balls,
    anchor_contacts,
    change_rate,
    closing_rate,
    compression_after,
    rate_now,
    schedule_collision,
    velocity_after,
    wake,
)
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.log import append_row
from stackbounce.engine.restitution import loses_energy, next_restitution
from stackbounce.engine.settling import earliest_other, settle
from stackbounce.engine.stack import RigidStack, Samples

_ROWS = 5  # rows of the log that one collision can fill
_EXTREME = 1e8  # from here on, a ratio of masses explains that a run meets a limit
_SMALL = 2.0**-600  # slower speeds are scaled up by its inverse: only ratios matter


@kernel
def begin_collisions(stack: RigidStack) -> None:
    """Set up a new rigid stack and schedule its first collisions."""
    size = len(stack.mass)
    stack.counter[slots.KEEP_AFTER] = 1
    stack.counter[slots.LOWEST_LOSSY] = size
    clear_queue(stack.due, stack.heap, stack.place)
    for i in range(size):
        speed = abs(stack.velocity[i]) * stack.number[slots.UNIT]
        stack.number[slots.SPEED] = max(stack.number[slots.SPEED], speed)
        below = stack.velocity[i - 1] if i > 0 else 0.0
        stack.rate[i] = below - stack.velocity[i]
        if loses_energy(stack, i):
            stack.counter[slots.LOWEST_LOSSY] = min(stack.counter[slots.LOWEST_LOSSY], i)
        schedule_collision(stack, i)
    keep_state(stack, -1, 0.0)
    settle(stack, math.inf)


@kernel
def collide_all(
    stack: RigidStack, until: float, event_limit: int, log: Floats, samples: Samples
) -> int:
    """Follow the collisions until none is left or a time or a limit is reached.

    Fills ``samples`` on the way and returns the status; counter[LOG_ROWS] is the length of the log.
    The status is RUNNING if the log is full: the caller continues.
    """
    room = len(log) // codes.LOG_COLUMNS
    while True:
        contact = stack.heap[0]
        wait = max(0.0, stack.due[contact] - stack.now[0])
        time = stack.number[slots.LAST_EVENT] + wait
        if math.isnan(time):
            return codes.INVALID
        if _is_over(stack, until):
            _record_samples(stack, samples, math.inf)
            return _final_status(stack)
        _record_samples(stack, samples, min(time, until))
        if time > until:
            return codes.TIME_REACHED
        if time == math.inf:
            return _final_status(stack)
        if stack.counter[slots.EVENTS] >= event_limit:
            stack.counter[slots.CAUSE] = _cause_of_limit(stack)
            return codes.EVENT_LIMIT
        if stack.counter[slots.LOG_ROWS] + _ROWS > room:
            return codes.RUNNING
        stack.now[0] += wait
        stack.number[slots.LAST_EVENT] = time
        _collide(stack, contact, log)
        find_collapse(stack, contact, until, log)
        settle(stack, until)
        _keep_in_range(stack)


@kernel
def rigid_velocity(stack: RigidStack, b: int, time: float) -> float:
    """Return the velocity of ball b in m/s at a time after the last collision."""
    later = time - stack.number[slots.LAST_EVENT]
    return velocity_after(stack, b, later) * stack.number[slots.UNIT]


@kernel
def _is_over(stack: RigidStack, until: float) -> bool:
    """Return whether a run under gravity is over.

    It is over if all balls rest or, without an end time, if no contact closes any more.
    """
    if stack.counter[slots.BALLS_AT_REST] == len(stack.mass):
        return True
    if stack.number[slots.GRAVITY] == 0.0 or until < math.inf:
        return False
    contact = stack.counter[slots.BALLS_AT_REST]
    noise = stack.rate_noise[contact]
    if stack.law[contact] != codes.ABSENT and rate_now(stack, contact) > noise:
        return False
    return earliest_other(stack, contact) == math.inf


@kernel
def _cause_of_limit(stack: RigidStack) -> int:
    """Return the code of why a run has met a limit."""
    lightest, heaviest = math.inf, 0.0
    for mass in stack.mass:
        lightest, heaviest = min(lightest, mass), max(heaviest, mass)
    return codes.EXTREME if heaviest > _EXTREME * lightest else codes.ENDLESS


@kernel
def _final_status(stack: RigidStack) -> int:
    """Return the status of a sequence without further collisions."""
    for velocity in stack.velocity:
        if not math.isfinite(velocity):
            return codes.INVALID
    if stack.counter[slots.BALLS_AT_REST] == len(stack.mass):
        return codes.SETTLED
    for infinite in stack.infinite:
        if infinite == 1:
            return codes.COLLAPSED
    return codes.FINISHED


@kernel
def _anchor_colliding(stack: RigidStack, i: int) -> float:
    """Anchor now the balls and contacts that a collision of contact i affects.

    Returns the closing rate of contact i.
    """
    if acceleration(stack, i) > 0.0:
        stack.rate[i] = closing_rate(stack, i)
        stack.velocity[i] = -stack.rate[i]
        stack.anchor[i] = stack.now[0]
        stack.since[i] = stack.now[0]
    anchor_contacts(stack, i - 1, i + 1)
    anchor_balls(stack, i - 2, i + 1)
    if i > 0:
        wake(stack, i - 1)
    return stack.rate[i]


@kernel
def _collide(stack: RigidStack, i: int, log: Floats) -> None:
    """Reverse the closing rate of contact i times its restitution, and log the collision.

    The heavier ball's velocity changes by the smaller increment; the lighter one's is that velocity
    plus the reversed rate, so that errors of the relative velocity do not accumulate.
    """
    rate = _anchor_colliding(stack, i)
    e = next_restitution(stack, i, rate)
    stack.hits[i] += 1
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
        schedule_collision(stack, j)
    factor, time = stack.number[slots.UNIT], stack.number[slots.LAST_EVENT]
    below, above = lower_velocity * factor, stack.velocity[i] * factor
    at = append_row(log, stack.counter, codes.COLLISION, i, time, time, below, above)
    log[at + codes.PEAK_FORCE] = math.inf
    log[at + codes.PEAK_TIME] = time
    log[at + codes.IMPULSE] = impulse * factor
    stack.counter[slots.EVENTS] += 1


@kernel
def _keep_in_range(stack: RigidStack) -> None:
    """Multiply all speeds and gaps by one factor if all balls are very slow, to avoid underflow.

    Times do not change. Under gravity nothing is scaled.
    """
    if stack.number[slots.GRAVITY] > 0.0:
        return
    for velocity in stack.velocity:
        if velocity == 0.0 or abs(velocity) > _SMALL:
            return
    for i in range(len(stack.mass)):
        stack.velocity[i] /= _SMALL
        stack.rate[i] /= _SMALL
        stack.rate_noise[i] /= _SMALL
        stack.compression[i] /= _SMALL
    stack.number[slots.UNIT] *= _SMALL
    keep_state(stack, -1, stack.number[slots.LAST_EVENT])


@kernel
def _record_samples(stack: RigidStack, samples: Samples, time: float) -> None:
    """Record every ball and contact at the sample times up to a time."""
    size = len(stack.mass)
    factor = stack.number[slots.UNIT]
    while (
        stack.counter[slots.NEXT_SAMPLE] < len(samples.time)
        and samples.time[stack.counter[slots.NEXT_SAMPLE]] <= time
    ):
        moment = samples.time[stack.counter[slots.NEXT_SAMPLE]]
        later = moment - stack.number[slots.LAST_EVENT]
        at = stack.counter[slots.NEXT_SAMPLE] * size
        position = 0.0
        for i in range(size):
            compression = compression_after(stack, i, later) * factor
            if stack.number[slots.LAST_EVENT] + (stack.due[i] - stack.now[0]) == moment:
                compression = 0.0
            position -= compression
            samples.position[at + i] = position
            samples.velocity[at + i] = velocity_after(stack, i, later) * factor
            samples.compression[at + i] = compression
        stack.counter[slots.NEXT_SAMPLE] += 1
