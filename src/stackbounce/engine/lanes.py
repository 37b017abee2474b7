"""One look at each of many drops of two balls on springs (eqs 5 and 6), in lock step.

Every drop has a lane in one flat array: slot ``N`` of lane i is ``x[N + i]``. All lanes take a look
at the same time, and what a look does is written without branches, in loops so short that a
compiler makes vectors of them and a processor works on several rounds at once. Lanes never see each
other.

In units of the lower ball's mass m1, of 1/omega = sqrt(m1/k1) and of the impact speed, with
mu = m2/m1 and kappa = k2/k1, and in the coordinates w0 = q0, w1 = sqrt(mu) q1, eqs 5 and 6 read
w'' = -K w, with another K in each of four regimes. A rotation by (c, s) gives two modes of the
frequencies a and b:

============ ========= ========= ==================================================================
regime       floor     balls     modes
============ ========= ========= ==================================================================
both         pressed   pressed   those of eqs 5 and 6
balls only   open      pressed   the two balls against each other, and their centre in flight
floor only   pressed   open      the lower ball on the floor, and the upper ball in flight
none         open      open      both balls in flight
============ ========= ========= ==================================================================

A mode y'' = -a^2 y moves as y cos(a t) + y' t sinc(a t), in flight too: there a is 0.

A look goes as far as no contact can have changed its phase, or right onto the first change. Where a
change is not clear of round-off the lane ends with the status ASK: the general engine has a rule
for everything.
"""

import math

from stackbounce.engine.codes import ASK, EVENT_LIMIT, FINISHED
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.waves import WIDEST, cosine, sinc

LANES = 32

# The slots of a drop. Its state: positions, velocities, time, and which contacts press (1 or 0).
W0, W1, U0, U1, TIME, FLOOR, BALLS = (k * LANES for k in range(7))
# Its story: how it ended, looks, events, intervals of each contact, the balls' first touch, last
# releases. And which row it is.
STATUS, LOOKS, EVENTS, N0, N1, FIRST, LAST0, LAST1, ROW = (k * LANES for k in range(7, 16))
# 1/sqrt(mu); with both contacts pressed c, s, a, b, what the balls' contact sees of the modes, and
# the longest look; the same for the balls only.
SLIM, C2, S2, A2, B2, V2, X2, REACH2 = (k * LANES for k in range(16, 24))
C1, S1, A1, V1, REACH1 = (k * LANES for k in range(24, 29))
DROP = 29  # so many

# The slots of a look: the rotation of the present regime; what the contact that ends the look sees
# of the modes; whether (1 or 0) it is the floor's, whether it changes its phase, any doubt, and
# which contact has changed.
C, S, SEES_A, SEES_B, LOWER, CHANGES, DOUBT = (k * LANES for k in range(29, 36))
FLOOR_TURNS, BALLS_TURN = 36 * LANES, 37 * LANES
# Double slots, of mode a in the first half and of mode b in the second: frequency, position,
# velocity, and the step.
OMEGA, Y, Z, STEP = (k * LANES for k in range(38, 46, 2))
# Double slots, of the floor's contact and of the balls': how far it is from an event (a compression
# or a gap) as a series, bounds of the third derivative over 2 and of the sixth over 6!, the shares
# of the modes in distance and rate, a, b, the longest look, what it sees of the modes, and how long
# nothing happens.
P0, P1, P2, P3, P4, P5, THIRD, TAIL, GA, GB, HA, HB = (k * LANES for k in range(46, 70, 2))
A, B, REACH, FA, FB, SAFE = (k * LANES for k in range(70, 82, 2))
OTHER = LANES  # the second half of a double slot
SLOTS = 82

_SLOW = 1e-5  # of the impact speed: whether anything so slow happens is left to the general engine
_CLOSE = 1e-10  # of v0/omega: so is what comes so close to happening
_NOISE = 1e-13  # of the impact speed: balls that move together
_LANDED = 1e-11  # what keeps the error of Halley's step below 1e-16
_LOOKS = 200.0  # longer stories gather round-off
_NEVER = 1e300


