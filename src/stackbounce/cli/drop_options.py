"""The values of options that change a drop."""

import shlex
from collections.abc import Sequence
from typing import Any

from stackbounce.errors import InvalidValue, shown
from stackbounce.model.laws import ContactLaw
from stackbounce.model.toml import read_law
from stackbounce.units import quantity


def read_contact(text: str, path: str) -> ContactLaw | None:
    """Return the contact law of a text such as ``"Spring stiffness=2.5kN/m"``.

    It is the law's name and its numbers, with or without units; ``"none"`` stands for no floor.
    Messages call it `path`.

    Examples
    --------
    >>> read_contact("Spring stiffness=2.5kN/m", "--contact")
    Spring(stiffness=2500.0)
    """
    try:
        words = shlex.split(text)
    except ValueError:
        words = []
    law, pairs = (words[0], [word.partition("=") for word in words[1:]]) if words else ("", [])
    if not law or "=" in law or any(not key or not value for key, _, value in pairs):
        right = "'LAW key=value …', such as 'Spring stiffness=2.5kN/m'"
        raise InvalidValue(f"{path} must be {right}, got {shown(text)}")
    keys = ["law", *(key for key, _, _ in pairs)]
    if len(set(keys)) < len(keys):
        raise InvalidValue(f"{path} must give each key once, got {shown(text)}")
    return read_law({"law": law} | {key: value for key, _, value in pairs}, path)


def read_fall(height: str | None, speed: str | None) -> dict[str, float]:
    """Return the height or the impact speed of ``--height`` and ``--speed``, if one is given.

    Examples
    --------
    >>> read_fall("63cm", None), read_fall(None, None)
    ({'height': 0.63}, {})
    """
    if height is not None and speed is not None:
        raise InvalidValue("--height and --speed: only one of the two can be given, got both")
    if height is not None:
        return {"height": quantity(height, "m", "--height")}
    return {} if speed is None else {"impact_speed": quantity(speed, "m/s", "--speed")}


def read_until(text: str | None) -> float | None:
    """Return the time in s of ``--until``.

    Examples
    --------
    >>> read_until("5 ms")
    0.005
    """
    return None if text is None else quantity(text, "s", "--until")


def read_changes(
    *,
    height: str | None = None,
    speed: str | None = None,
    gap: Sequence[str] | None = None,
    contact: Sequence[str] | None = None,
    gravity: str | None = None,
) -> dict[str, Any]:
    """Return the fields of a drop that the options change.

    The texts of height, speed and gravity may have a unit; gap and contact are all gaps and all
    contacts.
    """
    changes: dict[str, Any] = {**read_fall(height, speed)}
    if gap:
        changes["gaps"] = [quantity(text, "m", "--gap") for text in gap]
    if contact:
        changes["contacts"] = [
            read_contact(text, f"--contact {i}") for i, text in enumerate(contact)
        ]
    if gravity is not None:
        changes["gravity"] = quantity(gravity, "m/s**2", "--gravity")
    return changes
