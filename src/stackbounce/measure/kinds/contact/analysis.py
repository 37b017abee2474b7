"""A known contact time and restitution, as a result like those of the analyses."""

from typing import Any

from stackbounce.errors import fraction
from stackbounce.measure.constants import dynamic_stiffness
from stackbounce.measure.kinds.contact.result import Known
from stackbounce.measure.quantities import measured

__all__ = ["known_contact"]


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
    time = None if contact_time is None else measured("contact_time", contact_time, "seconds")
    kept = None
    if restitution is not None:
        kept = measured(
            "restitution", restitution, "", lambda name, value, _: fraction(name, value)
        )
    stiffness = None if time is None or mass is None else dynamic_stiffness(mass, time)
    return Known(time, kept, stiffness)
