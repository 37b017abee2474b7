"""A cluster with nonlinear or damped contacts: the Taylor series of its motion, step by step.

Inside a phase of every contact the motion is analytic, so that its Taylor series serves as
integrator, dense output and event search. Order by order, forces follow from compressions and their
rates, accelerations from forces, velocities and compressions from accelerations. If a contact
begins at a speed and p is a multiple of 1/2, c^p has a series in the square root of time instead,
and so has the whole motion up to the next step. A step is the time for which the last two terms of
every velocity (2 p + 2, in the root of time) stay below the tolerance (Jorba and Zou, Exp. Math.
14, 99, 2005), and those of every creep. It is also limited so that no power grows beyond what these
terms represent, and no compression falls by much more than itself, or rises by more than the last
term of its power allows. If all contacts are springs and dashpots the series is that of the matrix
exponential, whatever its eigenvalues; the tolerance is then round-off, whatever the user asks for.
"""

import math

from stackbounce.engine.codes import HYSTERETIC, PRODUCT
from stackbounce.engine.contacts import record_peak
from stackbounce.engine.elementary import near_root, power
from stackbounce.engine.forces import (
    creeps,
    find_terms,
    force,
    has_rare_terms,
    held_energy,
    is_linear,
    power_needed,
    raised,
)
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.series import ORDER, ROOT_ORDER, differentiate, evaluate
from stackbounce.engine.slots import RECORDS_PEAKS, SERIES_ORDER, SPEED, TOLERANCE
from stackbounce.engine.stack import Stack

_EXACT = 1e-16  # of its own speed: the error of a step of a linear cluster
_ROUGH = 1e-3  # of its own speed: the largest error of a step of any other cluster,
_SLOW = 1e-13  # but at least this part of the reference speed
ROOT_POWERS = 8.0  # twice the power from which on a series in the root of time is no faster
_BEYOND = 1.25  # times a compression: the largest change in a step
_CLEAR = 50.0  # times the tolerance of a step: the largest last term of a power
_HALVINGS = 50  # of a part of a step, in the search for a peak
_UNDERFLOW = 1e-280  # where the last terms are smaller, as of very slow motion, earlier ones count
_PARTS = 4  # of a step, each searched for one peak


@kernel
def expand_motion(stack: Stack, low: int, high: int) -> float:
    """Expand the motion of the cluster with pressing contacts low..high-1; return the safe step."""
    bottom = max(low - 1, 0)
    root = stack.root[bottom]
    exact, steepest = True, 0.0
    for i in range(low, high):
        stack.compression_series[i][0] = stack.compression[i]
        stack.compression_series[i][1] = 0.0  # remains 0 in a series in the root of time
        stack.creep_series[i][0] = stack.creep[i]
        stack.creep_series[i][1] = 0.0  # the same
        stack.power[i] = power_needed(stack, i) if stack.linearised[i] == 0 else 0.0
        if stack.compression[i] == 0.0:
            steepest = max(steepest, stack.power[i])
        ratio = stack.compression[i] / stack.curve_unit[i]
        begin = ratio > 0.0 and stack.power[i] > 0.0
        stack.power_series[i][0] = raised(ratio, stack.power[i]) if begin else 0.0
        stack.power_series[i][1] = 0.0  # the same
        if stack.depth[i] > 0:
            ratio = stack.compression[i] / stack.held_unit[i]
            stack.held_series[i][0] = power(ratio, stack.loss_exponent[i])
            stack.held_series[i][1] = 0.0  # the same
        if not is_linear(stack, i) and (stack.curve_exponent[i] != 0.0 or stack.depth[i] > 0):
            exact = False
    order = ORDER if exact else stack.counter[SERIES_ORDER]
    if root == 2:
        order = min(2 * order, ROOT_ORDER)
    speed = _own_speed(stack, low, high) if exact else stack.number[SPEED]
    for b in range(bottom, high):
        stack.velocity_series[b][0] = stack.velocity[b]
        stack.velocity_series[b][1] = 0.0
        stack.order[b] = order
        stack.speed[b] = speed
    if has_rare_terms(stack, low, high):
        find_terms(stack, low, high, order, root, 1)
    elif root == 1 and low == 0 and high == 2:
        find_terms(stack, 0, 2, order, 1, 0)  # as below, but compiled for constants
    else:
        find_terms(stack, low, high, order, root, 0)
    step = 0.0
    for i in range(low, high):
        step = max(step, 100.0 * stack.scale[i] / stack.number[SPEED])
    allowed = speed * (_EXACT if exact else stack.number[TOLERANCE])
    if not exact and allowed > _ROUGH * _fastest(stack, low, high):
        own_speed = _own_speed(stack, low, high)
        allowed = min(allowed, max(_ROUGH * own_speed, _SLOW * speed))
    # in the root of time, 2 p + 1 terms of 2 p + 2 may be 0
    terms, last, known = 2 if root == 1 else 2 + int(2.0 * steepest), order, False
    x = longest = step if root == 1 else math.sqrt(step)
    while not known:
        before, largest, x = 0.0, 0.0, longest
        for k in range(last - terms + 1, last + 1):
            size = _size_of_term(stack, low, high, k)
            if size * x > before:  # otherwise this term is as small as the last one
                x = min(x, near_root(allowed / size, k))
            before, largest = size, max(largest, size)
        last -= terms
        known = largest > _UNDERFLOW or last < 2 * terms
    step = min(step, x if root == 1 else x * x)
    for i in range(low, high):
        if (stack.power[i] > 0.0 or stack.depth[i] > 0) and stack.compression[i] > 0.0:
            step = _steep_step(stack, i, order, root, step)
    return step


