"""One step of many drops of two balls on linear contacts at the same time, by power series.

The state of a lane and its slots are those of `pair_step`. While no contact touches or opens, the
motion is that of a linear system. With gravity g, the free closing rates v of both contacts obey

    v0' = (F1 - F0)/m1 + g,    v1' = -(F1 - F0)/m1 - F1/m2,    F = k (c + d c')

for contacts that press (0 is the floor's). A contact that creeps counts c from its surface, whose
compression is s. There its force k (1 + z) c has the simplest form, and with w as in `forces`

    s' = mu c - nu s,    c' = v - s',    mu = z nu,    nu = 1/((1 + z) w),

where mu is 0 while it is open. A power series in time follows term by term, and holds for a step
of any length up to ``_REACH`` over the largest rate in the motion. Thus a step ends exactly at an
event, which is found in two stages: a lower bound of what the contact waits for (the compression
of a contact that creeps or is open, else c + d c') gives the time until which nothing happens, and
the first root of the series after that is the event if it is sure that there is no earlier one.
The loops have no branches, so that a compiler vectorises them.
"""

import math

from stackbounce.engine import pair_step as lane
from stackbounce.engine.codes import ASK
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.lockstep import time_above
from stackbounce.engine.pair_events import GAIN, RELEASE, TOUCH, apply_event, fly
from stackbounce.engine.pair_step import BOTH, LANES, take_steps

ORDER = 25  # of the series
_REACH = 3.0  # the longest step, times the largest rate: the last term is then below 1e-12
_FLIGHT = 1e30  # s: the longest step of balls that no force acts on
_ROUGH = 8  # terms fewer: near enough for the first rounds to find a root
_NEAR = 1e-5  # of a step: a change so small leaves an error below round-off
ERROR = 1e-13  # of a step, over the impact speed

# Slots for each contact: a term of its free closing rate; the rate at which its surface follows;
# the sign of what it waits for, and the weight of v in it; the bound, and the time until which it
# is safe. The same for both contacts: the longest step, its inverse, and the part of it that is
# made.
_EACH = lane.SLOTS + -lane.SLOTS % LANES  # a row begins at a cache line
V, CREEP, SIDE, DAMP, BOUND, SAFE, LENGTH, OVER_LENGTH, PART = (_EACH + k * BOTH for k in range(9))
# Slots for each lane: 1 if an event ends the step, and 1 if that is the floor's; what the contact
# waits for, its slope, half its second derivative, and how sure the root is.
_LANE = _EACH + 9 * BOTH
LANDS, FLOOR, VALUE, SLOPE, BEND, SURE = (_LANE + k * LANES for k in range(6))
# The order: in a slot, so that a compiler does not unroll the loops.
COUNT_OF_TERMS = _LANE + 6 * LANES
# Terms of the series in parts of a step, a slot for each contact: compression, its surface's, and
# what it waits for, which is positive; in the first half later that which may end the step. They
# come last, so that a compiler sees that no other slot is among them.
C_TERMS = COUNT_OF_TERMS + LANES
S_TERMS = C_TERMS + (ORDER + 1) * BOTH
WAITS = S_TERMS + (ORDER + 1) * BOTH
SLOTS = WAITS + ORDER * BOTH
_MASK = 31  # no change: it shows a compiler the range of a term's number


@kernel
def begin_series(x: Floats) -> None:
    """Set the number that holds for all lanes."""
    x[COUNT_OF_TERMS] = ORDER


@kernel
def step_by_series(x: Floats) -> None:
    """Move each lane on, at most to its next event; `look_after_series` applies that."""
    order = int(x[COUNT_OF_TERMS]) & _MASK
    _choose_lengths(x)
    _expand(x, order)
    _find_safe_times(x, order)
    _choose_contact(x, order)
    for terms in (order - _ROUGH, order - _ROUGH, order):
        _improve_root(x, terms)
    _choose_steps(x)
    _move(x, order)
    take_steps(x)


@kernel
def look_after_series(x: Floats, i: int) -> None:
    """Apply the event that ends the step of a lane, or decide how a free flight goes on."""
    k = i if x[FLOOR + i] > 0.0 else LANES + i
    if x[lane.DOUBT + i] > 0.0:
        x[lane.STATUS + i] = ASK
    elif x[LANDS + i] == 0.0:
        fly(x, i)
    elif x[DAMP + k] == 0.0 or x[lane.PRESSING + k] + x[lane.LEVEL + k] > 0.0:
        kind = TOUCH  # else it opened before it could press again
        if x[lane.PRESSING + k] > 0.0:
            kind = GAIN if x[lane.D + k] > 0.0 else RELEASE
        x[lane.CONTACT + i], x[lane.KIND + i] = k, kind
        apply_event(x, i)


