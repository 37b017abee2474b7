"""The shapes of touch and release that a contact law gives, for a fit to a force record."""

from typing import Any, NamedTuple

from stackbounce.errors import InvalidType, InvalidValue, between, shown
from stackbounce.measure.kinds.waveform.shapes import Shape
from stackbounce.model.laws import LAWS, ContactLaw, law_named

_OTHERS = 0.03  # of the flank's height: prior spread of other forces where the law is exact
_SLOWING = 0.04  # of the flank's height: that of the ball's slowing down, which is known better
_LARGEST_EXPONENT = 100.0  # of a flank that can be fitted


class Ends(NamedTuple):
    """The shapes of the two flanks of a contact."""

    touch: Shape
    release: Shape


UNTOLD = Ends(Shape(1.0, 1.5), Shape(1.0, 2.5))
"""The shapes without a law.

A linear spring has the exponent 1, Hertz's law 1.5; larger ones are rarer, 2 (a cone) to 2.5. A
contact that loses energy ends more softly than it begins: with an exponent of (p + 1) / e**2 - 1
where it unloads along a power law of its own, which is 2.5 for p = 1.25 and a restitution e of 0.8.
"""


def ends_of(
    law: "ContactLaw | type[ContactLaw] | str | None", exponent: float | None = None
) -> Ends:
    """Return the shapes of touch and release of a law.

    Parameters
    ----------
    law : law, class of a law, or name
        None and `Rigid`, which has no finite force, give `UNTOLD`.
    exponent : float, optional
        Of its loading curve, where the law itself does not have it; default unknown.

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
    kind: Any = (
        law_named(law) if isinstance(law, str) else law if isinstance(law, type) else type(law)
    )
    if law is not None and kind not in LAWS.values():
        raise InvalidType(f"law must be a contact law, its class or its name, got {shown(law)}")
    p = _exponent(law, kind, exponent)
    one = law if isinstance(law, ContactLaw) else None
    flanks = None if law is None else kind.flanks(p, one)
    if flanks is None:
        return UNTOLD
    exact = {"others": _OTHERS, "slowing": _SLOWING}
    touch, release = (Shape(f.least, f.most, f.kind, **exact if f.exact else {}) for f in flanks)
    return Ends(touch, release)


def _exponent(law: Any, kind: Any, exponent: float | None) -> float | None:
    """Return the exponent of a law that has one, or the one that is given beside it."""
    alone = law is None or isinstance(law, ContactLaw)
    own = getattr(law, "exponent", None) if alone else kind.fixed_exponent()
    told = own if exponent is None else exponent
    if told is None:
        return None
    told = between("exponent", told, 1.0, _LARGEST_EXPONENT)
    if exponent is not None and (law is None or "exponent" not in kind.quantities()):
        raise InvalidValue(f"exponent goes with a law that has one to choose, got law {shown(law)}")
    if own not in (None, told):
        raise InvalidValue(f"exponent must be that of the law, {own:g}, got {told:g}")
    return told
