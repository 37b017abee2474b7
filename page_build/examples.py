"""Examples with the balls that a class owns, from ``examples.toml``."""

import tomllib
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

from stackbounce.cross2007.cases import Case
from stackbounce.model import Ball, Drop, Rigid
from stackbounce.model.catalogue import stack

_HEIGHT = 1.0  # m


def list_examples() -> Iterator[Case]:
    """Yield the examples, those of two balls first.

    Examples
    --------
    >>> [case.name for case in list_examples()][:2]
    ['class-touching', 'class-gap']
    """
    text = (files(__package__) / "examples.toml").read_text("utf-8")
    for name, example in tomllib.loads(text).items():
        yield Case(name, example["group"], example["title"], example["says"], _drop(example))


def _drop(example: dict[str, Any]) -> Drop:
    """Return the drop of an example; without a floor the lowest ball flies at the others."""
    if "masses" in example:
        balls = [Ball(mass) for mass in example["masses"]]
        return Drop(balls, [Rigid(1.0)] * len(balls), [example["gap"]], height=_HEIGHT)
    drop = stack(*example["balls"], gap=example["gap"], height=_HEIGHT)
    if example.get("floor", True):
        return drop
    velocities = [1.0] + [0.0] * len(drop.gaps)
    return Drop(drop.balls, [None, *drop.contacts[1:]], drop.gaps, velocities=velocities)
