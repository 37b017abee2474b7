"""The next event of a contact: when its present phase ends, and what follows.

=========== ============================ =====================================================
phase       ends when                    event and next phase
=========== ============================ =====================================================
open        c rises through 0, or        TOUCH: compressing along the loading curve
..          through the surface          (if the contact creeps)
compressing the rate falls through 0     PEAK: releasing; with hysteresis along the unloading curve
                                         from here
..          c rises through the peak of  RETURNED: the same, as before that cycle, see `cycles`
            the present cycle
releasing   c falls through 0            RELEASE: open
..          c of a spring rises through  RETURNED: compressing, to another peak
            its peak
..          c falls to where the present RETURNED: the same, as before that cycle
            cycle began
..          the rate of a contact with   DIP: compressing, in a cycle inside the present one
            hysteresis rises through 0
any above   c passes a knot              CROSSED: the same, on the next piece of the curve
..          the gain falls through 0     CLIPPED: unloaded; of a contact that creeps RELEASE: open
unloaded    the gain rises through 0     RESUMED: compressing
..          c falls through 0            RELEASE: open since the force was clipped
=========== ============================ =====================================================

A bond has no events: it never opens, and its force has one formula.

A lossless power-law contact in a cluster that is solved by Taylor series has no PEAK event:
`record_series_peaks` finds the peak from the series.

A change of sign counts only if it exceeds round-off: an open contact that grazes within its
round-off has not touched, and balls whose speeds are equal within theirs do not approach. A gain
that exceeds its round-off only long after its zero is clipped at the zero all the same.
"""

import math
from typing import NamedTuple, TypeAlias

from stackbounce.engine import codes
from stackbounce.engine.contacts import approach_noise, linearised_impulse_limit
from stackbounce.engine.cycles import has_hysteresis, lowest_compression
from stackbounce.engine.elementary import exponent_of, times_power_of_two
from stackbounce.engine.event_queue import schedule
from stackbounce.engine.forces import creeps, is_damped
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.motion import (
    KNOWN,
    align_anchors,
    compression_series,
    contact_impulse,
    root_at,
    series_time,
    subtract_surface,
)
from stackbounce.engine.series import (
    differentiate,
    evaluate,
    lower_bound,
    parabola_root,
    safe_step,
    shift,
    time_to_level,
)
from stackbounce.engine.slots import GRAVITY, NONLINEAR, SPEED, TOLERANCE
from stackbounce.engine.stack import Stack

# of a typical speed or compression: a motion whose round-off is smaller has died out
_VANISHED = 1000.0 * codes.EPSILON * codes.EPSILON
# times the tolerance of a step: where motion is nonlinear, smaller overlaps are no touch
_TOUCH_MARGIN = 10.0
# of a time: a zero of the gain that is nearer than this to the time found is not refined
_TIME_ERROR = 2e-12
# the most steps that refine such a zero, and the part of them all that the last may be
_NEWTON_STEPS, _LAST_STEP = 6, 1e-3
# a chord ends at ``linearised_below`` and begins at this part of it, so that it does not end at
# once, or where the logarithm of a steep force has fallen by so much
_CHORD_ENTRY, _CHORD_LOGARITHMS = 0.9, 1e3

Event: TypeAlias = tuple[float, bool, int]
"""A wait until an event, whether it is reached then or only not before, and its kind."""


class Motion(NamedTuple):
    """The motion of a contact from now on: what is known of the series in ``stack.watched``.

    It is the power series of the compression c. Its variable is the time from now (root = 1) or the
    square root of that (root = 2).
    """

    root: int
    order: int  # of the series
    power: int  # of its remainder
    tail: float  # a bound on the remainder's coefficient
    known: bool  # whether all of these are finite
    straight: bool  # whether two balls in flight have no relative acceleration
    noise: float  # round-off of c
    rate_noise: float  # round-off of the rate of c
    tick: float  # round-off of the time
    band: float  # the least change of c that counts
    rate_band: float  # the least rate that counts
    horizon: float  # how far the series is valid, in its variable


