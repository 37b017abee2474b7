"""How rigid balls come to rest under gravity.

A ball without a closing rate rests on the floor, or on a ball at rest. With losses, coming to rest
takes infinitely many bounces. On the floor alone, their total duration from a bounce at which the
ball leaves with the speed u is

    2 u/g (1 + e + e^2 + ...) = 2 u / (g (1 - e)),

and the bounces are computed until this duration is negligible. If the loss d = 1 - e is
proportional to v^p, d becomes d (1 - d)^p from one bounce to the next, and the duration is

    2 u/g S(d),    S(d) = 1 + (1 - d) S(d (1 - d)^p).

For p below 1 it is finite, at most 2 u/(g (1 - p) d), and S has the expansion of `_sum_of_bounces`.
As d vanishes with u, the bounces become short much more slowly than with a constant e: they are
computed until the expansion is exact and their height negligible. For p of 1 or above, and with a
restitution that is 1 for slow collisions, the ball bounces for ever.

No formula is known for several balls that bounce on each other while they come to rest. They count
as resting as soon as none of them would fly for more than a negligible time, if a contact among or
below them loses energy.
"""

import math

from stackbounce.engine import slots
from stackbounce.engine.codes import ABSENT, RIGID_LOSS
from stackbounce.engine.flight import (
    anchor_balls,
    anchor_contacts,
    change_rate,
    compression_after,
    schedule_collision,
    velocity_after,
)
from stackbounce.engine.kernels import kernel
from stackbounce.engine.restitution import loss_at, settling_loss
from stackbounce.engine.stack import RigidStack

NEGLIGIBLE_TIME = 1e-12  # longest duration of collisions left out, over the time elapsed
_NEGLIGIBLE_FLIGHT = 1e-13  # longest flight left out, over the time elapsed times (1 - e)
_LOW = 1e-6  # of the impact speed: bounces at lower speeds are left out if their sum is known


@kernel
def settle(stack: RigidStack, until: float) -> None:
    """Find the balls that have come to rest, the lowest first, and set them at rest."""
    if stack.number[slots.GRAVITY] == 0.0 or stack.law[0] == ABSENT:
        return
    while stack.counter[slots.BALLS_AT_REST] < len(stack.mass):
        low = stack.counter[slots.BALLS_AT_REST]
        if stack.anchor[low] != stack.now[0] or stack.compression[low] < 0.0:
            return
        if abs(stack.rate[low]) <= stack.rate_noise[low]:
            _set_at_rest(stack, low, low)
        elif low > 0 or not _finish_bouncing(stack, until):
            high = _highest_settling(stack, low)
            if high < low:
                return
            for i in range(high + 1):
                stack.infinite[i] = 1
            _set_at_rest(stack, low, high)


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
def _set_at_rest(stack: RigidStack, low: int, high: int) -> None:
    """Set the balls low..high at rest now, each on the ball below it or on the floor."""
    anchor_contacts(stack, low, high + 1)
    anchor_balls(stack, high, high + 1)
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
    stack.counter[slots.BALLS_AT_REST] = high + 1
    for i in range(low, high + 1):
        schedule_collision(stack, i)
    if high + 1 < len(stack.mass):
        stack.compression[high + 1] -= max(height, 0.0)
        change_rate(stack, high + 1, faster)
        stack.rate_noise[high + 1] = max(stack.rate_noise[high + 1], noise)
        schedule_collision(stack, high + 1)


