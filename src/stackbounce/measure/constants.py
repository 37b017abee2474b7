"""A contact time, or the results of files -> stiffness, a contact law, the ball to drop."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from inspect import signature
from typing import Any

from stackbounce.errors import InvalidValue, finite, one_of, shown
from stackbounce.measure.quantities import Number, Row, deviation, measured, propagate
from stackbounce.model import Drop
from stackbounce.model.laws import ContactLaw, law_named
from stackbounce.run.calibration import calibrate

_BOUNDS = {"restitution": (0.0, 1.0), "exponent": (1.0, math.inf)}
_UNITS = {"mass": "kilograms", "contact_time": "seconds", "impact_speed": "m/s"}
_HEIGHT = 1.0  # m: from where a ball falls whose drop height is not known
_SOURCES = {
    "contact_time": "a force waveform",
    "restitution": "a sound, a track of one ball, or heights of bounces",
    "impact_speed": "a track, or the drop height",
}


def dynamic_stiffness(mass: Any, contact_time: Any) -> Number:
    """Return the stiffness that a ball shows in a bounce, k = m (π/τ)².

    Parameters
    ----------
    mass : float, UFloat or pair of them
        The mass in kg of the ball that bounced on a floor; or those of two balls that met, of which
        the reduced mass ``m1 m2/(m1 + m2)`` counts.
    contact_time : float or UFloat
        τ, from touch to release, in s.

    Returns
    -------
    UFloat
        In N/m, with the errors of both.

    Raises
    ------
    InvalidValue
        If a number is not positive and finite.
    InvalidType
        If it is no number.

    Notes
    -----
    Half a period of a mass on a linear spring: R. Cross, Am. J. Phys. 75, 1009 (2007), section III.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> print(dynamic_stiffness(ufloat(0.101, 0.0005), ufloat(4.3e-3, 0.1e-3)))  # Table I's B1
    (5.39+/-0.25)e+04
    """
    time = measured("contact_time", contact_time, _UNITS["contact_time"])
    return _moving(mass) * (math.pi / time) ** 2


@dataclass(frozen=True)
class LawConstants:
    """A contact law with the errors of its constants.

    Parameters
    ----------
    law : ContactLaw
        With the nominal values.
    constants : mapping of str to UFloat
        Its constants by their names, in SI units; correlated with each other and with what was
        measured.
    given : mapping of str to UFloat
        The measured numbers that they follow from, by the arguments of `law_constants`.
    """

    law: ContactLaw
    constants: Mapping[str, Number]
    given: Mapping[str, Number]

    def rows(self) -> list[Row]:
        """Return the law, its constants, and the measured numbers that they follow from."""
        units = self.law.units()
        found = [Row(n.replace("_", " "), v, units[n]) for n, v in self.constants.items()]
        units = {"mass": "kg", "contact_time": "s", "impact_speed": "m/s"}
        given = self.given.items()
        made_of = [Row(f"from {n.replace('_', ' ')}", v, units.get(n, "")) for n, v in given]
        return [Row("law", type(self.law).__name__), *found, *made_of]

    def parts(self) -> dict[str, object]:
        """Return the contact with its nominal values, as a drop's TOML has it."""
        return {"contact": self.law.to_mapping()}


