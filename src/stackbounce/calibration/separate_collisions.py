"""The separate collisions of a drop: the same stack with rigid contacts."""

import sys
from dataclasses import replace

from stackbounce.calibration.collision import reduced, restitution
from stackbounce.errors import InvalidType, shown
from stackbounce.model.drop import Drop
from stackbounce.model.laws import Rigid

__all__ = ["separate"]


def separate(drop: Drop) -> Drop:
    """Return a drop with rigid contacts: the textbook model of separate collisions.

    Parameters
    ----------
    drop : Drop
        Any drop.

    Returns
    -------
    Drop
        The same drop, in which each contact is `Rigid` with the restitution of its former law.
        Gravity is 0, because it has no effect during an instantaneous collision.

    Raises
    ------
    InvalidType
        If `drop` is no Drop.
    InvalidValue
        If the restitution of a contact cannot be computed in floating point, or a contact is a
        `Bond`, which has none.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4.

    If the restitution depends on the speed, the closing speed of the first collision is used. For
    this speed the contacts collide once each, from the bottom up: ball 0 hits the floor at its
    start velocity, and ball i meets ball i - 1 after the collision at contact i - 1. A contact that
    would not close in this order gets the restitution at the drop's `reference_speed`. All later
    collisions of a contact have the same restitution.

    Examples
    --------
    >>> from stackbounce.model import Ball, Drop, Spring
    >>> drop = Drop([Ball(0.150), Ball(0.057)], [Spring(2500), Spring(1000)], impact_speed=3.53)
    >>> separate(drop).contacts
    (Rigid(restitution=1.0), Rigid(restitution=1.0))
    """
    if not isinstance(drop, Drop):
        raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
    rigid = replace(drop, contacts=_collisions(drop))
    if drop.gravity == 0.0:
        return rigid
    if drop.height is None:
        return replace(rigid, gravity=0.0)
    return replace(rigid, gravity=0.0, height=None, impact_speed=drop.reference_speed)


def _collisions(drop: Drop) -> list[Rigid | None]:
    """Return each contact as `Rigid`, with its restitution in collisions from the bottom up."""
    contacts: list[Rigid | None] = []
    below = 0.0  # velocity of what lies below: the floor, then the ball after its own collision
    for i, law in enumerate(drop.contacts):
        own, mass = drop.start_velocities[i], drop.balls[i].mass
        if law is None:
            contacts.append(None)
            below = own
            continue
        moving = mass if i == 0 else reduced((drop.balls[i - 1].mass, mass))
        closing = min(below - own, sys.float_info.max)
        e = restitution(law, moving, closing if closing > 0.0 else drop.reference_speed)
        contacts.append(Rigid(e))
        # m v' = m v + (1 + e) μ (v_below - v), as eqs 1 and 2
        below = own + (1.0 + e) * moving / mass * max(0.0, closing)
    return contacts
