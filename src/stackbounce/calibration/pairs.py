"""The contact of two balls, from the contacts that each of them has with a hard floor."""

import math

from stackbounce.errors import InvalidValue
from stackbounce.model.laws import ContactLaw, Hertz, Hysteretic, PowerLaw, Spring, series

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
    >>> one, other = Hysteretic(3e4, restitution=0.8), Hysteretic(1e4, restitution=0.6)
    >>> both = between(one, other)
    >>> round(both.stiffness, 6), round(both.restitution, 6)
    (7500.0, 0.655744)
    """
    try:
        return series(law_a, law_b)
    except InvalidValue:
        a, b = _hysteretic(law_a), _hysteretic(law_b)
        if a is None or b is None or (a.exponent, a.reloading) != (b.exponent, b.reloading):
            raise
    p = a.exponent
    soft_a, soft_b = a.stiffness ** (-1.0 / p), b.stiffness ** (-1.0 / p)
    f = soft_a / (soft_a + soft_b)
    kept = f * a.restitution**2 + (1.0 - f) * b.restitution**2
    stiffness = (soft_a + soft_b) ** -p
    return Hysteretic(stiffness, exponent=p, restitution=math.sqrt(kept), reloading=a.reloading)


def _hysteretic(law: ContactLaw) -> Hysteretic | None:
    """Return a law without a rate in it as one with hysteresis, be it none."""
    if isinstance(law, Hysteretic):
        return law
    if isinstance(law, Spring | Hertz | PowerLaw):
        return Hysteretic(law.stiffness, exponent=law.exponent, restitution=1.0)
    return None
