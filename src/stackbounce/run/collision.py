"""The restitution and the contact time of a contact law, and a drop as separate collisions."""

import math
import sys
from collections.abc import Mapping, Sequence, Set
from typing import Any, TypeAlias

from stackbounce.errors import InvalidType, InvalidValue, instance, positive, shown
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw, Rigid
from stackbounce.units import checked, in_unit

Mass: TypeAlias = float | Sequence[float]
"""In kg: the mass of a ball on a floor, or the reduced mass or both masses of a pair."""


def restitution(
    law: ContactLaw, mass: Mass | None = None, impact_speed: float | None = None
) -> float:
    """Return the restitution of a contact: the ratio of its relative speeds after and before.

    Parameters
    ----------
    law : ContactLaw
        Any contact law.
    mass : float or (float, float), optional
        The mass in kg of the ball on the floor, or the two masses of a pair (or their reduced mass
        ``m1 m2/(m1 + m2)``); needed for `Dashpot`, `StandardLinearSolid`, `Viscoelastic` and
        `Tabulated`.
    impact_speed : float, optional
        The speed in m/s at which the two meet; needed for `RigidBySpeed`, `RigidLossBySpeed`,
        `Viscoelastic`, `HuntCrossley` and `Tabulated`.

    Returns
    -------
    float
        From 0 to 1; without scatter.

    Raises
    ------
    InvalidType
        If `law` is no contact law, or a number has the wrong type.
    InvalidValue
        If `mass` or `impact_speed` is needed and missing, or is not positive and finite.

    Notes
    -----
    Springs and power laws are lossless. `Hysteretic`: R. Cross, Am. J. Phys. 75,
    1009 (2007), section V. `Dashpot`, with ``ζ = b/(2 sqrt(k m))``:
    ``e = exp(-2 ζ acos(ζ)/sqrt(1 - ζ**2))`` (T. Schwager and T. Pöschel, Granular Matter 9, 465,
    2007). `HuntCrossley`, with ``d = χ v``: ``d (1 + e) = ln((1 + d)/(1 - d e))``. `Viscoelastic`:
    a function of ``1.5 A (k/m)**0.4 v**0.2`` alone, computed by a simulation.
    `StandardLinearSolid`: a function of its relaxation strength and ``τ sqrt(k/m)``, computed by a
    simulation.

    Examples
    --------
    >>> from stackbounce.model import Dashpot, Hysteretic
    >>> restitution(Hysteretic(5.6e4, unloading_exponent=7))
    0.5
    >>> round(restitution(Dashpot(100.0, damping=2.0), mass=1.0), 6)  # ζ = 0.1
    0.744079
    """
    return _measured("restitution", law, mass, impact_speed)


def contact_time(
    law: ContactLaw, mass: Mass | None = None, impact_speed: float | None = None
) -> float:
    """Return the contact time in s of one collision, from the touch to the release.

    Parameters
    ----------
    law : ContactLaw
        Any contact law.
    mass : float or (float, float), optional
        The mass in kg of the ball on the floor, or the two masses of a pair (or their reduced mass
        ``m1 m2/(m1 + m2)``); not needed for rigid laws.
    impact_speed : float, optional
        The relative speed in m/s at the touch. Not needed for rigid laws, `Spring`, `Dashpot` and
        `StandardLinearSolid`, nor for `PowerLaw` and `Hysteretic` with the exponent 1.

    Returns
    -------
    float
        0 for rigid laws.

    Raises
    ------
    InvalidType
        If `law` is no contact law, or a number has the wrong type.
    InvalidValue
        If `mass` or `impact_speed` is needed and missing, or is not positive and finite.

    Notes
    -----
    Let C be the compression at which the contact stores the whole kinetic energy,
    ``k C**(p+1)/(p+1) = m v**2/2``. The contact time of a power law is
    ``C/v 2 sqrt(π) Γ(1 + 1/(p+1))/Γ(1/2 + 1/(p+1))``. For `Hysteretic`, loading takes half of that
    time; unloading takes half of the same expression for the unloading curve at the speed e v. For
    `Dashpot` it is ``sqrt(m/k) 2 acos(ζ)/sqrt(1 - ζ**2)``, see `restitution`. For
    all others it is computed by a simulation.

    Examples
    --------
    >>> from stackbounce.model import Hertz, Spring
    >>> round(contact_time(Spring(22500), mass=0.057), 6)
    0.005
    >>> round(contact_time(Hertz(1.0), mass=1.0, impact_speed=1.0), 6)
    3.218065
    """
    return _measured("contact time", law, mass, impact_speed)


