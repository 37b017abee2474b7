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
from stackbounce.engine.waves import cosine, half_turns, sinc

LANES = 16

# The slots of a drop. Its state: positions, velocities, time, and which contacts press (1 or 0).
W0, W1, U0, U1, TIME, FLOOR, BALLS = (k * LANES for k in range(7))
# Its story: how it ended, looks, events, intervals of each contact, the balls' first touch, last
# releases. Which row it is, and whether its last look was in vain (1 or 0).
STATUS, LOOKS, EVENTS, N0, N1, FIRST, LAST0, LAST1, ROW = (k * LANES for k in range(7, 16))
VAIN = 16 * LANES
# 1/sqrt(mu); with both contacts pressed c, s, a, b, what the balls' contact sees of the modes, 1/a
# and 1/b; the same for the balls only, where b is 0.
SLIM, C2, S2, A2, B2, V2, X2, OVER_A2, OVER_B2 = (k * LANES for k in range(17, 26))
C1, S1, A1, V1, OVER_A1 = (k * LANES for k in range(26, 31))
DROP = 31  # so many

# The slots of a look: the rotation of the present regime, how far a series is used, and how far one
# of the slower mode only. Of the contact that may end the look: what it sees of the modes, a bound
# of its third derivative over 2, whether (1 or 0) it is the floor's, whether an event is expected,
# how long after the time that is safe, and how much longer the other contact is safe. Any doubt,
# and which contact has changed.
C, S, REACH, LONG = (k * LANES for k in range(31, 35))
SEES_A, SEES_B, BEND, LOWER, EXPECTED, PAST, SPARE, DOUBT = (k * LANES for k in range(35, 43))
FLOOR_TURNS, BALLS_TURN = 43 * LANES, 44 * LANES
# Double slots, of mode a in the first half and of mode b in the second: frequency, one over it or
# 0, position, velocity, and the step.
OMEGA, OVER, Y, Z, STEP = (k * LANES for k in range(45, 55, 2))
# Double slots, of the floor's contact and of the balls': how far it is from an event (a compression
# or a gap) as a series, how far that is used, bounds of the third derivative over 2 and of the
# sixth over 6!, the shares of the modes in distance and rate, what it sees of the modes, and how
# long nothing happens.
P0, P1, P2, P3, P4, P5, VALID, THIRD, TAIL = (k * LANES for k in range(55, 73, 2))
GA, GB, HA, HB, FA, FB, SAFE = (k * LANES for k in range(73, 87, 2))
OTHER = LANES  # the second half of a double slot
SLOTS = 87

WIDEST = 2.5  # rad: how far series of order 5 are used
_FAST = 64.0  # rad: how far the faster mode goes in one look
_SLOW = 1e-5  # of the impact speed: whether anything so slow happens is left to the general engine
_CLOSE = 1e-10  # of v0/omega: so is what comes so close to happening
_NOISE = 1e-13  # of the impact speed: balls that move together
_NEAR = 0.01  # rad, and as a part: what keeps the error of a landing below 1e-16
_LOOKS = 200.0  # longer stories gather round-off
_NEVER = 1e300


@kernel
def look(x: Floats, event_limit: float) -> None:
    """Move each lane on, at most to its next event, and let that happen."""
    _expand(x)
    _differentiate(x, 0)
    _differentiate(x, OTHER)
    _watch(x)
    _aim(x)
    _swing(x)
    _land(x)
    _happen(x, event_limit)


