"""What the page knows of the package, as JSON: `model.json`."""

import dataclasses
import functools
import itertools
from typing import Any

from stackbounce.cross2007.cases import list_lines
from stackbounce.explorer.answers import play
from stackbounce.explorer.page.catalogue import WORDS, list_choices
from stackbounce.explorer.page.lessons import list_lessons
from stackbounce.explorer.page.units import list_units
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, STEEPEST
from stackbounce.model.catalogue import BALLS, CLASS_BALLS, stack
from stackbounce.run.result import Cause, Status
from stackbounce.units import examples

MAP_RTOL = 1e-8
"""The tolerance of nonlinear contacts in maps and lines, far finer than their colours."""

_ENERGY = ("kinetic energy retained", "")
_USUAL = {"contact_time": 5e-3, "exponent": 1.5, "restitution": 0.8}
"""What a law takes over from one that has none of it: in s a tennis ball's, of a solid ball, of a
floor where there was none."""


@functools.cache
def model_json() -> str:
    """Return the balls, laws, cases, limits, units and words that the page needs, as JSON.

    Examples
    --------
    >>> import json
    >>> sorted(json.loads(model_json()))[:4]
    ['advice', 'balls', 'contacts', 'energy']
    """
    return as_json(
        list_choices()
        | {
            "advice": {ending.name: ending.advice for ending in (*Status, *Cause)},
            "contacts": _list_contacts(),
            "energy": _ENERGY,
            "gravity": STANDARD_GRAVITY,
            "kinds": examples(),
            "lessons": list_lessons(),
            "lines": _list_lines(),
            "map_rtol": MAP_RTOL,
            "outcomes": WORDS["outcomes"],
            "ratios": WORDS["ratios"],
            "rtol": play.RTOL,
            "stacks": _list_stacks(),
            "steepest": STEEPEST,
            "units": list_units(),
            "usual": _USUAL,
        }
    )


def _list_lines() -> list[dict[str, Any]]:
    """Return the paper's lines: a drop each, what varies, and what was measured of each ball."""
    return [
        {
            "name": line.name,
            "title": line.title,
            "says": line.says,
            "drop": line.drop.to_mapping(),
            "x": dataclasses.asdict(line.across),
            "measured": [{"value": value, "error": error} for value, error in line.measured],
        }
        for line in list_lines()
    ]


def _list_contacts() -> dict[str, Any]:
    """Return each ball's contact with the floor, and its source."""
    found = {}
    for entry in (*BALLS, *CLASS_BALLS):
        alone = stack([str(entry.ball.name)])
        found[str(entry.ball.name)] = alone.contacts[0].to_mapping(), alone.contact_sources[0]
    return found


def _list_stacks() -> dict[str, Any]:
    """Return the contact of any two balls, and where the lower one's differs, floor and gap."""
    found = {}
    names = [str(entry.ball.name) for entry in (*BALLS, *CLASS_BALLS)]
    for lower, upper in itertools.product(names, repeat=2):
        two, alone = stack([lower, upper]), stack([lower])
        floor, between = (
            (law.to_mapping(), source)
            for law, source in zip(two.contacts, two.contact_sources, strict=True)
        )
        pair: dict[str, Any] = {"between": between}
        if floor[1] != alone.contact_sources[0]:
            pair["floor"] = floor
        if two.gaps[0] > 0.0:
            pair["gap"] = two.gaps[0], two.gap_sources[0]
        found[f"{lower} {upper}"] = pair
    return found