@kernel
def _choose_lengths(x: Floats) -> None:
    """Choose the longest step of each lane, and what each contact waits for.

    The largest rate in the motion (the size of an eigenvalue) is at most the larger one of two: the
    largest frequency of undamped balls, and the sum of the largest rates of dashpots and surfaces.
    docs/models.md proves it for dashpots or surfaces alone; for both the frequency is taken larger.
    """
    for i in range(BOTH):
        pressing, surface = x[lane.PRESSING + i], x[lane.S + i]
        x[CREEP + i] = x[lane.NU + i] + x[lane.MU_NOW + i] if pressing + surface > 0.0 else 0.0
    for i in range(LANES):
        k, one = LANES + i, x[lane.OVER_1 + i]
        k0, k1 = x[lane.PRESSING + i] * one, x[lane.PRESSING + k] * (one + x[lane.OVER_2 + i])
        both = x[lane.PRESSING + i] * x[lane.PRESSING + k] * (one * one)
        springs = 0.5 * (k0 + k1 + math.sqrt((k0 - k1) * (k0 - k1) + 4.0 * both))
        dashpots, creep = k0 * x[lane.D + i] + k1 * x[lane.D + k], max(x[CREEP + i], x[CREEP + k])
        slow = dashpots + creep
        rate = math.sqrt(max(springs + dashpots * creep, slow * slow))
        x[LENGTH + i] = x[LENGTH + k] = _REACH / max(rate, _REACH / _FLIGHT)
        x[lane.WIDE + i] = x[lane.WIDE + k] = x[lane.UNSURE + i]
    for i in range(BOTH):
        pressing, compressed = x[lane.PRESSING + i], x[lane.LEVEL + i]
        x[SIDE + i], x[OVER_LENGTH + i] = 1.0 if pressing > 0.0 else -1.0, 1.0 / x[LENGTH + i]
        x[DAMP + i] = x[lane.D + i] if pressing + compressed > 0.0 else 0.0
        x[lane.TAKEN + i] = 1.0
        x[lane.WIDE + i] *= x[lane.SPAN + i]


@kernel
def _expand(x: Floats, order: int) -> None:
    """Compute the terms of the series, see the head of this module."""
    for i in range(BOTH):
        c, r, s = x[lane.Y + lane.C + i], x[lane.Y + lane.R + i], x[lane.S + i]
        x[C_TERMS + i], x[S_TERMS + i] = c, s
        x[V + i] = r + (x[lane.MU_NOW + i] * c - x[lane.NU + i] * s)
    for j in range(order):
        now, over = (j & _MASK) * BOTH, 1.0 / (j + 1.0)
        for i in range(LANES):
            k, h = LANES + i, x[LENGTH + i] * over
            v0, v1, c0, c1 = x[V + i], x[V + k], x[C_TERMS + now + i], x[C_TERMS + now + k]
            wait0, wait1 = c0 + x[DAMP + i] * v0, c1 + x[DAMP + k] * v1
            floor, balls = x[lane.PRESSING + i] * wait0, x[lane.PRESSING + k] * wait1
            creep0 = x[lane.MU_NOW + i] * c0 - x[lane.NU + i] * x[S_TERMS + now + i]
            creep1 = x[lane.MU_NOW + k] * c1 - x[lane.NU + k] * x[S_TERMS + now + k]
            push = h * x[lane.OVER_1 + i] * (balls - floor)
            x[V + i], x[V + k] = push, -push - h * x[lane.OVER_2 + i] * balls
            x[WAITS + now + i], x[WAITS + now + k] = x[SIDE + i] * wait0, x[SIDE + k] * wait1
            x[C_TERMS + now + BOTH + i] = h * (v0 - creep0)
            x[C_TERMS + now + BOTH + k] = h * (v1 - creep1)
            x[S_TERMS + now + BOTH + i], x[S_TERMS + now + BOTH + k] = h * creep0, h * creep1
        if j == 0:
            for i in range(LANES):
                x[V + i] += x[LENGTH + i] * x[lane.GRAVITY + i]


@kernel
def _find_safe_times(x: Floats, order: int) -> None:
    """Find for each contact a part of the step before which it cannot change.

    All terms but the first two are replaced by a parabola that lies below them, as in `lockstep`.
    """
    for i in range(BOTH):
        x[BOUND + i] = 0.0
    for j in range(order - 1, 1, -1):
        term = WAITS + (j & _MASK) * BOTH
        for i in range(BOTH):
            x[BOUND + i] = x[term + i] + min(0.0, x[BOUND + i])
    for i in range(BOTH):
        p0, p1, margin = x[WAITS + i], x[WAITS + BOTH + i], x[lane.WIDE + i]
        x[SAFE + i] = time_above(p0 - margin if p0 > margin else 0.0, p1, x[BOUND + i], 1.0)


