"""A contact with hysteresis: its unloading curve lies below its loading curve."""

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, field
from typing import Annotated, Any, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, between, fraction, shown
from stackbounce.model.collision import elastic
from stackbounce.model.laws.law import (
    EXPONENT,
    STEEPEST,
    ContactLaw,
    EngineNumbers,
    Flank,
    Given,
    Quantity,
    stiffness_in,
)
from stackbounce.model.laws.registry import register

_STIFFNESS = stiffness_in("N/m**exponent")
_SOFTEST, _STEEPEST_FLANK = 6.0, 100.0  # exponents of a release that is not known, and that is


@register
class Hysteretic(ContactLaw):
    """A lossy spring with hysteresis: it unloads along another curve than it loads.

    Loading follows ``F = k c**p``; from the peak compression C it unloads along
    ``F = k C**p (c/C)**n``. This returns the fraction ``e**2 = (p + 1)/(n + 1)`` of the work of
    loading, at any speed. The contact ends when force and compression are zero, and the next one
    has no memory of it.

    If the contact is compressed again before it has opened, it acts as a bundle of elements, each
    of which parts at its own compression. Elements that have parted load afresh; the others go
    back along their unloading curve to the old peak. From c0 the force is ``F = k c**p - k c0**p +
    k c0**p (c/C)**(n - p)`` up to the old peak C. No cycle gains energy, and a contact that just
    opens and one that just does not do the same.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float, optional
        p of the loading curve, at least 1; 1, a linear spring, is the paper's choice.
    restitution : float, optional
        e, at most 1, and not so small that n exceeds 1e6: 0.00142 or above for p = 1.
    unloading_exponent : float, optional
        n of the unloading curve, from `exponent` to 1e6. Give one of this and `restitution`; the
        other is derived, and both can be read. Both can be given where they agree exactly, so that
        `dataclasses.replace` can change the rest; to change one of them, set the other to None.

    Raises
    ------
    InvalidValue
        If a number is out of its range, or neither `restitution` nor `unloading_exponent` is given,
        or both and they disagree.
    InvalidType
        If one is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section V. The paper has a single loading and
    unloading; the rule for reloading is this package's own, a Preisach model (I. D. Mayergoyz,
    Mathematical Models of Hysteresis, 1991) whose first-order reversal curves are these.

    Examples
    --------
    >>> Hysteretic(5.6e4, unloading_exponent=7.0).restitution
    0.5
    >>> Hysteretic(5.6e4, restitution=0.5).unloading_exponent
    7.0
    """

    formula = (
        "F = stiffness c**exponent; from the peak C on, "
        "F = stiffness C**exponent (c/C)**unloading_exponent"
    )
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), section V"
    form = codes.HYSTERETIC
    third_number = "unloading_exponent"
    rate_free = True
    loss = "restitution"
    loss_fields = ("restitution", "unloading_exponent")
    usual_exponent = 1.0
    usual_models: ClassVar = {"Hysteretic": {}, "Hysteretic, Hertz loading": {"exponent": 1.5}}

    stiffness: Annotated[float, _STIFFNESS]
    _: KW_ONLY
    exponent: Annotated[float, EXPONENT] = 1.0
    # One of these is given and __post_init__ derives the other: neither is ever None to read.
    restitution: Annotated[float, Quantity("", slider=(0.8, 0.05, 1.0))] = None  # type: ignore[assignment]
    unloading_exponent: Annotated[float, Quantity("", slider=(2.0, 1.0, 20.0))] = None  # type: ignore[assignment]
    derived: str = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        k = _STIFFNESS.check("stiffness", self.in_si("stiffness"))
        p = EXPONENT.check("exponent", self.in_si("exponent"))
        e, n, derived = _losses(p, *map(self.in_si, _ONE_OF))
        names = ("stiffness", "exponent", "restitution", "unloading_exponent", "derived")
        for name, value in zip(names, (k, p, e, n, derived), strict=True):
            object.__setattr__(self, name, value)

    def replaced(self, changes: Mapping[str, Any]) -> Self:
        """Return a copy with changed fields; the derived field is computed again."""
        given = [name for name in _ONE_OF if name in changes]
        given = given or [name for name in _ONE_OF if name != self.derived]
        others = {_OTHER[name]: None for name in given if _OTHER[name] not in changes}
        return super().replaced({**others, **changes})

    def to_mapping(self) -> dict[str, Any]:
        """Return the law as plain values, without the derived field."""
        plain = super().to_mapping()
        del plain[self.derived]
        return plain

    def _described_fields(self) -> list[str]:
        shape = [] if self.exponent == 1.0 else ["exponent"]
        return ["stiffness", *shape, "restitution"]

    def engine_numbers(self, varied: Mapping[str, Any] = {}) -> EngineNumbers:
        """Return the law's numbers, with n from e where e is what is known of the loss."""
        k, p, e, n = self.values(varied)
        by_restitution = self.derived == "unloading_exponent" and "unloading_exponent" not in varied
        if "restitution" in varied or (by_restitution and "exponent" in varied):
            import numpy as np

            n = np.maximum(p, (p + 1.0) / e / e - 1.0)
        return self.form, k, p, n, 0.0

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v: half of that on each curve without loss.

        Unloading begins with no speed and ends at the speed e v.
        """
        loading, unloading = map(elastic.duration, (self.exponent, self.unloading_exponent))
        return 0.5 * loading + 0.5 * unloading / self.restitution

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time."""
        p, e = given["exponent"], given["restitution"]
        unit = cls(1.0, exponent=p, restitution=e)
        k = elastic.measured_stiffness(given, unit.duration_at(1.0, 1.0))
        return cls(k, exponent=p, restitution=e)

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> tuple[Flank, Flank]:
        """Return the flanks: the exponent of the release is at least that of the touch."""
        touch = Flank(exponent or 1.0, exponent or 1.5, exact=True)
        if law is None:
            least = exponent or 1.0
            return touch, Flank(least, max(least, _SOFTEST))
        n = min(law.unloading_exponent, _STEEPEST_FLANK)
        return touch, Flank(n, n)

    def series_constants(self) -> dict[str, Any]:
        """Return what two laws in series must have in common: both exponents."""
        return {"exponent": self.exponent, "unloading_exponent": self.unloading_exponent}

    def as_hysteretic(self) -> "Hysteretic":
        """Return the law itself."""
        return self

    def pressed_on(self, other: "Hysteretic") -> "Hysteretic":
        """Return the law with the loading curve and the energy loss of this and another in series.

        Both must have the same exponent. This law takes the fraction f of
        the compression, and therefore of the work: ``e**2 = f e_a**2 + (1 - f) e_b**2``.
        """
        p = self.exponent
        soft_a, soft_b = self.stiffness ** (-1.0 / p), other.stiffness ** (-1.0 / p)
        f = soft_a / (soft_a + soft_b)
        kept = f * self.restitution**2 + (1.0 - f) * other.restitution**2
        return Hysteretic((soft_a + soft_b) ** -p, exponent=p, restitution=math.sqrt(kept))


_ONE_OF = Hysteretic.loss_fields
_OTHER = dict(zip(_ONE_OF, reversed(_ONE_OF), strict=True))


def _losses(p: float, restitution: object, unloading: object) -> tuple[float, float, str]:
    """Return e, n and the name of the derived one: ``e**2 = (p + 1)/(n + 1)``, section V."""
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
