"""The next event of a contact: when its present phase ends, and what follows.

=========== ============================ =====================================================
phase       ends when                    event and next phase
=========== ============================ =====================================================
open        c rises through 0, or        TOUCH: compressing along the loading curve
..          through the surface          (if the contact creeps)
compressing the rate falls through 0     PEAK: releasing; with hysteresis along the unloading curve
                                         from here
..          c rises through the peak of  RETURNED: the same, as before that cycle, see `cycles`
            the present cycle
releasing   c falls through 0            RELEASE: open
..          c of a spring rises through  RETURNED: compressing, to another peak
            its peak
..          c falls to where the present RETURNED: the same, as before that cycle
            cycle began
..          the rate of a contact with   DIP: compressing, in a cycle inside the present one
            hysteresis rises through 0
any above   c passes a knot              CROSSED: the same, on the next piece of the curve
..          the gain falls through 0     CLIPPED: unloaded; of a contact that creeps RELEASE: open
unloaded    the gain rises through 0     RESUMED: compressing
..          c falls through 0            RELEASE: open since the force was clipped
=========== ============================ =====================================================

A bond has no events: it never opens, and its force has one formula.

A lossless power-law contact in a cluster that is solved by Taylor series has no PEAK event:
`record_series_peaks` finds the peak from the series.

A change of sign counts only if it exceeds round-off: an open contact that grazes within its
round-off has not touched, and balls whose speeds are equal within theirs do not approach. A gain
that exceeds its round-off only long after its zero is clipped at the zero all the same.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    CHECK,
    CLIPPED,
    COMPRESSING,
    CROSSED,
    CURVED,
    DIP,
    EPSILON,
    LINEARISED,
    OPEN,
    PEAK,
    PIECEWISE,
    POWER,
    PRODUCT,
    RELEASE,
    RELEASING,
    RESUMED,
    RETURNED,
    TOUCH,
    UNLOADED,
)
from stackbounce.engine.contacts import linearised_impulse_limit
from stackbounce.engine.cycles import has_hysteresis, lowest_compression
from stackbounce.engine.elementary import exponent_of, times_power_of_two
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.forces import creeps, is_damped
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.motion import (
    KNOWN,
    align_anchors,
    compression_series,
    contact_impulse,
    root_at,
    series_time,
    subtract_surface,
)
from stackbounce.engine.series import (
    differentiate,
    evaluate,
    lower_bound,
    parabola_root,
    safe_step,
    shift,
    time_to_level,
)
from stackbounce.engine.slots import NONLINEAR, SPEED, TOLERANCE
from stackbounce.engine.stack import Stack

# round-off below this fraction of a typical motion: the motion itself is only round-off
_NOTHING = 1000.0 * EPSILON * EPSILON
_LOOSE = 10.0  # a touch must exceed this times the tolerance of a step
_NEAR = 2e-12  # of a time: the end of a force that is no later than that is left where it is,
_NEWTON = 6  # else so many steps lead back to the zero,
_CONVERGED = 1e-3  # if the last is at most that part of them all
_LINEARISED_EXIT = 0.9  # of ``linearised_below``: the chord is left above 1 and taken below this,
_LOGARITHMS = 1e3  # or where the logarithm of the force has changed by this


@kernel
def schedule_next_event(stack: Stack, i: int, time: float) -> None:
    """Schedule the next event of contact i, or a check if no event is certain yet."""
    size = len(stack.mass)
    phase = stack.phase[i]
    if stack.law[i] == ABSENT:
        return
    if stack.bonded[i] == 1:
        schedule(stack.due, stack.heap, stack.place, i, math.inf)
        return
    if phase < COMPRESSING:
        align_anchors(stack, i)
    elif _keeps_curve(stack, i, time):
        stack.event[i] = CHECK
        schedule(stack.due, stack.heap, stack.place, i, math.inf)
        return
    a = stack.watched
    root = root_at(stack, i)
    order, power, tail, noise, rate_noise = compression_series(stack, i, time, root, a)
    if not math.isfinite(tail + noise + rate_noise + a[0] + a[1] + a[order]):
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
        return
    straight = order <= 2 and a[2] == 0.0
    if phase == OPEN and stack.creep[i] > 0.0:
        noise += 8.0 * EPSILON * abs(a[0])
        last, power, rest = subtract_surface(stack, i, time, root, a)
        order, tail = max(order, last), tail + rest
    # round-off of the solution, of the time, and at least that of a typical compression
    tick = 4.0 * EPSILON * time
    rate, second = abs(a[root]), abs(2.0 * a[2 * root])
    band = max(noise + tick * rate, 4.0 * EPSILON * stack.scale[i])
    rate_band = max(rate_noise + tick * second, 4.0 * EPSILON * stack.number[SPEED])
    horizon = stack.due[size + stack.first[i]]
    if i > 0:
        horizon = min(horizon, stack.due[size + stack.first[i - 1]])
    horizon -= time
    if root == 2:
        horizon = math.sqrt(horizon)
    wait, reached, kind = math.inf, False, CHECK
    if phase == OPEN:
        if stack.setting[NONLINEAR] == 1:  # and at least the tolerance of nonlinear motion
            band += _LOOSE * stack.number[TOLERANCE] * stack.scale[i]
            rate_band += _LOOSE * stack.number[TOLERANCE] * stack.number[SPEED]
        if a[0] < -band or a[root] < -rate_band:
            stack.touching[i] = math.nan
        if not (straight and _never_meets(stack, i, a)):
            kind = TOUCH
            if root == 2 and _is_pressed_together(stack, i, a, order):
                wait, reached = 0.0, True
            else:
                wait, reached = _safe_wait(
                    stack, a, order, power, tail, 0.0, -1.0, 0.0, band, horizon
                )
        _schedule(stack, i, time, wait, reached, kind, horizon)
        return
    still = rate_noise < _NOTHING * stack.number[SPEED] and noise < _NOTHING * stack.scale[i]
    if phase >= COMPRESSING and still and stack.modal[stack.first[i]] == 1:
        _schedule(stack, i, time, 0.0, True, RELEASE, horizon)
        return
    plain = not has_hysteresis(stack, i)
    plain = plain and not (stack.law[i] == POWER and stack.modal[stack.first[i]] == 1)
    if is_damped(stack, i):
        noise = max(noise, 16.0 * EPSILON * abs(a[0])) + tick * rate
        speed = stack.speed[i] + rate
        rate_noise = max(rate_noise, 16.0 * EPSILON * speed) + tick * second
        wait, reached = _gain_wait(
            stack, i, time, order, power, tail, noise, rate_noise, root, horizon
        )
        kind = RESUMED if phase == UNLOADED else CLIPPED
    if creeps(stack, i):
        kind = RELEASE
    elif plain or phase == RELEASING:
        left = min(wait, horizon)
        level, lower_kind = _lower_level(stack, i)
        other, there = _safe_wait(stack, a, order, power, tail, 0.0, 1.0, level, band, left)
        if other < left or (there and other <= left < horizon):
            wait, reached, kind = other, there, lower_kind
        level = _linearised_level(stack, i)
        # else the series is valid up to the release
        if level > 0.0 and (wait >= horizon or not reached):
            left = min(wait, horizon)
            other, there = _safe_wait(stack, a, order, power, tail, 0.0, 1.0, level, band, left)
            if other < left:
                wait, reached, kind = other, there, LINEARISED
    level, upper_kind = _upper_level(stack, i, plain)
    if level < math.inf:
        left = min(wait, horizon)
        other, there = _safe_wait(stack, a, order, power, tail, 0.0, -1.0, level, band, left)
        if other < wait:
            wait, reached, kind = other, there, upper_kind
    if stack.linearised[i] == 1 and stack.rate[i] > 0.0 and phase >= COMPRESSING:
        other, there = _linearised_wait(stack, i, time, order, power, tail, min(wait, horizon))
        if other < wait:
            wait, reached, kind = other, there, CURVED
    if not plain and (phase == COMPRESSING or has_hysteresis(stack, i)):
        for k in range(order - root + 1):
            a[k] = (k + root) * a[k + root] / root
        sign, left = 1.0 if phase == COMPRESSING else -1.0, min(wait, horizon)
        other, there = _safe_wait(
            stack, a, order - root, power - 1, power * tail, 0.0, sign, 0.0, rate_band, left
        )
        if other < wait:
            wait, reached, kind = other, there, PEAK if phase == COMPRESSING else DIP
    _schedule(stack, i, time, wait, reached, kind, horizon)


@kernel
def _keeps_curve(stack: Stack, i: int, time: float) -> bool:
    """Return whether contact i surely has no event while its cluster's series is valid.

    A lower bound of the compression, and of the gain of a damped contact, decides. It is true
    during most of an interval, which saves the search for the event.
    """
    first, law = stack.first[i], stack.law[i]
    if stack.modal[first] == 1 or stack.anchor[first] != time or stack.linearised[i] == 1:
        return False
    if law not in (POWER, PRODUCT) or stack.phase[i] != COMPRESSING:
        return False
    horizon = series_time(stack, first, stack.due[len(stack.mass) + first] - time)
    order, c = stack.order[first], stack.compression_series[i]
    begins = stack.root[first] if c[0] == 0.0 else 0  # the lowest power of the series that is not 0
    least = lower_bound(c, begins, order + stack.root[first], horizon)
    if law == PRODUCT and not lower_bound(stack.gain_series[i], 0, order, horizon) > 0.0:
        return False
    return least > _linearised_level(stack, i)


@kernel
def _linearised_level(stack: Stack, i: int) -> float:
    """Return the compression below which contact i must be linearised; 0 if it need not be."""
    smooth = stack.curve_exponent[i] == 0.0 or stack.curve_exponent[i] == 1.0
    if smooth or stack.linearised[i] == 1 or stack.phase[i] == UNLOADED:
        return 0.0
    if root_at(stack, i) == 2 and stack.phase[i] == COMPRESSING:
        return 0.0
    ratio = max(_LINEARISED_EXIT, 1.0 - _LOGARITHMS / stack.curve_exponent[i])
    return ratio * stack.linearised_below[i]


@kernel
def _lower_level(stack: Stack, i: int) -> tuple[float, int]:
    """Return the compression below which contact i opens or changes its curve, and the event."""
    level, kind = lowest_compression(stack, i), RELEASE
    if level > 0.0:
        kind = RETURNED
    if stack.law[i] == PIECEWISE and stack.piece_low[i] > level:
        level, kind = stack.piece_low[i], CROSSED
    return level, kind


@kernel
def _upper_level(stack: Stack, i: int, plain: bool) -> tuple[float, int]:
    """Return the compression above which contact i changes its curve, and the kind of event."""
    level, kind = math.inf, CHECK
    phase = stack.phase[i]
    if phase == UNLOADED:
        return level, kind
    if not plain and phase == (COMPRESSING if has_hysteresis(stack, i) else RELEASING):
        level, kind = stack.top[i], RETURNED
    if stack.law[i] == PIECEWISE and stack.piece_high[i] < level:
        level, kind = stack.piece_high[i], CROSSED
    if stack.linearised[i] == 1 and stack.linearised_below[i] < level:
        level, kind = stack.linearised_below[i], CURVED
    return level, kind


@kernel
def _linearised_wait(
    stack: Stack, i: int, time: float, order: int, power: int, tail: float, horizon: float
) -> tuple[float, bool]:
    """Return how long the impulse along the chord of contact i surely stays below its limit.

    The results are those of `_safe_wait`.
    """
    spent = stack.changed
    first = stack.first[i]
    s = time - stack.anchor[first]
    spent[0] = stack.linearised_impulse[i] + contact_impulse(stack, i, s)
    if stack.modal[first] == 1:
        order += 1
        power += 1
        tail *= stack.rate[i] / power
        for k in range(order, 0, -1):
            spent[k] = stack.rate[i] * stack.watched[k - 1] / k
    else:
        root = stack.root[first]
        order = stack.order[first] + root
        shift(stack.force_series[i], order - root, s, stack.scratch)
        spent[1] = 0.0  # remains 0 in a series in the root of time
        for k in range(root, order + 1):
            spent[k] = root * stack.scratch[k - root] / k
    budget = linearised_impulse_limit(stack, i)
    band = 0.1 * budget
    return _safe_wait(stack, spent, order, power, tail, 0.0, -1.0, budget, band, horizon)


@kernel
def _gain_wait(
    stack: Stack,
    i: int,
    time: float,
    order: int,
    power: int,
    tail: float,
    noise: float,
    rate_noise: float,
    root: int,
    horizon: float,
) -> tuple[float, bool]:
    """Return how long the gain of damped contact i surely keeps its sign; see `_safe_wait`."""
    a, gain = stack.watched, stack.changed
    slope, rate = stack.gain_slope[i], stack.gain_rate[i]
    for k in range(order + 1):
        gain[k] = slope * a[k]
    for k in range(order - root + 1):
        gain[k] += rate * (k + root) * a[k + root] / root
    gain[0] += stack.gain_constant[i]
    if creeps(stack, i):
        since = time - stack.anchor[stack.first[i]]
        shift(stack.creep_series[i], order, since, stack.scratch)
        for k in range(order + 1):
            gain[k] -= stack.gain_creep[i] * stack.scratch[k]
    noise = max(noise, EPSILON * EPSILON * stack.scale[i])
    rate_noise = max(rate_noise, EPSILON * EPSILON * stack.number[SPEED])
    clear = slope * noise + rate * rate_noise + 4.0 * EPSILON * stack.gain_constant[i]
    sign = -1.0 if stack.phase[i] == UNLOADED else 1.0
    level = 0.0
    if stack.factor_exponent[i] > 0.0:
        clear += rate * stack.number[TOLERANCE] * stack.number[SPEED]
    if slope == 0.0:
        clear *= 10.0  # this gain may approach zero without ever falling through it
    elif sign < 0.0:
        level = 2.0 * clear
    elif gain[0] <= clear and gain[1] < 0.0 and a[1] < 0.0:
        # an overdamped contact would open infinitely slowly, with a negligible force
        return _zero_near(stack, i, time, order, root, 0.0, horizon), True
    wait, reached = _safe_wait(
        stack,
        gain,
        order,
        power - 1,
        rate * power * tail,
        slope * tail,
        sign,
        level,
        clear,
        horizon,
    )
    if reached and sign > 0.0:
        wait = _zero_near(stack, i, time, order, root, wait, horizon)
    return wait, reached


@kernel
def _zero_near(
    stack: Stack, i: int, time: float, order: int, root: int, near: float, horizon: float
) -> float:
    """Return where the gain of contact i falls through zero, or ``near`` if that is near enough.

    Near enough is what the tolerance leaves of a time after many steps. Under strong damping the
    gain passes zero so gently that it is clear of its round-off only later than that. The result is
    ``near`` as well if Newton's method finds no zero from now to the horizon.
    """
    share = _NEAR
    if stack.factor_exponent[i] > 0.0:
        share = max(share, KNOWN * stack.number[TOLERANCE])
    gain, x, step = stack.changed, near, 0.0
    found = near if root == 1 else near * near
    for _ in range(_NEWTON):
        rate = differentiate(gain, order, x)
        if rate >= 0.0:
            return near
        step = evaluate(gain, order, x) / rate
        x -= step
        zero = x if root == 1 else x * x
        if not 0.0 <= x <= horizon or abs(zero - found) <= share * (time + found):
            return near
    return x if abs(step) <= _CONVERGED * abs(x - near) else near


@kernel
def _schedule(
    stack: Stack, i: int, time: float, wait: float, reached: bool, kind: int, horizon: float
) -> None:
    """Schedule an event (``reached``) or a check of contact i after ``wait``.

    Nothing is scheduled if the cluster's series ends before: its renewal schedules the contact.
    """
    if root_at(stack, i) == 2:
        wait, horizon = wait * wait, horizon * horizon
    if time + wait <= time:
        reached = True  # shorter than the resolution of float64 time
    stack.event[i] = kind if reached else CHECK
    due = time + wait if wait < horizon else math.inf
    schedule(stack.due, stack.heap, stack.place, i, due)


@kernel
def _is_pressed_together(stack: Stack, i: int, a: Floats, order: int) -> bool:
    """Return whether neighbouring forces begin to compress a contact that touches without force."""
    if math.isnan(stack.touching[i]):
        return False
    for k in range(order + 1):
        if a[k] != 0.0:
            return a[k] > 0.0
    return False


@kernel
def _never_meets(stack: Stack, i: int, a: Floats) -> bool:
    """Return whether two balls in flight without relative acceleration do not approach each other.

    The lower one may be the floor. A surface that recovers does so ever more slowly.
    """
    noise = stack.velocity_noise[i]
    if i > 0:
        noise += stack.velocity_noise[i - 1]
    return a[1] <= noise


@kernel
def _safe_wait(
    stack: Stack,
    a: Floats,
    order: int,
    power: int,
    tail: float,
    more: float,
    sign: float,
    level: float,
    band: float,
    horizon: float,
) -> tuple[float, bool]:
    """Return a time s during which sign (f - level) surely stays above -band/2.

    The second result is True if it reaches -band/2 at s, and False if s is only a lower bound of
    that time. The function f differs from its power series ``a`` by at most
    ``tail s^power + more s^(power+1)``.
    """
    if tail == 0.0 and order > 2 and horizon < math.inf:
        wait, reached = time_to_level(a, order, sign, level, band, horizon)
        if reached or wait == horizon:
            return wait, reached
    f = stack.margin
    for k in range(order + 1):
        f[k] = sign * a[k]
    f[0] += band - sign * level
    if f[0] <= 0.5 * band:
        return 0.0, True
    if order <= 2 and tail == 0.0:
        for k in range(order + 1, 3):
            f[k] = 0.0
        return parabola_root(f[0] - 0.5 * band, f[1], f[2]), True
    if tail == 0.0:
        return min(safe_step(f, order, 0.0, horizon), horizon), False
    size = abs(f[0]) + band / EPSILON
    # where the remainder is as large, as a power of two: the choice of units changes no bit
    natural = times_power_of_two(8.0, exponent_of(size / tail) // power)
    if order < power and more == 0.0:
        for k in range(order + 1, power):
            f[k] = 0.0
        return safe_step(f, power - 1, tail, min(natural, horizon)), False
    last = max(order, power + 1)
    for k in range(order + 1, last + 1):
        f[k] = 0.0
    f[power] -= tail
    f[power + 1] -= more
    return safe_step(f, last, 0.0, min(natural, horizon)), False
