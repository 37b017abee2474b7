"""How a force may begin: the curves of the contact laws' flanks, and what is supposed of them.

With u the time since the touch, or until the release, a flank is

    F = A (L(u) + b u**q + c u**r),

where the lead L is what a law begins or ends with, b stands for what else presses or accelerates,
and c for the ball's own slowing down, which Newton's law ties to the lead. The leads, with one
unknown each:

- power, ``u**p``: a `Spring` has p = 1, `Hertz` 1.5;
- jump, ``u + a``: the touch of a `Dashpot`, where a is its damping over its stiffness;
- root, ``u**1.5 + a u**0.5``: the touch of a `Viscoelastic` contact, where a is 1.5 times its
  dissipative time;
- fade, ``u (u + a)**0.5``: the release of the same, where its force would begin to pull.
"""

from dataclasses import dataclass
from math import log, pi, sqrt
from typing import Any

import numpy as np

from stackbounce.measure.waveform.record import Array

__all__ = ["FADE", "JUMP", "ROOT", "Lean", "Shape", "power"]

_EDGES = (0.1, 0.25)  # of the unknown's logarithm: spreads of the normals below and above its range
_POWERS, _OTHER, _FINE = 13, 11, 200  # values of the unknown
_OTHERS, _SLOWING = 0.3, 0.15  # of the flank's height: spreads of the corrections b and c


@dataclass(frozen=True)
class Lean:
    """How far a pulse leans forward, and the error of that.

    Between the times t, u and v at which 15 %, half and 85 % of the impulse are done it is
    ``(t - 2 u + v)/(v - t)``. It is 0 where nothing is lost, above 0 for viscous losses, whose
    force is early, and below 0 where the release is softer than the touch, as in `Hysteretic`.
    """

    value: float
    error: float

    def likelihood(self, expected: Array) -> Array:
        """Return the logarithm of how probable this is where something else is expected."""
        found: Array = -0.5 * ((self.value - expected) / self.error) ** 2
        return found - log(sqrt(2.0 * pi) * self.error)


