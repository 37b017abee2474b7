"""The restitution of one rigid collision, which may depend on its speed and scatter.

A contact of the form RIGID has the same restitution in all collisions. The other two forms have,
at the speed v at which the pair meets,

    RIGID_POWER    e = k v^-p,  at most 1,
    RIGID_LOSS     1 - e = k v^p,  at most 1,

with p of 0 or above: the slower the collision, the smaller the *loss* 1 - e. With a scatter, a
random number with that standard deviation is added to e in each collision, and e is kept from 0
to 1. The random number follows from the contact's seed, its place in the stack and how often it has
collided, and from nothing else.
"""

import math

from stackbounce.engine.codes import ABSENT, RIGID, RIGID_LOSS, RIGID_POWER
from stackbounce.engine.elementary import log, power, sine_and_cosine
from stackbounce.engine.kernels import kernel
from stackbounce.engine.slots import UNIT
from stackbounce.engine.stack import RigidStack

_WORD = 4294967295  # 32 bits, all 1
_WORDS = 4294967296.0  # 2^32
_OTHER = 2654435769  # a word by which the second of two random words is made to differ
_TURN = 6.283185307179586  # 2 pi
_CLIPPED = 0.39  # times the scatter: keeping e at most 1 costs at least so much on average


@kernel
def take_restitution(
    stack: RigidStack, i: int, kind: int, k: float, p: float, z: float, w: float
) -> None:
    """Set the numbers of contact i's law; one that cannot vary becomes RIGID."""
    stack.law[i] = kind
    if kind == RIGID:
        stack.restitution[i] = z
    elif kind != ABSENT and p == 0.0 and z == 0.0:
        stack.law[i] = RIGID
        stack.restitution[i] = _mean_restitution(kind, k, p, 1.0)
    elif kind != ABSENT:
        stack.coefficient[i], stack.exponent[i] = k, p
        stack.scatter[i], stack.seed[i] = z, w


@kernel
def varies(stack: RigidStack, i: int) -> bool:
    """Return whether the restitution of contact i is not the same in all collisions."""
    return stack.law[i] == RIGID_POWER or stack.law[i] == RIGID_LOSS


@kernel
def loses_energy(stack: RigidStack, i: int) -> bool:
    """Return whether there are collisions in which contact i loses energy."""
    if varies(stack, i):
        return stack.coefficient[i] > 0.0 or stack.scatter[i] > 0.0
    return stack.law[i] != ABSENT and stack.restitution[i] < 1.0


@kernel
def next_restitution(stack: RigidStack, i: int, rate: float) -> float:
    """Return the restitution of the collision that contact i has now, at a closing rate."""
    if not varies(stack, i):
        return stack.restitution[i]
    speed = abs(rate) * stack.number[UNIT]
    e = _mean_restitution(stack.law[i], stack.coefficient[i], stack.exponent[i], speed)
    if stack.scatter[i] > 0.0:
        e += stack.scatter[i] * _normal(stack.seed[i], i, stack.hits[i])
    return min(max(e, 0.0), 1.0)


@kernel
def loss_at(stack: RigidStack, i: int, rate: float) -> float:
    """Return 1 - e of contact i at a closing rate, without scatter."""
    if not varies(stack, i):
        return 1.0 - stack.restitution[i]
    speed, k, p = abs(rate) * stack.number[UNIT], stack.coefficient[i], stack.exponent[i]
    if stack.law[i] == RIGID_LOSS:
        return _power_loss(k, p, speed)
    return 1.0 - _mean_restitution(stack.law[i], k, p, speed)


@kernel
def settling_loss(stack: RigidStack, i: int, rate: float) -> float:
    """Return x such that all bounces of a ball on contact i take at most 1/x times the next one.

    ``rate`` is the closing rate of the next one. With a constant restitution x is 1 - e, with a
    scatter that holds on average, and x is 0 if the ball bounces for ever: where e is 1 below some
    speed, or the loss vanishes as fast as the speed. See `settling` for the sum behind it.
    """
    if not varies(stack, i):
        return 1.0 - stack.restitution[i]
    if stack.scatter[i] > 0.0:
        return max(loss_at(stack, i, rate), _CLIPPED * stack.scatter[i])
    if stack.law[i] == RIGID_LOSS:
        return loss_at(stack, i, rate) * max(0.0, 1.0 - stack.exponent[i])
    return 0.0


@kernel
def _mean_restitution(kind: int, k: float, p: float, speed: float) -> float:
    """Return e at a speed in m/s, from 0 to 1."""
    if kind == RIGID_LOSS:
        return 1.0 - _power_loss(k, p, speed)
    return min(1.0, k * power(speed, -p)) if k > 0.0 else 0.0


@kernel
def _power_loss(k: float, p: float, speed: float) -> float:
    """Return k v^p at a speed in m/s, at most 1."""
    return min(1.0, k * power(speed, p)) if k > 0.0 else 0.0


@kernel
def _normal(seed: float, contact: int, hit: int) -> float:
    """Return a number of the standard normal distribution, by Box and Muller's transform."""
    whole = int(seed)
    word = _mixed(whole)
    word = _mixed(word ^ int((seed - whole) * _WORDS))
    word = _mixed(word ^ contact)
    word = _mixed(word ^ (hit & _WORD))
    size = (_mixed(word) + 0.5) / _WORDS
    _, cosine = sine_and_cosine(_TURN * (_mixed(word ^ _OTHER) / _WORDS))
    return math.sqrt(-2.0 * log(size)) * cosine


@kernel
def _mixed(word: int) -> int:
    """Return a word of 32 bits that looks random: the hash PCG-RXS-M-XS.

    Source: M. Jarzynski and M. Olano, J. Comput. Graph. Tech. 9 (3), 20 (2020).
    """
    state = (word * 747796405 + 2891336453) & _WORD
    mixed = (((state >> ((state >> 28) + 4)) ^ state) * 277803737) & _WORD
    return (mixed >> 22) ^ mixed