@kernel
def _expand(x: Floats) -> None:
    """Find each lane's modes (eqs 5 and 6), and what each contact sees of them.

    A slot of a contact holds how far it is from its next event: a pressed one its compression, an
    open one its gap.
    """
    for i in range(LANES):
        floor, balls = x[FLOOR + i], x[BALLS + i]
        both = floor * balls
        only, apart = balls - both, 1.0 - balls
        w0, w1, u0, u1, slim = x[W0 + i], x[W1 + i], x[U0 + i], x[U1 + i], x[SLIM + i]
        # sums, as a choice between two slots would be compiled to a slow one between addresses
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
    """Find for a contact the series of its distance from an event, and a bound of the rest.

    The distance is at least what mode b makes of it less all that mode a, the faster one, can take
    away. Where that is sure to stay positive for long it stands for the distance.
    """
    for n in range(LANES):
        i = half + n
        ga, gb, ha, hb, p0, p1 = x[GA + i], x[GB + i], x[HA + i], x[HB + i], x[P0 + i], x[P1 + i]
        a, b, reach, long = x[OMEGA + n], x[OMEGA + OTHER + n], x[REACH + n], x[LONG + n]
        # at least sqrt(u^2 + v^2), the amplitude of mode a
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
def _watch(x: Floats) -> None:
    """Find for each contact a time before which it surely keeps its phase.

    Its distance p(t) from the event is known to order 5, with a bound of the rest. Horner's nested
    lower bounds, as in `series.safe_step`, go down to a parabola here: p is positive before its
    root.
    """
    for i in range(2 * LANES):
        p0, p1, p2, p3, p4, p5 = x[P0 + i], x[P1 + i], x[P2 + i], x[P3 + i], x[P4 + i], x[P5 + i]
        tail, reach = x[TAIL + i], x[VALID + i]
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
def _aim(x: Floats) -> None:
    """Find each lane's step: to where its first event is expected, or as far as there is none."""
    for i in range(LANES):
        one, other = x[SAFE + i], x[SAFE + OTHER + i]
        lower = 1.0 if one <= other else 0.0
        upper = 1.0 - lower
        p0, p1 = lower * x[P0 + i], lower * x[P1 + i]
        p2, p3 = lower * x[P2 + i], lower * x[P3 + i]
        p4, p5 = lower * x[P4 + i], lower * x[P5 + i]
        p0, p1 = p0 + upper * x[P0 + OTHER + i], p1 + upper * x[P1 + OTHER + i]
        p2, p3 = p2 + upper * x[P2 + OTHER + i], p3 + upper * x[P3 + OTHER + i]
        p4, p5 = p4 + upper * x[P4 + OTHER + i], p5 + upper * x[P5 + OTHER + i]
        x[SEES_A + i] = lower * x[FA + i] + upper * x[FA + OTHER + i]
        x[SEES_B + i] = lower * x[FB + i] + upper * x[FB + OTHER + i]
        x[BEND + i] = lower * x[THIRD + i] + upper * x[THIRD + OTHER + i]
        reach, short, vain = (
            lower * x[VALID + i] + upper * x[VALID + OTHER + i],
            x[REACH + i],
            x[VAIN + i],
        )
        safe, limit = min(one, other), max(one, other)
        f = p0 + safe * (p1 + safe * (p2 + safe * (p3 + safe * (p4 + safe * p5))))
        g = p1 + safe * (2.0 * p2 + safe * (3.0 * p3 + safe * (4.0 * p4 + safe * (5.0 * p5))))
        h = p2 + safe * (3.0 * p3 + safe * (6.0 * p4 + safe * (10.0 * p5)))
        d = _halley(f, g, h)
        t = safe + d
        expected = 1.0 - vain if g < -_SLOW and (d >= 0.0 or p0 <= _CLOSE) else 0.0
        expected = expected if t <= limit and t <= reach and abs(d) <= 0.1 * reach else 0.0
        expected = expected if reach <= short else 0.0
        step = t if expected > 0.0 else safe
        x[STEP + i], x[STEP + OTHER + i] = step, step
        x[LOWER + i], x[EXPECTED + i], x[PAST + i], x[SPARE + i] = lower, expected, d, limit - t
        x[DOUBT + i] = 1.0 if expected <= 0.0 and step <= 0.0 else 0.0


@kernel
def _halley(f: float, g: float, h: float) -> float:
    """Return Halley's step, to second order, to where f + g d + h d^2 falls through 0."""
    inverse = 1.0 / (g if g < 0.0 else -1.0)
    d = -f * inverse
    return d * (1.0 - d * h * inverse)


@kernel
def _swing(x: Floats) -> None:
    """Move each mode on by a step."""
    for i in range(2 * LANES):
        omega, over, step, y, z = x[OMEGA + i], x[OVER + i], x[STEP + i], x[Y + i], x[Z + i]
        sign, angle = half_turns(omega * step)
        square = angle * angle
        cos, sin = sign * cosine(square), sign * (angle * sinc(square))
        travel = sin * over if over > 0.0 else step
        x[Y + i], x[Z + i] = y * cos + z * travel, z * cos - omega * (y * sin)


