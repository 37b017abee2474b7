"""Simultaneous, finite contacts: from event to event, each cluster on its own solution.

Every contact is checked before it could possibly have changed its phase, so that no event is
missed. The earliest check comes first; of several at the same time, that of the lowest contact. An
event changes the clusters beside it only.
"""

import math

from stackbounce.engine import codes, slots
from stackbounce.engine.bodies import have_parted, load_floor
from stackbounce.engine.contacts import (
    approach_noise,
    approach_speed,
    change_curve,
    change_phase,
    changes_curve,
    clip,
    close_contact,
    record_peak,
    reduced_mass,
)
from stackbounce.engine.event_queue import clear_queue, schedule
from stackbounce.engine.forces import arm_energy, force, held_energy, stored_energy, surface
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.log import append_row
from stackbounce.engine.motion import (
    advance_cluster,
    allows_root_series,
    compression_at,
    contact_impulse,
    creep_at,
    form_clusters,
    is_free,
    overlap_at,
    overlap_rate_at,
    rate_at,
    root_at,
    series_time,
    velocity_at,
)
from stackbounce.engine.next_event import schedule_next_event
from stackbounce.engine.rest import is_bound, set_static_state
from stackbounce.engine.stack import Samples, Stack
from stackbounce.engine.taylor import record_series_peaks
from stackbounce.engine.work import SLICE, STANDSTILL, STEP

_COARSE = 1e-5  # of a contact's duration: the coarsest resolution of time
_NOTICED = 1e-3  # of the energy of approach: the largest energy stored before a touch is noticed
_SWINGING = 50_000  # steps since a touch or release: a stack that lies is left, if no end is set
_EXTREME = 1e4  # a ratio of the contacts' times, or root of one of masses, that explains a limit
_STIFF = 20  # so does this number of steps for each event
_NEWTON = 4  # Newton steps from a time at which the sign is certain to its change


@kernel
def begin_contacts(stack: Stack) -> None:
    """Anchor a new stack at time 0 and schedule the first event of every contact."""
    size = len(stack.mass)
    clear_queue(stack.due, stack.heap, stack.place)
    for i in range(size):
        stack.curve_exponent[i] = 1.0
        stack.touching[i] = 0.0
        if stack.bonded[i] == 1:
            close_contact(stack, i, 0.0)
    load_floor(stack)
    form_clusters(stack, 0, size - 1, 0.0)
    for i in range(size):
        schedule_next_event(stack, i, 0.0)


@kernel
def advance_contacts(
    stack: Stack, until: float, event_limit: int, work_limit: int, log: Floats, samples: Samples
) -> int:
    """Advance a stack until it is finished or a time or a limit is reached.

    Fills ``samples`` on the way and returns the status; counter[LOG_ROWS] is the length of the log.
    The status is RUNNING if the log is full, or after a slice of work: the caller continues.
    """
    size = len(stack.mass)
    room = len(log) // codes.LOG_COLUMNS - size  # the rest is for `log_unfinished`
    pause = min(stack.counter[slots.WORK] + SLICE, work_limit)
    if stack.counter[slots.STEPS] == 0 and until == math.inf and _all_separating(stack):
        _record_samples(stack, samples, math.inf)
        return _final_status(stack)
    while True:
        slot = stack.heap[0]
        time = stack.due[slot]
        if time < 0.0:
            return codes.INVALID
        _record_samples(stack, samples, min(time, until))
        if time > until:
            return codes.TIME_REACHED
        if time == math.inf:
            return _final_status(stack)
        if stack.counter[slots.WORK] >= pause and pause < work_limit:
            return codes.RUNNING
        if stack.counter[slots.WORK] >= pause or _meets_limit(stack, until, event_limit):
            stack.counter[slots.CAUSE] = _cause_of_limit(stack)
            return codes.EVENT_LIMIT
        if stack.counter[slots.LOG_ROWS] == room:
            return codes.RUNNING
        stack.number[slots.LAST_CHECK] = time
        stack.counter[slots.STEPS] += 1
        stack.counter[slots.WORK] += STEP
        if slot >= size:
            stack.counter[slots.CHECKS] += 1
            _expand_again(stack, slot - size, time)
            if _lies(stack) and is_bound(stack):
                set_static_state(stack)
                _record_samples(stack, samples, math.inf)
                return codes.SETTLED
            if until == math.inf and _is_over(stack, time, samples):
                return _final_status(stack)
        elif stack.event[slot] == codes.CHECK:
            stack.counter[slots.CHECKS] += 1
            _reschedule(stack, slot, time)
        else:
            kind = stack.event[slot]
            _apply_event(stack, slot, kind, time, log)
            if kind == codes.RELEASE and until == math.inf and _all_separating(stack):
                _record_samples(stack, samples, math.inf)
                return _final_status(stack)


