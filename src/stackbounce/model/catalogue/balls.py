"""The catalogue's balls, from ``balls.csv``: each figure in SI units, with kind and source.

The group ``paper`` has the balls of Cross (2007), the group ``class`` those that a class owns. A
measured figure of these comes first, then the middle of what the rules of the game allow, then an
estimate, whose source says how it was made. The figures of a bounce hold for the drop height or
speed that their source names; a ball of another make, pressure or age has others.

Source of the compressions: L. J. Dowell and G. Krebs, Br. J. Sports Med. 25, 34 (1991), who dropped
balls on carbon paper. They found a compression of d = c v, as of a linear spring, which gives
the contact time π c.
"""

import csv
import itertools
from collections.abc import Iterable, Iterator, Mapping
from importlib.resources import files
from operator import itemgetter
from typing import Any

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.entry import ESTIMATE, MEASURED, CatalogueBall
from stackbounce.model.laws import Hysteretic


def _read_balls(group: str) -> Iterator[CatalogueBall]:
    """Yield the balls of a group, in the order of ``balls.csv``."""
    text = (files(__package__) / "balls.csv").read_text("utf-8")
    rows = [row for row in csv.DictReader(text.splitlines()) if row["group"] == group]
    for name, figures in itertools.groupby(rows, itemgetter("ball")):
        yield _entry(name, list(figures))


def _entry(name: str, figures: Iterable[Mapping[str, str]]) -> CatalogueBall:
    """Return a ball; one without a stiffness gets that of a lossy contact with its bounce."""
    numbers: dict[str, Any] = {row["figure"]: float(row["value"]) for row in figures}
    sources = {row["figure"]: row["source"] for row in figures}
    kinds = {row["figure"]: row["kind"] for row in figures if row["kind"] != MEASURED}
    lossy = "stiffness" not in numbers
    if lossy:
        wanted = numbers | {"exponent": 1.0, "impact_speed": 1.0}
        numbers["stiffness"] = Hysteretic.calibrated(wanted).stiffness
        sources["stiffness"] = "from mass, contact time and restitution, as a Hysteretic contact"
        if ESTIMATE in [kinds.get(key) for key in ("mass", "restitution", "contact_time")]:
            kinds["stiffness"] = ESTIMATE
    return CatalogueBall(
        ball=Ball(mass=numbers.pop("mass"), diameter=numbers.pop("diameter"), name=name),
        sources=tuple(sources.items()),
        kinds=tuple(kinds.items()),
        lossy=lossy,
        **{"static_stiffness": None, "contact_time": None} | numbers,
    )


BALLS = tuple(_read_balls("paper"))
"""The balls of the paper."""

CLASS_BALLS = tuple(_read_balls("class"))
"""The balls that a class owns; their contacts lose energy as measured."""
