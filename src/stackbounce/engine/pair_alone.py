"""A contact of two balls in a lane that presses alone, with a power of its compression as force.

Its motion has a formula, so that it needs no steps. With r' = -kappa c^n and s = 1/(n + 1), energy
gives

    r = V (1 - 2 y),    c = C (4 y (1 - y))^s,    C = (V^2/(2 s kappa))^s,

where y goes from 0, where it touches at the rate V, over 1/2 at the largest compression, C, to 1.
The time since the touch is an incomplete beta function (NIST Digital Library of Mathematical
Functions, section 8.17): up to y = 1/2,

    t = (c/V) F(2 s, 1; 1 + s; y),

with the hypergeometric function F, from the continued fraction of Gauss (ibid., section 15.7).
The other contact is open: its compression, plus a share of c, grows at a steady rate.
"""

import math
from typing import NamedTuple

from stackbounce.engine import pair_step as lane
from stackbounce.engine.codes import ASK
from stackbounce.engine.elementary import exp, power, quick_log
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.pair_events import go_apart, open_now, touch
from stackbounce.engine.pair_step import LANES

_SMALL, _LARGE = 1e-140, 1e140  # m/s: squares of speeds between are ordinary numbers
_ROUNDS = 30  # to find where the other contact touches: three or four are typical


class LoneMotion(NamedTuple):
    """How a contact that presses alone moves."""

    s: float
    speed: float  # V
    y: float  # now; that of the outward motion, mirrored to less than 1/2
    time: float  # since the touch, or to the release if it moves outward
    largest: float  # C, and the time from the touch to it; 0 if it moves outward
    half: float
    share: float  # t from now on, the other contact's compression is start + rate t - share c
    start: float
    rate: float


@kernel
def go_alone(x: Floats, i: int) -> None:
    """Let a contact that presses alone move from event to event, as far as a formula says how."""
    goes = True
    while goes and x[lane.STATUS + i] == 0.0:
        k = i if x[lane.PRESSING + i] > 0.0 else LANES + i
        other = 2 * i + LANES - k
        alone = x[lane.PRESSING + k] > 0.0 and x[lane.PRESSING + other] == 0.0
        alone = alone and x[lane.LEVEL + other] == 0.0
        lossless = x[lane.D + k] == 0.0 and x[lane.LOSS + k] == 0.0
        has_formula = alone and lossless and x[lane.GRAVITY + i] == 0.0
        goes = has_formula and _go(x, i, k)


@kernel
def _time(x: Floats, i: int, c: float, speed: float, s: float, y: float) -> float:
    """Return the time since the touch, for y up to 1/2."""
    levels = int(x[lane.LEVELS + i])
    upper, lower = s + 2.0 * levels, 1.0
    for j in range(levels - 1, -1, -1):
        upper, lower = (s + 2.0 * j + 1.0) * upper - (j + 1) * (j + 1 - s) * y * lower, upper
        upper, lower = (s + 2.0 * j) * upper - (2.0 * s + j) * (s + j) * y * lower, upper
    return c * s * lower / (speed * upper)


@kernel
def _motion(x: Floats, i: int, k: int) -> LoneMotion:
    """Return how contact k moves, which presses alone."""
    other, over, share = 2 * i + LANES - k, x[lane.OVER_1 + i], 1.0
    if k != i:
        over += x[lane.OVER_2 + i]
        share = x[lane.OVER_1 + i] / over
    less, kappa = x[lane.POWER + k], over * x[lane.STIFFNESS + k]  # less: n - 1
    s, c, r = 1.0 / (less + 2.0), x[lane.Y + lane.C + k], x[lane.Y + lane.R + k]
    square = 2.0 * s * kappa * c * c * power(c, less)
    speed = max(math.sqrt(r * r + square), _SMALL)
    y, largest, half = square / (2.0 * speed * (speed + abs(r))), 0.0, 0.0
    time = _time(x, i, c, speed, s, y) if c > 0.0 else 0.0
    if not r < 0.0:
        largest = exp(s * quick_log(speed * speed / (2.0 * s * kappa)))
        half = _time(x, i, largest, speed, s, 0.5)
    start = x[lane.Y + lane.C + other] + share * c
    rate = x[lane.Y + lane.R + other] + share * r
    return LoneMotion(s, speed, y, time, largest, half, share, start, rate)


@kernel
def _go(x: Floats, i: int, k: int) -> bool:
    """Let contact k, which presses, move up to the next event; return whether it is sure which."""
    other, m, inward = 2 * i + LANES - k, _motion(x, i, k), not x[lane.Y + lane.R + k] < 0.0
    left = 2.0 * m.half - m.time if inward else m.time
    c_other, r_other = m.start + m.rate * left, m.rate + m.share * m.speed
    margin = x[lane.UNSURE + i] * left
    if not _SMALL < m.speed < _LARGE:
        x[lane.STATUS + i] = ASK
        return False
    if r_other > 0.0 and c_other > -margin:
        return inward and c_other > margin and _meet(x, i, k, m)
    x[lane.Y + lane.C + k], x[lane.Y + lane.R + k] = 0.0, -m.speed
    x[lane.Y + lane.C + other], x[lane.Y + lane.R + other] = c_other, r_other
    x[lane.Y + lane.T + i] += left
    open_now(x, k)
    go_apart(x, i, k)
    return True


@kernel
def _meet(x: Floats, i: int, k: int, m: LoneMotion) -> bool:
    """Let contact k move until the other one touches; return whether that was found.

    The compression of the other one grows from below 0 ever faster. Three derivatives with respect
    to time, at some y, lead to the next y, until they lead so near that they give the touch.
    """
    low, high, y, c, time = m.y, 1.0, 0.5, m.largest, m.half
    for _ in range(_ROUNDS):
        r, n = m.speed * (1.0 - 2.0 * y), 1.0 / m.s - 1.0
        push = 2.0 * m.speed * m.speed * y * (1.0 - y) / (m.s * c)
        change = n * push * r / c
        above = m.start + m.rate * (time - m.time) - m.share * c
        low, high = (low, y) if above > 0.0 else (y, high)
        slope = m.rate - m.share * r
        square = slope * slope - 2.0 * m.share * push * above
        y = low
        if square > 0.0:
            wait = -2.0 * above / (slope + math.sqrt(square))
            slower = wait * (push + 0.5 * wait * change)
            if abs(wait) * m.speed < x[lane.REACH + i] * c:
                x[lane.Y + lane.C + k] = c + wait * (r - wait * (0.5 * push + wait * change / 6.0))
                x[lane.Y + lane.R + k] = r - slower
                x[lane.Y + lane.R + 2 * i + LANES - k] = m.rate - m.share * (r - slower)
                x[lane.Y + lane.T + i] += time - m.time + wait
                x[lane.BY_TIME + i] = 2.0 * x[lane.SCALE + k] * x[lane.SCALE + k] / x[lane.V0 + i]
                touch(x, i, 2 * i + LANES - k)
                return True
            y = 0.5 - 0.5 * (r - slower) / m.speed
        if not low < y < high:
            y = 0.5 * (low + high)
        nearer = min(y, 1.0 - y)
        c = m.largest * exp(m.s * quick_log(4.0 * nearer * (1.0 - nearer)))
        time = _time(x, i, c, m.speed, m.s, nearer)
        time = 2.0 * m.half - time if y > 0.5 else time
    return False
