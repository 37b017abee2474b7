"""A contact time and a restitution that are known, without a file."""

from stackbounce.measure.kind import Kind

CONTACT = Kind(
    "contact",
    "dynamic stiffness of a contact time",
    f"{__name__}.kind",
    options=("contact_time", "restitution", "mass"),
    starts_with=("contact_time", "restitution"),
    typed="contact with the floor",
)
