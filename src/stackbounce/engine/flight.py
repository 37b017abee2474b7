"""Rigid balls between their collisions: straight lines and parabolas.

Gravity moves all flying balls alike, so that the gap between two of them changes at a steady rate.
The lowest balls may lie at rest on the floor, each on the one below it. One contact alone closes
with the acceleration of gravity: the lowest that is not at rest, between the highest ball at rest
(or the floor) and the lowest ball in flight. Its gap g follows

    g(t) = g - r t - a t^2/2,    closes after    2 g / (r + sqrt(r^2 + 2 a g)),

and at the rate sqrt(r^2 + 2 a g), with the closing rate r at the start.

Each contact (rate and compression) and each ball (velocity) is anchored at a local time of its own,
so that a collision touches nothing but its neighbours. The origin of local time is moved on
whenever a wait is so short against it that digits of the wait would be lost.
"""

import math

from stackbounce.engine.codes import ABSENT, EPSILON
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.kernel import kernel
from stackbounce.engine.stack import RigidStack

_ALIKE = 8.0  # speeds up to so many times their difference give it with all its digits
_LATE = 256.0  # waits that local time exceeds by this factor call for a new origin


@kernel
def approach(stack: RigidStack, i: int) -> float:
    """Return the rate at which contact i closes, 0 where it opens or rests within round-off."""
    if stack.law[i] == ABSENT:
        return 0.0
    return stack.rate[i] if stack.rate[i] > stack.rate_noise[i] else 0.0


@kernel
def acceleration(stack: RigidStack, i: int) -> float:
    """Return the acceleration at which contact i closes."""
    return stack.number[3] if i == stack.resting[0] else 0.0


@kernel
def rate_after(stack: RigidStack, i: int, later: float) -> float:
    """Return the rate at which contact i closes some time from now."""
    return stack.rate[i] + acceleration(stack, i) * (stack.now[0] - stack.anchor[i] + later)


@kernel
def compression_after(stack: RigidStack, i: int, later: float) -> float:
    """Return minus the gap of contact i some time from now."""
    elapsed = stack.now[0] - stack.anchor[i] + later
    mean = stack.rate[i] + 0.5 * acceleration(stack, i) * elapsed
    return stack.compression[i] + mean * elapsed


@kernel
def velocity_after(stack: RigidStack, b: int, later: float) -> float:
    """Return the velocity of ball b some time from now."""
    if b < stack.resting[0]:
        return stack.velocity[b]
    return stack.velocity[b] - stack.number[3] * (stack.now[0] - stack.since[b] + later)


@kernel
def bring_contacts(stack: RigidStack, low: int, high: int) -> None:
    """Anchor the contacts low..high now, as far as there are such."""
    for i in range(max(low, 0), min(high + 1, len(stack.mass))):
        compression = compression_after(stack, i, 0.0)
        stack.rate[i] = rate_after(stack, i, 0.0)
        stack.compression[i] = compression
        stack.anchor[i] = stack.now[0]


@kernel
def bring_balls(stack: RigidStack, low: int, high: int) -> None:
    """Anchor the balls low..high now, as far as there are such."""
    for b in range(max(low, 0), min(high + 1, len(stack.mass))):
        stack.velocity[b] = velocity_after(stack, b, 0.0)
        stack.since[b] = stack.now[0]


@kernel
def closing_time(stack: RigidStack, i: int, rate: float) -> float:
    """Return how long contact i, anchored now, takes to close at a steady rate."""
    if rate <= 0.0:
        return math.inf
    return max(0.0, -stack.compression[i] / rate)


@kernel
def closing_rate(stack: RigidStack, i: int) -> float:
    """Return the rate at which a contact that closes with acceleration will have closed."""
    gap, rate = -stack.compression[i], stack.rate[i]
    if gap <= 0.0:
        return abs(rate)
    return math.sqrt(rate * rate + 2.0 * acceleration(stack, i) * gap)


@kernel
def plan(stack: RigidStack, i: int) -> None:
    """Set the time of the next collision of contact i, which is anchored now."""
    wait = closing_time(stack, i, approach(stack, i))
    pull = acceleration(stack, i)
    if pull > 0.0 and stack.law[i] != ABSENT:
        gap, rate, last = max(0.0, -stack.compression[i]), stack.rate[i], closing_rate(stack, i)
        wait = 2.0 * gap / (rate + last) if rate > 0.0 else (last - rate) / pull
    if wait > 0.0 and wait * _LATE < stack.now[0]:
        _move_origin(stack)
    schedule(stack.due, stack.heap, stack.place, i, stack.now[0] + wait)


@kernel
def _move_origin(stack: RigidStack) -> None:
    """Count local time from now on."""
    now = stack.now[0]
    for i in range(len(stack.mass)):
        stack.anchor[i] -= now
        stack.since[i] -= now
        stack.due[i] -= now  # all by the same: the queue keeps its order
    stack.now[0] = 0.0


@kernel
def change_rate(stack: RigidStack, i: int, change: float) -> None:
    """Let contact i close faster, by a change that the velocities of its balls hold already.

    Their difference is the better number, except where both are far faster than they part or meet.
    Contact and balls are anchored now.
    """
    largest = max(abs(stack.rate[i]), abs(change))
    below = stack.velocity[i - 1] if i > 0 else 0.0
    above = stack.velocity[i]
    stack.rate_noise[i] = 64.0 * EPSILON * largest
    if max(abs(below), abs(above)) <= _ALIKE * largest:
        stack.rate[i] = below - above
    else:
        stack.rate[i] += change


@kernel
def wake(stack: RigidStack, b: int) -> None:
    """Let ball b, and those above it, be at rest no longer; its contact is still to be planned."""
    top = stack.resting[0]
    if b >= top:
        return
    if top < len(stack.mass):
        bring_contacts(stack, top, top)
    stack.resting[0] = b
    for i in range(b, top):
        stack.since[i] = stack.now[0]
        stack.anchor[i] = stack.now[0]
    if top < len(stack.mass):
        plan(stack, top)
