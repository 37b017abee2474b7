"""The contact of two balls, from the contacts that each of them has with a hard floor."""

from stackbounce.errors import InvalidValue
from stackbounce.model.laws import ContactLaw, series

__all__ = ["between"]


def between(law_a: ContactLaw, law_b: ContactLaw) -> ContactLaw:
    """Return the law by which two balls press on each other: both of theirs in series.

    Parameters
    ----------
    law_a, law_b : ContactLaw
        Those of each ball on a hard floor.

    Returns
    -------
    ContactLaw
        As `series` where this is exact. `Hysteretic` contacts with different restitutions (a power
        law's is 1) are no law of the table in series: the `Hysteretic` one returned has their
        loading curve, and gives back as much energy as both, ``e**2 = f e_a**2 + (1 - f) e_b**2``
        with a's share f of the compression and so, at one exponent, of the work.

    Raises
    ------
    InvalidValue
        If there is no such law.
    InvalidType
        If one of them is no contact law.

    Examples
    --------
    >>> from stackbounce.model import Hysteretic
    >>> one, other = Hysteretic(3e4, restitution=0.8), Hysteretic(1e4, restitution=0.6)
    >>> both = between(one, other)
    >>> round(both.stiffness, 6), round(both.restitution, 6)
    (7500.0, 0.655744)
    """
    try:
        return series(law_a, law_b)
    except InvalidValue:
        a, b = law_a.as_hysteretic(), law_b.as_hysteretic()
        if a is None or b is None or (a.exponent, a.reloading) != (b.exponent, b.reloading):
            raise
    return a.pressed_on(b)
