"""The links in the texts of lessons: ``[words](explorer: WHAT)`` and ``[words](lesson: NAME)``.

WHAT is the name of one of the explorer's examples, such as ``cannon``, or balls of the catalogue
with commas, the lowest first, then ``key=value`` pairs. ``gap`` and ``height`` change the drop, in
units; all others are settings that the explorer's address has, such as ``view=line``.
"""

import re
from typing import NamedTuple

from stackbounce.cross2007.cases import list_cases
from stackbounce.cross2007.playable import explorer_address
from stackbounce.explorer.examples import list_examples
from stackbounce.model import Drop
from stackbounce.model.catalogue import stack
from stackbounce.units import quantity

_LINK = re.compile(r"\[([^\]]+)\]\((explorer|lesson): ([^)]+)\)")


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
    drop = _drop(" ".join(words[:first]), settings)
    return explorer_address("", drop, settings).removeprefix("#")


def _drop(names: str, settings: dict[str, str]) -> Drop:
    """Return an example, or balls of the catalogue, of which `gap` and `height` are taken out."""
    cases = {case.name: case.drop for case in (*list_examples(), *list_cases())}
    if names in cases:
        return cases[names]
    chosen = stack([name.strip() for name in names.split(",")])
    gap = quantity(settings.pop("gap", "0 m"), "m", "gap")
    height = quantity(settings.pop("height", "1m"), "m", "height")
    gaps = [gap] * (len(chosen.balls) - 1)
    return Drop(chosen.balls, chosen.contacts, gaps, height=height)