@kernel
def _choose_contact(x: Floats, order: int) -> None:
    """Choose the contact that is safe for the shorter time, and let its terms be the first ones."""
    for i in range(LANES):
        one, other = x[SAFE + i], x[SAFE + LANES + i]
        x[FLOOR + i], x[PART + i] = 1.0 if one <= other else 0.0, min(one, other)
    for j in range(order):
        wait = WAITS + (j & _MASK) * BOTH
        for i in range(LANES):
            # a sum: a choice between two slots would be compiled to a slow choice between addresses
            one, other, floor = x[wait + i], x[wait + LANES + i], x[FLOOR + i]
            x[wait + i] = floor * one + (1.0 - floor) * other


@kernel
def _improve_root(x: Floats, order: int) -> None:
    """Go on to the root of the parabola that agrees with the series to second order.

    Horner's scheme gives value and derivatives, and the terms of what is left when the root is
    divided out, of which a lower bound shows whether there is another root before.
    """
    for i in range(LANES):
        x[VALUE + i] = x[WAITS + ((order - 1) & _MASK) * BOTH + i]
        x[SLOPE + i], x[BEND + i], x[SURE + i] = 0.0, 0.0, 0.0
    for j in range(order - 2, -1, -1):
        term = WAITS + (j & _MASK) * BOTH
        for i in range(LANES):
            u, f, g = x[PART + i], x[VALUE + i], x[SLOPE + i]
            x[BEND + i] = x[BEND + i] * u + g
            x[SLOPE + i] = g * u + f
            x[SURE + i] = u * min(0.0, x[SURE + i]) - f
            x[VALUE + i] = f * u + x[term + i]
    for i in range(LANES):
        f, g, h = x[VALUE + i], x[SLOPE + i], x[BEND + i]
        square = g * g - 4.0 * h * f
        under = math.sqrt(max(square, 0.0)) - g
        there = square >= 0.0 and under > 0.0
        d = 2.0 * f / (under if there else 1.0)
        there = there and abs(d) < 1.0
        x[PART + i] += d if there else 0.0
        x[LANDS + i] = 1.0 if there and abs(d) < _NEAR else 0.0


@kernel
def _choose_steps(x: Floats) -> None:
    """Let each lane step to the event if it is sure, else to the end of the safe time."""
    for i in range(LANES):
        u, unsure, steps = x[PART + i], x[lane.UNSURE + i], x[lane.STEPS + i] + 1.0
        sure = x[SURE + i] > -ERROR * x[lane.V0 + i] * x[LENGTH + i]
        sure = sure and x[SLOPE + i] < -unsure * x[LENGTH + i]
        one, other = x[SAFE + i], x[SAFE + LANES + i]
        sure = sure and 0.0 < u <= min(max(one, other), 1.0)
        lands = x[LANDS + i] if sure else 0.0
        u = u if lands > 0.0 else min(one, other)
        stuck = 1.0 if u <= 0.0 or steps > x[lane.LIMIT + i] else 0.0
        x[LANDS + i], x[lane.DOUBT + i], x[lane.STEPS + i] = lands, stuck, steps
        x[PART + i] = x[PART + LANES + i] = u
        x[lane.UNSURE + i] = unsure + ERROR * x[lane.V0 + i]
        x[lane.NEW + lane.T + i] = x[lane.Y + lane.T + i] + u * x[LENGTH + i]
        holds = x[lane.PRESSING + i] + x[lane.PRESSING + LANES + i] + x[lane.GRAVITY + i]
        x[lane.ASKS + i] = lands + stuck + (1.0 if holds == 0.0 else 0.0)


@kernel
def _move(x: Floats, order: int) -> None:
    """Compute the state at the end of each step; the rate is the slope of the compression.

    A surface has recovered if less is left of it than is not sure.
    """
    last, c_new, r_new = (order & _MASK) * BOTH, lane.NEW + lane.C, lane.NEW + lane.R
    for i in range(BOTH):
        x[c_new + i], x[r_new + i] = x[C_TERMS + last + i], 0.0
        x[lane.S_NEW + i] = x[S_TERMS + last + i]
    for j in range(order - 1, -1, -1):
        term = (j & _MASK) * BOTH
        for i in range(BOTH):
            u, c = x[PART + i], x[c_new + i]
            x[r_new + i] = c + u * x[r_new + i]
            x[c_new + i] = x[C_TERMS + term + i] + u * c
            x[lane.S_NEW + i] = x[S_TERMS + term + i] + u * x[lane.S_NEW + i]
    for i in range(BOTH):
        s_new = x[lane.S_NEW + i]
        rest = s_new if x[lane.PRESSING + i] > 0.0 or s_new > x[lane.WIDE + i] else 0.0
        x[r_new + i] = x[r_new + i] * x[OVER_LENGTH + i] + x[lane.NU + i] * (rest - s_new)
        x[lane.S + i] = rest
