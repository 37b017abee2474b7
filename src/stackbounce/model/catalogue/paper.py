"""The balls of Cross (2007), and the springs that the paper fitted to pairs of them."""

import math
from dataclasses import dataclass
from typing import Annotated

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.entry import CatalogueBall
from stackbounce.units import Unit

__all__ = ["BALLS", "PAIRS", "Pair"]

_TABLE_I = "Cross 2007, Table I"
_SECTION_III = "Cross 2007, section III"


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
