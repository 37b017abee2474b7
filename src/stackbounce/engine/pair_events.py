"""What happens to two balls in a lane between steps: contacts touch, turn, press no more, and open.

A step is aimed at the event that comes, the event is applied, the balls fly freely until they touch
again, or the drop ends. If it is not sure whether a contact touches, or follows no simple curve,
the lane ends with the status ASK, and the caller has that drop solved again, more closely.
"""

import math

from stackbounce.engine import pair_step as lane
from stackbounce.engine.codes import ASK, FINISHED
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.pair_cycles import follow, forget
from stackbounce.engine.pair_step import BOTH, EVENT, LANES, ROOT, TIME

# kinds of event; GAIN: the gain that is watched is 0; RETURN: the compression comes back to a
# turning point
TOUCH, RELEASE, GAIN, RETURN = 0.0, 1.0, 2.0, 3.0

_MOST = 2000.0  # touches of a contact: the general engine solves longer drops
_SLOW = 1e-5  # of the impact speed: it is not sure that slower contacts touch or open
_TOGETHER = 1e-6  # of a time: it is not sure which of two contacts that are so close touches first
_NEAR = 0.5  # of the next step by time: an event within it is aimed at
_PART = 0.8  # of the way to a later event, or to one that a step could not be aimed at
_LATE = 0.2  # of what gravity has added to a velocity: a slower touch magnifies errors
_STEADY = 0.4  # of the mean rate up to an event: the least rate at which a step is aimed at it


@kernel
def go_by(x: Floats, i: int, mode: float, h: float) -> None:
    """Let the next step of a lane go by time; a caller changes the weights for another variable."""
    x[lane.MODE + i], x[lane.H + i], x[lane.START + i] = mode, h, 0.0
    x[lane.M + i], x[lane.N + i], x[lane.Q + i] = 1.0, 0.0, 1.0
    for k in (i, LANES + i):
        x[lane.OWN + k], x[lane.BY_R + k], x[lane.BY_A + k] = 0.0, 0.0, 0.0


@kernel
def _go_by_contact(x: Floats, i: int, k: int, mode: float, n: float, h: float) -> None:
    """Let the next step of a lane go by the compression of contact k; if n is 1, by its root.

    One by the root with h below 0 ends where the contact opens.
    """
    go_by(x, i, mode, h)
    x[lane.START + i] = n * max(-h, 0.0)
    x[lane.M + i], x[lane.N + i], x[lane.Q + i] = 1.0 - n, n, 0.0
    x[lane.OWN + k], x[lane.BY_R + k] = 1.0, 1.0


@kernel
def _least_rate(x: Floats, i: int) -> float:
    """Return the rate below which it is not sure whether a contact closes or opens."""
    return max(_SLOW * x[lane.V0 + i], x[lane.UNSURE + i])


@kernel
def press(x: Floats, i: int, k: int) -> None:
    """Let contact k press from now on."""
    x[lane.PRESSING + k], x[lane.SIGN + k], x[lane.GAIN_SIGN + k] = x[lane.STIFFNESS + k], 1.0, 1.0
    x[lane.MU_NOW + k] = x[lane.MU + k]
    if x[lane.LOSS + k] > 0.0:
        forget(x, k)
    if x[lane.COUNT + k] == 0.0:
        x[lane.FIRST + k] = x[lane.Y + lane.T + i]
    x[lane.COUNT + k] += 1.0
    if x[lane.COUNT + k] > _MOST:
        x[lane.STATUS + i] = ASK


@kernel
def open_now(x: Floats, k: int) -> None:
    """Let contact k be open from now on."""
    x[lane.PRESSING + k], x[lane.SIGN + k], x[lane.GAIN_SIGN + k] = 0.0, -1.0, 0.0
    x[lane.MU_NOW + k], x[lane.LEVEL + k] = 0.0, 0.0


