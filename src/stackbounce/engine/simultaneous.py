"""Simultaneous, finite contacts: from event to event, each cluster on its own solution.

Every contact is looked at no later than it could possibly have changed its phase, so that no event
is missed; the earliest due comes next, at a tie the lowest contact. What an event touches is the
clusters beside it and nothing else.
"""

import math

from stackbounce.engine.codes import (
    ABSENT,
    CLIPPED,
    COMPRESSING,
    CONTACT,
    EPSILON,
    EVENT_LIMIT,
    FINISHED,
    IMPULSE,
    INVALID,
    KIND,
    LOG_COLUMNS,
    LOOK,
    LOWER_VELOCITY,
    OPEN,
    PEAK,
    PEAK_COMPRESSION,
    PEAK_FORCE,
    RELEASE,
    RESUMED,
    RUNNING,
    SETTLED,
    SLACK,
    START,
    TIME,
    TIME_REACHED,
    TOUCH,
    UPPER_VELOCITY,
)
from stackbounce.engine.contacts import (
    begin,
    change_curve,
    changes_curve,
    clip,
    force,
    record_peak,
    reduced_mass,
    stored_energy,
    turn,
)
from stackbounce.engine.event_queue import clear, schedule
from stackbounce.engine.kernel import Floats, kernel
from stackbounce.engine.motion import (
    advance_cluster,
    compression_at,
    contact_impulse,
    flies,
    form_clusters,
    may_enter,
    rate_at,
    root_at,
    series_time,
    velocity_at,
)
from stackbounce.engine.next_event import look
from stackbounce.engine.rest import is_bound, lay_down
from stackbounce.engine.stack import Samples, Stack
from stackbounce.engine.taylor import record_crests

_COARSE = 1e-5  # of a contact's time: what the clock must tell apart
_NOTICED = 1e-3  # of the energy of approach: what a touch may store before it is noticed
_NEWTON = 4  # steps from where a sign is clear to where it changes


@kernel
def start(stack: Stack) -> None:
    """Anchor a new stack at time 0 and look at every contact for the first time."""
    size = len(stack.mass)
    clear(stack.due, stack.heap, stack.place)
    for i in range(size):
        stack.phase[i] = OPEN
        stack.curve_exponent[i] = 1.0
        stack.touching[i] = 0.0
        stack.pushed[i] = 0
    form_clusters(stack, 0, size - 1, 0.0)
    for i in range(size):
        look(stack, i, 0.0)


@kernel
def advance(stack: Stack, until: float, event_limit: int, log: Floats, samples: Samples) -> int:
    """Move a stack on until it is finished, a time or a limit is reached, or the log is full.

    Fills ``samples`` on the way and returns the status; counter[0] tells the entries in the log.
    """
    room = len(log) // LOG_COLUMNS
    size = len(stack.mass)
    if stack.counter[1] == 0 and until == math.inf and _all_part(stack):
        _sample(stack, samples, math.inf)
        return _ending(stack)
    while True:
        slot = stack.heap[0]
        time = stack.due[slot]
        if time < 0.0:
            return INVALID
        _sample(stack, samples, min(time, until))
        if time > until:
            return TIME_REACHED
        if time == math.inf:
            return _ending(stack)
        if max(stack.counter[1], stack.counter[2]) >= event_limit:
            return EVENT_LIMIT
        if stack.counter[0] == room:
            return RUNNING
        stack.clock[1] = time
        if slot >= size:
            stack.counter[2] += 1
            _renew(stack, slot - size, time)
            if stack.number[0] > 0.0 and stack.counter[4] == size and is_bound(stack):
                lay_down(stack)
                _sample(stack, samples, math.inf)
                return SETTLED
        elif stack.event[slot] == LOOK:
            stack.counter[2] += 1
            _look_again(stack, slot, time)
        else:
            kind = stack.event[slot]
            _happen(stack, slot, kind, time, log)
            if kind == RELEASE and until == math.inf and _all_part(stack):
                _sample(stack, samples, math.inf)
                return _ending(stack)