@kernel
def schedule_next_event(stack: Stack, i: int, time: float) -> None:
    """Schedule the next event of contact i, or a check if no event is certain yet.

    Each kind of event is searched for up to the earliest found before it; of two at the same time
    the one found first stays, but for a fall.
    """
    phase = stack.phase[i]
    if stack.law[i] == codes.ABSENT:
        return
    if phase < codes.COMPRESSING:
        align_anchors(stack, i)
    elif stack.bonded[i] == 1 or _keeps_curve(stack, i, time):
        stack.event[i] = codes.CHECK
        schedule(stack.due, stack.heap, stack.place, i, math.inf)
        return
    motion = _motion(stack, i, time)
    if not motion.known:
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
        return
    if phase == codes.OPEN:
        event = _touch(stack, i, motion)
    elif _has_died_out(stack, i, motion):
        event = 0.0, True, codes.RELEASE
    else:
        event = _clip_or_resume(stack, i, time, motion)
        event = _fall(stack, i, motion, event)
        event = _linearise(stack, i, motion, event)
        event = _rise(stack, i, motion, event)
        event = _curve(stack, i, time, motion, event)
        event = _turn(stack, i, motion, event)
    _schedule(stack, i, time, motion, event)


@kernel
def _motion(stack: Stack, i: int, time: float) -> Motion:
    """Return the motion of contact i from ``time`` on; its series is in ``stack.watched``."""
    a, root, size = stack.watched, root_at(stack, i), len(stack.mass)
    order, power, tail, noise, rate_noise = compression_series(stack, i, time, root, a)
    known = math.isfinite(tail + noise + rate_noise + a[0] + a[1] + a[order])
    straight = order <= 2 and a[2] == 0.0
    if stack.phase[i] == codes.OPEN and stack.creep[i] > 0.0:
        noise += 8.0 * codes.EPSILON * abs(a[0])
        last, power, rest = subtract_surface(stack, i, time, root, a)
        order, tail = max(order, last), tail + rest
    # at least the round-off of a typical compression and speed
    tick = 4.0 * codes.EPSILON * time
    band = max(noise + tick * abs(a[root]), 4.0 * codes.EPSILON * stack.scale[i])
    rate_band = rate_noise + tick * abs(2.0 * a[2 * root])
    rate_band = max(rate_band, 4.0 * codes.EPSILON * stack.number[SPEED])
    horizon = stack.due[size + stack.first[i]]
    if i > 0:
        horizon = min(horizon, stack.due[size + stack.first[i - 1]])
    horizon -= time
    if root == 2:
        horizon = math.sqrt(horizon)
    return Motion(
        root, order, power, tail, known, straight, noise, rate_noise, tick, band, rate_band, horizon
    )


@kernel
def _has_died_out(stack: Stack, i: int, motion: Motion) -> bool:
    """Return whether the motion of pressing contact i, in normal modes, is only round-off."""
    if stack.phase[i] < codes.COMPRESSING or stack.modal[stack.first[i]] == 0:
        return False
    slow = motion.rate_noise < _VANISHED * stack.number[SPEED]
    return slow and motion.noise < _VANISHED * stack.scale[i]


@kernel
def _has_peaks(stack: Stack, i: int) -> bool:
    """Return whether a peak of contact i is an event; else its series gives the peak."""
    modal = stack.modal[stack.first[i]] == 1
    return has_hysteresis(stack, i) or (modal and stack.law[i] == codes.POWER)


@kernel
def _limit(motion: Motion, event: Event) -> float:
    """Return how far to search for an event before the one found so far: the series is valid."""
    return min(event[0], motion.horizon)


