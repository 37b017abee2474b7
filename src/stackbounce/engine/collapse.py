"""When a sequence of collisions is infinite: decided by theory, not by a speed threshold.

Two neighbouring contacts. Let x and y be the rates at which contacts 1 and 2 close, right after a
collision at contact 1 (so x <= 0), e1 and e2 their restitutions, and let a collision at 1 add a x
to the rate of 2 and one at 2 add b y to that of 1: a = (1+e1) m_lower/(m_lower+m_middle),
b = (1+e2) m_upper/(m_middle+m_upper), with a floor as an infinite mass. A round (collisions at 2,
then 1) maps x to -e1 (x + b y) and y to -e2 y + a (x + b y): its determinant is e1 e2 and its
trace a b - e1 - e2. The round repeats for ever exactly where its eigenvalues are real and positive,

    a b >= (sqrt(e1) + sqrt(e2))^2,

which for a floor and two balls is m2/m1 >= (sqrt(e1)+sqrt(e2))^2 / (1-sqrt(e1 e2))^2, and where the
first state lies on the right side of the weaker eigenvector. Gaps shrink as e1 e2 x_n/x_(n+1), so
that the durations of all rounds telescope to b g / (x (1 + weaker/e1) + b y), g being the gap at
contact 2 and weaker the smaller eigenvalue.

More contacts, for which no condition is known. A state that has come back in all its proportions,
only smaller, does so for ever: this is found by Brent's cycle search on the closing rates and gaps
of the contacts involved. A sequence that is not periodic is followed until its rates come close to
the end of the range of numbers, and taken for infinite then.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    CONTACT,
    EPSILON,
    JOINED,
    KIND,
    LOG_COLUMNS,
    START,
    TIME,
    UPPER_VELOCITY,
)
from stackbounce.engine.flight import (
    acceleration,
    approach,
    bring_balls,
    bring_contacts,
    change_rate,
    closing_time,
    compression_after,
    plan,
    rate_after,
    wake,
)
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.settling import NO_TIME
from stackbounce.engine.stack import RigidStack

_SAME = 1e-12  # rates whose proportions agree this well are the same
_SAME_GAPS = 1e-9
_BUSY = 200  # collisions a ball back, up to which a contact belongs to a group
_VANISHED = 1e-250  # rates below this part of the impact speed: close to the end of the numbers


@kernel
def find_collapse(stack: RigidStack, contact: int, until: float, log: Floats) -> None:
    """Finish infinitely many collisions with their limit, where theory finds that they have begun.

    While their rest still takes time that can be told from none, the next of them is followed.
    """
    soon = min(NO_TIME * stack.clock[0], until - stack.clock[0])
    for other in (contact - 1, contact + 1):
        if 0 <= other < len(stack.mass):
            duration = pair_ends(stack, contact, other)
            if duration <= soon:
                _merge(stack, min(contact, other), max(contact, other), duration, log)
    stack.last_hit[contact] = stack.counter[1]
    low, high = vanished(stack, contact)
    if low < high:
        _merge(stack, low, high, 0.0, log)
    _involve(stack, contact, contact)
    stack.memory[2] += 1
    low, high, shrink = repeats(stack, contact)
    if shrink != 0.0:
        # the rounds to come last shrink, shrink^2, ... times the one just over
        ratio = max(shrink, 0.0)
        round_time = stack.clock[0] - stack.number[1]
        if ratio < 1.0 and round_time * ratio / (1.0 - ratio) <= soon:
            _merge(stack, low, high, round_time * ratio / (1.0 - ratio), log)
    if stack.memory[2] >= stack.memory[1]:
        remember(stack, contact, stack.clock[0])


@kernel
def _merge(stack: RigidStack, low: int, high: int, duration: float, log: Floats) -> None:
    """Let the balls at contacts low..high come together, unless another ball meets them before.

    The outer balls of the group move between their present velocities and the common one; with no
    floor among them their centre of mass moves on, and all end there.
    """
    bring_contacts(stack, low - 1, high + 1)
    bring_balls(stack, low - 2, high + 1)
    velocity, lower_gain, upper_gain = common_velocity(stack, low, high)
    size = len(stack.mass)
    pull = stack.number[3] * duration
    lands = pull if low == 0 else 0.0
    if low > 0:
        below = stack.velocity[low - 2] if low > 1 else 0.0
        rate = below - min(velocity, stack.velocity[low - 1])
        rate += acceleration(stack, low - 1) * duration
        if stack.law[low - 1] != ABSENT and closing_time(stack, low - 1, rate) <= duration:
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
        stack.last_hit[i] = stack.counter[1]
    _involve(stack, low, high)
    travel = centre / mass + velocity * duration
    below = stack.velocity[low - 1] if low > 0 else 0.0
    above = stack.velocity[high]
    stack.clock[0] += duration
    stack.now[0] += duration
    bring_contacts(stack, low - 1, high + 1)
    bring_balls(stack, low - 2, high + 1)
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
        plan(stack, i)
    _write_joined(stack, low, high, log)


@kernel
def _write_joined(stack: RigidStack, low: int, high: int, log: Floats) -> None:
    """Tell the log that the balls at contacts low..high have come together."""
    at = stack.counter[0] * LOG_COLUMNS
    for column in range(LOG_COLUMNS):
        log[at + column] = 0.0
    log[at + TIME] = stack.clock[0]
    log[at + KIND] = JOINED
    log[at + CONTACT] = low
    log[at + START] = high
    log[at + UPPER_VELOCITY] = stack.velocity[high] * stack.number[0]
    stack.counter[0] += 1


@kernel
def _involve(stack: RigidStack, low: int, high: int) -> None:
    """Note that contacts low..high have collided since the state kept."""
    for i in range(low, high + 1):
        stack.involved[i] = 1
    stack.memory[3] = min(stack.memory[3], low)
    stack.memory[4] = max(stack.memory[4], high)


@kernel
def share(stack: RigidStack, i: int, ball: int) -> float:
    """Return the mass on the other side of contact i over that of both sides, seen from a ball."""
    if i == 0:
        return 1.0
    total = stack.mass[i - 1] + stack.mass[i]
    return (stack.mass[i - 1] if ball == i else stack.mass[i]) / total


@kernel
def pair_ends(stack: RigidStack, hit: int, other: int) -> float:
    """Return how long the infinite rounds of two neighbouring contacts last; infinity if finite.

    Contact ``hit`` has just collided and ``other``, beside it, is closing.
    """
    x, y = stack.rate[hit], approach(stack, other)
    e1, e2 = stack.restitution[hit], stack.restitution[other]
    if y == 0.0 or stack.law[hit] == ABSENT or e1 * e2 == 1.0:
        return math.inf
    middle = min(hit, other)
    a = (1.0 + e1) * share(stack, hit, middle)
    b = (1.0 + e2) * share(stack, other, middle)
    trace = a * b - e1 - e2
    least = 2.0 * math.sqrt(e1 * e2)
    round_off = 8.0 * EPSILON * (a * b + e1 + e2)
    if trace < least - round_off or (least == 0.0 and trace <= round_off):
        return math.inf
    discriminant = math.sqrt(max(0.0, (trace - least) * (trace + least)))
    # the weaker eigenvalue over e1, from the product e1 e2 of both, without cancellation
    weaker = 2.0 * e2 / (trace + discriminant) if e2 > 0.0 else 0.0
    margin = x * (1.0 + weaker) + b * y
    if margin <= 0.0:
        return math.inf
    return b * max(0.0, -stack.compression[other]) / margin


@kernel
def common_velocity(stack: RigidStack, low: int, high: int) -> tuple[float, float, float]:
    """Return the velocity to which the balls of contacts low..high come, and the outer balls' gain.

    All are anchored now. The closing rates know the differences to more digits than velocities do,
    and the heaviest ball changes least.
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
def remember(stack: RigidStack, contact: int, time: float) -> None:
    """Take the present state as the one to compare later ones with."""
    for i in range(len(stack.mass)):
        stack.kept_rate[i] = rate_after(stack, i, 0.0)
        stack.kept_gap[i] = compression_after(stack, i, 0.0)
        stack.involved[i] = 0
    stack.memory[3] = len(stack.mass)
    stack.memory[4] = -1
    stack.memory[0] = contact
    stack.memory[1] = 2 * stack.memory[1]
    stack.memory[2] = 0
    stack.number[1] = time


