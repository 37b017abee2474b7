"""One step of many drops of two balls on springs (eqs 5 and 6) at the same time, in lock step.

Every drop has a lane in one flat array: slot ``N`` of lane i is ``x[N + i]``. All lanes step at the
same time. A step has no branches and consists of short loops, which a compiler vectorises and a
processor, which looks some 200 instructions ahead, executes several rounds of at once. Lanes do not
affect each other.

In units of the lower ball's mass m1, of 1/omega = sqrt(m1/k1) and of the impact speed, with
mu = m2/m1 and kappa = k2/k1, and in the coordinates w0 = q0, w1 = sqrt(mu) q1, eqs 5 and 6 read
w'' = -K w, with another K in each of four regimes. A rotation by (c, s) gives two modes with the
frequencies a and b:

============ ========= ========= ==================================================================
regime       floor     balls     modes
============ ========= ========= ==================================================================
both         pressed   pressed   those of eqs 5 and 6
balls only   open      pressed   the two balls against each other, and their centre in flight
floor only   pressed   open      the lower ball on the floor, and the upper ball in flight
none         open      open      both balls in flight
============ ========= ========= ==================================================================

A mode y'' = -a^2 y moves as y cos(a t) + y' t sinc(a t); in flight a is 0.

A step ends either before any contact can have changed its phase, or exactly at the first change.
If round-off hides whether a contact changes its phase, the lane ends with the status ASK, and the
general engine solves that drop.
"""

import math

from stackbounce.engine.codes import ASK, EVENT_LIMIT, FINISHED
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.trigonometry import cosine, half_turns, nudge_mode, sinc

LANES = 32  # a power of two

# The slots of a drop, first those with a value of its own at the start: position and velocity of
# the upper ball, 1 if the balls' contact presses, status, row; 1/sqrt(mu); with both contacts
# pressed c, s, a, b, the modes' weights in the compression of the balls' contact, 1/a and 1/b; the
# same for the balls only, where b is 0; the units of time and speed.
W1, U1, BALLS, STATUS, ROW = (k * LANES for k in range(5))
SLIM, C2, S2, A2, B2, V2, X2, OVER_A2, OVER_B2 = (k * LANES for k in range(5, 14))
C1, S1, A1, V1, OVER_A1, UNIT, V0 = (k * LANES for k in range(14, 21))
OWN = 21  # slots with a value of their own
# Slots that start alike: position and velocity of the lower ball, time, 1 if the floor's contact
# presses; steps taken, intervals of each contact, first touch of the balls, last releases, and 1 if
# the last step was in vain.
W0, U0, TIME, FLOOR = (k * LANES for k in range(21, 25))
ROUNDS, N0, N1, FIRST, LAST0, LAST1, VAIN = (k * LANES for k in range(25, 32))

# The slots of a step: the rotation of the present regime, the range of a series, and that of a
# series of the slower mode alone. For the contact that may end the step: the modes' weights in it,
# a bound of its third derivative over 2, 1 if it is the floor's, 1 if an event is expected, the
# time from the safe time to the event, how much longer the other contact is safe, and the distance
# from the event with its first derivative and half its second. Then 1 if in doubt, 1 if the event
# is reached, and 1 for the contact that changes.
C, S, REACH, LONG = (k * LANES for k in range(32, 36))
SEES_A, SEES_B, BEND, LOWER, EXPECTED, PAST, SPARE = (k * LANES for k in range(36, 43))
F, G, H, DOUBT, LANDS, FLOOR_TURNS, BALLS_TURN = (k * LANES for k in range(43, 50))
# Double slots, mode a in the first half and mode b in the second: frequency, its inverse or 0,
# position, velocity, the step, and a short step to the event; the step's angle without half turns,
# their sign, cosine and (sin x)/x.
OMEGA, OVER, Y, Z, STEP, D = (k * LANES for k in range(50, 62, 2))
ANGLE, SIGN, COS, SINC = (k * LANES for k in range(62, 70, 2))
# Double slots, the floor's contact and the balls': the series of its distance from the event (a
# compression or a gap), the range of that series, bounds of the third derivative over 2 and of the
# sixth over 6!, the modes' parts of the distance and of the rate, their weights, and the safe time.
# In the first three rows, the first half then holds the numbers of the contact that may end the
# step.
P0, P1, P2, P3, P4, P5, VALID, THIRD, TAIL = (k * LANES for k in range(70, 88, 2))
GA, GB, HA, HB, FA, FB, SAFE = (k * LANES for k in range(88, 102, 2))
OTHER = LANES  # the second half of a double slot
SLOTS = 102

