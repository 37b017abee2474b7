"""A lesson, as its file has it, and as the page has it: with links that the page can follow.

The links in its texts are ``[words](explorer: WHAT)`` and ``[words](lesson: NAME)``. WHAT is the
name of one of the explorer's examples, such as ``cannon``, or balls of the catalogue with commas,
the lowest first, then ``key=value`` pairs. ``gap`` and ``height`` change the drop, in units; all
others are settings that the explorer's address has, such as ``view=line``.
"""

import functools
import re
import tomllib
from importlib.resources import files
from typing import Any, NamedTuple

from page_build.examples import list_examples
from stackbounce.cross2007.cases import explorer_address, list_cases
from stackbounce.model import Drop
from stackbounce.model.catalogue import stack

NAMES = ("three-times", "stiffness", "gap", "own-ball")
"""Of the lessons, in their order."""

LANGUAGES = ("en", "de")
"""The codes of the languages that have all lessons, English first."""

_LINK = re.compile(r"\[([^\]]+)\]\((explorer|lesson): ([^)]+)\)")


@functools.cache
def read_lesson(name: str, language: str = "en") -> dict[str, Any]:
    """Return a lesson of `NAMES` in one of `LANGUAGES`, as its file has it.

    Its `steps` have a `title`, `minutes` and a `text`. An item of its `worksheet` has a `text`, and
    perhaps a `table`, a `grid` to draw in, and text `after` these; the lesson's own `table` belongs
    to the answers. A table is a list of rows, the first one of headings; the cells that a row lacks
    are empty.

    Examples
    --------
    >>> read_lesson("gap")["title"], read_lesson("gap", "de")["title"]
    ('The gap', 'Der Abstand')
    """
    text = (files(__package__) / language / f"{name}.toml").read_text("utf-8")
    return {"name": name, **_in_one_line(tomllib.loads(text))}


def _in_one_line(value: Any) -> Any:
    """Return what a file holds, the lines of each text joined."""
    if isinstance(value, dict):
        return {key: _in_one_line(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_in_one_line(item) for item in value]
    return " ".join(value.split()) if isinstance(value, str) else value


class Link(NamedTuple):
    """A link: its words, where it leads (``explorer`` or ``lesson``), and what it shows there."""

    words: str
    to: str
    what: str


def split_links(text: str) -> list[str | Link]:
    """Return the parts of a text: texts without links, and links.

    Examples
    --------
    >>> split_links("See [the gap](lesson: gap).")
    ['See ', Link(words='the gap', to='lesson', what='gap'), '.']
    """
    parts: list[str | Link] = []
    end = 0
    for found in _LINK.finditer(text):
        parts += [text[end : found.start()], Link(*found.groups())]
        end = found.end()
    return [part for part in [*parts, text[end:]] if part]


def explorer_fragment(what: str) -> str:
    """Return the part of the explorer's address after the ``#``.

    Raises
    ------
    InvalidValue
        If there is no such example and no such ball.

    Examples
    --------
    >>> explorer_fragment("tennis ball height=2m")[:20]
    'view=play&height=2.0'
    """
    words = what.split()
    first = next((i for i, word in enumerate(words) if "=" in word), len(words))
    settings = dict(word.split("=", 1) for word in words[first:])
    drop = _drop_of(" ".join(words[:first]), settings)
    return explorer_address(drop, settings).removeprefix("#")


def _drop_of(names: str, settings: dict[str, str]) -> Drop:
    """Return an example, or balls of the catalogue, of which `gap` and `height` are taken out."""
    cases = {case.name: case.drop for case in (*list_examples(), *list_cases())}
    if names in cases:
        return cases[names]
    balls, gap = (name.strip() for name in names.split(",")), settings.pop("gap", "0 m")
    return stack(*balls, gap=gap, height=settings.pop("height", None))


def list_lessons() -> dict[str, list[dict[str, Any]]]:
    """Return the lessons by language. A text with links is the list of its parts.

    A link is an object with its `words` and the `fragment` of the page's address, or a `lesson`.

    Examples
    --------
    >>> lessons = list_lessons()
    >>> lessons["en"][0]["title"], lessons["en"][0]["minutes"]
    ('Three times the speed?', 45)
    """
    return {
        language: [_told(read_lesson(name, language)) for name in NAMES] for language in LANGUAGES
    }


def _told(value: Any) -> Any:
    """Return a lesson, or a part of it, with its links taken out of its texts."""
    if isinstance(value, dict):
        return {key: _told(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_told(item) for item in value]
    if isinstance(value, str) and _LINK.search(value):
        return [_link(part) for part in split_links(value)]
    return value


def _link(part: str | Link) -> str | dict[str, str]:
    if isinstance(part, str):
        return part
    if part.to == "lesson":
        return {"words": part.words, "lesson": part.what}
    return {"words": part.words, "fragment": explorer_fragment(part.what)}
