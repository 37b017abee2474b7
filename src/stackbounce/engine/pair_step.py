"""One step of many drops of two balls on nonlinear contacts at the same time, in lock step.

Every drop has a lane in one flat array, as in `lockstep`: slot ``N`` of lane i is ``x[N + i]``. All
lanes take a step of the Runge-Kutta method of order 8 of Dormand and Prince (E. Hairer, S. P.
Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer, 1993, section
II.10), each of its own length. The loops have no branches, so that a compiler vectorises them.

The state of a lane is the compression c and the closing rate r = c' of both contacts, and the time.
The force of a pressing contact is

    F = k c^(p - 1) g (b + a c),    g = a + b c + d r,

where a is 1 and b is 0, or the other way round (see `forces`): a Hertz contact has p = 1.5, a = 1
and d = 0; that of Hunt and Crossley a = 1; a dashpot p = 1 and b = 1; a viscoelastic one p = 1.5
and b = 1. F is not cut off at 0, so that a step is smooth that passes the end of a contact; it is
then repeated up to that end. With hysteresis, F becomes F (ADDED + KEPT s) + HELD s + OFFSET, with
the share s = (c/C)^M that is left of the force at a peak C (see `cycles`).

The independent variable s of a step is chosen so that the motion is smooth in it and the step ends
exactly at an event (M. Henon, Physica D 5, 412, 1982). With weights,

    dt/ds = (m + 2 n s) / (q + by_r r + by_a r').

=================================== ====== =========================================================
the step goes by                    s      weights
=================================== ====== =========================================================
time                                t      m = q = 1
the compression of an open contact  c      m = 1, by_r = 1: ends where the contact touches, at c = 0
its root, of a pressing contact     c^0.5  n = 1, by_r = 1: begins where it touches, or ends where
                                           it opens; there the force is smooth in this root only
the gain of a damped contact        g      m = 1, by_r = b, by_a = d: ends where it stops pressing
the rate, with hysteresis           r      m = 1, by_a = 1: ends where the compression turns
a compression, with hysteresis      c      m = 1, by_r = 1: ends where a cycle closes
=================================== ====== =========================================================
"""

import math
from collections.abc import Sequence

from stackbounce.engine.elementary import swift_exp, swift_log
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.files import shipped_table

LANES = 16  # a power of two
BOTH = 2 * LANES  # a slot for each contact: the floor's, then the balls'
CYCLES = 4  # of hysteresis, inside one another: the general engine follows more of them

