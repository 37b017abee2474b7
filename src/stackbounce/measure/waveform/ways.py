"""How contacts begin and end: what a law tells, or what may be where none is told."""

from collections.abc import Sequence
from dataclasses import replace
from math import exp, hypot
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, positive, shown
from stackbounce.measure.waveform.shapes import FADE, JUMP, ROOT, Lean, Shape, power
from stackbounce.model.laws import (
    LAWS,
    ContactLaw,
    Dashpot,
    Hertz,
    HuntCrossley,
    Hysteretic,
    Rigid,
    Spring,
    Viscoelastic,
    law_named,
)

__all__ = ["Way", "informed", "ways_of"]

_LINE = power(1.0)
_SOFT = power(1.0, 2.5)  # also for Hunt and Crossley's, which losses bend more than by a power
_SURE = {"others": 0.03, "slowing": 0.04}  # spreads of the corrections where the law is told
_RARE = 0.05  # share of dashpots, and of viscoelastic contacts, where no law is told
_EVEN = 0.7  # share of the others whose pulses do not lean
_LEANS = 0.3  # range of leans of those that do
_SCATTER = 0.003  # of leans about what is expected
_SYMMETRIC, _BACK = 1.3, 75.0  # exponent of a release, and by how much it grows as pulses lean back
_SOFTEST = 6.0  # exponent of a hysteretic release where the pulse does not tell


class Way(NamedTuple):
    """A way for a contact to begin and end, and how probable it is before the record is seen.

    `law` is the class that it is peculiar to, if there is one.
    """

    touch: Shape
    release: Shape
    share: float = 1.0
    law: type[ContactLaw] | None = None


_UNTOLD = (
    Way(power(1.0, 1.5), _SOFT, 1.0 - 2.0 * _RARE),
    Way(JUMP, _LINE, _RARE, Dashpot),
    Way(ROOT, FADE, _RARE, Viscoelastic),
)


def ways_of(
    law: "ContactLaw | type[ContactLaw] | str | None", exponent: Any = None
) -> tuple[Way, ...]:
    """Return the ways in which contacts of a law begin and end.

    Parameters
    ----------
    law : law, class of a law, or name
        None, or `Rigid`, which has no finite force, tells nothing.
    exponent : float or UFloat, optional
        Of its loading curve, where the law itself does not tell.

    Raises
    ------
    InvalidType, InvalidValue
        If it is no law, or the exponent no number above 0.

    Examples
    --------
    >>> (way,) = ways_of("hertz")
    >>> way.touch.least, way.touch.most
    (1.5, 1.5)
    >>> len(ways_of(None))
    3
    """
    kind = law_named(law) if isinstance(law, str) else law if isinstance(law, type) else type(law)
    if law is None or kind is Rigid:
        return _UNTOLD
    if kind not in LAWS.values():
        raise InvalidType(f"law must be a contact law, its class or its name, got {shown(law)}")
    if kind is Dashpot:
        return (Way(JUMP, _LINE),)
    if kind is Viscoelastic:
        return (Way(ROOT, FADE),)
    fixed = kind in (Spring, Hertz)
    told = law if isinstance(law, kind) else kind if fixed else None
    p = getattr(told, "exponent", exponent)
    if p is not None:
        p = positive("exponent", getattr(p, "nominal_value", p))
    if kind is Hysteretic:
        touch = power(p or 1.0, p or 1.5, **_SURE)
        n = getattr(told, "unloading_exponent", None)
        release = power(n or p or 1.0, n or _SOFTEST, **_SURE)
        return (Way(touch, release),)
    touch = power(p or 1.0, p or (1.5 if kind is HuntCrossley else 2.5), **_SURE)
    return (Way(touch, _SOFT if kind is HuntCrossley else touch),)


def informed(ways: Sequence[Way], lean: Lean) -> list[Way]:
    """Return ways with what the lean of the pulse tells of them.

    Where no law is told, a pulse that does not lean speaks for contacts without loss, one that
    leans forward for viscous losses, and one that leans back for a softer release.
    """
    lean = Lean(lean.value, hypot(lean.error, _SCATTER))
    return [_informed(way, lean) for way in ways]


def _informed(way: Way, lean: Lean) -> Way:
    touch, release = way.touch, way.release
    if touch.kind != "power":
        touch = replace(touch, lean=lean)
        if release.kind == "fade":
            release = replace(release, lean=lean)
        return way._replace(touch=touch, release=release, share=way.share * exp(touch.agreement))
    even = exp(float(lean.likelihood(np.zeros(()))))
    share = way.share * (_EVEN * even + (1.0 - _EVEN) / _LEANS)
    if not release.known:
        n = _SYMMETRIC - _BACK * min(lean.value, 0.0)
        if release.most == _SOFTEST:  # hysteretic for sure
            least, most = max(touch.least, 0.8 * n), 1.25 * n
        else:
            least, most = max(release.least, 0.5 * n), max(release.most, 1.25 * n)
        release = replace(release, least=least, most=max(least, most))
    return way._replace(release=release, share=share)
