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

from stackbounce.engine.codes import (
    COMPRESSING,
    CROSSED,
    DIP,
    LINEARISED,
    LOSSY,
    PEAK,
    PIECEWISE,
    POWER,
    RELEASING,
    RELOADED,
    RESUMED,
    UNLOADED,
)
from stackbounce.engine.elementary import exp, log, power
from stackbounce.engine.forces import force, loaded_energy, stored_energy
from stackbounce.engine.kernels import kernel
from stackbounce.engine.pieces import (
    cross_knot,
    find_piece,
    may_rescale,
    take_piece,
    unloading_factor,
)
from stackbounce.engine.slots import CLOSED, LINEARISED_WORK, SPEED, TOLERANCE
from stackbounce.engine.stack import Stack

_STEEPEST = 10.0  # times the first unloading exponent: the limit after many reloadings

_SHORTER = 0.125  # work under the next trial chord, over that under one that was too long
_AT_ITS_END = 1e-6  # over a chord's length: below this the contact stays on it until release
_NO_WORK = 1e-50  # the work under the shortest chord, over the reference energy

_SOFTEST = 1e-60  # times the slope at the curve's unit: the smallest slope of a chord
_GRAZE = 1e-30  # of a typical compression: the smallest peak
_STEEPER = 1.0 + 1e-12  # times the exponent: a smaller increase is round-off

_BEYOND = 1.0 + 1e-6  # times the old peak, where the steepest curve has 3 times the force


@kernel
def close_contact(stack: Stack, i: int, time: float) -> None:
    """Begin a contact interval of contact i on its loading curve.

    The interval starts at ``time`` or, if the contact already touched without a force, when that
    touch began.
    """
    stack.start[i] = time if math.isnan(stack.touching[i]) else stack.touching[i]
    stack.touching[i] = math.nan
    stack.phase[i] = COMPRESSING
    stack.counter[CLOSED] += 1
    stack.peak_force[i] = 0.0
    stack.peak_time[i] = stack.start[i]
    stack.peak_compression[i] = 0.0
    stack.impulse[i] = 0.0
    stack.base[i] = 0.0
    stack.base_energy[i] = 0.0
    _set_loading_curve(stack, i)
    if stack.curve_exponent[i] != 0.0 and stack.curve_exponent[i] != 1.0:
        _linearise(stack, i)


@kernel
def _set_loading_curve(stack: Stack, i: int) -> None:
    """Set the force of contact i to its loading curve: k c^p, or k c^q times the gain."""
    unit = stack.scale[i]
    exponent = stack.factor_exponent[i]
    _set_curve(stack, i, stack.stiffness[i] * power(unit, exponent), unit, exponent)
    stack.top[i] = math.inf
    if exponent == 1.0:
        stack.rate[i] = stack.stiffness[i]
    if stack.law[i] == PIECEWISE:
        stack.rescaled[i] = 0
        find_piece(stack, i, stack.compression[i])


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
def _linearise_if_slow(stack: Stack, i: int) -> None:
    """Linearise opening contact i, anchored now, if the work left under its chord is small enough.

    Otherwise ``linearised_below`` is reduced: the next trial comes at a smaller compression.
    """
    compression = stack.compression[i]
    rate = stack.velocity[i]
    if i > 0:
        rate -= stack.velocity[i - 1]
    work = force(stack, i, compression, -rate, 0.0) * compression
    budget = linearised_impulse_limit(stack, i)
    if (
        work <= rate * budget
        or work <= _NO_WORK / stack.number[TOLERANCE] * budget * stack.number[SPEED]
    ):
        _linearise(stack, i)
        if stack.law[i] == POWER:  # past its peak, see `record_series_peaks`
            stack.phase[i] = RELEASING
            stack.top[i] = math.inf
    else:
        shorter = power(_SHORTER, 1.0 / (stack.curve_exponent[i] + 1.0))
        stack.linearised_below[i] = shorter * compression


@kernel
def _energy_to_return(stack: Stack, i: int, compression: float) -> float:
    """Return the energy that lossy contact i will give back, after reloading up to a compression.

    That is what it held when the reloading began, plus e^2 of the work of reloading; but at least
    the energy under the steepest unloading curve.
    """
    kept = (stack.exponent[i] + 1.0) / (stack.unloading[i] + 1.0)
    held = stack.dip_energy[i]
    energy = held + kept * (stored_energy(stack, i, compression) - held)
    least = force(stack, i, compression, 0.0, 0.0) * compression / (_steepest(stack, i) + 1.0)
    return max(energy, least)


@kernel
def _steepest(stack: Stack, i: int) -> float:
    """Return the largest exponent of the unloading curves of contact i.

    Without a limit the exponent could grow beyond all bounds in infinitely many cycles.
    """
    return _STEEPEST * stack.unloading[i]


