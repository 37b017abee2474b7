"""The analysis of a force record: its contacts, their times, peaks and impulses."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stackbounce.errors import InvalidValue, counted
from stackbounce.library_types import Dataset
from stackbounce.measure.kinds.waveform.baseline import first_guess, quiet_parts
from stackbounce.measure.kinds.waveform.contact import Seen, measure_contact
from stackbounce.measure.kinds.waveform.hum import regression
from stackbounce.measure.kinds.waveform.intervals import (
    Stretch,
    find_stretches,
    no_contact,
    smoothed,
    which_sign,
)
from stackbounce.measure.kinds.waveform.peaks import flat_top
from stackbounce.measure.kinds.waveform.record import Record, read_record, undrooped
from stackbounce.measure.kinds.waveform.result import Contact, Waveform
from stackbounce.measure.kinds.waveform.ringing import ringing_of
from stackbounce.measure.kinds.waveform.shapes import UNTOLD, Ends, ends_of
from stackbounce.measure.messages import PART, Message, OptionHint
from stackbounce.measure.quantities import Array, Mask, known_to, measured_if_given, nominal
from stackbounce.measure.samples import runs
from stackbounce.model.laws import ContactLaw

_MARGIN = 0.2  # of a contact's length, on each side of it, that does not count as quiet
_HIGH = 0.25  # of the largest value, below which only hum and noise are sought at first
_SMOOTHED = 1e-4  # s of averages, so that noise does not break high parts into short ones
_MANY_EQUAL, _EQUAL = 5, 0.02  # pulses, and the share by which their peaks differ at most
_FULL = 0.8  # of peak times duration: the impulse of a square pulse of slow edges; a sine has 0.64
_ROUNDS = 4  # of finding baseline and contacts by each other; later ones change nothing
_MOST_CONTACTS = 120  # of a record of bounces
_FEW_SAMPLES = 6  # of a contact, below which a note says so
_CLEAR_DROP = 5.0  # standard errors by which the baseline is lower after a contact
_STEEP = 0.85  # exponent of a touch that is too small for any spring
_SOFT = 2.5  # exponent of a release, above which its errors are too small (Hysteretic, 0.7: 2.8)
_SOFT_END = "the force ends so softly that the release may be off by more than its error"
_CLEARLY_STEEP = 3.0  # standard errors by which it is below 1


def waveform(
    data: Dataset | Sequence[ArrayLike],
    *,
    mass: Any = None,
    impact_speed: Any = None,
    time_constant: float | None = None,
    law: "ContactLaw | type[ContactLaw] | str | None" = None,
    exponent: float | None = None,
) -> Waveform:
    """Find the contacts of a force record: their starts and ends, peaks and impulses.

    Parameters
    ----------
    data : xarray.Dataset or (array_like, array_like)
        A record as `read` gives it, whose first force (N) or voltage (V) is analysed; or times in s
        and values. Values need no calibration.
    mass : float or UFloat, optional
        Of the ball in kg: gives the dynamic stiffness.
    impact_speed : float or UFloat, optional
        In m/s: kept with the result, for `Waveform.parts` and a law's constants.
    time_constant : float, optional
        RC in s of a piezo sensor and its amplifier: the droop is corrected.
    law : ContactLaw, its class or its name, optional
        Of the contact, if it is known: touch and release are then more accurate. `Rigid` has no
        effect.
    exponent : float, optional
        Of the loading curve of a law that has one to choose; default unknown.

    Returns
    -------
    Waveform
        Without contacts if nothing exceeds the noise; a note says so.

    Raises
    ------
    InvalidValue
        If the record holds no waveform or too few samples, or an option makes no sense.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    The force crosses a threshold later than the touch. Therefore touch and release are found by a
    fit of the flanks of a contact with the curves of `shapes`. Without a `law` these are powers of
    the time since the touch, with corrections. The prior of the exponent is 1 (a linear spring) to
    1.5 (Hertz's law) or, less probably, up to 2.5 for a touch, and 1 to 2.5 or more for a release,
    as lossy contacts end softly. The prior matters only where samples are few or noise is high; the
    error bars include it. They do not include touches that begin with a jump (`Dashpot`) or as the
    root of the time (`Viscoelastic`), which are found too early, nor releases of very lossy
    contacts (a restitution below 0.75 or so, or below 0.85 if another ball still presses), which a
    note tells by their exponent: give the law there, if no other ball presses.

    A law that is given is taken as exact: the errors are those for this law, and for a ball that
    touches no other ball at its touch and release. Where the noise is as low as 0.1 % of the peak,
    the errors of exponents of 2 and more and those of the releases of `Hysteretic` and
    `Viscoelastic` contacts are too small.

    Examples
    --------
    >>> import numpy as np
    >>> times = np.arange(0.0, 0.012, 1e-5)
    >>> force = 200.0 * np.sin(np.pi * np.clip(times - 3e-3, 0.0, 4e-3) / 4e-3)
    >>> force += np.random.default_rng(1).normal(0.0, 1.0, len(times))
    >>> found = waveform((times, force), mass=0.1)
    >>> print(f"{found.contacts[0].time * 1e3:.1uS} ms, {found.stiffness / 1e3:.1uS} kN/m")
    3.999(7) ms, 61.7(2) kN/m
    """
    ends = ends_of(law, exponent)
    m = measured_if_given("mass", mass, "kilograms")
    v = measured_if_given("impact_speed", impact_speed, "m/s")
    record = read_record(data)
    raw = record.values
    ringing = ringing_of(record)
    if ringing is not None:
        record, inner = ringing.force(record)
        raw = raw[inner]
    seen = _see(record, raw)
    if time_constant is not None:
        record = _undrooped(record, seen, time_constant)
        seen = _see(record, raw)
    seen = seen._replace(ringing=ringing)
    if len(seen.stretches) > _MOST_CONTACTS:
        got = (
            f"data must hold the contacts of a bounce or of a few, up to {_MOST_CONTACTS}, got "
            f"{len(seen.stretches)} stretches above the noise: an oscillation, or a record of "
            "which the bounces are a part? "
        )
        raise InvalidValue(Message(got, PART, " choose it"))
    unlike = len(seen.stretches) - len(_alike(seen))
    seen, contacts = _contacts(seen, ends)
    if _are_square(contacts):
        unlike, contacts = unlike + len(contacts), ()
    notes = _notes(record.unit, seen, contacts, m, unlike)
    if time_constant is None:
        notes += _droops(seen, record.step)
    if ends == UNTOLD:
        notes += _steep(contacts)
        ends_as = [contact.exponents[1] for contact in contacts]
        notes += [_SOFT_END] * any(power and power.nominal_value > _SOFT for power in ends_as)
    zero = seen.zero
    return Waveform(
        contacts=contacts,
        unit=record.unit,
        noise=zero.noise,
        baseline=known_to(float(np.median(zero.base.values)), zero.error),
        hum=zero.base.height,
        sign=seen.sign,
        step=record.step,
        notes=(*record.notes, *notes),
        mass=m,
        impact_speed=v,
        times=record.times,
        force=seen.signal,
    )


def _see(record: Record, raw: Array) -> Seen:
    """Find baseline and contacts by iteration, as each depends on the other."""
    quiet = np.zeros(len(record.times), dtype=bool)
    zero = quiet_parts(record, quiet, hum=False)
    width = 2 * int(0.5 * _SMOOTHED / record.step) + 1
    bare = smoothed(np.abs(record.values - zero.base.values), width)
    high = [Stretch(int(a), int(b)) for a, b in zip(*runs(bare > _HIGH * bare.max()), strict=True)]
    humming = quiet_parts(record, _outside(len(bare), high), hum=True)
    zero = humming if humming.base.height else zero
    stretches: list[Stretch] = []
    short, own = 0, 1
    for k in range(_ROUNDS):
        bare = record.values - zero.base.values
        own = which_sign(bare, zero.noise)
        stretches, short = find_stretches(own * bare, zero.noise, zero.density)
        quiet = _outside(len(bare), stretches)
        zero = quiet_parts(record, quiet, hum=k > 0 or bool(humming.base.height))
    signal = own * (record.values - zero.base.values)
    times, quantum = record.times, record.quantum
    return Seen(times, signal, own * raw, quantum, zero, quiet, stretches, short, own)


def _contacts(seen: Seen, ends: Ends) -> tuple[Seen, tuple[Contact, ...]]:
    """Measure the contacts; those that begin before the one before them ends are one with it."""
    kept = _alike(seen)
    around = [None, *kept, None]
    contacts = tuple(
        measure_contact(seen, around[k], stretch, around[k + 2], ends)
        for k, stretch in enumerate(kept)
    )
    joined: list[Stretch] = kept[:1]
    for one, (before, after) in zip(kept[1:], pairwise(contacts), strict=True):
        end, start = before.end, after.start
        if end is not None and start is not None and end.nominal_value > start.nominal_value:
            joined[-1] = Stretch(joined[-1].first, one.last)
        else:
            joined.append(one)
    seen = seen._replace(stretches=joined)
    return (seen, contacts) if len(joined) == len(kept) else _contacts(seen, ends)


def _alike(seen: Seen) -> list[Stretch]:
    """Return the stretches that are like contacts of balls."""
    noisy = seen.zero.noise > seen.quantum  # so that a flat top is a clipped one
    parts = ((part, slice(part.first, part.last + 1)) for part in seen.stretches)
    return [
        part
        for part, own in parts
        if not no_contact(seen.signal[own], clipped=noisy and flat_top(seen.raw[own], seen.quantum))
    ]


def _are_square(contacts: tuple[Contact, ...]) -> bool:
    """Return whether pulses are equally high and full, as those of a generator."""
    whole = [contact for contact in contacts if contact.time is not None]
    if len(whole) < _MANY_EQUAL or any(contact.clipped for contact in contacts):
        return False
    peaks = np.array([nominal(contact.peak_force) for contact in whole])
    areas = [nominal(contact.impulse) / nominal(contact.time) for contact in whole]
    equal = float(np.ptp(peaks)) < _EQUAL * peaks.max()
    return equal and float(np.median(areas / peaks)) > _FULL


def _outside(count: int, stretches: list[Stretch]) -> Mask:
    """Return which samples are outside all contacts, with a margin."""
    quiet = np.ones(count, dtype=bool)
    ends = [-1, *(stretch.last for stretch in stretches)]
    starts = [*(stretch.first for stretch in stretches), count]
    for k, one in enumerate(stretches):
        margin = int(_MARGIN * len(one)) + 2
        before, after = (one.first - ends[k]) // 3, (starts[k + 1] - one.last) // 3
        quiet[one.first - min(margin, before) : one.last + min(margin, after) + 1] = False
    return quiet


def _undrooped(record: Record, seen: Seen, time_constant: float) -> Record:
    """Return the record with its droop corrected; its level is that before the first contact."""
    before = seen.quiet.copy()
    if seen.stretches:
        before[seen.stretches[0].first :] = False
    level = float(record.values[before].mean()) if before.any() else first_guess(record)[0]
    values = level + undrooped(record.times, record.values - level, time_constant)
    return replace(record, values=values)


def _notes(
    unit: str, seen: Seen, contacts: tuple[Contact, ...], mass: Any, unlike: int
) -> list[str]:
    """Return the notes on a record."""
    notes = []
    of = f" {unit}" if unit else ""
    if seen.ringing is not None:
        notes.append(
            f"the sensor rings at {seen.ringing.frequency:.0f} Hz with a damping ratio of "
            f"{seen.ringing.damping:.2g}, as it shows after a contact: this was taken off at the "
            "cost of accuracy; a stiffer sensor or mount rings above 5 / contact time"
        )
    if unlike:
        notes.append(
            f"{unlike} of the stretches above the noise are no contacts of balls: they jump "
            "between two levels, or jump up and fade out; is it the record of a force?"
        )
    elif not contacts:
        high = float(np.max(np.abs(seen.signal)))
        notes.append(
            f"no contact stands out of the noise of {seen.zero.noise:.3g}{of} (largest deviation "
            f"{high:.3g}): record with a more sensitive channel"
        )
    if seen.short:
        notes.append(
            f"{counted(seen.short, 'peak')} of one or two samples ignored: "
            "if these are contacts, sample faster"
        )
    if any(contact.clipped for contact in contacts):
        cut = [s for s, one in zip(seen.stretches, contacts, strict=True) if one.clipped]
        top = max(cut, key=len)
        height = seen.sign * float(seen.raw[top.first : top.last + 1].max())
        where = f" in {len(cut)} contacts" if len(cut) > 1 else ""
        notes.append(f"clipped at {height:.4g}{of}{where}: peak force and impulse are lower limits")
    if contacts and contacts[0].start is None:
        notes.append("the record begins within a contact: its touch is unknown")
    if contacts and contacts[-1].end is None:
        notes.append("the record stops within a contact: its release is unknown")
    few = min((contact.samples for contact in contacts), default=_FEW_SAMPLES)
    if few < _FEW_SAMPLES:
        notes.append(f"only {few} samples in a contact: times and peaks are coarse, sample faster")
    if seen.zero.base.height:
        hum = f"{seen.zero.base.height:.3g}{of}"
        notes.append(f"hum of {seen.zero.base.frequency:.0f} Hz was subtracted, amplitude {hum}")
    whole = next((contact for contact in contacts if contact.time is not None), None)
    if mass is not None and whole is not None and len(whole.peaks) > 1:
        notes.append(
            f"the first contact has {len(whole.peaks)} peaks: its stiffness supposes one ball on "
            "one spring"
        )
    return notes


def _steep(contacts: tuple[Contact, ...]) -> list[str]:
    """Return a note if the force begins more steeply than as a power, as damped contacts do."""
    power = contacts[0].exponents[0] if contacts else None
    if power is None or power.nominal_value > min(_STEEP, 1.0 - _CLEARLY_STEEP * power.std_dev):
        return []
    steep = (
        "the force begins more steeply than that of any spring, as if with a jump: the touch found "
        "may be too early; if the contact is damped, tell its law, "
    )
    return [Message(steep, OptionHint({"law": "dashpot"}), " or viscoelastic")]


def _droops(seen: Seen, step: float) -> list[str]:
    """Return a note if the baseline is lower after the first contact, an effect of a high-pass."""
    if not seen.stretches or seen.zero.base.height:
        return []
    one = seen.stretches[0]
    after = np.flatnonzero(seen.quiet[one.last :])[: max(8, len(one) // 2)] + one.last
    before = np.flatnonzero(seen.quiet[: one.first])[-max(8, len(one)) :]
    if len(after) < 4 or len(before) < 4:
        return []
    part = np.concatenate([before, after])
    times = seen.times[part] - seen.times[one.first]
    columns = np.column_stack([part > one.last, np.ones_like(times), times])  # a step on a drift
    weights, rest = regression(columns, seen.raw[part])
    low = float(weights[0])
    error = float(np.std(rest)) * np.sqrt(np.linalg.pinv(columns.T @ columns)[0, 0])
    top = float(smoothed(seen.signal, 3)[one.first : one.last + 1].max())
    if low > -max(_CLEAR_DROP * error, 0.005 * top):
        return []
    area = float(np.sum(seen.signal[one.first : one.last + 1])) * step
    droop = (
        f"after the contact the signal lies {-low / top:.1%} of its peak too low, as by the droop "
        "of a piezo sensor: give "
    )
    return [Message(droop, OptionHint({"time_constant": None}), f" (about {area / -low:.2g} s)")]