@kernel
def _meets_limit(stack: Stack, until: float, event_limit: int) -> bool:
    """Return whether a run ends because it has had too many events, or steps between two of them.

    A stack that lies is left where no contact has opened or closed for long, if no end is set.
    """
    if max(stack.counter[slots.EVENTS], stack.counter[slots.CHECKS]) >= event_limit:
        return True
    steps = stack.counter[slots.STEPS]
    swings = steps - stack.counter[slots.STEPS_BEFORE] >= _SWINGING
    return swings and until == math.inf and _lies(stack)


@kernel
def _cause_of_limit(stack: Stack) -> int:
    """Return the code of why a run has met a limit."""
    lightest, heaviest, shortest, longest = math.inf, 0.0, math.inf, 0.0
    for i in range(len(stack.mass)):
        lightest, heaviest = min(lightest, stack.mass[i]), max(heaviest, stack.mass[i])
        if stack.law[i] != codes.ABSENT:
            shortest, longest = min(shortest, stack.scale[i]), max(longest, stack.scale[i])
    if longest > _EXTREME * shortest or heaviest > _EXTREME * _EXTREME * lightest:
        return codes.EXTREME
    stiff = not _lies(stack) and stack.counter[slots.STEPS] > _STIFF * stack.counter[slots.EVENTS]
    return codes.STIFF if stiff else codes.ENDLESS


@kernel
def _is_over(stack: Stack, time: float, samples: Samples) -> bool:
    """Return whether bodies have parted for good; they are followed on to the last sample."""
    if stack.counter[slots.BONDS] == 0:
        return False
    return stack.counter[slots.NEXT_SAMPLE] == len(samples.time) and have_parted(stack, time)


@kernel
def _lies(stack: Stack) -> bool:
    """Return whether all balls are pressed together by their weight."""
    return stack.number[slots.GRAVITY] > 0.0 and stack.counter[slots.CLOSED] == len(stack.mass)


@kernel
def _apply_event(stack: Stack, i: int, kind: int, time: float, log: Floats) -> None:
    """Apply an event of contact i."""
    if time <= stack.number[slots.LAST_EVENT]:
        stack.counter[slots.WORK] += STANDSTILL
    stack.counter[slots.EVENTS] += 1
    stack.counter[slots.CHECKS] = 0
    if kind in (codes.TOUCH, codes.RELEASE):
        stack.counter[slots.STEPS_BEFORE] = stack.counter[slots.STEPS]
    compression = compression_at(stack, i, time)
    if kind == codes.PEAK:
        record_peak(stack, i, compression, force(stack, i, compression, 0.0, 0.0), time)
    if kind not in (codes.TOUCH, codes.RELEASE) and not changes_curve(stack, i, kind):
        change_phase(stack, i, kind)
        _reschedule(stack, i, time)
        stack.number[slots.LAST_EVENT] = time
        return
    if kind == codes.RELEASE and stack.phase[i] == codes.UNLOADED:
        _open_unloaded(stack, i, compression, log)
        _reschedule(stack, i, time)
        return
    bottom = stack.first[max(i - 1, 0)]
    top = stack.last[i]
    logical = time
    if kind in (codes.TOUCH, codes.RELEASE):
        logical = _zero_crossing(stack, i, time)
    overlap = compression - surface(stack, i, creep_at(stack, i, time))
    # a dashpot presses from the touch on: its impulse up to an overlap would be missed
    jumps = stack.gain_rate[i] > 0.0 and stack.factor_exponent[i] == 0.0
    exact = (jumps or allows_root_series(stack)) and logical >= _known_since(stack, i)
    if kind == codes.TOUCH and exact:
        time, overlap = logical, 0.0 if jumps or logical < time else overlap
    advance_cluster(stack, i, time)
    if i > 0 and stack.first[i - 1] != stack.first[i]:
        advance_cluster(stack, i - 1, time)
    if kind == codes.TOUCH:
        stack.creep[i] = creep_at(stack, i, time)
        close_contact(stack, i, logical)
        logical = stack.start[i]
        overlap = _first_overlap(stack, i, overlap)
        stack.compression[i] = surface(stack, i, stack.creep[i]) + overlap
    elif kind == codes.RELEASE:
        stack.phase[i] = codes.OPEN
        stack.released[i] = logical
        stack.counter[slots.CLOSED] -= 1
        stack.compression[i] = min(stack.compression[i], surface(stack, i, stack.creep[i]))
        stack.creep_time[i] = time
    elif kind == codes.CLIPPED:
        clip(stack, i, time)
    else:
        change_curve(stack, i, kind)
    form_clusters(stack, bottom, top, time)
    changed = kind in (codes.TOUCH, codes.RELEASE, codes.CLIPPED, codes.RESUMED)
    for j in range(bottom, min(top + 2, len(stack.mass))):
        if stack.phase[j] == codes.OPEN and changed:
            _track_touching(stack, j, logical)
        schedule_next_event(stack, j, time)
    stack.number[slots.LAST_EVENT] = max(stack.number[slots.LAST_EVENT], logical)
    if kind == codes.TOUCH and _is_unresolved(stack, i, time):
        schedule(stack.due, stack.heap, stack.place, i, -math.inf)
    if kind in (codes.TOUCH, codes.RELEASE):
        _log_event(stack, i, kind, logical, log)


