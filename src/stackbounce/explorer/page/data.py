"""What the page knows of the package, as JSON: `model.json`."""

import dataclasses
import functools
import itertools
import json
from typing import Any

from stackbounce.cross2007.lines import list_lines
from stackbounce.explorer.answers import catalogue, maps, play
from stackbounce.explorer.limits import LIMITS
from stackbounce.explorer.page.lessons import list_lessons
from stackbounce.explorer.page.units import list_units
from stackbounce.json_values import as_json
from stackbounce.model import STANDARD_GRAVITY, STEEPEST
from stackbounce.model.catalogue import BALLS, CLASS_BALLS, pressed, stack
from stackbounce.run.result import Cause, Status
from stackbounce.units import examples

__all__ = ["model_json"]


@functools.cache
def model_json() -> str:
    """Return the balls, laws, cases, limits, units and words that the page needs, as JSON.

    Examples
    --------
    >>> sorted(json.loads(model_json()))[:4]
    ['advice', 'balls', 'contacts', 'energy']
    """
    known = json.loads(catalogue.list_choices(LIMITS))
    return as_json(
        known
        | {
            "advice": {one.name: one.advice for one in (*Status, *Cause)},
            "contacts": _list_contacts(),
            "energy": maps.ENERGY,
            "gravity": STANDARD_GRAVITY,
            "kinds": examples(),
            "lessons": list_lessons(),
            "lines": _list_lines(),
            "map_rtol": maps.RTOL,
            "outcomes": maps.OUTCOMES,
            "ratios": {
                name: {"sets": sets, "refers": refers, "label": label}
                for name, (sets, refers, label) in maps.RATIOS.items()
            },
            "rtol": play.RTOL,
            "stacks": _list_stacks(),
            "steepest": STEEPEST,
            "units": list_units(),
            "usual": {
                "contact_time": catalogue.DEFAULT_CONTACT_TIME,
                "exponent": catalogue.DEFAULT_EXPONENT,
                "restitution": catalogue.DEFAULT_CONTACT.restitution,
            },
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
    """Return each ball's contact with the floor, as it is and as it is pressed on another one."""
    return {
        str(entry.ball.name): {
            "floor": entry.contact.to_mapping(),
            "pressed": pressed(entry).to_mapping(),
        }
        for entry in (*BALLS, *CLASS_BALLS)
    }


def _list_stacks() -> dict[str, Any]:
    """Return contacts and gaps of any two of the paper's balls, and their gap further up."""
    found = {}
    for names in itertools.product([str(entry.ball.name) for entry in BALLS], repeat=2):
        two, three = stack(names), stack([names[0], *names])
        found[" ".join(names)] = {
            "floor": (two.contacts[0].to_mapping(), two.contact_sources[0]),
            "between": (two.contacts[1].to_mapping(), two.contact_sources[1]),
            "gap": (two.gaps[0], two.gap_sources[0]),
            "other_gap": (three.gaps[1], three.gap_sources[1]),
        }
    return found
