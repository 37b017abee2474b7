"""The figures that are drops or lines, as links that open them in the explorer."""

from collections.abc import Iterator
from dataclasses import asdict, replace
from typing import Any, NamedTuple
from urllib.parse import urlencode

from stackbounce.cross2007.bench import PAPER, Bench
from stackbounce.cross2007.cases import list_cases, list_lines
from stackbounce.cross2007.style import read_words
from stackbounce.model import Drop


class Link(NamedTuple):
    """A link to the explorer: its text and its address."""

    text: str
    address: str


def link_figures(explorer: str) -> dict[str, list[Link]]:
    """Return the links of each figure by its number.

    Parameters
    ----------
    explorer : str
        The address of the explorer.

    Examples
    --------
    >>> [link.text for link in link_figures("../")["8"]]
    ['Play this drop', 'Play Figure 8 with a gap of 2 mm']
    """
    cases = {case.name: case for case in list_cases()}
    found: dict[str, list[Link]] = {}
    for number, words in read_words().items():
        for name in words.get("cases", ()):
            text = f"Play {cases[name].title}" if number in found else "Play this drop"
            address = explorer_address(explorer, _as_drawn(number, cases[name].drop), {})
            found.setdefault(number, []).append(Link(text, address))
    for line in list_lines():
        number = line.name.removeprefix("figure-").partition("-")[0]
        view = {"view": "line", "line": {"x": asdict(line.across), "show": "rebound_ratio"}}
        address = explorer_address(explorer, line.drop, view)
        link = Link(f"Open as a line: {line.title}", address)
        found.setdefault(number, []).append(link)
    return found


def explorer_address(explorer: str, drop: Drop, settings: dict[str, Any]) -> str:
    """Return the address of a drop in the explorer, with paths and values as in its own addresses.

    Parameters
    ----------
    explorer : str
        The address of the explorer.
    drop : Drop
        What it shows.
    settings : dict
        What its address says besides, by path or as dicts; the view is ``play`` by default.

    Examples
    --------
    >>> from stackbounce import Ball, Drop, Spring
    >>> drop = Drop([Ball(0.1)], [Spring(1e3)], impact_speed=1.0)
    >>> explorer_address("../", drop, {"loop": 1})[:38]
    '../#view=play&impact_speed=1.0&gravity'
    """
    state = {"view": "play", **drop.to_mapping(), **settings}
    return f"{explorer}#{urlencode(list(_flatten('', state)))}"


def _as_drawn(number: str, drop: Drop) -> Drop:
    """Return an example's drop as its figure has it: that of Fig. 10(b) has a gap."""
    return replace(drop, gaps=[Bench(PAPER)("superballs.gap")]) if number == "10b" else drop


def _flatten(path: str, value: Any) -> Iterator[tuple[str, str]]:
    if isinstance(value, dict | list | tuple):
        members = value.items() if isinstance(value, dict) else enumerate(value)
        for key, member in members:
            yield from _flatten(f"{path}.{key}" if path else str(key), member)
    elif value is not None:
        yield path, str(value).lower() if isinstance(value, bool) else str(value)
