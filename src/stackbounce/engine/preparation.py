"""Fill a stack with the parameters of a drop, at t = 0.

A contact is given by four numbers: the form of its force (`codes`), k, p, and the law parameter:
damping b, dissipative time A, dissipation χ, unloading exponent n or restitution e.
"""

import math

from stackbounce.engine import codes
from stackbounce.engine.compiler import Floats, Integers, kernel
from stackbounce.engine.series import ORDER
from stackbounce.engine.slots import (
    GRAVITY,
    LINEARISED_WORK,
    NONLINEAR,
    SERIES_ORDER,
    SPEED,
    TOLERANCE,
    UNIT,
)
from stackbounce.engine.stack import RigidStack, Stack

_STEP = 0.02  # the error of one step of a nonlinear cluster, over rtol
_ROUND_OFF = 1e-16
_LEAST_ORDER = 6
_LINEARISED_SHARE = 1e-2  # LINEARISED_WORK over the error of one step
_LEAST_LINEARISED_WORK = 1e-18
_LARGEST_EXPONENT = 600  # of 2 in the unit of speed
_LONGEST_EXPONENT = 200  # of 2 in the unit of time


@kernel
def prepare(
    stack: Stack,
    mass: Floats,
    kind: Integers,
    stiffness: Floats,
    exponent: Floats,
    law_parameter: Floats,
    gap: Floats,
    velocity: Floats,
    gravity: float,
    rtol: float,
) -> float:
    """Fill an empty stack with finite contacts, gap[0] being 0; return its unit of time in s.

    The unit is the power of two nearest to the shortest contact time. In it no power series leaves
    the range of floating-point numbers, and the conversion rounds nothing.
    """
    size = len(stack.mass)
    speed, shortest = 0.0, math.inf
    for i in range(size):
        speed = max(speed, abs(velocity[i]))
    for i in range(size):
        stack.mass[i] = mass[i]
        _take_law(stack, i, kind[i], stiffness[i], exponent[i], law_parameter[i])
        stack.scale[i] = _typical_compression(stack, i, speed)
        if stack.law[i] != codes.ABSENT:
            shortest = min(shortest, stack.scale[i] / speed)
        if stack.unloading[i] != 1.0 or stack.factor_exponent[i] != 0.0:
            stack.setting[NONLINEAR] = 1
    unit = 1.0
    if 0.0 < shortest < math.inf:
        power = round(math.log2(shortest))
        unit = 2.0 ** max(-_LONGEST_EXPONENT, min(power, _LONGEST_EXPONENT))
    for i in range(size):
        stack.stiffness[i] *= unit**2
        stack.gain_rate[i] /= unit
        stack.velocity[i] = velocity[i] * unit
        stack.compression[i] = -gap[i]
    tolerance = max(_STEP * rtol, _ROUND_OFF)
    stack.number[GRAVITY] = gravity * unit**2
    stack.number[SPEED] = speed * unit
    stack.number[TOLERANCE] = tolerance
    stack.number[LINEARISED_WORK] = max(tolerance * _LINEARISED_SHARE, _LEAST_LINEARISED_WORK)
    order = round(1.0 - 0.7 * math.log(tolerance))
    stack.setting[SERIES_ORDER] = min(ORDER, max(_LEAST_ORDER, order))
    return unit


@kernel
def _take_law(stack: Stack, i: int, kind: int, k: float, p: float, law_parameter: float) -> None:
    """Set the parameters of contact i's law; a law with zero loss becomes a lossless power law."""
    if kind == codes.ABSENT:
        stack.law[i] = codes.ABSENT
        stack.stiffness[i] = stack.exponent[i] = stack.unloading[i] = 1.0  # placeholders
        return
    stack.law[i] = codes.POWER
    stack.stiffness[i] = k
    stack.exponent[i] = p
    stack.unloading[i] = p
    if kind in (codes.HYSTERETIC, codes.LOSSY):
        stack.law[i] = kind
        stack.unloading[i] = law_parameter
    elif kind != codes.POWER and law_parameter > 0.0:
        stack.law[i] = codes.DAMPED
        if kind == codes.DASHPOT:  # k (c + b/k c')
            stack.gain_slope[i] = 1.0
            stack.gain_rate[i] = law_parameter / k
        elif kind == codes.VISCOELASTIC:  # k c^1/2 (c + 3/2 A c')
            stack.factor_exponent[i] = 0.5
            stack.gain_slope[i] = 1.0
            stack.gain_rate[i] = 1.5 * law_parameter
        else:  # k c^p (1 + χ c')
            stack.factor_exponent[i] = p
            stack.gain_constant[i] = 1.0
            stack.gain_rate[i] = law_parameter


@kernel
def _typical_compression(stack: Stack, i: int, speed: float) -> float:
    """Return the compression at which contact i alone would hold the energy m v^2/2."""
    mass, p = stack.mass[i], stack.exponent[i]
    if i > 0:
        mass = stack.mass[i - 1] * mass / (stack.mass[i - 1] + mass)
    power = 1.0 / (p + 1.0)
    length: float = (0.5 * (p + 1.0) * mass / stack.stiffness[i]) ** power * speed ** (2.0 * power)
    return length


@kernel
def prepare_rigid(
    stack: RigidStack,
    mass: Floats,
    kind: Integers,
    stiffness: Floats,  # noqa: ARG001 - no number of a rigid contact
    exponent: Floats,  # noqa: ARG001
    restitution: Floats,
    gap: Floats,
    velocity: Floats,
    gravity: float,
    rtol: float,  # noqa: ARG001 - collisions are exact
) -> float:
    """Fill an empty stack of rigid balls, gap[0] being 0; return its unit of time, 1 s.

    Lengths and speeds are in units of a power of two near the impact speed. This rounds nothing and
    keeps squares of speeds in the range of floating-point numbers. The arguments are those of
    `prepare`.
    """
    speed = 0.0
    for v in velocity:
        speed = max(speed, abs(v))
    power = math.frexp(speed)[1]
    unit = 2.0 ** max(-_LARGEST_EXPONENT, min(power, _LARGEST_EXPONENT))
    for i in range(len(stack.mass)):
        absent = kind[i] == codes.ABSENT
        stack.mass[i] = mass[i]
        stack.law[i] = codes.ABSENT if absent else codes.POWER
        stack.restitution[i] = 0.0 if absent else restitution[i]
        stack.velocity[i] = velocity[i] / unit
        stack.compression[i] = -gap[i] / unit
    stack.number[UNIT] = unit
    stack.number[GRAVITY] = gravity / unit
    return 1.0
