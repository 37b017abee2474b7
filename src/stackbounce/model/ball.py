"""A ball: its mass and, where needed, its diameter, elastic constants and name."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from stackbounce.errors import InvalidType, InvalidValue, between, positive, shown
from stackbounce.shown import Shown, Table, call_of
from stackbounce.units import Unit, handy_text

_UNITS = {"mass": "kg", "diameter": "m", "young_modulus": "Pa", "poisson_ratio": ""}


@dataclass(frozen=True)
class Ball(Shown):
    """One ball of a stack.

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
    """

    mass: Annotated[float, Unit("kg")]
    diameter: Annotated[float, Unit("m")] | None = None
    name: str | None = None
    young_modulus: Annotated[float, Unit("Pa")] | None = None
    poisson_ratio: Annotated[float, Unit()] | None = None

    __repr__ = call_of

    def __post_init__(self) -> None:
        object.__setattr__(self, "mass", positive("mass", self.mass, "kilograms"))
        for name, unit in (("diameter", "metres"), ("young_modulus", "pascals")):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, positive(name, getattr(self, name), unit))
        if self.name is not None:
            _check_name(self.name)
        if self.poisson_ratio is not None:
            object.__setattr__(self, "poisson_ratio", _poisson_ratio(self.poisson_ratio))

    def _tables(self) -> Sequence[Table]:
        numbers = {name: getattr(self, name) for name in _UNITS}
        known = {name: value for name, value in numbers.items() if value is not None}
        rows = [(name.replace("_", " "), handy_text(x, _UNITS[name])) for name, x in known.items()]
        return (Table(self.name or "Ball", ("", ""), rows),)


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
