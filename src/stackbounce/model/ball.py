"""A ball: a mass, and where they are needed its size, its material and a name."""

from dataclasses import dataclass
from typing import Annotated

from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown
from stackbounce.units import Unit

__all__ = ["Ball"]


@dataclass(frozen=True)
class Ball:
    """One ball of a stack.

    Parameters
    ----------
    mass : float
        In kg, above 0.
    diameter : float, optional
        In m, above 0; for pictures and for `Hertz.between`, no run depends on it.
    name : str, optional
        What tables and pictures call it.
    young_modulus : float, optional
        E of its material, in Pa, above 0; for `Hertz.between` only.
    poisson_ratio : float, optional
        ν of its material, above -1 and at most 0.5, as thermodynamics has it; for `Hertz.between`
        only.

    Raises
    ------
    InvalidValue
        If `mass`, `diameter` or `young_modulus` is not positive and finite, `poisson_ratio` is out
        of its range, or `name` is empty or no text.
    InvalidType
        If one of them has the wrong type.

    Examples
    --------
    >>> Ball(mass=0.057, name="tennis").name
    'tennis'
    """

    mass: Annotated[float, Unit("kg")]
    diameter: Annotated[float, Unit("m")] | None = None
    name: str | None = None
    young_modulus: Annotated[float, Unit("Pa")] | None = None
    poisson_ratio: Annotated[float, Unit()] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "mass", positive("mass", self.mass, "kilograms"))
        for name, unit in (("diameter", "metres"), ("young_modulus", "pascals")):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, positive(name, getattr(self, name), unit))
        if self.name is not None:
            _check_name(self.name)
        if self.poisson_ratio is not None:
            object.__setattr__(self, "poisson_ratio", _poisson_ratio(self.poisson_ratio))


def _poisson_ratio(value: object) -> float:
    ratio = between("poisson_ratio", value, -1.0, 0.5)
    if ratio == -1.0:
        raise InvalidValue(f"poisson_ratio must be above -1, got {shown(value)}")
    return ratio


def _check_name(name: object) -> None:
    if not isinstance(name, str):
        raise InvalidType(f"name must be a string, got {shown(name)}")
    if not name.strip():
        raise InvalidValue(f"name must not be empty, got {shown(name)}")
    try:
        name.encode()
    except UnicodeEncodeError:  # a lone surrogate
        raise InvalidValue(f"name must be text that UTF-8 can write, got {shown(name)}") from None
