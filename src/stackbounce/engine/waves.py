"""cos x and sin x as polynomials that a compiler can spread over many lanes.

Half turns are taken off first, without a branch; what is left is at most a quarter turn either way,
where both are their Taylor series, the first term left out of which is below 1e-18. Terms are
summed by twos, which is faster.
"""

from stackbounce.engine.kernel import kernel

_ROUND = 6755399441055744.0  # 1.5 * 2^52: a number added to it and taken off again is rounded
_PER_HALF_TURN = 0.3183098861837907  # 1/pi
_HALF_TURN = 3.141592651605606  # pi to 29 bits: its multiples up to 2^24 are exact ...
_REST = 1.984187159361081e-09  # ... and the rest


@kernel
def half_turns(x: float) -> tuple[float, float]:
    """Return s = 1 or -1 and an angle r up to pi/2: cos x = s cos r, sin x = s sin r."""
    turns = (x * _PER_HALF_TURN + _ROUND) - _ROUND
    odd = turns - 2.0 * ((0.5 * turns + _ROUND) - _ROUND)
    return 1.0 - 2.0 * abs(odd), (x - turns * _HALF_TURN) - turns * _REST


@kernel
def cosine(z: float) -> float:
    """Return cos x for z = x^2, x at most pi/2."""
    zz = z * z
    even = 1.0 / 2432902008176640000.0
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
    """Return (sin x)/x for z = x^2, x at most pi/2."""
    zz = z * z
    even = 1.0 / 51090942171709440000.0
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
