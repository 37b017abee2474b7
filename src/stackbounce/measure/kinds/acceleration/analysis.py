"""An accelerometer that fell and bounced -> flights, restitution of each bounce, drop height."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar

import numpy as np

from stackbounce.errors import positive
from stackbounce.measure.finding import Finding, Listed, rigid_contact
from stackbounce.measure.kinds.acceleration.series import is_held, record_of, refuse_gain, series_of
from stackbounce.measure.quantities import Array, Number, Row, known_rows, known_to, nominal
from stackbounce.measure.setup import Setup
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.units import checked

_CONTACT_SAMPLES = 6  # of a contact whose duration is given


@dataclass(frozen=True, eq=False, repr=False)
class Accelerometer(Finding):
    """The fall and the bounces of an accelerometer; made by `accelerometer`.

    Attributes
    ----------
    mean : ufloat
        The one restitution that leads from the first impact speed to the last rebound speed.
    drop_height : ufloat or None
        Of a fall from rest, in m.
    fall : ufloat or None
        From the release to the first touch, in s; None where the record does not hold it.
    flights : tuple of ufloat
        Between neighbouring bounces, in s.
    apex_heights : tuple of ufloat
        Of the flights, in m.
    impact_speeds : tuple of ufloat
        Of the bounces that have a restitution, in m/s.
    restitutions : tuple of ufloat
        Of each bounce between two flights, or between the fall and a flight. Neighbours share a
        flight, so their errors are correlated.
    contact_times : tuple of (ufloat or None)
        Of the bounces, in s; None where the sampling is too coarse.
    peaks : tuple of float
        The largest acceleration in each bounce, in m/s².
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    times, values : ndarray
        (n,) the record's times in s, and the magnitude of the acceleration in m/s², about 0 in
        flight.
    spans : tuple of (float, float)
        Of the fall and the flights, in s.
    """

    picture: ClassVar[str] = "acceleration"

    mean: Annotated[Number, Listed("restitution, mean")]
    drop_height: Annotated[Number | None, Listed("drop height", "m")]
    fall: Annotated[Number | None, Listed("time of fall", "s")]
    flights: tuple[Number, ...]
    apex_heights: tuple[Number, ...]
    impact_speeds: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    contact_times: tuple[Number | None, ...]
    peaks: tuple[float, ...]
    notes: tuple[str, ...]
    times: Array
    values: Array
    spans: tuple[tuple[float, float], ...]

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        listed = (  # values side by side, with the names and units of each
            ((self.impact_speeds, "impact speed of bounce", "m/s"),
             (self.restitutions, "restitution of bounce", "")),
            ((self.flights, "time of flight", "s"), (self.apex_heights, "height of flight", "m")),
            ((self.contact_times, "contact time of bounce", "s"),),
            ((self.peaks, "largest acceleration in bounce", "m/s^2"),),
        )  # fmt: skip
        rows = super().rows()
        for columns in listed:
            for k in range(len(columns[0][0])):
                own = [(f"{name} {k}", values[k], unit) for values, name, unit in columns]
                rows += known_rows(own)
        return rows

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact and the drop height, as in a drop's TOML."""
        parts = rigid_contact(self.mean)
        if self.drop_height is not None:
            parts["height"] = nominal(self.drop_height)
        return parts

    def law_arguments(self) -> dict[str, Any]:
        """Return the mean restitution and, after a fall, impact speed and contact time."""
        found: dict[str, Any] = {"restitution": self.mean}
        if self.fall is not None:
            found |= {"impact_speed": self.impact_speeds[0], "contact_time": self.contact_times[0]}
        return found


def analyse(data: Any, setup: Setup) -> Accelerometer:
    """Return the flights and bounces of a falling sensor."""
    return accelerometer(data, gravity=setup.gravity)


