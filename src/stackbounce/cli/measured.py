"""``stackbounce measure``: files in, what was found in them out, and a ball for ``simulate``."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stackbounce.cli.output import check_scenario, write_scenario
from stackbounce.errors import InvalidValue, StackbounceError, shown
from stackbounce.units import quantity

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from stackbounce.measure.law_constants import LawConstants
    from stackbounce.model.laws import ContactLaw

__all__ = [
    "Measured",
    "check_save",
    "constants",
    "law",
    "numbers",
    "pairs",
    "picture",
    "points",
    "run",
    "save",
    "summary",
    "tell",
    "typed",
]

_NOTE = "note"  # a row that is a sentence


@dataclass(frozen=True)
class Measured:
    """A file, or numbers from the command line, and what was found in it."""

    source: str
    told: Mapping[str, str]
    data: Any
    found: tuple[Any, ...]

    @property
    def rows(self) -> list[Any]:
        """All quantities."""
        return [row for found in self.found for row in found.rows() if row.name != _NOTE]

    @property
    def notes(self) -> list[str]:
        """All sentences, each once."""
        return list(dict.fromkeys(note for found in self.found for note in found.notes))


def numbers(**texts: str | None) -> dict[str, Any]:
    """Return the options that are quantities and given, in SI units, with errors where told."""
    from stackbounce.measure.told_numbers import told_number

    return {
        name: told_number(name, text, f"--{name.replace('_', '-')}")
        for name, text in texts.items()
        if text is not None
    }


def pairs(texts: Sequence[str] | None, option: str, right: str) -> dict[Any, str]:
    """Return the ``COLUMN=VALUE`` texts of an option; columns by name, or by number from 1."""
    found: dict[Any, str] = {}
    for text in texts or ():
        name, _, value = (part.strip() for part in text.partition("="))
        if not (name and value):
            raise InvalidValue(f"{option} must be {right}, got {shown(text)}")
        found[int(name) if name.isdecimal() else name] = value
    return found


def points(text: str) -> tuple[str, ...]:
    """Return the points that the drop's height and the bounces' were measured to."""
    from stackbounce.measure.kinds.heights.analysis import places

    words = tuple(word.strip() for word in text.split(","))
    if len(words) > 2:
        raise InvalidValue(f"--measured-to must be a point or two, got {shown(text)}")
    return places(words * 2 if len(words) == 1 else words)


def law(text: str) -> "tuple[type[ContactLaw], dict[str, float]]":
    """Return the class that ``--law`` names, and the exponent that it may tell."""
    from stackbounce.model.laws import law_named

    name, *rest = text.split() or [""]
    told: dict[str, float] = {}
    for word in rest:
        key, _, value = word.partition("=")
        if key != "exponent" or not value or told:
            raise InvalidValue(
                f"--law must be a law, or 'LAW exponent=NUMBER', got {shown(text)}; restitution "
                "and contact time have options of their own"
            )
        told[key] = quantity(value, "", "--law: exponent")
    return law_named(name), told


def run(
    paths: Sequence[Path],
    alone: Path | None,
    reading: Mapping[str, Any],
    known: Mapping[str, Any],
) -> list[Measured]:
    """Read each file, and find in it what its kind holds, with the record of one ball alone."""
    from stackbounce.measure import analyse, read

    done = []
    if alone is not None:
        known = {**known, "alone": read(alone, **reading)}
    for path in paths:
        data = read(path, **reading)
        try:
            found = analyse(data, **known)
        except StackbounceError as error:
            raise type(error)(f"{path}: {error}") from error
        told = {name: data.attrs[name] for name in ("format", "why", "doubt", "holds")}
        done.append(Measured(str(path), told, data, found))
    return done


def typed(
    lengths: str | None, contact: Mapping[str, Any], known: Mapping[str, Any]
) -> list[Measured]:
    """Return what the numbers on the command line tell: ``--heights``, then what is known of it."""
    from stackbounce.measure import heights
    from stackbounce.measure.kinds.contact.analysis import known_contact

    done = []
    if lengths is not None:
        dropped, *risen = _lengths(lengths)
        names = ("diameter", "measured_to", "height_error", "repeated")
        told = {name: known[name] for name in names if name in known}
        done.append(_typed("--heights", "heights of bounces", heights(dropped, risen, **told)))
    if contact:
        source = " ".join(f"--{name.replace('_', '-')}" for name in contact)
        known_of_it = known_contact(**contact, mass=known.get("mass"))
        done.append(_typed(source, "contact with the floor", known_of_it))
    return done


def _typed(source: str, holds: str, found: Any) -> Measured:
    told = {"format": "numbers of the command line", "why": "", "doubt": "", "holds": holds}
    return Measured(source, told, None, (found,))


def _lengths(text: str) -> list[Any]:
    """Return lengths between commas or semicolons; a unit at the end is that of all."""
    from stackbounce.measure.uncertain_numbers import quantity_with_error

    words = [word.strip() for word in re.split(r"[,;]", text)]
    unit = re.sub(r"^[-+.\deE±/ ()]+", "", words[-1])
    bare = [not re.search(r"[^-+.\deE±/ ()]", word) for word in words]
    if any(bare) and not (all(bare) or all(bare[:-1])):
        raise InvalidValue(
            f"--heights must have a unit each, or one at the end for all, got {shown(text)}"
        )
    return [
        quantity_with_error(word + unit if is_bare else word, "m", f"--heights {k}")
        for k, (word, is_bare) in enumerate(zip(words, bare, strict=True))
    ]


def constants(
    chosen: "tuple[type[ContactLaw], dict[str, float]]",
    done: Sequence[Measured],
    known: Mapping[str, Any],
) -> "LawConstants":
    """Return the law that ``--law`` asks for, of all that was found and is known."""
    from stackbounce.measure import one_law
    from stackbounce.model.drop import STANDARD_GRAVITY

    kind, exponent = chosen
    given = {key: known[key] for key in ("mass", "contact_time", "restitution") if key in known}
    speed = known.get("speed")
    if speed is None and "height" in known:
        speed = (2.0 * known.get("gravity", STANDARD_GRAVITY) * known["height"]) ** 0.5
    found = [one for each in done for one in each.found]
    return one_law(kind, found, **given, **exponent, impact_speed=speed)


def summary(
    done: Sequence[Measured], law: "LawConstants | None", ball: Mapping[str, Any]
) -> dict[str, Any]:
    """Return what was found, for machines."""
    from stackbounce.version import __version__

    files = [
        {
            "file": one.source,
            **one.told,
            "found": [_row(row) for row in one.rows],
            "notes": one.notes,
        }
        for one in done
    ]
    return {
        "stackbounce": __version__,
        "files": files,
        "law": None if law is None else [_row(row) for row in _law_rows(law)],
        "ball": dict(ball) or None,
    }


def tell(console: "Console", done: Sequence[Measured], law: "LawConstants | None") -> None:
    """Print what was found, for people."""
    for one in done:
        console.print(f"{one.source}: {one.told['format']}", style="bold")
        if one.told["why"]:
            console.print(f"  {one.told['why']}")
        if one.told["doubt"]:
            console.print(f"  Unsure: {one.told['doubt']}")
        _table(console, one.rows)
        for note in one.notes:
            console.print(f"  {note}")
    if law is not None:
        console.print(f"The contact as {type(law.law).__name__}", style="bold")
        _table(console, _law_rows(law))


def _law_rows(law: "LawConstants") -> list[Any]:
    """Return the law's constants, and what they were made of."""
    from stackbounce.measure.rows import Row

    units = {"mass": "kg", "contact_time": "s", "impact_speed": "m/s"}
    made_of = law.given.items()
    return [
        *law.rows(),
        *(Row(f"from {name.replace('_', ' ')}", one, units.get(name, "")) for name, one in made_of),
    ]


