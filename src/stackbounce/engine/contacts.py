"""What ends the present phase of a contact, when, and what comes after it.

=========== ======================== =====================================================
phase       ends when                and then
=========== ======================== =====================================================
open        c rises through 0        TOUCH: compressing along the loading curve
compressing the rate falls through 0 PEAK: releasing; a hysteretic contact takes the unloading
                                     curve from here if it was on the loading curve
..          c meets the old peak     RELOADED: back on the loading curve
releasing   the rate rises through 0 DIP: compressing
..          c falls through 0        RELEASE: open
=========== ======================== =====================================================

A sign counts once it stands clear of round-off: an open contact that only grazes within its own
round-off has not touched, and balls that part with equal speeds within theirs do not approach.
Below a compression that holds 1e-18 of a typical contact's work a power law is continued by its
chord (PRESSED, FAINT), because c^p has no power series at c = 0.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    COMPRESSING,
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
    TOUCH,
)
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.motion import compression_series, meet_anchors
from stackbounce.engine.series import parabola_root, safe_step
from stackbounce.engine.stack import Stack

FAINT_WORK = 1e-18
_NOTHING = 1000.0 * EPSILON**2  # round-off of a motion that is itself round-off
_STEEPEST = 10.0  # times its first unloading exponent, for a lossy contact reloaded many times
_FAINT_EXIT = 0.9  # the chord is left above 1 and taken below 0.9 of its end


@kernel
def force(stack: Stack, i: int, compression: float) -> float:
    """Return the force of contact i on the curve that it follows."""
    if stack.phase[i] == OPEN:
        return 0.0
    if stack.faint[i] == 1 or stack.curve_exponent[i] == 1.0:
        return stack.rate[i] * compression
    ratio = max(0.0, compression / stack.curve_unit[i])
    power: float = ratio ** stack.curve_exponent[i]
    return stack.curve_force[i] * power


@kernel
def stored_energy(stack: Stack, i: int, compression: float) -> float:
    """Return what contact i would give back: its force integrated along the way out."""
    exponent = stack.curve_exponent[i]
    if stack.law[i] != POWER and stack.top[i] == math.inf:
        exponent = stack.unloading[i]
    return force(stack, i, compression) * compression / (exponent + 1.0)


@kernel
def look(stack: Stack, i: int, time: float) -> None:
    """Set when contact i is due again, and what will have happened by then."""
    size = len(stack.mass)
    if stack.law[i] == ABSENT:
        stack.due[i] = math.inf
        return
    if stack.phase[i] == OPEN:
        meet_anchors(stack, i)
    a = stack.watched
    order, tail, noise, rate_noise = compression_series(stack, i, time, a)
    if not math.isfinite(tail + noise + rate_noise + a[0] + a[1] + a[order]):
        stack.due[i] = -math.inf
        return
    # round-off: of the solution, of the clock, and never less than that of a typical compression
    tick = 4.0 * EPSILON * time
    band = max(noise + tick * abs(a[1]), 4.0 * EPSILON * stack.scale[i])
    rate_band = max(rate_noise + tick * abs(2.0 * a[2]), 4.0 * EPSILON * stack.number[1])
    horizon = stack.due[size + stack.first[i]]
    if i > 0:
        horizon = min(horizon, stack.due[size + stack.first[i - 1]])
    horizon -= time
    if stack.phase[i] == OPEN:
        if a[0] < -band or a[1] < -rate_band:
            stack.touching[i] = math.nan
        if _never_meets(stack, i, a, order):
            stack.due[i] = math.inf
            return
        wait, reached = _wait(stack, a, order, tail, -1.0, 0.0, band, horizon)
        _note(stack, i, time, wait, reached, TOUCH, horizon)
        return
    still = rate_noise < _NOTHING * stack.number[1] and noise < _NOTHING * stack.scale[i]
    if still and stack.linear[stack.first[i]] == 1:
        _note(stack, i, time, 0.0, True, RELEASE, horizon)
        return
    exponent = stack.curve_exponent[i]
    pressed = exponent != 1.0 and stack.faint[i] == 0
    if stack.phase[i] == RELEASING:
        level = _FAINT_EXIT * stack.faint_below[i] if pressed else 0.0
        wait, reached = _wait(stack, a, order, tail, 1.0, level, band, horizon)
        kind, turn, sign = FAINT if pressed else RELEASE, DIP, -1.0
    else:
        level = stack.faint_below[i] if stack.faint[i] == 1 else stack.top[i]
        kind, turn, sign = PRESSED if stack.faint[i] == 1 else RELOADED, PEAK, 1.0
        wait, reached = math.inf, False
        if level < math.inf:
            wait, reached = _wait(stack, a, order, tail, -1.0, level, band, horizon)
    for k in range(order):
        a[k] = (k + 1) * a[k + 1]
    turning, turned = _wait(stack, a, order - 1, (order + 1) * tail, sign, 0.0, rate_band, horizon)
    if turning < wait:
        wait, reached, kind = turning, turned, turn
    _note(stack, i, time, wait, reached, kind, horizon)


@kernel
def _note(
    stack: Stack, i: int, time: float, wait: float, reached: bool, kind: int, horizon: float
) -> None:
    """Write down when contact i is due: not at all where its cluster's series ends before."""
    if time + wait <= time:
        reached = True  # closer than the clock can tell
    stack.due[i] = time + wait if wait < horizon else math.inf
    stack.event[i] = kind if reached else LOOK


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
    tail: float,
    sign: float,
    level: float,
    band: float,
    horizon: float,
) -> tuple[float, bool]:
    """Return how long sign (c - level) surely stays above -band/2, and whether it is there then."""
    f = stack.margin
    for k in range(order + 1):
        f[k] = sign * a[k]
    f[0] += band - sign * level
    if f[0] <= 0.5 * band:
        return 0.0, True
    if tail == 0.0 and order <= 9:
        wait = parabola_root(f[0] - 0.5 * band, f[1], f[2])
        return wait, True
    if order > 9:
        f[10] -= tail
        return min(safe_step(f, order, 0.0, horizon), horizon), False
    size = abs(f[0]) + band / EPSILON
    # where the rest of the series is as large, as a power of two: no unit's choice changes a bit
    _, exponent = math.frexp(size / tail)
    natural = math.ldexp(8.0, exponent // (order + 1))
    return safe_step(f, order, tail, min(natural, horizon)), False


@kernel
def begin(stack: Stack, i: int, time: float) -> None:
    """Close contact i at a time, or at the time since when it has been touching."""
    stack.start[i] = time if math.isnan(stack.touching[i]) else stack.touching[i]
    stack.touching[i] = math.nan
    stack.phase[i] = COMPRESSING
    stack.peak_force[i] = 0.0
    stack.peak_compression[i] = 0.0
    stack.impulse[i] = 0.0
    _load(stack, i)
    stack.faint[i] = 1 if stack.exponent[i] != 1.0 else 0


@kernel
def _load(stack: Stack, i: int) -> None:
    """Let contact i follow its loading curve k c^p."""
    unit = stack.scale[i]
    exponent = stack.exponent[i]
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
    ratio = FAINT_WORK ** (1.0 / (exponent + 1.0))
    stack.faint_below[i] = ratio * unit
    stack.rate[i] = force_at_unit * ratio ** (exponent - 1.0) / unit


@kernel
def _steepen(stack: Stack, i: int, compression: float) -> None:
    """Let contact i, turning back below its old peak, give back e^2 of what reloading took.

    The exponent has a limit: some contacts would become a wall after infinitely many cycles.
    """
    pressing = force(stack, i, compression)
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
def record_peak(stack: Stack, i: int, compression: float) -> None:
    """Keep the largest force and compression of the interval under way."""
    stack.peak_force[i] = max(stack.peak_force[i], force(stack, i, compression))
    stack.peak_compression[i] = max(stack.peak_compression[i], compression)


@kernel
def changes_curve(stack: Stack, i: int, kind: int) -> bool:
    """Tell whether after an event inside an interval the force follows another curve."""
    if kind == PEAK:
        return stack.law[i] == LOSSY or (stack.law[i] != POWER and stack.top[i] == math.inf)
    return kind != DIP


@kernel
def turn(stack: Stack, i: int, kind: int, compression: float) -> None:
    """Let contact i turn from compressing to releasing or back."""
    if kind == DIP:
        stack.dip_energy[i] = stored_energy(stack, i, compression)
    stack.phase[i] = RELEASING if kind == PEAK else COMPRESSING


@kernel
def change_curve(stack: Stack, i: int, kind: int) -> None:
    """Let contact i, anchored now, follow the curve that an event inside its interval leads to."""
    compression = stack.compression[i]
    if kind == PEAK:
        stack.phase[i] = RELEASING
        if stack.top[i] == math.inf:
            _follow(stack, i, force(stack, i, compression), compression, stack.unloading[i])
            stack.top[i] = compression
        else:
            _steepen(stack, i, compression)
    elif kind == RELOADED:
        _load(stack, i)
    else:
        stack.faint[i] = 1 if kind == FAINT else 0
