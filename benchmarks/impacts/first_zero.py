"""A root search that cannot miss a root, of curves whose derivatives have known bounds."""

from collections.abc import Sequence
from typing import Protocol

from mpmath import mp, mpf

from reference.common import TINY, Number


class Curve(Protocol):
    """A smooth function of time with known bounds."""

    def derivatives(self, t: Number) -> list[Number]:
        """Return the function and its first derivatives at t, always the same number of them."""

    def bound(self, order: int) -> Number:
        """Return a bound of the size of a derivative (order 1 up) wherever it is asked for."""


def first_zero(
    curve: Curve, start: Number, stop: Number, tiny: Number, unit: Number
) -> Number | None:
    """Return the first zero in (start, stop) of a curve that is positive just after `start`.

    `tiny` is what counts as zero, as a value of the curve, `unit` a long time of the problem. A
    curve that vanishes with all its derivatives has no zero.

    No zero is missed: where f > 0, f(t + h) >= f + f' h - M h**2 / 2 with M >= |f''|, and a step
    goes only to the zero of that parabola. It converges quadratically, from the left. From
    f(start) = 0, whose first derivative that is not zero has order p, f stays positive while
    h < (p + 1) f^(p) / M_(p+1), M_(p+1) >= |f^(p+1)|.
    """
    t, d = start, curve.derivatives(start)
    if d[0] <= tiny:
        order = leading_order(curve, d, tiny, unit)
        if order is None:
            return None
        if d[order] < 0:
            raise ArithmeticError("the curve is not positive just after the start")
        if curve.bound(order + 1) == 0:
            return None
        t += d[order] / curve.bound(order + 1)
    while t < stop:
        d = curve.derivatives(t)
        if d[0] <= tiny and d[1] <= 0:
            return t
        t += _safe_step(curve, [max(d[0], mpf(0)), *d[1:]])
    return None


def leading_order(
    curve: Curve, derivatives: Sequence[Number], tiny: Number, unit: Number
) -> int | None:
    """Return the order, 1 up, of the first derivative that is not zero to rounding."""
    for order in range(1, len(derivatives)):
        scale = TINY * (curve.bound(order) + curve.bound(order + 1))
        if abs(derivatives[order]) > 1000 * max(scale, tiny / unit**order):
            return order
    return None


def _safe_step(curve: Curve, d: Sequence[Number]) -> Number:
    """Return a time for which a curve with those derivatives, d[0] > 0, stays positive.

    On [0, h], |f''| <= |d[2]| + |d[3]| h + ... + M_n h**(n-2) / (n-2)!; the smaller h, the better
    that bound, and the step is the smaller one of h and the parabola's zero.
    """

    def parabola(curvature: Number) -> Number:
        root = mp.sqrt(d[1] * d[1] + 2 * curvature * d[0])
        if d[1] <= 0:
            return 2 * d[0] / (root - d[1]) if root != d[1] else mp.inf
        return (d[1] + root) / curvature if curvature else mp.inf

    def step(h: Number) -> Number:
        total, power = abs(d[2]), mpf(1)
        for order in range(3, len(d)):
            power *= h / (order - 2)
            total += abs(d[order]) * power
        power *= h / (len(d) - 2)
        return min(h, parabola(total + curve.bound(len(d)) * power))

    best = parabola(curve.bound(2))
    if best < mp.inf and parabola(abs(d[2])) > 2 * best:
        h = best
        while (longer := step(2 * h)) > best:
            best, h = longer, 2 * h
    return best