@kernel
def _finish_bouncing(stack: RigidStack, until: float) -> bool:
    """Advance ball 0 to the end of its bounces on the floor, if they end before any other event.

    This is done only if what is left out is negligible. Returns whether it was done.
    """
    gravity, speed = stack.number[slots.GRAVITY], -stack.rate[0]
    if speed < 0.0:
        return False
    flight = 2.0 * speed / gravity
    duration = _time_to_rest(stack, speed, flight)
    if stack.number[slots.LAST_EVENT] + duration > until:
        return False
    if earliest_other(stack, 0) <= stack.now[0] + duration:
        return False
    if len(stack.mass) > 1 and duration > 0.0:
        # ball 1 must be above ball 0's apexes at both ends of its parabola from the second
        # bounce on
        gap, velocity = -compression_after(stack, 1, 0.0), velocity_after(stack, 1, 0.0)
        e = 1.0 - loss_at(stack, 0, speed)
        apex = 0.25 * e * e * speed  # divided by the duration of the first flight
        if gap / flight + velocity - speed <= apex:
            return False
        part = flight / duration
        if gap / duration + velocity - speed / part <= apex * part:
            return False
        height = gap + (velocity - 0.5 * gravity * duration) * duration
        anchor_balls(stack, 1, 1)
        stack.velocity[1] -= gravity * duration
        stack.rate[1] = -stack.velocity[1]
        stack.compression[1] = -height
        stack.since[1] = stack.now[0] + duration
        stack.anchor[1] = stack.now[0] + duration
    stack.number[slots.LAST_EVENT] += duration
    stack.now[0] += duration
    stack.compression[0] = 0.0
    stack.rate[0] = 0.0
    stack.anchor[0] = stack.now[0]
    stack.velocity[0] = 0.0
    stack.since[0] = stack.now[0]
    stack.infinite[0] = 1
    _set_at_rest(stack, 0, 0)
    return True


@kernel
def _time_to_rest(stack: RigidStack, speed: float, flight: float) -> float:
    """Return how long ball 0, which leaves the floor at a speed for a flight, bounces from now on.

    The time is infinite while the bounces are not negligible and have to be computed.
    """
    share = settling_loss(stack, 0, speed)
    if share == 0.0:
        return math.inf
    negligible = NEGLIGIBLE_TIME * stack.number[slots.LAST_EVENT]
    if flight / share <= negligible:
        return flight / share
    if stack.law[0] == RIGID_LOSS and stack.scatter[0] == 0.0:
        loss = loss_at(stack, 0, speed)
        slow = speed * stack.number[slots.UNIT] <= _LOW * stack.number[slots.SPEED]
        if slow and flight * loss * loss * loss <= negligible:
            return flight * _sum_of_bounces(loss, stack.exponent[0])
    return math.inf


@kernel
def _sum_of_bounces(loss: float, p: float) -> float:
    """Return the duration of all bounces over that of the first; the loss goes with v^p, p < 1.

    The error of this expansion of S(d) is below d^3/6.
    """
    slope = -p * (p + 1.0) * (3.0 * p + 2.0) / (24.0 * (2.0 * p + 1.0))
    return 1.0 / ((1.0 - p) * loss) - 0.5 * p + loss * (-p / 6.0 + loss * slope)


@kernel
def _highest_settling(stack: RigidStack, low: int) -> int:
    """Return the highest ball from ``low`` up that comes to rest within a negligible time.

    Negligible means short compared with the time elapsed. If the next ball above arrives soon, the
    time must also be short compared with the time until then, or the speeds small compared with the
    speed of that ball. The result is less than ``low`` if there is no such ball, or if no contact
    loses energy. Ball 0 alone on a lossy floor is left to `_finish_bouncing`, which is exact.
    """
    lossy = stack.counter[slots.LOWEST_LOSSY]
    if lossy == len(stack.mass):
        return low - 1
    gravity = stack.number[slots.GRAVITY]
    height, longest, high = 0.0, 0.0, low - 1
    for i in range(low, len(stack.mass)):
        height += max(0.0, -compression_after(stack, i, 0.0))
        speed = abs(velocity_after(stack, i, 0.0))
        fall = (speed + math.sqrt(speed * speed + 2.0 * gravity * height)) / gravity
        longest = max(longest, fall)
        part = _NEGLIGIBLE_FLIGHT * settling_loss(stack, lossy, gravity * longest)
        limit = part * stack.number[slots.LAST_EVENT]
        if longest > limit:
            break
        alone = True
        if i + 1 < len(stack.mass):
            quiet = stack.due[i + 1] - stack.now[0]
            alone = quiet > limit or longest <= part * max(quiet, stack.rate[i + 1] / gravity)
        if alone:
            high = i
    return high if high >= max(lossy, 1) else low - 1
