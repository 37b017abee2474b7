"""A drop from arguments: a scenario file or balls of the catalogue, and options that change it."""

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from stackbounce.cli.drop_options import read_changes
from stackbounce.errors import InvalidValue
from stackbounce.model.catalogue import stack, stacked
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw


@dataclasses.dataclass(frozen=True)
class Scenario:
    """A drop, and where its numbers come from."""

    drop: Drop
    contact_sources: tuple[str, ...]
    gap_sources: tuple[str, ...]
    speed_source: str
    errors: Mapping[str, str] = dataclasses.field(default_factory=dict)
    """The numbers of the file that have errors, as they are written, by path."""


def read(what: Sequence[str], *, with_errors: bool = False, **options: Any) -> Scenario:
    """Return the scenario that the arguments of ``stackbounce simulate`` describe.

    Parameters
    ----------
    what : sequence of str
        One scenario file; files of one ball each, the lowest first, to be stacked; or names of the
        catalogue, the lowest first.
    with_errors : bool, optional
        Take a single file whose numbers have errors; without it these are refused.
    **options
        As `read_changes` takes them; they replace the numbers of the file.

    Raises
    ------
    StackbounceError
        If one of them cannot be read.
    """
    changes = read_changes(**options)
    if any(is_file(name) for name in what):
        if not all(is_file(name) for name in what):
            raise InvalidValue(
                "either scenario files or balls of the catalogue must be given, "
                f"got {' '.join(what)}"
            )
        if len(what) > 1:
            return _with(_from_files(what, changes), changes)
        return _with(_from_file(what[0], with_errors=with_errors), changes)
    return _with(_from_catalogue(what), changes)


def change(drop: Drop, **options: Any) -> Drop:
    """Return a drop changed by the options of `read`."""
    return _with(Scenario(drop, (), (), ""), read_changes(**options)).drop


def is_file(name: str) -> bool:
    """Return whether an argument is the name of a file, and not of a ball of the catalogue.

    Examples
    --------
    >>> is_file("tennis.toml"), is_file("tennis")
    (True, False)
    """
    return name.endswith(".toml") or Path(name).name != name


def _from_file(name: str, *, with_errors: bool) -> Scenario:
    if with_errors:
        from stackbounce.prediction import read_scenario

        drop, errors = read_scenario(name)
    else:
        drop, errors = Drop.from_toml(name), {}
    return Scenario(drop, (name,) * len(drop.contacts), (name,) * len(drop.gaps), name, errors)


def _from_files(names: Sequence[str], changes: dict[str, Any]) -> Scenario:
    """Stack one ball per file; two balls touch by their two floor contacts in series."""
    drops = [Drop.from_toml(name) for name in names]
    laws: list[ContactLaw] = []
    for name, drop in zip(names, drops, strict=True):
        if len(drop.balls) != 1 or drop.contacts[0] is None:
            raise InvalidValue(
                f"{name} must have one ball and its contact with the floor, to be stacked, got "
                f"{len(drop.balls)} balls{'' if drop.contacts[0] else ' and no floor'}"
            )
        laws.append(drop.contacts[0])
    contacts = changes.get("contacts") or _joined(names, laws)
    lowest = drops[0]
    drop = Drop(
        [drop.balls[0] for drop in drops],
        contacts,
        height=lowest.height,
        impact_speed=None if lowest.height is not None else lowest.reference_speed,
        gravity=lowest.gravity,
    )
    pairs = [f"{lower} and {upper} in series" for lower, upper in itertools.pairwise(names)]
    return Scenario(drop, (names[0], *pairs), ("no gap given",) * len(pairs), names[0])


def _joined(names: Sequence[str], laws: Sequence[ContactLaw]) -> list[ContactLaw]:
    from stackbounce.towers.ranking import join_contacts

    try:
        return join_contacts(names, laws)
    except InvalidValue as error:
        raise InvalidValue(f"{error}; give all contacts with --contact") from error


def _from_catalogue(names: Sequence[str]) -> Scenario:
    chosen = stacked(names)
    return Scenario(stack(*names), chosen.contact_sources, chosen.gap_sources, "default")


def _with(scenario: Scenario, changes: dict[str, Any]) -> Scenario:
    sources: dict[str, Any] = {}
    if "contacts" in changes:
        sources["contact_sources"] = ("--contact",) * len(changes["contacts"])
    if "gaps" in changes:
        sources["gap_sources"] = ("--gap",) * len(changes["gaps"])
    for key, option in (("height", "--height"), ("impact_speed", "--speed")):
        if key in changes:
            sources["speed_source"] = option
            changes = dict.fromkeys(("height", "impact_speed", "velocities")) | changes
    given = scenario.errors.items()
    errors = {path: text for path, text in given if path.partition(".")[0] not in changes}
    drop = dataclasses.replace(scenario.drop, **changes)
    return dataclasses.replace(scenario, drop=drop, errors=errors, **sources)
