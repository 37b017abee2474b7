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

A damped contact's force is a power of c times its *gain* a + b c + d c'. It stays compressing until
the gain falls through 0 (CLIPPED: slack), or c does. Below a compression that holds a negligible
part of a typical contact's work a power law is continued by its chord (PRESSED, FAINT), because
c^p has no power series at c = 0.

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
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.motion import compression_series, meet_anchors
from stackbounce.engine.queue import schedule
from stackbounce.engine.series import parabola_root, safe_step
from stackbounce.engine.stack import Stack

_NOTHING = 1000.0 * EPSILON**2  # round-off of a motion that is itself round-off
_STEEPEST = 10.0  # times its first unloading exponent, for a lossy contact reloaded many times
_LOOSE = 10.0  # times the tolerance of a step: what a touch must stand clear of
_FAINT_EXIT = 0.9  # the chord is left above 1 and taken below 0.9 of its end


@kernel
def force(stack: Stack, i: int, compression: float, rate: float) -> float:
    """Return the force of contact i on the curve that it follows."""
    if stack.phase[i] < COMPRESSING:
        return 0.0
    exponent = stack.curve_exponent[i]
    if stack.faint[i] == 1 or exponent == 1.0:
        pressing = stack.rate[i] * compression
    else:
        ratio = max(0.0, compression / stack.curve_unit[i])
        power: float = ratio**exponent
        pressing = stack.curve_force[i] * power
    if stack.law[i] == DAMPED:
        gain = stack.gain_constant[i] + stack.gain_slope[i] * compression
        return pressing * max(0.0, gain + stack.gain_rate[i] * rate)
    return pressing


@kernel
def stored_energy(stack: Stack, i: int, compression: float) -> float:
    """Return what contact i would give back if nothing damped it on its way out."""
    if stack.phase[i] == OPEN:
        return 0.0
    if stack.law[i] == DAMPED:
        exponent = stack.exponent[i] + 1.0
        power: float = max(0.0, compression) ** exponent
        return stack.stiffness[i] * power / exponent
    exponent = stack.curve_exponent[i]
    if stack.law[i] != POWER and stack.top[i] == math.inf:
        exponent = stack.unloading[i]
    return force(stack, i, compression, 0.0) * compression / (exponent + 1.0)


@kernel
def look(stack: Stack, i: int, time: float) -> None:
    """Set when contact i is due again, and what will have happened by then."""
    size = len(stack.mass)
    phase = stack.phase[i]
    if stack.law[i] == ABSENT:
        return
    if phase < COMPRESSING:
        meet_anchors(stack, i)
    a = stack.watched
    order, power, tail, noise, rate_noise = compression_series(stack, i, time, a)
    if not math.isfinite(tail + noise + rate_noise + a[0] + a[1] + a[order]):
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
        return
    # round-off: of the solution, of the clock, and never less than that of a typical compression
    tick = 4.0 * EPSILON * time
    band = max(noise + tick * abs(a[1]), 4.0 * EPSILON * stack.scale[i])
    rate_band = max(rate_noise + tick * abs(2.0 * a[2]), 4.0 * EPSILON * stack.number[1])
    horizon = stack.due[size + stack.first[i]]
    if i > 0:
        horizon = min(horizon, stack.due[size + stack.first[i - 1]])
    horizon -= time
    wait, reached, kind = math.inf, False, LOOK
    if phase == OPEN:
        if stack.setting[1] == 1:  # nor than the error that nonlinear motion has by choice
            band += _LOOSE * stack.number[2] * stack.scale[i]
            rate_band += _LOOSE * stack.number[2] * stack.number[1]
        if a[0] < -band or a[1] < -rate_band:
            stack.touching[i] = math.nan
        if not _never_meets(stack, i, a, order):
            kind = TOUCH
            wait, reached = _wait(stack, a, order, power, tail, 0.0, -1.0, 0.0, band, horizon)
        _note(stack, i, time, wait, reached, kind, horizon)
        return
    still = rate_noise < _NOTHING * stack.number[1] and noise < _NOTHING * stack.scale[i]
    if phase >= COMPRESSING and still and stack.modal[stack.first[i]] == 1:
        _note(stack, i, time, 0.0, True, RELEASE, horizon)
        return
    damped = stack.law[i] == DAMPED
    if damped or phase == RELEASING:
        level, kind = _lower_level(stack, i)
        wait, reached = _wait(stack, a, order, power, tail, 0.0, 1.0, level, band, horizon)
    level, upper_kind = _upper_level(stack, i)
    if level < math.inf:
        other, there = _wait(stack, a, order, power, tail, 0.0, -1.0, level, band, horizon)
        if other < wait:
            wait, reached, kind = other, there, upper_kind
    if damped:
        noise = max(noise, 16.0 * EPSILON * abs(a[0])) + tick * abs(a[1])
        speed = stack.speed[i] + abs(a[1])
        rate_noise = max(rate_noise, 16.0 * EPSILON * speed) + tick * abs(2.0 * a[2])
        other, there = _gain_wait(stack, i, order, power, tail, noise, rate_noise, horizon)
        turn_kind = RESUMED if phase == SLACK else CLIPPED
    elif phase == COMPRESSING or stack.law[i] == LOSSY:
        for k in range(order):
            a[k] = (k + 1) * a[k + 1]
        sign = 1.0 if phase == COMPRESSING else -1.0
        other, there = _wait(
            stack, a, order - 1, power - 1, power * tail, 0.0, sign, 0.0, rate_band, horizon
        )
        turn_kind = PEAK if phase == COMPRESSING else DIP
    else:
        other, there, turn_kind = math.inf, False, LOOK
    if other < wait:
        wait, reached, kind = other, there, turn_kind
    _note(stack, i, time, wait, reached, kind, horizon)


