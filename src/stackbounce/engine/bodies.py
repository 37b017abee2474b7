"""Balls that bonds join to one body, and when bodies have parted for good.

While only bonds press, a cluster is a body in flight, or one that is bonded to the floor. A body
vibrates: its parts deviate from where they would be if all its bonds were as long as at rest. The
energy E of the vibration never grows, so that no bond of stiffness k is ever pressed or pulled by
more than sqrt(2 E/k), and no part deviates by more than the sum of these.

Two bodies have parted if their centres do not approach each other, and the gap between them would
be larger than both deviations together if both were as long as at rest.
"""

import math

from stackbounce.engine.codes import ABSENT, OPEN
from stackbounce.engine.contacts import approach_noise
from stackbounce.engine.kernels import kernel
from stackbounce.engine.motion import compression_at, velocity_at
from stackbounce.engine.slots import GRAVITY, LAST_CHECK
from stackbounce.engine.stack import Stack


@kernel
def load_floor(stack: Stack) -> None:
    """Let the body that is bonded to the floor carry its own weight at the start."""
    top = 0
    while top < len(stack.mass) and stack.bonded[top] == 1:
        top += 1
    weight = 0.0
    for i in range(top - 1, -1, -1):
        weight += stack.mass[i] * stack.number[GRAVITY]
        stack.compression[i] = weight / stack.stiffness[i]


@kernel
def body_velocity(stack: Stack, b: int, time: float) -> float:
    """Return the velocity of the centre of ball b's body; 0 if it is bonded to the floor."""
    first, above = b, b + 1
    while first > 0 and stack.bonded[first] == 1:
        first -= 1
    if stack.bonded[first] == 1:
        return 0.0
    while above < len(stack.mass) and stack.bonded[above] == 1:
        above += 1
    mass, momentum = 0.0, 0.0
    for j in range(first, above):
        mass += stack.mass[j]
        momentum += stack.mass[j] * velocity_at(stack, j, time)
    return momentum / mass


@kernel
def body_velocity_at_end(stack: Stack, b: int, end: float) -> float:
    """Return the velocity of the centre of ball b's body at the end of the run.

    Bodies that have parted may have been followed longer, in free flight.
    """
    time = max(end, stack.number[LAST_CHECK])
    velocity = body_velocity(stack, b, time)
    if stack.bonded[stack.first[b]] == 1:
        return velocity
    return velocity + stack.number[GRAVITY] * (time - end)


@kernel
def _stretch(stack: Stack, i: int, time: float) -> float:
    """Return the compression of bond i beyond that which carries the weight above it.

    Only a body on the floor has a weight to carry.
    """
    first, last = stack.first[i], stack.last[i]
    weight = 0.0
    if stack.bonded[first] == 1:
        for j in range(i, last + 1):
            weight += stack.mass[j] * stack.number[GRAVITY]
    return compression_at(stack, i, time) - weight / stack.stiffness[i]


@kernel
def _largest_deviation(stack: Stack, b: int, time: float) -> float:
    """Return a bound on the deviation of all parts of ball b's body, for all later times."""
    first, last = stack.first[b], stack.last[b]
    centre = body_velocity(stack, b, time)
    energy, lengths = 0.0, 0.0
    for j in range(first, last + 1):
        speed = velocity_at(stack, j, time) - centre
        energy += 0.5 * stack.mass[j] * speed * speed
        if stack.bonded[j] == 1:
            stretch = _stretch(stack, j, time)
            energy += 0.5 * stack.stiffness[j] * stretch * stretch
            lengths += 1.0 / math.sqrt(stack.stiffness[j])
    return math.sqrt(2.0 * energy) * lengths


@kernel
def _deviation(stack: Stack, b: int, time: float) -> float:
    """Return how far ball b is above its place in its body, if all bonds were as long as at rest.

    The place is relative to the body's centre, or to the floor.
    """
    first, last = stack.first[b], stack.last[b]
    height, own, mean, mass = 0.0, 0.0, 0.0, 0.0
    for j in range(first, last + 1):
        if stack.bonded[j] == 1:
            height -= _stretch(stack, j, time)
        if j == b:
            own = height
        mean += stack.mass[j] * height
        mass += stack.mass[j]
    return own if stack.bonded[first] == 1 else own - mean / mass


@kernel
def have_parted(stack: Stack, time: float) -> bool:
    """Return whether all contacts but the bonds are open, and stay so without gravity."""
    for i in range(len(stack.mass)):
        if stack.bonded[i] == 1 or stack.law[i] == ABSENT:
            continue
        if stack.phase[i] != OPEN:
            return False
        rate = -body_velocity(stack, i, time)
        gap = -compression_at(stack, i, time) - _deviation(stack, i, time)
        reach = _largest_deviation(stack, i, time)
        if i > 0:
            rate += body_velocity(stack, i - 1, time)
            gap += _deviation(stack, i - 1, time)
            reach += _largest_deviation(stack, i - 1, time)
        if rate > approach_noise(stack, i) or gap < reach:
            return False
    return True
