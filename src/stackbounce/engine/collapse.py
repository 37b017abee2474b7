"""Infinitely many collisions in a finite time (inelastic collapse), detected by theory.

Two neighbouring contacts. Let x and y be the rates at which contacts 1 and 2 close, right after a
collision at contact 1 (so x <= 0), and e1 and e2 their restitutions. A collision at 1 adds a x to
the rate of 2, one at 2 adds b y to that of 1: a = (1+e1) m_lower/(m_lower+m_middle) and
b = (1+e2) m_upper/(m_middle+m_upper), with a floor as an infinite mass. A round (a collision at 2,
then one at 1) maps x to -e1 (x + b y) and y to -e2 y + a (x + b y); this map has the determinant
e1 e2 and the trace a b - e1 - e2. The rounds go on for ever exactly if the eigenvalues are real and
positive,

    a b >= (sqrt(e1) + sqrt(e2))^2,

and the first state lies on the right side of the eigenvector of the smaller eigenvalue. For a floor
and two balls the condition is m2/m1 >= (sqrt(e1)+sqrt(e2))^2 / (1-sqrt(e1 e2))^2. Gaps shrink as
e1 e2 x_n/x_(n+1), so that the durations of all rounds sum to b g / (x (1 + weaker/e1) + b y), where
g is the gap at contact 2 and weaker is the smaller eigenvalue.

More contacts. No condition is known. A state in which all rates and gaps have the same ratios as in
an earlier one, on a smaller scale, repeats for ever; Brent's cycle detection finds it among the
rates and gaps of the contacts involved. A sequence that is not periodic is followed until its rates
come close to underflow, and is then taken to be infinite.

A restitution that varies with the speed. Where it tends to 1 for slow collisions there is no
collapse: the condition above fails for
e1 = e2 = 1. Neither criterion is applied to such a contact, nor to one that scatters, whose rounds
are not alike. Their collisions are computed one by one, if need be until their rates come close to
underflow.
"""

import math

from stackbounce.engine import codes, slots
from stackbounce.engine.flight import (
    acceleration,
    anchor_balls,
    anchor_contacts,
    approach_rate,
    change_rate,
    closing_time,
    compression_after,
    rate_now,
    schedule_collision,
    wake,
)
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.log import append_row
from stackbounce.engine.restitution import varies
from stackbounce.engine.settling import NEGLIGIBLE_TIME
from stackbounce.engine.stack import RigidStack

_SAME, _SAME_GAPS = 1e-12, 1e-9  # rates, and gaps, are proportional if ratios agree to this
_BUSY = 200  # times the number of balls: the most recent collisions that define a group
_VANISHED = 1e-250  # of the impact speed: rates below this are close to underflow


@kernel
def find_collapse(stack: RigidStack, contact: int, until: float, log: Floats) -> None:
    """Jump to the end of an inelastic collapse if one has begun and its rest is negligibly short.

    The criteria are those of the module's docstring. While the remaining duration is not
    negligible, nothing is replaced and the collisions are computed one by one, until the rates of
    the two contacts come close to underflow: next to the threshold the duration of a round hardly
    shrinks, though the rates do.
    """
    left = until - stack.number[slots.LAST_EVENT]
    soon = min(NEGLIGIBLE_TIME * stack.number[slots.LAST_EVENT], left)
    for other in (contact - 1, contact + 1):
        if 0 <= other < len(stack.mass):
            duration = pair_duration(stack, contact, other)
            certain = duration < math.inf and duration <= left
            if duration <= soon or (certain and _are_still(stack, contact, other)):
                _merge(stack, min(contact, other), max(contact, other), duration, log)
    stack.last_hit[contact] = stack.counter[slots.EVENTS]
    low, high = vanished_group(stack, contact)
    if low < high:
        _merge(stack, low, high, 0.0, log)
    _mark_involved(stack, contact, contact)
    stack.counter[slots.SINCE_KEPT] += 1
    low, high = stack.counter[slots.LOWEST_INVOLVED], stack.counter[slots.HIGHEST_INVOLVED]
    ratio = _compare_with_kept(stack, contact, low, high)
    if ratio < 1.0:  # later rounds last ratio, ratio^2, ... times the present one
        round_time = stack.number[slots.LAST_EVENT] - stack.number[slots.KEPT_TIME]
        duration = round_time * ratio / (1.0 - ratio)
        if duration <= soon:
            _merge(stack, low, high, duration, log)
    if stack.counter[slots.SINCE_KEPT] >= stack.counter[slots.KEEP_AFTER]:
        keep_state(stack, contact, stack.number[slots.LAST_EVENT])


