"""From what was measured of a contact to the numbers of its law."""

from collections.abc import Callable, Mapping
from typing import TypeVar, cast

from stackbounce.calibration import dashpot, elastic, hunt_crossley, viscoelastic
from stackbounce.calibration.collision import Mass, reduced
from stackbounce.errors import InvalidType, InvalidValue, between, fraction, positive, shown
from stackbounce.model.laws import (
    LAWS,
    STEEPEST,
    ContactLaw,
    Dashpot,
    Hertz,
    HuntCrossley,
    Hysteretic,
    PowerLaw,
    Rigid,
    Spring,
    Viscoelastic,
)

__all__ = ["calibrate", "needed_by"]

_Law = TypeVar("_Law", bound=ContactLaw)
_Given = Mapping[str, float]


def calibrate(
    law_class: type[_Law],
    *,
    mass: Mass | None = None,
    contact_time: float | None = None,
    restitution: float | None = None,
    impact_speed: float | None = None,
    exponent: float | None = None,
) -> _Law:
    """Return the contact law of a class that has a measured contact time and restitution.

    Parameters
    ----------
    law_class : type
        The law's class, such as `HuntCrossley`.
    mass : float or (float, float), optional
        The mass in kg of the ball that bounced on a floor, or the two masses of a pair (or their
        reduced mass).
    contact_time : float, optional
        From touch to release, in s, above 0.
    restitution : float, optional
        The ratio of the relative speeds after and before, above 0 and at most 1; 0 for `Rigid` too.
    impact_speed : float, optional
        The relative speed in m/s, above 0, at which it was measured.
    exponent : float, optional
        p of the law, where the class leaves it open: needed for `PowerLaw`; by default 1.5 for
        `HuntCrossley` and 1 for `Hysteretic`.

    Returns
    -------
    law_class
        `stackbounce.restitution` and `stackbounce.contact_time` of it are what was asked for.

    Raises
    ------
    InvalidValue
        If something needed is missing or out of its range, or if the class cannot have what is
        asked for, as `Spring` cannot have a restitution below 1.
    InvalidType
        If `law_class` is no contact law's class, or a number has the wrong type.

    Notes
    -----
    Needed are, for `Rigid`, `restitution`; for all others `mass` and `contact_time`; in addition
    `restitution` for those with losses (`Dashpot`, `Viscoelastic`, `HuntCrossley`, `Hysteretic`),
    and `impact_speed` for `Viscoelastic`, `HuntCrossley` and any exponent other than 1. More than
    that may be given, so that the same measurement can be put to several classes. A `Rigid` contact
    has no contact time, whatever is given.

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley, Spring
    >>> round(calibrate(Spring, mass=0.057, contact_time=5e-3).stiffness)
    22503
    >>> measured = {"mass": 0.0567, "contact_time": 5e-3, "restitution": 0.75, "impact_speed": 3.0}
    >>> round(calibrate(HuntCrossley, **measured).dissipation, 4)
    0.1653
    """
    if not isinstance(law_class, type) or law_class not in LAWS.values():
        known = ", ".join(LAWS)
        raise InvalidType(
            f"law_class must be the class of a contact law ({known}), got {shown(law_class)}"
        )
    kind = cast("type[ContactLaw]", law_class)
    given = _checked(kind, mass, contact_time, restitution, impact_speed, exponent)
    if law_class in (Spring, Hertz, PowerLaw) and given.get("restitution", 1.0) != 1.0:
        raise InvalidValue(
            f"restitution must be 1 or left out for {law_class.__name__}, which gives back all "
            f"that it took, got {shown(restitution)}"
        )
    _check_missing(kind, given)
    try:  # where the exponent is 1, any speed will do
        return cast("_Law", _MAKERS[kind]({"impact_speed": 1.0} | given))
    except ArithmeticError:
        raise InvalidValue(
            f"what was measured must give a {kind.__name__} in the range of numbers, "
            f"got {', '.join(f'{name}={value:g}' for name, value in given.items())}"
        ) from None


def _checked(
    law_class: type[ContactLaw],
    mass: object,
    contact_time: object,
    restitution: object,
    impact_speed: object,
    exponent: object,
) -> dict[str, float]:
    """Return what is given, and the exponent that the class has or takes by default."""
    given = {}
    if mass is not None:
        given["mass"] = reduced(mass)
    if contact_time is not None:
        given["contact_time"] = positive("contact_time", contact_time, "seconds")
    if restitution is not None:
        zero = law_class is Rigid
        given["restitution"] = fraction("restitution", restitution, zero=zero)
    if impact_speed is not None:
        given["impact_speed"] = positive("impact_speed", impact_speed, "m/s")
    if exponent is not None:
        given["exponent"] = between("exponent", exponent, 1.0, STEEPEST)
    usual = _EXPONENTS.get(law_class)
    if usual is not None:
        p = given.setdefault("exponent", usual)
        if law_class not in (HuntCrossley, Hysteretic) and p != usual:
            raise InvalidValue(
                f"exponent must be {usual:g} or left out for {law_class.__name__}, "
                f"got {shown(exponent)}"
            )
    return given


