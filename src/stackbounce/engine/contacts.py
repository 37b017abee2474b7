"""The curve that the force of a contact follows in each phase, and how events change it.

A damped contact's force is a power of c times its *gain* a + b c + d c'. It stays compressing until
the gain falls through 0 (CLIPPED: slack), or c does.

Because c^p has no power series at c = 0, a power law is continued by its chord (FAINT, PRESSED)
below a compression that holds a negligible part of a typical contact's work, and for no longer than
the chord has changed no ball's velocity by more than one step may leave out: two balls that are
pressed together slowly need a shorter chord than two that collide. Two balls alone that collide
need none where c^p has a series in the root of time, see `motion`; and no contact needs one that
opens before the series it moves by is to end.
"""

import math

from stackbounce.engine.codes import (
    COMPRESSING,
    DAMPED,
    DIP,
    FAINT,
    HYSTERETIC,
    LOSSY,
    OPEN,
    PEAK,
    POWER,
    RELEASING,
    RELOADED,
    RESUMED,
    SLACK,
)
from stackbounce.engine.kernel import kernel
from stackbounce.engine.stack import Stack

_STEEPEST = 10.0  # times its first unloading exponent, for a lossy contact reloaded many times

_SHORTER = 0.125  # part of the work under a chord that took too long
_AT_ITS_END = 1e-6  # of a chord's length: where it may go on, for it will be over
_NO_WORK = 1e-50  # of the reference energy: the shortest chord

_SOFTEST = 1e-60  # times the slope at the curve's unit: what a chord keeps of a very steep curve
_GRAZE = 1e-30  # of a typical compression: the peak of a contact that opens where it closes
_STEEPER = 1.0 + 1e-12  # times the exponent: round-off of a contact that loses nothing is not

_BEYOND = 1.0 + 1e-6  # times the old peak: a steepest curve would be 3 times the force there


@kernel
def raised(x: float, p: float) -> float:
    """Return x^p, of a sphere's contact (Hertz) by a root, which takes less time than a power."""
    if p == 1.5:
        return x * math.sqrt(x)
    power: float = x**p
    return power


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
        pressing = stack.curve_force[i] * raised(ratio, exponent)
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
    if stack.law[i] == LOSSY and stack.top[i] == math.inf:
        return _loaded_energy(stack, i, compression)
    exponent = stack.curve_exponent[i]
    if stack.law[i] == HYSTERETIC and stack.top[i] == math.inf:
        exponent = stack.unloading[i]
    return force(stack, i, compression, 0.0) * compression / (exponent + 1.0)


@kernel
def _loaded_energy(stack: Stack, i: int, compression: float) -> float:
    """Return what a lossy contact on its loading curve would give back.

    That is e^2 of the work done on this curve, on top of what it held where it came onto it.
    """
    exponent = stack.exponent[i] + 1.0
    kept = exponent / (stack.unloading[i] + 1.0)
    above: float = max(0.0, compression) ** exponent
    base: float = stack.base[i] ** exponent
    work = stack.stiffness[i] * (above - base) / exponent
    return stack.base_energy[i] + kept * max(0.0, work)


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
    stack.base[i] = 0.0
    stack.base_energy[i] = 0.0
    _load(stack, i)
    if stack.curve_exponent[i] != 0.0 and stack.curve_exponent[i] != 1.0:
        _take_chord(stack, i)


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
    # of a power times a gain that grows from 0, too, the whole force counts
    steepest = max(exponent, stack.exponent[i])
    ratio = stack.number[3] ** (1.0 / (steepest + 1.0))
    stack.faint_below[i] = ratio * unit


@kernel
def _take_chord(stack: Stack, i: int) -> None:
    """Let contact i follow the chord of its curve up to where this is faint."""
    ratio = stack.faint_below[i] / stack.curve_unit[i]
    stack.faint[i] = 1
    stack.faint_impulse[i] = 0.0
    steepness: float = ratio ** (stack.curve_exponent[i] - 1.0)
    stack.rate[i] = stack.curve_force[i] * max(steepness, _SOFTEST) / stack.curve_unit[i]