@kernel
def _merge(stack: RigidStack, low: int, high: int, duration: float, log: Floats) -> None:
    """Let the balls at contacts low..high collapse: they touch and have one common velocity.

    Nothing changes if another ball could reach the group before the collapse ends. This check
    assumes that the velocities of the outer balls stay between their present values and the common
    velocity. Without the floor, all balls of the group end at its centre of mass.
    """
    anchor_contacts(stack, low - 1, high + 1)
    anchor_balls(stack, low - 2, high + 1)
    velocity, lower_gain, upper_gain = common_velocity(stack, low, high)
    size = len(stack.mass)
    pull = stack.number[slots.GRAVITY] * duration
    lands = pull if low == 0 else 0.0
    if low > 0:
        below = stack.velocity[low - 2] if low > 1 else 0.0
        rate = below - min(velocity, stack.velocity[low - 1])
        rate += acceleration(stack, low - 1) * duration
        if stack.law[low - 1] != codes.ABSENT and closing_time(stack, low - 1, rate) <= duration:
            return
    if high + 1 < size:
        rate = max(velocity, stack.velocity[high]) - stack.velocity[high + 1] + lands
        if closing_time(stack, high + 1, rate) < duration:
            return
    wake(stack, max(low - 1, 0))
    centre, mass = 0.0, stack.mass[low - 1] if low > 0 else math.inf
    height = 0.0
    for i in range(low, high + 1):
        height -= stack.compression[i]
        centre += stack.mass[i] * height
        mass += stack.mass[i]
        stack.infinite[i] = 1
        stack.last_hit[i] = stack.counter[slots.EVENTS]
    _mark_involved(stack, low, high)
    travel = centre / mass + velocity * duration
    below = stack.velocity[low - 1] if low > 0 else 0.0
    above = stack.velocity[high]
    stack.number[slots.LAST_EVENT] += duration
    stack.now[0] += duration
    anchor_contacts(stack, low - 1, high + 1)
    anchor_balls(stack, low - 2, high + 1)
    for i in range(low, high + 1):
        stack.compression[i] = 0.0
        stack.rate[i] = 0.0
        stack.rate_noise[i] = 0.0
    for b in range(max(low - 1, 0), high + 1):
        stack.velocity[b] = velocity - pull + lands
    if low > 0:
        stack.compression[low - 1] += below * duration - travel
        change_rate(stack, low - 1, -lower_gain)
    if high + 1 < size:
        stack.compression[high + 1] += travel - height - above * duration
        change_rate(stack, high + 1, upper_gain + lands)
    for i in range(max(low - 1, 0), min(high + 2, size)):
        schedule_collision(stack, i)
    time, after = stack.number[slots.LAST_EVENT], stack.velocity[high] * stack.number[slots.UNIT]
    append_row(log, stack.counter, codes.JOINED, low, high, time, 0.0, after)


@kernel
def _mark_involved(stack: RigidStack, low: int, high: int) -> None:
    """Mark contacts low..high as having collided since the reference state; see `keep_state`."""
    for i in range(low, high + 1):
        stack.involved[i] = 1
    stack.counter[slots.LOWEST_INVOLVED] = min(stack.counter[slots.LOWEST_INVOLVED], low)
    stack.counter[slots.HIGHEST_INVOLVED] = max(stack.counter[slots.HIGHEST_INVOLVED], high)


@kernel
def mass_share(stack: RigidStack, i: int, ball: int) -> float:
    """Return the mass of ball's partner at contact i over the mass of both; 1 at the floor.

    It is the share of a change of the closing rate that ``ball`` takes.
    """
    if i == 0:
        return 1.0
    total = stack.mass[i - 1] + stack.mass[i]
    return (stack.mass[i - 1] if ball == i else stack.mass[i]) / total


@kernel
def pair_duration(stack: RigidStack, hit: int, other: int) -> float:
    """Return the time until the collapse of two neighbouring contacts ends; inf if there is none.

    Contact ``hit`` has just collided, and ``other`` beside it is closing.
    """
    if varies(stack, hit) or varies(stack, other):
        return math.inf
    x, y = stack.rate[hit], approach_rate(stack, other)
    e1, e2 = stack.restitution[hit], stack.restitution[other]
    if y == 0.0 or stack.law[hit] == codes.ABSENT or e1 * e2 == 1.0:
        return math.inf
    middle = min(hit, other)
    a = (1.0 + e1) * mass_share(stack, hit, middle)
    b = (1.0 + e2) * mass_share(stack, other, middle)
    trace = a * b - e1 - e2
    least = 2.0 * math.sqrt(e1 * e2)
    round_off = 8.0 * codes.EPSILON * (a * b + e1 + e2)
    if trace < least - round_off or (least == 0.0 and trace <= round_off):
        return math.inf
    discriminant = math.sqrt(max(0.0, (trace - least) * (trace + least)))
    # the smaller eigenvalue over e1, from the product e1 e2 of both, without cancellation
    weaker = 2.0 * e2 / (trace + discriminant) if e2 > 0.0 else 0.0
    margin = x * (1.0 + weaker) + b * y
    if margin <= 0.0:
        return math.inf
    return b * max(0.0, -stack.compression[other]) / margin