@kernel
def _steepen(stack: Stack, i: int, compression: float) -> None:
    """Give lossy contact i, which turns back below its old peak, a steeper unloading curve.

    See `_energy_to_return`.
    """
    pressing = force(stack, i, compression, 0.0, 0.0)
    exponent = stack.exponent[i]
    steeper = pressing * compression / _energy_to_return(stack, i, compression) - 1.0
    if not steeper > stack.curve_exponent[i] * _STEEPER:  # nan where there is no force left
        return
    # the steeper curve meets the loading curve earlier than the old one
    meeting = max(0.0, log(stack.stiffness[i] * power(compression, exponent) / pressing))
    furthest = log(stack.top[i] / compression)
    _set_curve(stack, i, pressing, compression, steeper)
    stack.top[i] = compression * exp(min(furthest, meeting / (steeper - exponent)))


@kernel
def record_peak(stack: Stack, i: int, compression: float, pressing: float, time: float) -> None:
    """Update the largest force of the present interval, its time, and the largest compression."""
    if pressing > stack.peak_force[i]:
        stack.peak_force[i] = pressing
        stack.peak_time[i] = time
    stack.peak_compression[i] = max(stack.peak_compression[i], compression)


@kernel
def changes_curve(stack: Stack, i: int, kind: int) -> bool:
    """Tell whether the force follows another curve after an event inside an interval."""
    if kind == PEAK:
        return stack.law[i] == LOSSY or (stack.law[i] != POWER and stack.top[i] == math.inf)
    if kind == RELOADED:
        return stack.law[i] != POWER
    return kind != DIP


@kernel
def change_phase(stack: Stack, i: int, kind: int, compression: float) -> None:
    """Switch contact i between compressing and releasing on the same curve."""
    if kind == DIP:
        stack.dip_energy[i] = stored_energy(stack, i, compression)
    if kind == PEAK:
        stack.phase[i] = RELEASING
        stack.top[i] = max(compression, stack.peak_compression[i])
    else:
        stack.phase[i] = COMPRESSING


@kernel
def change_curve(stack: Stack, i: int, kind: int) -> None:
    """Switch contact i, anchored now, to the curve that follows an event inside its interval."""
    compression = max(stack.compression[i], _GRAZE * stack.scale[i])
    if kind == PEAK:
        stack.phase[i] = RELEASING
        if stack.law[i] == PIECEWISE:
            if stack.top[i] == math.inf:
                _turn_back(stack, i, compression)
        elif stack.top[i] == math.inf:
            pressing = force(stack, i, compression, 0.0, 0.0)
            exponent = stack.unloading[i]
            if stack.base[i] > 0.0:
                held = loaded_energy(stack, i, compression)
                given_back = min(pressing * compression / held - 1.0, _steepest(stack, i))
                exponent = max(stack.exponent[i], given_back)  # never more than the work done
            _set_curve(stack, i, pressing, compression, exponent)
            stack.top[i] = compression
        else:
            _steepen(stack, i, compression)
        stack.dip_energy[i] = stored_energy(stack, i, compression)  # until it dips
    elif kind == RELOADED:
        stack.phase[i] = COMPRESSING
        if stack.law[i] == LOSSY:
            stack.base_energy[i] = _energy_to_return(stack, i, compression)
            stack.base[i] = compression
        _set_loading_curve(stack, i)
    elif kind == CROSSED:
        cross_knot(stack, i)
    elif kind == RESUMED:
        stack.phase[i] = COMPRESSING
    elif kind == LINEARISED:
        _linearise_if_slow(stack, i)
    elif compression <= _AT_ITS_END * stack.linearised_below[i]:
        stack.linearised_impulse[i] = 0.0
    else:
        stack.linearised[i] = 0
        stack.linearised_below[i] = min(stack.linearised_below[i], compression)


@kernel
def _turn_back(stack: Stack, i: int, compression: float) -> None:
    """Give piecewise contact i the unloading curve from its peak, see `pieces`."""
    pressing = force(stack, i, compression, 0.0, 0.0)
    if may_rescale(stack, i, compression, pressing):
        _set_curve(stack, i, pressing, compression, 0.0)
        stack.top[i] = compression
        stack.rescaled[i] = 1
        take_piece(stack, i, stack.unloading_pieces[i] - 1)
        return
    exponent = unloading_factor(stack, i, compression)
    _set_curve(stack, i, stack.stiffness[i], compression, exponent)
    if exponent == 1.0:
        stack.rate[i] = stack.stiffness[i] / compression
    stack.top[i] = compression


@kernel
def clip(stack: Stack, i: int, time: float) -> None:
    """Set the force of damped contact i to 0, because its formula now gives a pulling force.

    The contact must be anchored at ``time``, which is logged as the end of its interval.
    """
    stack.phase[i] = UNLOADED
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
    exponent = stack.curve_exponent[i]
    if (
        stack.phase[i] < COMPRESSING
        or exponent == 0.0
        or exponent == 1.0
        or stack.linearised[i] == 1
    ):
        return
    if compression < 0.5 * stack.linearised_below[i]:
        _linearise(stack, i)
    elif stack.law[i] != POWER and compression > _BEYOND * stack.top[i]:
        change_curve(stack, i, RELOADED)