@kernel
def _lower_level(stack: Stack, i: int) -> tuple[float, int]:
    """Return the compression below which contact i changes, and how it does."""
    smooth = stack.curve_exponent[i] == 0.0 or stack.curve_exponent[i] == 1.0
    if smooth or stack.faint[i] == 1 or stack.phase[i] == SLACK:
        return 0.0, RELEASE
    return _FAINT_EXIT * stack.faint_below[i], FAINT


@kernel
def _upper_level(stack: Stack, i: int) -> tuple[float, int]:
    """Return the compression above which contact i changes, and how it does."""
    level, kind = math.inf, LOOK
    phase = stack.phase[i]
    if phase == SLACK:
        return level, kind
    if phase == (COMPRESSING if stack.law[i] == LOSSY else RELEASING):
        level, kind = stack.top[i], RELOADED
    if stack.faint[i] == 1 and stack.faint_below[i] < level:
        level, kind = stack.faint_below[i], PRESSED
    return level, kind


@kernel
def _gain_wait(
    stack: Stack,
    i: int,
    order: int,
    power: int,
    tail: float,
    noise: float,
    rate_noise: float,
    horizon: float,
) -> tuple[float, bool]:
    """Return how long the gain of damped contact i surely keeps its sign; see `_wait`."""
    a, gain = stack.watched, stack.changed
    slope, rate = stack.gain_slope[i], stack.gain_rate[i]
    for k in range(order):
        gain[k] = slope * a[k] + rate * (k + 1) * a[k + 1]
    gain[order] = slope * a[order]
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
    if time + wait <= time:
        reached = True  # closer than the clock can tell
    stack.event[i] = kind if reached else LOOK
    due = time + wait if wait < horizon else math.inf
    schedule(stack.due, stack.heap, stack.place, i, due)


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


@kernel
def begin(stack: Stack, i: int, time: float) -> None:
    """Close contact i at a time, or at the time since when it has been touching."""
    stack.start[i] = time if math.isnan(stack.touching[i]) else stack.touching[i]
    stack.touching[i] = math.nan
    stack.phase[i] = COMPRESSING
    stack.counter[4] += 1
    stack.peak_force[i] = 0.0
    stack.peak_compression[i] = 0.0
    stack.impulse[i] = 0.0
    _load(stack, i)
    smooth = stack.curve_exponent[i] == 0.0 or stack.curve_exponent[i] == 1.0
    stack.faint[i] = 0 if smooth else 1