def law_constants(
    law: type[ContactLaw] | str,
    *,
    mass: Any = None,
    contact_time: Any = None,
    restitution: Any = None,
    impact_speed: Any = None,
    exponent: Any = None,
) -> LawConstants:
    """Calibrate a law to measured contact time and restitution; return constants with errors.

    Parameters
    ----------
    law : type or str
        The law's class or its name, such as ``"HuntCrossley"``.
    mass : float, UFloat or pair of them, optional
        The mass in kg of the ball that bounced on a floor, or those of two balls that met.
    contact_time : float or UFloat, optional
        From touch to release, in s.
    restitution : float or UFloat, optional
        The ratio of the relative speeds after and before.
    impact_speed : float or UFloat, optional
        The relative speed in m/s at which it was measured.
    exponent : float or UFloat, optional
        p of the law, where the class leaves it open.

    Returns
    -------
    LawConstants

    Raises
    ------
    InvalidValue, InvalidType
        As `stackbounce.calibrate`, which finds the law.

    Notes
    -----
    Errors are propagated to first order. The derivatives of `calibrate` are central differences,
    or one-sided ones at the end of a number's range.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> found = law_constants(
    ...     "Dashpot",
    ...     mass=ufloat(0.057, 0.0005),
    ...     contact_time=ufloat(5e-3, 0.1e-3),
    ...     restitution=ufloat(0.75, 0.02),
    ... )
    >>> for row in found.rows():
    ...     print(f"{row.name}: {row.value} {row.unit}".rstrip())
    law: Dashpot
    stiffness: (2.00+/-0.08)e+04 N/m
    damping: 6.6+/-0.6 N s/m
    from mass: 0.0570+/-0.0005 kg
    from contact time: 0.00500+/-0.00010 s
    from restitution: 0.750+/-0.020
    """
    given = {name: value for name, value in locals().items() if name != "law" and value is not None}
    kind = law_named(law)
    if mass is not None:
        given["mass"] = _moving(mass)
    sources: dict[str, Number] = {
        name: measured(name, value, _UNITS.get(name, ""), finite) for name, value in given.items()
    }
    at = {name: value.nominal_value for name, value in sources.items()}
    found: Any = calibrate(kind, **at)
    names = list(found.quantities())  # includes constants that follow from each other

    def constants_of(**numbers: float) -> list[float]:
        law: Any = calibrate(kind, **numbers)
        return [getattr(law, name) for name in names]

    constants = propagate(constants_of, sources, _BOUNDS)
    try:
        for name, constant in zip(names, constants, strict=True):
            deviation(name, constant.std_dev)
    except OverflowError:
        raise InvalidValue(f"{kind.__name__} must have constants in the range of numbers") from None
    return LawConstants(found, dict(zip(names, constants, strict=True)), sources)


def _moving(mass: Any) -> Number:
    """Return the mass of one ball, or the reduced mass of two."""
    if not isinstance(mass, tuple | list):
        return measured("mass", mass, _UNITS["mass"])
    if len(mass) != 2:
        raise InvalidValue(f"mass must be a number or a pair of numbers, got {shown(mass)}")
    one, other = (measured(f"mass.{i}", mass[i], _UNITS["mass"]) for i in (0, 1))
    return one / (1.0 + one / other)


def one_ball(parts: Sequence[Mapping[str, Any]], **ball: Any) -> Drop:
    """Return a drop of the one ball that was measured, on the floor it was measured on.

    Parameters
    ----------
    parts : sequence of mapping
        The ``parts()`` of each result: ``ball``, ``contact``, ``height``, ``impact_speed``. A
        contact of known stiffness and one of known restitution are combined to a `Hysteretic` one.
    **ball
        What is known of the ball otherwise: mass in kg, diameter in m, name.

    Returns
    -------
    Drop
        From the height, or at the impact speed, that was measured last; else from 1 m.

    Raises
    ------
    InvalidValue
        If no contact was found, several cannot be combined, or the mass is not known.

    Examples
    --------
    >>> press = {"contact": {"law": "Spring", "stiffness": 2e4}}
    >>> sound = {"contact": {"law": "Rigid", "restitution": 0.8}, "height": 0.7}
    >>> drop = one_ball([press, sound], mass=0.057)
    >>> drop.contacts[0].stiffness, drop.contacts[0].restitution, drop.height
    (20000.0, 0.8, 0.7)
    """
    known: dict[str, Any] = {}
    start: dict[str, Any] = {"height": _HEIGHT}
    contacts = [part["contact"] for part in parts if "contact" in part]
    for part in parts:
        known |= part.get("ball", {})
        for key in ("impact_speed", "height"):
            start = {key: part[key]} if key in part else start
    known |= {key: value for key, value in ball.items() if value is not None}
    if "mass" not in known:
        raise InvalidValue("the ball's mass is not known: give it")
    mapping = {"balls": [known], "contacts": [_together(contacts)], "gaps": []}
    return Drop.from_mapping(mapping | start)


