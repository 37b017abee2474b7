"""Many drops of two balls on contacts with a nonlinear or lossy force, in lanes.

All lanes step together: by a Runge-Kutta method (`pair_step`), or where all contacts are linear by
power series (`pair_series`). Between steps, lanes that meet an event are looked after one by one
(`pair_events`). A nonlinear contact that presses alone needs no steps under some laws
(`pair_alone`). A lane whose drop has ended takes the next one. One whose drop is not sure, or takes
long, starts it again with a smaller tolerance, or leaves it to the general engine. No lane affects
another.
"""

import math
from typing import NamedTuple

from stackbounce.engine import codes
from stackbounce.engine import pair_step as lane
from stackbounce.engine.elementary import near_root, nearest_exponent, power
from stackbounce.engine.forces import numbers_of_product
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.pair_alone import go_alone
from stackbounce.engine.pair_cycles import forget
from stackbounce.engine.pair_events import free_rate, look_after, open_now, press, touch
from stackbounce.engine.pair_series import ERROR, begin_series, look_after_series, step_by_series
from stackbounce.engine.pair_step import LANES, step_by_runge_kutta
from stackbounce.engine.ratios import find_ratios
from stackbounce.engine.records import Drops, Outcomes, Workspace
from stackbounce.engine.work import LANE_STEP

_STEP = 1.3  # the error allowed in one step, over rtol
_FIRST = 1.8  # of the root of a typical compression: the first step by a root, for an error of 1
_FIRST_ROOT, _LONGEST = 8, 0.7  # it falls with this root of the error; at most so long
_FIRST_UNSURE = 2.0  # allowed errors of a step: what is not sure from the beginning
_LEVELS, _LEVELS_PER_BIT = 1.5, 0.2  # of a continued fraction, for an error of rtol/100
_REACH = 0.5  # of a compression, for an error of 1: so far do three derivatives lead
_COARSE = 2.0  # the largest estimate of order 3, for an error of 1
_COARSE_POWER = 0.38  # it falls with this power of the error
# A drop is solved again with so much of rtol, unless rtol is below _LEAST: there the general engine
# is as fast.
_AGAIN, _LEAST = 1e-3, 1e-9
# Steps of a drop, for an error of 1: one that takes more has many contacts, or oscillations, in
# which errors accumulate. With hysteresis steps also end where a compression turns.
_LONG, _TURNS = 12.0, 36.0
_MOST = 2000.0  # steps of a drop that is solved again: the general engine solves longer ones
_STEPS = 200.0  # of a linear drop: longer ones accumulate round-off


class Accuracy(NamedTuple):
    """How exactly drops are solved."""

    allowed: float  # see `pair_step`
    coarse: float
    levels: float
    reach: float
    first: float  # the first step by a root after a touch, over the root of a typical compression
    most: float  # steps of a drop; one with hysteresis may take `_TURNS` more


@kernel
def run_pairs(drops: Drops, rtol: float, out: Outcomes, space: Workspace) -> None:
    """Compute the outcomes of many drops of two balls.

    Parameters
    ----------
    drops : Drops
        The parameters of n drops, of the forms `codes.PAIR_FORMS`. Both balls come with the lower
        one's velocity.
    rtol : float
        The error of the velocities that is aimed at, over the impact speed. Drops that the lanes
        are not sure of, and long ones, are solved again with a smaller one.
    out : Outcomes
        Gets the ratios, numbers of collisions, times and work. The status is FINISHED,
        or ASK where the general engine must solve the drop; its other results are then meaningless.
    space : Workspace
        Its ``floats`` are scratch space, of the size `records.SCRATCH`.
    """
    closer = _AGAIN * rtol if rtol >= _LEAST else rtol
    most = _LONG * power(rtol, -0.125)
    _run(drops, _accuracy(rtol, most), _accuracy(closer, _MOST), False, out, space.floats)


@kernel
def run_linear(drops: Drops, event_limit: int, out: Outcomes, space: Workspace) -> None:
    """Compute the outcomes of many drops of two balls on linear contacts, up to round-off.

    Parameters
    ----------
    drops : Drops
        The parameters of n drops, of the forms `codes.LINEAR_FORMS`. Both balls come with the lower
        one's velocity.
    event_limit : int
        The number of steps, of which each has one event at most, after which a drop gets the status
        ASK.
    out, space
        As for `run_pairs`.
    """
    begin_series(space.floats)
    exact = Accuracy(ERROR, 0.0, 0.0, 0.0, 1.0, min(float(event_limit), _STEPS))
    _run(drops, exact, exact, True, out, space.floats)


@kernel
def _accuracy(rtol: float, most: float) -> Accuracy:
    """Return how exactly drops are solved with a tolerance."""
    coarse = _COARSE * power(rtol, _COARSE_POWER)
    levels, reach = _LEVELS - _LEVELS_PER_BIT * nearest_exponent(rtol), _REACH * near_root(rtol, 3)
    first = min(_FIRST * near_root(rtol, _FIRST_ROOT), _LONGEST)
    return Accuracy(_STEP * rtol, coarse, levels, reach, first, most)