@kernel
def _happen(stack: Stack, i: int, kind: int, time: float, log: Floats) -> None:
    """Apply an event of contact i."""
    stack.counter[1] += 1
    stack.counter[2] = 0
    compression = compression_at(stack, i, time)
    if kind == PEAK:
        record_peak(stack, i, compression, 0.0)
    if kind not in (TOUCH, RELEASE) and not changes_curve(stack, i, kind):
        turn(stack, i, kind, compression)
        _look_again(stack, i, time)
        stack.clock[0] = time
        return
    if kind == RELEASE and stack.phase[i] == SLACK:
        _let_go(stack, i, compression, log)
        _look_again(stack, i, time)
        return
    bottom = stack.first[max(i - 1, 0)]
    top = stack.last[i]
    logical = time
    if kind in (TOUCH, RELEASE):
        logical = _crossing(stack, i, time)
    if kind == TOUCH and may_enter(stack) and logical >= stack.anchor[stack.first[i]]:
        time, compression = logical, 0.0 if logical < time else compression
    advance_cluster(stack, i, time)
    if i > 0 and stack.first[i - 1] != stack.first[i]:
        advance_cluster(stack, i - 1, time)
    if kind == TOUCH:
        begin(stack, i, logical)
        logical = stack.start[i]
        stack.compression[i] = _at_touch(stack, i, compression, time)
    elif kind == RELEASE:
        stack.phase[i] = OPEN
        stack.released[i] = logical
        stack.counter[4] -= 1
        stack.compression[i] = min(stack.compression[i], 0.0)
    elif kind == CLIPPED:
        clip(stack, i, time)
    else:
        change_curve(stack, i, kind)
    form_clusters(stack, bottom, top, time)
    changed = kind in (TOUCH, RELEASE, CLIPPED, RESUMED)
    for j in range(bottom, min(top + 2, len(stack.mass))):
        if stack.phase[j] == OPEN and changed:
            _note_push(stack, j, logical)
        look(stack, j, time)
    stack.clock[0] = max(stack.clock[0], logical)
    if kind == TOUCH and _comes_too_late(stack, i, time):
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
    if kind in (TOUCH, RELEASE):
        _write(stack, i, kind, logical, log)


@kernel
def _let_go(stack: Stack, i: int, compression: float, log: Floats) -> None:
    """Open slack contact i, whose interval was over when it was clipped: no motion changes."""
    stack.phase[i] = OPEN
    stack.released[i] = stack.clip_time[i]
    stack.counter[4] -= 1
    stack.compression[i] -= max(0.0, compression)
    _write(stack, i, RELEASE, stack.clip_time[i], log)
    at = (stack.counter[0] - 1) * LOG_COLUMNS
    log[at + LOWER_VELOCITY] = stack.clip_lower[i]
    log[at + UPPER_VELOCITY] = stack.clip_upper[i]


@kernel
def _comes_too_late(stack: Stack, i: int, time: float) -> bool:
    """Tell whether contact i, just touching, is over before the clock tells times apart.

    Balls that touch gently need no exact time: what they may miss is less than they approach by.
    """
    rate = stack.velocity[i]
    if i > 0:
        rate -= stack.velocity[i - 1]
    return 4.0 * EPSILON * time * abs(rate) > _COARSE * stack.scale[i]


@kernel
def _at_touch(stack: Stack, i: int, compression: float, time: float) -> float:
    """Return the compression with which contact i, anchored now, begins: next to none.

    Two balls whose approach was lost in the error of their speeds may have come to overlap since,
    or touch so slowly that what noticing it takes would store more energy than they bring.
    """
    rate = stack.velocity[i]
    if i > 0:
        rate -= stack.velocity[i - 1]
    known = max(100.0 * stack.number[2], 1e-12) * stack.scale[i]
    known += 64.0 * EPSILON * time * abs(rate)
    brought = 0.5 * reduced_mass(stack, i) * rate * rate
    if compression > known or stored_energy(stack, i, compression) > _NOTICED * brought:
        return 0.0
    return max(compression, 0.0)


@kernel
def _note_push(stack: Stack, i: int, time: float) -> None:
    """Keep since when open contact i, if it is touching, can have been pressed by its neighbours.

    That is since the first of them pressed: what comes later finds it pressed already, though by
    less than its round-off.
    """
    idle = flies(stack, i) and (i == 0 or flies(stack, i - 1))
    if stack.pushed[i] == 0 or idle or math.isnan(stack.touching[i]):
        stack.touching[i] = max(time, stack.released[i])
    stack.pushed[i] = 0 if idle else 1


@kernel
def _crossing(stack: Stack, i: int, time: float) -> float:
    """Return when the compression of contact i, just past zero at a time, was zero."""
    earliest = stack.clock[0]
    if root_at(stack, i) == 2:  # there is no such root before the anchors
        earliest = max(earliest, stack.anchor[stack.first[i]])
        if i > 0:
            earliest = max(earliest, stack.anchor[stack.first[i - 1]])
    crossing = time
    for _ in range(_NEWTON):
        compression = compression_at(stack, i, crossing)
        rate = rate_at(stack, i, crossing)
        if compression * rate <= 0.0:
            break
        crossing -= compression / rate
        if crossing < earliest:
            return earliest
    return crossing


