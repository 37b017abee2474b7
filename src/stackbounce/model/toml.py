"""Scenario files: a drop in TOML, read with the standard library and written back exactly."""

import json
import os
import re
import tomllib
from collections.abc import Mapping
from typing import Any, TypeVar

from stackbounce.errors import ScenarioError
from stackbounce.files import content_of
from stackbounce.model.schema import read_mapping

_T = TypeVar("_T")

_BYTES = 2**19  # of a file, at most: room for 5000 balls, and read in about a second
_DEPTH = 5  # parts of a key, at most: time and memory grow with their square
_WORD = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_KEY = rf"{_WORD}(?:[ \t]*\.[ \t]*{_WORD}){{{_DEPTH}}}"
_DEEP = re.compile(rf"(?:^|[\[{{,])[ \t]*{_KEY}", re.MULTILINE)


def read_toml(kind: type[_T], path: str | os.PathLike[str]) -> _T:
    """Return the drop, of class `kind`, of a scenario file; see `Drop.from_toml`."""
    name, mapping = load_toml(path)
    try:
        return read_mapping(kind, mapping)
    except ScenarioError as error:
        raise ScenarioError(f"{name}: {error}") from error


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
