"""The gap between two falling balls, from the delay between floor contact and ball contact.

When the lower ball touches the floor the upper one is a gap above it and falls on at the impact
speed. They touch when the gap is closed by its fall and the lower ball's displacement:

    gap(t) = v0 t + q(t),

where q is the lower ball's displacement, up-positive, as it bounces alone: on a linear spring
``-(v0/ω) sin ω t`` until it leaves the floor at ``π/ω``, and upward flight afterwards.
"""

import math
from dataclasses import dataclass
from typing import Annotated, Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import Finding, Listed, force_channels
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.result import Waveform
from stackbounce.measure.quantities import Number, measured, propagate
from stackbounce.model import Ball, Drop
from stackbounce.model.laws import ContactLaw
from stackbounce.run.driver import simulate


@dataclass(frozen=True, repr=False)
class SensorGap(Finding):
    """The delay and the gap of two balls from two sensors; made by `sensor_gap`.

    Attributes
    ----------
    gap : UFloat or None
        Between the balls as they fell, in m; None where speed or contact time are not known.
    delay : UFloat
        From the floor's first touch to that of the balls, in s.
    notes : tuple of str
        What should be known about it, a sentence each.
    """

    gap: Annotated[Number | None, Listed("gap between the balls", "m")]
    delay: Annotated[Number, Listed("delay of their touch", "s")]
    notes: tuple[str, ...]


def gap_from_delay(
    delay: Any,
    impact_speed: Any,
    *,
    contact_time: Any = None,
    mass: Any = None,
    contact: ContactLaw | None = None,
) -> Number:
    """Return the gap of two falling balls that touch a delay after the lower one's landing.

    The bounce of the lower ball alone is given either by `contact_time`, or by `contact` and
    `mass`.

    Parameters
    ----------
    delay : float or UFloat
        From the floor's first touch to that of the balls, in s.
    impact_speed : float or UFloat
        In m/s, of both balls.
    contact_time : float or UFloat, optional
        The time in s that the lower ball alone is on the floor, as on a linear spring without loss.
    mass : float or UFloat, optional
        Of the lower ball in kg.
    contact : ContactLaw, optional
        Any law of its contact with the floor; the single ball is simulated.

    Returns
    -------
    UFloat
        In m; its error follows from those of all arguments, to first order.

    Raises
    ------
    InvalidValue
        If a number is out of its range, or the bounce is given in no way or more than one.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    The paper's superball B2 on B1: a fall of 20 cm, 4.3 ms of contact, 2 ms of delay.

    >>> from uncertainties import ufloat
    >>> gap = gap_from_delay(ufloat(2e-3, 0.5e-3), 1.98, contact_time=ufloat(4.3e-3, 0.1e-3))
    >>> print(f"{gap * 1e3:.1uS} mm")
    1.3(9) mm
    """
    numbers = {"t": measured("delay", delay, "seconds")}
    numbers["v"] = measured("impact_speed", impact_speed, "m/s")
    if (contact is None) == (contact_time is None):
        got = "none" if contact is None else "both"
        raise InvalidValue(f"one of contact_time and contact must be given, got {got}")
    if contact is None:
        numbers["tau"] = measured("contact_time", contact_time, "seconds")
        return propagate(lambda **at: [_spring_gap(**at)], numbers)[0]
    numbers["mass"] = measured("mass", mass, "kilograms")
    return propagate(lambda **at: [_simulated_gap(contact, **at)], numbers)[0]


