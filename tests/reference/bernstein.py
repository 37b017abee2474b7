"""All roots of a polynomial on (0, 1], none missed: signs of its Bernstein coefficients.

Coefficients are integers, a fixed-point number each (the point is the caller's). By Descartes'
rule in Bernstein form a polynomial has no root in an interval where its Bernstein coefficients do
not change sign, and exactly one where they do so once; any other interval is halved (Lane and
Riesenfeld 1981).
"""

from collections.abc import Iterator, Sequence
from itertools import accumulate, pairwise
from math import comb

NEGLIGIBLE = 165  # bits: first coefficients that much smaller than the largest one are zero
GUARD = 64  # more bits in Bernstein coefficients, for the binomials' cancellation
DEPTH = 90  # halvings; two roots closer together than that are a touch, not a crossing


def sign_after_zero(a: Sequence[int]) -> int:
    """Return the sign just after 0: that of the first coefficient that counts, 0 if none does."""
    first = _first(a)
    return 0 if first is None else 1 if a[first] > 0 else -1


def roots(a: Sequence[int], bits: int) -> Iterator[int]:
    """Yield the roots in (0, 1] of the sum of a[k] x**k from left to right, times 2**bits."""
    first = _first(a)
    if first is None or abs(a[first]) > sum(map(abs, a[first + 1 :])):
        return
    last = max(k for k, x in enumerate(a) if x)
    a = a[first : last + 1]
    waiting = [(_bernstein(a), 0, 0)]
    while waiting:
        b, place, depth = waiting.pop()
        changes = _changes(b)
        if changes == 1:
            rising = next(x for x in b if x) < 0
            yield _refine(a, bits, (place << bits) >> depth, ((place + 1) << bits) >> depth, rising)
        elif changes > 1 and depth < DEPTH:
            left, right = _halves(b)
            waiting += [(right, 2 * place + 1, depth + 1), (left, 2 * place, depth + 1)]


def value(a: Sequence[int], x: int, bits: int) -> int:
    """Return the polynomial at x / 2**bits."""
    total = 0
    for coefficient in reversed(a):
        total = (total * x >> bits) + coefficient
    return total


def slope(a: Sequence[int]) -> list[int]:
    """Return the coefficients of the derivative."""
    return [k * x for k, x in enumerate(a)][1:]


def _first(a: Sequence[int]) -> int | None:
    limit = max(map(abs, a)) >> NEGLIGIBLE
    return next((k for k, x in enumerate(a) if abs(x) > limit), None)


def _bernstein(a: Sequence[int]) -> list[int]:
    """Return Bernstein coefficients, b_j = sum over i of C(j, i) a_i / C(n, i), times 2**GUARD.

    The a_i / C(n, i) are the forward differences of the b_j at j = 0.
    """
    n = len(a) - 1
    row: list[int] = []
    for i in range(n, -1, -1):
        row = list(accumulate([(a[i] << GUARD) // comb(n, i), *row]))
    return row


def _changes(b: Sequence[int]) -> int:
    """Return how often the sign changes, zeros left out."""
    signs = [x > 0 for x in b if x]
    return sum(x != y for x, y in pairwise(signs))


def _halves(b: list[int]) -> tuple[list[int], list[int]]:
    """Return the coefficients on either half (de Casteljau)."""
    left, right = [b[0]], [b[-1]]
    while len(b) > 1:
        b = [(x + y) >> 1 for x, y in pairwise(b)]
        left.append(b[0])
        right.append(b[-1])
    left[-1] = right[-1] = b[0] or 1  # a root in the very middle belongs to one side
    return left, right[::-1]


def _refine(a: Sequence[int], bits: int, low: int, high: int, rising: bool) -> int:
    """Return the one root between two places: Newton's steps, halving where one leads outside."""
    rate, x = slope(a), (low + high) >> 1
    while high - low > 1:
        there = value(a, x, bits)
        if (there > 0) == rising:
            high = x
        else:
            low = x
        incline = value(rate, x, bits)
        new = x - (there << bits) // incline if incline else low
        if abs(new - x) <= 1:
            return new
        x = new if low < new < high else (low + high) >> 1
    return x
