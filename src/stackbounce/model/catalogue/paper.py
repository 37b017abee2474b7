"""The balls of Cross (2007), and the springs that the paper fitted to pairs of them."""

import math
from dataclasses import dataclass
from typing import Annotated, Any

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.entry import CatalogueBall
from stackbounce.units import Unit

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


_SUPERBALL = ("mass", "diameter", "restitution", "stiffness", "static_stiffness", "contact_time")


def _bounced(height: float) -> tuple[float, str]:
    """Return the restitution of a bounce from 0.71 m to a height in m, and its source."""
    return math.sqrt(height / 0.71), f"{_SECTION_III}: bounce to {height:.2f} m from 0.71 m"


def _entry(name: str, **figures: tuple[float, str]) -> CatalogueBall:
    """Return a ball of figures, each with its source."""
    given: dict[str, Any] = {figure: value for figure, (value, _) in figures.items()}
    return CatalogueBall(
        ball=Ball(mass=given.pop("mass"), diameter=given.pop("diameter"), name=name),
        sources=tuple((figure, source) for figure, (_, source) in figures.items()),
        **{"static_stiffness": None, "contact_time": None} | given,
    )


def _superball(name: str, *values: float) -> CatalogueBall:
    figures = zip(_SUPERBALL, values, strict=True)
    return _entry(name, **{figure: (value, _TABLE_I) for figure, value in figures})


BALLS: tuple[CatalogueBall, ...] = (
    _entry(
        "basketball",
        mass=(0.150, _SECTION_III),
        diameter=(0.160, _SECTION_III),
        restitution=_bounced(0.42),
        stiffness=(2500.0, "Cross 2007, Figure 9: k1 of the fit with a tennis ball on top"),
        static_stiffness=(30.0 / 18.6e-3, f"{_SECTION_III}, Figure 7: 18.6 mm at 30 N"),
    ),
    _entry(
        "tennis",
        mass=(0.057, _SECTION_III),
        diameter=(0.066, _SECTION_III),
        restitution=_bounced(0.40),
        stiffness=(2.25e4, f"{_SECTION_III}: from the contact time"),
        static_stiffness=(1.03e4, f"{_SECTION_III}, Figure 7: at 30 N"),
        contact_time=(5.0e-3, _SECTION_III),
    ),
    _superball("B1", 0.101, 0.058, 0.78, 5.4e4, 4e4, 4.3e-3),
    _superball("B2", 0.0248, 0.038, 0.90, 3.6e4, 1.3e4, 2.6e-3),
    _superball("B3", 0.0085, 0.026, 0.90, 2.3e4, 1.2e4, 1.9e-3),
)
"""The balls of the paper."""

PAIRS: tuple[Pair, ...] = (
    Pair("basketball", "tennis", 2500.0, 1000.0, 0.0, "Cross 2007, Figure 9"),
    Pair("B1", "B2", 5.6e4, 1.6e4, 1.0e-3, "Cross 2007, section V, Figure 13"),
    Pair("B1", "B3", 5.4e4, 1.4e4, 2.4e-3, "Cross 2007, section V"),
)
"""The fits of the paper; those of the superballs had a lossy floor contact of restitution 0.78."""
