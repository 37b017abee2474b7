"""The gap between two falling balls from the force on the floor, with and without the upper one."""

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from stackbounce.errors import InvalidValue, fraction
from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.result import Contact, Waveform
from stackbounce.measure.kinds.waveform.sensor import restitution_of
from stackbounce.measure.quantities import (
    Number,
    Row,
    known_to,
    measured,
    measured_if_given,
    nominal,
)
from stackbounce.measure.statistics.change_point import Kink, find_kink

_RESTITUTION = (0.75, 0.144)  # mean and deviation of the prior: uniform from 0.5 to 1
_REPEATED_WITHIN = 0.04  # relative, by which two drops from one height may differ
_EARLY = 0.33  # of the contact time alone: earlier change points do not exclude a gap of 0
_LATE = 0.6  # of the contact time alone: later a second ball may be invisible
_SAME_IMPACT = 8.0  # contact times within which a second contact belongs to the same impact


@dataclass(frozen=True, eq=False, repr=False)
class FloorGap(Finding):
    """The delay and the gap of two balls from the floor's force; made by `floor_gap`.

    Parameters
    ----------
    delay : UFloat or None
        From the floor's first touch to that of the balls, in s; None where only limits are known.
    gap : UFloat or None
        Between the balls as they fell, in m; None where only limits are known.
    delay_limits, gap_limits : (float, float)
        Limits in s and m: two standard errors each way, or those without a change point.
    gain : float
        Ratio of the stack's force to the lower ball's alone, before the balls touch.
    notes : tuple of str
        What should be known about it, a sentence each.
    stack, alone : Waveform
        The two records.
    kink : Kink
        The change point at which the two forces part.
    """

    picture: ClassVar[str] = "gap"

    delay: Number | None
    gap: Number | None
    delay_limits: tuple[float, float]
    gap_limits: tuple[float, float]
    gain: float
    notes: tuple[str, ...]
    stack: Waveform = field(repr=False)
    alone: Waveform = field(repr=False)
    kink: Kink = field(repr=False)

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        return [
            Row("gap between the balls", _limited(self.gap, self.gap_limits), "m"),
            Row("delay of their touch", _limited(self.delay, self.delay_limits), "s"),
            Row("force over that of the ball alone", self.gain),
        ]


def floor_gap(
    stack: Any,
    alone: Any,
    *,
    mass: Any = None,
    impact_speed: Any = None,
    restitution: Any = None,
) -> FloorGap:
    """Return delay and gap of two balls from the floor's force under both and under one.

    One sensor on the floor records two drops from the same height: the lower ball alone, and both.
    Until the balls touch both forces are the same; the touch is the change point after which they
    differ. One record is not enough: the force of a single ball differs so much from ball to ball
    that a dip in it need not come from a second ball.

    Parameters
    ----------
    stack, alone : Dataset or Waveform
        The two records, as `read` gives them, or what `waveform` found in them.
    mass : float or UFloat, optional
        Of the lower ball in kg: for records in N.
    impact_speed : float or UFloat, optional
        In m/s: for records in V, and records in N without a mass.
    restitution : float or UFloat, optional
        Of the lower ball alone, where the speed is needed; by default anything from 0.5 to 1.

    Returns
    -------
    FloorGap

    Raises
    ------
    InvalidValue
        If a record shows no whole contact, or neither mass nor speed is given as needed.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    The lower ball's acceleration alone is its force over its mass, or its force times
    ``v0 (1 + e)`` over its impulse. The upper ball falls on meanwhile, so that the gap is that
    acceleration integrated twice, from the touch to the kink: no law is needed. A gap that is
    closed when the lower ball has nearly left the floor is not seen: forces are too small then.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> import xarray as xr
    >>> balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.6e4), sb.Spring(1.6e4)]
    >>> both = sb.Drop(balls, laws, gaps=[1e-3], height=0.2)
    >>> one = sb.Drop(balls[:1], laws[:1], height=0.2)
    >>> random, times, records = np.random.default_rng(1), np.arange(-2e-3, 1e-2, 1e-5), []
    >>> for drop in (both, one):
    ...     force = sb.simulate(drop).sample(np.maximum(times, 0.0)).force.values[0]
    ...     force = force * (times >= 0.0) + random.normal(0.0, 0.3, len(times))
    ...     column = {"force": ("time", force, {"units": "N"})}
    ...     records.append(xr.Dataset(column, {"time": times}))
    >>> found = floor_gap(*records, mass=0.101)
    >>> abs(found.gap.nominal_value - 1e-3) < 2.0 * found.gap.std_dev < 1e-3
    True
    """
    from scipy.interpolate import make_interp_spline

    both, single = (
        record if isinstance(record, Waveform) else waveform(record) for record in (stack, alone)
    )
    pressed, free = _first("stack", both), _first("alone", single)
    touch, touch_alone = (contact.start.nominal_value for contact in (pressed, free))
    lasting = free.time.nominal_value
    times, force = both.times - touch, single.force
    since = single.times - touch_alone
    noise = float(np.hypot(both.noise, single.noise * np.sqrt(single.step / both.step)))
    kink = find_kink(times, both.force, (since, force), noise, lasting)
    felt = make_interp_spline(since, np.where((since > 0.0) & (since < lasting), force, 0.0), k=1)
    speed, fall = felt.antiderivative(1), felt.antiderivative(2)  # go on after the release
    scale = _scale(single, free, mass, impact_speed, restitution)
    limits, why = _limits(both, kink, lasting)
    low, high = (
        limit if limit in (0.0, math.inf) else scale.nominal_value * float(fall(limit))
        for limit in limits
    )
    delay = gap = None
    if not why:
        delay = known_to(kink.time, kink.error) - (pressed.start - touch)
        gap = scale * (float(fall(kink.time)) + float(speed(kink.time)) * (delay - kink.time))
    notes = (*both.notes, *_notes(kink, lasting), *why)
    return FloorGap(delay, gap, limits, (low, high), kink.gain, notes, both, single, kink)


