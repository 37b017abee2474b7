"""A known contact time and restitution as a kind of measurement without a file."""

from typing import Any

from stackbounce.measure.kind import Kind

__all__ = ["CONTACT"]


def _of_numbers(*, contact_time: Any = None, restitution: Any = None, mass: Any = None) -> Any:
    from stackbounce.measure.kinds.contact.analysis import known_contact

    return known_contact(contact_time=contact_time, restitution=restitution, mass=mass)


CONTACT = Kind(
    "contact",
    "dynamic stiffness of a contact time",
    of_numbers=_of_numbers,
    starts_with=("contact_time", "restitution"),
    typed="contact with the floor",
)
