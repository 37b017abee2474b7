"""From laws to what is measured of them, and from a drop to its separate collisions."""

from dataclasses import replace

from stackbounce.errors import InvalidType, shown
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw, Hysteretic, Rigid, Spring

__all__ = ["restitution", "separate"]


def restitution(law: ContactLaw) -> float:
    """Return the restitution of one contact: its relative speed after over that before.

    Parameters
    ----------
    law : ContactLaw
        For these laws the restitution is the same at every speed.

    Returns
    -------
    float
        From 0 to 1.

    Raises
    ------
    InvalidType
        If `law` is no contact law.

    Notes
    -----
    A `Spring` gives back all that it took. For `Hysteretic` see R. Cross, Am. J. Phys. 75, 1009
    (2007), section V.

    Examples
    --------
    >>> from stackbounce.model import Hysteretic
    >>> restitution(Hysteretic(5.6e4, unloading_exponent=7))
    0.5
    """
    match law:
        case Rigid() | Hysteretic():
            return law.restitution
        case Spring():
            return 1.0
        case _:
            raise InvalidType(f"law must be a contact law, got {shown(law)}")


def separate(drop: Drop) -> Drop:
    """Return the textbook's version of a drop: one instantaneous collision after the other.

    Parameters
    ----------
    drop : Drop
        Any drop.

    Returns
    -------
    Drop
        The same drop with every contact `Rigid`, with the restitution of the law that it had, and
        without gravity, which does nothing in a collision that takes no time.

    Raises
    ------
    InvalidType
        If `drop` is no Drop.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4.

    Examples
    --------
    >>> from stackbounce.model import Ball, Drop, Spring
    >>> drop = Drop([Ball(0.150), Ball(0.057)], [Spring(2500), Spring(1000)], impact_speed=3.53)
    >>> separate(drop).contacts
    (Rigid(restitution=1.0), Rigid(restitution=1.0))
    """
    if not isinstance(drop, Drop):
        raise InvalidType(f"drop must be a Drop, got {shown(drop)}")
    contacts = [None if law is None else Rigid(restitution(law)) for law in drop.contacts]
    rigid = replace(drop, contacts=contacts)
    if drop.gravity == 0.0:
        return rigid
    if drop.height is None:
        return replace(rigid, gravity=0.0)
    return replace(rigid, gravity=0.0, height=None, impact_speed=drop.reference_speed)