@kernel
def look(x: Floats, lanes: int, event_limit: float) -> None:
    """Move each lane on, at most to its next event, and let that happen."""
    _expand(x, lanes)
    _differentiate(x, lanes)
    _watch(x, lanes)
    _aim(x, lanes)
    _swing(x, lanes)
    _land(x, lanes)
    _happen(x, lanes, event_limit)


@kernel
def _expand(x: Floats, lanes: int) -> None:
    """Find each lane's modes (eqs 5 and 6), and what each contact sees of them.

    A slot of a contact holds how far it is from its next event: a pressed one its compression, an
    open one its gap.
    """
    for i in range(lanes):
        floor, balls = x[FLOOR + i] > 0.0, x[BALLS + i] > 0.0
        c2, s2, a2, b2, v2 = x[C2 + i], x[S2 + i], x[A2 + i], x[B2 + i], x[V2 + i]
        c1, s1, a1, v1 = x[C1 + i], x[S1 + i], x[A1 + i], x[V1 + i]
        x2, reach2, reach1, slim = x[X2 + i], x[REACH2 + i], x[REACH1 + i], x[SLIM + i]
        w0, w1, u0, u1 = x[W0 + i], x[W1 + i], x[U0 + i], x[U1 + i]
        c = (c2 if floor else c1) if balls else 1.0
        s = (s2 if floor else s1) if balls else 0.0
        a = (a2 if floor else a1) if balls else (1.0 if floor else 0.0)
        b = b2 if floor and balls else 0.0
        v = (v2 if floor else v1) if balls else 1.0
        o = (x2 if floor else 0.0) if balls else -slim
        reach = (reach2 if floor else reach1) if balls else (WIDEST if floor else _NEVER)
        ya, yb, za, zb = c * w0 + s * w1, c * w1 - s * w0, c * u0 + s * u1, c * u1 - s * u0
        x[C + i], x[S + i] = c, s
        x[OMEGA + i], x[Y + i], x[Z + i] = a, ya, za
        x[OMEGA + OTHER + i], x[Y + OTHER + i], x[Z + OTHER + i] = b, yb, zb
        x[A + i], x[B + i], x[REACH + i] = a, b, reach
        x[A + OTHER + i], x[B + OTHER + i], x[REACH + OTHER + i] = a, b, reach
        # the floor's contact: pressed by -q0
        sign = -1.0 if floor else 1.0
        fa, fb = sign * c, -sign * s
        x[P0 + i], x[P1 + i], x[FA + i], x[FB + i] = sign * w0, sign * u0, fa, fb
        x[GA + i], x[GB + i], x[HA + i], x[HB + i] = fa * ya, fb * yb, fa * za, fb * zb
        # the balls' contact: pressed by q0 - q1
        sign = 1.0 if balls else -1.0
        fa, fb, rate = sign * v, sign * o, sign * (u0 - u1 * slim)
        x[P0 + OTHER + i] = sign * (w0 - w1 * slim)
        x[P1 + OTHER + i] = rate if abs(rate) > _NOISE else 0.0
        x[FA + OTHER + i], x[FB + OTHER + i] = fa, fb
        x[GA + OTHER + i], x[GB + OTHER + i] = fa * ya, fb * yb
        x[HA + OTHER + i], x[HB + OTHER + i] = fa * za, fb * zb


@kernel
def _differentiate(x: Floats, lanes: int) -> None:
    """Find for each contact the series of its distance from an event, and a bound of the rest."""
    for i in range(OTHER + lanes):
        ga, gb, ha, hb, a, b = x[GA + i], x[GB + i], x[HA + i], x[HB + i], x[A + i], x[B + i]
        aa, bb = -a * a, -b * b
        x[P2 + i], x[P3 + i] = (aa * ga + bb * gb) * (1.0 / 2.0), (aa * ha + bb * hb) * (1.0 / 6.0)
        ra, rb = a * (a * abs(ga) + abs(ha)), b * (b * abs(gb) + abs(hb))
        x[THIRD + i] = (a * ra + b * rb) * 0.5
        aa, bb = aa * aa, bb * bb
        x[P4 + i] = (aa * ga + bb * gb) * (1.0 / 24.0)
        x[P5 + i] = (aa * ha + bb * hb) * (1.0 / 120.0)
        x[TAIL + i] = (aa * ra + bb * rb) * (1.0 / 720.0)