@kernel
def _run(
    drops: Drops, usual: Accuracy, closer: Accuracy, linear: bool, out: Outcomes, x: Floats
) -> None:
    """Let all drops pass through the lanes, and some once more."""
    x[lane.GENERAL] = x[lane.REMEMBERS] = x[lane.LOSES] = x[lane.WATCHES] = 0.0
    rows = len(out.status)
    left, row = rows, 0
    for i in range(LANES):
        x[lane.STATUS + i], x[lane.ROW + i] = codes.ASK, -1.0  # without a drop
    while left > 0:
        for i in range(LANES):
            if x[lane.STATUS + i] == 0.0 and x[lane.ASKS + i] > 0.0:
                if linear:
                    look_after_series(x, i)
                elif look_after(x, i):
                    go_alone(x, i)
            while x[lane.STATUS + i] != 0.0:
                done = int(x[lane.ROW + i])
                unsure = x[lane.STATUS + i] == codes.ASK
                if done >= 0 and unsure and x[lane.ALLOWED + i] > closer.allowed:
                    _begin(drops, x, i, done, closer)
                else:
                    if done >= 0:
                        _write_outcome(drops, out, x, i, done)
                        left -= 1
                    if row == rows:
                        x[lane.ROW + i] = -1.0
                        break
                    _begin(drops, x, i, row, usual)
                    row += 1
                if not linear:
                    go_alone(x, i)
        if linear:
            step_by_series(x)
        else:
            step_by_runge_kutta(x)


@kernel
def _begin(drops: Drops, x: Floats, i: int, row: int, accuracy: Accuracy) -> None:
    """Start a drop in lane i, at t = 0."""
    speed, first = -drops.velocity[row, 0], accuracy.first
    x[lane.ALLOWED + i], x[lane.COARSE + i] = accuracy.allowed, accuracy.coarse
    x[lane.LEVELS + i], x[lane.REACH + i] = accuracy.levels, accuracy.reach
    x[lane.LIMIT + i] = accuracy.most
    x[lane.ROW + i], x[lane.STATUS + i], x[lane.V0 + i], x[lane.STEPS + i] = row, 0.0, speed, 0.0
    x[lane.OVER_1 + i], x[lane.OVER_2 + i] = 1.0 / drops.mass[row, 0], 1.0 / drops.mass[row, 1]
    x[lane.Y + lane.T + i], x[lane.BY_TIME + i] = 0.0, math.inf
    x[lane.GRAVITY + i] = drops.gravity[row]
    x[lane.UNSURE + i] = _FIRST_UNSURE * accuracy.allowed * speed
    over_mass = 0.0
    for b in range(2):
        k = b * LANES + i
        _take_law(drops, x, row, b, k)
        if x[lane.LOSS + k] > 0.0:
            x[lane.LIMIT + i] = accuracy.most + _TURNS
        x[lane.Y + lane.C + k], x[lane.Y + lane.R + k] = -drops.gap[row, b], 0.0
        x[lane.S + k], x[lane.COUNT + k] = 0.0, 0.0
        x[lane.FIRST + k], x[lane.LAST + k] = math.nan, math.nan
        open_now(x, k)
        forget(x, k)
        # k c^(p + 1) is about m v^2
        over_mass += x[lane.OVER_1 + b * LANES + i]
        energy = speed * speed / (x[lane.STIFFNESS + k] * over_mass)
        root = near_root(energy, int(2.0 * x[lane.POWER + k] + 4.5))
        x[lane.SCALE + k], x[lane.SPAN + k] = first * root, root * root / speed
    x[lane.Y + lane.R + i] = speed
    k = LANES + i
    if x[lane.Y + lane.C + k] == 0.0:
        press(x, i, k)
        x[lane.BY_TIME + i] = 2.0 * first * first * x[lane.SPAN + k]  # the upper may be stiffer
    touch(x, i, i)
    if x[lane.PRESSING + k] > 0.0:  # from rest: it is compressed from now on
        x[lane.OWN + k] = 1.0


@kernel
def _take_law(drops: Drops, x: Floats, row: int, b: int, k: int) -> None:
    """Set the numbers of contact k of a lane: those of ball b's contact in a row."""
    form, stiffness = drops.form[row, b], drops.first[row, b]
    p, loss = drops.second[row, b], drops.third[row, b]
    a, slope, d, mu, nu, held = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if form == codes.HYSTERETIC:
        held = max(loss - p, 0.0)
    elif form != codes.POWER and loss > 0.0:
        product = numbers_of_product(form, stiffness, p, loss, drops.fourth[row, b])
        _, a, slope, d, creep, rate = product
        if creep > 0.0:
            stiffness, nu = slope * stiffness, rate / slope
            a, slope, mu = 1.0, 0.0, creep * nu
    if held > 0.0:
        x[lane.REMEMBERS] = x[lane.WATCHES] = 1.0
    if d > 0.0:
        x[lane.LOSES] = x[lane.WATCHES] = 1.0
    if p not in (1.0, 1.5):
        x[lane.GENERAL] = 1.0
    x[lane.A + k], x[lane.B + k], x[lane.D + k] = a, slope, d
    watched = (0.0, 0.0, 1.0) if held > 0.0 else (a, slope, d)
    x[lane.END_A + k], x[lane.END_B + k], x[lane.END_D + k] = watched
    x[lane.STIFFNESS + k], x[lane.POWER + k], x[lane.LOSS + k] = stiffness, p - 1.0, held
    x[lane.MU + k], x[lane.NU + k] = mu, nu


@kernel
def _write_outcome(drops: Drops, out: Outcomes, x: Floats, i: int, row: int) -> None:
    """Write the outcome of the drop in lane i."""
    out.status[row], out.work[row] = int(x[lane.STATUS + i]), LANE_STEP * int(x[lane.STEPS + i])
    lower = -free_rate(x, i)
    out.rebound_ratio[row, 0], out.rebound_ratio[row, 1] = lower, lower - free_rate(x, LANES + i)
    for b in range(2):
        k = b * LANES + i
        out.collisions[row, b] = int(x[lane.COUNT + k])
        out.first_touch[row, b], out.last_release[row, b] = x[lane.FIRST + k], x[lane.LAST + k]
    find_ratios(drops, out, row)
