"""How rigid balls come to rest under gravity.

A ball that has no closing rate left on a floor, or on a ball at rest, rests there. With losses this
takes infinitely many bounces. On the floor alone they take, from one at which the ball leaves at
the speed u, all together

    2 u/g (1 + e + e^2 + ...) = 2 u / (g (1 - e)),

and are followed until this is negligible. Several balls that bounce on each other on their way to
rest follow no known law: they rest once even the highest of them takes a negligible time to fall,
if a contact among them or below them loses energy.
"""

import math

from stackbounce.engine.codes import ABSENT
from stackbounce.engine.flight import (
    bring_balls,
    bring_contacts,
    change_rate,
    compression_after,
    plan,
    velocity_after,
)
from stackbounce.engine.kernel import kernel
from stackbounce.engine.stack import RigidStack

NO_TIME = 1e-12  # of the time so far: infinitely many collisions that take no longer are over
_NO_FLIGHT = 1e-13  # of the time so far, and of what a collision loses: a flight that is none


@kernel
def settle(stack: RigidStack, until: float) -> None:
    """Lay down the balls that rest from now on, the lowest first."""
    if stack.number[3] == 0.0 or stack.law[0] == ABSENT:
        return
    while stack.resting[0] < len(stack.mass):
        low = stack.resting[0]
        if stack.anchor[low] != stack.now[0] or stack.compression[low] < 0.0:
            return
        if abs(stack.rate[low]) <= stack.rate_noise[low]:
            _lay_down(stack, low, low)
        elif low > 0 or not _bounce_to_the_end(stack, until):
            high = _faint(stack, low)
            if high < low:
                return
            for i in range(high + 1):
                stack.infinite[i] = 1
            _lay_down(stack, low, high)


@kernel
def earliest_other(stack: RigidStack, i: int) -> float:
    """Return the earliest time at which a contact other than i is due."""
    if stack.heap[0] != i:
        return stack.due[stack.heap[0]]
    time = math.inf
    for at in range(1, min(3, len(stack.heap))):
        time = min(time, stack.due[stack.heap[at]])
    return time


@kernel
def _lay_down(stack: RigidStack, low: int, high: int) -> None:
    """Let the balls low..high rest from now on, on those at rest already or on the floor."""
    bring_contacts(stack, low, high + 1)
    bring_balls(stack, high, high + 1)
    faster = -stack.velocity[high]
    noise, height = 0.0, 0.0
    for i in range(low, high + 1):
        height -= stack.compression[i]
        noise = max(noise, stack.rate_noise[i])
        stack.compression[i] = 0.0
        stack.rate[i] = 0.0
        stack.rate_noise[i] = 0.0
        stack.velocity[i] = 0.0
        stack.since[i] = stack.now[0]
    stack.resting[0] = high + 1
    for i in range(low, high + 1):
        plan(stack, i)
    if high + 1 < len(stack.mass):
        stack.compression[high + 1] -= max(height, 0.0)
        change_rate(stack, high + 1, faster)
        stack.rate_noise[high + 1] = max(stack.rate_noise[high + 1], noise)
        plan(stack, high + 1)


@kernel
def _bounce_to_the_end(stack: RigidStack, until: float) -> bool:
    """Let ball 0, just off the floor, make all its bounces if they are over before anything else.

    Tells whether it did.
    """
    gravity, e, speed = stack.number[3], stack.restitution[0], -stack.rate[0]
    if e == 1.0 or speed < 0.0:
        return False
    flight = 2.0 * speed / gravity
    duration = flight / (1.0 - e)
    if duration > NO_TIME * stack.clock[0] or stack.clock[0] + duration > until:
        return False
    if earliest_other(stack, 0) <= stack.now[0] + duration:
        return False
    if len(stack.mass) > 1 and duration > 0.0:
        # from the second bounce on, a parabola: it is above the lower ball's apex at both ends
        gap, velocity = -compression_after(stack, 1, 0.0), velocity_after(stack, 1, 0.0)
        apex = 0.25 * e * e * speed  # over the duration of the first flight
        if gap / flight + velocity - speed <= apex:
            return False
        if gap / duration + velocity - speed / (1.0 - e) <= apex * (1.0 - e):
            return False
        height = gap + (velocity - 0.5 * gravity * duration) * duration
        bring_balls(stack, 1, 1)
        stack.velocity[1] -= gravity * duration
        stack.rate[1] = -stack.velocity[1]
        stack.compression[1] = -height
        stack.since[1] = stack.now[0] + duration
        stack.anchor[1] = stack.now[0] + duration
    stack.clock[0] += duration
    stack.now[0] += duration
    stack.compression[0] = 0.0
    stack.rate[0] = 0.0
    stack.anchor[0] = stack.now[0]
    stack.velocity[0] = 0.0
    stack.since[0] = stack.now[0]
    stack.infinite[0] = 1
    _lay_down(stack, 0, 0)
    return True


@kernel
def _faint(stack: RigidStack, low: int) -> int:
    """Return the highest of the balls from ``low`` up that rest after a negligible time.

    Negligible against the time so far, but where the next ball meets them soon, against the time
    until then, or in speed against that ball. It is less than ``low`` where there is none, and
    where no contact loses energy. Ball 0 alone on a floor that does is left to its exact limit.
    """
    lossy = stack.resting[1]
    if lossy == len(stack.mass):
        return low - 1
    gravity = stack.number[3]
    part = _NO_FLIGHT * (1.0 - stack.restitution[lossy])
    limit = part * stack.clock[0]
    height, longest, high = 0.0, 0.0, low - 1
    for i in range(low, len(stack.mass)):
        height += max(0.0, -compression_after(stack, i, 0.0))
        speed = abs(velocity_after(stack, i, 0.0))
        fall = (speed + math.sqrt(speed * speed + 2.0 * gravity * height)) / gravity
        longest = max(longest, fall)
        if longest > limit:
            break
        alone = True
        if i + 1 < len(stack.mass):
            quiet = stack.due[i + 1] - stack.now[0]
            alone = quiet > limit or longest <= part * max(quiet, stack.rate[i + 1] / gravity)
        if alone:
            high = i
    return high if high >= max(lossy, 1) else low - 1