# A state: compressions, their rates, and time.
C, R, T = 0, BOTH, 2 * BOTH
STATE = T + LANES
# The present state and that at the end of the step; without time, the state of a stage, its rates,
# and those of earlier stages.
Y, NEW = 0, STATE
NOW, OUT, K1, K3, K4, K5, K6, K7, K8, K9, K10, K11 = (2 * STATE + k * T for k in range(12))
# Slots for each contact: the base c^(p - 1) and then the force; the acceleration r' at both ends
# of the step; stiffness, 0 where it does not press; stiffness, p - 1, and a, b, d of its gain; the
# sign that its compression has while no event comes, and that of its watched gain; 1 if the step
# goes by it, and the weights by_r and by_a.
_EACH = 2 * STATE + 12 * T
F, ACC, ACC_NEW, PRESSING, STIFFNESS, POWER = (_EACH + k * BOTH for k in range(6))
A, B, D, SIGN, GAIN_SIGN, OWN, BY_R, BY_A = (_EACH + k * BOTH for k in range(6, 14))
# The root of a typical compression; intervals so far, first touch, last release; and what is found
# of a step: 1 if an event comes, or may come, in it, and 1 if one is expected in the next.
SCALE, COUNT, FIRST, LAST, DOUBT, SOON = (_EACH + k * BOTH for k in range(14, 20))
DT, NEXT, TAKEN = (_EACH + k * BOTH for k in range(20, 23))  # the same for both contacts
# a, b, d of the gain that is watched, and the compression that is.
END_A, END_B, END_D, LEVEL = (_EACH + k * BOTH for k in range(23, 27))
# Of a contact that creeps, see `pair_series`: the rates mu and nu of its surface, mu while it
# presses; the surface's compression, now and at the end of the step.
MU, NU, MU_NOW, S, S_NEW = (_EACH + k * BOTH for k in range(27, 32))
# Of hysteresis: M, 0 without; 1/C; the four numbers of the force; 1 on the way out, and the peak of
# that; how many cycles are remembered, and numbers to be raised to a power.
LOSS, OVER_PEAK, ADDED, KEPT, HELD, OFFSET = (_EACH + k * BOTH for k in range(32, 38))
OUTWARD, TOP, DEPTH, BASE, EXPONENT = (_EACH + k * BOTH for k in range(38, 43))
# A typical compression over the impact speed, and how near 0 a turn of the compression is not sure.
SPAN, WIDE = _EACH + 43 * BOTH, _EACH + 44 * BOTH
# The peaks and the turning points below them of the cycles that are remembered.
HIGHS, LOWS = _EACH + 45 * BOTH, _EACH + (45 + CYCLES) * BOTH
# Slots for each lane: 1/m1, 1/m2; the step in s, s where it begins, and the weights m, n, q; how
# the step goes; impact speed, row, status; 1 if `pairs` must decide how the lane goes on; steps so
# far; the allowed error over that of the step, and the factor for the next step; the last step by
# time.
_LANE = LOWS + CYCLES * BOTH
OVER_1, OVER_2, H, START, M, N, Q, MODE = (_LANE + k * LANES for k in range(8))
V0, ROW, STATUS, ASKS, STEPS, OVER_ERROR, GROW, BY_TIME = (_LANE + k * LANES for k in range(8, 16))
# The event that a step is to end at: its contact, its kind, and the time to it; the velocity by
# which an event may come too early or too late; gravity.
CONTACT, KIND, WAIT, UNSURE, GRAVITY = (_LANE + k * LANES for k in range(16, 21))
# How exactly a drop is solved: the error allowed in a step, over the impact speed; the largest
# estimate of order 3 with which the others can be trusted; of `pair_alone`, half the levels of a
# continued fraction, and how far derivatives lead, over c; and the most steps.
ALLOWED, COARSE, LEVELS, REACH, LIMIT = (_LANE + k * LANES for k in range(21, 26))
# 1 if some exponent is neither 1 nor 1.5; if some contact has hysteresis, a gain that changes, or
# one that is watched.
_ALL = _LANE + 26 * LANES
GENERAL, REMEMBERS, LOSES, WATCHES = (_ALL + k for k in range(4))
SLOTS = _ALL + 4

TIME, ROOT, EVENT = 0.0, 1.0, 2.0  # modes: by time, by a root from a touch on, up to an event

_HALVED = 1.5  # allowed errors: where so much is not sure, a step may have half of its error
_UNSURE = 3.0  # errors of the steps so far: an event that comes, or fails to, by less is not sure
AHEAD = 1.2  # steps: an event within this is aimed at
_TINY = 1e-150  # m/s: a step without an error is exact
ONWARD = 2.2  # the first step by time, over the time of the last one by a root

_TABLE = shipped_table("stackbounce.engine", "dormand_prince.toml")
_TO_2, _TO_3, _TO_4, _TO_5, _TO_6, _TO_7, _TO_8, _TO_9, _TO_10, _TO_11, _TO_12 = (
    tuple(stage) for stage in _TABLE["stages"]
)
_END, _THIRD, _FIFTH = (tuple(_TABLE[name]) for name in ("end", "third", "fifth"))


