"""When balls on finite contacts have come to rest under gravity: decided by energy.

While all contacts press, the motion has an energy in excess of that of the static state, in which
contact i carries the weight W_i of all balls above it:

    E = sum m v^2/2 + sum (U_i(c_i) - U_i(s_i) - W_i (c_i - s_i)),   U_i'(s_i) = W_i,

a sum of terms none of which is negative, and which no law increases. Opening contact i takes
W_i s_i - U_i(s_i); with less than that for every contact none can open again, and the stack is
bound. A contact that creeps has the energy of its relaxing spring, too, and opens before it has
come back to c = 0: to open it at once takes 1/(1 + z) of that energy.

A vibration about the static state remains. If it is damped, it is followed until its speeds are
1e-9 of the reference speed, or as small as their error. If it is not, it would never end, as
hysteresis takes from it in proportion to the cube of its amplitude: it is followed until its energy
is a hundredth of what opens a contact.

A contact with hysteresis carries a weight at many compressions, and stays near the one to which the
vibration leads. From c on, whose force is F, it can give no more than it does on its direct way to
the nearest of them, D <= |F - W| |d - c|: other ways take more of its loss. Going in, the force
rises at least as the loading curve L does, L(d) = L(c) + W - F; going out, it falls at least as
much in proportion, L(d) = L(c) W/F. So D takes the place of U(c) - U(s) - W (c - s), and W c - U(c)
that of the work that opens it.
"""

import math

from stackbounce.engine.codes import COMPRESSING, DIP, PEAK, PIECEWISE
from stackbounce.engine.contacts import change_curve
from stackbounce.engine.cycles import (
    count_cycles,
    has_hysteresis,
    loading_compression,
    loading_force,
)
from stackbounce.engine.forces import (
    arm_energy,
    creeps,
    force,
    is_damped,
    potential,
    static_compression,
)
from stackbounce.engine.kernels import kernel
from stackbounce.engine.pieces import find_piece
from stackbounce.engine.slots import GRAVITY, SPEED, TOLERANCE
from stackbounce.engine.stack import TERMS, Stack

_STILL = 1e-9  # of the reference speed: a damped vibration that is slower is at rest
_HALVINGS = 60  # of a range of compressions
# of the energy that opens a contact: what may be left of a vibration that hysteresis alone damps
_LEFT_BY_HYSTERESIS = 0.01


@kernel
def is_bound(stack: Stack) -> bool:
    """Return whether a stack is at rest for good: its energy is too low to open any contact again.

    A damped vibration must have decayed as well. All balls must be anchored now.
    """
    size = len(stack.mass)
    if stack.first[size - 1] != 0 or stack.phase[0] < COMPRESSING:
        return False
    excess, reference = 0.0, 0.0
    for b in range(size):
        excess += 0.5 * stack.mass[b] * stack.velocity[b] * stack.velocity[b]
        reference += 0.5 * stack.mass[b] * stack.number[SPEED] * stack.number[SPEED]
    damped, hysteresis = False, False
    barrier = math.inf
    weight = 0.0
    for i in range(size - 1, -1, -1):
        weight += stack.mass[i] * stack.number[GRAVITY]
        c = stack.compression[i]
        damped = damped or is_damped(stack, i)
        if has_hysteresis(stack, i):
            hysteresis = True
            off = abs(force(stack, i, c, 0.0, 0.0) - weight)
            excess += off * abs(_far_side(stack, i, weight) - c)  # D: the most that it can give
            if excess >= min(barrier, weight * c):  # before the potential, which takes long
                return False
            count_cycles(stack, i)
            opening = weight * c - potential(stack, i, c)
        else:
            rest = static_compression(stack, i, weight)
            at_rest = potential(stack, i, rest)
            opening = weight * rest - at_rest
            above = max(0.0, potential(stack, i, c) - at_rest - weight * (c - rest))
            # near rest the difference is lost in round-off; the potential is convex
            most = abs(force(stack, i, c, 0.0, c) - weight) * abs(c - rest)
            excess += min(above, most)
            excess += arm_energy(stack, i, c, stack.creep[i])
        if stack.bonded[i] == 0:
            barrier = min(barrier, opening / stack.gain_slope[i] if creeps(stack, i) else opening)
        if excess >= barrier:
            return False
    still = max(_STILL, 100.0 * stack.number[TOLERANCE])
    if damped:
        return excess < barrier and excess <= still * still * reference
    return excess < (_LEFT_BY_HYSTERESIS if hysteresis else 1.0) * barrier


@kernel
def _far_side(stack: Stack, i: int, weight: float) -> float:
    """Return a compression before which contact i, with hysteresis, will carry a weight."""
    c = stack.compression[i]
    pressing, pressed = force(stack, i, c, 0.0, 0.0), loading_force(stack, i, c)
    if pressing <= 0.0 or pressed <= 0.0:
        return math.inf
    there = pressed * weight / pressing if pressing > weight else pressed + weight - pressing
    return loading_compression(stack, i, there)


@kernel
def _settle(stack: Stack, i: int, weight: float) -> None:
    """Put contact i, with hysteresis, where it carries a weight on the direct way there."""
    c = stack.compression[i]
    out = force(stack, i, c, 0.0, 0.0) > weight
    end = _far_side(stack, i, weight)
    if out == (stack.phase[i] == COMPRESSING):
        change_curve(stack, i, PEAK if out else DIP)
    low, high = min(c, end), max(c, end)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if force(stack, i, middle, 0.0, 0.0) < weight:
            low = middle
        else:
            high = middle
    stack.compression[i] = high


@kernel
def set_static_state(stack: Stack) -> None:
    """Put a bound stack into its static state, for all later times."""
    size, weight = len(stack.mass), 0.0
    for i in range(size - 1, -1, -1):
        weight += stack.mass[i] * stack.number[GRAVITY]
        if has_hysteresis(stack, i):
            _settle(stack, i, weight)
        else:
            stack.compression[i] = static_compression(stack, i, weight)
            if stack.law[i] == PIECEWISE:
                find_piece(stack, i, stack.compression[i], False)
        stack.velocity[i] = 0.0
        stack.creep[i] = stack.compression[i] if creeps(stack, i) else 0.0
        for k in range(TERMS):
            stack.compression_series[i][k] = 0.0
            stack.velocity_series[i][k] = 0.0
            stack.force_series[i][k] = 0.0
            stack.creep_series[i][k] = 0.0
        stack.compression_series[i][0] = stack.compression[i]
        stack.creep_series[i][0] = stack.creep[i]
        stack.force_series[i][0] = weight