@kernel
def _open_unloaded(stack: Stack, i: int, compression: float, log: Floats) -> None:
    """Open unloaded contact i and log its release at the time when its force was clipped.

    No motion changes, because the force has been 0 since then.
    """
    stack.phase[i] = codes.OPEN
    stack.released[i] = stack.clip_time[i]
    stack.counter[slots.CLOSED] -= 1
    stack.compression[i] -= max(0.0, compression)
    _log_event(stack, i, codes.RELEASE, stack.clip_time[i], log)
    at = (stack.counter[slots.LOG_ROWS] - 1) * codes.LOG_COLUMNS
    log[at + codes.LOWER_VELOCITY] = stack.clip_lower[i]
    log[at + codes.UPPER_VELOCITY] = stack.clip_upper[i]


@kernel
def _is_unresolved(stack: Stack, i: int, time: float) -> bool:
    """Return whether contact i closes too fast for the resolution of float64 times.

    This is so if the balls approach by a considerable part of a typical compression within the
    round-off of the time.
    """
    passed = 4.0 * codes.EPSILON * time * abs(approach_speed(stack, i))
    return passed > _COARSE * stack.scale[i]


@kernel
def _first_overlap(stack: Stack, i: int, overlap: float) -> float:
    """Return the initial overlap of contact i, anchored now: a rounding error, or 0.

    It is 0 if the balls touch so slowly that the compression would store more energy than their
    approach has: then an approach was missed within the error of the speeds.
    """
    rate = approach_speed(stack, i)
    brought = 0.5 * reduced_mass(stack, i) * rate * rate
    stored = stored_energy(stack, i, overlap) + arm_energy(stack, i, overlap, 0.0)
    return 0.0 if stored > _NOTICED * brought else max(overlap, 0.0)


@kernel
def _track_touching(stack: Stack, i: int, time: float) -> None:
    """Update the time since which open contact i may have been touching under a neighbour's force.

    It is the time at which the first neighbouring contact began to press. The compression since
    then may be below round-off, so that the touch is detected only at a later event.
    """
    idle = is_free(stack, i) and (i == 0 or is_free(stack, i - 1))
    if stack.pushed[i] == 0 or idle or math.isnan(stack.touching[i]):
        stack.touching[i] = max(time, stack.released[i])
    stack.pushed[i] = 0 if idle else 1


@kernel
def _zero_crossing(stack: Stack, i: int, time: float) -> float:
    """Return when the overlap of contact i was zero, shortly before ``time``."""
    earliest = stack.number[slots.LAST_EVENT]
    if root_at(stack, i) == 2:  # the series has no root before its anchor
        earliest = max(earliest, stack.anchor[stack.first[i]])
        if i > 0:
            earliest = max(earliest, stack.anchor[stack.first[i - 1]])
    crossing = time
    for _ in range(_NEWTON):
        overlap = overlap_at(stack, i, crossing)
        rate = overlap_rate_at(stack, i, crossing)
        if overlap * rate <= 0.0:
            break
        crossing -= overlap / rate
        if crossing < earliest:
            return earliest
    return crossing


@kernel
def _known_since(stack: Stack, i: int) -> float:
    """Return since when the motion at open contact i is known.

    The series of what is below holds as long before its anchor as after it.
    """
    since = stack.anchor[stack.first[i]]
    if i > 0:
        first = stack.first[i - 1]
        since = max(since, 2.0 * stack.anchor[first] - stack.due[len(stack.mass) + first])
    return since


