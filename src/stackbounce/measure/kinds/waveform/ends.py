"""How contacts of a law begin and end: the one place where a law decides what flanks may be."""

from typing import Any, NamedTuple

from stackbounce.errors import InvalidType, InvalidValue, between, shown
from stackbounce.measure.kinds.waveform.shapes import FADE, JUMP, ROOT, Shape
from stackbounce.model.laws import (
    LAWS,
    ContactLaw,
    Dashpot,
    Hertz,
    HuntCrossley,
    Hysteretic,
    PowerLaw,
    Rigid,
    Spring,
    Viscoelastic,
    law_named,
)

__all__ = ["UNTOLD", "Ends", "ends_of"]

_OTHERS, _SLOWING = 0.03, 0.04  # spreads of the corrections where the law is told
_SOFTEST, _STEEPEST = 6.0, 100.0  # exponents of a hysteretic release, and of what can be fitted
_FIXED: dict[type[Any], float] = {Spring: Spring.exponent, Hertz: Hertz.exponent}


class Ends(NamedTuple):
    """What the touch of a contact may be, and its release."""

    touch: Shape
    release: Shape


UNTOLD = Ends(Shape(1.0, 1.5), Shape(1.0, 2.5))
"""Where no law is told.

A linear spring has the exponent 1, Hertz's law 1.5; larger ones are rarer, 2 (a cone) to 2.5. A
contact that loses energy ends more softly than it begins: with an exponent of (p + 1) / e**2 - 1
where it unloads along a power law of its own, which is 2.5 for p = 1.25 and a restitution e of 0.8.
"""


def ends_of(
    law: "ContactLaw | type[ContactLaw] | str | None", exponent: float | None = None
) -> Ends:
    """Return how contacts of a law begin and end.

    Parameters
    ----------
    law : law, class of a law, or name
        None, or `Rigid`, which has no finite force, tells nothing.
    exponent : float, optional
        Of its loading curve, where the law itself does not tell; default unknown.

    Returns
    -------
    Ends

    Raises
    ------
    InvalidType, InvalidValue
        If it is no law, or the exponent is out of its range or not one of this law's.

    Examples
    --------
    >>> touch, release = ends_of("hertz")
    >>> touch.least, touch.most
    (1.5, 1.5)
    >>> ends_of(None) == UNTOLD
    True
    """
    kind = law_named(law) if isinstance(law, str) else law if isinstance(law, type) else type(law)
    if law is not None and kind not in LAWS.values():
        raise InvalidType(f"law must be a contact law, its class or its name, got {shown(law)}")
    p = _exponent(law, kind, exponent)
    if law is None or kind is Rigid:
        return UNTOLD
    if kind is Dashpot:
        return Ends(JUMP, Shape(1.0, 1.0))
    if kind is Viscoelastic:
        return Ends(ROOT, FADE)
    if kind is HuntCrossley:  # which a loss bends otherwise than by a power
        return Ends(_sure(p, 1.0, 1.5), UNTOLD.release)
    if kind is Hysteretic:
        return Ends(_sure(p, 1.0, 1.5), _unloading(law, p or 1.0))
    either = _sure(p, 1.0, 2.5)
    return Ends(either, either)


def _sure(known: float | None, least: float, most: float) -> Shape:
    """Return a power that is known, or between two, with the corrections of a told law."""
    return Shape(known or least, known or most, others=_OTHERS, slowing=_SLOWING)


def _unloading(law: Any, least: float) -> Shape:
    """Return the release of a `Hysteretic`, which is never harder than its touch."""
    n = getattr(law, "unloading_exponent", None) if isinstance(law, Hysteretic) else None
    if n is None:
        return Shape(least, max(least, _SOFTEST))
    return Shape(min(n, _STEEPEST), min(n, _STEEPEST))


def _exponent(law: Any, kind: type[Any], exponent: float | None) -> float | None:
    """Return the exponent of a law that has one, or the one that is told beside it."""
    own = getattr(law, "exponent", None) if isinstance(law, kind) else _FIXED.get(kind)
    told = own if exponent is None else exponent
    if told is None:
        return None
    told = between("exponent", told, 1.0, _STEEPEST)
    if exponent is not None and kind not in (PowerLaw, HuntCrossley, Hysteretic):
        raise InvalidValue(f"exponent goes with a law that has one to choose, got law {shown(law)}")
    if own not in (None, told):
        raise InvalidValue(f"exponent must be that of the law, {own:g}, got {told:g}")
    return told
