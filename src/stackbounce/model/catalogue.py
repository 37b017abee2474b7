"""The catalogue: the balls of Cross (2007), each number with its source.

The spring of a single ball has its dynamic stiffness, from its bounce on a hard floor. For some
pairs of balls the paper fitted the spring between them: these pairs have that spring, in either
order. If such a pair is the lowest two balls in the order of the fit, it also has the fitted floor
spring and gap. Between any other two balls, their two springs act in series.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from typing import Annotated, Any

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.model.ball import Ball
from stackbounce.model.laws import Spring
from stackbounce.units import Unit

__all__ = ["BALLS", "PAIRS", "CatalogueBall", "Pair", "Stack", "catalogue_ball", "stack"]

_TABLE_I = "Cross 2007, Table I"
_SECTION_III = "Cross 2007, section III"


@dataclass(frozen=True)
class CatalogueBall:
    """A ball of the catalogue with the numbers that the paper gives, and their sources.

    Parameters
    ----------
    ball : Ball
        With its mass, diameter and name.
    restitution : float
        The coefficient of restitution on a hard floor.
    stiffness : float
        The dynamic stiffness in N/m of its bounce on a hard floor.
    static_stiffness : float
        The stiffness in N/m of the whole ball, pressed slowly between two plates.
    contact_time : float, optional
        The contact time on a hard floor, in s.
    sources : tuple of (str, str)
        The name and the source of each of these numbers.

    Examples
    --------
    >>> catalogue_ball("B1").stiffness
    54000.0
    """

    ball: Ball
    restitution: float
    stiffness: Annotated[float, Unit("N/m")]
    static_stiffness: Annotated[float, Unit("N/m")]
    contact_time: Annotated[float, Unit("s")] | None
    sources: tuple[tuple[str, str], ...]

    def to_mapping(self) -> dict[str, Any]:
        """Return all numbers of the entry, including the fields of its `Ball`, as a flat dict.

        Examples
        --------
        >>> catalogue_ball("B1").to_mapping()["mass"]
        0.101
        """
        figures = {one.name: getattr(self, one.name) for one in fields(self)}
        return asdict(figures.pop("ball")) | figures | {"sources": dict(self.sources)}


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


@dataclass(frozen=True)
class Stack:
    """A stack of balls of the catalogue: the arguments of a `Drop`, and their sources.

    Parameters
    ----------
    balls : tuple of Ball
        N balls, the lowest first.
    contacts : tuple of Spring
        N springs, each below its ball.
    gaps : tuple of float
        N - 1 distances in m.
    contact_sources : tuple of str
        Where each contact's stiffness comes from, (N,).
    gap_sources : tuple of str
        Where each gap comes from, (N - 1,).

    Examples
    --------
    >>> stack(["B1", "B2"]).gaps
    (0.001,)
    """

    balls: tuple[Ball, ...]
    contacts: tuple[Spring, ...]
    gaps: tuple[float, ...]
    contact_sources: tuple[str, ...]
    gap_sources: tuple[str, ...]


def _bounced(height: float, drop_height: float) -> tuple[float, str]:
    source = f"{_SECTION_III}: bounce to {height:.2f} m from {drop_height:.2f} m"
    return math.sqrt(height / drop_height), source


def _basketball() -> CatalogueBall:
    restitution, bounce = _bounced(0.42, 0.71)
    return CatalogueBall(
        ball=Ball(mass=0.150, diameter=0.160, name="basketball"),
        restitution=restitution,
        stiffness=2500.0,
        static_stiffness=30.0 / 18.6e-3,
        contact_time=None,
        sources=(
            ("mass", _SECTION_III),
            ("diameter", _SECTION_III),
            ("restitution", bounce),
            ("stiffness", "Cross 2007, Figure 9: k1 of the fit with a tennis ball on top"),
            ("static_stiffness", f"{_SECTION_III}, Figure 7: 18.6 mm at 30 N"),
        ),
    )


def _tennis() -> CatalogueBall:
    restitution, bounce = _bounced(0.40, 0.71)
    return CatalogueBall(
        ball=Ball(mass=0.057, diameter=0.066, name="tennis"),
        restitution=restitution,
        stiffness=2.25e4,
        static_stiffness=1.03e4,
        contact_time=5.0e-3,
        sources=(
            ("mass", _SECTION_III),
            ("diameter", _SECTION_III),
            ("restitution", bounce),
            ("stiffness", f"{_SECTION_III}: from the contact time"),
            ("static_stiffness", f"{_SECTION_III}, Figure 7: at 30 N"),
            ("contact_time", _SECTION_III),
        ),
    )


def _superball(
    name: str,
    *,
    diameter: float,
    mass: float,
    static_stiffness: float,
    contact_time: float,
    stiffness: float,
    restitution: float,
) -> CatalogueBall:
    figures = ("mass", "diameter", "restitution", "stiffness", "static_stiffness", "contact_time")
    return CatalogueBall(
        ball=Ball(mass=mass, diameter=diameter, name=name),
        restitution=restitution,
        stiffness=stiffness,
        static_stiffness=static_stiffness,
        contact_time=contact_time,
        sources=tuple((figure, _TABLE_I) for figure in figures),
    )


BALLS: tuple[CatalogueBall, ...] = (
    _basketball(),
    _tennis(),
    _superball(
        "B1",
        diameter=0.058,
        mass=0.101,
        static_stiffness=4e4,
        contact_time=4.3e-3,
        stiffness=5.4e4,
        restitution=0.78,
    ),
    _superball(
        "B2",
        diameter=0.038,
        mass=0.0248,
        static_stiffness=1.3e4,
        contact_time=2.6e-3,
        stiffness=3.6e4,
        restitution=0.90,
    ),
    _superball(
        "B3",
        diameter=0.026,
        mass=0.0085,
        static_stiffness=1.2e4,
        contact_time=1.9e-3,
        stiffness=2.3e4,
        restitution=0.90,
    ),
)
"""The balls of the paper."""

PAIRS: tuple[Pair, ...] = (
    Pair("basketball", "tennis", 2500.0, 1000.0, 0.0, "Cross 2007, Figure 9"),
    Pair("B1", "B2", 5.6e4, 1.6e4, 1.0e-3, "Cross 2007, section V, Figure 13"),
    Pair("B1", "B3", 5.4e4, 1.4e4, 2.4e-3, "Cross 2007, section V"),
)
"""The fits of the paper; those of the superballs had a lossy floor contact of restitution 0.78."""


def catalogue_ball(name: str) -> CatalogueBall:
    """Return the catalogue's entry for a ball's name; case does not matter.

    Parameters
    ----------
    name : str
        Such as ``"basketball"`` or ``"B1"``.

    Returns
    -------
    CatalogueBall

    Raises
    ------
    InvalidValue
        If the catalogue has no ball of this name; the message suggests the nearest.

    Examples
    --------
    >>> catalogue_ball("Tennis").ball.mass
    0.057
    """
    names = [str(entry.ball.name) for entry in BALLS]
    for known, entry in zip(names, BALLS, strict=True):
        if str(name).casefold() == known.casefold():
            return entry
    raise InvalidValue(
        f"ball must be one of the catalogue, got {shown(name)}; {nearest(name, names)}"
    )


def stack(names: Sequence[str]) -> Stack:
    """Return a stack of balls of the catalogue, with the springs and gaps that the paper gives.

    Parameters
    ----------
    names : sequence of str
        The balls, the lowest first.

    Returns
    -------
    Stack
        Its springs and gaps follow the rules in the docstring of this module.

    Raises
    ------
    InvalidValue
        If there is no name, or the catalogue lacks one of them.

    Examples
    --------
    >>> stack(["basketball", "tennis"]).contacts
    (Spring(stiffness=2500.0), Spring(stiffness=1000.0))
    """
    if not names:
        raise InvalidValue("balls must hold at least one name, got none")
    entries = [catalogue_ball(name) for name in names]
    lowest = _pair(*entries[:2]) if len(entries) > 1 else None
    contacts = [_floor(entries[0], lowest)]
    contacts += [_between(a, b) for a, b in itertools.pairwise(entries)]
    gaps = [(0.0, "no gap given")] * (len(entries) - 1)
    if lowest is not None and lowest.gap > 0.0:
        gaps[0] = (lowest.gap, lowest.source)
    return Stack(
        balls=tuple(entry.ball for entry in entries),
        contacts=tuple(Spring(stiffness) for stiffness, _ in contacts),
        gaps=tuple(gap for gap, _ in gaps),
        contact_sources=tuple(source for _, source in contacts),
        gap_sources=tuple(source for _, source in gaps),
    )


def _pair(lower: CatalogueBall, upper: CatalogueBall) -> Pair | None:
    names = (lower.ball.name, upper.ball.name)
    return next((pair for pair in PAIRS if (pair.lower, pair.upper) == names), None)


def _floor(ball: CatalogueBall, pair: Pair | None) -> tuple[float, str]:
    if pair is not None:
        return pair.floor_stiffness, pair.source
    return ball.stiffness, dict(ball.sources)["stiffness"]


def _between(lower: CatalogueBall, upper: CatalogueBall) -> tuple[float, str]:
    pair = _pair(lower, upper) or _pair(upper, lower)
    if pair is not None:
        return pair.stiffness, pair.source
    series = 1.0 / (1.0 / lower.stiffness + 1.0 / upper.stiffness)
    return series, f"{lower.ball.name} and {upper.ball.name} in series"