@kernel
def _touch(stack: Stack, i: int, motion: Motion) -> Event:
    """Return when open contact i touches: c rises through 0, or through its surface."""
    a, band, rate_band = stack.watched, motion.band, motion.rate_band
    if stack.counter[NONLINEAR] == 1:  # and at least the tolerance of nonlinear motion
        band += _TOUCH_MARGIN * stack.number[TOLERANCE] * stack.scale[i]
        rate_band += _TOUCH_MARGIN * stack.number[TOLERANCE] * stack.number[SPEED]
    if a[0] < -band or a[motion.root] < -rate_band:
        stack.touching[i] = math.nan
    # two balls in flight, or one above the floor; a surface that recovers does so ever more slowly
    if motion.straight and a[1] <= approach_noise(stack, i):
        return math.inf, False, codes.CHECK
    if motion.root == 2 and _is_pressed_together(stack, i, a, motion.order):
        return 0.0, True, codes.TOUCH
    wait, reached = _level_wait(stack, motion, -1.0, 0.0, band, motion.horizon)
    return wait, reached, codes.TOUCH


@kernel
def _clip_or_resume(stack: Stack, i: int, time: float, motion: Motion) -> Event:
    """Return when the gain of contact i changes its sign; one that creeps then opens."""
    if not is_damped(stack, i):
        return math.inf, False, codes.CHECK
    wait, reached = _gain_wait(stack, i, time, motion)
    if creeps(stack, i):
        return wait, reached, codes.RELEASE
    return wait, reached, codes.RESUMED if stack.phase[i] == codes.UNLOADED else codes.CLIPPED


@kernel
def _can_fall(stack: Stack, i: int) -> bool:
    """Return whether c can fall to the lower end of the present curve before another event.

    A contact that creeps opens with its gain; one with peaks has to pass its peak first.
    """
    return not creeps(stack, i) and (stack.phase[i] == codes.RELEASING or not _has_peaks(stack, i))


@kernel
def _fall(stack: Stack, i: int, motion: Motion, event: Event) -> Event:
    """Return when c falls to where contact i opens or its curve changes, if before ``event``.

    It comes first as well if both are at the same time. A contact whose force was clipped opens at
    once if its balls fly on at one speed.
    """
    if not _can_fall(stack, i):
        return event
    level, kind = lowest_compression(stack, i), codes.RELEASE
    together = motion.straight and abs(stack.watched[1]) <= approach_noise(stack, i)
    if together and stack.phase[i] == codes.UNLOADED:
        return 0.0, True, kind
    if level > 0.0:
        kind = codes.RETURNED
    if stack.law[i] == codes.PIECEWISE and stack.piece_low[i] > level:
        level, kind = stack.piece_low[i], codes.CROSSED
    limit = _limit(motion, event)
    wait, reached = _level_wait(stack, motion, 1.0, level, motion.band, limit)
    if wait < limit or (reached and wait <= limit < motion.horizon):
        return wait, reached, kind
    return event


@kernel
def _linearise(stack: Stack, i: int, motion: Motion, event: Event) -> Event:
    """Return when c falls to where a chord replaces the power law, if before ``event``.

    Up to an event that is certain no chord is needed: the series is valid.
    """
    if not _can_fall(stack, i):
        return event
    level = _linearised_level(stack, i)
    if level <= 0.0 or (event[1] and event[0] < motion.horizon):
        return event
    limit = _limit(motion, event)
    wait, reached = _level_wait(stack, motion, 1.0, level, motion.band, limit)
    return (wait, reached, codes.LINEARISED) if wait < limit else event


