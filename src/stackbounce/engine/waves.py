"""cos x and (sin x)/x for small x, as polynomials that a compiler can spread over many lanes.

No quarter turns are taken off, so there are no branches; up to `WIDEST` both are their Taylor
series, the first term left out of which is below 1e-17. Terms are summed by twos, which is faster.
"""

from stackbounce.engine.kernel import kernel

WIDEST = 2.5


@kernel
def cosine(z: float) -> float:
    """Return cos x for z = x^2, x at most `WIDEST`."""
    zz = z * z
    even = 1.0 / 620448401733239439360000.0
    even = 1.0 / 2432902008176640000.0 + zz * even
    even = 1.0 / 20922789888000.0 + zz * even
    even = 1.0 / 479001600.0 + zz * even
    even = 1.0 / 40320.0 + zz * even
    even = 1.0 / 24.0 + zz * even
    even = 1.0 + zz * even
    odd = -1.0 / 1124000727777607680000.0
    odd = -1.0 / 6402373705728000.0 + zz * odd
    odd = -1.0 / 87178291200.0 + zz * odd
    odd = -1.0 / 3628800.0 + zz * odd
    odd = -1.0 / 720.0 + zz * odd
    odd = -1.0 / 2.0 + zz * odd
    return even + z * odd


@kernel
def sinc(z: float) -> float:
    """Return (sin x)/x for z = x^2, x at most `WIDEST`."""
    zz = z * z
    even = 1.0 / 15511210043330985984000000.0
    even = 1.0 / 51090942171709440000.0 + zz * even
    even = 1.0 / 355687428096000.0 + zz * even
    even = 1.0 / 6227020800.0 + zz * even
    even = 1.0 / 362880.0 + zz * even
    even = 1.0 / 120.0 + zz * even
    even = 1.0 + zz * even
    odd = -1.0 / 25852016738884976640000.0
    odd = -1.0 / 121645100408832000.0 + zz * odd
    odd = -1.0 / 1307674368000.0 + zz * odd
    odd = -1.0 / 39916800.0 + zz * odd
    odd = -1.0 / 5040.0 + zz * odd
    odd = -1.0 / 6.0 + zz * odd
    return even + z * odd