@kernel
def _find_rates(x: Floats, node: float, weight: float) -> None:
    """Compute dt/ds and the rates of the state in NOW, a part ``node`` of the step after its start.

    The rates are those of a whole step. The time at its end gets a part, ``weight``, of dt/ds.
    """
    if x[GENERAL] > 0.0:
        for i in range(BOTH):
            x[BASE + i], x[EXPONENT + i] = x[NOW + C + i], x[POWER + i]
        _find_powers(x)
    if x[GENERAL] + x[LOSES] > 0.0:
        for i in range(BOTH):
            c, p, a, b = x[NOW + C + i], x[POWER + i], x[A + i], x[B + i]
            base = math.sqrt(max(c, 0.0)) if p == 0.5 else x[BASE + i]
            gain = a + b * c + x[D + i] * x[NOW + R + i]
            x[F + i] = x[PRESSING + i] * (base if p > 0.0 else 1.0) * gain * (b + a * c)
    else:
        for i in range(BOTH):
            c = x[NOW + C + i]
            root = math.sqrt(max(c, 0.0))
            x[F + i] = x[PRESSING + i] * (root if x[POWER + i] > 0.0 else 1.0) * c
    if x[REMEMBERS] > 0.0:
        for i in range(BOTH):
            ratio, exponent = x[NOW + C + i] * x[OVER_PEAK + i], x[LOSS + i]
            x[BASE + i], x[EXPONENT + i] = ratio, exponent
        _find_powers(x)
        for i in range(BOTH):
            rest = x[BASE + i]
            force = x[F + i] * (x[ADDED + i] + x[KEPT + i] * rest)
            x[F + i] = force + x[HELD + i] * rest + x[OFFSET + i]
    for i in range(LANES):
        r0, r1 = x[NOW + R + i], x[NOW + R + LANES + i]
        floor, balls = x[F + i], x[F + LANES + i]
        a0 = (balls - floor) * x[OVER_1 + i]
        a1 = -a0 - balls * x[OVER_2 + i]
        a0 += x[GRAVITY + i]
        speed = x[Q + i] + x[BY_R + i] * r0 + x[BY_R + LANES + i] * r1
        speed += x[BY_A + i] * a0 + x[BY_A + LANES + i] * a1
        h = x[H + i]
        dt = h * (x[M + i] + 2.0 * x[N + i] * (x[START + i] + node * h)) / speed
        x[OUT + C + i], x[OUT + C + LANES + i] = dt * r0, dt * r1
        x[OUT + R + i], x[OUT + R + LANES + i] = dt * a0, dt * a1
        x[NEW + T + i] += weight * dt
        x[ACC_NEW + i], x[ACC_NEW + LANES + i] = a0, a1


@kernel
def _find_powers(x: Floats) -> None:
    """Raise all numbers in BASE to their EXPONENT.

    Other kernels call `exp` and `log`: these two become vector code only as long as nothing else
    calls them.
    """
    for i in range(BOTH):
        x[EXPONENT + i] *= swift_log(x[BASE + i])
    for i in range(BOTH):
        x[BASE + i] = swift_exp(x[EXPONENT + i])


@kernel
def _try_step(x: Floats) -> None:
    """Compute the state of each lane at the end of its step, and two estimates of the error.

    Those of orders 3 and 5, without signs, are left in K3 and K4.
    """
    for i in range(LANES):
        x[NEW + T + i] = x[Y + T + i]
    for i in range(T):
        x[NOW + i] = x[Y + i]
    _find_rates(x, 0.0, _END[0])
    for i in range(BOTH):
        x[ACC + i] = x[ACC_NEW + i]
    _next_stage(x, K1, _TO_2, (K1,), 0.05260015195876773, 0.0)
    _next_stage(x, K3, _TO_3, (K1, K3), 0.0789002279381516, 0.0)
    _next_stage(x, K3, _TO_4, (K1, K3), 0.1183503419072274, 0.0)
    _next_stage(x, K4, _TO_5, (K1, K3, K4), 0.2816496580927726, 0.0)
    _next_stage(x, K5, _TO_6, (K1, K4, K5), 0.3333333333333333, _END[1])
    _next_stage(x, K6, _TO_7, (K1, K4, K5, K6), 0.25, _END[2])
    _next_stage(x, K7, _TO_8, (K1, K4, K5, K6, K7), 0.3076923076923077, _END[3])
    _next_stage(x, K8, _TO_9, (K1, K4, K5, K6, K7, K8), 0.6512820512820513, _END[4])
    _next_stage(x, K9, _TO_10, (K1, K4, K5, K6, K7, K8, K9), 0.6, _END[5])
    _next_stage(x, K10, _TO_11, (K1, K4, K5, K6, K7, K8, K9, K10), 0.8571428571428571, _END[6])
    _next_stage(x, K11, _TO_12, (K1, K4, K5, K6, K7, K8, K9, K10, K11), 1.0, _END[7])
    for i in range(T):
        x[NEW + i] = x[Y + i] + _weighted(x, i, _END)
        third, fifth = _weighted(x, i, _THIRD), _weighted(x, i, _FIFTH)
        x[K3 + i], x[K4 + i] = abs(third), abs(fifth)