@kernel
def _rise(stack: Stack, i: int, motion: Motion, event: Event) -> Event:
    """Return when c rises to where the curve of contact i changes, if before ``event``."""
    level, kind, phase = math.inf, codes.CHECK, stack.phase[i]
    if phase == codes.UNLOADED:
        return event
    turned = codes.COMPRESSING if has_hysteresis(stack, i) else codes.RELEASING
    if phase == turned and _has_peaks(stack, i):
        level, kind = stack.top[i], codes.RETURNED
    if stack.law[i] == codes.PIECEWISE and stack.piece_high[i] < level:
        level, kind = stack.piece_high[i], codes.CROSSED
    if stack.linearised[i] == 1 and stack.linearised_below[i] < level:
        level, kind = stack.linearised_below[i], codes.CURVED
    if level == math.inf:
        return event
    limit = _limit(motion, event)
    wait, reached = _level_wait(stack, motion, -1.0, level, motion.band, limit)
    return (wait, reached, kind) if wait < limit else event


@kernel
def _curve(stack: Stack, i: int, time: float, motion: Motion, event: Event) -> Event:
    """Return when the impulse along the chord of contact i is spent, if before ``event``."""
    if stack.linearised[i] == 0 or stack.rate[i] <= 0.0 or stack.phase[i] < codes.COMPRESSING:
        return event
    spent, first = stack.changed, stack.first[i]
    order, power, tail = motion.order, motion.power, motion.tail
    s = time - stack.anchor[first]
    spent[0] = stack.linearised_impulse[i] + contact_impulse(stack, i, s)
    if stack.modal[first] == 1:
        order += 1
        power += 1
        tail *= stack.rate[i] / power
        for k in range(order, 0, -1):
            spent[k] = stack.rate[i] * stack.watched[k - 1] / k
    else:
        root = stack.root[first]
        order = stack.order[first] + root
        shift(stack.force_series[i], order - root, s, stack.scratch)
        spent[1] = 0.0  # remains 0 in a series in the root of time
        for k in range(root, order + 1):
            spent[k] = root * stack.scratch[k - root] / k
    budget, limit = linearised_impulse_limit(stack, i), _limit(motion, event)
    band = 0.1 * budget
    wait, reached = _safe_wait(stack, spent, order, power, tail, 0.0, -1.0, budget, band, limit)
    return (wait, reached, codes.CURVED) if wait < limit else event


@kernel
def _turn(stack: Stack, i: int, motion: Motion, event: Event) -> Event:
    """Return when c stops rising or, with hysteresis, stops falling, if before ``event``.

    The series in ``stack.watched`` becomes that of the rate.
    """
    rises = stack.phase[i] == codes.COMPRESSING
    if not has_hysteresis(stack, i) and not (rises and _has_peaks(stack, i)):
        return event
    a, order, root, power = stack.watched, motion.order, motion.root, motion.power
    for k in range(order - root + 1):
        a[k] = (k + root) * a[k + root] / root
    sign, tail, limit = 1.0 if rises else -1.0, power * motion.tail, _limit(motion, event)
    wait, reached = _safe_wait(
        stack, a, order - root, power - 1, tail, 0.0, sign, 0.0, motion.rate_band, limit
    )
    return (wait, reached, codes.PEAK if rises else codes.DIP) if wait < limit else event


@kernel
def _keeps_curve(stack: Stack, i: int, time: float) -> bool:
    """Return whether contact i surely has no event while its cluster's series is valid.

    A lower bound of the compression, and of the gain of a damped contact, decides. It is true
    during most of an interval, which saves the search for the event.
    """
    first, law = stack.first[i], stack.law[i]
    if stack.modal[first] == 1 or stack.anchor[first] != time or stack.linearised[i] == 1:
        return False
    if law not in (codes.POWER, codes.PRODUCT) or stack.phase[i] != codes.COMPRESSING:
        return False
    horizon = series_time(stack, first, stack.due[len(stack.mass) + first] - time)
    order, c = stack.order[first], stack.compression_series[i]
    begins = stack.root[first] if c[0] == 0.0 else 0  # the lowest power of the series that is not 0
    least = lower_bound(c, begins, order + stack.root[first], horizon)
    if law == codes.PRODUCT and not lower_bound(stack.gain_series[i], 0, order, horizon) > 0.0:
        return False
    return least > _linearised_level(stack, i)


