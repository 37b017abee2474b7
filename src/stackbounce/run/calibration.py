"""Calibration: the law of a contact from its measured contact time and restitution."""

from typing import TypeVar

from stackbounce.errors import InvalidType, InvalidValue, between, fraction, positive, shown
from stackbounce.model.laws import LAWS, STEEPEST, ContactLaw
from stackbounce.model.laws.registry import UNLISTED
from stackbounce.run.collision import Mass, reduced
from stackbounce.units import checked, in_unit

_TIMES = ("contact_time", "relaxation_time", "buckling_time", "decay_time")
_UNITS = dict.fromkeys(_TIMES, "seconds") | {"impact_speed": "m/s", "frequency": "Hz"}
_KNOWN_BESIDES = {"relaxation_time", "buckling_time", "buckling_share"}

_Law = TypeVar("_Law", bound=ContactLaw)


def calibrate(
    law_class: type[_Law],
    *,
    mass: Mass | None = None,
    contact_time: float | None = None,
    restitution: float | None = None,
    impact_speed: float | None = None,
    exponent: float | None = None,
    relaxation_time: float | None = None,
    buckling_time: float | None = None,
    buckling_share: float | None = None,
    frequency: float | None = None,
    decay_time: float | None = None,
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
        The relative speed in m/s, above 0, at which both were measured.
    exponent : float, optional
        p of the law, where the class leaves it open: needed for `PowerLaw`; by default 1.5 for
        `HuntCrossley` and 1 for `Hysteretic`.
    relaxation_time : float, optional
        τ of a `StandardLinearSolid` in s, above 0, if it is known, as from the decay of the force
        at a constant compression.
    buckling_time : float, optional
        Of a `HollowBall`, in s, above 0: the time after the touch at which the force bends.
    buckling_share : float, optional
        Of a `HollowBall`, above 0 and below 1: the force at that time over the peak force.
    frequency : float, optional
        Of the vibration of a `Bond` in Hz, above 0, as it is seen: damped.
    decay_time : float, optional
        Of the same vibration, in s, above 0: the time in which its amplitude falls to 1/e of what
        it was. By default the vibration does not decay.

    Returns
    -------
    law_class
        A law whose `stackbounce.restitution` and `stackbounce.contact_time` are the given values;
        of a `Bond`, the vibration.

    Raises
    ------
    InvalidValue
        If a needed argument is missing or out of its range, or if no law of the class has the given
        values: a `Spring` has no restitution below 1.
    InvalidType
        If `law_class` is no contact law's class, or a number has the wrong type.

    Notes
    -----
    `Rigid` needs `restitution` only; `RigidBySpeed` and `RigidLossBySpeed` need `impact_speed` too
    and have their usual `speed_exponent`. All other laws need `mass` and `contact_time`. The lossy
    ones (`Dashpot`, `StandardLinearSolid`, `Viscoelastic`, `HuntCrossley`, `Hysteretic`,
    `HollowBall`) need `restitution` as well.
    `Viscoelastic`, `HuntCrossley`, `HollowBall` and any exponent other than 1 need `impact_speed`
    as well. A `Bond` needs `mass` and `frequency`: the masses of the two parts of a body, or one
    mass that is bonded to the floor.
    Arguments that are not needed may be given, so that one measurement serves several classes. The
    contact time of a rigid contact is 0, whatever is given.

    A `StandardLinearSolid` has one number more than these two tell. Unless `relaxation_time` is
    given, it is that at which a vibration with a half period of the contact time T loses most,
    ``T/(π sqrt(1 + Δ))``: nearly the weakest relaxation that explains the loss, and a restitution
    that depends little on the mass. A `HollowBall` has two numbers more. Unless they are given, it
    buckles after 4 % of the contact time, at half of the peak force.

    Examples
    --------
    >>> from stackbounce.model import HuntCrossley, Spring
    >>> round(calibrate(Spring, mass="57 g", contact_time="5 ms").stiffness)
    22503
    >>> measured = {"mass": 0.0567, "contact_time": 5e-3, "restitution": 0.75, "impact_speed": 3.0}
    >>> round(calibrate(HuntCrossley, **measured).dissipation, 4)
    0.1653
    """
    asked = {name: value for name, value in locals().items() if name != "law_class"}
    known_laws = LAWS | UNLISTED
    if not isinstance(law_class, type) or law_class not in known_laws.values():
        known = ", ".join(known_laws)
        raise InvalidType(
            f"law_class must be the class of a contact law ({known}), got {shown(law_class)}"
        )
    kind: type[_Law] = law_class
    given = {
        name: _checked(kind, name, value) for name, value in asked.items() if value is not None
    }
    usual, fixed = kind.default_exponent(), kind.fixed_exponent()
    if usual is not None:
        given.setdefault("exponent", usual)
    if fixed is not None and given["exponent"] != fixed:
        raise InvalidValue(
            f"exponent must be {fixed:g} or left out for {kind.__name__}, got {shown(exponent)}"
        )
    if not kind.loss and given.get("restitution", 1.0) != 1.0:
        raise InvalidValue(
            f"restitution must be 1 or left out for {kind.__name__}, which gives back all "
            f"that it took, got {shown(restitution)}"
        )
    needed = kind.calibration_needs(given.get("exponent"))
    missing = [name for name in needed if name not in given]
    if missing:
        raise InvalidValue(
            f"{', '.join(missing)} must be given to calibrate {kind.__name__}, which needs "
            f"{', '.join(needed)}"
        )
    kept = given.get("restitution", 1.0)
    if kept < kind.least_restitution and not given.keys() & _KNOWN_BESIDES:
        least = f"{kind.least_restitution:.3g}"
        raise InvalidValue(
            f"restitution must be at least {least} for a {kind.__name__}, got {kept:g}"
        )
    try:  # where the exponent is 1, any speed will do
        return kind.calibrated({"impact_speed": 1.0} | given)
    except ArithmeticError:
        raise InvalidValue(
            f"what was measured must give a {kind.__name__} in the range of numbers, "
            f"got {', '.join(f'{name}={value:g}' for name, value in given.items())}"
        ) from None


def _checked(kind: type[ContactLaw], name: str, value: object) -> float:
    """Return an argument, validated."""
    if name == "mass":
        return reduced(value)
    if name in _UNITS:
        return checked(positive, name, value, _UNITS[name])
    value = in_unit(value, "", name)
    if name == "restitution":
        return fraction(name, value, zero=kind.rigid)
    if name == "exponent":
        return between(name, value, 1.0, STEEPEST)
    share = fraction(name, value, zero=False)
    if share == 1.0:
        raise InvalidValue("buckling_share must be below 1: the force rises on, got 1")
    return share