def one_law(law: type[ContactLaw] | str, found: Sequence[Any], **given: Any) -> LawConstants:
    """Return the contact law of a given class that fits all results.

    Parameters
    ----------
    law : type or str
        The law's class or its name, such as ``"HuntCrossley"``.
    found : sequence
        What the analyses returned; each result's ``law_arguments()`` has the contact time,
        restitution and impact speed that it found. Where two results have one, the later counts.
    **given
        Other arguments of `law_constants`, which take precedence over the results.

    Returns
    -------
    LawConstants
        Its ``given`` has the values that were used: those that the class needs.

    Raises
    ------
    InvalidValue
        If something that the class needs was not found, or `law_constants` refuses it.

    Examples
    --------
    >>> from stackbounce.measure import heights
    >>> dropped = heights(1.0, [0.64, 0.41], height_error=0.005)
    >>> found = one_law("hunt-crossley", [dropped], mass=0.057, contact_time=5e-3)
    >>> print(f"{found.constants['dissipation']:.1uS} s/m at {found.given['impact_speed']:.1uS}")
    0.084(1) s/m at 4.43(1)
    """
    kind, arguments = law_named(law), signature(law_constants).parameters
    for name in given:
        one_of(name, arguments, f"{name} is no argument of one_law")
    known: dict[str, Any] = {}
    for result in found:
        for name, value in result.law_arguments().items():
            if value is not None:  # an error that is NaN is unknown
                unknown = math.isnan(getattr(value, "std_dev", 0.0))
                known[name] = value.nominal_value if unknown else value
    known |= {name: value for name, value in given.items() if value is not None}
    exponent = known.get("exponent")
    needed = kind.calibration_needs(getattr(exponent, "nominal_value", exponent))
    missing = [name for name in needed if name not in known]
    if missing:
        sources = {name: f" ({source})" for name, source in _SOURCES.items()}
        words = [name.replace("_", " ") + sources.get(name, "") for name in missing]
        raise InvalidValue(f"{kind.__name__} needs what was not found: {', '.join(words)}")
    used = {name: known[name] for name in (*needed, "exponent") if name in known}
    return law_constants(kind, **used)


def _together(contacts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Combine measured contacts into one: a stiffness and a restitution make a `Hysteretic` one.

    A table keeps its loading curve; its loss is that of the bounce, which is faster than a press.
    """
    if not contacts:
        raise InvalidValue(
            "no contact was found, which needs a sound of three bounces, a track, a force waveform "
            "with the ball's mass, or a press curve"
        )
    if len(contacts) == 1:
        return dict(contacts[0])
    rigid = [contact for contact in contacts if law_named(contact["law"]).rigid]
    sprung = [contact for contact in contacts if law_named(contact["law"]).rate_free]
    if len(contacts) == 2 and len(rigid) == len(sprung) == 1:
        law = sprung[0]
        if law["law"] == "Tabulated":
            loading = {key: law[key] for key in ("law", "compression", "force")}
            return loading | {"restitution": rigid[0]["restitution"]}
        return {
            "law": "Hysteretic",
            "stiffness": law["stiffness"],
            "exponent": law.get("exponent", law_named(law["law"]).default_exponent() or 1.0),
            "restitution": rigid[0]["restitution"],
        }
    names = ", ".join(contact["law"] for contact in contacts)
    raise InvalidValue(
        f"the files must give one contact, or one with a stiffness and one with a restitution, "
        f"got {names}"
    )