WIDEST = 2.5  # rad: the range of series of order 5
_FAST = 64.0  # rad: the longest step of the faster mode
_SLOW = 1e-5  # of the impact speed: slower events are left to the general engine
_CLOSE = 1e-10  # of v0/omega: so are events that are missed by less
_NOISE = 1e-13  # of the impact speed: slower relative motion counts as none
_NEAR = 0.01  # rad, and relative: keeps the error of a landing below 1e-16
_ROUNDS = 200.0  # steps; longer runs accumulate round-off
_NEVER = 1e300  # 1/omega


@kernel
def advance_lanes(x: Floats, event_limit: float) -> None:
    """Move each lane on, at most to its next event, and apply that event."""
    _find_modes(x)
    _differentiate(x, 0)
    _differentiate(x, OTHER)
    _find_safe_times(x)
    _choose_contact(x)
    _evaluate_series(x)
    _choose_steps(x)
    _move_modes(x)
    _find_landing(x)
    _evaluate_series(x)
    _land(x)
    _apply_events(x, event_limit)


@kernel
def _find_modes(x: Floats) -> None:
    """Compute each lane's modes (eqs 5 and 6), and each contact's distance from its next event.

    The distance is the compression of a pressed contact and the gap of an open one. It is 0 at the
    event.
    """
    for i in range(LANES):
        floor, balls = x[FLOOR + i], x[BALLS + i]
        both = floor * balls
        only, apart = balls - both, 1.0 - balls
        w0, w1, u0, u1, slim = x[W0 + i], x[W1 + i], x[U0 + i], x[U1 + i], x[SLIM + i]
        # sums: a choice between two slots would be compiled to a slow choice between addresses
        c = both * x[C2 + i] + only * x[C1 + i] + apart
        s = both * x[S2 + i] + only * x[S1 + i]
        a = both * x[A2 + i] + only * x[A1 + i] + (floor - both)
        over_a = both * x[OVER_A2 + i] + only * x[OVER_A1 + i] + (floor - both)
        b, over_b = both * x[B2 + i], both * x[OVER_B2 + i]
        v, o = both * x[V2 + i] + only * x[V1 + i] + apart, both * x[X2 + i] - apart * slim
        reach = WIDEST * over_a + _NEVER * (apart * (1.0 - floor))
        long = min(_FAST * over_a, WIDEST * over_b)
        ya, yb, za, zb = c * w0 + s * w1, c * w1 - s * w0, c * u0 + s * u1, c * u1 - s * u0
        x[C + i], x[S + i] = c, s
        x[OMEGA + i], x[OVER + i], x[Y + i], x[Z + i] = a, over_a, ya, za
        x[OMEGA + OTHER + i], x[OVER + OTHER + i] = b, over_b
        x[Y + OTHER + i], x[Z + OTHER + i] = yb, zb
        x[REACH + i], x[LONG + i] = reach, long
        # the floor's contact: pressed by -q0
        sign = 1.0 - 2.0 * floor
        fa, fb = sign * c, -sign * s
        x[P0 + i], x[P1 + i], x[FA + i], x[FB + i] = sign * w0, sign * u0, fa, fb
        x[GA + i], x[GB + i], x[HA + i], x[HB + i] = fa * ya, fb * yb, fa * za, fb * zb
        # the balls' contact: pressed by q0 - q1
        sign = 2.0 * balls - 1.0
        fa, fb, rate = sign * v, sign * o, sign * (u0 - u1 * slim)
        x[P0 + OTHER + i] = sign * (w0 - w1 * slim)
        x[P1 + OTHER + i] = rate if abs(rate) > _NOISE else 0.0
        x[FA + OTHER + i], x[FB + OTHER + i] = fa, fb
        x[GA + OTHER + i], x[GB + OTHER + i] = fa * ya, fb * yb
        x[HA + OTHER + i], x[HB + OTHER + i] = fa * za, fb * zb


