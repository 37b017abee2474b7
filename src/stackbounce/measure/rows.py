"""What an analysis found, as the rows of a table."""

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from uncertainties import UFloat

__all__ = ["Row"]


class Row(NamedTuple):
    """A quantity that was found: its name, its value (with an error if it has one) and SI unit."""

    name: str
    value: "UFloat | float | int | str"
    unit: str = ""
