"""Results of one or more files -> a contact law, or the ball that `simulate` drops."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.constants import LawConstants, law_constants
from stackbounce.model import Drop
from stackbounce.model.laws import ContactLaw, law_named

_HEIGHT = 1.0  # m: from where a ball falls whose drop height is not known
_SOURCES = {
    "contact_time": "a force waveform",
    "restitution": "a sound, a track of one ball, or heights of bounces",
    "impact_speed": "a track, or the drop height",
}


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
    contacts: list[Mapping[str, Any]] = []
    for part in parts:
        known |= part.get("ball", {})
        contacts += [part["contact"]] if "contact" in part else []
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
    kind = law_named(law) if isinstance(law, str) else law
    known: dict[str, Any] = {}
    for result in found:
        values = result.law_arguments().items()
        known |= {name: _usable(value) for name, value in values if value is not None}
    known |= {name: value for name, value in given.items() if value is not None}
    exponent = known.get("exponent")
    needed = kind.calibration_needs(getattr(exponent, "nominal_value", exponent))
    missing = [name for name in needed if name not in known]
    if missing:
        words = [
            name.replace("_", " ") + (f" ({_SOURCES[name]})" if name in _SOURCES else "")
            for name in missing
        ]
        raise InvalidValue(f"{kind.__name__} needs what was not found: {', '.join(words)}")
    used = {name: known[name] for name in (*needed, "exponent") if name in known}
    return law_constants(kind, **used)


def _usable(value: Any) -> Any:
    """Return a number; drop its error if that is NaN, which means unknown."""
    return value.nominal_value if math.isnan(getattr(value, "std_dev", 0.0)) else value


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
