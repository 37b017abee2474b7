"""What ends the present phase of a contact, when, and what comes after it.

=========== ============================ =====================================================
phase       ends when                    and then
=========== ============================ =====================================================
open        c rises through 0            TOUCH: compressing along the loading curve
compressing the rate falls through 0     PEAK: releasing; a hysteretic contact takes the unloading
                                         curve from here if it was on the loading curve
..          c of a lossy contact meets   RELOADED: back on the loading curve
            the old peak
releasing   c rises through its old peak RELOADED: compressing, on the loading curve
..          c falls through 0            RELEASE: open
..          the rate of a lossy contact  DIP: compressing
            rises through 0
slack       the gain rises through 0     RESUMED: compressing
..          c falls through 0            RELEASE: open since the force was clipped
=========== ============================ =====================================================

A force that follows one power law both ways has no event at its peak where its cluster moves by a
power series: `record_crests` reads the peak off the series.

A sign counts once it stands clear of round-off: an open contact that only grazes within its own
round-off has not touched, and balls that part with equal speeds within theirs do not approach.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    CLIPPED,
    COMPRESSING,
    DAMPED,
    DIP,
    EPSILON,
    FAINT,
    LOOK,
    LOSSY,
    OPEN,
    PEAK,
    POWER,
    PRESSED,
    RELEASE,
    RELEASING,
    RELOADED,
    RESUMED,
    SLACK,
    TOUCH,
)
from stackbounce.engine.contacts import chord_budget
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.motion import (
    compression_series,
    contact_impulse,
    meet_anchors,
    root_at,
    series_time,
)
from stackbounce.engine.series import fall, lower_bound, parabola_root, safe_step, shift
from stackbounce.engine.stack import Stack

_NOTHING = 1000.0 * EPSILON**2  # round-off of a motion that is itself round-off
_LOOSE = 10.0  # times the tolerance of a step: what a touch must stand clear of
_FAINT_EXIT = 0.9  # the chord is left above 1 and taken below 0.9 of its end


@kernel
def look(stack: Stack, i: int, time: float) -> None:
    """Set when contact i is due again, and what will have happened by then."""
    size = len(stack.mass)
    phase = stack.phase[i]
    if stack.law[i] == ABSENT:
        return
    if phase < COMPRESSING:
        meet_anchors(stack, i)
    elif _stays(stack, i, time):
        stack.event[i] = LOOK
        schedule(stack.due, stack.heap, stack.place, i, math.inf)
        return
    a = stack.watched
    root = root_at(stack, i)
    order, power, tail, noise, rate_noise = compression_series(stack, i, time, root, a)
    if not math.isfinite(tail + noise + rate_noise + a[0] + a[1] + a[order]):
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
        return
    # round-off: of the solution, of the clock, and never less than that of a typical compression
    tick = 4.0 * EPSILON * time
    rate, second = abs(a[root]), abs(2.0 * a[2 * root])
    band = max(noise + tick * rate, 4.0 * EPSILON * stack.scale[i])
    rate_band = max(rate_noise + tick * second, 4.0 * EPSILON * stack.number[1])
    horizon = stack.due[size + stack.first[i]]
    if i > 0:
        horizon = min(horizon, stack.due[size + stack.first[i - 1]])
    horizon -= time
    if root == 2:
        horizon = math.sqrt(horizon)
    wait, reached, kind = math.inf, False, LOOK
    if phase == OPEN:
        if stack.setting[1] == 1:  # nor than the error that nonlinear motion has by choice
            band += _LOOSE * stack.number[2] * stack.scale[i]
            rate_band += _LOOSE * stack.number[2] * stack.number[1]
        if a[0] < -band or a[root] < -rate_band:
            stack.touching[i] = math.nan
        if not _never_meets(stack, i, a, order):
            kind = TOUCH
            if root == 2 and _is_pushed(stack, i, a, order):
                wait, reached = 0.0, True
            else:
                wait, reached = _wait(stack, a, order, power, tail, 0.0, -1.0, 0.0, band, horizon)
        _note(stack, i, time, wait, reached, kind, horizon)
        return
    still = rate_noise < _NOTHING * stack.number[1] and noise < _NOTHING * stack.scale[i]
    if phase >= COMPRESSING and still and stack.modal[stack.first[i]] == 1:
        _note(stack, i, time, 0.0, True, RELEASE, horizon)
        return
    damped = stack.law[i] == DAMPED
    plain = stack.law[i] == POWER and stack.modal[stack.first[i]] == 0
    if damped:
        noise = max(noise, 16.0 * EPSILON * abs(a[0])) + tick * rate
        speed = stack.speed[i] + rate
        rate_noise = max(rate_noise, 16.0 * EPSILON * speed) + tick * second
        wait, reached = _gain_wait(stack, i, order, power, tail, noise, rate_noise, root, horizon)
        kind = RESUMED if phase == SLACK else CLIPPED
    if damped or plain or phase == RELEASING:
        left = min(wait, horizon)
        other, there = _wait(stack, a, order, power, tail, 0.0, 1.0, 0.0, band, left)
        if other < left or (there and other <= left < horizon):
            wait, reached, kind = other, there, RELEASE
        level = _faint_level(stack, i)
        if level > 0.0 and (wait >= horizon or not reached):  # else the series gets to the very end
            left = min(wait, horizon)
            other, there = _wait(stack, a, order, power, tail, 0.0, 1.0, level, band, left)
            if other < left:
                wait, reached, kind = other, there, FAINT
    level, upper_kind = _upper_level(stack, i, plain)
    if level < math.inf:
        left = min(wait, horizon)
        other, there = _wait(stack, a, order, power, tail, 0.0, -1.0, level, band, left)
        if other < wait:
            wait, reached, kind = other, there, upper_kind
    if stack.faint[i] == 1 and phase >= COMPRESSING:
        other, there = _chord_wait(stack, i, time, order, power, tail, min(wait, horizon))
        if other < wait:
            wait, reached, kind = other, there, PRESSED
    if not (damped or plain) and (phase == COMPRESSING or stack.law[i] == LOSSY):
        for k in range(order - root + 1):
            a[k] = (k + root) * a[k + root] / root
        sign, left = 1.0 if phase == COMPRESSING else -1.0, min(wait, horizon)
        other, there = _wait(
            stack, a, order - root, power - 1, power * tail, 0.0, sign, 0.0, rate_band, left
        )
        if other < wait:
            wait, reached, kind = other, there, PEAK if phase == COMPRESSING else DIP
    _note(stack, i, time, wait, reached, kind, horizon)


@kernel
def _stays(stack: Stack, i: int, time: float) -> bool:
    """Tell whether a bound is enough to see that contact i keeps its curve while its series lasts.

    That is the rule along an interval; whatever is near its end takes a closer look.
    """
    first, law = stack.first[i], stack.law[i]
    if stack.modal[first] == 1 or stack.anchor[first] != time or stack.faint[i] == 1:
        return False
    if law not in (POWER, DAMPED) or stack.phase[i] != COMPRESSING:
        return False
    horizon = series_time(stack, first, stack.due[len(stack.mass) + first] - time)
    order, c = stack.order[first], stack.compression_series[i]
    begins = stack.root[first] if c[0] == 0.0 else 0  # with that power of the series' argument
    least = lower_bound(c, begins, order + stack.root[first], horizon)
    if law == DAMPED and not lower_bound(stack.gain_series[i], 0, order, horizon) > 0.0:
        return False
    return least > _faint_level(stack, i)


@kernel
def _faint_level(stack: Stack, i: int) -> float:
    """Return the compression below which contact i takes the chord of its curve, 0 for none."""
    smooth = stack.curve_exponent[i] == 0.0 or stack.curve_exponent[i] == 1.0
    if smooth or stack.faint[i] == 1 or stack.phase[i] == SLACK:
        return 0.0
    if root_at(stack, i) == 2 and stack.phase[i] == COMPRESSING:
        return 0.0
    return _FAINT_EXIT * stack.faint_below[i]


@kernel
def _upper_level(stack: Stack, i: int, plain: bool) -> tuple[float, int]:
    """Return the compression above which contact i changes, and how it does."""
    level, kind = math.inf, LOOK
    phase = stack.phase[i]
    if phase == SLACK:
        return level, kind
    if not plain and phase == (COMPRESSING if stack.law[i] == LOSSY else RELEASING):
        level, kind = stack.top[i], RELOADED
    if stack.faint[i] == 1 and stack.faint_below[i] < level:
        level, kind = stack.faint_below[i], PRESSED
    return level, kind


@kernel
def _chord_wait(
    stack: Stack, i: int, time: float, order: int, power: int, tail: float, horizon: float
) -> tuple[float, bool]:
    """Return how long contact i may surely follow its chord; see `_wait`."""
    spent = stack.changed
    first = stack.first[i]
    s = time - stack.anchor[first]
    spent[0] = stack.faint_impulse[i] + contact_impulse(stack, i, s)
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
        spent[1] = 0.0  # stays so in a series in the root of time
        for k in range(root, order + 1):
            spent[k] = root * stack.scratch[k - root] / k
    budget = chord_budget(stack, i)
    band = 0.1 * budget
    return _wait(stack, spent, order, power, tail, 0.0, -1.0, budget, band, horizon)


@kernel
def _gain_wait(
    stack: Stack,
    i: int,
    order: int,
    power: int,
    tail: float,
    noise: float,
    rate_noise: float,
    root: int,
    horizon: float,
) -> tuple[float, bool]:
    """Return how long the gain of damped contact i surely keeps its sign; see `_wait`."""
    a, gain = stack.watched, stack.changed
    slope, rate = stack.gain_slope[i], stack.gain_rate[i]
    for k in range(order + 1):
        gain[k] = slope * a[k]
    for k in range(order - root + 1):
        gain[k] += rate * (k + root) * a[k + root] / root
    gain[0] += stack.gain_constant[i]
    noise = max(noise, EPSILON * EPSILON * stack.scale[i])
    rate_noise = max(rate_noise, EPSILON * EPSILON * stack.number[1])
    clear = slope * noise + rate * rate_noise + 4.0 * EPSILON * stack.gain_constant[i]
    sign = -1.0 if stack.phase[i] == SLACK else 1.0
    level = 0.0
    if stack.factor_exponent[i] > 0.0:
        clear += rate * stack.number[2] * stack.number[1]
    if slope == 0.0:
        clear *= 10.0  # this gain may creep towards zero and never fall through it
    elif sign < 0.0:
        level = 2.0 * clear
    elif gain[0] <= clear and gain[1] < 0.0 and a[1] < 0.0:
        return 0.0, True  # an overdamped contact would creep apart for ever with no force to tell
    return _wait(
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


@kernel
def _note(
    stack: Stack, i: int, time: float, wait: float, reached: bool, kind: int, horizon: float
) -> None:
    """Write down when contact i is due: not at all where its cluster's series ends before."""
    if root_at(stack, i) == 2:
        wait, horizon = wait * wait, horizon * horizon
    if time + wait <= time:
        reached = True  # closer than the clock can tell
    stack.event[i] = kind if reached else LOOK
    due = time + wait if wait < horizon else math.inf
    schedule(stack.due, stack.heap, stack.place, i, due)


@kernel
def _is_pushed(stack: Stack, i: int, a: Floats, order: int) -> bool:
    """Tell whether two balls that touch, at equal speeds, are being pushed together."""
    if math.isnan(stack.touching[i]):
        return False
    for k in range(order + 1):
        if a[k] != 0.0:
            return a[k] > 0.0
    return False


@kernel
def _never_meets(stack: Stack, i: int, a: Floats, order: int) -> bool:
    """Tell whether two balls in flight (or one and the floor) part, or keep their distance."""
    if order > 2 or a[2] != 0.0:
        return False
    noise = stack.velocity_noise[i]
    if i > 0:
        noise += stack.velocity_noise[i - 1]
    return a[1] <= noise


@kernel
def _wait(
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
    """Return how long sign (f - level) surely stays above -band/2, and whether it is there then.

    The function f is within ``tail s^power + more s^(power+1)`` of its series.
    """
    if tail == 0.0 and order > 2 and horizon < math.inf:
        wait, reached = fall(a, order, sign, level, band, horizon)
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
    # where the rest of the series is as large, as a power of two: no unit's choice changes a bit
    _, exponent = math.frexp(size / tail)
    natural = math.ldexp(8.0, exponent // power)
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
