"""Displacement, velocity and compression at any time between events, for every kind of cluster."""

import math

from stackbounce.engine.codes import COMPRESSING, EPSILON, HYSTERETIC, POWER
from stackbounce.engine.contacts import approach_speed, correct_curve
from stackbounce.engine.elementary import exp
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.forces import creeps, is_linear, power_needed, recovery, surface
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.modes import (
    find_modes,
    modal_compression,
    modal_impulse,
    modal_position,
    start_modes,
)
from stackbounce.engine.series import ORDER, evaluate, integrate, shift
from stackbounce.engine.slots import GRAVITY, NONLINEAR, RECORDS_PEAKS, SPEED, TOLERANCE, WORK
from stackbounce.engine.stack import MODES, TERMS, WIDTH, Stack
from stackbounce.engine.taylor import ROOT_POWERS, expand_motion, record_series_peaks
from stackbounce.engine.work import CREST, EXPANSION, MODES_WORK

KNOWN = 100.0  # times the tolerance of a step: the error after many steps
_ENTERS = 1e-6  # of the reference speed: contacts that begin faster need no chord
_SURFACE_TERMS = 10  # as many as of a spring's compression, see `add_ball_series`
_LEAST_REST = 1e-290  # a bound that is not 0, as the search for events needs one
_SLOWEST = 1e-9  # of the reference speed: the largest error that the tolerance implies


@kernel
def pressing_range(stack: Stack, ball: int) -> tuple[int, int]:
    """Return low and high of a cluster's pressing contacts low..high-1; none in flight."""
    first = stack.first[ball]
    low = first if stack.phase[first] >= COMPRESSING else first + 1
    return low, stack.last[ball] + 1


@kernel
def series_time(stack: Stack, first: int, s: float) -> float:
    """Return the argument of a cluster's power series at the time s: s, or its square root."""
    return s if stack.root[first] == 1 else math.sqrt(s)


@kernel
def contact_impulse(stack: Stack, i: int, s: float) -> float:
    """Return the time integral of a pressing contact's force since the anchor."""
    first = stack.first[i]
    if stack.modal[first] == 0:
        x = series_time(stack, first, s)
        return integrate(stack.force_series[i], stack.order[first], x, stack.root[first])
    low, high = pressing_range(stack, i)
    once, _ = modal_impulse(stack, i, low, high, s)
    return once


@kernel
def ball_travel(stack: Stack, b: int, s: float) -> tuple[float, float]:
    """Return a ball's displacement and change of velocity over s from its cluster's anchor."""
    gravity = stack.number[GRAVITY]
    first = stack.first[b]
    if stack.modal[first] == 0:
        if s == 0.0:
            return 0.0, 0.0
        order, x = stack.order[first], series_time(stack, first, s)
        travel = integrate(stack.velocity_series[b], order, x, stack.root[first])
        return travel, evaluate(stack.velocity_series[b], order, x) - stack.velocity[b]
    low, high = pressing_range(stack, b)
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
    """Return the compression of a pressing contact at s after the anchor."""
    first = stack.first[i]
    if stack.modal[first] == 0:
        order = stack.order[first] + stack.root[first]
        return evaluate(stack.compression_series[i], order, series_time(stack, first, s))
    low, high = pressing_range(stack, i)
    total = 0.0
    for j in range(low, high):
        total += stack.shape[j * WIDTH + i - low] * modal_position(stack, j, s)
    return total / stack.weight[i]


@kernel
def is_free(stack: Stack, ball: int) -> bool:
    """Return whether no pressing contact touches a ball."""
    first = stack.first[ball]
    return first == stack.last[ball] and stack.phase[first] < COMPRESSING


@kernel
def have_common_anchor(stack: Stack, i: int) -> bool:
    """Return whether both balls at a contact are in flight and anchored at the same time.

    Their distance can then be computed from their relative velocity, without the round-off of their
    displacements.
    """
    if i == 0 or not (is_free(stack, i - 1) and is_free(stack, i)):
        return False
    return stack.anchor[i - 1] == stack.anchor[i]


