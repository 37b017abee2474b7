"""What an analysis found, as the rows of a table."""

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from uncertainties import UFloat

__all__ = ["Row"]


class Row(NamedTuple):
<<<<<<< HEAD
<<<<<<< HEAD
    """A quantity that was found: its name, its value (with an error if it has one) and SI unit."""
=======
    """A quantity that was found: name, value (with an error where it has one) and SI unit."""
>>>>>>> m-s
=======
    """A quantity that was found: its name, value (with an error where it has one) and SI unit."""
>>>>>>> m-p

    name: str
    value: "UFloat | float | int | str"
    unit: str = ""