def delay(floor: Waveform, balls: Waveform) -> Number:
    """Return the time from the floor's first touch to that of the balls, from two channels.

    Parameters
    ----------
    floor, balls : Waveform
        What was found in two channels of one record, on one clock: of a sensor under the lower
        ball, and of one between the balls.

    Returns
    -------
    UFloat
        In s; negative if the balls touched first.

    Raises
    ------
    InvalidValue
        If a channel shows no contact, or begins within one.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.6e4), sb.Spring(1.6e4)]
    >>> drop = sb.Drop(balls, laws, gaps=[1e-3], height=0.2)
    >>> times = np.arange(-2e-3, 1e-2, 1e-5)  # s
    >>> forces = sb.simulate(drop).sample(np.maximum(times, 0.0)).force.values * (times >= 0.0)
    >>> forces += np.random.default_rng(1).normal(0.0, 0.5, forces.shape)
    >>> floor, balls = (waveform((times, force)) for force in forces)
    >>> later = delay(floor, balls)
    >>> round(later.nominal_value * 1e3, 1), float(sb.simulate(drop).first_touch[1].round(4)) * 1e3
    (1.8, 1.8)
    """
    starts = []
    for name, one in (("floor", floor), ("balls", balls)):
        if not one.contacts:
            raise InvalidValue(f"{name} must show a contact, got none: {'; '.join(one.notes)}")
        if one.contacts[0].start is None:
            raise InvalidValue(f"{name} must begin before the touch, got a record that does not")
        starts.append(one.contacts[0].start)
    return starts[1] - starts[0]


def sensor_gap(data: Any, *, impact_speed: Any = None, contact_time: Any = None) -> SensorGap:
    """Return the delay between the first two channels of a record, and the gap.

    Parameters
    ----------
    data : Dataset
        A waveform as `read` gives it: the first channel is the floor's.
    impact_speed : float or UFloat, optional
        In m/s.
    contact_time : float or UFloat, optional
        Of the lower ball alone on the floor, in s.

    Returns
    -------
    SensorGap

    Raises
    ------
    InvalidValue
        If there are not two channels with a contact each, the second one later.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> import xarray as xr
    >>> balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.6e4), sb.Spring(1.6e4)]
    >>> drop = sb.Drop(balls, laws, gaps=[1e-3], impact_speed=2.0)
    >>> times = np.arange(-2e-3, 1e-2, 1e-5)  # s
    >>> forces = sb.simulate(drop).sample(np.maximum(times, 0.0)).force.values * (times >= 0.0)
    >>> forces += np.random.default_rng(1).normal(0.0, 0.5, forces.shape)
    >>> columns = {name: ("time", force) for name, force in zip(("force", "force_2"), forces)}
    >>> record = xr.Dataset(columns, {"time": times})
    >>> found = sensor_gap(record, impact_speed=2.0, contact_time=4.22e-3)
    >>> abs(found.gap.nominal_value - 1e-3) < 3.0 * found.gap.std_dev < 2e-4
    True
    """
    names = force_channels(data)
    if len(names) < 2:
        raise InvalidValue(f"data must have two channels, got {', '.join(names) or 'none'}")
    later = delay(*(waveform(data[[name]]) for name in names[:2]))
    if not later.nominal_value > 0.0:
        raise InvalidValue(
            f"data must have the floor's channel first, got {names[1]} {-1e3 * later:.1uS} ms "
            f"before {names[0]}"
        )
    said = f"{names[0]} is taken as the floor's force, {names[1]} as that between the balls"
    if impact_speed is None or contact_time is None:
        missing = "impact speed" if impact_speed is None else "contact time of the lower ball alone"
        return SensorGap(None, later, (said, f"the gap needs the {missing} too"))
    return SensorGap(gap_from_delay(later, impact_speed, contact_time=contact_time), later, (said,))


def _spring_gap(t: float, v: float, tau: float) -> float:
    """Return v0 t + q(t) of a ball on a linear spring, which then flies up at v0."""
    if t <= tau:
        return v * (t - tau / math.pi * math.sin(math.pi * t / tau))
    return v * (2.0 * t - tau)


def _simulated_gap(contact: Any, t: float, v: float, mass: float) -> float:
    """Return v0 t + q(t) of a ball on any law."""
    single = simulate(Drop([Ball(mass)], [contact], impact_speed=v))
    return v * t + float(single.sampled([t])["position"][0, 0])