@kernel
def align_anchors(stack: Stack, i: int) -> None:
    """Move the earlier anchor of two balls in flight at a contact to the later one."""
    if i == 0 or not (is_free(stack, i - 1) and is_free(stack, i)):
        return
    if stack.anchor[i - 1] < stack.anchor[i]:
        advance_cluster(stack, i - 1, stack.anchor[i])
    elif stack.anchor[i] < stack.anchor[i - 1]:
        advance_cluster(stack, i, stack.anchor[i - 1])


@kernel
def compression_at(stack: Stack, i: int, time: float) -> float:
    """Return the compression of contact i at a time: positive if pressed, minus the gap if open."""
    if stack.phase[i] >= COMPRESSING:
        return closed_compression(stack, i, time - stack.anchor[stack.first[i]])
    if have_common_anchor(stack, i):
        rate = stack.velocity[i - 1] - stack.velocity[i]
        return stack.compression[i] + rate * (time - stack.anchor[i])
    travel, _ = ball_travel(stack, i, time - stack.anchor[stack.first[i]])
    total = stack.compression[i] - travel
    if i > 0:
        below, _ = ball_travel(stack, i - 1, time - stack.anchor[stack.first[i - 1]])
        total += below
    return total


@kernel
def velocity_at(stack: Stack, b: int, time: float) -> float:
    """Return the velocity of ball b at a time."""
    _, change = ball_travel(stack, b, time - stack.anchor[stack.first[b]])
    return stack.velocity[b] + change


@kernel
def rate_at(stack: Stack, i: int, time: float) -> float:
    """Return the rate of compression of contact i at a time."""
    below = velocity_at(stack, i - 1, time) if i > 0 else 0.0
    return below - velocity_at(stack, i, time)


@kernel
def creep_at(stack: Stack, i: int, time: float) -> float:
    """Return the creep of contact i at a time: it follows the compression, or recovers freely."""
    if stack.phase[i] < COMPRESSING:
        if stack.creep[i] == 0.0:
            return 0.0
        return stack.creep[i] * exp(-recovery(stack, i) * (time - stack.creep_time[i]))
    if not creeps(stack, i):
        return 0.0
    first = stack.first[i]
    x = series_time(stack, first, time - stack.anchor[first])
    return evaluate(stack.creep_series[i], stack.order[first] + stack.root[first], x)


@kernel
def overlap_at(stack: Stack, i: int, time: float) -> float:
    """Return the compression of contact i beyond its surface: 0 where it touches or opens."""
    return compression_at(stack, i, time) - surface(stack, i, creep_at(stack, i, time))


@kernel
def overlap_rate_at(stack: Stack, i: int, time: float) -> float:
    """Return the rate of the overlap of contact i."""
    rate = rate_at(stack, i, time)
    if not creeps(stack, i):
        return rate
    creep = creep_at(stack, i, time)
    reached = surface(stack, i, creep)
    if stack.phase[i] >= COMPRESSING:
        reached = compression_at(stack, i, time)
    growth = stack.creep_rate[i] * (reached - creep)
    return rate - stack.gain_creep[i] * growth / stack.gain_slope[i]


@kernel
def subtract_surface(
    stack: Stack, i: int, time: float, root: int, out: Floats
) -> tuple[int, int, float]:
    """Subtract the power series of open contact i's surface, about ``time``, from ``out``.

    It recovers exponentially. Returns the order of the series, the order of its remainder, and a
    bound on the remainder; all terms alternate, so that the next one is that bound.
    """
    term = surface(stack, i, creep_at(stack, i, time))
    rate = recovery(stack, i)
    for k in range(_SURFACE_TERMS):
        out[root * k] -= term
        term *= -rate / (k + 1)
    return root * (_SURFACE_TERMS - 1), root * _SURFACE_TERMS, max(abs(term), _LEAST_REST)


