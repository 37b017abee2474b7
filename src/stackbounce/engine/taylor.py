"""Any other cluster: the power series of its motion, step by step.

Inside a phase of every contact the motion is analytic, so its own Taylor series is integrator,
dense output and event search in one. Order by order: forces from compressions and their rates,
accelerations from forces, velocities and compressions from accelerations. The step is the time for
which the last two terms of every velocity stay below the tolerance (Jorba and Zou, Exp. Math. 14,
99, 2005), and in which no power grows beyond what these terms could tell. Where all contacts are
springs and dashpots the series is that of the matrix exponential, whatever its eigenvalues; the
tolerance is then round-off and no choice of the user.
"""

import math

from stackbounce.engine.codes import DAMPED
from stackbounce.engine.contacts import stored_energy
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.series import ORDER, TERMS, power_term, value
from stackbounce.engine.stack import Stack

_TINY = 1e-300  # keeps a standstill from dividing by zero
_EXACT = 1e-16  # of its own speed: what a linear cluster's series leaves out per step
_ROUGH = 1e-3  # of its own speed: what any other, however slow, leaves out at most ...
_SLOW = 1e-13  # ... though not less than this part of the reference speed
_PARTS = 4  # of a step, in each of which a force has no more than one crest


@kernel
def is_linear(stack: Stack, i: int) -> bool:
    """Tell whether the force of a pressing contact is a constant times its compression now."""
    if stack.law[i] == DAMPED:
        return False
    return stack.faint[i] == 1 or stack.curve_exponent[i] == 1.0


@kernel
def expand(stack: Stack, low: int, high: int) -> float:
    """Expand the motion of the cluster with pressing contacts low..high-1; return the safe step."""
    bottom = max(low - 1, 0)
    exact = True
    for i in range(low, high):
        stack.compression_series[i * TERMS] = stack.compression[i]
        if not is_linear(stack, i) and stack.curve_exponent[i] != 0.0:
            exact = False
    order = ORDER if exact else stack.setting[0]
    own_speed = _own_speed(stack, low, high)
    speed = own_speed if exact else stack.number[1]
    for b in range(bottom, high):
        stack.velocity_series[b * TERMS] = stack.velocity[b]
        stack.order[b] = order
        stack.speed[b] = speed
    for k in range(order + 1):
        for i in range(low, high):
            stack.force_series[i * TERMS + k] = _force_term(stack, i, k)
        for b in range(bottom, high):
            net = 0.0
            if b >= low:
                net += stack.force_series[b * TERMS + k]
            if b + 1 < high:
                net -= stack.force_series[(b + 1) * TERMS + k]
            acceleration = net / stack.mass[b]
            if k == 0:
                acceleration -= stack.number[0]
            stack.velocity_series[b * TERMS + k + 1] = acceleration / (k + 1)
        for i in range(low, high):
            below = stack.velocity_series[(i - 1) * TERMS + k] if i > 0 else 0.0
            above = stack.velocity_series[i * TERMS + k]
            stack.compression_series[i * TERMS + k + 1] = (below - above) / (k + 1)
    step = 0.0
    for i in range(low, high):
        step = max(step, 100.0 * stack.scale[i] / stack.number[1])
    for i in range(low, high):
        if stack.faint[i] == 0 and stack.curve_exponent[i] > 1.0:
            step = min(step, _steep_step(stack, i, order))
    allowed = speed * (_EXACT if exact else stack.number[2])
    if not exact:
        allowed = min(allowed, max(_ROUGH * own_speed, _SLOW * speed))
    for b in range(bottom, high):
        for k in range(order - 1, order + 1):
            size = abs(stack.velocity_series[b * TERMS + k])
            if size > 0.0:
                step = min(step, (allowed / size) ** (1.0 / k))
    return step


