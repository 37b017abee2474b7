"""What is known of a contact without a file."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from stackbounce.measure.finding import Finding
from stackbounce.measure.quantities import Row

if TYPE_CHECKING:
    from uncertainties import UFloat


__all__ = ["Known"]


@dataclass(frozen=True)
class Known(Finding):
    """A contact with the floor as typed, without a file; made by `known_contact`.

    Attributes
    ----------
    contact_time : ufloat or None
        In s.
    restitution : ufloat or None
        Of the bounce.
    stiffness : ufloat or None
        Dynamic, in N/m, where contact time and mass are known.
    notes : tuple of str
        What should be known about it, a sentence each.
    """

    contact_time: "UFloat | None"
    restitution: "UFloat | None"
    stiffness: "UFloat | None"
    notes: tuple[str, ...] = ()

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = (
            ("dynamic stiffness", self.stiffness, "N/m"),
            ("contact time", self.contact_time, "s"),
            ("restitution", self.restitution, ""),
        )
        return [Row(name, value, unit) for name, value, unit in rows if value is not None]

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact, as in a drop's TOML."""
        numbers = {"stiffness": self.stiffness, "restitution": self.restitution}
        told = {name: one.nominal_value for name, one in numbers.items() if one is not None}
        if not told:
            return {}
        law = "Hysteretic" if len(told) > 1 else "Spring" if "stiffness" in told else "Rigid"
        return {"contact": {"law": law, **told}}
