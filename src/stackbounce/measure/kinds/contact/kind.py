"""A known contact time and restitution, as a result like those of the analyses."""

from dataclasses import dataclass
from typing import Annotated, Any

from stackbounce.errors import fraction
from stackbounce.measure.constants import dynamic_stiffness
from stackbounce.measure.finding import Finding, Listed
from stackbounce.measure.quantities import Number, measured_if_given, nominal
from stackbounce.measure.setup import Setup


@dataclass(frozen=True, repr=False)
class Known(Finding):
    """A contact with the floor as typed, without a file; made by `of_numbers`.

    Attributes
    ----------
    stiffness : ufloat or None
        Dynamic, in N/m, where contact time and mass are known.
    contact_time : ufloat or None
        In s.
    restitution : ufloat or None
        Of the bounce.
    notes : tuple of str
        What should be known about it, a sentence each.
    """

    stiffness: Annotated[Number | None, Listed("dynamic stiffness", "N/m")]
    contact_time: Annotated[Number | None, Listed("contact time", "s")]
    restitution: Annotated[Number | None, Listed("restitution")]
    notes: tuple[str, ...] = ()

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact, as in a drop's TOML."""
        numbers = {"stiffness": self.stiffness, "restitution": self.restitution}
        known = {name: nominal(number) for name, number in numbers.items() if number is not None}
        if not known:
            return {}
        law = "Hysteretic" if len(known) > 1 else "Spring" if "stiffness" in known else "Rigid"
        return {"contact": {"law": law, **known}}


def of_numbers(setup: Setup) -> Known:
    """Return a contact with the floor from a contact time, a restitution or both.

    Raises
    ------
    InvalidValue
        If a number is out of its range.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> for row in of_numbers(Setup(contact_time=5e-3, mass=0.057)).rows():
    ...     print(row.name, f"{row.value.nominal_value:.4g}", row.unit)
    dynamic stiffness 2.25e+04 N/m
    contact time 0.005 s
    """
    time = measured_if_given("contact_time", setup.contact_time, "seconds")
    kept = measured_if_given("restitution", setup.restitution, check=fraction)
    known = time is not None and setup.mass is not None
    return Known(dynamic_stiffness(setup.mass, time) if known else None, time, kept)