@kernel
def _turn_or_return(x: Floats, i: int, k: int, kind: float) -> None:
    """Let contact k with hysteresis go over to another curve: at rest, or where a cycle closes.

    The general engine follows a turn close to where the curve ends, and more cycles.
    """
    out, depth = x[lane.OUTWARD + k] > 0.0, int(x[lane.DEPTH + k])
    c, near = x[lane.Y + lane.C + k], _least_rate(x, i) * x[lane.BY_TIME + i]
    if kind == RETURN:
        depth -= 1
        if out:
            x[lane.TOP + k] = x[lane.HIGHS + depth * BOTH + k]
    elif abs(c - x[lane.LEVEL + k]) < near or (out and depth == lane.CYCLES):
        x[lane.STATUS + i] = ASK
    else:
        if out:
            x[lane.HIGHS + depth * BOTH + k], x[lane.LOWS + depth * BOTH + k] = x[lane.TOP + k], c
            depth += 1
        else:
            x[lane.TOP + k] = c
        x[lane.Y + lane.R + k] = 0.0
        out = not out
    x[lane.OUTWARD + k], x[lane.DEPTH + k] = 1.0 if out else 0.0, depth
    x[lane.SIGN + k] = 1.0 if out or depth == 0 else -1.0
    x[lane.GAIN_SIGN + k] = -1.0 if out else 1.0
    follow(x, k)
    go_by(x, i, TIME, x[lane.BY_TIME + i])


@kernel
def touch(x: Floats, i: int, k: int) -> None:
    """Let contact k touch now; the next step goes by the root of its compression if p is not 1."""
    rate, fallen = x[lane.Y + lane.R + k], x[lane.GRAVITY + i] * x[lane.Y + lane.T + i]
    if not rate > max(_least_rate(x, i), _LATE * fallen) or x[lane.LEVEL + k] > 0.0:
        x[lane.STATUS + i] = ASK
        return
    x[lane.Y + lane.C + k] = 0.0
    press(x, i, k)
    root = x[lane.SCALE + k] * math.sqrt(rate / x[lane.V0 + i])
    if x[lane.POWER + k] > 0.0:
        longest = 2.0 * math.sqrt(rate * x[lane.BY_TIME + i])
        _go_by_contact(x, i, k, ROOT, 1.0, min(root, longest))
    else:
        go_by(x, i, TIME, min(2.0 * root * root / rate, x[lane.BY_TIME + i]))


@kernel
def free_rate(x: Floats, k: int) -> float:
    """Return the rate at which the gap of contact k closes, without its surface's own rate."""
    return x[lane.Y + lane.R + k] - x[lane.NU + k] * x[lane.S + k]


@kernel
def fly(x: Floats, i: int) -> None:
    """Let both balls fly freely until a contact touches, or end the drop.

    A flight to a touch while a surface recovers is left to `pair_series`.
    """
    first, contact, least = math.inf, -1, _least_rate(x, i)
    for k in (i, LANES + i):
        c, r, free = x[lane.Y + lane.C + k], x[lane.Y + lane.R + k], free_rate(x, k)
        touches = free > least
        wait = -c / r if touches and c < 0.0 else math.inf
        close = abs(wait - first) < _TOGETHER * wait
        if free < -least < r:  # the surface still follows the ball
            return
        if not (touches or r < -least) or close or (touches and c > 0.0):
            x[lane.STATUS + i] = ASK
            return
        if wait < first:
            first, contact = wait, k
    if contact < 0:
        x[lane.STATUS + i] = FINISHED
    elif x[lane.S + i] + x[lane.S + LANES + i] == 0.0:
        for k in (i, LANES + i):
            x[lane.Y + lane.C + k] += first * x[lane.Y + lane.R + k]
            if x[lane.Y + lane.C + k] <= 0.0:
                open_now(x, k)
        x[lane.Y + lane.T + i] += first
        touch(x, i, contact)


