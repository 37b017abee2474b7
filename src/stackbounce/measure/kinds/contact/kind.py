"""A known contact time and restitution as a kind of measurement without a file."""

from stackbounce.measure.kinds.contact.analysis import Known, known_contact
from stackbounce.measure.setup import Setup

__all__ = ["of_numbers"]


def of_numbers(setup: Setup) -> Known:
    """Return the contact that the numbers tell."""
    known = {"contact_time": setup.contact_time, "restitution": setup.restitution}
    return known_contact(mass=setup.mass, **known)
