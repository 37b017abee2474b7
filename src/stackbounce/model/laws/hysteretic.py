"""A contact that loses energy by its history: a softer curve on the way out."""

import math
from dataclasses import KW_ONLY, dataclass, field
from typing import Annotated

from stackbounce.errors import (
    InvalidType,
    InvalidValue,
    between,
    fraction,
    nearest,
    positive,
    shown,
)
from stackbounce.model.laws.elastic import STEEPEST
from stackbounce.units import Unit

__all__ = ["Hysteretic"]


@dataclass(frozen=True)
class Hysteretic:
    """A spring that gives back less than it took: a softer curve on the way out.

    Loading follows ``F = k c**p``; from the peak compression C it unloads along
    ``F = k C**p (c/C)**n``. A contact compressed again before it has opened goes back up its
    unloading curve to the old peak C and on along the loading curve, so that no cycle gains energy.
    (Where `reloading` is lossy and it turns back at a lower peak, it unloads from there along a
    steeper power law, at most 10 n, which gives back e**2 of the reloading's work.) The contact
    ends when force and compression are zero, and the next one starts afresh. The work given back
    over the work taken is ``e**2 = (p + 1)/(n + 1)``, whatever the speed.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float, optional
        p of the loading curve, at least 1; 1, a linear spring, is the paper's choice.
    restitution : float, optional
        e, at most 1, and not so small that n exceeds 1e6: 0.0015 or above for p = 1.
    unloading_exponent : float, optional
        n of the unloading curve, from `exponent` to 1e6. Give one of this and `restitution`; the
        other is derived, and both can be read. Both can be given where they agree exactly, so that
        `dataclasses.replace` can change the rest; to change one of them, set the other to None.
    reloading : str, optional
        What it costs to be compressed again before the contact has opened: ``"free"``, nothing up
        to the old peak, or ``"lossy"``, the same share of the work as the first time. Nature's rule
        is not known; the second is here to show what the choice changes.

    Raises
    ------
    InvalidValue
        If a number is out of its range, or neither `restitution` nor `unloading_exponent` is given,
        or both and they disagree.
    InvalidType
        If one is no number, or `reloading` no string.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section V. The paper has a single loading and
    unloading; the rule for reloading is this package's own.

    Examples
    --------
    >>> Hysteretic(5.6e4, unloading_exponent=7.0).restitution
    0.5
    >>> Hysteretic(5.6e4, restitution=0.5).unloading_exponent
    7.0
    """

    stiffness: Annotated[float, Unit("N/m**exponent")]
    _: KW_ONLY
    exponent: Annotated[float, Unit()] = 1.0
    # One of these is given and the other derived in __post_init__: neither is ever None to read.
    restitution: Annotated[float, Unit()] = None  # type: ignore[assignment]
    unloading_exponent: Annotated[float, Unit()] = None  # type: ignore[assignment]
    reloading: str = "free"
    derived: str = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not isinstance(self.reloading, str):
            raise InvalidType(f"reloading must be a string, got {shown(self.reloading)}")
        if self.reloading not in _RELOADINGS:
            words = nearest(self.reloading, _RELOADINGS)
            raise InvalidValue(f"reloading must name a rule, got {shown(self.reloading)}; {words}")
        k = positive("stiffness", self.stiffness, "N/m**exponent")
        p = between("exponent", self.exponent, 1.0, STEEPEST)
        e, n, derived = _losses(p, self.restitution, self.unloading_exponent)
        object.__setattr__(self, "stiffness", k)
        object.__setattr__(self, "exponent", p)
        object.__setattr__(self, "restitution", e)
        object.__setattr__(self, "unloading_exponent", n)
        object.__setattr__(self, "derived", derived)

    def __repr__(self) -> str:
        given = next(name for name in _ONE_OF if name != self.derived)
        rule = "" if self.reloading == "free" else f", reloading={self.reloading!r}"
        return (
            f"Hysteretic(stiffness={self.stiffness!r}, exponent={self.exponent!r}, "
            f"{given}={getattr(self, given)!r}{rule})"
        )


_ONE_OF = ("restitution", "unloading_exponent")
_RELOADINGS = ("free", "lossy")


def _losses(p: float, restitution: object, unloading: object) -> tuple[float, float, str]:
    """Return e, n and which of the two is derived: ``e**2 = (p + 1)/(n + 1)``, section V."""
    e = None if restitution is None else fraction("restitution", restitution, zero=False)
    n = None if unloading is None else between("unloading_exponent", unloading, p, STEEPEST)
    if e is not None:
        from_e = max(p, (p + 1.0) / e / e - 1.0)
        if n is None and from_e > STEEPEST:
            least = 1.001 * math.sqrt((p + 1.0) / (STEEPEST + 1.0))
            raise InvalidValue(
                f"restitution must be at least {least:.3g} for exponent {p:g}, so that "
                f"unloading_exponent is at most {STEEPEST:g}, got {shown(restitution)}"
            )
        if n is None or n == from_e:
            return e, from_e, "unloading_exponent"
    if n is not None:
        from_n = math.sqrt((p + 1.0) / (n + 1.0))
        if e is None or e == from_n:
            return from_n, n, "restitution"
    values = zip(_ONE_OF, (restitution, unloading), strict=True)
    got = " and ".join(f"{name}={shown(value)}" for name, value in values if value is not None)
    raise InvalidValue(
        "restitution and unloading_exponent: exactly one of the two must be given, "
        f"got {got + ', which disagree: set the other to None' if got else 'neither'}"
    )