def _table(console: "Console", rows: Sequence[Any]) -> None:
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("")
    table.add_column("value", justify="right")
    table.add_column("error", justify="right")
    table.add_column("unit")
    for row in rows:
        table.add_row(row.name, *_written(row.value), row.unit)
    console.print(table)


def picture(done: Sequence[Measured]) -> "Figure":
    """Return what was found first in the file, or in the heights, drawn on what was measured."""
    from stackbounce import plots

    return plots.measured(done[0].data, done[0].found[-1])


def check_save(path: Path, known: Mapping[str, Any]) -> None:
    """Refuse to save a ball that could not be written, before anything is computed."""
    check_scenario(path)
    if "mass" not in known:
        raise InvalidValue("--save needs the mass of the ball, such as --mass 57g")


def save(
    done: Sequence[Measured],
    law: "LawConstants | None",
    path: Path,
    ball: Mapping[str, Any],
) -> dict[str, Any]:
    """Write the ball that was measured as a scenario file, and return what is in it."""
    from stackbounce.measure import one_ball

    parts = [found.parts() for one in done for found in one.found]
    if law is not None:
        parts = [{key: part[key] for key in part if key != "contact"} for part in parts]
        parts.append(law.parts())
    drop = one_ball(parts, **{key: getattr(one, "nominal_value", one) for key, one in ball.items()})
    write_scenario(drop.to_toml(), path)
    return drop.to_mapping()


def _row(row: Any) -> dict[str, Any]:
    value, error = row.value, None
    if hasattr(value, "nominal_value"):
        value, error = value.nominal_value, value.std_dev
    return {"name": row.name, "value": value, "error": error, "unit": row.unit}


def _written(value: Any) -> tuple[str, str]:
    """Return a value and its error as people write them: the error with two digits that count."""
    from stackbounce.cli.tables import number

    if isinstance(value, str):
        return value, ""
    if not hasattr(value, "nominal_value"):
        return (str(value) if isinstance(value, int) else number(value)), ""
    if not value.std_dev > 0.0:
        return number(value.nominal_value), ""
    body, _, power = f"{value:.2u}".replace("(", "").partition(")")
    one, _, other = body.partition("+/-")
    return one + power, other + power
