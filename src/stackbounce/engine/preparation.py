"""Fill a stack with the parameters of a drop, at t = 0.

A contact is given by the form of its force and four numbers, which `forces` explains.
"""

import math

from stackbounce.engine import codes, slots
from stackbounce.engine.elementary import exponent_of, log, nearest_exponent, times_power_of_two
from stackbounce.engine.forces import is_nonlinear, take_law, typical_compression
from stackbounce.engine.kernels import kernel
from stackbounce.engine.ratios import largest_speed
from stackbounce.engine.records import Drops
from stackbounce.engine.restitution import take_restitution
from stackbounce.engine.series import ORDER
from stackbounce.engine.stack import RigidStack, Stack

_STEP = 0.02  # the error of one step of a nonlinear cluster, over rtol
_ROUND_OFF = 1e-16  # the least such error
_APART = 10.0  # a ratio of the contacts' times: beyond it that error is smaller in proportion
_LEAST_ORDER = 6  # of a power series
_LINEARISED_SHARE = 1e-2  # LINEARISED_WORK over the error of one step
_LEAST_LINEARISED_WORK = 1e-18  # but at least so much
_LARGEST_EXPONENT = 600  # of 2 in the unit of speed
_LONGEST_EXPONENT = 200  # of 2 in the unit of time


@kernel
def prepare(stack: Stack, drops: Drops, row: int, rtol: float) -> float:
    """Fill an empty stack with a drop on finite contacts; return its unit of time in s.

    The unit is the power of two nearest to the shortest contact time. In it no power series leaves
    the range of floating-point numbers, and the conversion rounds nothing.
    """
    size, velocity = len(stack.mass), drops.velocity[row]
    speed, shortest, longest = largest_speed(velocity), math.inf, 0.0
    for i in range(size):
        stack.mass[i] = drops.mass[row][i]
        take_law(stack, i, *_contact(drops, row, i))
        stack.scale[i] = typical_compression(stack, i, speed)
        if stack.law[i] != codes.ABSENT:
            shortest = min(shortest, stack.scale[i] / speed)
            longest = max(longest, stack.scale[i] / speed)
        stack.counter[slots.BONDS] += stack.bonded[i]
        if is_nonlinear(stack, i):
            stack.counter[slots.NONLINEAR] = 1
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
        stack.compression[i] = -drops.gap[row][i]
    tolerance = _STEP * rtol
    if _APART * shortest < longest:  # errors of speeds add up to positions while the longest lasts
        tolerance *= _APART * shortest / longest
    tolerance = max(tolerance, _ROUND_OFF)
    stack.number[slots.GRAVITY] = drops.gravity[row] * (unit * unit)
    stack.number[slots.SPEED] = speed * unit
    stack.number[slots.TOLERANCE] = tolerance
    stack.number[slots.LINEARISED_WORK] = max(tolerance * _LINEARISED_SHARE, _LEAST_LINEARISED_WORK)
    order = math.floor(1.5 - 0.7 * log(tolerance))
    stack.counter[slots.SERIES_ORDER] = min(ORDER, max(_LEAST_ORDER, order))
    return unit


@kernel
def prepare_rigid(stack: RigidStack, drops: Drops, row: int) -> float:
    """Fill an empty stack with a drop of rigid balls; return its unit of time, 1 s.

    Lengths and speeds are in units of a power of two near the impact speed. This rounds nothing and
    keeps squares of speeds in the range of floating-point numbers.
    """
    velocity = drops.velocity[row]
    speed = largest_speed(velocity)
    power = max(-_LARGEST_EXPONENT, min(exponent_of(speed), _LARGEST_EXPONENT))
    unit = times_power_of_two(1.0, power)
    for i in range(len(stack.mass)):
        stack.mass[i] = drops.mass[row][i]
        take_restitution(stack, i, *_contact(drops, row, i))
        stack.velocity[i] = velocity[i] / unit
        stack.compression[i] = -drops.gap[row][i] / unit
    stack.number[slots.UNIT] = unit
    stack.number[slots.GRAVITY] = drops.gravity[row] / unit
    return 1.0


@kernel
def _contact(drops: Drops, row: int, i: int) -> tuple[int, float, float, float, float]:
    """Return the form of the force of contact i, and its four numbers."""
    first, second = drops.first[row][i], drops.second[row][i]
    return drops.form[row][i], first, second, drops.third[row][i], drops.fourth[row][i]