@kernel
def _size_of_term(stack: Stack, low: int, high: int, k: int) -> float:
    """Return the largest term of order k of a cluster's velocities, and of creeps, as speeds."""
    size = 0.0
    for b in range(max(low - 1, 0), high):
        size = max(size, abs(stack.velocity_series[b][k]))
    for i in range(low, high):
        if creeps(stack, i):  # as a speed, by the contact's own rate
            own_rate = stack.number[SPEED] / stack.scale[i]
            size = max(size, abs(stack.creep_series[i][k]) * own_rate)
    return size


@kernel
def _steep_step(stack: Stack, i: int, order: int, root: int, step: float) -> float:
    """Return the step, shortened so that the power of a compression changes by at most e^(order/2).

    The series cannot represent a larger change. Moreover, the compression may change by little more
    than its own value, because its power has no series at 0. A rising compression may change by
    more, as long as the last term of the series of its power is small.
    """
    compression, c = stack.compression[i], stack.compression_series[i]
    steepness, first, last = 0.0, 0.0, 0.0
    if stack.power[i] > 0.0:
        steepness = stack.curve_exponent[i]
        first, last = stack.power_series[i][0], abs(stack.power_series[i][order])
    if stack.depth[i] > 0:
        steepness = max(steepness, stack.loss_exponent[i])
        held, end = stack.held_series[i][0], abs(stack.held_series[i][order])
        if end * first >= last * held:
            first, last = held, end
    furthest = 0.5 * order / root / steepness * compression
    reach = min(furthest, _BEYOND * compression)
    near = _time_to_rise(abs(c[1]), abs(c[2]), reach)
    if near >= step or c[1] <= 0.0 or root == 2:
        return min(near, step)
    far = min(_time_to_rise(c[1], c[2], furthest), _time_to_rise(-c[1], -c[2], reach))
    if far > near and last > 0.0:
        far = min(far, near_root(_CLEAR * stack.number[TOLERANCE] * first / last, order))
    return min(max(near, far), step)


@kernel
def _time_to_rise(first: float, second: float, reach: float) -> float:
    """Return the time at which first t + second t^2 reaches ``reach`` > 0; infinity if never."""
    discriminant = first * first + 4.0 * second * reach
    if discriminant < 0.0 or (first <= 0.0 and second <= 0.0):
        return math.inf
    root = math.sqrt(discriminant)
    return 2.0 * reach / (first + root) if first >= 0.0 else (root - first) / (2.0 * second)


@kernel
def _own_speed(stack: Stack, low: int, high: int) -> float:
    """Return the speed to which the error of a linear cluster's step is relative.

    It is the larger of two: the largest present speed of its balls, and the speed that its stored
    energy could give them. The speed at the start does not count, because an overdamped contact
    ends with a far smaller one.
    """
    mass, stored = 0.0, 0.0
    for b in range(max(low - 1, 0), high):
        mass += stack.mass[b]
    for i in range(low, high):
        stored += held_energy(stack, i, stack.compression[i], stack.creep[i])
    return max(_fastest(stack, low, high), math.sqrt(2.0 * stored / mass))


@kernel
def _fastest(stack: Stack, low: int, high: int) -> float:
    """Return the largest speed of a cluster's balls."""
    fastest = 0.0
    for b in range(max(low - 1, 0), high):
        fastest = max(fastest, abs(stack.velocity[b]))
    return fastest


@kernel
def record_series_peaks(stack: Stack, low: int, high: int, s: float) -> None:
    """Update the peaks of contacts with one force curve from their series up to s."""
    for i in range(low, high):
        if stack.counter[RECORDS_PEAKS] == 0 or stack.law[i] == HYSTERETIC:
            continue
        first, order = stack.first[i], stack.order[i]
        root = stack.root[first]
        crest, at = _largest_value(stack.compression_series[i], order + root, s)
        pressing = stack.peak_force[i]
        if stack.law[i] >= PRODUCT:
            pressing, at = _largest_value(stack.force_series[i], order, s)
        elif crest > stack.peak_compression[i]:
            pressing = force(stack, i, crest, 0.0, 0.0)
        time = stack.anchor[first] + (at if root == 1 else at * at)
        record_peak(stack, i, crest, pressing, time)


@kernel
def _largest_value(a: Floats, n: int, s: float) -> tuple[float, float]:
    """Return the largest value of a series from 0 to s, and where it is."""
    largest, at = a[0], 0.0
    last = evaluate(a, n, s)
    if last > largest:
        largest, at = last, s
    bend = 0.0
    for k in range(n, 1, -1):
        bend = k * abs(a[k]) + s * bend
    if abs(a[1]) > s * bend:
        return largest, at  # monotonic
    for part in range(_PARTS):
        left, right = s * part / _PARTS, s * (part + 1) / _PARTS
        if differentiate(a, n, left) <= 0.0 or differentiate(a, n, right) >= 0.0:
            continue
        for _ in range(_HALVINGS):
            middle = 0.5 * (left + right)
            if differentiate(a, n, middle) > 0.0:
                left = middle
            else:
                right = middle
        crest = evaluate(a, n, left)
        if crest > largest:
            largest, at = crest, left
    return largest, at