@kernel
def _land(x: Floats) -> None:
    """Move each lane that expects an event right onto it, and all back to the balls.

    The root is the first event if the distance falls all the way to it from the time that was safe,
    as its derivatives at the root tell, and if the other contact is safe until then. Otherwise the
    look was in vain: the lane stays where it was, and will not look further than is safe.
    """
    for i in range(LANES):
        a, ya, za = x[OMEGA + i], x[Y + i], x[Z + i]
        b, yb, zb = x[OMEGA + OTHER + i], x[Y + OTHER + i], x[Z + OTHER + i]
        sees_a, sees_b, expected = x[SEES_A + i], x[SEES_B + i], x[EXPECTED + i]
        aa, bb = -a * a, -b * b
        fa, fb, ga, gb = sees_a * ya, sees_b * yb, sees_a * za, sees_b * zb
        p0, p1 = fa + fb, ga + gb
        fa, fb, ga, gb = aa * fa, bb * fb, aa * ga, bb * gb
        p2, p3 = (fa + fb) * (1.0 / 2.0), (ga + gb) * (1.0 / 6.0)
        p4, p5 = (aa * fa + bb * fb) * (1.0 / 24.0), (aa * ga + bb * gb) * (1.0 / 120.0)
        inverse = 1.0 / (p1 if p1 < 0.0 else -1.0)
        newton = -p0 * inverse
        bent = newton * p2 * inverse
        d = newton * (1.0 - bent)
        f = p0 + d * (p1 + d * (p2 + d * (p3 + d * (p4 + d * p5))))
        g = p1 + d * (2.0 * p2 + d * (3.0 * p3 + d * (4.0 * p4 + d * (5.0 * p5))))
        h = p2 + d * (3.0 * p3 + d * (6.0 * p4 + d * (10.0 * p5)))
        d = d + _halley(f, g, h)
        past, bend, spare = abs(x[PAST + i]) + abs(d), x[BEND + i], x[SPARE + i]
        lands = expected if p1 <= -_SLOW and d <= spare else 0.0
        lands = lands if a * abs(newton) <= _NEAR and abs(bent) <= _NEAR else 0.0
        lands = lands if (2.0 * abs(h) + bend * past) * past <= -0.9 * g else 0.0
        d = lands * d
        ya, za = _nudged(aa, d, ya, za)
        yb, zb = _nudged(bb, d, yb, zb)
        c, s = x[C + i], x[S + i]
        stays = expected - lands
        moves = 1.0 - stays
        x[W0 + i] = moves * (c * ya - s * yb) + stays * x[W0 + i]
        x[W1 + i] = moves * (s * ya + c * yb) + stays * x[W1 + i]
        x[U0 + i] = moves * (c * za - s * zb) + stays * x[U0 + i]
        x[U1 + i] = moves * (s * za + c * zb) + stays * x[U1 + i]
        x[TIME + i] = x[TIME + i] + moves * (x[STEP + i] + d)
        x[VAIN + i] = stays
        x[FLOOR_TURNS + i], x[BALLS_TURN + i] = lands * x[LOWER + i], lands * (1.0 - x[LOWER + i])


@kernel
def _nudged(square: float, d: float, y: float, z: float) -> tuple[float, float]:
    """Return a mode after a time d of much less than a period; square is minus its frequency's."""
    angle = square * d * d
    cos = 1.0 + angle * (1.0 / 2.0 + angle * (1.0 / 24.0 + angle * (1.0 / 720.0)))
    sinc = 1.0 + angle * (1.0 / 6.0 + angle * (1.0 / 120.0 + angle * (1.0 / 5040.0)))
    return y * cos + z * (d * sinc), z * cos + square * (y * (d * sinc))


@kernel
def _happen(x: Floats, event_limit: float) -> None:
    """Let contacts touch and release, and tell what is over."""
    for i in range(LANES):
        floor, balls, now = x[FLOOR + i], x[BALLS + i], x[TIME + i]
        lower, upper = x[FLOOR_TURNS + i], x[BALLS_TURN + i]
        touch, n1, first = upper * (1.0 - balls), x[N1 + i], x[FIRST + i]
        new = touch if n1 == 0.0 else 0.0
        x[FIRST + i], x[N1 + i] = first + new * now, n1 + touch
        x[N0 + i] = x[N0 + i] + lower * (1.0 - floor)
        release0, release1 = lower * floor, upper * balls
        x[LAST0 + i] = (1.0 - release0) * x[LAST0 + i] + release0 * now
        x[LAST1 + i] = (1.0 - release1) * x[LAST1 + i] + release1 * now
        floor, balls = abs(floor - lower), abs(balls - upper)
        x[FLOOR + i], x[BALLS + i] = floor, balls
        events, looks = x[EVENTS + i] + lower + upper, x[LOOKS + i] + 1.0
        x[EVENTS + i], x[LOOKS + i] = events, looks
        u0, u1, doubt = x[U0 + i], x[U1 + i] * x[SLIM + i], x[DOUBT + i]
        parting = min(u1 - u0, u0)  # the slower one of the two contacts
        result = EVENT_LIMIT if events >= event_limit else 0.0
        result = ASK if doubt > 0.0 or looks >= _LOOKS else result
        result = ASK if floor + balls == 0.0 and parting > -_SLOW else result
        x[STATUS + i] = FINISHED if floor + balls == 0.0 and parting >= _SLOW else result