@kernel
def _differentiate(x: Floats, half: int) -> None:
    """Expand each contact's distance from its event in time, with a bound on the remainder.

    A lower bound on the distance is the contribution of the slow mode b minus the amplitude of the
    fast mode a. If this bound stays positive for a long time, its series replaces that of the
    distance, because it is valid for longer.
    """
    for n in range(LANES):
        i = half + n
        ga, gb, ha, hb, p0, p1 = x[GA + i], x[GB + i], x[HA + i], x[HB + i], x[P0 + i], x[P1 + i]
        a, b, reach, long = x[OMEGA + n], x[OMEGA + OTHER + n], x[REACH + n], x[LONG + n]
        # an upper bound of sqrt(u^2 + v^2), the amplitude of mode a
        u, v = abs(ga), x[OVER + n] * abs(ha)
        taken = max(u, v) + 0.4142136 * min(u, v)
        ra, rb = a * (a * taken), b * (b * abs(gb) + abs(hb))
        x[THIRD + i] = (a * ra + b * rb) * 0.5
        slow = gb - taken + reach * min(0.0, hb - 0.5 * reach * rb)
        slow = slow if reach < long else 0.0
        stands = 1.0 if slow > _CLOSE else 0.0
        keeps = 1.0 - stands
        x[P0 + i], x[P1 + i] = keeps * p0 + stands * (gb - taken), keeps * p1 + stands * hb
        x[VALID + i] = keeps * reach + stands * long
        ga, ha, ra = keeps * ga, keeps * ha, keeps * ra
        aa, bb = -a * a, -b * b
        x[P2 + i], x[P3 + i] = (aa * ga + bb * gb) * (1.0 / 2.0), (aa * ha + bb * hb) * (1.0 / 6.0)
        aa, bb = aa * aa, bb * bb
        x[P4 + i] = (aa * ga + bb * gb) * (1.0 / 24.0)
        x[P5 + i] = (aa * ha + bb * hb) * (1.0 / 120.0)
        x[TAIL + i] = (aa * ra + bb * rb) * (1.0 / 720.0)


@kernel
def _find_safe_times(x: Floats) -> None:
    """Find for each contact a time before which it cannot change its phase.

    The distance p(t) from the event is known to order 5, with a bound on the remainder. Horner's
    nested lower bounds, as in `series.safe_step`, end with a parabola here: p is positive before
    its root.
    """
    for i in range(2 * LANES):
        p0, p1, p2, p3, p4, p5 = x[P0 + i], x[P1 + i], x[P2 + i], x[P3 + i], x[P4 + i], x[P5 + i]
        tail, reach = x[TAIL + i], x[VALID + i]
        # zero gap: p0 = p1 = p2 = 0, and a parabola is below a cubic for a short time only
        s = reach if p0 > _CLOSE or p1 != 0.0 else 0.5 * reach
        h = p5 - tail * s
        h = p4 + min(0.0, h) * s
        h = p3 + min(0.0, h) * s
        h = p2 + min(0.0, h) * s
        x[SAFE + i] = time_above(p0 - _CLOSE if p0 > _CLOSE else 0.0, p1, h, s)


@kernel
def time_above(p0: float, p1: float, h: float, longest: float) -> float:
    """Return the time until p0 + p1 t + h t^2, with p0 at least 0, becomes negative, or less."""
    square = p1 * p1 - 4.0 * h * p0
    q = abs(p1) + math.sqrt(max(0.0, square))
    over = 2.0 * p0 if p1 < 0.0 else q
    under = (q if square >= 0.0 else 0.0) if p1 < 0.0 else -2.0 * h
    root = over / (under if under > 0.0 else 1.0)
    root = root if under > 0.0 else longest
    return min(longest, root)


@kernel
def _choose_contact(x: Floats) -> None:
    """Choose the contact with the shorter safe time, at the end of that time."""
    for i in range(LANES):
        one, other = x[SAFE + i], x[SAFE + OTHER + i]
        lower = 1.0 if one <= other else 0.0
        upper = 1.0 - lower
        x[LOWER + i], x[D + i], x[SPARE + i] = lower, min(one, other), max(one, other)
        x[P0 + i] = lower * x[P0 + i] + upper * x[P0 + OTHER + i]
        x[P1 + i] = lower * x[P1 + i] + upper * x[P1 + OTHER + i]
        x[P2 + i] = lower * x[P2 + i] + upper * x[P2 + OTHER + i]
        x[P3 + i] = lower * x[P3 + i] + upper * x[P3 + OTHER + i]
        x[P4 + i] = lower * x[P4 + i] + upper * x[P4 + OTHER + i]
        x[P5 + i] = lower * x[P5 + i] + upper * x[P5 + OTHER + i]
        x[VALID + i] = lower * x[VALID + i] + upper * x[VALID + OTHER + i]
        x[BEND + i] = lower * x[THIRD + i] + upper * x[THIRD + OTHER + i]
        x[SEES_A + i] = lower * x[FA + i] + upper * x[FA + OTHER + i]
        x[SEES_B + i] = lower * x[FB + i] + upper * x[FB + OTHER + i]


