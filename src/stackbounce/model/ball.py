"""A ball: its mass and, where needed, its diameter, elastic constants and name."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown
from stackbounce.shown import Shown, Table, call_of
from stackbounce.units import Unit, checked, handy_text, units_of

_POSITIVE = (("mass", "kilograms"), ("diameter", "metres"), ("young_modulus", "pascals"))


@dataclass(frozen=True)
class Ball(Shown):
    """One ball of a stack; its numbers are SI, or texts or quantities of pint with a unit.

    Parameters
    ----------
    mass : float
        In kg, above 0.
    diameter : float, optional
        In m, above 0; used by plots and `Hertz.between`. No run depends on it.
    name : str, optional
        The label in tables and plots.
    young_modulus : float, optional
        Young's modulus E of the material, in Pa, above 0; used by `Hertz.between` only.
    poisson_ratio : float, optional
        Poisson's ratio ν of the material, above -1 and at most 0.5, the range of stable isotropic
        materials; used by `Hertz.between` only.

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
    >>> Ball("57 g", diameter="6.6 cm").diameter
    0.066
    """

    mass: Annotated[float, Unit("kg")]
    diameter: Annotated[float, Unit("m")] | None = None
    name: str | None = None
    young_modulus: Annotated[float, Unit("Pa")] | None = None
    poisson_ratio: Annotated[float, Unit()] | None = None

    __repr__ = call_of

    def __post_init__(self) -> None:
        for name, of in _POSITIVE:
            value = getattr(self, name)
            if value is not None or name == "mass":
                object.__setattr__(self, name, checked(positive, name, value, of))
        if self.name is not None:
            _check_name(self.name)
        if self.poisson_ratio is not None:
            ratio = checked(_stable, "poisson_ratio", self.poisson_ratio)
            object.__setattr__(self, "poisson_ratio", ratio)

    def _tables(self) -> Sequence[Table]:
        rows = [
            (name.replace("_", " "), handy_text(getattr(self, name), unit.symbol))
            for name, unit in units_of(Ball).items()
            if getattr(self, name) is not None
        ]
        return (Table(self.name or "Ball", ("", ""), rows),)


def _stable(name: str, value: object) -> float:
    ratio = between(name, value, -1.0, 0.5)
    if ratio == -1.0:
        raise InvalidValue(f"{name} must be above -1, got {shown(value)}")
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