@kernel
def _steep_step(stack: Stack, i: int, order: int) -> float:
    """Return the time in which a power of contact i's compression may change by e^(order/2).

    A steeper force grows from nothing to everything past the terms that a series ends with.
    """
    reach = 0.5 * order * stack.compression[i] / stack.curve_exponent[i]
    first = abs(stack.compression_series[i * TERMS + 1])
    second = abs(stack.compression_series[i * TERMS + 2])
    return 2.0 * reach / (first + math.sqrt(first * first + 4.0 * second * reach) + _TINY)


@kernel
def _own_speed(stack: Stack, low: int, high: int) -> float:
    """Return a speed that a cluster has, or could have from what it holds.

    An overdamped contact ends at a far smaller speed than it began: it counts, not the first one.
    """
    fastest, mass, stored = 0.0, 0.0, 0.0
    for b in range(max(low - 1, 0), high):
        fastest = max(fastest, abs(stack.velocity[b]))
        mass += stack.mass[b]
    for i in range(low, high):
        stored += stored_energy(stack, i, stack.compression[i])
    return max(fastest, math.sqrt(2.0 * stored / mass))


@kernel
def _force_term(stack: Stack, i: int, k: int) -> float:
    """Return term k of the force of contact i on the curve that it follows."""
    at = i * TERMS
    if stack.law[i] != DAMPED:
        return _power_of_compression(stack, i, k)
    below = stack.velocity_series[(i - 1) * TERMS + k] if i > 0 else 0.0
    above = stack.velocity_series[i * TERMS + k]
    gain = stack.gain_slope[i] * stack.compression_series[at + k]
    gain += stack.gain_rate[i] * (below - above)
    if k == 0:
        gain += stack.gain_constant[i]
    if stack.curve_exponent[i] == 0.0:
        return stack.curve_force[i] * gain
    stack.gain_series[at + k] = gain
    stack.elastic_series[at + k] = _power_of_compression(stack, i, k)
    total = 0.0
    for j in range(k + 1):
        total += stack.elastic_series[at + j] * stack.gain_series[at + k - j]
    return total


@kernel
def _power_of_compression(stack: Stack, i: int, k: int) -> float:
    """Return term k of curve_force (c/curve_unit)^curve_exponent, or of its chord."""
    at = i * TERMS
    exponent = stack.curve_exponent[i]
    if stack.faint[i] == 1 or exponent == 1.0:
        return stack.rate[i] * stack.compression_series[at + k]
    unit = stack.curve_unit[i]
    term = power_term(stack.compression_series, unit, stack.power_series, at, exponent, k)
    stack.power_series[at + k] = term
    return stack.curve_force[i] * term


@kernel
def record_crests(stack: Stack, low: int, high: int, s: float) -> None:
    """Keep the largest force and compression of damped contacts up to s after their anchor."""
    for i in range(low, high):
        if stack.law[i] == DAMPED:
            order = stack.order[i]
            crest = _crest(stack.force_series, i * TERMS, order, s)
            stack.peak_force[i] = max(stack.peak_force[i], crest)
            crest = _crest(stack.compression_series, i * TERMS, order + 1, s)
            stack.peak_compression[i] = max(stack.peak_compression[i], crest)


@kernel
def _crest(a: Floats, offset: int, n: int, s: float) -> float:
    """Return the largest value of a series from 0 to s."""
    largest = max(a[offset], value(a, offset, n, s))
    for part in range(_PARTS):
        left, right = s * part / _PARTS, s * (part + 1) / _PARTS
        if _slope(a, offset, n, left) <= 0.0 or _slope(a, offset, n, right) >= 0.0:
            continue
        for _ in range(50):
            middle = 0.5 * (left + right)
            if _slope(a, offset, n, middle) > 0.0:
                left = middle
            else:
                right = middle
        largest = max(largest, value(a, offset, n, left))
    return largest


@kernel
def _slope(a: Floats, offset: int, n: int, s: float) -> float:
    """Return the derivative of a series at s."""
    total = n * a[offset + n]
    for k in range(n - 1, 0, -1):
        total = k * a[offset + k] + s * total
    return total