@kernel
def add_ball_series(
    stack: Stack, b: int, sign: float, time: float, root: int, out: Floats
) -> tuple[int, float, float]:
    """Add sign times the power series of a ball's displacement since its anchor to ``out``.

    The series is expanded about ``time``. Returns its order, a bound on its remainder (order 10)
    and its round-off. With root = 2 it is a series in the square root of the time since then, which
    exists only if the ball's own cluster is anchored at ``time``.
    """
    first = stack.first[b]
    s = time - stack.anchor[first]
    travel, change = ball_travel(stack, b, s)
    velocity = stack.velocity[b] + change
    noise = 8.0 * EPSILON * (abs(travel) + (abs(stack.velocity[b]) + abs(velocity)) * s)
    out[0] += sign * travel
    out[root] += sign * velocity
    part = stack.scratch
    if stack.modal[first] == 0:
        order = stack.order[first]
        shift(stack.velocity_series[b], order, s, part)
        for k in range(1, order + 1):
            out[k + root] += sign * root * part[k] / (k + root)
        return order + root, 0.0, noise
    out[2 * root] -= 0.5 * sign * stack.number[GRAVITY]
    low, high = pressing_range(stack, b)
    tail = 0.0
    for i in range(max(low, b), min(high, b + 2)):
        scale = (sign if i == b else -sign) * stack.rate[i] / stack.mass[b]
        rest, _, _ = modal_compression(stack, i, low, high, s, part)
        for k in range(8):
            out[k + 2] += scale * part[k] / ((k + 1) * (k + 2))
        tail += abs(scale) * rest / 90.0
    return 9 if low < high else 2 * root, tail, noise


@kernel
def root_at(stack: Stack, i: int) -> int:
    """Return the root of time (1 or 2) in which the compression of contact i is a power series."""
    root = stack.root[stack.first[i]]
    return max(root, stack.root[stack.first[i - 1]]) if i > 0 else root


@kernel
def compression_series(
    stack: Stack, i: int, time: float, root: int, out: Floats
) -> tuple[int, int, float, float, float]:
    """Write the power series of the compression of contact i about ``time`` to ``out``.

    Its variable is the time since then (root = 1) or the square root of that (root = 2). Returns
    the order of the series, the order of its remainder, a bound on the remainder, and the round-off
    of the compression and of its rate.
    """
    first = stack.first[i]
    if stack.phase[i] < COMPRESSING:
        for k in range(TERMS):
            out[k] = 0.0
        noise = 8.0 * EPSILON * abs(stack.compression[i])
        if have_common_anchor(stack, i):
            out[0] = compression_at(stack, i, time)
            out[1] = stack.velocity[i - 1] - stack.velocity[i]
            return 2, 10, 0.0, noise, 0.0
        out[0] = stack.compression[i]
        order, tail, round_off = add_ball_series(stack, i, -1.0, time, root, out)
        noise += round_off
        if i > 0:
            other, rest, round_off = add_ball_series(stack, i - 1, 1.0, time, root, out)
            order = max(order, other)
            tail += rest
            noise += round_off
        return order, 10, tail, noise, 0.0
    s = time - stack.anchor[first]
    if stack.modal[first] == 1:
        low, high = pressing_range(stack, i)
        tail, noise, rate_noise = modal_compression(stack, i, low, high, s, out)
        return 7, 8, tail, noise, rate_noise
    order = stack.order[first] + root
    shift(stack.compression_series[i], order, s, out)
    noise = 16.0 * EPSILON * abs(stack.compression_series[i][0])
    speed = stack.speed[first] + abs(stack.compression_series[i][root])
    return order, order + 1, 0.0, noise + EPSILON * speed * s, 16.0 * EPSILON * speed


