"""The force curve that a contact follows in each phase, and how events change it.

The force of a PRODUCT is c^q times a *gain*, see `forces`. Its phase is COMPRESSING until c falls
through 0 (RELEASE), or until the gain does (CLIPPED). After CLIPPED the formula would give a
pulling force: the force is 0 and the phase is UNLOADED.

Because c^p has no power series at c = 0, a power law is *linearised* at small compressions: its
chord from 0 replaces it, where the work is negligible (event LINEARISED). Above that compression
the contact follows the power law again (event CURVED). The impulse along the chord must change no
ball's velocity by more than the error of one step. The chord is therefore shorter if two balls are
pressed together slowly than if they collide. No chord is needed in two cases: for two balls alone
whose c^p has a series in the square root of time (see `motion`), and for a contact that opens
before its present series ends.
"""

import math

from stackbounce.engine import codes
from stackbounce.engine.cycles import (
    begin_loading,
    has_hysteresis,
    loading_force,
    lowest_compression,
    return_to_turn,
    take_shares,
    turn_in,
    turn_out,
)
from stackbounce.engine.elementary import power
from stackbounce.engine.forces import force
from stackbounce.engine.kernels import kernel
from stackbounce.engine.pieces import crossed_knot
from stackbounce.engine.slots import CLOSED, LINEARISED_WORK, SPEED, TOLERANCE
from stackbounce.engine.stack import Stack

_SHORTER = 0.125  # work under the next trial chord, over that under one that was too long
_AT_ITS_END = 1e-6  # over a chord's length: below this the contact stays on it until release
_NO_WORK = 1e-50  # the work under the shortest chord, over the reference energy

_SOFTEST = 1e-60  # times the slope at the curve's unit: the smallest slope of a chord
_GRAZE = 1e-30  # of a typical compression: the smallest peak

_ALL_BUT_OPEN = 1e-12  # of the peak
_BEYOND = 1.0 + 1e-6  # times a turning point, where the steepest curve has 3 times the force


@kernel
def close_contact(stack: Stack, i: int, time: float) -> None:
    """Begin a contact interval of contact i on its loading curve.

    The interval starts at ``time`` or, if the contact already touched without a force, when that
    touch began.
    """
    stack.start[i] = time if math.isnan(stack.touching[i]) else stack.touching[i]
    stack.touching[i] = math.nan
    stack.counter[CLOSED] += 1
    stack.peak_force[i] = 0.0
    stack.peak_time[i] = stack.start[i]
    stack.peak_compression[i] = 0.0
    stack.impulse[i] = 0.0
    begin_loading(stack, i)
    _set_loading_curve(stack, i, stack.compression[i])
    _linearise_at_touch(stack, i)


@kernel
def _linearise_at_touch(stack: Stack, i: int) -> None:
    """Take the chord of the loading curve of contact i, if it is curved at 0."""
    if stack.curve_exponent[i] != 0.0 and stack.curve_exponent[i] != 1.0:
        _linearise(stack, i)


@kernel
def _set_loading_curve(stack: Stack, i: int, c: float) -> None:
    """Set the force of contact i, at c, to its loading curve: k c^p, or k c^q times the gain."""
    unit = stack.scale[i]
    exponent = stack.factor_exponent[i]
    _set_curve(stack, i, stack.stiffness[i] * power(unit, exponent), unit, exponent)
    if exponent == 1.0:
        stack.rate[i] = stack.stiffness[i]
    _set_shares(stack, i, c, True)


@kernel
def _set_unloading_curve(stack: Stack, i: int, pressing: float, c: float) -> None:
    """Set the force of contact i, at c, to the curve from its last peak, where it is ``pressing``.

    A piecewise contact unloads along its gain times a power.
    """
    peak = stack.top[i]
    if stack.law[i] == codes.PIECEWISE:
        _set_curve(stack, i, stack.stiffness[i], peak, stack.loss_exponent[i])
    else:
        _set_curve(stack, i, pressing, peak, stack.unloading[i])
    _set_shares(stack, i, c, False)
    if stack.curve_exponent[i] == 1.0:
        stack.rate[i] = stack.curve_force[i] / peak


