"""Where everything is at any time between events, whatever kind of cluster it belongs to."""

import math

from stackbounce.engine.codes import EPSILON, OPEN
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.modes import find_modes, modal_compression, modal_impulse, start_modes
from stackbounce.engine.series import ORDER, TERMS, double_integral, integral, shift, value
from stackbounce.engine.stack import Stack
from stackbounce.engine.taylor import expand


@kernel
def closed_range(stack: Stack, ball: int) -> tuple[int, int]:
    """Return the closed contacts (low, high) of a ball's cluster; low = high for one in flight."""
    first = stack.first[ball]
    low = first if stack.phase[first] != OPEN else first + 1
    return low, stack.last[ball] + 1


@kernel
def contact_impulse(stack: Stack, i: int, s: float) -> tuple[float, float]:
    """Return the first and second time integrals of a closed contact's force since the anchor."""
    first = stack.first[i]
    if stack.linear[first] == 1:
        low, high = closed_range(stack, i)
        return modal_impulse(stack, i, low, high, s)
    at = i * TERMS
    once = integral(stack.force_series, at, ORDER, s)
    twice = double_integral(stack.force_series, at, ORDER, s)
    return once, twice


@kernel
def ball_shift(stack: Stack, b: int, s: float) -> tuple[float, float]:
    """Return displacement and change of velocity of a ball over s from its cluster's anchor."""
    gravity = stack.number[0]
    first = stack.first[b]
    if stack.linear[first] == 0:
        at = b * TERMS
        travel = integral(stack.velocity_series, at, ORDER, s)
        return travel, value(stack.velocity_series, at, ORDER, s) - stack.velocity[b]
    low, high = closed_range(stack, b)
    once, twice = 0.0, 0.0
    if low <= b:
        once, twice = modal_impulse(stack, b, low, high, s)
    if b + 1 < high:
        above_once, above_twice = modal_impulse(stack, b + 1, low, high, s)
        once -= above_once
        twice -= above_twice
    mass = stack.mass[b]
    travel = stack.velocity[b] * s + twice / mass - 0.5 * gravity * s * s
    return travel, once / mass - gravity * s


@kernel
def closed_compression(stack: Stack, i: int, s: float) -> float:
    """Return the compression of a closed contact at s from the anchor."""
    first = stack.first[i]
    if stack.linear[first] == 0:
        return value(stack.compression_series, i * TERMS, ORDER, s)
    low, high = closed_range(stack, i)
    size = len(stack.mass)
    total = 0.0
    for j in range(low, high):
        omega = stack.omega[j]
        swing = stack.cosine[j] * math.cos(omega * s) + stack.sine[j] * math.sin(omega * s) / omega
        total += stack.shape[j * size + i] * (stack.static[j] + swing)
    return total / stack.weight[i]


@kernel
def fly_alike(stack: Stack, i: int) -> bool:
    """Tell whether both balls at open contact i are in flight and anchored at one time.

    Their distance then follows from their relative velocity, without their travels' round-off.
    """
    if i == 0 or stack.phase[i] != OPEN:
        return False
    below = stack.first[i - 1] == stack.last[i - 1] and stack.linear[i - 1] == 1
    above = stack.first[i] == stack.last[i] and stack.linear[i] == 1
    if not (below and above) or (i == 1 and stack.phase[0] != OPEN):
        return False
    return stack.anchor[i - 1] == stack.anchor[i]


@kernel
def meet_anchors(stack: Stack, i: int) -> None:
    """Anchor the two balls at open contact i at one time if both are in flight."""
    if i == 0 or (i == 1 and stack.phase[0] != OPEN):
        return
    if stack.first[i - 1] != stack.last[i - 1] or stack.first[i] != stack.last[i]:
        return
    if stack.anchor[i - 1] < stack.anchor[i]:
        advance_cluster(stack, i - 1, stack.anchor[i])
    elif stack.anchor[i] < stack.anchor[i - 1]:
        advance_cluster(stack, i, stack.anchor[i - 1])


@kernel
def compression_at(stack: Stack, i: int, time: float) -> float:
    """Return the compression of contact i at a time: positive while pressed, minus the gap else."""
    if stack.phase[i] != OPEN:
        return closed_compression(stack, i, time - stack.anchor[stack.first[i]])
    if fly_alike(stack, i):
        rate = stack.velocity[i - 1] - stack.velocity[i]
        return stack.compression[i] + rate * (time - stack.anchor[i])
    travel, _ = ball_shift(stack, i, time - stack.anchor[stack.first[i]])
    total = stack.compression[i] - travel
    if i > 0:
        below, _ = ball_shift(stack, i - 1, time - stack.anchor[stack.first[i - 1]])
        total += below
    return total


@kernel
def velocity_at(stack: Stack, b: int, time: float) -> float:
    """Return the velocity of ball b at a time."""
    _, change = ball_shift(stack, b, time - stack.anchor[stack.first[b]])
    return stack.velocity[b] + change