@kernel
def _next_stage(
    x: Floats, own: int, a: Sequence[float], earlier: Sequence[int], node: float, weight: float
) -> None:
    """Keep the rates of a stage in a slot, and find those of the next one from earlier ones."""
    for i in range(T):
        x[own + i] = x[OUT + i]
        way = a[0] * x[earlier[0] + i]
        for j in range(1, len(a)):
            way += a[j] * x[earlier[j] + i]
        x[NOW + i] = x[Y + i] + way
    _find_rates(x, node, weight)


@kernel
def _weighted(x: Floats, i: int, a: Sequence[float]) -> float:
    """Return a weighted sum of the rates of those stages that the end of the step depends on."""
    way = a[0] * x[K1 + i] + a[1] * x[K6 + i] + a[2] * x[K7 + i] + a[3] * x[K8 + i]
    return way + (a[4] * x[K9 + i] + a[5] * x[K10 + i] + a[6] * x[K11 + i] + a[7] * x[OUT + i])


@kernel
def step_by_runge_kutta(x: Floats) -> None:
    """Move each lane on, or try a shorter step next, or let `look_after` decide."""
    _try_step(x)
    _find_errors(x)
    _look_for_events(x)
    _go_on(x)


@kernel
def _find_errors(x: Floats) -> None:
    """Compare the error of each step with the allowed one (Hairer, Norsett and Wanner, eq. 10.17).

    The error is that of the rates and of the mean rates in the step. The square root in that
    equation is left out. Where the estimate of order 3 is large, none can be trusted: its limit
    counts as another error. The less sure the steps so far are, the smaller an error is allowed,
    since a long drop adds up many.
    """
    for i in range(LANES):
        dt, speed = x[NEW + T + i] - x[Y + T + i], x[V0 + i]
        per_time = 1.0 / dt
        third = (x[K3 + C + i] + x[K3 + C + LANES + i]) * per_time
        third += x[K3 + R + i] + x[K3 + R + LANES + i]
        fifth = (x[K4 + C + i] + x[K4 + C + LANES + i]) * per_time
        fifth += x[K4 + R + i] + x[K4 + R + LANES + i]
        unsure, most = x[UNSURE + i], speed * x[ALLOWED + i]
        allowed = most / (1.0 + unsure / (_HALVED * most))
        by_eighth = (fifth + 0.1 * third + _TINY) * allowed / (fifth * fifth + _TINY * _TINY)
        # squared: an error of order 3 grows as h^4
        by_third = x[COARSE + i] * speed / (third + _TINY)
        over = min(by_eighth, by_third * by_third) if dt > 0.0 and by_third > 1e-3 else 0.0
        over = min(max(over, 1e-6), 1e6)
        root = math.sqrt(math.sqrt(math.sqrt(over)))
        grow = min(max(0.86 * root, 0.2), 2.4)
        x[OVER_ERROR + i], x[GROW + i] = over, grow
        x[DT + i] = x[DT + LANES + i] = dt
        unsure += _UNSURE * allowed / by_eighth if over >= 1.0 else 0.0
        x[UNSURE + i] = unsure
        x[WIDE + i] = unsure * max(dt, x[SPAN + i])
        x[WIDE + LANES + i] = unsure * max(dt, x[SPAN + LANES + i])
        x[NEXT + i] = x[NEXT + LANES + i] = AHEAD * dt * grow


