"""The result of the analysis of a force record."""

from dataclasses import dataclass, field
from typing import Any, ClassVar

from stackbounce.library_types import DataArray, Dataset
from stackbounce.measure.constants import dynamic_stiffness
from stackbounce.measure.finding import Curve, Finding, channels, force_channels
from stackbounce.measure.kinds.waveform.flanks import Flank
from stackbounce.measure.quantities import Array, Number, Row, known_rows, nominal

_LISTED = 12  # contacts in a table for people


@dataclass(frozen=True, eq=False)
class Contact:
    """One contact interval of a force record, from the first touch to the last release.

    Parameters
    ----------
    start, end : UFloat or None
        In s, on the record's clock; None where the record begins or stops within the contact.
    time : UFloat or None
        The contact time in s, from touch to release.
    peaks : tuple of (UFloat, UFloat)
        Time in s and height of each maximum of the force, in order.
    peak_force : UFloat
        The greatest height; where the record is clipped it is only a lower limit.
    impulse : UFloat
        The area under the force, in s times the force's unit; a lower limit where the record is
        clipped or does not hold the whole contact.
    rise, fall : UFloat or None
        From the touch to the first peak and from the last peak to the release, in s.
    exponents : (UFloat or None, UFloat or None)
        The powers of time with which the force began and ended: 1 for a linear spring, 1.5 for
        Hertz's law, more where a lossy contact ends softly.
    clipped : bool
        Whether the top was cut off.
    samples : int
        How many samples the contact has.
    flanks : (Flank or None, Flank or None)
        The fits behind `start` and `end`, for a picture.
    """

    start: Number | None
    end: Number | None
    time: Number | None
    peaks: tuple[tuple[Number, Number], ...]
    peak_force: Number
    impulse: Number
    rise: Number | None
    fall: Number | None
    exponents: tuple[Number | None, Number | None]
    clipped: bool
    samples: int
    flanks: tuple[Flank | None, Flank | None] = field(repr=False)


@dataclass(frozen=True, eq=False, repr=False)
class Waveform(Finding):
    """A force record, and the contacts in it; made by `waveform`.

    Parameters
    ----------
    contacts : tuple of Contact
        In order; empty where nothing stands out of the noise.
    unit : str
        Of the force: ``"N"``, ``"V"`` or empty.
    noise : float
        Standard deviation of one sample, in `unit`, from the quiet parts.
    baseline : UFloat
        The level without force at the record's middle.
    hum : float
        Amplitude of the mains' hum that was subtracted, in `unit`; 0 where there is none.
    sign : int
        -1 where contacts went down in the record.
    step : float
        The sampling interval in s.
    notes : tuple of str
        What should be known about the record, a sentence each.
    mass, impact_speed : UFloat, float or None
        As they were given, in kg and m/s.
    times, force : ndarray
        (n,) the record's times in s, and its values contacts upward without baseline, droop
        corrected, for a picture.
    """

    picture: ClassVar[str] = "waveform"

    contacts: tuple[Contact, ...]
    unit: str
    noise: float
    baseline: Number
    hum: float
    sign: int
    step: float
    notes: tuple[str, ...]
    mass: Number | float | None
    impact_speed: Number | float | None
    times: Array
    force: Array

    @property
    def stiffness(self) -> Number | None:
        """Dynamic stiffness ``m (π/τ)**2`` in N/m of the first whole contact, if `mass` is known.

        It supposes one ball on one linear spring: R. Cross, Am. J. Phys. 75, 1009 (2007),
        section III.
        """
        time = self._first_time
        return None if self.mass is None or time is None else dynamic_stiffness(self.mass, time)

    @property
    def _first_time(self) -> Number | None:
        return next((contact.time for contact in self.contacts if contact.time is not None), None)

    def rows(self) -> list[Row]:
        """Return what was found as rows of a table, the most important first."""
        rows = [Row("contacts", len(self.contacts))]
        for number, contact in enumerate(self.contacts[:_LISTED], start=1):
            rows += self._rows_of(contact, f"contact {number}: " if self.contacts[1:] else "")
        if len(self.contacts) > _LISTED:
            rows.append(Row("further contacts, not listed", len(self.contacts) - _LISTED))
        if self.stiffness is not None:
            rows.append(Row("dynamic stiffness", self.stiffness, "N/m"))
        rows += [Row("noise", self.noise, self.unit), Row("baseline", self.baseline, self.unit)]
        if self.hum:
            rows.append(Row("amplitude of the subtracted hum", self.hum, self.unit))
        return rows

    def _rows_of(self, contact: Contact, start: str) -> list[Row]:
        force, area = self.unit, f"{self.unit} s".strip()
        highest: Any = contact.peak_force
        impulse: Any = contact.impulse
        if contact.clipped:
            highest, impulse = (f"above {value.nominal_value:.4g}" for value in (highest, impulse))
        rows: list[tuple[str, Any, str]] = [
            ("contact time", contact.time, "s"),
            ("touch", contact.start, "s"),
            ("release", contact.end, "s"),
            ("peaks", len(contact.peaks), ""),
            ("peak force", highest, force),
            ("impulse", impulse, area),
            ("rise", contact.rise, "s"),
            ("fall", contact.fall, "s"),
        ]
        return known_rows((start + name, value, unit) for name, value, unit in rows)

    def parts(self) -> dict[str, Any]:
        """Return what a drop can use, by the keys of its TOML: ball, contact, impact speed."""
        found: dict[str, Any] = {}
        if self.mass is not None:
            found["ball"] = {"mass": nominal(self.mass)}
        if self.stiffness is not None:
            found["contact"] = {"law": "Spring", "stiffness": nominal(self.stiffness)}
        if self.impact_speed is not None:
            found["impact_speed"] = nominal(self.impact_speed)
        return found

    def law_arguments(self) -> dict[str, Any]:
        """Return the contact time of the first whole contact, and the impact speed as given."""
        return {"contact_time": self._first_time, "impact_speed": self.impact_speed}

    def measured(self, data: Dataset) -> dict[str, str]:
        """Return the channels that are the forces of the two lowest contacts."""
        return {f"force.{i}": name for i, name in enumerate(force_channels(data)[:2])}

    def forces(self, data: Dataset, lasting: float) -> dict[str, DataArray]:
        """Return the force channels, without later bounces, which are those of another drop."""
        return {name: self._first_impact(data[name], lasting) for name in force_channels(data)}

    def _first_impact(self, channel: DataArray, lasting: float) -> DataArray:
        record = channel.dropna("time").sortby("time")
        first = self.contacts[0] if self.contacts else None
        if first is None or first.start is None:
            return record
        begin = first.start.nominal_value
        lasts = 0.0 if first.end is None else first.end.nominal_value - begin
        end = begin + max(2.0 * lasts, lasting)
        later = [contact.start for contact in self.contacts[1:] if contact.start is not None]
        beyond = [start for start in map(nominal, later) if start > end]
        return record.sel(time=slice(None, 0.5 * (end + min(beyond)))) if beyond else record

    def curves(self, data: Dataset) -> list[Curve]:
        """Return the channels; the one that was analysed without its baseline, contacts upward."""
        return channels(data, Curve("", "force", self.times, self.force, self.unit))

    def first_touch(self) -> float | None:
        """Return when the first contact begins, in s; None where the record begins within it."""
        start = self.contacts[0].start if self.contacts else None
        return None if start is None else float(start.nominal_value)
