"""The contact between two balls, from the contact of each with a hard floor."""

from stackbounce.errors import InvalidValue
from stackbounce.model.laws import ContactLaw, series

__all__ = ["between"]


def between(law_a: ContactLaw, law_b: ContactLaw) -> ContactLaw:
    """Return the contact law between two balls: the floor contacts of both in series.

    Parameters
    ----------
    law_a, law_b : ContactLaw
        The law of each ball on a hard floor.

    Returns
    -------
    ContactLaw
        That of `series`, if the two in series are exactly one law. `Hysteretic` contacts with
        different restitutions are not (a lossless law counts as one with restitution 1). For them
        the result is an approximation: the `Hysteretic` law with the loading curve and the energy
        loss of both. Its restitution is ``e**2 = f e_a**2 + (1 - f) e_b**2``, where f is the
        fraction of the compression, and of the work, that `law_a` takes.

    Raises
    ------
    InvalidValue
        If there is no such law: the classes, exponents or other parameters do not match.
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
        if a is None or b is None or a.exponent != b.exponent:
            raise
    both: ContactLaw = a.pressed_on(b)
    return both