@kernel
def common_velocity(stack: RigidStack, low: int, high: int) -> tuple[float, float, float]:
    """Return the common velocity of the balls at contacts low..high after their collapse.

    Also returns the changes of velocity of the lowest and of the uppermost of these balls. All
    balls must be anchored now. Velocity differences are sums of closing rates, which have less
    round-off than the velocities. They are relative to the heaviest ball, whose velocity changes
    least.
    """
    if low == 0:
        relative = 0.0
        for i in range(high + 1):
            relative -= stack.rate[i]
        return 0.0, 0.0, -relative
    heaviest = low - 1
    for b in range(low, high + 1):
        if stack.mass[b] > stack.mass[heaviest]:
            heaviest = b
    momentum, mass = 0.0, stack.mass[heaviest]
    lowest, uppermost = 0.0, 0.0
    for i in range(heaviest, low - 1, -1):
        lowest += stack.rate[i]
        momentum += stack.mass[i - 1] * lowest
        mass += stack.mass[i - 1]
    for i in range(heaviest + 1, high + 1):
        uppermost -= stack.rate[i]
        momentum += stack.mass[i] * uppermost
        mass += stack.mass[i]
    gain = momentum / mass
    return stack.velocity[heaviest] + gain, gain - lowest, gain - uppermost


@kernel
def keep_state(stack: RigidStack, contact: int, time: float) -> None:
    """Store the present rates and gaps as the reference state of the cycle detection."""
    for i in range(len(stack.mass)):
        stack.kept_rate[i] = rate_now(stack, i)
        stack.kept_gap[i] = compression_after(stack, i, 0.0)
        stack.involved[i] = 0
    stack.counter[slots.LOWEST_INVOLVED] = len(stack.mass)
    stack.counter[slots.HIGHEST_INVOLVED] = -1
    stack.counter[slots.KEPT_CONTACT] = contact
    stack.counter[slots.KEEP_AFTER] = 2 * stack.counter[slots.KEEP_AFTER]
    stack.counter[slots.SINCE_KEPT] = 0
    stack.number[slots.KEPT_TIME] = time


@kernel
def _compare_with_kept(stack: RigidStack, contact: int, low: int, high: int) -> float:
    """Return how long each following round lasts, over the one before; infinity if none follows.

    The state repeats the reference state (`keep_state`) if its rates and gaps at contacts low..high
    have the same ratios on a smaller scale. The result is 0 if the rounds take no time.
    """
    if contact != stack.counter[slots.KEPT_CONTACT] or high < low + 2:
        return math.inf
    size, kept, gap, kept_gap = 0.0, 0.0, 0.0, 0.0
    for i in range(low, high + 1):
        if stack.involved[i] == 0 or varies(stack, i):
            return math.inf
        size = max(size, abs(rate_now(stack, i)))
        kept = max(kept, abs(stack.kept_rate[i]))
        gap = max(gap, -compression_after(stack, i, 0.0))
        kept_gap = max(kept_gap, -stack.kept_gap[i])
    if size >= kept or size == 0.0 or (gap == 0.0) != (kept_gap == 0.0):
        return math.inf
    for i in range(low, high + 1):
        if abs(rate_now(stack, i) / size - stack.kept_rate[i] / kept) > _SAME:
            return math.inf
        part = compression_after(stack, i, 0.0) / gap if gap > 0.0 else 0.0
        if kept_gap > 0.0 and abs(part - stack.kept_gap[i] / kept_gap) > _SAME_GAPS:
            return math.inf
    return gap / kept_gap * kept / size if kept_gap > 0.0 else 0.0


@kernel
def _are_still(stack: RigidStack, i: int, j: int) -> bool:
    """Return whether, without gravity, the rates of contacts i and j are close to underflow."""
    return stack.number[slots.GRAVITY] == 0.0 and _is_still(stack, i) and _is_still(stack, j)


@kernel
def _is_still(stack: RigidStack, i: int) -> bool:
    """Return whether the rate of contact i is close to underflow."""
    return abs(stack.rate[i]) * stack.number[slots.UNIT] < _VANISHED * stack.number[slots.SPEED]


@kernel
def vanished_group(stack: RigidStack, contact: int) -> tuple[int, int]:
    """Return the lowest and highest contact of the group around ``contact`` if its rates vanish.

    The group consists of neighbouring contacts that have all collided recently. If a rate has not
    vanished, or the group has fewer than three contacts, ``contact`` is returned twice: two
    contacts are decided by `pair_duration`, unless the restitution of one of them varies.
    """
    size = len(stack.mass)
    if not _is_still(stack, contact):
        return contact, contact
    busy = stack.counter[slots.EVENTS] - _BUSY * size
    low, high = contact, contact
    while low > 0 and stack.last_hit[low - 1] > max(busy, 0):
        low -= 1
    while high + 1 < size and stack.last_hit[high + 1] > max(busy, 0):
        high += 1
    least = 3
    for i in range(low, high + 1):
        if not _is_still(stack, i):
            return contact, contact
        if varies(stack, i):
            least = 2
    return (low, high) if high - low + 1 >= least else (contact, contact)
