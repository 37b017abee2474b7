"""A fit problem from a file: a scenario with what was measured, what varies, what follows."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

from stackbounce.errors import InvalidValue, ScenarioError, a_or_an, one_of, placed, shown
from stackbounce.fitting.parameters import Range
from stackbounce.fitting.problem import FitProblem
from stackbounce.library_types import DataArray
from stackbounce.measure.finding import force_channels
from stackbounce.model import Drop
from stackbounce.model.toml import load_toml
from stackbounce.units import count_written, quantity

_DROP = tuple(field.name for field in fields(Drop))
_OWN = ("measured", "vary", "tie", "drops")
_INCIDENCE = ("impact_speed", "height", "velocities")
_RANGE = ("low", "high", "prior")
_RECORD = ("file", "start", "end", "error")
_READING = ("holds", "table", "run", "names", "units", "decimal")
Asked: TypeAlias = tuple[dict[str, Drop], dict[str, dict[str, Any]]]
"""Drops by their names, and what was measured of each."""


class Parts(NamedTuple):
    """The parts of a `FitProblem` from a file, not checked; what the file lacks is empty."""

    drops: dict[str, Drop]
    data: dict[str, dict[str, Any]]
    vary: dict[str, Any]
    tie: dict[str, Any]


def read_question(path: str | os.PathLike[str]) -> FitProblem:
    """Return the fit problem of a file in TOML.

    Parameters
    ----------
    path : str or path-like
        A scenario, as `stackbounce.Drop.from_toml` reads it, with three more tables, which may be
        left out. ``[measured]`` has what was measured, by the names that `stackbounce.fit` takes:
        ``"rebound_ratios.1" = "1.64 ± 0.02"``. ``"force.0"`` is the name of a file beside this one,
        as `stackbounce.read` reads it, or a table with ``file``, ``start`` and ``end`` of the part
        to take, ``error`` of a sample, and options of `stackbounce.read`. ``[vary]`` has what may
        change: ``"gaps.0" = "0 mm : 5 mm"``, ``"1.3 ± 0.9 mm"``, or a table of ``low``, ``high``
        and ``prior``; an empty text means bounds around the drop's own number. ``[tie]`` has what
        follows: ``"contacts.1.stiffness" = "0.5 * contacts.0.stiffness"``. Several drops are
        ``[[drops]]``, each with a ``name``, ``[drops.measured]`` and the keys in which it differs;
        the rest of the file holds for all drops.

    Returns
    -------
    FitProblem
        Its method `fit` makes the fit. Without data or anything to vary it is not complete yet.

    Raises
    ------
    FileError
        If a file cannot be read.
    ScenarioError
        If its content is wrong; the message begins with the file's name.
    InvalidType
        If `path` is not a path.

    Examples
    --------
    >>> read_question("no-such-file.toml")
    Traceback (most recent call last):
        ...
    stackbounce.errors.FileError: no-such-file.toml cannot be read: No such file or directory
    """
    parts = read_parts(path)
    with placed(f"{os.fspath(path)}: ", ScenarioError):
        return FitProblem(*parts)


def read_parts(path: str | os.PathLike[str]) -> Parts:
    """Return the parts of a fit problem from a file, not checked; see `read_question`."""
    name, mapping = load_toml(path)
    with placed(f"{name}: ", ScenarioError):
        return _parts(mapping, Path(name).parent)


def convert_measured(name: str, value: object, folder: Path) -> Any:
    """Convert a measured value from a file or the command line to what `fit` takes.

    Parameters
    ----------
    name : str
        Such as ``rebound_ratios.1``, ``collisions.0`` or ``force.0``.
    value : object
        A text, a number or a list; for a force record the name of its file, or a table.
    folder : Path
        The folder of the files.

    Returns
    -------
    object
        A count as a whole number, a force record as a DataArray, anything else unchanged.

    Raises
    ------
    FileError
        If a force record cannot be read.
    InvalidValue
        If the file has no force in it.

    Examples
    --------
    >>> convert_measured("collisions.0", "3", Path())
    3
    """
    if name.startswith("collisions.") and isinstance(value, str):
        count = count_written(value.strip())
        return value if count is None else count
    return read_force_record(name, value, folder) if name.startswith("force.") else value


def read_force_record(name: str, value: object, folder: Path) -> DataArray:
    """Return the force record of a file, or of a table that has one; see `read_question`."""
    from stackbounce.measure import read

    table = {"file": value} if isinstance(value, str) else value
    if not isinstance(table, Mapping) or not isinstance(table.get("file"), str):
        raise InvalidValue(f"{name} must be the name of a file with a force, got {shown(value)}")
    _check_keys(table, _RECORD + _READING, f"{name}.")
    path = folder / table["file"]
    data = read(path, **{key: value for key, value in table.items() if key in _READING})
    own = force_channels(data)
    if data.attrs["holds"] != "waveform" or not own:
        raise InvalidValue(
            f"{name}: {path} holds no force over time, but {a_or_an(data.attrs['holds'])}"
        )
    record = data[own[0]].dropna("time")
    ends = [quantity(table[k], "s", f"{name}.{k}") if k in table else None for k in _RECORD[1:3]]
    record = record.sortby("time").sel(time=slice(*ends))
    if "error" in table:
        unit = record.attrs.get("units", "")
        record.attrs["error"] = quantity(table["error"], unit, f"{name}.error")
    return record


def _parts(mapping: Mapping[str, Any], folder: Path) -> Parts:
    _check_keys(mapping, _DROP + _OWN, "")
    rest = {key: value for key, value in mapping.items() if key not in _OWN}
    if "drops" in mapping:
        if "measured" in mapping:
            raise InvalidValue("measured belongs to one of the drops: write [drops.measured] there")
        drops, data = _several(mapping["drops"], rest, folder)
    else:
        measured = _measured(mapping.get("measured", {}), "measured", folder)
        drops, data = {"": Drop.from_mapping(rest)}, {"": measured}
    data = {key: own for key, own in data.items() if own}
    tie = _flat(_table(mapping.get("tie", {}), "tie"))
    return Parts(drops, data, _vary(mapping.get("vary", {})), tie)


def _several(given: object, rest: Mapping[str, Any], folder: Path) -> Asked:
    if not isinstance(given, list) or not given:
        raise InvalidValue(f"drops must be tables, each under [[drops]], got {shown(given)}")
    drops: dict[str, Drop] = {}
    data = {}
    for k, drop in enumerate(given):
        own = dict(_table(drop, f"drops.{k}"))
        name = own.pop("name", None)
        check_name(f"drops.{k}.name", name, drops)
        _check_keys(own, (*_DROP, "measured", "name"), f"drops.{k}.")
        data[name] = _measured(own.pop("measured", {}), f"{name}.measured", folder)
        replaced = _INCIDENCE if any(key in own for key in _INCIDENCE) else ()
        common = {key: value for key, value in rest.items() if key not in replaced}
        with placed(f"{name}: ", ScenarioError):
            drops[name] = Drop.from_mapping(common | own)
    return drops, data


def check_name(path: str, name: object, drops: Mapping[str, Drop]) -> None:
    """Refuse what is no name of a drop, or that of another one."""
    if not (isinstance(name, str) and name.isidentifier()) or name in drops:
        raise InvalidValue(
            f"{path} must be a name of its own in letters, digits and _, such as B2_on_B1, "
            f"got {shown(name)}"
        )


def _check_keys(table: Mapping[str, Any], known: Sequence[str], path: str) -> None:
    for key in table:
        word = key if key.isidentifier() else shown(key)
        one_of(key, known, f"{path}{word[:60]} is not a known key")


def _measured(given: object, path: str, folder: Path) -> dict[str, Any]:
    table = _flat(_table(given, path), leaf=lambda one: "file" in one)
    return {name: convert_measured(name, value, folder) for name, value in table.items()}


def _vary(given: object) -> dict[str, Any]:
    if isinstance(given, list) and all(isinstance(name, str) for name in given):
        return dict.fromkeys(given)
    table = _flat(_table(given, "vary"), leaf=lambda one: bool(set(one) & set(_RANGE)))
    return {name: _bounds(name, value) for name, value in table.items()}


def _bounds(name: str, value: object) -> object:
    """Return the bounds or prior of a number: a table as a `Range`, an empty text as None."""
    if not isinstance(value, Mapping):
        return None if value == "" else value
    _check_keys(value, _RANGE, f"vary: {name}.")
    if ("low" in value) != ("high" in value) or not value:
        raise InvalidValue(f"vary: {name} must have both low and high, got {shown(dict(value))}")
    prior = value.get("prior")
    return Range(value["low"], value["high"], prior) if "low" in value else prior


def _table(given: object, path: str) -> Mapping[str, Any]:
    if not isinstance(given, Mapping):
        raise InvalidValue(f"{path} must be a table of names and values, got {shown(given)}")
    return given


def _flat(table: Mapping[str, Any], leaf: Any = lambda _: False, path: str = "") -> dict[str, Any]:
    """Flatten nested tables to full names; TOML nests tables where ``gaps.0`` has no quotes."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, Mapping) and not leaf(value):
            found |= _flat(value, leaf, f"{path}{key}.")
        else:
            found[path + key] = value
    return found
