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

import numpy as np

from stackbounce.measure.quantities import Array

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
        """Whether the lead has no unknown."""
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
        bulk = np.full_like(logs, _BULK[self.kind])
        return -forward, _slowing(bulk, level) + forward

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