@kernel
def advance_cluster(stack: Stack, ball: int, time: float) -> None:
    """Move the anchor of a ball's cluster to a time."""
    first = stack.first[ball]
    last = stack.last[ball]
    s = time - stack.anchor[first]
    low, high = pressing_range(stack, ball)
    moves, x, order = stack.modal[first] == 0, s, stack.order[first]
    if moves:
        x = series_time(stack, first, s)
        record_series_peaks(stack, low, high, x)
    fastest = 0.0
    for b in range(first, last + 1):
        open_below = b == first and low > first
        open_above = b == last and b + 1 < len(stack.mass)
        before = stack.velocity[b]
        if open_below or open_above or not moves:
            travel, change = ball_travel(stack, b, s)
            stack.velocity[b] += change
            if open_below:
                stack.compression[b] -= travel
            if open_above:
                stack.compression[b + 1] += travel
        else:
            stack.velocity[b] = evaluate(stack.velocity_series[b], order, x)
        fastest = max(fastest, abs(before), abs(stack.velocity[b]))
    noise = 64.0 * EPSILON * fastest
    if moves and (order < ORDER or stack.root[first] == 2):
        known = min(KNOWN * stack.number[TOLERANCE], _SLOWEST)
        noise = max(noise, known * stack.number[SPEED])
    for b in range(first, last + 1):
        stack.velocity_noise[b] = max(stack.velocity_noise[b], noise)
    for i in range(low, high):
        if stack.counter[RECORDS_PEAKS] == 1 or stack.linearised[i] == 1:
            impulse = contact_impulse(stack, i, s)
            stack.impulse[i] += impulse
            stack.linearised_impulse[i] += impulse
        if moves:
            c = stack.compression_series[i]
            stack.compression[i] = evaluate(c, order + stack.root[first], x)
            crest = c[stack.root[first]] > 0.0 and approach_speed(stack, i) <= 0.0
            if crest and stack.law[i] != HYSTERETIC:  # see `record_series_peaks`
                stack.counter[WORK] += CREST * order * (1 if stack.law[i] == POWER else 2)
        else:
            stack.compression[i] = closed_compression(stack, i, s)
        if creeps(stack, i):
            stack.creep[i] = creep_at(stack, i, time)
    stack.anchor[first] = time


@kernel
def allows_root_series(stack: Stack) -> bool:
    """Return whether clusters may have series in the root of time.

    In a stack of more than two balls, a contact at such a cluster might also need the series of the
    next cluster, which has another anchor.
    """
    return len(stack.mass) <= 2 and stack.counter[NONLINEAR] == 1


@kernel
def _choose_root(stack: Stack, low: int, high: int) -> int:
    """Return 2 if a cluster's motion needs a series in the square root of time, else 1.

    It is 2 if a contact closes at a nonzero speed and the exponent of its force is a multiple of
    1/2. Such a contact needs no linearisation.
    """
    for i in range(low, high):
        twice = 2.0 * power_needed(stack, i)
        if stack.compression[i] != 0.0 or twice != math.floor(twice):
            continue
        fast = approach_speed(stack, i) > _ENTERS * stack.number[SPEED]
        if fast and 0.0 < twice < ROOT_POWERS:
            stack.linearised[i] = 0
            return 2
    return 1


@kernel
def form_clusters(stack: Stack, bottom: int, top: int, time: float) -> None:
    """Group the balls bottom..top, all anchored at a time, into clusters; expand their motion."""
    size = len(stack.mass)
    first = bottom
    for b in range(bottom, top + 1):
        if b > first:
            schedule(stack.due, stack.heap, stack.place, size + b, math.inf)
        if b < top and stack.phase[b + 1] >= COMPRESSING:
            continue
        for member in range(first, b + 1):
            stack.first[member] = first
            stack.last[member] = b
        stack.anchor[first] = time
        low, high = pressing_range(stack, first)
        stack.modal[first] = 1 if high - low <= MODES else 0
        for i in range(low, high):
            correct_curve(stack, i)
        stack.root[first] = _choose_root(stack, low, high) if allows_root_series(stack) else 1
        for i in range(low, high):
            # a chord is too soft to carry a weight: there is no static state to oscillate about
            if not is_linear(stack, i) or (
                stack.linearised[i] == 1 and stack.number[GRAVITY] > 0.0
            ):
                stack.modal[first] = 0
        end = math.inf
        if stack.modal[first] == 0:
            end = time + expand_motion(stack, low, high)
            stack.counter[WORK] += EXPANSION + (high - low) * stack.order[first]
        elif low < high:
            stack.counter[WORK] += MODES_WORK * (high - low)
            find_modes(stack, low, high)
            start_modes(stack, low, high)
        schedule(stack.due, stack.heap, stack.place, size + first, end)
        first = b + 1
