"""Two contacts in series as one law, exactly or nearly."""

import math
from typing import TypeVar

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.model.laws.law import ContactLaw

_Law = TypeVar("_Law", bound=ContactLaw)
_AGREE = 1e-12  # numbers that agree so well differ by round-off


def series(law_a: _Law, law_b: _Law) -> _Law:
    """Return the law of two contacts in series: equal forces, and compressions that add up.

    The contact between two balls is the contact of each with the floor, in series.

    Parameters
    ----------
    law_a, law_b : ContactLaw
        Two laws of the same class and exponent, not `Rigid`. For lossy laws, the ratio of the two
        compressions must not depend on the rate: see the notes.

    Returns
    -------
    ContactLaw
        Of the same class, with the stiffness ``k**(-1/p) = k1**(-1/p) + k2**(-1/p)``.

    Raises
    ------
    InvalidValue
        If the two in series are not equivalent to one law of their class.
    InvalidType
        If one of them is no contact law.

    Notes
    -----
    Without a mass in between, ``F1(c1) = F2(c2)`` and ``c = c1 + c2``. The law of both is of the
    same class if, and only if, ``c1 = f c`` at all times, with ``f = k1**(-1/p) / (k1**(-1/p) +
    k2**(-1/p))``. This holds for springs and power laws; for `Dashpot` if b/k is the same; for
    `StandardLinearSolid` if Δ and τ are the same; for `Viscoelastic` if A is the same (its force is
    ``k (s + A ṡ)`` with ``s = c**1.5``); for `HuntCrossley` if ``χ1 f = χ2 (1 - f)``, which then is
    the χ of both in series; for `Hysteretic` if `restitution` is the same.

    Springs: R. Cross, Am. J. Phys. 75, 1009 (2007), section V.

    Examples
    --------
    >>> from stackbounce.model.laws import HuntCrossley, Spring
    >>> series(Spring(54000), Spring(36000))
    Spring(stiffness=21600.0)
    >>> series(HuntCrossley(2e6, 1.0, 0.1), HuntCrossley(2e6, 1.0, 0.1))
    HuntCrossley(stiffness=1000000.0, exponent=1.0, dissipation=0.05)
    """
    _check_classes(law_a, law_b)
    ours, theirs = law_a.series_constants(), law_b.series_constants()
    for name, our in ours.items():
        if not math.isclose(our, theirs[name], rel_tol=_AGREE):
            raise InvalidValue(
                f"law_a and law_b must have the same {name}, got {shown(our)} and "
                f"{shown(theirs[name])}: in series they are no {type(law_a).__name__}, as their "
                "shares of the compression change"
            )
    p = law_a.exponent
    ratio = (law_a.stiffness / law_b.stiffness) ** (1.0 / p)  # c2/c1
    share_a, share_b = 1.0 / (1.0 + ratio), ratio / (1.0 + ratio)
    # the softer law takes the larger share
    k = min(law_a.stiffness, law_b.stiffness) * max(share_a, share_b) ** p
    return law_a.replaced(law_a.series_changes(k, share_a))


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
    >>> from stackbounce.model.laws import Hysteretic
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


def _check_classes(law_a: object, law_b: object) -> None:
    for name, law in (("law_a", law_a), ("law_b", law_b)):
        if not isinstance(law, ContactLaw):
            raise InvalidType(f"{name} must be a contact law, got {shown(law)}")
        if law.rigid:
            raise InvalidValue(f"{name} must be a law with a compression, got {shown(law)}")
    if type(law_a) is not type(law_b):
        got = f"{type(law_a).__name__} and {type(law_b).__name__}"
        raise InvalidValue(
            f"law_a and law_b must be of one class, got {got}: if both are powers with one "
            "exponent, write them as PowerLaw; otherwise they are none of the laws in series"
        )