def reduced(mass: object) -> float:
    """Return the mass in kg in one collision: one mass as it is, two as ``m1 m2/(m1 + m2)``.

    Raises
    ------
    InvalidValue
        If a mass is not positive and finite, or there are more than two or none.
    InvalidType
        If one has the wrong type.

    Examples
    --------
    >>> reduced((1.0, 1.0)), reduced(0.5)
    (0.5, 0.5)
    """
    given: Any = in_unit(mass, "kg", "mass")
    try:
        pair = () if isinstance(given, bytes | Mapping | Set) else tuple(given)
    except TypeError:  # one number
        pair = ()
    if not pair:
        return positive("mass", given, "kilograms")
    if len(pair) != 2:
        raise InvalidValue(f"mass must be a number or a pair of numbers, got {shown(mass)}")
    low, high = sorted(positive(f"mass.{i}", pair[i], "kilograms") for i in (0, 1))
    return low / (1.0 + low / high)


def _measured(what: str, law: object, mass: object, impact_speed: object) -> float:
    """Return the restitution or the contact time; mass and speed may be None if not needed."""
    if not isinstance(law, ContactLaw):
        raise InvalidType(f"law must be a contact law, got {shown(law)}")
    if what == "restitution":
        needed, compute = law.loss_depends_on, law.restitution_at
    else:
        needed, compute = law.contact_time_depends_on, law.contact_time_at
    given = {"mass": mass, "impact_speed": impact_speed}
    missing = [name for name in needed if given[name] is None]
    if missing:
        raise InvalidValue(
            f"{' and '.join(missing)} must be given, as the {what} of {type(law).__name__} "
            "depends on it, got None"
        )
    m = 1.0 if mass is None else reduced(mass)
    v = 1.0 if impact_speed is None else checked(positive, "impact_speed", impact_speed, "m/s")
    try:
        value = compute(m, v)
    except ArithmeticError:
        value = math.nan
    if not math.isfinite(value):
        raise InvalidValue(
            f"law, mass and impact_speed must give a {what} in the range of numbers, "
            f"got {shown(law)}"
        )
    return value


def separate(drop: Drop) -> Drop:
    """Return a drop with rigid contacts: the textbook model of separate collisions.

    Parameters
    ----------
    drop : Drop
        Any drop.

    Returns
    -------
    Drop
        The same drop, in which each contact is `Rigid` with the restitution of its former law.
        Gravity is 0, because it has no effect during an instantaneous collision.

    Raises
    ------
    InvalidType
        If `drop` is no Drop.
    InvalidValue
        If the restitution of a contact cannot be computed in floating point, or a contact is a
        `Bond`, which has none.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4.

    If the restitution depends on the speed, the closing speed of the first collision is used. For
    this speed the contacts collide once each, from the bottom up: ball 0 hits the floor at its
    start velocity, and ball i meets ball i - 1 after the collision at contact i - 1. A contact that
    would not close in this order gets the restitution at the drop's `reference_speed`. All later
    collisions of a contact have the same restitution.

    Examples
    --------
    >>> from stackbounce.model import Ball, Drop, Spring
    >>> drop = Drop([Ball(0.150), Ball(0.057)], [Spring(2500), Spring(1000)], impact_speed=3.53)
    >>> separate(drop).contacts
    (Rigid(restitution=1.0), Rigid(restitution=1.0))
    """
    instance("drop", drop, Drop)
    rigid = drop.replace(contacts=_collisions(drop))
    if drop.gravity == 0.0 or drop.height is None:
        return rigid.replace(gravity=0.0)
    return rigid.replace(gravity=0.0, impact_speed=drop.reference_speed)


def _collisions(drop: Drop) -> list[Rigid | None]:
    """Return each contact as `Rigid`, with its restitution in collisions from the bottom up."""
    contacts: list[Rigid | None] = []
    below = 0.0  # velocity of what lies below: the floor, then the ball after its own collision
    for i, law in enumerate(drop.contacts):
        own, mass = drop.start_velocities[i], drop.balls[i].mass
        if law is None:
            contacts.append(None)
            below = own
            continue
        moving = mass if i == 0 else reduced((drop.balls[i - 1].mass, mass))
        closing = min(below - own, sys.float_info.max)
        e = restitution(law, moving, closing if closing > 0.0 else drop.reference_speed)
        contacts.append(Rigid(e))
        # m v' = m v + (1 + e) μ (v_below - v), as eqs 1 and 2
        below = own + (1.0 + e) * moving / mass * max(0.0, closing)
    return contacts
