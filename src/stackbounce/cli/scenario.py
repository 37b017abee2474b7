"""From arguments to a drop: a scenario file or balls of the catalogue, and what to change."""

import dataclasses
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from stackbounce.errors import InvalidValue, shown
from stackbounce.model.catalogue import stack
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw
from stackbounce.model.schema import read_law
from stackbounce.units import quantity

__all__ = ["DEFAULT_HEIGHT", "Scenario", "read", "read_contact"]

DEFAULT_HEIGHT = 1.0
"""The height in m from which balls of the catalogue fall if nothing is said about it."""


@dataclasses.dataclass(frozen=True)
class Scenario:
    """A drop, and for people where its numbers come from."""

    drop: Drop
    contact_sources: tuple[str, ...]
    gap_sources: tuple[str, ...]
    speed_source: str


def read(
    what: Sequence[str],
    *,
    height: str | None = None,
    speed: str | None = None,
    gaps: Sequence[str] | None = None,
    contacts: Sequence[str] | None = None,
    gravity: str | None = None,
) -> Scenario:
    """Return the scenario that the arguments of ``stackbounce simulate`` describe.

    Parameters
    ----------
    what : sequence of str
        One scenario file, or names of the catalogue, the lowest ball first.
    height, speed, gravity : str, optional
        Numbers with or without a unit; they replace the file's.
    gaps, contacts : sequence of str, optional
        All gaps, all contacts; they replace those of the file or catalogue.

    Returns
    -------
    Scenario

    Raises
    ------
    StackbounceError
        If one of them cannot be read.
    """
    changes = _changes(height, speed, gaps, contacts, gravity)
    if any(_is_file(name) for name in what):
        if len(what) > 1:
            raise InvalidValue(
                f"simulate needs one scenario file, or balls of the catalogue, got {' '.join(what)}"
            )
        return _with(_from_file(what[0]), changes)
    return _with(_from_catalogue(what, changes), changes)


def read_contact(text: str, path: str) -> ContactLaw | None:
    """Return the contact law of a text such as ``"Spring stiffness=2.5kN/m"``.

    Parameters
    ----------
    text : str
        The law's name and its numbers, with or without units; ``"none"`` for no floor.
    path : str
        What messages call it.

    Returns
    -------
    ContactLaw or None

    Raises
    ------
    InvalidValue
        If it cannot be read.

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


def _is_file(name: str) -> bool:
    return name.endswith(".toml") or Path(name).name != name


def _changes(
    height: str | None,
    speed: str | None,
    gaps: Sequence[str] | None,
    contacts: Sequence[str] | None,
    gravity: str | None,
) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    if height is not None and speed is not None:
        raise InvalidValue("--height and --speed: only one of the two can be given, got both")
    if height is not None:
        changes["height"] = quantity(height, "m", "--height")
    if speed is not None:
        changes["impact_speed"] = quantity(speed, "m/s", "--speed")
    if gaps:
        changes["gaps"] = [quantity(gap, "m", "--gap") for gap in gaps]
    if contacts:
        changes["contacts"] = [
            read_contact(text, f"--contact {i}") for i, text in enumerate(contacts)
        ]
    if gravity is not None:
        changes["gravity"] = quantity(gravity, "m/s**2", "--gravity")
    return changes


def _from_file(name: str) -> Scenario:
    drop = Drop.from_toml(name)
    return Scenario(drop, (name,) * len(drop.contacts), (name,) * len(drop.gaps), name)


def _from_catalogue(names: Sequence[str], changes: dict[str, Any]) -> Scenario:
    chosen = stack(names)
    given = {key: changes[key] for key in ("height", "impact_speed") if key in changes}
    drop = Drop(chosen.balls, chosen.contacts, chosen.gaps, **(given or {"height": DEFAULT_HEIGHT}))
    return Scenario(drop, chosen.contact_sources, chosen.gap_sources, "default")


def _with(scenario: Scenario, changes: dict[str, Any]) -> Scenario:
    sources: dict[str, Any] = {}
    if "contacts" in changes:
        sources["contact_sources"] = ("--contact",) * len(changes["contacts"])
    if "gaps" in changes:
        sources["gap_sources"] = ("--gap",) * len(changes["gaps"])
    for key, option in (("height", "--height"), ("impact_speed", "--speed")):
        if key in changes:
            sources["speed_source"] = option
            others = dict.fromkeys(("height", "impact_speed", "velocities"))
            changes = others | changes
    return dataclasses.replace(
        scenario, drop=dataclasses.replace(scenario.drop, **changes), **sources
    )