@dataclass(frozen=True)
class Shape:
    """A lead, what its unknown may be before the flank is seen, and its corrections.

    Parameters
    ----------
    kind : str
        ``"power"``, ``"jump"``, ``"root"`` or ``"fade"``.
    least, most : float
        Between which the unknown is as probable everywhere, on a log scale, and rarely beyond;
        equal where it is known. It is p, or a as a share of the contact's length.
    others, slowing : float, optional
        Spreads of the corrections b and c, as shares of the flank's height.
    lean : Lean, optional
        Tells a, as viscous losses make a pulse lean.
    """

    kind: str
    least: float
    most: float
    others: float = _OTHERS
    slowing: float = _SLOWING
    lean: Lean | None = None

    @property
    def known(self) -> bool:
        """Whether nothing is unknown of the lead."""
        return self.least == self.most

    def grid(self, count: int = 0) -> Array:
        """Return logarithms of the unknown that cover what it may be."""
        if self.known:
            return np.array([log(self.least)])
        low, high = (3.0 * edge for edge in _EDGES)
        count = count or (_POWERS if self.kind == "power" else _OTHER)
        return np.linspace(log(self.least) - low, log(self.most) + high, count)

    def prior(self, logs: Array) -> Array:
        """Return the logarithm of the probability per unit of the unknown's logarithm."""
        if self.known:
            return np.zeros_like(logs)
        return self._weight(logs) - self.agreement

    @property
    def agreement(self) -> float:
        """Logarithm of how probable the lean is, whatever the unknown."""
        logs = self.grid(_FINE)
        return log(float(np.exp(self._weight(logs)).sum()) * (logs[1] - logs[0]) + 1e-300)

    def _weight(self, logs: Array) -> Array:
        least, most = log(self.least), log(self.most)
        beyond = np.maximum((least - logs) / _EDGES[0], (logs - most) / _EDGES[1])
        whole = most - least + sqrt(0.5 * pi) * sum(_EDGES)
        free: Array = -0.5 * np.maximum(beyond, 0.0) ** 2 - log(whole)
        if self.lean is None:
            return free
        a = np.exp(logs)
        linear, square = (0.27, 0.55) if self.kind == "jump" else (0.28, 0.09)  # fit to simulations
        return free + self.lean.likelihood((linear + square * a) * a)

    def begins(self, logs: Array) -> Array:
        """Return the power of the time with which the force begins."""
        fixed = {"jump": 0.0, "root": 0.5, "fade": 1.0}
        return np.exp(logs) if self.kind == "power" else np.full_like(logs, fixed[self.kind])

    def corrections(self, logs: Array, level: float) -> tuple[Array, Array]:
        """Return what b and c are on average, as shares of the flank's height.

        Each loss takes some of the slowing's curve forward, to b: a fit to simulations.
        """
        bulk = {"jump": 1.0, "root": 1.5, "fade": 1.25}.get(self.kind)
        p = np.exp(logs) if bulk is None else np.full_like(logs, bulk)
        share = {"jump": 0.5, "root": 0.7, "fade": -0.3}.get(self.kind, 0.0)
        forward = share * np.exp(0.5 * logs) * (level / 0.7) ** 1.6
        return -forward, _slowing(p, level) + forward

    def rows(self, u: Array, unknown: Array, *, averaged: bool) -> Array:
        """Return lead, corrections and 1, where u is at most 0 before the touch.

        They are taken at each u, or averaged between each and the next; `unknown` is p, or a in
        units of u.
        """
        wide = np.diff(u, axis=-1) if averaged else None
        on = (u > 0.0).astype(float)
        u = np.maximum(u, 0.0)
        if self.kind == "power":
            first = u**unknown
            one = first * u
            rows = [first, one, first * one]
            if averaged:
                powers = unknown + 1.0, unknown + 2.0, 2.0 * unknown + 2.0
                rows = [row * u / power for row, power in zip(rows, powers, strict=True)]
        else:
            second, third = {"jump": (2.0, 3.0), "root": (3.0, 4.0), "fade": (2.0, 3.5)}[self.kind]
            rows = [self._area(u, unknown) if averaged else self._lead(u, unknown, on)]
            if averaged:
                rows += [u ** (k + 1.0) / (k + 1.0) for k in (second, third)]
            else:
                rows += [u**second, u**third]
        if wide is not None:
            rows = [np.diff(area, axis=-1) / wide for area in rows]
        return np.stack([*rows, np.ones_like(rows[0])], axis=-2)

    def _lead(self, u: Array, a: Array, on: Array) -> Array:
        lead: Array = u + a * on
        if self.kind == "root":
            lead = (u + a) * np.sqrt(u)
        elif self.kind == "fade":
            lead = u * np.sqrt(u + a)
        return lead

    def _area(self, u: Array, a: Array) -> Array:
        """Return the lead's integral from the touch on."""
        area: Array = (0.5 * u + a) * u
        if self.kind == "root":
            area = (0.4 * u + 2.0 / 3.0 * a) * u * np.sqrt(u)
        elif self.kind == "fade":
            area = (0.4 * u - 4.0 / 15.0 * a) * (u + a) ** 1.5 + 4.0 / 15.0 * a**2.5
        return area


def power(least: float, most: float | None = None, **spreads: Any) -> Shape:
    """Return a force that begins as a power, of an exponent that is known or between two.

    Examples
    --------
    >>> power(1.5).known, power(1.0, 1.5).known
    (True, False)
    """
    return Shape("power", least, least if most is None else most, **spreads)


_SHARES = (0.01, 0.3)  # of the contact's length: restitutions of about 0.95 to 0.3
JUMP, ROOT, FADE = (Shape(kind, *_SHARES) for kind in ("jump", "root", "fade"))


def _slowing(p: Array, level: float) -> Array:
    """Return by how much a ball's slowing down lowers the force, as a share of what it then is.

    At a level, a share of the peak force, the compression is x = level**(1/p) of the largest, and
    the time since the touch that in which the impact speed would make it ξ, the integral of
    ``(1 - y**(p + 1))**-0.5`` from 0 to x. Without slowing the force would be ``(ξ / x)**p`` times
    as large.

    Examples
    --------
    >>> round(float(_slowing(np.array(1.0), 0.5)), 3)  # 1 - (π / 6) / sin(π / 6)
    -0.047
    """
    from scipy.special import hyp2f1

    part = 1.0 / (p + 1.0)
    longer: Array = hyp2f1(0.5, part, 1.0 + part, level ** ((p + 1.0) / p))
    return 1.0 - longer**p
