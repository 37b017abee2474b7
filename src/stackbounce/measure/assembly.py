"""From what was found in one or more files to the ball that `simulate` drops."""

from collections.abc import Mapping, Sequence
from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.model import Drop

__all__ = ["one_ball"]

_EXPONENTS = {"Spring": 1.0, "Hertz": 1.5, "PowerLaw": 1.0, "Hysteretic": 1.0}  # where not told
_HEIGHT = 1.0  # m: from where a ball falls whose drop height is not known


def one_ball(parts: Sequence[Mapping[str, Any]], **ball: Any) -> Drop:
    """Return a drop of the one ball that was measured, on the floor it was measured on.

    Parameters
    ----------
    parts : sequence of mapping
        What each analysis found, as its ``parts()`` tells: ``ball``, ``contact``, ``height``,
        ``impact_speed``. A contact of known stiffness and one of known restitution make one that
        is `Hysteretic`.
    **ball
        What is known of the ball otherwise: mass in kg, diameter in m, name.

    Returns
    -------
    Drop
        From the height, or at the impact speed, that was measured last; else from 1 m.

    Raises
    ------
    InvalidValue
        If no contact was found, or several that do not go together, or the mass is not known.

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


def _together(contacts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the one contact that measured contacts make."""
    if not contacts:
        raise InvalidValue(
            "no contact was found, which needs a sound of three bounces, a track, a force waveform "
            "with the ball's mass, or a press curve"
        )
    if len(contacts) == 1:
        return dict(contacts[0])
    rigid = [one for one in contacts if one["law"] == "Rigid"]
    sprung = [one for one in contacts if one["law"] in _EXPONENTS]
    if len(contacts) == 2 and len(rigid) == len(sprung) == 1:
        law = sprung[0]
        return {
            "law": "Hysteretic",
            "stiffness": law["stiffness"],
            "exponent": law.get("exponent", _EXPONENTS[law["law"]]),
            "restitution": rigid[0]["restitution"],
        }
    names = ", ".join(one["law"] for one in contacts)
    raise InvalidValue(
        f"the files must give one contact, or one with a stiffness and one with a restitution, "
        f"got {names}"
    )
