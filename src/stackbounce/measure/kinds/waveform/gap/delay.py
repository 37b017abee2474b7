"""The gap between two falling balls, from the delay between floor contact and ball contact.

When the lower ball touches the floor the upper one is a gap above it and falls on at the impact
speed. They touch when the gap is closed by its fall and the lower ball's displacement:

    gap(t) = v0 t + q(t),

where q is the lower ball's displacement, up-positive, as it bounces alone: on a linear spring
``-(v0/ω) sin ω t`` until it leaves the floor at ``π/ω``, and upward flight afterwards.
"""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from stackbounce.errors import InvalidValue, fraction, shown
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.result import Waveform
from stackbounce.measure.kinds.waveform.sensor import known
from stackbounce.measure.statistics.propagation import propagate
from stackbounce.model import Ball, Drop
from stackbounce.run.driver import simulate

if TYPE_CHECKING:
    from uncertainties import UFloat

    from stackbounce.model.laws import ContactLaw

__all__ = ["delay", "delay_from_gap", "gap_from_delay"]

_Gap: TypeAlias = Callable[[float, float, float], float]
_TURNS = 200


def gap_from_delay(
    delay: Any,
    impact_speed: Any,
    *,
    mass: Any = None,
    stiffness: Any = None,
    contact_time: Any = None,
    contact: "ContactLaw | None" = None,
    restitution: float = 1.0,
) -> "UFloat":
    """Return the gap of two falling balls that touch a delay after the lower one's landing.

    The bounce of the lower ball alone is given by exactly one of `contact_time`, `stiffness` (with
    `mass`) and `contact` (with `mass` unless it is `Rigid`).

    Parameters
    ----------
    delay : float or UFloat
        From the floor's first touch to that of the balls, in s.
    impact_speed : float or UFloat
        In m/s, of both balls.
    mass : float or UFloat, optional
        Of the lower ball in kg.
    stiffness : float or UFloat, optional
        Of its contact with the floor, a linear spring, in N/m.
    contact_time : float or UFloat, optional
        The time in s that the lower ball alone is on the floor, as on a linear spring.
    contact : ContactLaw, optional
        Any law of its contact with the floor; the single ball is simulated.
    restitution : float, optional
        Of the lower ball alone, where `contact_time` or `stiffness` is given: it only sets the
        speed at which the ball leaves the floor. Default 1.

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
    gap, given = _checked(
        "delay", delay, impact_speed, mass, stiffness, contact_time, contact, restitution
    )
    result: UFloat = propagate(lambda value, v, ball: [gap(value, v, ball)], given)[0]
    return result


def delay_from_gap(
    gap: Any,
    impact_speed: Any,
    *,
    mass: Any = None,
    stiffness: Any = None,
    contact_time: Any = None,
    contact: "ContactLaw | None" = None,
    restitution: float = 1.0,
) -> "UFloat":
    """Return the delay after which two falling balls touch: the inverse of `gap_from_delay`.

    Parameters
    ----------
    gap : float or UFloat
        In m, above 0.
    impact_speed, mass, stiffness, contact_time, contact, restitution : optional
        See `gap_from_delay`.

    Returns
    -------
    UFloat
        In s.

    Raises
    ------
    InvalidValue
        As in `gap_from_delay`, or if they never touch.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> print(f"{delay_from_gap(1e-3, 1.98, contact_time=4.3e-3) * 1e3:.2f} ms")
    1.84+/-0 ms
    """
    gap_of, given = _checked(
        "gap", gap, impact_speed, mass, stiffness, contact_time, contact, restitution
    )
    result: UFloat = propagate(lambda **numbers: [_inverted(gap_of, **numbers)], given)[0]
    return result


def delay(floor: Any, balls: Any) -> "UFloat":
    """Return the time from the floor's first touch to that of the balls, from two channels.

    Parameters
    ----------
    floor, balls : Waveform or what `waveform` takes
        The two channels of one record, on one clock, or what was found in them: a sensor under the
        lower ball, and one between the balls.

    Returns
    -------
    UFloat
        In s; negative if the balls touched first.

    Raises
    ------
    InvalidValue
        If a channel shows no contact, begins within one, or holds no waveform.
    InvalidType
        If it is none.

    Examples
    --------
    >>> import stackbounce as sb
    >>> from stackbounce.synthetic.waveform import waveform as record_of
    >>> balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.6e4), sb.Spring(1.6e4)]
    >>> drop = sb.Drop(balls, laws, gaps=[1e-3], height=0.2)
    >>> record = record_of(drop, rate=1e5, noise=0.5, contacts=[0, 1], seed=1)
    >>> later = delay(record[["force"]], record[["force_2"]])
    >>> round(later.nominal_value * 1e3, 1), float(sb.simulate(drop).first_touch[1].round(4)) * 1e3
    (1.8, 1.8)
    """
    starts = []
    for name, data in (("floor", floor), ("balls", balls)):
        one = data if isinstance(data, Waveform) else waveform(data)
        if not one.contacts:
            raise InvalidValue(f"{name} must show a contact, got none: {'; '.join(one.notes)}")
        if one.contacts[0].start is None:
            raise InvalidValue(f"{name} must begin before the touch, got a record that does not")
        starts.append(one.contacts[0].start)
    return starts[1] - starts[0]


def _checked(
    name: str,
    value: Any,
    speed: Any,
    mass: Any,
    stiffness: Any,
    contact_time: Any,
    contact: Any,
    restitution: float,
) -> tuple[_Gap, dict[str, Any]]:
    """Return the gap as a function of delay, speed and ball, and the numbers that were given.

    The ball is given by its contact time on a spring, or by its mass.
    """
    ways = {"stiffness": stiffness, "contact_time": contact_time, "contact": contact}
    given = [way for way, one in ways.items() if one is not None]
    if len(given) != 1:
        raise InvalidValue(
            f"exactly one of stiffness, contact_time and contact must be given, got "
            f"{', '.join(given) or 'none'}"
        )
    m = known("mass", mass, "kilograms")
    if m is None and (
        stiffness is not None or (contact is not None and not getattr(contact, "rigid", False))
    ):
        raise InvalidValue(f"mass must be given with {given[0]}, got {shown(mass)}")
    k, tau = known("stiffness", stiffness, "N/m"), known("contact_time", contact_time, "seconds")
    if k is not None and m is not None:
        tau = math.pi * (m / k) ** 0.5
    numbers = {"value": known(name, value), "v": known("impact_speed", speed, "m/s")}
    fraction("restitution", restitution)
    if contact is None:
        return lambda t, v, ball: _spring_gap(t, v, ball, restitution), numbers | {"ball": tau}
    ball = 1.0 if m is None else m
    return lambda t, v, ball: _simulated_gap(contact, t, v, ball), numbers | {"ball": ball}


def _spring_gap(t: float, v: float, tau: float, e: float) -> float:
    """Return v0 t + q(t) of a ball on a linear spring, which then flies up at e v0."""
    if t <= tau:
        return v * (t - tau / math.pi * math.sin(math.pi * t / tau))
    return v * (t + e * (t - tau))


def _simulated_gap(contact: Any, t: float, v: float, mass: float) -> float:
    """Return v0 t + q(t) of a ball on any law."""
    single = simulate(Drop([Ball(mass)], [contact], impact_speed=v))
    return v * t + float(single.sample([t]).position.values[0, 0])


def _inverted(gap_of: _Gap, value: float, v: float, ball: float) -> float:
    """Return the delay of a gap, which grows with the delay."""
    from scipy.optimize import brentq

    high = value / v
    for _ in range(_TURNS):
        if gap_of(high, v, ball) >= value:
            break
        high *= 2.0
    else:
        raise InvalidValue(f"gap must be one that closes, got {value:g}")
    tolerances = {"xtol": 1e-15 * high, "rtol": 1e-13}
    return float(brentq(lambda t: gap_of(t, v, ball) - value, 0.0, high, **tolerances))
