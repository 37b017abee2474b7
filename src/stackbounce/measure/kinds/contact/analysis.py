"""A known contact time and restitution, as a result like those of the analyses."""

from dataclasses import dataclass
from typing import Any

from stackbounce.errors import fraction
from stackbounce.measure.constants import dynamic_stiffness
from stackbounce.measure.finding import Finding
from stackbounce.measure.quantities import Number, Row, known_rows, measured_if_given

__all__ = ["Known", "known_contact"]


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

    contact_time: Number | None
    restitution: Number | None
    stiffness: Number | None
    notes: tuple[str, ...] = ()

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        return known_rows(
            [
                ("dynamic stiffness", self.stiffness, "N/m"),
                ("contact time", self.contact_time, "s"),
                ("restitution", self.restitution, ""),
            ]
        )

    def parts(self) -> dict[str, Any]:
        """Return the floor's contact, as in a drop's TOML."""
        numbers = {"stiffness": self.stiffness, "restitution": self.restitution}
        told = {name: one.nominal_value for name, one in numbers.items() if one is not None}
        if not told:
            return {}
        law = "Hysteretic" if len(told) > 1 else "Spring" if "stiffness" in told else "Rigid"
        return {"contact": {"law": law, **told}}


def known_contact(*, contact_time: Any = None, restitution: Any = None, mass: Any = None) -> Known:
    """Return a contact with the floor from a contact time, a restitution or both.

    Parameters
    ----------
    contact_time : float or UFloat, optional
        From touch to release, in s.
    restitution : float or UFloat, optional
        Of the bounce, from 0 to 1.
    mass : float or UFloat, optional
        Of the ball, in kg: gives the dynamic stiffness.

    Returns
    -------
    Known

    Raises
    ------
    InvalidValue
        If a number is out of its range.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> for row in known_contact(contact_time=5e-3, mass=0.057).rows():
    ...     print(row.name, f"{row.value.nominal_value:.4g}", row.unit)
    dynamic stiffness 2.25e+04 N/m
    contact time 0.005 s
    """
    time = measured_if_given("contact_time", contact_time, "seconds")
    kept = measured_if_given("restitution", restitution, check=fraction)
    stiffness = None if time is None or mass is None else dynamic_stiffness(mass, time)
    return Known(time, kept, stiffness)