@kernel
def _reschedule(stack: Stack, i: int, time: float) -> None:
    """Schedule the next event of contact i.

    A series in the square root of time is first renewed: it can be expanded about its anchor only.
    """
    if root_at(stack, i) == 1:
        schedule_next_event(stack, i, time)
    elif stack.root[stack.first[i]] == 2:
        _expand_again(stack, i, time)
    else:
        _expand_again(stack, i - 1, time)


@kernel
def _expand_again(stack: Stack, ball: int, time: float) -> None:
    """Expand the motion of a ball's cluster about a new time."""
    bottom, top = stack.first[ball], stack.last[ball]
    advance_cluster(stack, ball, time)
    form_clusters(stack, bottom, top, time)
    for j in range(bottom, min(top + 2, len(stack.mass))):
        schedule_next_event(stack, j, time)


@kernel
def _log_event(stack: Stack, i: int, kind: int, time: float, log: Floats) -> None:
    """Append an event of contact i to the log, with its balls' velocities at their anchors."""
    below = stack.velocity[i - 1] if i > 0 else 0.0
    at = append_row(log, stack.counter, kind, i, stack.start[i], time, below, stack.velocity[i])
    log[at + codes.PEAK_FORCE] = stack.peak_force[i]
    log[at + codes.PEAK_TIME] = stack.peak_time[i]
    log[at + codes.PEAK_COMPRESSION] = stack.peak_compression[i]
    log[at + codes.IMPULSE] = stack.impulse[i]


@kernel
def log_unfinished(stack: Stack, time: float, log: Floats) -> None:
    """Log the contact intervals that have not ended at a time as releases at time infinity."""
    for i in range(len(stack.mass)):
        if stack.phase[i] == codes.OPEN or stack.bonded[i] == 1:
            continue
        if stack.phase[i] >= codes.COMPRESSING:
            compression = compression_at(stack, i, time)
            rate, creep = rate_at(stack, i, time), creep_at(stack, i, time)
            record_peak(stack, i, compression, force(stack, i, compression, rate, creep), time)
            since = time - stack.anchor[stack.first[i]]
            if stack.modal[stack.first[i]] == 0:
                record_series_peaks(stack, i, i + 1, series_time(stack, stack.first[i], since))
            stack.impulse[i] += contact_impulse(stack, i, since)
        _log_event(stack, i, codes.RELEASE, math.inf, log)


@kernel
def _final_status(stack: Stack) -> int:
    """Return FINISHED, or INVALID if a velocity is not finite."""
    for velocity in stack.velocity:
        if not math.isfinite(velocity):
            return codes.INVALID
    return codes.FINISHED


@kernel
def _all_separating(stack: Stack) -> bool:
    """Tell, with gravity, whether all contacts are open and no ball approaches the one below it."""
    if stack.number[slots.GRAVITY] == 0.0 or stack.counter[slots.CLOSED] > 0:
        return False  # without gravity the run ends when no event is due
    if _approaches(stack, stack.counter[slots.APPROACHING]):
        return False
    for i in range(len(stack.mass)):
        if _approaches(stack, i):
            stack.counter[slots.APPROACHING] = i
            return False
    return True


@kernel
def _approaches(stack: Stack, i: int) -> bool:
    """Return whether ball i approaches the ball below it, or the floor."""
    if stack.law[i] == codes.ABSENT:
        return False
    rate = overlap_rate_at(stack, i, stack.number[slots.LAST_EVENT])
    return rate > approach_noise(stack, i)


@kernel
def _record_samples(stack: Stack, samples: Samples, time: float) -> None:
    """Record every ball and contact at the sample times up to a time, before its event."""
    size = len(stack.mass)
    while (
        stack.counter[slots.NEXT_SAMPLE] < len(samples.time)
        and samples.time[stack.counter[slots.NEXT_SAMPLE]] <= time
    ):
        now = samples.time[stack.counter[slots.NEXT_SAMPLE]]
        at = stack.counter[slots.NEXT_SAMPLE] * size
        position = 0.0
        for i in range(size):
            compression = compression_at(stack, i, now)
            position -= compression
            samples.position[at + i] = position
            samples.velocity[at + i] = velocity_at(stack, i, now)
            samples.compression[at + i] = compression
            rate = samples.velocity[at + i - 1] if i > 0 else 0.0
            rate -= samples.velocity[at + i]
            creep = creep_at(stack, i, now)
            samples.force[at + i] = force(stack, i, compression, rate, creep)
            samples.stored[at + i] = held_energy(stack, i, compression, creep)
        stack.counter[slots.NEXT_SAMPLE] += 1