def accelerometer(data: Any, *, gravity: float = STANDARD_GRAVITY) -> Accelerometer:
    """Analyse the fall and the bounces of an accelerometer.

    An accelerometer reads zero in free flight, g at rest, and a short high pulse in a bounce. The
    flights are found, and the speeds follow from their durations: the impact speed is ``g t`` after
    a fall of duration t, and ``g T/2`` at both ends of a flight of duration T.

    Parameters
    ----------
    data : Dataset or (times, values)
        As `stackbounce.read` gives it, with gravity in it or not, or times in s and sizes of the
        acceleration in m/s², with gravity in it.
    gravity : float, optional
        In m/s², above 0.

    Returns
    -------
    Accelerometer

    Raises
    ------
    InvalidValue
        If no flights with bounces are found, or a number is out of its range.
    InvalidType
        If `data` holds no acceleration.

    Notes
    -----
    A flight begins and ends at an unknown time between two samples, which gives its error. The
    contact time of a pulse of fewer than six samples is not given, and its peak is uncertain. A
    sensor that averages over a time makes pulses longer, and flights shorter, by about this time.
    The longest series of flights with short pulses between them is used. Its first flight is a fall
    from rest if the sensor was at rest before it. Air and spin are neglected.

    A pulse is above 2 g, where it has enough samples to know. Restitutions above 1 by more than
    their errors are refused: what swings, jumps or is thrown shows the like. Where a phone has
    subtracted gravity (linear acceleration), it reads g in free flight and zero at rest; then the
    fall must begin from rest.

    Examples
    --------
    >>> import numpy as np
    >>> times = np.arange(0.0, 1.5, 0.0025)
    >>> values = np.where((times > 0.3) & (times < 1.3), 0.0, 9.81)
    >>> values[(times > 0.7) & (times < 0.705)] = 120.0  # after a fall of 0.4 s
    >>> found = accelerometer((times, values))
    >>> print(f"{found.drop_height:.1uS} m, e = {found.mean:.1uS}")
    0.775(4) m, e = 0.748(2)
    """
    g = checked(positive, "gravity", gravity, "m/s^2")
    record = record_of(data, g)
    times, values, notes = record.times, record.felt, record.notes
    series = series_of(record, g)
    starts = [_edge(times, flight.first) for flight in series]
    ends = [_edge(times, flight.last + 1) for flight in series]
    lasting = [end - start for start, end in zip(starts, ends, strict=True)]
    held = is_held(record, series[0].first, g)
    fall, flights = (lasting[0], lasting[1:]) if held else (None, lasting)
    speeds = [g * lasting[0]] * held + [g * lasts / 2.0 for lasts in flights]  # at the end of each
    before, after = speeds[:-1], speeds[1:]
    kept = [out / into for into, out in zip(before, after, strict=True)]
    refuse_gain(kept, [float(times[flight.last]) for flight in series[:-1]])
    pulses = list(pairwise(series))
    counts = [first - last - 1 for (_, last), (first, _) in pulses]
    notes += _notes(times, counts, held)
    return Accelerometer(
        fall=fall,
        flights=tuple(flights),
        drop_height=None if fall is None else g * fall**2 / 2.0,
        apex_heights=tuple(g * lasts**2 / 8.0 for lasts in flights),
        impact_speeds=tuple(before),
        restitutions=tuple(kept),
        mean=(after[-1] / before[0]) ** (1.0 / len(kept)),
        contact_times=tuple(
            starts[k + 1] - ends[k] if count >= _CONTACT_SAMPLES else None
            for k, count in enumerate(counts)
        ),
        peaks=tuple(float(values[last + 1 : first].max()) for (_, last), (first, _) in pulses),
        notes=tuple(notes),
        times=times,
        values=values,
        spans=tuple((float(times[flight.first]), float(times[flight.last])) for flight in series),
    )


def _edge(times: Array, k: int) -> Any:
    """Return a time that is uniformly distributed between samples k - 1 and k."""
    step = float(times[k] - times[k - 1])
    return known_to(0.5 * float(times[k] + times[k - 1]), step / math.sqrt(12.0))


def _notes(times: Array, counts: list[int], held: bool) -> list[str]:
    step = float(np.median(np.diff(times)))
    notes = []
    if min(counts) < _CONTACT_SAMPLES:
        notes.append(
            f"it was sampled every {1e3 * step:.2g} ms: contact times and peaks of bounces with "
            f"fewer than {_CONTACT_SAMPLES} samples, {min(counts)} here, cannot be told from it"
        )
    if held:
        notes.append("the drop height supposes a fall from rest: a hand that follows adds to it")
    else:
        notes.append("what came before the first flight is not in the record: no drop height")
    return notes