@kernel
def _set_shares(stack: Stack, i: int, c: float, up: bool) -> None:
    """Set what elements that remember a peak add, see `cycles`; they part before c is near 0."""
    if stack.law[i] == codes.PIECEWISE or stack.depth[i] > 0:
        take_shares(stack, i, c, up)
    if stack.depth[i] > 0:
        stack.linearised_below[i] = 0.0


@kernel
def _set_curve(stack: Stack, i: int, force_at_unit: float, unit: float, exponent: float) -> None:
    """Set the force of contact i to the curve force_at_unit (c/unit)^exponent."""
    stack.curve_force[i] = force_at_unit
    stack.curve_unit[i] = unit
    stack.curve_exponent[i] = exponent
    stack.linearised[i] = 0
    # if the gain grows from 0 as well, the whole force has a larger exponent than the power alone
    steepest = max(exponent, stack.exponent[i])
    ratio = power(stack.number[LINEARISED_WORK], 1.0 / (steepest + 1.0))
    stack.linearised_below[i] = ratio * unit


@kernel
def _linearise(stack: Stack, i: int) -> None:
    """Replace the curve of contact i by its chord from 0 to ``linearised_below``."""
    ratio = stack.linearised_below[i] / stack.curve_unit[i]
    stack.linearised[i] = 1
    stack.linearised_impulse[i] = 0.0
    steepness = power(ratio, stack.curve_exponent[i] - 1.0)
    stack.rate[i] = stack.curve_force[i] * max(steepness, _SOFTEST) / stack.curve_unit[i]


@kernel
def linearised_impulse_limit(stack: Stack, i: int) -> float:
    """Return the impulse along the chord of contact i that gives the error of one step."""
    return stack.number[TOLERANCE] * reduced_mass(stack, i) * stack.number[SPEED]


@kernel
def reduced_mass(stack: Stack, i: int) -> float:
    """Return the reduced mass of the balls at contact i."""
    if i == 0:
        return stack.mass[0]
    return stack.mass[i] / (1.0 + stack.mass[i] / stack.mass[i - 1])


@kernel
def approach_speed(stack: Stack, i: int) -> float:
    """Return the speed at which the balls at contact i, both anchored now, approach each other."""
    return (stack.velocity[i - 1] if i > 0 else 0.0) - stack.velocity[i]


@kernel
def approach_noise(stack: Stack, i: int) -> float:
    """Return a bound on the round-off of the speed at which the balls at contact i approach."""
    noise = stack.velocity_noise[i]
    return noise + stack.velocity_noise[i - 1] if i > 0 else noise


@kernel
def _linearise_if_slow(stack: Stack, i: int) -> None:
    """Linearise opening contact i, anchored now, if the work left under its chord is small enough.

    Otherwise ``linearised_below`` is reduced: the next trial comes at a smaller compression. Where
    the gain alone is a part of the force, the chord is 0: the power is nothing beside that part.
    """
    compression, rate = stack.compression[i], -approach_speed(stack, i)
    work = force(stack, i, compression, -rate, 0.0) * compression
    flat = stack.flat[i]
    if flat > 0.0:
        steep = power(compression / stack.curve_unit[i], stack.curve_exponent[i])
        steep *= stack.curve_force[i]
        work *= steep / (steep + flat)
    budget = linearised_impulse_limit(stack, i)
    if (
        work <= rate * budget
        or work <= _NO_WORK / stack.number[TOLERANCE] * budget * stack.number[SPEED]
    ):
        _linearise(stack, i)
        if flat > 0.0:
            stack.rate[i] = 0.0
        if stack.law[i] == codes.POWER:  # past its peak, see `record_series_peaks`
            stack.phase[i] = codes.RELEASING
            stack.top[i] = math.inf
    else:
        shorter = power(_SHORTER, 1.0 / (stack.curve_exponent[i] + 1.0))
        stack.linearised_below[i] = shorter * compression