@kernel
def _evaluate_series(x: Floats) -> None:
    """Evaluate the series of the chosen contact after the short step."""
    for i in range(LANES):
        p0, p1, p2, p3, p4, p5 = x[P0 + i], x[P1 + i], x[P2 + i], x[P3 + i], x[P4 + i], x[P5 + i]
        d = x[D + i]
        x[F + i] = p0 + d * (p1 + d * (p2 + d * (p3 + d * (p4 + d * p5))))
        x[G + i] = p1 + d * (2.0 * p2 + d * (3.0 * p3 + d * (4.0 * p4 + d * (5.0 * p5))))
        x[H + i] = p2 + d * (3.0 * p3 + d * (6.0 * p4 + d * (10.0 * p5)))


@kernel
def _choose_steps(x: Floats) -> None:
    """Choose each lane's step: to the predicted event, or else to the end of the safe time."""
    for i in range(LANES):
        f, g, h = x[F + i], x[G + i], x[H + i]
        safe, limit, p0, reach = x[D + i], x[SPARE + i], x[P0 + i], x[VALID + i]
        d = _halley(f, g, h)
        t = safe + d
        expected = 1.0 if g < -_SLOW and (d >= 0.0 or p0 <= _CLOSE) else 0.0
        expected = expected if t <= limit and t <= reach and abs(d) <= 0.1 * reach else 0.0
        expected = expected if reach <= x[REACH + i] else 0.0
        expected = expected * (1.0 - x[VAIN + i])
        step = safe + expected * d
        x[STEP + i], x[STEP + OTHER + i] = step, step
        x[EXPECTED + i], x[PAST + i], x[SPARE + i] = expected, d, limit - t
        x[DOUBT + i] = 1.0 - expected if step <= 0.0 else 0.0


@kernel
def _halley(f: float, g: float, h: float) -> float:
    """Return Halley's step d, to second order, to the zero of a falling f + g d + h d^2.

    If the slope g is not negative enough, the step is meaningless; the caller ignores it.
    """
    inverse = 1.0 / (g if g < -_SLOW else -1.0)
    d = -f * inverse
    return d * (1.0 - d * h * inverse)


@kernel
def _move_modes(x: Floats) -> None:
    """Move each mode on by its step."""
    for i in range(2 * LANES):
        x[SIGN + i], x[ANGLE + i] = half_turns(x[OMEGA + i] * x[STEP + i])
    for i in range(2 * LANES):
        x[COS + i] = cosine(x[ANGLE + i] * x[ANGLE + i])
    for i in range(2 * LANES):
        x[SINC + i] = sinc(x[ANGLE + i] * x[ANGLE + i])
    for i in range(2 * LANES):
        omega, over, step, y, z = x[OMEGA + i], x[OVER + i], x[STEP + i], x[Y + i], x[Z + i]
        cos, sin = x[SIGN + i] * x[COS + i], x[SIGN + i] * (x[ANGLE + i] * x[SINC + i])
        travel = sin * over if over > 0.0 else step
        x[Y + i], x[Z + i] = y * cos + z * travel, z * cos - omega * (y * sin)


@kernel
def _find_landing(x: Floats) -> None:
    """Compute a Newton correction from the predicted to the exact time of the event.

    A lane whose correction is not small is marked as not landing.
    """
    for i in range(LANES):
        a, ya, za = x[OMEGA + i], x[Y + i], x[Z + i]
        b, yb, zb = x[OMEGA + OTHER + i], x[Y + OTHER + i], x[Z + OTHER + i]
        sees_a, sees_b = x[SEES_A + i], x[SEES_B + i]
        aa, bb = -a * a, -b * b
        fa, fb, ga, gb = sees_a * ya, sees_b * yb, sees_a * za, sees_b * zb
        x[P0 + i], x[P1 + i] = fa + fb, ga + gb
        fa, fb, ga, gb = aa * fa, bb * fb, aa * ga, bb * gb
        x[P2 + i], x[P3 + i] = (fa + fb) * (1.0 / 2.0), (ga + gb) * (1.0 / 6.0)
        x[P4 + i] = (aa * fa + bb * fb) * (1.0 / 24.0)
        x[P5 + i] = (aa * ga + bb * gb) * (1.0 / 120.0)
    for i in range(LANES):
        p0, p1, p2 = x[P0 + i], x[P1 + i], x[P2 + i]
        inverse = 1.0 / (p1 if p1 <= -_SLOW else -1.0)
        newton = -p0 * inverse
        bent = newton * p2 * inverse
        lands = x[EXPECTED + i] if p1 <= -_SLOW and abs(bent) <= _NEAR else 0.0
        x[LANDS + i] = lands if x[OMEGA + i] * abs(newton) <= _NEAR else 0.0
        x[D + i] = newton * (1.0 - bent)