@kernel
def _linearised_level(stack: Stack, i: int) -> float:
    """Return the compression below which contact i must be linearised; 0 if it need not be."""
    smooth = stack.curve_exponent[i] == 0.0 or stack.curve_exponent[i] == 1.0
    if smooth or stack.linearised[i] == 1 or stack.phase[i] == codes.UNLOADED:
        return 0.0
    if root_at(stack, i) == 2 and stack.phase[i] == codes.COMPRESSING:
        return 0.0
    ratio = max(_CHORD_ENTRY, 1.0 - _CHORD_LOGARITHMS / stack.curve_exponent[i])
    return ratio * stack.linearised_below[i]


@kernel
def _gain_wait(stack: Stack, i: int, time: float, motion: Motion) -> tuple[float, bool]:
    """Return how long the gain of damped contact i surely keeps its sign; see `_safe_wait`."""
    a, gain = stack.watched, stack.changed
    order, power, root, tail = motion.order, motion.power, motion.root, motion.tail
    speed, reach = abs(a[root]), motion.horizon
    noise = max(motion.noise, 16.0 * codes.EPSILON * abs(a[0])) + motion.tick * speed
    rate_noise = max(motion.rate_noise, 16.0 * codes.EPSILON * (stack.speed[i] + speed))
    rate_noise += motion.tick * abs(2.0 * a[2 * root])
    slope, rate = stack.gain_slope[i], stack.gain_rate[i]
    for k in range(order + 1):
        gain[k] = slope * a[k]
    for k in range(order - root + 1):
        gain[k] += rate * (k + root) * a[k + root] / root
    gain[0] += stack.gain_constant[i]
    if creeps(stack, i):
        since = time - stack.anchor[stack.first[i]]
        shift(stack.creep_series[i], order, since, stack.scratch)
        for k in range(order + 1):
            gain[k] -= stack.gain_creep[i] * stack.scratch[k]
    noise = max(noise, codes.EPSILON * codes.EPSILON * stack.scale[i])
    rate_noise = max(rate_noise, codes.EPSILON * codes.EPSILON * stack.number[SPEED])
    clear = slope * noise + rate * rate_noise + 4.0 * codes.EPSILON * stack.gain_constant[i]
    sign = -1.0 if stack.phase[i] == codes.UNLOADED else 1.0
    level = 0.0
    if stack.factor_exponent[i] > 0.0:
        clear += rate * stack.number[TOLERANCE] * stack.number[SPEED]
    if slope == 0.0:
        clear *= 10.0  # this gain may approach zero without ever falling through it
    elif sign < 0.0:
        level = 2.0 * clear
    elif gain[0] <= clear and gain[1] < 0.0 and a[1] < 0.0:
        # an overdamped contact would open infinitely slowly, with a negligible force
        return _zero_near(stack, i, time, motion, 0.0), True
    elif a[1] == 0.0 and abs(gain[0]) + abs(gain[1]) * reach <= clear and _is_alone(stack, i):
        return 0.0, True  # at rest, with a force too small to change that
    rest, more = rate * power * tail, slope * tail
    wait, reached = _safe_wait(stack, gain, order, power - 1, rest, more, sign, level, clear, reach)
    if reached and sign > 0.0:
        wait = _zero_near(stack, i, time, motion, wait)
    return wait, reached


@kernel
def _is_alone(stack: Stack, i: int) -> bool:
    """Return whether no force but that of contact i acts on its balls."""
    below = i == 0 or stack.phase[i - 1] < codes.COMPRESSING
    above = i + 1 == len(stack.mass) or stack.phase[i + 1] < codes.COMPRESSING
    return below and above and stack.number[GRAVITY] == 0.0


