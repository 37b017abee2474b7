"""What the page knows of the package: `model.json`, `options.json`, the code of laws, `laws.js`.

Balls, contact laws, examples, the paper's lines and lessons, with the numbers that each check lets
through, found by asking it.
"""

import dataclasses
import functools
import itertools
import math
import sys
import tomllib
from collections.abc import Callable
from importlib.resources import files
from typing import Any

from page_build.examples import list_examples
from page_build.lessons.lesson import list_lessons
from stackbounce.cross2007.cases import list_cases, list_lines
from stackbounce.cross2007.drops import bisect
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.explorer.limits import LIMITS, RTOL
from stackbounce.json_values import as_json
from stackbounce.measure.options import options_for
from stackbounce.model import LAWS, STANDARD_GRAVITY, STEEPEST, ContactLaw, Hysteretic
from stackbounce.model.catalogue import BALLS, CLASS_BALLS, stacked
from stackbounce.version import __version__

WORDS: dict[str, Any] = tomllib.loads((files(__package__) / "words.toml").read_text("utf-8"))
"""What the page calls numbers of laws, what maps show, and the ratios that they vary."""

_TOLD = ("says", "formula", "source", "form", "rigid", "exact", "loss", "least_restitution")
"""What the page takes of a law as it is."""

_FIRST = "figure-9"
"""The example that stands above the others: the paper's pair."""

_LOSSY = Hysteretic  # the paper's own way to lose energy
MAP_RTOL = 1e-8
"""The tolerance of nonlinear contacts in maps and lines, far finer than their colours."""

_ENERGY = ("kinetic energy retained", "")
_USUAL = {"contact_time": 5e-3, "exponent": 1.5, "restitution": 0.8}
"""What a law takes over from one that has none of it: in s a tennis ball's, of a solid ball, of a
floor where there was none."""


def list_choices() -> dict[str, Any]:
    """Return balls, contact laws, examples and the limits of a request."""
    cases = sorted((*list_examples(), *list_cases()), key=lambda case: case.name != _FIRST)
    return {
        "stackbounce": __version__,
        "balls": [entry.to_mapping() for entry in (*BALLS, *CLASS_BALLS)],
        "laws": [_describe_law(kind) for kind in LAWS.values()],
        "lossy_law": _LOSSY.__name__,
        "presets": [vars(case) | {"drop": case.drop.to_mapping()} for case in cases],
        "limits": LIMITS,
    }


def _describe_law(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return what the page shows of a law and computes with, and what it is in the engine."""
    return {
        "law": kind.__name__,
        **{name: getattr(kind, name) for name in _TOLD},
        "fields": [_describe_number(kind, name) for name in kind.quantities()],
        "parameters": (kind.third_number, kind.fourth_number),
        "loss_fields": list(kind.loss_fields or filter(None, [kind.loss])),
        "constant_loss": not kind.loss_depends_on,
        "exponent": kind.fixed_exponent(),
        "usual_exponent": kind.default_exponent(),
        "needs": {"linear": kind.calibration_needs(1.0), "other": kind.calibration_needs(2.0)},
    }


def _describe_number(kind: type[ContactLaw], name: str) -> dict[str, Any]:
    """Return a number of a law: words, unit, limits, slider, where a search starts, usual value."""
    number, words = kind.quantities()[name], name.replace("_", " ")
    initial, low, high = number.slider
    usual = getattr(kind, name, None)
    return {
        "name": name,
        "unit": number.symbol,
        "required": not hasattr(kind, name),
        "default": initial if usual is None else usual,
        "low": low,
        "high": high,
        "start": low if name == kind.loss else initial,
        "says": words,
        "words": words,
        "explains": "",
        **WORDS["numbers"].get(name, {}),
        **limits_of(number.check),
        **({"usual": usual} if hasattr(kind, name) else {}),
    }


def limits_of(check: Callable[[str, object], float]) -> dict[str, Any]:
    """Return the least and the largest number that a check lets through, and its words.

    The numbers that a check lets through are an interval. Its ends are found by bisection, to the
    last bit.

    Examples
    --------
    >>> from stackbounce.errors import fraction
    >>> limits_of(fraction)
    {'right': 'a number from 0 to 1', 'least': 0.0, 'most': 1.0}
    """
    right = ""
    try:
        check("x", None)
    except InvalidType as error:
        right = str(error).removeprefix("x must be ").removesuffix(", got None")

    def holds(value: float) -> bool:
        try:
            check("x", value)
        except InvalidValue:
            return False
        return True

    inside = next(value for value in (1.0, 0.5, 2.0, -1.0, 0.0, 1e3, 1e-3) if holds(value))
    return {
        "right": right,
        "least": _last(holds, inside, -sys.float_info.max),
        "most": _last(holds, inside, sys.float_info.max),
    }


def _last(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return the last number from `inside` towards `outside` for which something holds."""
    if holds(outside):
        return outside
    low, high = sorted([inside, outside])
    end = bisect(lambda value: 1.0 if holds(value) else -1.0, low, high)
    return 0.0 + (end if holds(end) else math.nextafter(end, inside))  # not -0.0


@functools.cache
def model_json() -> str:
    """Return the balls, laws, cases, limits, units and words that the page needs, as JSON.

    Examples
    --------
    >>> import json
    >>> sorted(json.loads(model_json()))[:4]
    ['balls', 'contacts', 'energy', 'gravity']
    """
    return as_json(
        list_choices()
        | {
            "contacts": _list_contacts(),
            "energy": _ENERGY,
            "gravity": STANDARD_GRAVITY,
            "lessons": list_lessons(),
            "lines": _list_lines(),
            "map_rtol": MAP_RTOL,
            "outcomes": WORDS["outcomes"],
            "ratios": WORDS["ratios"],
            "rtol": RTOL,
            "stacks": _list_stacks(),
            "steepest": STEEPEST,
            "usual": _USUAL,
        }
    )


def laws_js() -> str:
    """Return what the page computes of some laws in their own way, see `ContactLaw.page_code`.

    Examples
    --------
    >>> laws_js().splitlines()[0]
    'export const LAW_CODE = {'
    """
    codes = (
        f"  {name}: {{ {', '.join(f'{what}: {code}' for what, code in kind.page_code.items())} }},"
        for name, kind in LAWS.items()
        if kind.page_code
    )
    return "\n".join(["export const LAW_CODE = {", *codes, "};", ""])


def options_json() -> str:
    """Return the options of the page's form of a measurement, as JSON.

    Examples
    --------
    >>> import json
    >>> json.loads(options_json())["options"][0]["name"]
    'mass'
    """
    told = ("name", "form", "label", "example", "says", "rare")
    options = [
        {name: getattr(option, name) for name in told}
        | {"choices": None if option.choices is None else list(option.choices)}
        for option in options_for("read", "analyse").values()
    ]
    return as_json({"options": options})


def _list_lines() -> list[dict[str, Any]]:
    """Return the paper's lines: a drop each, what varies, and what was measured of each ball."""
    return [
        {
            **{name: getattr(line, name) for name in ("name", "title", "says")},
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
        alone = stacked([str(entry.ball.name)])
        found[str(entry.ball.name)] = alone.contacts[0].to_mapping(), alone.contact_sources[0]
    return found


def _list_stacks() -> dict[str, Any]:
    """Return the contact of any two balls, and where the lower one's differs, floor and gap."""
    found = {}
    names = [str(entry.ball.name) for entry in (*BALLS, *CLASS_BALLS)]
    for lower, upper in itertools.product(names, repeat=2):
        two, alone = stacked([lower, upper]), stacked([lower])
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
