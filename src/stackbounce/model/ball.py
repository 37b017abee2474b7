"""A ball: a mass, and for pictures a diameter and a name."""

from dataclasses import dataclass
from typing import Annotated

from stackbounce.errors import InvalidType, InvalidValue, positive, shown
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
        In m, above 0; for pictures, no result depends on it.
    name : str, optional
        What tables and pictures call it.

    Raises
    ------
    InvalidValue
        If `mass` or `diameter` is not positive and finite, or `name` is empty or no text.
    InvalidType
        If one of them has the wrong type.

    Examples
    --------
    >>> Ball(mass=0.057, name="tennis")
    Ball(mass=0.057, diameter=None, name='tennis')
    """

    mass: Annotated[float, Unit("kg")]
    diameter: Annotated[float, Unit("m")] | None = None
    name: str | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "mass", positive("mass", self.mass, "kilograms"))
        if self.diameter is not None:
            object.__setattr__(self, "diameter", positive("diameter", self.diameter, "metres"))
        if self.name is not None:
            _check_name(self.name)


def _check_name(name: object) -> None:
    if not isinstance(name, str):
        raise InvalidType(f"name must be a string, got {shown(name)}")
    if not name.strip():
        raise InvalidValue(f"name must not be empty, got {shown(name)}")
    try:
        name.encode()
    except UnicodeEncodeError:  # a lone surrogate
        raise InvalidValue(f"name must be text that UTF-8 can write, got {shown(name)}") from None
