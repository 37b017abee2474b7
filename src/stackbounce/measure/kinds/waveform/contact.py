"""One contact: its own baseline, its flanks, peaks and impulse."""

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stackbounce.measure.kinds.waveform.baseline import Quiet, scatter, stuck
from stackbounce.measure.kinds.waveform.ends import Ends
from stackbounce.measure.kinds.waveform.flanks import Flank, fit_flank
from stackbounce.measure.kinds.waveform.intervals import Stretch
from stackbounce.measure.kinds.waveform.peaks import Peak, find_peaks, flat_top, impulse_of
from stackbounce.measure.kinds.waveform.result import Contact
from stackbounce.measure.kinds.waveform.shapes import Shape
from stackbounce.measure.quantities import known_to
from stackbounce.measure.samples import Array

if TYPE_CHECKING:
    from uncertainties import UFloat

__all__ = ["Local", "measure_contact"]

_BESIDE = 2  # contacts' lengths of baseline on each side
_SOME = 4  # quiet samples that tell a level
_MANY = 60  # quiet samples that tell the noise
_LEAST = 40  # samples of baseline looked at on each side
_AVERAGES = 80  # over a contact, to see where its flanks are
_TAIL = 0.25  # of a contact's length that its end may still reach


@dataclass(frozen=True, eq=False)
class Local:
    """A record with its contacts upward and its baseline taken off.

    Parameters
    ----------
    times, signal : ndarray
        (n,) in s and in the record's unit.
    raw : ndarray
        (n,) as it was recorded, but contacts upward: at a recorder's limit all values are equal.
    level : Quiet
        What is known of the quiet parts.
    quantum : float
        The step of the converter, 0 where none is seen.
    quiet : ndarray of bool
        (n,) which samples are clear of all contacts.
    """

    times: Array
    signal: Array
    raw: Array
    level: Quiet
    quantum: float
    quiet: NDArray[np.bool_]

    @property
    def step(self) -> float:
        """The middle sampling interval in s."""
        return float(np.median(np.diff(self.times)))


@dataclass(frozen=True, eq=False)
class _Part:
    """The samples around a contact, without the baseline beside it, whose error is `offset`.

    The noise is that beside the contact, where there are samples enough to tell.
    """

    times: Array
    values: Array
    first: int
    last: int
    offset: float
    noise: float
    density: float


def measure_contact(
    local: Local, before: Stretch | None, one: Stretch, after: Stretch | None, ends: Ends
) -> Contact:
    """Return what a stretch of the record tells about a contact.

    Parameters
    ----------
    local : Local
        The record.
    before, one, after : Stretch
        The contact and its neighbours, None where it has none.
    ends : Ends
        How it may begin and end.

    Returns
    -------
    Contact
    """
    part = _part(local, before, one, after)
    pad = len(one) // 20 + 2
    inner = slice(max(0, part.first - pad), part.last + pad + 1)
    peaks = find_peaks(part.times[inner], part.values[inner], part.noise, part.density)
    whole = one.first > 1, one.last < len(local.times) - 2
    rise = _flank(part, peaks[0], ends.touch, forward=True) if whole[0] else None
    fall = _flank(part, peaks[-1], ends.release, forward=False) if whole[1] else None
    inside = (
        rise.time if rise else float(part.times[part.first]),
        fall.time if fall else float(part.times[part.last]),
    )
    area = impulse_of(part.times, part.values, part.density, part.offset, inside)
    clipped = flat_top(local.raw[one.first : one.last + 1], local.quantum)
    return _contact(peaks, part.offset, (rise, fall), area, clipped, len(one))


def _contact(
    peaks: list[Peak],
    offset: float,
    flanks: tuple[Flank | None, Flank | None],
    area: tuple[float, float],
    clipped: bool,
    samples: int,
) -> Contact:
    start, end = (known_to(one.time, one.error) if one else None for one in flanks)
    tops: list[tuple[UFloat, UFloat]] = [
        (
            known_to(one.time, one.time_error),
            known_to(one.force, hypot(one.force_error, offset)),
        )
        for one in peaks
    ]
    powers = tuple(known_to(one.exponent, one.exponent_error) if one else None for one in flanks)
    return Contact(
        start=start,
        end=end,
        time=None if start is None or end is None else end - start,
        peaks=tuple(tops),
        peak_force=max((force for _, force in tops), key=lambda force: force.nominal_value),
        impulse=known_to(*area),
        rise=None if start is None else tops[0][0] - start,
        fall=None if end is None else end - tops[-1][0],
        exponents=(powers[0], powers[1]),
        clipped=clipped,
        samples=samples,
        flanks=flanks,
    )


def _part(local: Local, before: Stretch | None, one: Stretch, after: Stretch | None) -> _Part:
    """Return the contact with what is quiet beside it, the line through which is taken off."""
    reach = max(_BESIDE * len(one), _LEAST)
    low, high = max(0, one.first - reach), min(len(local.times) - 1, one.last + reach)
    if before is not None:
        tail = min(int(_TAIL * len(before)) + 2, (one.first - before.last) // 2)
        low = max(low, before.last + tail)
    if after is not None:
        head = min(int(_TAIL * len(after)) + 2, (after.first - one.last) // 2)
        high = min(high, after.first - head)
    times, values = local.times[low : high + 1], local.signal[low : high + 1]
    quiet = local.quiet[low : high + 1]
    sides = quiet[: one.first - low].sum(), quiet[one.last - low :].sum()
    offset, noise, density = local.level.error, local.level.noise, local.level.density
    if sum(sides) >= _SOME:
        middle = 0.5 * (times[0] + times[-1])
        columns = np.stack([np.ones_like(times), times - middle], axis=1)
        columns = columns if min(sides) >= _SOME else columns[:, :1]
        weights = np.linalg.lstsq(columns[quiet], values[quiet], rcond=None)[0]
        values = values - columns @ weights
        if sum(sides) >= _MANY:
            noise, density = scatter(values[quiet], columns.shape[1], local.quantum)
            density = max(density, 1e-6 * float(np.ptp(values)))
        offset = float(np.hypot(density / np.sqrt(sum(sides)), stuck(local.quantum, noise)))
    return _Part(times, values, one.first - low, one.last - low, offset, noise, density)


def _flank(part: _Part, peak: Peak, shape: Shape, *, forward: bool) -> Flank | None:
    """Return the flank before the first peak, or with time reversed the one after the last."""
    top = int(np.searchsorted(part.times, peak.time))
    if forward:
        times, values = part.times[: top + 1], part.values[: top + 1]
    else:
        times, values = -part.times[top - 1 :][::-1], part.values[top - 1 :][::-1]
    found = fit_flank(
        times,
        values,
        part.density,
        shape,
        peak=peak.force,
        offset=part.offset,
        length=float(part.times[part.last] - part.times[part.first]),
        width=2 * ((part.last - part.first) // _AVERAGES // 2) + 1,
    )
    return found if found is None or forward else found.reversed()
