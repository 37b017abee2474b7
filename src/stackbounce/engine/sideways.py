"""How offsets of balls that do not stand exactly above each other grow, to first order.

The vertical motion is that of the aligned stack, so that the forces F and compressions c of a run
are known. The normal of contact i leans by (s_i - s_(i-1)) / L_i, with the offsets s and the
distance of the centres L_i = R_(i-1) + R_i - c_i. There is no friction, and the floor pushes
straight up:

    m_i s_i'' = F_i (s_i - s_(i-1)) / L_i - F_(i+1) (s_(i+1) - s_i) / L_(i+1)

A rigid collision is a push, with its impulse. A force that lasts stands for many, with flights
between them: n in each stretch of time in which it is smooth. Their times x^3 (10 - 15 x + 6 x^2)
with x = 0, 1/n, 2/n and so on lie close where a stretch begins or ends, for there a force may be a
root of time. The error is then a series in 1/n^2, of which Richardson's extrapolation from every
second push, every fourth and so on takes the first terms away.
"""

from typing import NamedTuple

from stackbounce.engine.kernels import Floats, kernel

LEVELS = 4  # of the extrapolation, in which every push, every second, fourth and eighth counts
FEW = 128  # pushes in a stretch, of which most stacks need no more; they are doubled until the
MANY = 65536  # error is small, or all stretches together have so many
ENOUGH = 1e-9  # of the largest sideways speed: an error that is small
WRONG = 1e-3  # and one that is too large, as where a stack topples


class Pushes(NamedTuple):
    """Pushes in order of time, the balls that they push, and how these move sideways."""

    mass: Floats
    distance: Floats  # of the centres at the contact below each ball, without compression
    time: Floats
    share: Floats  # of time, s, in which the force is that of the push; 1 where it is an impulse
    force: Floats  # rows of pushes, columns of contacts: N, or N s of an impulse
    compression: Floats
    path: Floats  # the offsets at the pushes
    begin: Floats  # the offset of each ball at time 0, and its sideways speed
    end: Floats  # the same at the end; and coarser ones, see `carry_sideways`


def new_pushes(size: int, count: int) -> Pushes:
    """Return room for so many pushes on a stack of ``size`` balls as plain lists of zeros."""
    lengths = (size, size, count, count, *3 * [count * size], 2 * size, 2 * size * LEVELS)
    return Pushes(*([0.0] * length for length in lengths))


@kernel
def place_pushes(pushes: Pushes, count: int, end: float) -> int:
    """Set the times and shares of so many pushes in each stretch; return 0.

    The time of the first of them, at which the stretch begins, is given. The last stretch ends at
    ``end``.
    """
    for first in range(0, len(pushes.time), count):
        begin, following = pushes.time[first], first + count
        span = (pushes.time[following] if following < len(pushes.time) else end) - begin
        for k in range(count):
            x = k / count
            rise = x * (1.0 - x)
            pushes.time[first + k] = begin + span * (x * x * x * (10.0 + x * (6.0 * x - 15.0)))
            pushes.share[first + k] = span * (30.0 * rise * rise) / count
    return 0


@kernel
def carry_sideways(pushes: Pushes, levels: int, end: float) -> int:
    """Set the offsets and sideways speeds at the end, from those at the start; return 0.

    The last of so many rows of ``pushes.end`` has them. The row before lacks one extrapolation.
    """
    numbers = len(pushes.begin)
    for level in range(levels):
        row, step = level * numbers, 1 << (levels - 1 - level)
        _push_all(pushes, step, end, row)
        for n in range(numbers):
            value, power = pushes.end[row + n], 1.0
            for at in range(n, row + n, numbers):
                power *= 4.0
                coarse = pushes.end[at]
                pushes.end[at] = value
                value += (value - coarse) / (power - 1.0)
            pushes.end[row + n] = value
    return 0


@kernel
def _push_all(pushes: Pushes, step: int, end: float, row: int) -> None:
    """Carry offsets and speeds by every so many-th push; they are in a row of ``pushes.end``."""
    balls, now = len(pushes.mass), 0.0
    speed = row + balls
    for n in range(2 * balls):
        pushes.end[row + n] = pushes.begin[n]
    for k in range(0, len(pushes.time), step):
        for b in range(balls):
            pushes.end[row + b] += (pushes.time[k] - now) * pushes.end[speed + b]
            pushes.path[k * balls + b] = pushes.end[row + b]
        now = pushes.time[k]
        for i in range(1, balls):
            at = k * balls + i
            lean = pushes.end[row + i] - pushes.end[row + i - 1]
            lean /= pushes.distance[i] - pushes.compression[at]
            impulse = step * pushes.share[k] * pushes.force[at] * lean
            pushes.end[speed + i] += impulse / pushes.mass[i]
            pushes.end[speed + i - 1] -= impulse / pushes.mass[i - 1]
    for b in range(balls):
        pushes.end[row + b] += (end - now) * pushes.end[speed + b]
