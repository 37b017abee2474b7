"""Power series: values, integrals, shifts, and bounds on when one falls to a level."""

import math

from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.stack import TERMS

ORDER = 24  # highest order of the power series of clusters without modes
ROOT_ORDER = TERMS - 4  # highest order of a series in the root of time; two more integrate it
_PARABOLAS = 100  # trials of one search for an event


@kernel
def safe_step(a: Floats, n: int, tail: float, limit: float) -> float:
    """Return a time before which a positive series surely stays positive.

    The function differs from ``a[0] + a[1] s + ... + a[n] s^n`` by at most ``tail s^(n+1)``, and
    a[0] > 0. Nested lower bounds (each bracket of Horner's scheme is at least its constant, or that
    plus s times the next bracket's bound where this is negative) give a slope l with f(u) >= a[0] +
    l u on all of [0, s]: either s is safe, or -a[0]/l is. The trial s shrinks until one of them is
    long enough; close to a simple root the steps become Newton's, always from the safe side.
    """
    s = limit
    if a[1] < 0.0:
        s = min(s, -2.0 * a[0] / a[1])
    for _ in range(600):  # more than floating point has powers of 4
        slope = -tail
        for k in range(n, 0, -1):
            slope = a[k] + min(0.0, slope * s)
        if a[0] + slope * s >= 0.0:
            return s
        root = -a[0] / slope
        if root >= 0.25 * s:
            return root
        s = 0.25 * s
    return 0.0


@kernel
def lower_bound(a: Floats, low: int, n: int, limit: float) -> float:
    """Return a lower bound of a[low] + a[low + 1] s + ... + a[n] s^(n - low) up to a limit.

    See `safe_step`. It is nan if a term is: the order of the arguments of `min` propagates nan.
    """
    slope = 0.0
    for k in range(n, low, -1):
        slope = a[k] + min(slope * limit, 0.0)
    return a[low] + min(slope * limit, 0.0)


@kernel
def time_to_level(
    a: Floats, n: int, sign: float, level: float, band: float, limit: float
) -> tuple[float, bool]:
    """Return the first time at which f = ``sign (a(s) - level) + band`` falls into [0, band/2].

    Here a(s) is the polynomial with the coefficients ``a[0]`` to ``a[n]``. There are three results:

    - (time, True): f falls into the band at that time.
    - (limit, False): f stays above the band up to the limit.
    - (earlier time, False): the search was given up; f stays above the band up to that time.

    Mostly the bound of `safe_step` shows at once that f stays above the band. Otherwise a bound on
    the curvature gives a parabola below f. The roots of such parabolas converge to the time sought
    as in Newton's method, and never pass it.
    """
    slope = 0.0
    for k in range(n, 0, -1):
        slope = sign * a[k] + min(0.0, slope * limit)
    s, f, reach = 0.0, sign * (a[0] - level) + band, limit
    if f + min(0.0, slope * limit) > 0.5 * band:
        return limit, False
    slope = sign * a[1]
    for _ in range(_PARABOLAS):
        if f <= 0.5 * band:
            return s, True
        end = min(s + reach, limit)
        bend = 0.0
        for k in range(n, 1, -1):
            bend = k * (k - 1) * abs(a[k]) + end * bend
        root = math.sqrt(slope * slope + 2.0 * bend * f)
        step = limit
        if slope < 0.0:
            step = 2.0 * f / (root - slope)
        elif bend > 0.0:
            step = (root + slope) / bend
        if s + step >= end:
            if end == limit:
                return limit, False
            s, reach = end, 2.0 * reach
        else:
            s += step
            if 4.0 * step < reach:
                reach *= 0.25
        f, slope = 0.0, 0.0
        for k in range(n, -1, -1):
            slope = f + s * slope
            f = a[k] + s * f
        f, slope = sign * (f - level) + band, sign * slope
    return s, False


@kernel
def parabola_root(a0: float, a1: float, a2: float) -> float:
    """Return the first root s > 0 of a0 + a1 s + a2 s^2, a0 >= 0; infinity if there is none."""
    if a0 <= 0.0 and (a1 < 0.0 or (a1 == 0.0 and a2 < 0.0)):
        return 0.0
    discriminant = a1 * a1 - 4.0 * a2 * a0
    if discriminant < 0.0:
        return math.inf
    if a1 < 0.0:
        return 2.0 * a0 / (-a1 + math.sqrt(discriminant))
    if a2 < 0.0:
        return (a1 + math.sqrt(discriminant)) / (-2.0 * a2)
    return math.inf


@kernel
def evaluate(a: Floats, n: int, s: float) -> float:
    """Return a[0] + a[1] s + ... + a[n] s^n."""
    total = a[n]
    for k in range(n - 1, -1, -1):
        total = a[k] + s * total
    return total


@kernel
def differentiate(a: Floats, n: int, s: float) -> float:
    """Return the derivative of the polynomial of `evaluate` at s."""
    total = n * a[n]
    for k in range(n - 1, 0, -1):
        total = k * a[k] + s * total
    return total


@kernel
def integrate(a: Floats, n: int, s: float, root: int) -> float:
    """Return the integral of the polynomial of `evaluate` over time, from 0 to s^root.

    Its variable is the time itself (root = 1) or the square root of the time (root = 2).
    """
    total = a[n] / (n + root)
    for k in range(n - 1, -1, -1):
        total = a[k] / (k + root) + s * total
    return total * s if root == 1 else 2.0 * total * (s * s)


@kernel
def shift(a: Floats, n: int, s: float, out: Floats) -> None:
    """Expand the polynomial of `evaluate` about s: at s + u it is out[0] + ... + out[n] u^n."""
    for k in range(n + 1):
        out[k] = a[k]
    if s == 0.0:
        return
    for k in range(n):
        for j in range(n - 1, k - 1, -1):
            out[j] += s * out[j + 1]