def _limited(value: Any, limits: tuple[float, float]) -> Any:
    """Return a value or, where there is none, its limits as words."""
    low, high = limits
    if value is not None:
        return value
    if math.isinf(high):
        return "unknown"
    if low <= 0.0:
        return f"below {high:.2g}"
    return f"{low:.2g} to {high:.2g}"


def _first(name: str, found: Waveform) -> Any:
    contact = found.contacts[0] if found.contacts else None
    if contact is None or contact.time is None:
        raise InvalidValue(
            f"{name} must be the record of a bounce that it holds in full, got "
            f"{len(found.contacts)} contacts: {'; '.join(found.notes) or 'the first is cut off'}"
        )
    return contact


def _scale(alone: Waveform, contact: Contact, mass: Any, speed: Any, restitution: Any) -> Any:
    """Return the factor from the force on the lower ball alone to its acceleration."""
    if mass is not None and alone.unit == "N":
        return 1.0 / measured("mass", mass, "kilograms")
    if speed is None:
        raise InvalidValue(
            f"impact_speed must be given for a record in {alone.unit or 'no unit'}"
            + (", or mass" if alone.unit == "N" else "")
            + ", got None"
        )
    v = measured("impact_speed", speed, "m/s")
    e = measured_if_given("restitution", restitution, check=fraction)
    if e is None:
        e = restitution_of(alone.contacts, v) or known_to(*_RESTITUTION)
    return v * (1.0 + e) / contact.impulse


def _limits(both: Waveform, kink: Kink, lasting: float) -> tuple[tuple[float, float], list[str]]:
    """Return limits of the delay, and a note if the delay itself is unknown."""
    low, high = kink.time - 2.0 * kink.error, kink.time + 2.0 * kink.error
    back = _thrown_back(both, lasting)
    if kink.time - kink.error < _EARLY * lasting:
        low = 0.0
        why = "the forces part as early as with balls that touch from the start: the gap may be 0"
    elif kink.time > 0.0:
        return (low, high), []
    elif kink.pressed:
        low, high = 0.0, lasting
        why = "the second ball came before the lower one left the floor, too faintly to tell when"
    elif back is None:
        low, high = 0.0, math.inf
        why = (
            "no second ball is seen while the lower one is on the floor: it came too late, or is "
            "too light for this noise, and the gap cannot be told"
        )
    else:
        low, high = _LATE * lasting, back
        why = (
            "the force is that of the lower ball alone until that leaves the floor, and then it "
            "was thrown back: the second ball came late, and only limits can be told"
        )
    return (low, high), [why]


def _thrown_back(both: Waveform, lasting: float) -> float | None:
    """Return when the lower ball hit the floor again in the same impact, or None."""
    starts = [nominal(contact.start) for contact in both.contacts[:2] if contact.start is not None]
    back = float(np.ptp(starts))
    return back if 0.0 < back < _SAME_IMPACT * lasting else None


def _notes(kink: Kink, lasting: float) -> list[str]:
    notes = []
    if abs(kink.gain - 1.0) > _REPEATED_WITHIN:
        notes.append(
            f"before the second ball came the force was {kink.gain:.2f} times that of the lower "
            "ball alone: were both drops from the same height?"
        )
    if kink.time > _LATE * lasting:
        notes.append("the second ball came late in the contact, where little of it is to be seen")
    return notes