@kernel
def _watch(x: Floats, lanes: int) -> None:
    """Find for each contact a time before which it surely keeps its phase.

    Its distance p(t) from the event is known to order 5, with a bound of the rest. Horner's nested
    lower bounds, as in `series.safe_step`, go down to a parabola here: p is positive before its
    root.
    """
    for i in range(OTHER + lanes):
        p0, p1, p2, p3, p4, p5 = x[P0 + i], x[P1 + i], x[P2 + i], x[P3 + i], x[P4 + i], x[P5 + i]
        tail, reach = x[TAIL + i], x[REACH + i]
        # zero gap: p0 = p1 = p2 = 0, and no parabola but a short one is below a cubic
        s = reach if p0 > _CLOSE or p1 != 0.0 else 0.5 * reach
        h = p5 - tail * s
        h = p4 + min(0.0, h) * s
        h = p3 + min(0.0, h) * s
        h = p2 + min(0.0, h) * s
        start = p0 - _CLOSE if p0 > _CLOSE else 0.0
        square = p1 * p1 - 4.0 * h * start
        q = abs(p1) + math.sqrt(max(0.0, square))
        over = 2.0 * start if p1 < 0.0 else q
        under = (q if square >= 0.0 else 0.0) if p1 < 0.0 else -2.0 * h
        root = over / (under if under > 0.0 else 1.0)
        root = root if under > 0.0 else s
        x[SAFE + i] = min(s, root)


@kernel
def _aim(x: Floats, lanes: int) -> None:
    """Find each lane's step: to its first event if this is known, or as far as there is none.

    If the distance of the contact that is the first in danger falls all the way from now to a root
    of its series, this is its event; and the first one if the other contact is safe until then.
    """
    for i in range(lanes):
        one, other = x[SAFE + i], x[SAFE + OTHER + i]
        lower = 1.0 if one <= other else 0.0
        upper = 1.0 - lower
        # sums, as a choice between two slots would be compiled to a slow one between addresses
        p0, p1 = lower * x[P0 + i], lower * x[P1 + i]
        p2, p3 = lower * x[P2 + i], lower * x[P3 + i]
        p4, p5 = lower * x[P4 + i], lower * x[P5 + i]
        p0, p1 = p0 + upper * x[P0 + OTHER + i], p1 + upper * x[P1 + OTHER + i]
        p2, p3 = p2 + upper * x[P2 + OTHER + i], p3 + upper * x[P3 + OTHER + i]
        p4, p5 = p4 + upper * x[P4 + OTHER + i], p5 + upper * x[P5 + OTHER + i]
        third, reach = lower * x[THIRD + i] + upper * x[THIRD + OTHER + i], x[REACH + i]
        safe, limit = min(one, other), max(one, other)
        t = safe
        f = p0 + t * (p1 + t * (p2 + t * (p3 + t * (p4 + t * p5))))
        g = p1 + t * (2.0 * p2 + t * (3.0 * p3 + t * (4.0 * p4 + t * (5.0 * p5))))
        h = p2 + t * (3.0 * p3 + t * (6.0 * p4 + t * (10.0 * p5)))
        # Halley's step, to second order
        inverse = 1.0 / (g if g < 0.0 else -1.0)
        d = f * inverse
        d = d * (1.0 + d * h * inverse)
        t = t - d
        far = abs(t)
        changes = 1.0 if p1 < -_SLOW else 0.0
        changes = changes if (2.0 * abs(p2) + third * far) * far < -0.9 * p1 else 0.0
        changes = changes if t <= limit and far <= reach else 0.0
        changes = changes if abs(d) <= 0.1 * reach else 0.0
        changes = changes if t >= safe or p0 <= _CLOSE else 0.0
        step = t if changes > 0.0 else safe
        x[SEES_A + i] = lower * x[FA + i] + upper * x[FA + OTHER + i]
        x[SEES_B + i] = lower * x[FB + i] + upper * x[FB + OTHER + i]
        x[STEP + i], x[STEP + OTHER + i] = step, step
        x[LOWER + i], x[CHANGES + i] = lower, changes
        x[DOUBT + i] = 1.0 if changes <= 0.0 and step <= 0.0 else 0.0
        x[TIME + i] = x[TIME + i] + step