@kernel
def record_peak(stack: Stack, i: int, compression: float, pressing: float, time: float) -> None:
    """Update the largest force of the present interval, its time, and the largest compression."""
    if pressing > stack.peak_force[i]:
        stack.peak_force[i] = pressing
        stack.peak_time[i] = time
    stack.peak_compression[i] = max(stack.peak_compression[i], compression)


@kernel
def changes_curve(stack: Stack, i: int, kind: int) -> bool:
    """Return whether the force follows another curve after an event inside an interval."""
    return has_hysteresis(stack, i) or kind not in (codes.PEAK, codes.RETURNED)


@kernel
def change_phase(stack: Stack, i: int, kind: int) -> None:
    """Switch contact i between compressing and releasing on the same curve."""
    stack.phase[i] = codes.RELEASING if kind == codes.PEAK else codes.COMPRESSING
    if kind == codes.PEAK and not has_hysteresis(stack, i):  # beyond it there is another peak
        stack.top[i] = stack.peak_compression[i]


@kernel
def change_curve(stack: Stack, i: int, kind: int) -> None:
    """Switch contact i, anchored now, to the curve that follows an event inside its interval."""
    compression = max(stack.compression[i], _GRAZE * stack.scale[i])
    if kind == codes.PEAK:
        pressing = force(stack, i, compression, 0.0, 0.0)
        turn_out(stack, i, compression)
        if stack.depth[i] > 0:
            pressing = loading_force(stack, i, compression)
        _set_unloading_curve(stack, i, pressing, compression)
    elif kind == codes.DIP:
        if compression < _ALL_BUT_OPEN * stack.top[i]:  # all elements forget their peak
            begin_loading(stack, i)
            _set_loading_curve(stack, i, compression)
            _linearise_at_touch(stack, i)
        else:
            turn_in(stack, i, compression)
            _set_loading_curve(stack, i, compression)
    elif kind == codes.RETURNED:
        return_to_turn(stack, i)
        if stack.phase[i] == codes.COMPRESSING:
            _set_loading_curve(stack, i, compression)
        else:
            pressing = loading_force(stack, i, stack.top[i])
            _set_unloading_curve(stack, i, pressing, compression)
    elif kind == codes.CROSSED:
        knot, up = crossed_knot(stack, i)
        take_shares(stack, i, knot, up)
        if stack.phase[i] == codes.RELEASING and stack.curve_exponent[i] == 1.0:
            stack.rate[i] = stack.curve_force[i] / stack.curve_unit[i]
    elif kind == codes.RESUMED:
        stack.phase[i] = codes.COMPRESSING
    elif kind == codes.LINEARISED:
        _linearise_if_slow(stack, i)
    elif compression <= _AT_ITS_END * stack.linearised_below[i]:
        stack.linearised_impulse[i] = 0.0
    else:
        stack.linearised[i] = 0
        stack.linearised_below[i] = min(stack.linearised_below[i], compression)


@kernel
def clip(stack: Stack, i: int, time: float) -> None:
    """Set the force of damped contact i to 0, because its formula now gives a pulling force.

    The contact must be anchored at ``time``, which is logged as the end of its interval.
    """
    stack.phase[i] = codes.UNLOADED
    stack.clip_time[i] = time
    stack.clip_lower[i] = stack.velocity[i - 1] if i > 0 else 0.0
    stack.clip_upper[i] = stack.velocity[i]


@kernel
def correct_curve(stack: Stack, i: int) -> None:
    """Switch contact i, anchored now, to the curve that is valid at its compression.

    An event time is rounded to float64. Within that rounding, a fast ball may pass the end of a
    steep unloading curve, or the compression at which a power law is linearised.
    """
    compression = stack.compression[i]
    curved = stack.curve_exponent[i] not in (0.0, 1.0)
    if stack.phase[i] < codes.COMPRESSING or stack.linearised[i] == 1:
        return
    rises = stack.phase[i] == codes.COMPRESSING
    if has_hysteresis(stack, i) and (
        (rises and compression > _BEYOND * stack.top[i])
        or (not rises and compression * _BEYOND < lowest_compression(stack, i))
    ):
        change_curve(stack, i, codes.RETURNED)
    elif curved and compression < 0.5 * stack.linearised_below[i]:
        _linearise(stack, i)