@kernel
def _fall(x: Floats, i: int) -> None:
    """Let both balls fly under gravity, in steps, or end the drop.

    As in the general engine, it ends if neither ball approaches what is below it now, unless the
    lower ball comes back to the floor before the last contact that is still compressed opens. The
    floor's compression is c + r t + g t^2/2, that of the balls c + r t.
    """
    g, c, lower = x[lane.GRAVITY + i], x[lane.Y + lane.C + i], x[lane.Y + lane.R + i]
    c_balls, upper = x[lane.Y + lane.C + LANES + i], x[lane.Y + lane.R + LANES + i]
    square = lower * lower - 2.0 * g * c
    if min(abs(lower), abs(upper)) <= _least_rate(x, i):
        x[lane.STATUS + i] = ASK
    elif max(lower, upper) > 0.0:
        go_by(x, i, TIME, x[lane.BY_TIME + i])
    elif square < 0.0 or math.sqrt(square) - lower < -g * c_balls / upper:
        x[lane.STATUS + i] = ASK
    else:
        x[lane.STATUS + i] = FINISHED


@kernel
def look_after(x: Floats, i: int) -> bool:
    """Decide how a lane goes on that meets or nears an event; return whether one was applied."""
    taken, at_event = x[lane.TAKEN + i] > 0.0, x[lane.MODE + i] == EVENT
    if x[lane.STEPS + i] > x[lane.LIMIT + i]:
        x[lane.STATUS + i] = ASK
    elif not taken and at_event:
        go_by(x, i, TIME, _PART * x[lane.WAIT + i])
    elif not taken:
        _retry(x, i)
    elif not at_event:
        _look_ahead(x, i)
    else:
        apply_event(x, i)
        if x[lane.WATCHES] > 0.0 and x[lane.STATUS + i] == 0.0 and x[lane.MODE + i] == TIME:
            _look_ahead(x, i)  # else the other contact mostly goes by a formula
        return True
    return False


@kernel
def _gain(x: Floats, k: int, acc: int) -> tuple[float, float]:
    """Return the watched gain of contact k, and its rate; ``acc``: as for `_find_next_event`."""
    a, b, d = x[lane.END_A + k], x[lane.END_B + k], x[lane.END_D + k]
    r = x[lane.Y + lane.R + k]
    return a + b * x[lane.Y + lane.C + k] + d * r, b * r + d * x[acc + k]


@kernel
def _wait(left: float, rate: float, change: float) -> float:
    """Return how long a number takes to become 0, from its derivatives; infinity if it grows."""
    if not (left * rate < 0.0 or (rate == 0.0 and left * change < 0.0)):
        return math.inf
    square = rate * rate - 2.0 * change * left
    return 2.0 * abs(left) / (abs(rate) + math.sqrt(square)) if square > 0.0 else abs(left / rate)


@kernel
def _find_next_event(x: Floats, i: int, acc: int) -> float:
    """Find the next event of a lane that the derivatives tell; return the time to it, or infinity.

    ``acc`` is the slot of the present acceleration.
    """
    first, contact, kind = math.inf, -1, TOUCH
    for k in (i, LANES + i):
        left = x[lane.Y + lane.C + k] - x[lane.LEVEL + k]
        wait = _wait(left, x[lane.Y + lane.R + k], x[acc + k])
        if wait < first:
            first, contact, kind = wait, k, _kind(x, k)
        (gain, slope), sign = _gain(x, k, acc), x[lane.GAIN_SIGN + k]
        if (sign > 0.0 or _turns(x, k)) and sign * gain < -sign * slope * first:
            first, contact, kind = -gain / slope, k, GAIN
    x[lane.CONTACT + i], x[lane.KIND + i], x[lane.WAIT + i] = contact, kind, first
    return first


@kernel
def _look_ahead(x: Floats, i: int) -> None:
    """Aim the next step of a lane, which goes by time, at the event expected in it, if any."""
    first = _find_next_event(x, i, lane.ACC_NEW)
    ahead = first / (lane.AHEAD * x[lane.H + i])
    if ahead < 1.5 and not (ahead < _NEAR and _aim(x, i, lane.ACC_NEW)):
        x[lane.H + i] = min(x[lane.H + i], _PART * first)


