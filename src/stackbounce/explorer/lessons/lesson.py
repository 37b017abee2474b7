"""A lesson, as its file has it."""

import functools
import tomllib
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

NAMES = ("three-times", "stiffness", "gap", "own-ball")
"""Of the lessons, in their order."""

LANGUAGES = ("en", "de")
"""The codes of the languages that have all lessons, English first."""

Table = list[list[str]]
"""Rows of cells, the first one of headings; the cells that a row lacks are empty."""


@dataclass(frozen=True)
class Step:
    """A step: what it is called, how long it takes in minutes, and what to do."""

    title: str
    minutes: int
    text: str


@dataclass(frozen=True)
class Item:
    """An item of a worksheet: a text, perhaps with a table, a grid to draw in, and more text."""

    text: str
    table: Table = field(default_factory=list)
    grid: bool = False
    after: str = ""


@dataclass(frozen=True)
class Lesson:
    """A lesson. Its texts have links, see `split_links`; `table` belongs to the answers."""

    name: str
    title: str
    about: str
    for_whom: str
    minutes: int
    needs: str
    misconception: str
    steps: list[Step]
    questions: list[str]
    answers: list[str]
    remarks: list[str]
    worksheet: list[Item]
    table: Table = field(default_factory=list)
    example: str = ""


@functools.cache
def read_lesson(name: str, language: str = "en") -> Lesson:
    """Return a lesson of `NAMES` in one of `LANGUAGES`.

    Examples
    --------
    >>> read_lesson("gap").title, read_lesson("gap", "de").title
    ('The gap', 'Der Abstand')
    """
    text = (files(__package__) / language / f"{name}.toml").read_text("utf-8")
    known = _in_one_line(tomllib.loads(text))
    known["steps"] = [Step(**step) for step in known["steps"]]
    known["worksheet"] = [Item(**item) for item in known["worksheet"]]
    return Lesson(name=name, **known)


def _in_one_line(value: Any) -> Any:
    """Return what a file holds, the lines of each text joined."""
    if isinstance(value, dict):
        return {key: _in_one_line(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_in_one_line(item) for item in value]
    return " ".join(value.split()) if isinstance(value, str) else value
