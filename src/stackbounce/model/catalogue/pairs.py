"""The springs and gaps that the paper fitted to pairs of its balls."""

from dataclasses import dataclass
from typing import Annotated

from stackbounce.units import Unit


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