_EXPONENTS: dict[type[ContactLaw], float] = {
    Spring: Spring.exponent,
    Hertz: Hertz.exponent,
    Dashpot: Dashpot.exponent,
    Viscoelastic: Viscoelastic.exponent,
    HuntCrossley: 1.5,
    Hysteretic: 1.0,
}


def needed_by(law_class: type[ContactLaw], exponent: float | None = None) -> list[str]:
    """Return what `calibrate` must be given for a class, by the names of its arguments.

    Parameters
    ----------
    law_class : type
        The law's class.
    exponent : float, optional
        Where it is given; else the class's usual one.

    Examples
    --------
    >>> needed_by(Hysteretic), needed_by(Hysteretic, 1.5)[-1]
    (['mass', 'contact_time', 'restitution'], 'impact_speed')
    """
    needed = ["restitution"] if law_class is Rigid else ["mass", "contact_time"]
    if law_class in (Dashpot, Viscoelastic, HuntCrossley, Hysteretic):
        needed.append("restitution")
    if law_class is PowerLaw:
        needed.append("exponent")
    if exponent is None:
        exponent = _EXPONENTS.get(law_class, 1.0)
    if law_class is HuntCrossley or exponent != 1.0:
        needed.append("impact_speed")
    return needed


def _check_missing(law_class: type[ContactLaw], given: _Given) -> None:
    needed = needed_by(law_class, given.get("exponent"))
    missing = [name for name in needed if name not in given]
    if missing:
        raise InvalidValue(
            f"{', '.join(missing)} must be given to calibrate {law_class.__name__}, which needs "
            f"{', '.join(needed)}"
        )


def _stiffness(given: _Given, duration: float) -> float:
    """Return k of a contact that takes `duration` in units of C/v, see `elastic`."""
    p, speed = given["exponent"], given["impact_speed"]
    peak = given["contact_time"] * speed / duration
    return elastic.stiffness(peak, p, given["mass"], speed)


def _rigid(given: _Given) -> Rigid:
    return Rigid(given["restitution"])


def _spring(given: _Given) -> Spring:
    return Spring(_stiffness(given, elastic.duration(1.0)))


def _hertz(given: _Given) -> Hertz:
    return Hertz(_stiffness(given, elastic.duration(1.5)))


def _power_law(given: _Given) -> PowerLaw:
    p = given["exponent"]
    return PowerLaw(_stiffness(given, elastic.duration(p)), p)


def _dashpot(given: _Given) -> Dashpot:
    zeta = dashpot.damping_ratio(given["restitution"])
    duration = dashpot.duration(zeta)
    # b = 2 ζ m ω0
    damping = 2.0 * zeta * given["mass"] * duration / given["contact_time"]
    return Dashpot(_stiffness(given, duration), damping)


def _viscoelastic(given: _Given) -> Viscoelastic:
    squared = viscoelastic.squared_speed(given["restitution"])
    k = _stiffness(given, viscoelastic.duration(squared))
    # v*² = 1.5 A (k/m)**0.4 v**0.2
    rate = (k / given["mass"]) ** 0.4 * given["impact_speed"] ** 0.2
    return Viscoelastic(k, squared / 1.5 / rate)


def _hunt_crossley(given: _Given) -> HuntCrossley:
    p, speed = given["exponent"], given["impact_speed"]
    d = hunt_crossley.dissipation(given["restitution"])
    return HuntCrossley(_stiffness(given, hunt_crossley.duration(d, p)), p, d / speed)


def _hysteretic(given: _Given) -> Hysteretic:
    p, e = given["exponent"], given["restitution"]
    n = Hysteretic(1.0, exponent=p, restitution=e).unloading_exponent
    k = _stiffness(given, elastic.hysteretic_duration(p, n, e))
    return Hysteretic(k, exponent=p, restitution=e)


_MAKERS: dict[type[ContactLaw], Callable[[_Given], ContactLaw]] = {
    Rigid: _rigid,
    Spring: _spring,
    Hertz: _hertz,
    PowerLaw: _power_law,
    Dashpot: _dashpot,
    Viscoelastic: _viscoelastic,
    HuntCrossley: _hunt_crossley,
    Hysteretic: _hysteretic,
}
