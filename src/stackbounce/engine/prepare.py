"""From a drop's own numbers to a stack at t = 0: what each law's numbers mean to the engine.

A contact is given by four numbers: the form of its force (`codes`), k, p, and one more, `extra`:
damping b, dissipative time A, dissipation χ, unloading exponent n or restitution e.
"""

import math

from stackbounce.engine import codes
from stackbounce.engine.kernel import Floats, Integers, kernel
from stackbounce.engine.series import ORDER
from stackbounce.engine.stack import RigidStack, Stack

_STEP = 0.02  # of the tolerance asked for: what one step of a nonlinear cluster may leave out
_ROUND_OFF = 1e-16
_LEAST_ORDER = 6
_FAINT = 1e-2  # of that again: work of a typical contact below which a power law's chord will do
_FAINTEST = 1e-18
_LARGEST_EXPONENT = 600  # of a unit of speed, as a power of two
_LONGEST_EXPONENT = 200  # of a unit of time


@kernel
def prepare(
    stack: Stack,
    mass: Floats,
    kind: Integers,
    stiffness: Floats,
    exponent: Floats,
    extra: Floats,
    gap: Floats,
    velocity: Floats,
    gravity: float,
    rtol: float,
) -> float:
    """Fill an empty stack on finite contacts, gap[0] being 0; return its unit of time in s.

    That is the power of two nearest to the shortest contact time: in this unit no power series
    leaves the range of numbers, and nothing is rounded by it.
    """
    size = len(stack.mass)
    speed, shortest = 0.0, math.inf
    for i in range(size):
        speed = max(speed, abs(velocity[i]))
    for i in range(size):
        stack.mass[i] = mass[i]
        _take_law(stack, i, kind[i], stiffness[i], exponent[i], extra[i])
        stack.scale[i] = _typical_compression(stack, i, speed)
        if stack.law[i] != codes.ABSENT:
            shortest = min(shortest, stack.scale[i] / speed)
        if stack.unloading[i] != 1.0 or stack.factor_exponent[i] != 0.0:
            stack.setting[1] = 1
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
    stack.number[0] = gravity * unit**2
    stack.number[1] = speed * unit
    stack.number[2] = tolerance
    stack.number[3] = max(tolerance * _FAINT, _FAINTEST)
    order = round(1.0 - 0.7 * math.log(tolerance))
    stack.setting[0] = min(ORDER, max(_LEAST_ORDER, order))
    return unit


@kernel
def _take_law(stack: Stack, i: int, kind: int, k: float, p: float, extra: float) -> None:
    """Put the numbers of contact i's law in place; a law that loses nothing is a power law."""
    if kind == codes.ABSENT:
        stack.law[i] = codes.ABSENT
        stack.stiffness[i] = stack.exponent[i] = stack.unloading[i] = 1.0  # whatever it was given
        return
    stack.law[i] = codes.POWER
    stack.stiffness[i] = k
    stack.exponent[i] = p
    stack.unloading[i] = p
    if kind in (codes.HYSTERETIC, codes.LOSSY):
        stack.law[i] = kind
        stack.unloading[i] = extra
    elif kind != codes.POWER and extra > 0.0:
        stack.law[i] = codes.DAMPED
        if kind == codes.DASHPOT:  # k (c + b/k c')
            stack.gain_slope[i] = 1.0
            stack.gain_rate[i] = extra / k
        elif kind == codes.VISCOELASTIC:  # k c^1/2 (c + 3/2 A c')
            stack.factor_exponent[i] = 0.5
            stack.gain_slope[i] = 1.0
            stack.gain_rate[i] = 1.5 * extra
        else:  # k c^p (1 + χ c')
            stack.factor_exponent[i] = p
            stack.gain_constant[i] = 1.0
            stack.gain_rate[i] = extra


@kernel
def _typical_compression(stack: Stack, i: int, speed: float) -> float:
    """Return the compression of contact i at which it alone would hold the energy m v^2/2."""
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
    restitution: Floats,
    gap: Floats,
    velocity: Floats,
    gravity: float,
) -> None:
    """Fill an empty stack of rigid balls, gap[0] being 0.

    Lengths and speeds are in units of a power of two near the impact speed, which rounds nothing
    and keeps squares of speeds in the range of numbers.
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
    stack.number[0] = unit
    stack.number[3] = gravity / unit
