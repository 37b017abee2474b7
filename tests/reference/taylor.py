"""Taylor series of a stack's compressions while the curves of its contacts stay the same.

The unknowns are the compressions c_i themselves (i = 0 is the lowest ball's distance below the
floor's height), so that a contact that has just begun is known as precisely as any other:
c_i'' = F_(i-1) / m_(i-1) - F_i (1 / m_(i-1) + 1 / m_i) + F_(i+1) / m_i, and + g for i = 0.

Every coefficient is an integer with `BITS` bits behind the point, in units of the contact's own
length (its compression, where the force has a power) and of the step's time. A power w = u**r
follows from u w' = r u' w, that is k w_k = sum over j of ((r + 1) j - k) u_j w_(k-j).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from operator import mul

from mpmath import mp, mpf

from reference.bernstein import slope, value
from reference.common import Number
from reference.laws import Curve

BITS = 256
ONE = 1 << BITS
DIGITS = 70  # carried outside of the series
TERMS = 56  # of a force; a compression has two more
PRECISION = -126  # log2 of a step's error, in units of the problem's length and speed
CONVERGED = -13  # log2 of the last term of a power, over the first


def fixed(number: Number) -> int:
    """Return the number with `BITS` bits behind the point."""
    return int(mp.floor(mp.ldexp(number, BITS)))


def floating(number: int) -> Number:
    """Return the number that an integer stands for."""
    return mp.ldexp(mpf(number), -BITS)


class Force:
    """The series of one contact's force, in units of `unit`, as that of its compression grows."""

    def __init__(self, curve: Curve, u: list[int], length: Number, time: Number) -> None:
        self.u, self.terms, self.smooth = u, [], curve.power == 0
        weights = [curve.constant, curve.slope * length, curve.rate * length / time]
        norm = sum(weights)
        self.weights = [fixed(x / norm) for x in weights]
        self.unit = curve.k * length**curve.power * norm
        self.above = fixed(curve.power + 1)  # r + 1
        self.powers: list[int] = []  # w
        self.moments: list[int] = [0]  # of (u**r) u'
        self.weighted: list[int] = [0]  # j u_j

    def extend(self) -> None:
        """Find the next term; the compression is known one term further."""
        k, u = len(self.terms), self.u
        constant, in_c, in_rate = self.weights
        if self.smooth:
            term = in_c * u[k] + in_rate * (k + 1) * u[k + 1] + (0 if k else constant * ONE)
        else:
            w = self.powers
            product = sum(map(mul, u[1 : k + 1], w[::-1])) >> BITS
            power = ((self.above * self.moments[k] // k) >> BITS) - product if k else ONE
            w.append(power)
            self.weighted.append((k + 1) * u[k + 1])
            self.moments.append(sum(map(mul, self.weighted[1:], w[::-1])) >> BITS)
            term = constant * power + in_c * (power + product) + in_rate * self.moments[k + 1]
        self.terms.append(term >> BITS)


@dataclass
class Piece:
    """The motion from now on: series in t / time, to be used up to `reach`, in the same unit."""

    time: Number
    reach: int
    lengths: list[Number]
    compressions: list[list[int]]
    forces: list[list[Force]]  # of each contact: their sum acts

    def rescaled(self, terms: Sequence[int]) -> list[int]:
        """Return coefficients for which `reach` is 1."""
        power, found = ONE, []
        for x in terms:
            found.append(x * power >> BITS)
            power = power * self.reach >> BITS
        return found

    def state(self, at: int) -> tuple[list[Number], list[Number]]:
        """Return the compressions and their rates at the fraction `at` of the reach."""
        x, c, rates = at * self.reach >> BITS, [], []
        for length, terms in zip(self.lengths, self.compressions, strict=True):
            c.append(length * floating(value(terms, x, BITS)))
            rates.append(length / self.time * floating(value(slope(terms), x, BITS)))
        return c, rates

    def duration(self, at: int) -> Number:
        """Return the time to the fraction `at` of the reach."""
        return self.time * floating(at * self.reach >> BITS)

    def impulse(self, index: int, at: int) -> Number:
        """Return the integral of a contact's force from now to the fraction `at` of the reach."""
        total, x = mpf(0), at * self.reach >> BITS
        for force in self.forces[index]:
            terms = [0, *(a // (k + 1) for k, a in enumerate(force.terms))]
            total += force.unit * self.time * floating(value(terms, x, BITS))
        return total


def couplings(masses: Sequence[Number]) -> list[dict[int, Number]]:
    """Return for every compression the factors of the forces in its second derivative."""
    light = [mpf(0), *(1 / m for m in masses)]  # nothing moves the floor
    n = len(masses)
    rows = [{i - 1: light[i], i: -light[i] - light[i + 1], i + 1: light[i + 1]} for i in range(n)]
    return [{j: x for j, x in row.items() if 0 <= j < n} for row in rows]


def accelerations(
    rows: Sequence[dict[int, Number]], forces: Sequence[Number], gravity: Number
) -> list[Number]:
    """Return the second derivatives of the compressions."""
    found = [sum((a * forces[j] for j, a in row.items()), mpf(0)) for row in rows]
    found[0] += gravity
    return found


def forces_of(
    curves: Sequence[Sequence[Curve]], c: Sequence[Number], rates: Sequence[Number]
) -> list[Number]:
    """Return the force of each contact, the sum of its curves."""
    return [
        sum((x.force(a, b) for x in row), mpf(0))
        for row, a, b in zip(curves, c, rates, strict=True)
    ]


def expand(
    rows: Sequence[dict[int, Number]],
    gravity: Number,
    curves: Sequence[Sequence[Curve]],
    c: Sequence[Number],
    rates: Sequence[Number],
    time: Number,
    scales: tuple[Number, Number],
) -> Piece:
    """Return the series; `scales` are the problem's length and speed."""
    a = accelerations(rows, forces_of(curves, c, rates), gravity)
    lengths = [
        c[i]
        if any(x.power for x in row)
        else max(abs(c[i]), abs(rates[i] * time), abs(a[i]) * time**2) or time
        for i, row in enumerate(curves)
    ]
    u = [
        [fixed(x / length), fixed(rate * time / length)]
        for x, rate, length in zip(c, rates, lengths, strict=True)
    ]
    forces = [
        [Force(curve, row, length, time) for curve in several]
        for several, row, length in zip(curves, u, lengths, strict=True)
    ]
    factors = [
        [(fixed(a * x.unit * time**2 / length), x) for j, a in row.items() for x in forces[j]]
        for row, length in zip(rows, lengths, strict=True)
    ]
    constant = fixed(gravity * time**2 / lengths[0])
    for k in range(TERMS):
        for force in chain(*forces):
            force.extend()
        for i, row in enumerate(factors):
            total = sum(x * force.terms[k] for x, force in row) >> BITS
            if i == k == 0:
                total += constant
            u[i].append(total // ((k + 1) * (k + 2)))
    return Piece(time, _reach(u, [*chain(*forces)], lengths, time, scales), lengths, u, forces)


def _reach(
    u: Sequence[Sequence[int]],
    forces: Sequence[Force],
    lengths: Sequence[Number],
    time: Number,
    scales: tuple[Number, Number],
) -> int:
    """Return the part of the time on which the series are precise, inside their convergence."""
    best = 0.0
    for row, length in zip(u, lengths, strict=True):
        for n in (TERMS, TERMS + 1):
            size = abs(row[n]).bit_length() - BITS
            for unit in (length / scales[0], n * length / (time * scales[1])):
                best = min(best, (PRECISION - size - _log2(unit)) / n)
    for force in forces:
        if not force.smooth:
            for n in (TERMS - 2, TERMS - 1):
                size = abs(force.powers[n]).bit_length() - BITS
                best = min(best, (CONVERGED - size) / n)
    return fixed(mpf(2.0**best))


def _log2(number: Number) -> int:
    return mp.mag(number)
