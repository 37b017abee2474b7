"""One contact: its own baseline, its flanks, peaks and impulse."""

from math import hypot
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.waveform.baseline import Quiet, scatter
from stackbounce.measure.kinds.waveform.flanks import Part, fit_flank
from stackbounce.measure.kinds.waveform.hum import fit_quiet
from stackbounce.measure.kinds.waveform.intervals import Stretch
from stackbounce.measure.kinds.waveform.peaks import find_peaks, flat_top, impulse_of
from stackbounce.measure.kinds.waveform.result import Contact
from stackbounce.measure.kinds.waveform.ringing import OWN_NOISE, Ringing
from stackbounce.measure.kinds.waveform.shapes import Ends
from stackbounce.measure.quantities import Array, Mask, known_to
from stackbounce.measure.samples import quantisation_error

_BESIDE = 2  # times the contact's length: baseline that is looked at on each side
_LEAST_BESIDE = 40  # samples of baseline that are looked at on each side
_LEVEL_SAMPLES = 4  # quiet ones, at least, that tell a level
_NOISE_SAMPLES = 60  # quiet ones, at least, that tell the noise
_TAIL = 0.25  # of a contact's length that its end may still reach


class Seen(NamedTuple):
    """A record with its contacts upward and its baseline subtracted.

    Parameters
    ----------
    times, signal : ndarray
        (n,) in s and in the record's unit.
    raw : ndarray
        (n,) as recorded, but contacts upward; where the record is clipped all values are equal.
    quantum : float
        The step of the converter, 0 where none is seen.
    zero : Quiet
        Baseline and noise.
    quiet : ndarray of bool
        (n,) which samples are clear of all contacts.
    stretches : list of Stretch
        The contacts.
    short : int
        How many peaks were too short to be contacts.
    sign : int
        -1 where contacts go down in the record.
    ringing : Ringing or None
        Of the sensor; its effect is taken off the signal.
    """

    times: Array
    signal: Array
    raw: Array
    quantum: float
    zero: Quiet
    quiet: Mask
    stretches: list[Stretch]
    short: int
    sign: int
    ringing: Ringing | None = None


def measure_contact(
    seen: Seen, before: Stretch | None, one: Stretch, after: Stretch | None, ends: Ends
) -> Contact:
    """Return the times, peaks and impulse of a contact.

    Parameters
    ----------
    seen : Seen
        The record.
    before, one, after : Stretch
        The contact and its neighbours, None where it has none.
    ends : Ends
        The shapes of its flanks.

    Returns
    -------
    Contact
    """
    part = _part(seen, before, one, after)
    pad = len(one) // 20 + 2
    inner = slice(max(0, part.first - pad), part.last + pad + 1)
    ringing, density = seen.ringing, part.density
    peaks = find_peaks(part.times[inner], part.values[inner], part.noise, density)
    rise = fit_flank(part, peaks[0], ends.touch, forward=True) if one.first > 1 else None
    whole = one.last < len(seen.times) - 2
    fall = fit_flank(part, peaks[-1], ends.release, forward=False) if whole else None
    start, end = (flank.time if flank else None for flank in (rise, fall))
    if ringing is not None:
        start, end, density = ringing.end(start, 1.0), ringing.end(end, -1.0), ringing.level_density
    inside = (
        part.times[part.first] if start is None else start.nominal_value,
        part.times[part.last] if end is None else end.nominal_value,
    )
    area = impulse_of(part.times, part.values, density, part.offset, inside)
    own = 1.0 if ringing is None else OWN_NOISE
    times = [known_to(peak.time, own * peak.time_error) for peak in peaks]
    forces = [known_to(peak.force, hypot(own * peak.force_error, part.offset)) for peak in peaks]
    return Contact(
        start=start,
        end=end,
        time=None if start is None or end is None else end - start,
        peaks=tuple(zip(times, forces, strict=True)),
        peak_force=max(forces, key=lambda force: force.nominal_value),
        impulse=known_to(*area),
        rise=None if start is None else times[0] - start,
        fall=None if end is None else end - times[-1],
        exponents=(rise.exponent if rise else None, fall.exponent if fall else None),
        clipped=flat_top(seen.raw[one.first : one.last + 1], seen.quantum),
        samples=len(one),
        flanks=(rise, fall),
    )


def _part(seen: Seen, before: Stretch | None, one: Stretch, after: Stretch | None) -> Part:
    """Return a contact with the quiet samples around it, less a baseline fitted to these."""
    reach = max(_BESIDE * len(one), _LEAST_BESIDE)
    low, high = max(0, one.first - reach), min(len(seen.times) - 1, one.last + reach)
    if before is not None:
        tail = min(int(_TAIL * len(before)) + 2, (one.first - before.last) // 2)
        low = max(low, before.last + tail)
    if after is not None:
        head = min(int(_TAIL * len(after)) + 2, (after.first - one.last) // 2)
        high = min(high, after.first - head)
    times, values = seen.times[low : high + 1], seen.signal[low : high + 1]
    quiet = seen.quiet[low : high + 1]
    sides = quiet[: one.first - low].sum(), quiet[one.last - low :].sum()
    offset, noise, density = seen.zero.error, seen.zero.noise, seen.zero.density
    if sum(sides) >= _LEVEL_SAMPLES:
        middle = 0.5 * (times[0] + times[-1])
        columns = np.stack([np.ones_like(times), times - middle], axis=1)
        columns = columns if min(sides) >= _LEVEL_SAMPLES else columns[:, :1]
        values = values - fit_quiet(columns, values, quiet)
        if sum(sides) >= _NOISE_SAMPLES:
            noise, density = scatter(values[quiet], columns.shape[1], seen.quantum)
            density = max(density, 1e-6 * float(np.ptp(values)))
        level = density if seen.ringing is None else seen.ringing.level_density
        own = level / np.sqrt(sum(sides))
        offset = float(np.hypot(own, quantisation_error(seen.quantum, noise)))
    by_hum = seen.zero.density * seen.zero.base.leverage[(one.first + one.last) // 2]
    offset = float(np.hypot(offset, by_hum))
    return Part(times, values, one.first - low, one.last - low, offset, noise, density)
