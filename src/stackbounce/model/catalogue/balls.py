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
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from operator import itemgetter
from typing import Annotated, Any

from stackbounce.files import shipped
from stackbounce.model.ball import Ball
from stackbounce.model.laws import ContactLaw, Hysteretic, Spring
from stackbounce.shown import Shown, Table
from stackbounce.units import Unit, handy_text

MEASURED, RULE, ESTIMATE = KINDS = ("measured", "rule", "estimate")
"""What a figure is: measured, set by the rules of a game, or estimated."""

UNITS = {"mass": "kg", "diameter": "m", "restitution": "", "contact_time": "s"}
UNITS |= dict.fromkeys(("stiffness", "static_stiffness"), "N/m")
"""The unit of each figure of a ball."""


@dataclass(frozen=True, repr=False)
class CatalogueBall(Shown):
    """A ball of the catalogue with its numbers, and their sources.

    Parameters
    ----------
    ball : Ball
        With its mass, diameter and name.
    restitution : float
        The coefficient of restitution on a hard floor.
    stiffness : float
        The dynamic stiffness in N/m of its bounce on a hard floor.
    static_stiffness : float, optional
        The stiffness in N/m of the whole ball, pressed slowly between two plates.
    contact_time : float, optional
        The contact time on a hard floor, in s.
    sources : tuple of (str, str)
        The name and the source of each of these numbers.
    kinds : tuple of (str, str), optional
        The name of each number that is a ``"rule"``, the middle or the limit of what the rules of a
        game allow, or an ``"estimate"``. All others were measured, or follow from a measurement.
    lossy : bool, optional
        Whether its contacts lose energy as the restitution says.

    Examples
    --------
    >>> from stackbounce.model.catalogue import catalogue_ball
    >>> catalogue_ball("B1").stiffness
    54000.0
    """

    ball: Ball
    restitution: float
    stiffness: Annotated[float, Unit("N/m")]
    static_stiffness: Annotated[float, Unit("N/m")] | None
    contact_time: Annotated[float, Unit("s")] | None
    sources: tuple[tuple[str, str], ...]
    kinds: tuple[tuple[str, str], ...] = ()
    lossy: bool = False

    def _tables(self) -> Sequence[Table]:
        numbers, rows = self.to_mapping(), []
        for name, source in self.sources:
            value = handy_text(numbers[name], UNITS[name], 4)
            rows.append((name.replace("_", " "), value, self.kind_of(name), source))
        return (Table(str(self.ball.name), ("", "value", "kind", "source"), rows),)

    @property
    def contact(self) -> ContactLaw:
        """The contact law of the ball on a hard floor.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("B1").contact
        Spring(stiffness=54000.0)
        """
        if self.lossy:
            return Hysteretic(self.stiffness, restitution=self.restitution)
        return Spring(self.stiffness)

    def kind_of(self, figure: str) -> str:
        """Return whether a number is measured, a rule's or an estimate.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("football").kind_of("mass")
        'rule'
        """
        return dict(self.kinds).get(figure, MEASURED)

    def to_mapping(self) -> dict[str, Any]:
        """Return all numbers of the entry, including the fields of its `Ball`, as a flat dict.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("B1").to_mapping()["mass"]
        0.101
        """
        figures = {field.name: getattr(self, field.name) for field in fields(self)}
        listed = {"sources": dict(self.sources), "kinds": dict(self.kinds)}
        return asdict(figures.pop("ball")) | figures | listed


def _read_balls(group: str) -> Iterator[CatalogueBall]:
    """Yield the balls of a group, in the order of ``balls.csv``."""
    text = shipped(__package__, "balls.csv")
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

ENTRIES = {str(entry.ball.name): entry for entry in (*BALLS, *CLASS_BALLS)}
"""All entries by the names of their balls."""


@dataclass(frozen=True)
class Pair:
    """The springs and the gap that the paper fitted to a drop of two balls.

    Parameters
    ----------
    lower, upper : str
        The balls' names.
    floor_stiffness : float
        Of the spring below the lower ball, in N/m.
    stiffness : float
        Of the spring between the two, in N/m.
    gap : float
        Between the two, in m.
    source : str
        Where the fit stands.

    Examples
    --------
    >>> PAIRS[0].upper, PAIRS[0].stiffness
    ('tennis', 1000.0)
    """

    lower: str
    upper: str
    floor_stiffness: Annotated[float, Unit("N/m")]
    stiffness: Annotated[float, Unit("N/m")]
    gap: Annotated[float, Unit("m")]
    source: str


PAIRS: tuple[Pair, ...] = (
    Pair("basketball", "tennis", 2500.0, 1000.0, 0.0, "Cross 2007, Figure 9"),
    Pair("B1", "B2", 5.6e4, 1.6e4, 1.0e-3, "Cross 2007, section V, Figure 13"),
    Pair("B1", "B3", 5.4e4, 1.4e4, 2.4e-3, "Cross 2007, section V"),
)
"""The fits of the paper; those of the superballs had a lossy floor contact of restitution 0.78."""
