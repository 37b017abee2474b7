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
    EPSILON,
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
    START,
    TIME,
    TIME_REACHED,
    UPPER_VELOCITY,
)
from stackbounce.engine.collapse import (
    approach,
    common_velocity,
    pair_ends,
    remember,
    repeats,
    vanished,
)
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.stack import RigidStack, Samples

_NO_TIME = 1e-12  # of the time so far: infinitely many collisions that take no longer are over
_ALIKE = 8.0  # speeds up to so many times their difference give it with all its digits
_SMALL = 2.0**-600  # speeds below this are scaled up by its inverse: only ratios count


@kernel
def begin_collisions(stack: RigidStack) -> None:
    """Prepare a new rigid stack for its first collision."""
    stack.number[0] = 1.0
    stack.memory[1] = 1
    for i in range(len(stack.mass)):
        stack.number[2] = max(stack.number[2], abs(stack.velocity[i]))
        below = stack.velocity[i - 1] if i > 0 else 0.0
        stack.rate[i] = below - stack.velocity[i]
    remember(stack, -1, 0.0)


@kernel
def collide_all(
    stack: RigidStack, until: float, event_limit: int, log: Floats, samples: Samples
) -> int:
    """Follow the collisions until none is left, a time or a limit is reached, or the log is full.

    Fills ``samples`` on the way and returns the status; counter[0] tells the entries in the log.
    """
    room = len(log) // LOG_COLUMNS
    while True:
        contact, wait = _next_collision(stack)
        time = stack.clock[0] + wait
        _sample(stack, samples, min(time, until))
        if time > until:
            return TIME_REACHED
        if contact < 0:
            return _ending(stack)
        if stack.counter[1] >= event_limit:
            return EVENT_LIMIT
        if stack.counter[0] == room:
            return RUNNING
        _fly(stack, wait)
        stack.clock[0] = time
        _collide(stack, contact, log)
        _find_collapse(stack, contact)
        _keep_in_range(stack)


@kernel
def rigid_velocity(stack: RigidStack, b: int, _time: float) -> float:
    """Return the velocity of ball b, which has not changed since the last collision."""
    return stack.velocity[b] * stack.number[0]


@kernel
def _ending(stack: RigidStack) -> int:
    """Return how a sequence without further collisions has ended."""
    for velocity in stack.velocity:
        if not math.isfinite(velocity):
            return INVALID
    for infinite in stack.infinite:
        if infinite == 1:
            return COLLAPSED
    return FINISHED


@kernel
def _next_collision(stack: RigidStack) -> tuple[int, float]:
    """Return the contact that collides next and how long that takes; -1 and infinity for none."""
    contact, least = -1, math.inf
    for i in range(len(stack.mass)):
        wait = _wait(stack, i, approach(stack, i))
        if wait < least:
            contact, least = i, wait
    return contact, least


@kernel
def _wait(stack: RigidStack, i: int, rate: float) -> float:
    """Return how long contact i takes to close at a rate."""
    if rate <= 0.0:
        return math.inf
    return max(0.0, -stack.compression[i] / rate)


@kernel
def _fly(stack: RigidStack, duration: float) -> None:
    """Let all balls fly for a time."""
    if duration > 0.0:
        for i in range(len(stack.mass)):
            stack.compression[i] += stack.rate[i] * duration


