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
hysteresis takes from it in proportion to the cube of its amplitude: the stack is set to its static
state at once.

A contact with hysteresis carries a weight at many compressions, the largest of which is on the
unloading curve from its highest peak: there is the static state. A damped vibration leads to
another one, where the contact stays. What is left of it there is known by the force, as that rises
about as F/c: (F - W)^2 c/(2 W).
"""

import math

from stackbounce.engine.codes import COMPRESSING
from stackbounce.engine.contacts import settle_curve
from stackbounce.engine.cycles import has_hysteresis, highest_peak
from stackbounce.engine.forces import (
    arm_energy,
    creeps,
    force,
    is_damped,
    potential,
    static_state,
)
from stackbounce.engine.kernels import kernel
from stackbounce.engine.slots import GRAVITY, SPEED, TOLERANCE
from stackbounce.engine.stack import TERMS, Stack

_STILL = 1e-9
_HYSTERETIC = 0.5  # of that energy: the limit where a higher peak can still change the static state


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
    damped = _is_damped(stack)
    share = 1.0
    barrier = math.inf
    weight = 0.0
    for i in range(size - 1, -1, -1):
        weight += stack.mass[i] * stack.number[GRAVITY]
        c, settling = stack.compression[i], damped and has_hysteresis(stack, i)
        if settling:
            rest, at_rest = c, potential(stack, i, c)
        else:
            if has_hysteresis(stack, i):
                if highest_peak(stack, i) == math.inf:
                    return False
                share = _HYSTERETIC if size > 1 else 1.0
            rest, at_rest = static_state(stack, i, weight)
        opening = weight * rest - at_rest
        if stack.bonded[i] == 0:
            barrier = min(barrier, opening / stack.gain_slope[i] if creeps(stack, i) else opening)
        if excess >= share * barrier:  # before the potential, which takes long
            return False
        if settling:
            off = force(stack, i, c, 0.0, 0.0) - weight
            excess += 0.5 * off * off * c / weight
        else:
            excess += max(0.0, potential(stack, i, c) - at_rest - weight * (c - rest))
            excess += arm_energy(stack, i, c, stack.creep[i])
    still = max(_STILL, 100.0 * stack.number[TOLERANCE])
    return excess < share * barrier and (not damped or excess <= still * still * reference)


@kernel
def _is_damped(stack: Stack) -> bool:
    """Return whether a contact damps vibrations, however small."""
    damped = False
    for i in range(len(stack.mass)):
        damped = damped or is_damped(stack, i)
    return damped


@kernel
def set_static_state(stack: Stack) -> None:
    """Put a bound stack into its static state, for all later times."""
    size, damped = len(stack.mass), _is_damped(stack)
    weight = 0.0
    for i in range(size - 1, -1, -1):
        weight += stack.mass[i] * stack.number[GRAVITY]
        if not (damped and has_hysteresis(stack, i)):
            stack.compression[i], _ = static_state(stack, i, weight)
            settle_curve(stack, i, stack.compression[i])
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