@kernel
def _look_for_events(x: Floats) -> None:
    """Find where an event comes, or may come, in the step, and where one is near after it.

    The compression is taken as the polynomial of degree 5, and the gain as that of degree 3, with
    the values and derivatives at both ends. Where its Bernstein coefficients have one sign, so has
    the polynomial. The first coefficient of the compression is left out: it is 0 after an event.
    A compression that turns must stay further from 0 than is not sure.
    """
    for i in range(BOTH):
        dt, sign, level, ahead = x[DT + i], x[SIGN + i], x[LEVEL + i], x[NEXT + i]
        c, r, acc = x[Y + C + i] - level, x[Y + R + i], x[ACC + i]
        c_new, r_new, acc_new = x[NEW + C + i] - level, x[NEW + R + i], x[ACC_NEW + i]
        fifth, bend = 0.2 * dt, 0.05 * dt * dt
        low = min(sign * (c + fifth * r), sign * (c + 2.0 * fifth * r + bend * acc))
        low = min(low, sign * (c_new - 2.0 * fifth * r_new + bend * acc_new))
        low = min(low, sign * (c_new - fifth * r_new))
        low = min(low, sign * c_new)
        near = x[WIDE + i] if r * r_new < 0.0 else 0.0
        x[DOUBT + i] = 1.0 - x[OWN + i] if low < near else 0.0
        low = sign * (c_new + ahead * (r_new + 0.5 * ahead * acc_new))
        x[SOON + i] = 1.0 if low < 0.0 else 0.0
    if x[WATCHES] > 0.0:
        for i in range(BOTH):
            a, b, d, sign = x[END_A + i], x[END_B + i], x[END_D + i], x[GAIN_SIGN + i]
            gain = a + b * x[Y + C + i] + d * x[Y + R + i]
            gain_new = a + b * x[NEW + C + i] + d * x[NEW + R + i]
            slope = b * x[Y + R + i] + d * x[ACC + i]
            slope_new = b * x[NEW + R + i] + d * x[ACC_NEW + i]
            third, doubt, soon = 0.3333333333333333 * x[DT + i], x[DOUBT + i], x[SOON + i]
            least = min(sign * (gain + third * slope), sign * (gain_new - third * slope_new))
            least = min(least, sign * gain_new)
            x[DOUBT + i] = 1.0 - x[OWN + i] if least < 0.0 else doubt
            x[SOON + i] = 1.0 if sign * (gain_new + x[NEXT + i] * slope_new) < 0.0 else soon


@kernel
def _go_on(x: Floats) -> None:
    """Take the steps that are exact enough and meet no event, and choose the next step.

    After a step by a root from a touch on, the next is one by time.
    """
    for i in range(LANES):
        exact = 1.0 if x[OVER_ERROR + i] >= 1.0 else 0.0
        mode, grow = x[MODE + i], x[GROW + i]
        clear = 1.0 if x[DOUBT + i] + x[DOUBT + LANES + i] == 0.0 else 0.0
        meets = exact * (1.0 - clear) + (1.0 if mode == EVENT else 0.0)
        asks = meets + exact * (x[SOON + i] + x[SOON + LANES + i])
        asks += 1.0 if x[STEPS + i] > x[LIMIT + i] else 0.0
        alone = 1.0 if meets == 0.0 else 0.0
        taken = alone * exact  # but those up to an event
        turns = taken * mode  # 1 where a step by a root is taken
        stays = 1.0 - turns
        h = x[H + i] * (1.0 + alone * (grow - 1.0))
        first = ONWARD * x[DT + i] * min(grow, 1.0)
        h = first if turns > 0.0 else h
        by_time = x[BY_TIME + i]
        x[H + i] = h
        x[BY_TIME + i] = h if taken > 0.0 else by_time
        x[MODE + i] = mode * stays
        x[START + i] *= stays
        x[N + i] *= stays
        x[M + i] = x[M + i] * stays + turns
        x[Q + i] = x[Q + i] * stays + turns
        x[OWN + i] *= 1.0 - taken
        x[OWN + LANES + i] *= 1.0 - taken
        x[BY_R + i] *= stays
        x[BY_R + LANES + i] *= stays
        x[STEPS + i] += 1.0
        x[ASKS + i] = asks
        x[TAKEN + i] = x[TAKEN + LANES + i] = exact * clear
    take_steps(x)


@kernel
def take_steps(x: Floats) -> None:
    """Let the state at the end of a step be the present one of the lanes that are in TAKEN.

    An open contact that is not compressed any more waits for a touch.
    """
    for i in range(BOTH):
        c, c_new, r, r_new = x[Y + C + i], x[NEW + C + i], x[Y + R + i], x[NEW + R + i]
        x[Y + C + i] = c_new if x[TAKEN + i] > 0.0 else c
        x[Y + R + i] = r_new if x[TAKEN + i] > 0.0 else r
    if x[WATCHES] > 0.0:
        for i in range(BOTH):
            c, sign, level = x[Y + C + i], x[GAIN_SIGN + i], x[LEVEL + i]
            away = x[PRESSING + i] == 0.0 and c <= 0.0
            x[GAIN_SIGN + i] = 0.0 if away else sign
            x[LEVEL + i] = 0.0 if away else level
    for i in range(LANES):
        t, t_new = x[Y + T + i], x[NEW + T + i]
        x[Y + T + i] = t_new if x[TAKEN + i] > 0.0 else t
