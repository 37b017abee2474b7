"""The parameters of one drop, as the engine takes them."""

from stackbounce.engine.records import Drops
from stackbounce.model import Drop
from stackbounce.model.laws import contact_numbers


def drop_numbers(drop: Drop) -> Drops:
    """Return the parameters of a drop in the form that `prepare` takes, as lists."""
    rows = zip(*map(contact_numbers, drop.contacts), strict=True)
    form, first, second, third, fourth = map(list, rows)
    return Drops(
        mass=[ball.mass for ball in drop.balls],
        form=form,
        first=first,
        second=second,
        third=third,
        fourth=fourth,
        gap=[0.0, *drop.gaps],
        velocity=list(drop.start_velocities),
        gravity=drop.gravity,
    )


def drop_pieces(drop: Drop) -> list[list[float]]:
    """Return the pieces of the curves of each contact; none of one that is not a table."""
    return [[] if law is None else law.pieces() for law in drop.contacts]
