"""Contacts that lose energy by their rate: the force follows from the compression and its rate."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

from stackbounce.errors import between, non_negative, positive
from stackbounce.model.laws.elastic import STEEPEST
from stackbounce.units import Unit

__all__ = ["Dashpot", "HuntCrossley", "Viscoelastic"]


@dataclass(frozen=True)
class Dashpot:
    """A linear spring and a dashpot side by side, which cannot pull.

    ``F = max(0, k c + b ċ)`` while the compression c is above 0, else 0: Kelvin's and Voigt's
    solid. The contact begins with a force b times the speed of the touch. It ends when the force is
    back at zero, which is before the compression is; in between, k c**2/2 counts as stored.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0.
    damping : float
        b, in N s/m, 0 or above.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `damping` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: Bartz, arXiv 2007.15005. A contact that were to end at c = 0 would pull, and have
    another restitution.

    Examples
    --------
    >>> Dashpot(22500, damping=7.2)
    Dashpot(stiffness=22500.0, damping=7.2)
    """

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, Unit("N/m")]
    damping: Annotated[float, Unit("N s/m")]

    def __post_init__(self) -> None:
        object.__setattr__(self, "stiffness", positive("stiffness", self.stiffness, "N/m"))
        object.__setattr__(self, "damping", non_negative("damping", self.damping, "N s/m"))


@dataclass(frozen=True)
class Viscoelastic:
    """The contact of two viscoelastic spheres, or of one and a flat floor.

    ``F = max(0, k (c**1.5 + 1.5 A sqrt(c) ċ))`` while the compression c is above 0, else 0. The
    contact ends when the force is back at zero, which is before the compression is; in between,
    k c**2.5/2.5 counts as stored.

    Parameters
    ----------
    stiffness : float
        k, in N/m**1.5, above 0, as of `Hertz`.
    dissipative_time : float
        A, in s, 0 or above: a constant of the material.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `dissipative_time` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: G. Kuwabara and K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov,
    F. Spahn, J.-M. Hertzsch and T. Pöschel, Phys. Rev. E 53, 5382 (1996). Valid where the speed is
    well below that of sound.

    Examples
    --------
    >>> Viscoelastic(3e6, dissipative_time=1e-4)
    Viscoelastic(stiffness=3000000.0, dissipative_time=0.0001)
    """

    exponent: ClassVar[float] = 1.5
    stiffness: Annotated[float, Unit("N/m**1.5")]
    dissipative_time: Annotated[float, Unit("s")]

    def __post_init__(self) -> None:
        k = positive("stiffness", self.stiffness, "N/m**1.5")
        time = non_negative("dissipative_time", self.dissipative_time, "seconds")
        object.__setattr__(self, "stiffness", k)
        object.__setattr__(self, "dissipative_time", time)


@dataclass(frozen=True)
class HuntCrossley:
    """A power law with a damping that grows as the force does.

    ``F = max(0, k c**p (1 + χ ċ))`` while the compression c is above 0, else 0. A contact of two
    bodies ends when force and compression are back at zero, since they part more slowly than 1/χ;
    ``k c**(p + 1)/(p + 1)`` counts as stored.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float
        p, from 1 to 1e6; 1.5 for spheres.
    dissipation : float
        χ, in s/m, 0 or above.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, `exponent` is out of its range, or `dissipation`
        is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42, 440 (1975). They write λ = k χ.

    Examples
    --------
    >>> HuntCrossley(3e6, 1.5, dissipation=0.15)
    HuntCrossley(stiffness=3000000.0, exponent=1.5, dissipation=0.15)
    """

    stiffness: Annotated[float, Unit("N/m**exponent")]
    exponent: Annotated[float, Unit()]
    dissipation: Annotated[float, Unit("s/m")]

    def __post_init__(self) -> None:
        k = positive("stiffness", self.stiffness, "N/m**exponent")
        chi = non_negative("dissipation", self.dissipation, "s/m")
        object.__setattr__(self, "stiffness", k)
        object.__setattr__(self, "exponent", between("exponent", self.exponent, 1.0, STEEPEST))
        object.__setattr__(self, "dissipation", chi)
