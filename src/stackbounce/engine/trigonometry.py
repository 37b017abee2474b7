"""cos x and (sin x)/x as polynomials, which a compiler can vectorise.

Multiples of a half turn are subtracted first, without a branch, so that at most a quarter turn
either way remains. There cos x and (sin x)/x are polynomials in x^2. The first coefficients are
those of the Taylor series; the others are from Remez's algorithm, with the smallest error: below
6e-18. Terms are summed in pairs, which is faster.
"""

from stackbounce.engine.kernels import kernel

_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and subtracting it rounds a number
_PER_HALF_TURN = 0.3183098861837907  # 1/pi
_HALF_TURN = 3.141592651605606  # pi to 29 bits: multiples up to 2^24 are exact
_REST = 1.984187159361081e-09  # the rest of pi


@kernel
def half_turns(x: float) -> tuple[float, float]:
    """Return s = 1 or -1 and an angle r up to pi/2 with cos x = s cos r, sin x = s sin r."""
    turns = (x * _PER_HALF_TURN + _ROUND) - _ROUND
    odd = turns - 2.0 * ((0.5 * turns + _ROUND) - _ROUND)
    return 1.0 - 2.0 * abs(odd), (x - turns * _HALF_TURN) - turns * _REST


@kernel
def cosine(z: float) -> float:
    """Return cos x for z = x^2, x at most pi/2."""
    zz = z * z
    even = 2.4801587285783923e-05 + zz * (2.0876592592640105e-09 + zz * 4.6161350973324585e-14)
    even = 1.0 + zz * (0.04166666666666583 + zz * even)
    odd = -0.001388888888883005 + zz * (-2.755731706851301e-07 + zz * -1.1463635441551134e-11)
    odd = -0.5 + zz * odd
    return even + z * odd


@kernel
def sinc(z: float) -> float:
    """Return (sin x)/x for z = x^2, x at most pi/2."""
    zz = z * z
    even = 2.755731921214364e-06 + zz * (1.6058943987849492e-10 + zz * 2.7222687986209786e-15)
    even = 1.0 + zz * (0.008333333333333212 + zz * even)
    odd = -0.00019841269841215352 + zz * (-2.505210696129337e-08 + zz * -7.643098981846764e-13)
    odd = -0.16666666666666666 + zz * odd
    return even + z * odd


@kernel
def nudge_mode(omega: float, d: float, y: float, z: float) -> tuple[float, float]:
    """Return position and velocity of a mode at a time d later, omega d being at most 0.01 rad."""
    square = -omega * omega
    angle = square * d * d
    cos = 1.0 + angle * (1.0 / 2.0 + angle * (1.0 / 24.0 + angle * (1.0 / 720.0)))
    travel = d * (1.0 + angle * (1.0 / 6.0 + angle * (1.0 / 120.0)))
    return y * cos + z * travel, z * cos + square * (y * travel)
