"""Fill a stack with the parameters of a drop, at t = 0.

A contact is given by the five numbers that `forces` explains: the form of its force, the stiffness,
the exponent and two law parameters.
"""

import math

from stackbounce.engine import codes
from stackbounce.engine.elementary import (
    exponent_of,
    log,
    nearest_exponent,
    times_power_of_two,
)
from stackbounce.engine.forces import is_nonlinear, take_law, typical_compression
from stackbounce.engine.kernels import Floats, Integers, kernel
from stackbounce.engine.restitution import take_restitution
from stackbounce.engine.series import ORDER
from stackbounce.engine.slots import (
    BONDS,
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
    second_parameter: Floats,
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
        z, w = law_parameter[i], second_parameter[i]
        take_law(stack, i, kind[i], stiffness[i], exponent[i], z, w)
        stack.scale[i] = typical_compression(stack, i, speed)
        if stack.law[i] != codes.ABSENT:
            shortest = min(shortest, stack.scale[i] / speed)
        stack.setting[BONDS] += stack.bonded[i]
        if is_nonlinear(stack, i):
            stack.setting[NONLINEAR] = 1
    unit = 1.0
    if 0.0 < shortest < math.inf:
        power = nearest_exponent(shortest)
        power = max(-_LONGEST_EXPONENT, min(power, _LONGEST_EXPONENT))
        unit = times_power_of_two(1.0, power)
    for i in range(size):
        stack.stiffness[i] *= unit * unit
        stack.gain_rate[i] /= unit
        stack.creep_rate[i] *= unit
        stack.velocity[i] = velocity[i] * unit
        stack.compression[i] = -gap[i]
    tolerance = max(_STEP * rtol, _ROUND_OFF)
    stack.number[GRAVITY] = gravity * (unit * unit)
    stack.number[SPEED] = speed * unit
    stack.number[TOLERANCE] = tolerance
    stack.number[LINEARISED_WORK] = max(tolerance * _LINEARISED_SHARE, _LEAST_LINEARISED_WORK)
    order = math.floor(1.5 - 0.7 * log(tolerance))
    stack.setting[SERIES_ORDER] = min(ORDER, max(_LEAST_ORDER, order))
    return unit


@kernel
def prepare_rigid(
    stack: RigidStack,
    mass: Floats,
    kind: Integers,
    coefficient: Floats,
    exponent: Floats,
    law_parameter: Floats,
    second_parameter: Floats,
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
    power = max(-_LARGEST_EXPONENT, min(exponent_of(speed), _LARGEST_EXPONENT))
    unit = times_power_of_two(1.0, power)
    for i in range(len(stack.mass)):
        stack.mass[i] = mass[i]
        z, w = law_parameter[i], second_parameter[i]
        take_restitution(stack, i, kind[i], coefficient[i], exponent[i], z, w)
        stack.velocity[i] = velocity[i] / unit
        stack.compression[i] = -gap[i] / unit
    stack.number[UNIT] = unit
    stack.number[GRAVITY] = gravity / unit
    return 1.0