@kernel
def repeats(stack: RigidStack, contact: int) -> tuple[int, int, float]:
    """Compare with the state kept: return its (lowest, highest) contact and the ratio of sizes.

    The ratio is 0 where the present state is not the kept one on a smaller scale, and -1 where its
    rounds take no time.
    """
    low, high = stack.memory[3], stack.memory[4]
    if contact != stack.memory[0] or high < low + 2:
        return low, high, 0.0
    size, kept, gap, kept_gap = 0.0, 0.0, 0.0, 0.0
    for i in range(low, high + 1):
        if stack.involved[i] == 0:
            return low, high, 0.0
        size = max(size, abs(rate_after(stack, i, 0.0)))
        kept = max(kept, abs(stack.kept_rate[i]))
        gap = max(gap, -compression_after(stack, i, 0.0))
        kept_gap = max(kept_gap, -stack.kept_gap[i])
    if size >= kept or size == 0.0 or (gap == 0.0) != (kept_gap == 0.0):
        return low, high, 0.0
    for i in range(low, high + 1):
        if abs(rate_after(stack, i, 0.0) / size - stack.kept_rate[i] / kept) > _SAME:
            return low, high, 0.0
        part = compression_after(stack, i, 0.0) / gap if gap > 0.0 else 0.0
        if kept_gap > 0.0 and abs(part - stack.kept_gap[i] / kept_gap) > _SAME_GAPS:
            return low, high, 0.0
    shrink = gap / kept_gap * kept / size if kept_gap > 0.0 else 0.0
    return low, high, shrink if shrink > 0.0 else -1.0


@kernel
def vanished(stack: RigidStack, contact: int) -> tuple[int, int]:
    """Return the lowest and highest contact of the busy group around one, if its rates are gone.

    Otherwise, and for the two contacts on which theory decides, return that contact twice.
    """
    limit = _VANISHED * stack.number[2] / stack.number[0]
    size = len(stack.mass)
    if abs(stack.rate[contact]) >= limit:
        return contact, contact
    busy = stack.counter[1] - _BUSY * size
    low, high = contact, contact
    while low > 0 and stack.last_hit[low - 1] > max(busy, 0):
        low -= 1
    while high + 1 < size and stack.last_hit[high + 1] > max(busy, 0):
        high += 1
    for i in range(low, high + 1):
        if abs(stack.rate[i]) >= limit:
            return contact, contact
    return (low, high) if high > low + 1 else (contact, contact)