@kernel
def _load(stack: Stack, i: int) -> None:
    """Let contact i follow its loading curve, k c^p or a power of c times a gain."""
    unit = stack.scale[i]
    exponent = stack.exponent[i]
    if stack.law[i] == DAMPED:
        exponent = stack.factor_exponent[i]
    _follow(stack, i, stack.stiffness[i] * unit**exponent, unit, exponent)
    stack.top[i] = math.inf
    if exponent == 1.0:
        stack.rate[i] = stack.stiffness[i]


@kernel
def _follow(stack: Stack, i: int, force_at_unit: float, unit: float, exponent: float) -> None:
    """Let contact i follow the curve force_at_unit (c/unit)^exponent."""
    stack.curve_force[i] = force_at_unit
    stack.curve_unit[i] = unit
    stack.curve_exponent[i] = exponent
    stack.faint[i] = 0
    ratio = stack.number[3] ** (1.0 / (exponent + 1.0))
    stack.faint_below[i] = ratio * unit
    stack.rate[i] = force_at_unit * ratio ** (exponent - 1.0) / unit


@kernel
def _steepen(stack: Stack, i: int, compression: float) -> None:
    """Let contact i, turning back below its old peak, give back e^2 of what reloading took.

    The exponent has a limit: some contacts would become a wall after infinitely many cycles.
    """
    pressing = force(stack, i, compression, 0.0)
    exponent = stack.exponent[i]
    kept = (exponent + 1.0) / (stack.unloading[i] + 1.0)
    reloaded = stored_energy(stack, i, compression)
    energy = stack.dip_energy[i] + kept * (reloaded - stack.dip_energy[i])
    steeper = min(pressing * compression / energy - 1.0, _STEEPEST * stack.unloading[i])
    if steeper <= stack.curve_exponent[i]:
        return
    meeting = stack.stiffness[i] * compression**exponent / pressing
    _follow(stack, i, pressing, compression, steeper)
    stack.top[i] = compression * meeting ** (1.0 / (steeper - exponent))


@kernel
def record_peak(stack: Stack, i: int, compression: float, rate: float) -> None:
    """Keep the largest force and compression of the interval under way."""
    stack.peak_force[i] = max(stack.peak_force[i], force(stack, i, compression, rate))
    stack.peak_compression[i] = max(stack.peak_compression[i], compression)


@kernel
def changes_curve(stack: Stack, i: int, kind: int) -> bool:
    """Tell whether after an event inside an interval the force follows another curve."""
    if kind == PEAK:
        return stack.law[i] == LOSSY or (stack.law[i] != POWER and stack.top[i] == math.inf)
    if kind == RELOADED:
        return stack.law[i] != POWER
    return kind != DIP


@kernel
def turn(stack: Stack, i: int, kind: int, compression: float) -> None:
    """Let contact i turn from compressing to releasing or back, on the same curve."""
    if kind == DIP:
        stack.dip_energy[i] = stored_energy(stack, i, compression)
    if kind == PEAK:
        stack.phase[i] = RELEASING
        stack.top[i] = max(compression, stack.peak_compression[i])
    else:
        stack.phase[i] = COMPRESSING


@kernel
def change_curve(stack: Stack, i: int, kind: int) -> None:
    """Let contact i, anchored now, follow the curve that an event inside its interval leads to."""
    compression = stack.compression[i]
    if kind == PEAK:
        stack.phase[i] = RELEASING
        if stack.top[i] == math.inf:
            pressing = force(stack, i, compression, 0.0)
            _follow(stack, i, pressing, compression, stack.unloading[i])
            stack.top[i] = compression
        else:
            _steepen(stack, i, compression)
    elif kind == RELOADED:
        stack.phase[i] = COMPRESSING
        _load(stack, i)
    elif kind == RESUMED:
        stack.phase[i] = COMPRESSING
    else:
        stack.faint[i] = 1 if kind == FAINT else 0


@kernel
def clip(stack: Stack, i: int, time: float) -> None:
    """Let damped contact i, anchored at this time, exert no force while it would pull."""
    stack.phase[i] = SLACK
    stack.clip_time[i] = time
    stack.clip_lower[i] = stack.velocity[i - 1] if i > 0 else 0.0
    stack.clip_upper[i] = stack.velocity[i]