@kernel
def _zero_near(stack: Stack, i: int, time: float, motion: Motion, near: float) -> float:
    """Return where the gain of contact i falls through zero, or ``near`` if that is near enough.

    Near enough is what the tolerance leaves of a time after many steps. Under strong damping the
    gain passes zero so gently that it is clear of its round-off only later than that. The result is
    ``near`` as well if Newton's method finds no zero from now to the horizon.
    """
    share = _TIME_ERROR
    if stack.factor_exponent[i] > 0.0:
        share = max(share, KNOWN * stack.number[TOLERANCE])
    gain, order, x, step = stack.changed, motion.order, near, 0.0
    found = near if motion.root == 1 else near * near
    for _ in range(_NEWTON_STEPS):
        rate = differentiate(gain, order, x)
        if rate >= 0.0:
            return near
        step = evaluate(gain, order, x) / rate
        x -= step
        zero = x if motion.root == 1 else x * x
        if not 0.0 <= x <= motion.horizon or abs(zero - found) <= share * (time + found):
            return near
    return x if abs(step) <= _LAST_STEP * abs(x - near) else near


@kernel
def _schedule(stack: Stack, i: int, time: float, motion: Motion, event: Event) -> None:
    """Schedule an event of contact i, or a check if it is not certain to be reached.

    Nothing is scheduled if the cluster's series ends before: its renewal schedules the contact.
    """
    wait, reached, kind = event
    horizon = motion.horizon
    if motion.root == 2:
        wait, horizon = wait * wait, horizon * horizon
    if time + wait <= time:
        reached = True  # shorter than the resolution of float64 time
    stack.event[i] = kind if reached else codes.CHECK
    due = time + wait if wait < horizon else math.inf
    schedule(stack.due, stack.heap, stack.place, i, due)


@kernel
def _is_pressed_together(stack: Stack, i: int, a: Floats, order: int) -> bool:
    """Return whether neighbouring forces begin to compress a contact that touches without force."""
    if math.isnan(stack.touching[i]):
        return False
    for k in range(order + 1):
        if a[k] != 0.0:
            return a[k] > 0.0
    return False


@kernel
def _level_wait(
    stack: Stack, motion: Motion, sign: float, level: float, band: float, limit: float
) -> tuple[float, bool]:
    """Return how long the compression surely stays on one side of a level; see `_safe_wait`."""
    order, power, tail = motion.order, motion.power, motion.tail
    return _safe_wait(stack, stack.watched, order, power, tail, 0.0, sign, level, band, limit)


@kernel
def _safe_wait(
    stack: Stack,
    a: Floats,
    order: int,
    power: int,
    tail: float,
    more: float,
    sign: float,
    level: float,
    band: float,
    horizon: float,
) -> tuple[float, bool]:
    """Return a time s during which sign (f - level) surely stays above -band/2.

    The second result is True if it reaches -band/2 at s, and False if s is only a lower bound of
    that time. The function f differs from its power series ``a`` by at most
    ``tail s^power + more s^(power+1)``.
    """
    if tail == 0.0 and order > 2 and horizon < math.inf:
        wait, reached = time_to_level(a, order, sign, level, band, horizon)
        if reached or wait == horizon:
            return wait, reached
    f = stack.margin
    for k in range(order + 1):
        f[k] = sign * a[k]
    f[0] += band - sign * level
    if f[0] <= 0.5 * band:
        return 0.0, True
    if tail == 0.0 and order > 2:
        return min(safe_step(f, order, 0.0, horizon), horizon), False
    for k in range(order + 1, power + 2):
        f[k] = 0.0
    if tail == 0.0:
        return parabola_root(f[0] - 0.5 * band, f[1], f[2]), True
    size = abs(f[0]) + band / codes.EPSILON
    # where the remainder is as large, as a power of two: the choice of units changes no bit
    natural = times_power_of_two(8.0, exponent_of(size / tail) // power)
    if order < power and more == 0.0:
        return safe_step(f, power - 1, tail, min(natural, horizon)), False
    f[power] -= tail
    f[power + 1] -= more
    return safe_step(f, max(order, power + 1), 0.0, min(natural, horizon)), False
