"""The motion of rigid balls between collisions: straight lines and parabolas.

Gravity accelerates all flying balls alike, so that the gap between two of them changes at a
constant rate. The lowest balls may be at rest, on the floor and on each other. Only one contact
closes with the acceleration of gravity: the lowest that is not at rest, between the highest ball at
rest (or the floor) and the lowest ball in flight. Its gap g follows

    g(t) = g - r t - a t^2/2,    closes after    2 g / (r + sqrt(r^2 + 2 a g)),

with the closing rate r at the start and sqrt(r^2 + 2 a g) at the end.

The arrays hold each ball's velocity, and each contact's rate and compression, at a local time of
its own, the *anchor*. A collision therefore updates its neighbours only. If the wait for the next
event would lose digits when it is added to the local time, the origin of local time is shifted.
"""

import math

from stackbounce.engine.codes import ABSENT, EPSILON
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.kernels import kernel
from stackbounce.engine.slots import BALLS_AT_REST, GRAVITY
from stackbounce.engine.stack import RigidStack

_ALIKE = 8.0  # times a difference of speeds: up to this they give it to all digits
_LATE = 256.0  # times a wait: a later local time gets a new origin


@kernel
def approach_rate(stack: RigidStack, i: int) -> float:
    """Return the rate at which contact i closes; 0 if it opens or is at rest within round-off."""
    if stack.law[i] == ABSENT:
        return 0.0
    return stack.rate[i] if stack.rate[i] > stack.rate_noise[i] else 0.0


@kernel
def acceleration(stack: RigidStack, i: int) -> float:
    """Return the acceleration at which contact i closes."""
    return stack.number[GRAVITY] if i == stack.counter[BALLS_AT_REST] else 0.0


@kernel
def rate_now(stack: RigidStack, i: int) -> float:
    """Return the closing rate of contact i."""
    return stack.rate[i] + acceleration(stack, i) * (stack.now[0] - stack.anchor[i])


@kernel
def compression_after(stack: RigidStack, i: int, later: float) -> float:
    """Return the compression of contact i (minus its gap) at a time after now."""
    elapsed = stack.now[0] - stack.anchor[i] + later
    mean = stack.rate[i] + 0.5 * acceleration(stack, i) * elapsed
    return stack.compression[i] + mean * elapsed


@kernel
def velocity_after(stack: RigidStack, b: int, later: float) -> float:
    """Return the velocity of ball b at a time after now."""
    if b < stack.counter[BALLS_AT_REST]:
        return stack.velocity[b]
    return stack.velocity[b] - stack.number[GRAVITY] * (stack.now[0] - stack.since[b] + later)


@kernel
def anchor_contacts(stack: RigidStack, low: int, high: int) -> None:
    """Anchor the existing contacts among low..high now."""
    for i in range(max(low, 0), min(high + 1, len(stack.mass))):
        compression = compression_after(stack, i, 0.0)
        stack.rate[i] = rate_now(stack, i)
        stack.compression[i] = compression
        stack.anchor[i] = stack.now[0]


@kernel
def anchor_balls(stack: RigidStack, low: int, high: int) -> None:
    """Anchor the existing balls among low..high now."""
    for b in range(max(low, 0), min(high + 1, len(stack.mass))):
        stack.velocity[b] = velocity_after(stack, b, 0.0)
        stack.since[b] = stack.now[0]


@kernel
def closing_time(stack: RigidStack, i: int, rate: float) -> float:
    """Return the time that contact i, anchored now, takes to close at a constant rate."""
    if rate <= 0.0:
        return math.inf
    return max(0.0, -stack.compression[i] / rate)


@kernel
def closing_rate(stack: RigidStack, i: int) -> float:
    """Return the rate of an accelerated contact at the moment at which it closes."""
    gap, rate = -stack.compression[i], stack.rate[i]
    if gap <= 0.0:
        return abs(rate)
    return math.sqrt(rate * rate + 2.0 * acceleration(stack, i) * gap)


@kernel
def schedule_collision(stack: RigidStack, i: int) -> None:
    """Set the time of the next collision of contact i, which is anchored now."""
    wait = closing_time(stack, i, approach_rate(stack, i))
    pull = acceleration(stack, i)
    if pull > 0.0 and stack.law[i] != ABSENT:
        gap, rate, last = max(0.0, -stack.compression[i]), stack.rate[i], closing_rate(stack, i)
        wait = 2.0 * gap / (rate + last) if rate > 0.0 else (last - rate) / pull
    if is_late(stack.now[0], wait):
        _move_origin(stack)
    schedule(stack.due, stack.heap, stack.place, i, stack.now[0] + wait)


@kernel
def is_late(now: float, wait: float) -> bool:
    """Return whether local time needs a new origin before an event that it is to wait for."""
    return wait > 0.0 and wait * _LATE < now


@kernel
def _move_origin(stack: RigidStack) -> None:
    """Shift the origin of local time to the present, which does not change the queue's order."""
    now = stack.now[0]
    for i in range(len(stack.mass)):
        stack.anchor[i] -= now
        stack.since[i] -= now
        stack.due[i] -= now  # by the same amount: the order of the queue stays
    stack.now[0] = 0.0


@kernel
def change_rate(stack: RigidStack, i: int, change: float) -> None:
    """Update the closing rate of contact i after a change of the velocities of its balls.

    The rate becomes the difference of the velocities. If these are much larger than the rate,
    cancellation would lose digits, and ``change`` is added to the old rate instead. Contact and
    balls must be anchored now.
    """
    below = stack.velocity[i - 1] if i > 0 else 0.0
    rate, noise = rate_after(stack.rate[i], change, below, stack.velocity[i])
    stack.rate[i], stack.rate_noise[i] = rate, noise


@kernel
def rate_after(rate: float, change: float, below: float, above: float) -> tuple[float, float]:
    """Return the closing rate after a change, see `change_rate`, and its round-off."""
    largest = max(abs(rate), abs(change))
    alike = max(abs(below), abs(above)) <= _ALIKE * largest
    return below - above if alike else rate + change, 64.0 * EPSILON * largest


@kernel
def wake(stack: RigidStack, b: int) -> None:
    """Set ball b and all resting balls above it in motion again; the caller schedules contact b."""
    top = stack.counter[BALLS_AT_REST]
    if b >= top:
        return
    if top < len(stack.mass):
        anchor_contacts(stack, top, top)
    stack.counter[BALLS_AT_REST] = b
    for i in range(b, top):
        stack.since[i] = stack.now[0]
        stack.anchor[i] = stack.now[0]
    if top < len(stack.mass):
        schedule_collision(stack, top)