@kernel
def _land(x: Floats) -> None:
    """Move each lane with a predicted event to its exact time; compute the balls' coordinates.

    The root is accepted as the first event under two conditions. The distance decreases
    monotonically from the end of the safe time to the root, as its derivatives at the root show,
    and the other contact is safe until then. Otherwise the step is rejected: the lane keeps its old
    state, and its next step goes to the end of the safe time.
    """
    for i in range(LANES):
        f, g, h, d = x[F + i], x[G + i], x[H + i], x[D + i]
        d = d + _halley(f, g, h)
        past, bend = abs(x[PAST + i]) + abs(d), x[BEND + i]
        lands = x[LANDS + i] if d <= x[SPARE + i] else 0.0
        lands = lands if (2.0 * abs(h) + bend * past) * past <= -0.9 * g else 0.0
        x[LANDS + i], x[D + i], x[D + OTHER + i] = lands, lands * d, lands * d
    for i in range(2 * LANES):
        x[Y + i], x[Z + i] = nudge_mode(x[OMEGA + i], x[D + i], x[Y + i], x[Z + i])
    for i in range(LANES):
        ya, za, yb, zb = x[Y + i], x[Z + i], x[Y + OTHER + i], x[Z + OTHER + i]
        c, s, lands, lower = x[C + i], x[S + i], x[LANDS + i], x[LOWER + i]
        stays = x[EXPECTED + i] - lands
        moves = 1.0 - stays
        x[W0 + i] = moves * (c * ya - s * yb) + stays * x[W0 + i]
        x[W1 + i] = moves * (s * ya + c * yb) + stays * x[W1 + i]
        x[U0 + i] = moves * (c * za - s * zb) + stays * x[U0 + i]
        x[U1 + i] = moves * (s * za + c * zb) + stays * x[U1 + i]
        x[TIME + i] = x[TIME + i] + moves * (x[STEP + i] + x[D + i])
        x[VAIN + i] = stays
        x[FLOOR_TURNS + i], x[BALLS_TURN + i] = lands * lower, lands * (1.0 - lower)


@kernel
def _apply_events(x: Floats, event_limit: float) -> None:
    """Let contacts touch and release, and set the status of drops that have ended."""
    for i in range(LANES):
        floor, balls, now = x[FLOOR + i], x[BALLS + i], x[TIME + i]
        lower, upper = x[FLOOR_TURNS + i], x[BALLS_TURN + i]
        touch, n1, first = upper * (1.0 - balls), x[N1 + i], x[FIRST + i]
        new = touch if n1 == 0.0 else 0.0
        n0, n1 = x[N0 + i] + lower * (1.0 - floor), n1 + touch
        x[N0 + i], x[N1 + i], x[FIRST + i] = n0, n1, first + new * now
        release0, release1 = lower * floor, upper * balls
        x[LAST0 + i] = (1.0 - release0) * x[LAST0 + i] + release0 * now
        x[LAST1 + i] = (1.0 - release1) * x[LAST1 + i] + release1 * now
        floor, balls = abs(floor - lower), abs(balls - upper)
        x[FLOOR + i], x[BALLS + i] = floor, balls
        pressed, rounds = floor + balls, x[ROUNDS + i] + 1.0
        x[ROUNDS + i] = rounds
        u0, u1, doubt = x[U0 + i], x[U1 + i] * x[SLIM + i], x[DOUBT + i]
        parting = min(u1 - u0, u0)  # the slower one of the two contacts
        result = EVENT_LIMIT if 2.0 * (n0 + n1) - pressed >= event_limit else 0.0
        result = ASK if doubt > 0.0 or rounds >= _ROUNDS else result
        result = ASK if pressed == 0.0 and parting > -_SLOW else result
        x[STATUS + i] = FINISHED if pressed == 0.0 and parting >= _SLOW else result