@kernel
def chord_budget(stack: Stack, i: int) -> float:
    """Return the impulse that contact i may exert along its chord."""
    return stack.number[2] * reduced_mass(stack, i) * stack.number[1]


@kernel
def reduced_mass(stack: Stack, i: int) -> float:
    """Return the reduced mass of the balls at contact i."""
    if i == 0:
        return stack.mass[0]
    return stack.mass[i] / (1.0 + stack.mass[i] / stack.mass[i - 1])


@kernel
def _fade(stack: Stack, i: int) -> None:
    """Let contact i, anchored now, take the chord on its way out, or later if that is too early."""
    compression = stack.compression[i]
    rate = stack.velocity[i]
    if i > 0:
        rate -= stack.velocity[i - 1]
    work = force(stack, i, compression, -rate) * compression
    budget = chord_budget(stack, i)
    if work <= rate * budget or work <= _NO_WORK / stack.number[2] * budget * stack.number[1]:
        _take_chord(stack, i)
        if stack.law[i] == POWER:  # its peak has been, see `record_crests`
            stack.phase[i] = RELEASING
            stack.top[i] = math.inf
    else:
        shorter: float = _SHORTER ** (1.0 / (stack.curve_exponent[i] + 1.0))
        stack.faint_below[i] = shorter * compression


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
    if steeper <= stack.curve_exponent[i] * _STEEPER:
        return
    # the steeper curve meets the loading curve before the old one does
    meeting = max(0.0, math.log(stack.stiffness[i] * compression**exponent / pressing))
    furthest = math.log(stack.top[i] / compression)
    _follow(stack, i, pressing, compression, steeper)
    stack.top[i] = compression * math.exp(min(furthest, meeting / (steeper - exponent)))


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
    compression = max(stack.compression[i], _GRAZE * stack.scale[i])
    if kind == PEAK:
        stack.phase[i] = RELEASING
        if stack.top[i] == math.inf:
            pressing = force(stack, i, compression, 0.0)
            exponent = stack.unloading[i]
            if stack.base[i] > 0.0:
                held = _loaded_energy(stack, i, compression)
                given_back = min(pressing * compression / held - 1.0, _STEEPEST * exponent)
                exponent = max(stack.exponent[i], given_back)  # but never more than it took
            _follow(stack, i, pressing, compression, exponent)
            stack.top[i] = compression
        else:
            _steepen(stack, i, compression)
    elif kind == RELOADED:
        stack.phase[i] = COMPRESSING
        if stack.law[i] == LOSSY:
            stack.base_energy[i] = stored_energy(stack, i, compression)
            stack.base[i] = compression
        _load(stack, i)
    elif kind == RESUMED:
        stack.phase[i] = COMPRESSING
    elif kind == FAINT:
        _fade(stack, i)
    elif compression <= _AT_ITS_END * stack.faint_below[i]:
        stack.faint_impulse[i] = 0.0
    else:
        stack.faint[i] = 0
        stack.faint_below[i] = min(stack.faint_below[i], compression)


@kernel
def clip(stack: Stack, i: int, time: float) -> None:
    """Let damped contact i, anchored at this time, exert no force while it would pull."""
    stack.phase[i] = SLACK
    stack.clip_time[i] = time
    stack.clip_lower[i] = stack.velocity[i - 1] if i > 0 else 0.0
    stack.clip_upper[i] = stack.velocity[i]


@kernel
def catch_up(stack: Stack, i: int) -> None:
    """Let contact i, anchored now, be on the curve that its compression belongs to.

    An event is known no better than the clock tells times apart, in which a fast ball may go
    further than a power law reaches, or past where a steep one ends.
    """
    compression = stack.compression[i]
    exponent = stack.curve_exponent[i]
    if stack.phase[i] < COMPRESSING or exponent == 0.0 or exponent == 1.0 or stack.faint[i] == 1:
        return
    if compression < 0.5 * stack.faint_below[i]:
        _take_chord(stack, i)
    elif stack.law[i] != POWER and compression > _BEYOND * stack.top[i]:
        change_curve(stack, i, RELOADED)
