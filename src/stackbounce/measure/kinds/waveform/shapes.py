"""The curves of the contact laws' flanks, and the priors of their unknowns.

With u the time since the touch, or until the release, a flank is

    F = A (L(u) + b u**q + c u**r),

where the lead L is the leading term of a law, b stands for other forces on the ball, and c for the
ball's own slowing down, whose mean follows from the lead by Newton's law: see `_slowing`. The
leads, with one unknown each:

- power, ``u**p``: a `Spring` has p = 1, `Hertz` 1.5;
- jump, ``u + a``: the touch of a `Dashpot`, where a is its damping over its stiffness;
- root, ``u**1.5 + a u**0.5``: the touch of a `Viscoelastic` contact, where a is 1.5 times its
  dissipative time;
- fade, ``u (u + a)**0.5``: the release of the same, where its force would begin to pull.
"""

from dataclasses import dataclass
from math import log
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, between, shown
from stackbounce.measure.quantities import Array
from stackbounce.model.laws import LAWS, ContactLaw, law_named

_OTHERS = 0.03  # of the flank's height: prior spread of other forces where the law is exact
_SLOWING = 0.04  # of the flank's height: that of the ball's slowing down, which is known better
_LARGEST_EXPONENT = 100.0  # of a flank that can be fitted
_BELOW = 0.1  # spread of the normal that is the prior below the range of the unknown's logarithm
_ABOVE = 0.25  # that above the range
_GRID = 13  # values of the unknown
_BULK = {"jump": 1.0, "root": 1.5, "fade": 1.25}  # power of the force where it is large
# The part of the slowing that shows in b is, in a fit to simulations, so much at the level
# `_FITTED_LEVEL` of the peak, and goes with the power `_LEVEL_POWER` of the level.
_FORWARD = {"jump": 0.5, "root": 0.7, "fade": -0.3}
_FITTED_LEVEL = 0.7
_LEVEL_POWER = 1.6
_BEGINS = {"jump": 0.0, "root": 0.5, "fade": 1.0}  # power of time with which the force begins
_CORRECTIONS = {"jump": (2.0, 3.0), "root": (3.0, 4.0), "fade": (2.0, 3.5)}  # q and r


@dataclass(frozen=True)
class Shape:
    """A lead, the prior of its unknown, and its corrections.

    Parameters
    ----------
    least, most : float
        Range of the unknown: its prior is log-uniform there, with normal tails; equal where it is
        known. The unknown is p, or a over the contact's length.
    kind : str, optional
        ``"power"``, ``"jump"``, ``"root"`` or ``"fade"``.
    others, slowing : float, optional
        Prior standard deviations of the corrections b and c, over the flank's height.

    Examples
    --------
    >>> Shape(1.5, 1.5).known, Shape(1.0, 1.5).known
    (True, False)
    """

    least: float
    most: float
    kind: str = "power"
    others: float = 0.3
    slowing: float = 0.15

    @property
    def known(self) -> bool:
        """Return whether the lead has no unknown."""
        return self.least == self.most

    def grid(self) -> Array:
        """Return logarithms of the unknown that cover its prior."""
        if self.known:
            return np.array([log(self.least)])
        return np.linspace(log(self.least) - 3.0 * _BELOW, log(self.most) + 3.0 * _ABOVE, _GRID)

    def prior(self, logs: Array) -> Array:
        """Return the log-prior of logarithms of the unknown."""
        beyond = np.maximum((log(self.least) - logs) / _BELOW, (logs - log(self.most)) / _ABOVE)
        return np.asarray(-0.5 * np.maximum(beyond, 0.0) ** 2)

    def unknown(self, logs: Array, length: float) -> Array:
        """Return p, or a in the unit of the contact's length."""
        return np.asarray(np.exp(logs) * (1.0 if self.kind == "power" else length))

    def begins(self, log: float, spread: float) -> tuple[float, float]:
        """Return the power of the time with which the force begins, and its standard error."""
        if self.kind == "power":
            return float(np.exp(log)), float(np.exp(log)) * spread
        return _BEGINS[self.kind], 0.0

    def corrections(self, logs: Array, level: float) -> tuple[Array, Array]:
        """Return the prior means of b and c, over the flank's height.

        In a lossy contact a part of the slowing shows in b.
        """
        if self.kind == "power":
            return np.zeros_like(logs), _slowing(np.exp(logs), level)
        forward = _FORWARD[self.kind] * np.exp(0.5 * logs) * (level / _FITTED_LEVEL) ** _LEVEL_POWER
        return -forward, _slowing(np.full_like(logs, _BULK[self.kind]), level) + forward

    def rows(self, u: Array, unknown: Array, *, averaged: bool) -> Array:
        """Return the columns of the linear model: the lead, both corrections and 1.

        All but the last are 0 before the touch, where u is below 0. They are evaluated at each u,
        or averaged between each u and the next. `unknown` is p, or a in the unit of u.
        """
        wide = np.diff(u, axis=-1) if averaged else None
        touched = u > 0.0
        u = np.maximum(u, 0.0)
        if self.kind == "power":
            first = u**unknown
            one = first * u
            rows = [first, one, first * one]
            powers = unknown, unknown + 1.0, 2.0 * unknown + 1.0
            if averaged:
                rows = [row * u / (power + 1.0) for row, power in zip(rows, powers, strict=True)]
        else:
            lead, area = _lead(self.kind, u, unknown)
            second, third = _CORRECTIONS[self.kind]
            rows = [np.where(touched, lead, 0.0), u**second, u**third]
            if averaged:
                rows = [area, u * rows[1] / (second + 1.0), u * rows[2] / (third + 1.0)]
        if wide is not None:
            rows = [np.diff(area, axis=-1) / wide for area in rows]
        return np.stack([*rows, np.ones_like(rows[0])], axis=-2)


def _lead(kind: str, u: Array, a: Array) -> tuple[Array, Array]:
    """Return a lead and its integral from the touch on."""
    if kind == "jump":
        return u + a, (0.5 * u + a) * u
    if kind == "root":
        return (u + a) * np.sqrt(u), (0.4 * u + 2.0 / 3.0 * a) * u * np.sqrt(u)
    area = (0.4 * u - 4.0 / 15.0 * a) * (u + a) ** 1.5 + 4.0 / 15.0 * a**2.5
    return u * np.sqrt(u + a), area


def _slowing(p: Array, level: float) -> Array:
    """Return the relative change of the force that is due to the ball's deceleration.

    `level` is the force over its peak. There the compression is x C, with the largest compression C
    and ``x = level**(1/p)``. The time since the touch is ξ C/v0, where v0 is the impact speed and ξ
    the integral of ``(1 - y**(p + 1))**-0.5`` from 0 to x. At constant speed the force would be
    ``(ξ / x)**p`` times as large.

    Examples
    --------
    >>> round(float(_slowing(np.array(1.0), 0.5)), 3)  # 1 - (π / 6) / sin(π / 6)
    -0.047
    """
    from scipy.special import hyp2f1

    part = 1.0 / (p + 1.0)
    longer: Array = hyp2f1(0.5, part, 1.0 + part, level ** ((p + 1.0) / p))
    return 1.0 - longer**p


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