@kernel
def _look_again(stack: Stack, i: int, time: float) -> None:
    """Look at contact i, where it has a series in the root of time with a new one."""
    if root_at(stack, i) == 1:
        look(stack, i, time)
    elif stack.root[stack.first[i]] == 2:
        _renew(stack, i, time)
    else:
        _renew(stack, i - 1, time)


@kernel
def _renew(stack: Stack, ball: int, time: float) -> None:
    """Expand the motion of a ball's cluster anew where its series ends."""
    bottom, top = stack.first[ball], stack.last[ball]
    advance_cluster(stack, ball, time)
    form_clusters(stack, bottom, top, time)
    for j in range(bottom, min(top + 2, len(stack.mass))):
        look(stack, j, time)


@kernel
def _write(stack: Stack, i: int, kind: int, time: float, log: Floats) -> None:
    """Append an event of contact i to the log, with its balls' velocities at their anchors."""
    at = stack.counter[0] * LOG_COLUMNS
    stack.counter[0] += 1
    log[at + TIME] = time
    log[at + CONTACT] = i
    log[at + KIND] = kind
    log[at + LOWER_VELOCITY] = stack.velocity[i - 1] if i > 0 else 0.0
    log[at + UPPER_VELOCITY] = stack.velocity[i]
    log[at + START] = stack.start[i]
    log[at + PEAK_FORCE] = stack.peak_force[i]
    log[at + PEAK_COMPRESSION] = stack.peak_compression[i]
    log[at + IMPULSE] = stack.impulse[i]


@kernel
def write_unfinished(stack: Stack, time: float, log: Floats) -> None:
    """Append the intervals that are still under way at a time, as releases at infinity."""
    for i in range(len(stack.mass)):
        if stack.phase[i] == OPEN:
            continue
        if stack.phase[i] >= COMPRESSING:
            compression = compression_at(stack, i, time)
            record_peak(stack, i, compression, rate_at(stack, i, time))
            since = time - stack.anchor[stack.first[i]]
            if stack.modal[stack.first[i]] == 0:
                record_crests(stack, i, i + 1, series_time(stack, stack.first[i], since))
            stack.impulse[i] += contact_impulse(stack, i, since)
        _write(stack, i, RELEASE, math.inf, log)


@kernel
def _ending(stack: Stack) -> int:
    """Return FINISHED, or INVALID where a number got lost."""
    for velocity in stack.velocity:
        if not math.isfinite(velocity):
            return INVALID
    return FINISHED


@kernel
def _all_part(stack: Stack) -> bool:
    """Tell, with gravity, whether all contacts are open and no ball approaches what is below it."""
    if stack.number[0] == 0.0 or stack.counter[4] > 0:
        return False  # without gravity the run ends when nothing is due any more
    if _approaches(stack, stack.counter[5]):
        return False
    for i in range(len(stack.mass)):
        if _approaches(stack, i):
            stack.counter[5] = i
            return False
    return True


@kernel
def _approaches(stack: Stack, i: int) -> bool:
    """Tell whether ball i approaches what is below it."""
    if stack.law[i] == ABSENT:
        return False
    noise = stack.velocity_noise[i]
    if i > 0:
        noise += stack.velocity_noise[i - 1]
    return rate_at(stack, i, stack.clock[0]) > noise


@kernel
def _sample(stack: Stack, samples: Samples, time: float) -> None:
    """Record every ball and contact at the sample times up to a time, before its event."""
    size = len(stack.mass)
    while stack.counter[3] < len(samples.time) and samples.time[stack.counter[3]] <= time:
        now = samples.time[stack.counter[3]]
        at = stack.counter[3] * size
        position = 0.0
        for i in range(size):
            compression = compression_at(stack, i, now)
            position -= compression
            samples.position[at + i] = position
            samples.velocity[at + i] = velocity_at(stack, i, now)
            samples.compression[at + i] = compression
            rate = samples.velocity[at + i - 1] if i > 0 else 0.0
            rate -= samples.velocity[at + i]
            samples.force[at + i] = force(stack, i, compression, rate)
            samples.stored[at + i] = stored_energy(stack, i, compression)
        stack.counter[3] += 1