@kernel
def _retry(x: Floats, i: int) -> None:
    """Let a lane repeat a step in which an event may come: up to it, or shorter.

    If the balls move less in the step than what is not sure, it is left to the caller.
    """
    first, dt = _find_next_event(x, i, lane.ACC), x[lane.DT + i]
    span = min(x[lane.SPAN + i], x[lane.SPAN + LANES + i])
    if dt * x[lane.V0 + i] < x[lane.UNSURE + i] * span:
        x[lane.STATUS + i] = ASK
    elif x[lane.MODE + i] == ROOT or not first < dt:
        x[lane.H + i] *= 0.5
    elif not _aim(x, i, lane.ACC):
        x[lane.H + i] = _PART * first


@kernel
def _kind(x: Floats, k: int) -> float:
    """Return the kind of event that comes when the compression of contact k is 0."""
    if not x[lane.PRESSING + k] > 0.0:
        return TOUCH
    if x[lane.LEVEL + k] > 0.0:
        return RETURN
    # the gain of a damped contact with a = 0 ends before
    return GAIN if x[lane.B + k] * x[lane.D + k] > 0.0 else RELEASE


@kernel
def _turns(x: Floats, k: int) -> bool:
    """Return whether contact k has hysteresis and presses, so that it turns where it is at rest."""
    return x[lane.LOSS + k] > 0.0 and x[lane.PRESSING + k] > 0.0


@kernel
def _aim(x: Floats, i: int, acc: int) -> bool:
    """Let the next step of a lane end at the next event; return whether the way to it is steady."""
    k, kind, wait = int(x[lane.CONTACT + i]), x[lane.KIND + i], x[lane.WAIT + i]
    left, slope = x[lane.Y + lane.C + k] - x[lane.LEVEL + k], x[lane.Y + lane.R + k]
    if kind == GAIN:
        left, slope = _gain(x, k, acc)
    if not (left * slope < 0.0 and abs(slope) * wait > _STEADY * abs(left)):
        return False
    if kind == RELEASE:
        _go_by_contact(x, i, k, EVENT, 1.0, -math.sqrt(left))
    else:
        _go_by_contact(x, i, k, EVENT, 0.0, -left)
    if kind == GAIN:
        x[lane.BY_R + k], x[lane.BY_A + k] = x[lane.END_B + k], x[lane.END_D + k]
    return True


@kernel
def apply_event(x: Floats, i: int) -> None:
    """Apply the event at which a step has ended."""
    k, kind = int(x[lane.CONTACT + i]), x[lane.KIND + i]
    r, acc, turns = x[lane.Y + lane.R + k], x[lane.ACC_NEW + k], kind >= GAIN and _turns(x, k)
    if not turns and r * acc < 0.0 and r * r < 2.0 * abs(acc) * x[lane.WIDE + k]:
        x[lane.STATUS + i] = ASK  # it would come back before it is sure that it was there
    elif kind == TOUCH:
        touch(x, i, k)
    elif turns:
        _turn_or_return(x, i, k, kind)
    else:
        open_now(x, k)
        if kind == GAIN:  # it is open, but compressed, and may press again
            x[lane.GAIN_SIGN + k], x[lane.LEVEL + k] = -1.0, x[lane.Y + lane.C + k]
        else:
            x[lane.Y + lane.C + k] = 0.0
        go_apart(x, i, k)


@kernel
def go_apart(x: Floats, i: int, k: int) -> None:
    """Let contact k, which presses no more from now on, go on as the other one lets it."""
    x[lane.LAST + k] = x[lane.Y + lane.T + i]
    if not x[lane.Y + lane.R + k] < -_least_rate(x, i):
        x[lane.STATUS + i] = ASK
    elif x[lane.PRESSING + i] + x[lane.PRESSING + LANES + i] > 0.0:
        go_by(x, i, TIME, x[lane.BY_TIME + i])
    elif x[lane.GRAVITY + i] > 0.0:
        _fall(x, i)
    else:
        fly(x, i)