@kernel
def _swing(x: Floats, lanes: int) -> None:
    """Move each mode on by a step."""
    for i in range(OTHER + lanes):
        omega, step, y, z = x[OMEGA + i], x[STEP + i], x[Y + i], x[Z + i]
        square = omega * omega
        angle = square * (step * step)
        cos, sin = cosine(angle), sinc(angle) * step
        x[Y + i], x[Z + i] = y * cos + z * sin, z * cos - square * (y * sin)


@kernel
def _land(x: Floats, lanes: int) -> None:
    """Move each lane whose step was to end at an event right onto it, and back to the balls."""
    for i in range(lanes):
        a, ya, za = x[OMEGA + i], x[Y + i], x[Z + i]
        b, yb, zb = x[OMEGA + OTHER + i], x[Y + OTHER + i], x[Z + OTHER + i]
        sees_a, sees_b, lower, changes = x[SEES_A + i], x[SEES_B + i], x[LOWER + i], x[CHANGES + i]
        aa, bb = -a * a, -b * b
        ua, ub = aa * ya, bb * yb
        # what is left, and its first two derivatives; Halley's step again
        f, g = sees_a * ya + sees_b * yb, sees_a * za + sees_b * zb
        h = 0.5 * (sees_a * ua + sees_b * ub)
        inverse = 1.0 / (g if g < 0.0 else -1.0)
        d = f * inverse
        changes = changes if g <= -_SLOW and -aa * d * d <= -_LANDED * g else 0.0
        d = -changes * d * (1.0 + d * h * inverse)
        ya, yb = ya + d * (za + 0.5 * d * ua), yb + d * (zb + 0.5 * d * ub)
        za, zb = za + d * (ua + 0.5 * d * (aa * za)), zb + d * (ub + 0.5 * d * (bb * zb))
        c, s = x[C + i], x[S + i]
        x[W0 + i], x[W1 + i] = c * ya - s * yb, s * ya + c * yb
        x[U0 + i], x[U1 + i] = c * za - s * zb, s * za + c * zb
        x[TIME + i] = x[TIME + i] + d
        x[FLOOR_TURNS + i], x[BALLS_TURN + i] = changes * lower, changes * (1.0 - lower)


@kernel
def _happen(x: Floats, lanes: int, event_limit: float) -> None:
    """Let contacts touch and release, and tell what is over."""
    for i in range(lanes):
        floor, balls, now = x[FLOOR + i], x[BALLS + i], x[TIME + i]
        lower, upper = x[FLOOR_TURNS + i], x[BALLS_TURN + i]
        first, last0, last1 = x[FIRST + i], x[LAST0 + i], x[LAST1 + i]
        touch = upper * (1.0 - balls)
        x[N0 + i] = x[N0 + i] + lower * (1.0 - floor)
        x[N1 + i] = x[N1 + i] + touch
        x[FIRST + i] = now if touch > 0.0 and math.isnan(first) else first
        x[LAST0 + i] = now if lower * floor > 0.0 else last0
        x[LAST1 + i] = now if upper * balls > 0.0 else last1
        floor, balls = abs(floor - lower), abs(balls - upper)
        x[FLOOR + i], x[BALLS + i] = floor, balls
        events, looks = x[EVENTS + i] + lower + upper, x[LOOKS + i] + 1.0
        x[EVENTS + i], x[LOOKS + i] = events, looks
        u0, u1, status, doubt = x[U0 + i], x[U1 + i] * x[SLIM + i], x[STATUS + i], x[DOUBT + i]
        parting = min(u1 - u0, u0)  # the slower one of the two contacts
        result = EVENT_LIMIT if events >= event_limit else 0.0
        result = ASK if doubt > 0.0 or looks >= _LOOKS else result
        result = ASK if floor + balls == 0.0 and parting > -_SLOW else result
        result = FINISHED if floor + balls == 0.0 and parting >= _SLOW else result
        x[STATUS + i] = result if status == 0.0 else status
