"""Scenario files: a drop in TOML, read with the standard library and written back exactly.

A drop is converted from and to plain mappings, the one schema of TOML files, JSON and the web. The
keys are the fields of the dataclasses, and the units are those of their ``Unit`` annotations. The
dataclasses validate the values. Reading only adds the path to their error messages.
"""

import json
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, fields
from typing import Any, TypeVar

from stackbounce.errors import InvalidValue, ScenarioError, between, nearest, placed, shown
from stackbounce.files import content_of
from stackbounce.model.ball import Ball
from stackbounce.model.laws import LAWS, STEEPEST, ContactLaw, law_named
from stackbounce.units import Unit, quantity, units_of

NO_FLOOR = "none"
"""The ``law`` of the lowest contact where there is no floor."""

_T = TypeVar("_T")

_BYTES = 2**19  # of a file, at most: room for 5000 balls, and read in about a second
_DEPTH = 5  # parts of a key, at most: time and memory grow with their square
_WORD = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_KEY = rf"{_WORD}(?:[ \t]*\.[ \t]*{_WORD}){{{_DEPTH}}}"
_DEEP = re.compile(rf"(?:^|[\[{{,])[ \t]*{_KEY}", re.MULTILINE)


def read_mapping(kind: type[_T], mapping: object) -> _T:
    """Return the drop, of class `kind`, that a mapping describes; see `Drop.from_mapping`."""
    table = _table(mapping, "the scenario")
    _check_keys(kind, table, "")
    values = {key: _value(kind, key, value, "") for key, value in table.items()}
    values["balls"] = _each(read_ball, table["balls"], "balls")
    values["contacts"] = _each(read_law, table["contacts"], "contacts")
    return _raised("", kind, **values)


def read_ball(value: object, path: str) -> Ball:
    """Return the ball that a mapping describes; `path` begins the messages."""
    table = _table(value, path)
    _check_keys(Ball, table, path)
    return _raised(path, Ball, **{key: _value(Ball, key, one, path) for key, one in table.items()})


def read_law(value: object, path: str) -> ContactLaw | None:
    """Return the contact law that a mapping with a ``law`` describes; None for no floor."""
    table = dict(_table(value, path))
    if "law" not in table:
        raise ScenarioError(f"{path}.law is missing; {nearest('', [*LAWS, NO_FLOOR])}")
    name = table.pop("law")
    if isinstance(name, str) and name.casefold() == NO_FLOOR:
        if table:
            raise ScenarioError(f'{path}.law = "{NO_FLOOR}" has no numbers, got {shown(table)}')
        return None
    try:
        kind = law_named(name)
    except InvalidValue as error:
        raise ScenarioError(f"{path}.{error}, {NO_FLOOR}") from error
    _check_keys(kind, table, path)
    exponent = _value(kind, "exponent", table["exponent"], path) if "exponent" in table else 1.0
    values = {key: _value(kind, key, one, path, exponent) for key, one in table.items()}
    return _raised(path, kind, **values)


def write_mapping(drop: Any) -> dict[str, Any]:
    """Return the drop as plain values; see `Drop.to_mapping`."""
    plain = {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in _given(drop).items()
        if name not in ("balls", "contacts")
    }
    balls = [_given(ball) for ball in drop.balls]
    laws = [{"law": NO_FLOOR} if law is None else law.to_mapping() for law in drop.contacts]
    return plain | {"balls": balls, "contacts": laws}


def _given(instance: Any) -> dict[str, Any]:
    values = {field.name: getattr(instance, field.name) for field in fields(instance) if field.init}
    return {name: value for name, value in values.items() if value is not None}


def _table(value: object, path: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise ScenarioError(f"{path} must be a table of keys and values, got {shown(value)}")
    return {str(key): one for key, one in value.items() if one is not None}


def _check_keys(kind: type, table: Iterable[str], path: str) -> None:
    known = {field.name: field for field in fields(kind) if field.init}
    for key in table:
        if key not in known:
            name = key if key.isidentifier() and len(key) < 60 else shown(key)
            raise ScenarioError(f"{_join(path, name)} is not a known key; {nearest(key, known)}")
    for name, value in known.items():
        if value.default is MISSING and name not in table:
            raise ScenarioError(f"{_join(path, name)} is missing")


def _each(read: Any, values: object, path: str) -> list[Any]:
    if not isinstance(values, list | tuple):
        raise ScenarioError(f"{path} must be a list of tables, got {shown(values)}")
    return [read(value, f"{path}.{i}") for i, value in enumerate(values)]


def _value(kind: type, key: str, value: object, path: str, exponent: float = 1.0) -> Any:
    unit = units_of(kind).get(key)
    if unit is None:
        return value
    if "exponent" in unit.symbol:
        _raised("", between, f"{path}.exponent", exponent, 1.0, STEEPEST)
        power = "" if exponent == 1.0 else f"**{exponent!r}"
        unit = Unit(unit.symbol.replace("**exponent", power))
    place = _join(path, key)
    if isinstance(value, list | tuple):
        return [
            _raised("", quantity, member, unit.symbol, f"{place}.{i}")
            for i, member in enumerate(value)
        ]
    return _raised("", quantity, value, unit.symbol, place)


def _raised(path: str, make: Callable[..., _T], *arguments: object, **values: Any) -> _T:
    """Return what a function returns; its errors are those of a scenario, at a path."""
    with placed(_join(path, ""), ScenarioError):
        return make(*arguments, **values)


def _join(path: str, key: str) -> str:
    return f"{path}.{key}" if path else key


def read_toml(kind: type[_T], path: str | os.PathLike[str]) -> _T:
    """Return the drop, of class `kind`, of a scenario file; see `Drop.from_toml`."""
    name, mapping = load_toml(path)
    with placed(f"{name}: "):
        return read_mapping(kind, mapping)


def load_toml(path: object) -> tuple[str, dict[str, Any]]:
    """Read a TOML file; return its name and its contents as a mapping.

    Raises
    ------
    InvalidType
        If `path` is no path.
    FileError
        If the file cannot be read: see `content_of`.
    ScenarioError
        If it is not TOML, or its keys or values are nested too deeply.
    """
    name, content = content_of(path, _BYTES)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{name} is not TOML: it is not text in UTF-8") from error
    if _DEEP.search(text):
        raise ScenarioError(f"{name}: a key has more than {_DEPTH} parts between dots")
    try:
        return name, tomllib.loads(text)
    except RecursionError as error:
        raise ScenarioError(f"{name} is not TOML: its values are nested too deeply") from error
    except ValueError as error:
        raise ScenarioError(f"{name} is not TOML: {' '.join(str(error).split())}") from error


def write_toml(mapping: Mapping[str, Any]) -> str:
    """Return a mapping of plain values, lists of them, and lists of tables as TOML."""
    lines = []
    tables = []
    for key, value in mapping.items():
        if isinstance(value, list) and value and isinstance(value[0], Mapping):
            for table in value:
                tables += ["", f"[[{key}]]"]
                tables += [f"{name} = {_written(one)}" for name, one in table.items()]
        else:
            lines.append(f"{key} = {_written(value)}")
    return "\n".join(lines + tables) + "\n"


def _written(value: object) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return f"[{', '.join(_written(item) for item in value)}]"
    return repr(value)
