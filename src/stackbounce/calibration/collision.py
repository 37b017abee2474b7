"""The restitution and the contact time of a contact law, for one collision."""

import math
from collections.abc import Mapping, Sequence, Set
from typing import Any, TypeAlias

from stackbounce.errors import InvalidType, InvalidValue, positive, shown
from stackbounce.model.laws import ContactLaw

__all__ = ["Mass", "contact_time", "reduced", "restitution"]

Mass: TypeAlias = float | Sequence[float]
"""In kg: the mass of a ball on a floor, or the reduced mass or both masses of a pair."""


def restitution(law: ContactLaw, mass: Mass | None = None, speed: float | None = None) -> float:
    """Return the restitution of a contact: the ratio of its relative speeds after and before.

    Parameters
    ----------
    law : ContactLaw
        Any contact law.
    mass : float or (float, float), optional
        The mass in kg of the ball on the floor, or the two masses of a pair (or their reduced mass
        ``m1 m2/(m1 + m2)``); needed for `Dashpot`,
        `StandardLinearSolid` and `Viscoelastic`.
    speed : float, optional
        The speed in m/s at which the two meet; needed for `RigidBySpeed`, `RigidLossBySpeed`,
        `Viscoelastic` and `HuntCrossley`.

    Returns
    -------
    float
        From 0 to 1; without scatter.

    Raises
    ------
    InvalidType
        If `law` is no contact law, or a number has the wrong type.
    InvalidValue
        If `mass` or `speed` is needed and missing, or is not positive and finite.

    Notes
    -----
    Springs and power laws are lossless. `Hysteretic`: R. Cross, Am. J. Phys. 75,
    1009 (2007), section V. `Dashpot`, with ``ζ = b/(2 sqrt(k m))``:
    ``e = exp(-2 ζ acos(ζ)/sqrt(1 - ζ**2))`` (T. Schwager and T. Pöschel, Granular Matter 9, 465,
    2007). `HuntCrossley`, with ``d = χ v``: ``d (1 + e) = ln((1 + d)/(1 - d e))``. `Viscoelastic`:
    a function of ``1.5 A (k/m)**0.4 v**0.2`` alone, computed by a simulation.
    `StandardLinearSolid`: a function of its relaxation strength and ``τ sqrt(k/m)``, in closed form
    but for the time of release.

    Examples
    --------
    >>> from stackbounce.model import Dashpot, Hysteretic
    >>> restitution(Hysteretic(5.6e4, unloading_exponent=7))
    0.5
    >>> round(restitution(Dashpot(100.0, damping=2.0), mass=1.0), 6)  # ζ = 0.1
    0.744079
    """
    return _measured("restitution", law, mass, speed)


def contact_time(law: ContactLaw, mass: Mass | None = None, speed: float | None = None) -> float:
    """Return the contact time in s of one collision, from the touch to the release.

    Parameters
    ----------
    law : ContactLaw
        Any contact law.
    mass : float or (float, float), optional
        The mass in kg of the ball on the floor, or the two masses of a pair (or their reduced mass
        ``m1 m2/(m1 + m2)``); not needed for rigid laws.
    speed : float, optional
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
        If `mass` or `speed` is needed and missing, or is not positive and finite.

    Notes
    -----
    Let C be the compression at which the contact stores the whole kinetic energy,
    ``k C**(p+1)/(p+1) = m v**2/2``. The contact time of a power law is
    ``C/v 2 sqrt(π) Γ(1 + 1/(p+1))/Γ(1/2 + 1/(p+1))``. For `Hysteretic`, loading takes half of that
    time; unloading takes half of the same expression for the unloading curve at the speed e v. For
    `Dashpot` it is ``sqrt(m/k) 2 acos(ζ)/sqrt(1 - ζ**2)``, see `restitution`. For `HuntCrossley` it
    is computed by numerical integration, for `Viscoelastic` by a simulation, for
    `StandardLinearSolid` as the zero of a force in closed form.

    Examples
    --------
    >>> from stackbounce.model import Hertz, Spring
    >>> round(contact_time(Spring(22500), mass=0.057), 6)
    0.005
    >>> round(contact_time(Hertz(1.0), mass=1.0, speed=1.0), 6)
    3.218065
    """
    return _measured("contact time", law, mass, speed)


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
    given: Any = mass
    try:
        pair = () if isinstance(mass, str | bytes | Mapping | Set) else tuple(given)
    except TypeError:  # one number
        pair = ()
    if not pair:
        return positive("mass", mass, "kilograms")
    if len(pair) != 2:
        raise InvalidValue(f"mass must be a number or a pair of numbers, got {shown(mass)}")
    low, high = sorted(positive(f"mass.{i}", pair[i], "kilograms") for i in (0, 1))
    return low / (1.0 + low / high)


def _measured(what: str, law: object, mass: object, speed: object) -> float:
    """Return the restitution or the contact time; mass and speed may be None if not needed."""
    if not isinstance(law, ContactLaw):
        raise InvalidType(f"law must be a contact law, got {shown(law)}")
    if what == "restitution":
        needed, compute = law.loss_depends_on, law.restitution_at
    else:
        needed, compute = law.contact_time_depends_on, law.contact_time_at
    given = {"mass": mass, "speed": speed}
    missing = [name for name in needed if given[name] is None]
    if missing:
        raise InvalidValue(
            f"{' and '.join(missing)} must be given, as the {what} of {type(law).__name__} "
            "depends on it, got None"
        )
    m = 1.0 if mass is None else reduced(mass)
    v = 1.0 if speed is None else positive("speed", speed, "m/s")
    try:
        value = compute(m, v)
    except ArithmeticError:
        value = math.nan
    if not math.isfinite(value):
        raise InvalidValue(
            f"law, mass and speed must give a {what} in the range of numbers, got {shown(law)}"
        )
    return value
