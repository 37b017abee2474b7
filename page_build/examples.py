"""Examples with the balls that a class owns, from ``examples.toml``."""

import tomllib
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

from stackbounce.cross2007.cases import Case
from stackbounce.model import Drop
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
    chosen = stack(example["balls"])
    count = len(chosen.balls)
    gaps = [example["gap"]] * (count - 1)
    if example.get("floor", True):
        return Drop(chosen.balls, chosen.contacts, gaps, height=_HEIGHT)
    velocities = [1.0] + [0.0] * (count - 1)
    return Drop(chosen.balls, [None, *chosen.contacts[1:]], gaps, velocities=velocities)