@kernel
def add_ball_series(
    stack: Stack, b: int, sign: float, time: float, out: Floats
) -> tuple[int, float, float]:
    """Add sign times a ball's displacement since its anchor, expanded about a time, to ``out``.

    Returns the order of the series, the bound on its rest (order 10 where the order is 9) and its
    round-off.
    """
    first = stack.first[b]
    s = time - stack.anchor[first]
    travel, change = ball_shift(stack, b, s)
    velocity = stack.velocity[b] + change
    noise = 8.0 * EPSILON * (abs(travel) + (abs(stack.velocity[b]) + abs(velocity)) * s)
    out[0] += sign * travel
    out[1] += sign * velocity
    part = stack.scratch
    if stack.linear[first] == 0:
        shift(stack.velocity_series, b * TERMS, ORDER, s, part)
        for k in range(1, ORDER + 1):
            out[k + 1] += sign * part[k] / (k + 1)
        return ORDER + 1, 0.0, noise
    out[2] -= 0.5 * sign * stack.number[0]
    low, high = closed_range(stack, b)
    tail = 0.0
    for i in range(max(low, b), min(high, b + 2)):
        scale = (sign if i == b else -sign) * stack.rate[i] / stack.mass[b]
        rest, _, _ = modal_compression(stack, i, low, high, s, part)
        for k in range(8):
            out[k + 2] += scale * part[k] / ((k + 1) * (k + 2))
        tail += abs(scale) * rest / 90.0
    return 9 if low < high else 2, tail, noise


@kernel
def compression_series(
    stack: Stack, i: int, time: float, out: Floats
) -> tuple[int, float, float, float]:
    """Expand the compression of contact i about a time.

    Returns the order, the bound on the rest (one order higher), and the round-off of the
    compression and of its rate.
    """
    for k in range(TERMS):
        out[k] = 0.0
    first = stack.first[i]
    if stack.phase[i] == OPEN:
        noise = 8.0 * EPSILON * abs(stack.compression[i])
        if fly_alike(stack, i):
            out[0] = compression_at(stack, i, time)
            out[1] = stack.velocity[i - 1] - stack.velocity[i]
            return 2, 0.0, noise, 0.0
        out[0] = stack.compression[i]
        order, tail, round_off = add_ball_series(stack, i, -1.0, time, out)
        noise += round_off
        if i > 0:
            other, rest, round_off = add_ball_series(stack, i - 1, 1.0, time, out)
            order = max(order, other)
            tail += rest
            noise += round_off
        return order, tail, noise, 0.0
    s = time - stack.anchor[first]
    if stack.linear[first] == 1:
        low, high = closed_range(stack, i)
        tail, noise, rate_noise = modal_compression(stack, i, low, high, s, out)
        return 7, tail, noise, rate_noise
    shift(stack.compression_series, i * TERMS, ORDER + 1, s, out)
    noise = 16.0 * EPSILON * abs(stack.compression_series[i * TERMS])
    speed = stack.number[1] + abs(stack.compression_series[i * TERMS + 1])
    return ORDER + 1, 0.0, noise + EPSILON * speed * s, 16.0 * EPSILON * speed


@kernel
def advance_cluster(stack: Stack, ball: int, time: float) -> None:
    """Move the anchor of a ball's cluster to a time."""
    first = stack.first[ball]
    last = stack.last[ball]
    s = time - stack.anchor[first]
    low, high = closed_range(stack, ball)
    fastest = 0.0
    for b in range(first, last + 1):
        travel, change = ball_shift(stack, b, s)
        before = abs(stack.velocity[b])
        stack.velocity[b] += change
        fastest = max(fastest, before, abs(stack.velocity[b]))
        if b == first and low > first:
            stack.compression[b] -= travel
        if b == last and b + 1 < len(stack.mass):
            stack.compression[b + 1] += travel
    for b in range(first, last + 1):
        stack.velocity_noise[b] = 64.0 * EPSILON * fastest
    for i in range(low, high):
        once, _ = contact_impulse(stack, i, s)
        stack.impulse[i] += once
        stack.compression[i] = closed_compression(stack, i, s)
    stack.anchor[first] = time


@kernel
def form_clusters(stack: Stack, bottom: int, top: int, time: float) -> None:
    """Join the balls bottom..top, all anchored at a time, into clusters and expand their motion."""
    size = len(stack.mass)
    first = bottom
    for b in range(bottom, top + 1):
        stack.due[size + b] = math.inf
        if b < top and stack.phase[b + 1] != OPEN:
            continue
        for member in range(first, b + 1):
            stack.first[member] = first
            stack.last[member] = b
        stack.anchor[first] = time
        low, high = closed_range(stack, first)
        stack.linear[first] = 1
        for i in range(low, high):
            if stack.curve_exponent[i] != 1.0 and stack.faint[i] == 0:
                stack.linear[first] = 0
        if stack.linear[first] == 0:
            stack.due[size + first] = time + expand(stack, low, high)
        elif low < high:
            find_modes(stack, low, high)
            start_modes(stack, low, high)
        first = b + 1
