"""The contact laws as the data files name them, in one form that `precise` integrates.

Every finite law is F = k c**r (g0 + g1 c + g2 ċ) while the contact is compressed by c > 0, or zero
where that would pull:

===========================================  =======  ====  ====  ======
law                                          r        g0    g1    g2
===========================================  =======  ====  ====  ======
Spring: k c                                  0        0     1     0
Hertz, PowerLaw: k c**p                      p        1     0     0
Dashpot: k c + b ċ                           0        0     1     b / k
Viscoelastic: k (c**1.5 + 1.5 A sqrt(c) ċ)   1/2      0     1     1.5 A
HuntCrossley: k c**p (1 + χ ċ)               p        1     0     χ
===========================================  =======  ====  ====  ======

Hysteretic is a bundle of elements, and a sum of such curves. The element that touches and parts at
the compression l carries k dl**p (c/H)**(n - p), where H is the highest compression since it
touched. So many of them have the same H: a bundle is a list of pairs of l and H, and the elements
from l to that of the next pair remember H, or None if they are on the loading curve.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from mpmath import mpf

from reference.common import Number

Bundle = Sequence[tuple[Number, Number | None]]


@dataclass(frozen=True)
class Curve:
    """F = k c**power (constant + slope c + rate ċ)."""

    k: Number
    power: Number
    constant: Number
    slope: Number
    rate: Number

    def weight(self, c: Number, speed: Number) -> Number:
        """Return the bracket of the formula, which is negative where the force would pull."""
        return self.constant + self.slope * c + self.rate * speed

    def force(self, c: Number, speed: Number) -> Number:
        """Return the force of the formula, which may pull."""
        return self.k * c**self.power * self.weight(c, speed)


@dataclass(frozen=True)
class Law:
    """The loading curve, and for `Hysteretic` the exponents p and n of loading and unloading."""

    loading: Curve
    exponent: Number
    unloading: Number | None = None

    def curves(self, bundle: Bundle) -> list[Curve]:
        """Return the curves whose sum is the force; the first of them matters most near c = 0."""
        if self.unloading is None:
            return [self.loading]
        k, p, fade, held = self.loading.k, self.exponent, self.unloading - self.exponent, mpf(0)
        for (low, peak), (high, _) in pairwise(bundle):
            held += k * (high**p - low**p) / peak**fade
        low, peak = bundle[-1]
        if peak is None:
            found = [self.loading, Curve(-k * low**p, mpf(0), mpf(1), mpf(0), mpf(0))]
        else:
            found = [power_curve(k / peak**fade, self.unloading)]
            held -= k * low**p / peak**fade
        return [*found, power_curve(held, fade)] if low else found[:1]


def power_curve(k: Number, exponent: Number) -> Curve:
    """Return k c**exponent; a straight line is written as such, since it is smooth at c = 0."""
    if exponent == 1:
        return Curve(k, mpf(0), mpf(0), mpf(1), mpf(0))
    return Curve(k, exponent, mpf(1), mpf(0), mpf(0))


def read(fields: Mapping[str, Any]) -> Law:
    """Return the law of a row such as {"law": "Dashpot", "stiffness": 1.0, "damping": 0.2}."""
    numbers = {name: mpf(value) for name, value in fields.items() if name != "law"}
    return _READERS[fields["law"]](**numbers)


def _spring(stiffness: Number) -> Law:
    return _power_law(stiffness, mpf(1))


def _hertz(stiffness: Number) -> Law:
    return _power_law(stiffness, mpf(3) / 2)


def _power_law(stiffness: Number, exponent: Number) -> Law:
    return Law(power_curve(stiffness, exponent), exponent)


def _dashpot(stiffness: Number, damping: Number) -> Law:
    return Law(Curve(stiffness, mpf(0), mpf(0), mpf(1), damping / stiffness), mpf(1))


def _viscoelastic(stiffness: Number, dissipative_time: Number) -> Law:
    half = mpf(1) / 2
    return Law(Curve(stiffness, half, mpf(0), mpf(1), 3 * half * dissipative_time), 3 * half)


def _hunt_crossley(stiffness: Number, exponent: Number, dissipation: Number) -> Law:
    return Law(Curve(stiffness, exponent, mpf(1), mpf(0), dissipation), exponent)


def _hysteretic(
    stiffness: Number,
    exponent: Number = 1,
    restitution: Number | None = None,
    unloading_exponent: Number | None = None,
) -> Law:
    p = mpf(exponent)
    if restitution is not None:  # e**2 = (p + 1) / (n + 1)
        unloading_exponent = (p + 1) / restitution**2 - 1
    return Law(power_curve(stiffness, p), p, unloading_exponent)


_READERS = {
    "Spring": _spring,
    "Hertz": _hertz,
    "PowerLaw": _power_law,
    "Dashpot": _dashpot,
    "Viscoelastic": _viscoelastic,
    "HuntCrossley": _hunt_crossley,
    "Hysteretic": _hysteretic,
}
