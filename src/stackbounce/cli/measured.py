"""``stackbounce measure``: files in, what was found in them out, and a ball for ``simulate``."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stackbounce.errors import FileError, InvalidValue, StackbounceError, shown
from stackbounce.units import quantity

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure
    from rich.console import Console

__all__ = [
    "Measured",
    "check_save",
    "numbers",
    "pairs",
    "picture",
    "run",
    "save",
    "summary",
    "tell",
]

_UNITS = {
    "mass": "kg",
    "diameter": "m",
    "height": "m",
    "speed": "m/s",
    "time_constant": "s",
    "gravity": "m/s**2",
}
_NOTE = "note"  # a row that is a sentence


@dataclass(frozen=True)
class Measured:
    """A file, and what was found in it: one analysis after the other."""

    path: Path
    data: "xr.Dataset"
    found: tuple[Any, ...]

    @property
    def rows(self) -> list[Any]:
        """All quantities."""
        return [row for found in self.found for row in found.rows() if row.name != _NOTE]

    @property
    def notes(self) -> list[str]:
        """All sentences, each once."""
        return list(dict.fromkeys(note for found in self.found for note in found.notes))


def numbers(**texts: str | None) -> dict[str, float]:
    """Return the options that are quantities and given, in SI units."""
    return {
        name: quantity(text, _UNITS[name], f"--{name.replace('_', '-')}")
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


def run(
    paths: Sequence[Path], reading: Mapping[str, Any], known: Mapping[str, float]
) -> list[Measured]:
    """Read each file, and find in it what its kind holds."""
    from stackbounce.measure import analyse, read

    done = []
    for path in paths:
        data = read(path, **reading)
        try:
            done.append(Measured(path, data, analyse(data, **known)))
        except StackbounceError as error:
            raise type(error)(f"{path}: {error}") from error
    return done


def summary(done: Sequence[Measured], ball: Mapping[str, Any]) -> dict[str, Any]:
    """Return what was found, for machines."""
    from stackbounce.version import __version__

    files = [
        {
            "file": str(one.path),
            **{name: one.data.attrs[name] for name in ("format", "why", "doubt", "holds")},
            "found": [_row(row) for row in one.rows],
            "notes": one.notes,
        }
        for one in done
    ]
    return {"stackbounce": __version__, "files": files, "ball": dict(ball) or None}


def tell(console: "Console", done: Sequence[Measured]) -> None:
    """Print what was found, for people."""
    from rich import box
    from rich.table import Table

    for one in done:
        attrs = one.data.attrs
        console.print(f"{one.path}: {attrs['format']}", style="bold")
        console.print(f"  {attrs['why']}")
        if attrs["doubt"]:
            console.print(f"  Unsure: {attrs['doubt']}")
        table = Table(box=box.SIMPLE_HEAD)
        table.add_column("")
        table.add_column("value", justify="right")
        table.add_column("error", justify="right")
        table.add_column("unit")
        for row in one.rows:
            table.add_row(row.name, *_written(row.value), row.unit)
        console.print(table)
        for note in one.notes:
            console.print(f"  {note}")


def picture(done: Sequence[Measured]) -> "Figure":
    """Return what was found in the one file, drawn on what was measured."""
    from stackbounce import plots

    (one,) = done
    return plots.measured(one.data, one.found[-1])  # what was found first


def check_save(path: Path, known: Mapping[str, float]) -> None:
    """Refuse to save a ball that could not be written, before anything is computed."""
    if path.suffix.lower() != ".toml":
        raise InvalidValue(f"--save must end in .toml, got {path}")
    if path.is_dir():
        raise FileError(f"{path} cannot be written: it is a folder")
    if not path.parent.is_dir():
        raise FileError(f"{path} cannot be written: there is no folder {path.parent}")
    if "mass" not in known:
        raise InvalidValue("--save needs the mass of the ball, such as --mass 57g")


def save(done: Sequence[Measured], path: Path, **known: Any) -> dict[str, Any]:
    """Write the ball that was measured as a scenario file, and return what is in it."""
    from stackbounce.measure import one_ball

    drop = one_ball([found.parts() for one in done for found in one.found], **known)
    try:
        path.write_text(drop.to_toml(), encoding="utf-8")
    except OSError as error:
        raise FileError(f"{path} cannot be written: {error.strerror or error}") from error
    return drop.to_mapping()


def _row(row: Any) -> dict[str, Any]:
    value, error = row.value, None
    if hasattr(value, "nominal_value"):
        value, error = value.nominal_value, value.std_dev
    return {"name": row.name, "value": value, "error": error, "unit": row.unit}


def _written(value: Any) -> tuple[str, str]:
    """Return a value and its error as people write them: the error with two digits that count."""
    from stackbounce.cli.show import number

    if isinstance(value, str):
        return value, ""
    if not hasattr(value, "nominal_value"):
        return (str(value) if isinstance(value, int) else number(value)), ""
    if not value.std_dev > 0.0:
        return number(value.nominal_value), ""
    body, _, power = f"{value:.2u}".replace("(", "").partition(")")
    one, _, other = body.partition("+/-")
    return one + power, other + power