@kernel
def _collide(stack: RigidStack, i: int, log: Floats) -> None:
    """Reverse the closing rate of contact i times its restitution, and log it.

    The heavier ball's velocity changes by the small increment; the lighter one's is then the
    heavier one's plus the reversed rate, so that no error of the relative velocity builds up.
    """
    e = stack.restitution[i]
    rate = stack.rate[i]
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
    if i > 0:
        lower_velocity = stack.velocity[i - 1]
        _change_rate(stack, i - 1, down)
    if i + 1 < len(stack.mass):
        _change_rate(stack, i + 1, up)
    stack.compression[i] = 0.0
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
def _change_rate(stack: RigidStack, i: int, change: float) -> None:
    """Let contact i close faster, by a change that the velocities of its balls hold already.

    Their difference is the better number, except where both are far faster than they part or meet.
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
def _find_collapse(stack: RigidStack, contact: int) -> None:
    """Finish infinitely many collisions with their limit, where theory finds that they have begun.

    While their rest still takes time that can be told from none, the next of them is followed.
    """
    soon = _NO_TIME * stack.clock[0]
    for other in (contact - 1, contact + 1):
        if 0 <= other < len(stack.mass):
            duration = pair_ends(stack, contact, other)
            if duration <= soon:
                _merge(stack, min(contact, other), max(contact, other), duration)
    stack.last_hit[contact] = stack.counter[1]
    low, high = vanished(stack, contact)
    if low < high:
        _merge(stack, low, high, 0.0)
    stack.involved[contact] = 1
    stack.memory[2] += 1
    low, high, shrink = repeats(stack, contact)
    if shrink != 0.0:
        # the rounds to come last shrink, shrink^2, ... times the one just over
        ratio = max(shrink, 0.0)
        round_time = stack.clock[0] - stack.number[1]
        if ratio < 1.0 and round_time * ratio / (1.0 - ratio) <= soon:
            _merge(stack, low, high, round_time * ratio / (1.0 - ratio))
    if stack.memory[2] >= stack.memory[1]:
        remember(stack, contact, stack.clock[0])


@kernel
def _merge(stack: RigidStack, low: int, high: int, duration: float) -> None:
    """Let the balls at contacts low..high come together, unless another ball meets them before.

    The outer balls of the group move between their present velocities and the common one; with no
    floor among them their centre of mass moves on, and all end there.
    """
    velocity = common_velocity(stack, low, high)
    size = len(stack.mass)
    outer_below, outer_above = 0.0, 0.0
    if low > 0:
        outer_below = stack.velocity[low - 2] if low > 1 else 0.0
        rate = outer_below - min(velocity, stack.velocity[low - 1])
        if stack.law[low - 1] != ABSENT and _wait(stack, low - 1, rate) <= duration:
            return
    if high + 1 < size:
        outer_above = stack.velocity[high + 1]
        rate = max(velocity, stack.velocity[high]) - outer_above
        if _wait(stack, high + 1, rate) < duration:
            return
    centre, mass = 0.0, stack.mass[low - 1] if low > 0 else math.inf
    height = 0.0
    for i in range(low, high + 1):
        height -= stack.compression[i]
        centre += stack.mass[i] * height
        mass += stack.mass[i]
        stack.infinite[i] = 1
        stack.involved[i] = 1
    travel = centre / mass + velocity * duration
    _fly(stack, duration)
    if low > 0:
        flown = stack.velocity[low - 1] * duration
        stack.compression[low - 1] += flown - travel
    if high + 1 < size:
        flown = stack.velocity[high] * duration
        stack.compression[high + 1] += travel - height - flown
    slower = stack.velocity[low - 1] - velocity if low > 0 else 0.0
    faster = velocity - stack.velocity[high]
    for i in range(low, high + 1):
        stack.compression[i] = 0.0
        stack.rate[i] = 0.0
        stack.rate_noise[i] = 0.0
    for b in range(max(low - 1, 0), high + 1):
        stack.velocity[b] = velocity
    if low > 0:
        _change_rate(stack, low - 1, slower)
    if high + 1 < size:
        _change_rate(stack, high + 1, faster)
    stack.clock[0] += duration


@kernel
def _keep_in_range(stack: RigidStack) -> None:
    """Scale speeds and gaps up together, which leaves all times, once every ball is slow."""
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
        now = samples.time[stack.counter[3]]
        at = stack.counter[3] * size
        position = 0.0
        for i in range(size):
            travel = stack.rate[i] * (now - stack.clock[0])
            gap = (stack.compression[i] + travel) * factor
            position -= gap
            samples.position[at + i] = position
            samples.velocity[at + i] = stack.velocity[i] * factor
            samples.compression[at + i] = gap
        stack.counter[3] += 1
