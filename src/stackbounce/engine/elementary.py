"""Exponential, logarithm, power, sine and cosine, of basic operations only.

The C library's functions differ in their last digits from one system to the next. These kernels use
only operations that IEEE 754 rounds exactly (+ - * / and the square root), never a fused
multiply-add. They give the same bits everywhere: in plain Python, or compiled for any processor.
None raises: where Python's `math` would, the result is an infinity or not a number.

Sine, cosine and `log` reduce their arguments, and evaluate polynomials, in the manner of fdlibm
(Sun Microsystems, 1993); the polynomials are fitted at Chebyshev nodes. Exponentials and powers
look up the nearest of 128 steps (P. T. P. Tang, ACM Trans. Math. Softw. 15, 144, 1989; 16, 378,
1990), and so need no division. Where a double has too few digits, a number is the sum of two
doubles (Dekker, Numerische Mathematik 18, 224, 1971). Errors are given in units of the last place;
subnormal results have at most 1.
"""

import math
from decimal import Decimal, localcontext

from stackbounce.engine.kernels import kernel

_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding and subtracting it rounds a number
_SPLIT = 134217729.0  # 2^27 + 1
_ROOT_TWO = 1.4142135623730951
_POWERS_OF_TWO = tuple(math.ldexp(1.0, n) for n in range(-1022, 1024))
_SMALLEST_NORMAL = 2.2250738585072014e-308

_LN2 = 0.6931471803691238  # ln 2 to 32 bits: whole multiples up to 2^21 are exact
_LN2_REST = 1.9082149292705877e-10
_LARGEST = 709.782712893384  # its exponential is the last finite one
_SMALLEST = -745.1332191019412  # its exponential is the last above 0

_THIRD = 0.3333333333333333

_STEPS = 128  # of the tables: powers of two from 1 to 2, and numbers from 1 to 2
_STEPS_PER_LN2 = 184.6649652337873  # 128/ln 2
_STEP = _LN2 / _STEPS
_STEP_REST = _LN2_REST / _STEPS
_LOW_END = 0.70703125  # 90.5/128: the least significand of which a logarithm is looked up
_TO_22_BITS = 1.5 * 2.0**30  # adding and subtracting it rounds to multiples of 2^-22


def _two_to_the_steps() -> list[tuple[float, float]]:
    """Return 2^(j/128) as sums of two doubles, for j from 0 to 127."""
    with localcontext(prec=50):
        exact = [Decimal(2) ** (Decimal(j) / _STEPS) for j in range(_STEPS)]
        return [(float(value), float(value - Decimal(float(value)))) for value in exact]


def _logarithms() -> list[tuple[float, float, float]]:
    """Return 1/c to 9 bits and -ln of it as a sum of two doubles, the first a multiple of 2^-42.

    The numbers c are those in the middle of steps of 1/128. On both sides of 1, c is 1.
    """
    found = []
    with localcontext(prec=50):
        for j in range(2 * _STEPS):
            near = j in (_STEPS - 1, _STEPS)
            inverse = 1.0 if near else math.floor(512.0 * _STEPS / (j + 0.5) + 0.5) / 512.0
            exact = -Decimal(inverse).ln()
            high = math.floor(float(exact) * 2.0**42 + 0.5) / 2.0**42
            found.append((inverse, high, float(exact - Decimal(high))))
    return found


_TWO_TO_STEP, _TWO_TO_STEP_REST = zip(*_two_to_the_steps(), strict=True)
_INVERSE, _LOG, _LOG_REST = zip(*_logarithms(), strict=True)

_PER_QUARTER_TURN = 0.6366197723675814  # 2/pi
_QUARTER_TURN = 1.570796325802803  # pi/2 to 29 bits: whole multiples up to 2^24 are exact
_QUARTER_TURN_2 = 9.920935774287987e-10  # the next 29 bits
_QUARTER_TURN_3 = 2.2517417706346578e-18  # the next 29 bits
_QUARTER_TURN_4 = 3.5215598651832e-27  # the rest
_FEW_TURNS = 26353589.0  # 2^24 quarter turns
_PER_TURN = 0.15915494309189535  # 1/(2 pi)
_TURN = 6.283185307179586
_TURN_REST = 2.4492935982947064e-16
_COARSE = 1125899906842624.0  # 2^50


@kernel
def exact_product(a: float, b: float) -> tuple[float, float]:
    """Return a b rounded, and its rounding error, for factors below 2^996 (Dekker, 1971)."""
    product = a * b
    wide = _SPLIT * a
    a_high = wide - (wide - a)
    a_low = a - a_high
    wide = _SPLIT * b
    b_high = wide - (wide - b)
    b_low = b - b_high
    rest = (a_high * b_high - product) + a_high * b_low + a_low * b_high + a_low * b_low
    return product, rest


@kernel
def times_power_of_two(x: float, n: int) -> float:
    """Return x 2^n, rounded once where it is subnormal."""
    while n > 1023:
        if x == 0.0 or abs(x) == math.inf:
            return x
        x *= 8.98846567431158e307  # 2^1023
        n -= 1023
    while n < -1022:
        if x == 0.0:
            return x
        x *= 2.004168360008973e-292  # 2^-969: what is still to come is at most 2^-53
        n += 969
    return x * _POWERS_OF_TWO[n + 1022]


@kernel
def _significand(x: float) -> tuple[float, int]:
    """Return m from 1 to below 2, and e, with x = m 2^e, for finite x > 0."""
    shift = 1
    if x < _SMALLEST_NORMAL:
        x *= 18014398509481984.0  # 2^54
        shift = 55
    m, e = math.frexp(x)
    return 2.0 * m, e - shift


@kernel
def exponent_of(x: float) -> int:
    """Return e with 2^(e-1) <= |x| < 2^e; 0 for 0, an infinity or not a number."""
    size = abs(x)
    if not 0.0 < size < math.inf:
        return 0
    return _significand(size)[1] + 1


@kernel
def nearest_exponent(x: float) -> int:
    """Return the whole number nearest to log2 x, for finite x > 0."""
    m, e = _significand(x)
    return e + 1 if m > _ROOT_TWO else e


@kernel
def exp(x: float) -> float:
    """Return e^x; the error is below 1 unit."""
    return _exp_of_sum(x, 0.0)


@kernel
def _exp_of_sum(x: float, low: float) -> float:
    """Return e^(x + low), for a small second part: 2^(k/128) e^r, with |r| <= ln 2/256."""
    if not x <= _LARGEST:
        return x if x != x else math.inf
    if x < _SMALLEST:
        return 0.0
    steps = (x * _STEPS_PER_LN2 + _ROUND) - _ROUND
    r = (x - steps * _STEP) - (steps * _STEP_REST - low)
    t = r * r
    p = r + t * (
        (0.5 + r * 0.16666666666666666) + t * (0.041666666666666664 + r * 0.008333333333333333)
    )
    k = int(steps)
    j = k & (_STEPS - 1)
    value = _TWO_TO_STEP[j]
    return times_power_of_two(value + (_TWO_TO_STEP_REST[j] + value * p), k >> 7)


@kernel
def _log_series(z: float) -> float:
    """Return 1/5 + z/7 + z^2/9 + ..., for z up to (3 - sqrt 8)^2."""
    zz = z * z
    even = 0.07692297481259215 + zz * 0.05853118169745603
    even = 0.2 + zz * (0.11111111110827943 + zz * even)
    odd = 0.06667402346923655 + zz * 0.05861589311938259
    odd = 0.14285714285714682 + zz * (0.09090909167696401 + zz * odd)
    return even + z * odd


@kernel
def log(x: float) -> float:
    """Return the natural logarithm; the error is below 1 unit.

    With x = 2^e (1 + f) and s = f/(2 + f), ln(1 + f) is 2 s (1 + s^2/3 + s^4/5 + ...).
    """
    if not 0.0 < x < math.inf:
        if x == 0.0:
            return -math.inf
        return x if x > 0.0 else math.nan
    m, e = _significand(x)
    if m > _ROOT_TWO:
        m *= 0.5
        e += 1
    f = m - 1.0
    s = f / (2.0 + f)
    z = s * s
    square = 0.5 * f * f
    rest = 2.0 * z * (_THIRD + z * _log_series(z))
    return e * _LN2 - ((square - (s * (square + rest) + e * _LN2_REST)) - f)


@kernel
def _log_in_two(x: float) -> tuple[float, float]:
    """Return the natural logarithm as a sum of two doubles, relative error 2^-64, 0 < x < inf.

    With x = 2^e m and an inverse 1/c looked up, ln x = e ln 2 - ln(1/c) + ln(1 + r), r = m/c - 1.
    Of m = a + b, a has few bits: a/c - 1, its square, and its sum with the first two logarithms are
    exact, and so is b/c.
    """
    m, e = _significand(x)
    if m >= 2.0 * _LOW_END:
        m *= 0.5
        e += 1
    j = int(_STEPS * m)
    inverse = _INVERSE[j]
    a = (m + _TO_22_BITS) - _TO_22_BITS
    r = a * inverse - 1.0
    r_low = (m - a) * inverse
    s = r + r_low
    t = s * s
    series = (_THIRD - 0.25 * s) + t * (
        (0.2 - s * 0.16666666666666666)
        + t * ((0.14285714285714285 - 0.125 * s) + t * 0.1111111111111111)
    )
    exact = (e * _LN2 + _LOG[j]) + r
    square = 0.5 * r * r
    high = exact - square
    low = (exact - high) - square
    first = high + r_low
    low += (high - first) + r_low
    rest = e * _LN2_REST + _LOG_REST[j]
    low += rest + (s * t * series - r_low * (r + 0.5 * r_low))
    total = first + low
    return total, (first - total) + low


@kernel
def power(x: float, y: float) -> float:
    """Return x^y for x >= 0; the error is below 1 unit.

    Exact as far as rounding allows for y = 1/2, 1 and 2.
    """
    if y == 0.0 or x == 1.0:
        return 1.0
    if not 0.0 < x < math.inf:
        if x == 0.0 and y == y:
            return 0.0 if y > 0.0 else math.inf
        if x > 0.0 and y == y:
            return x if y > 0.0 else 0.0
        return math.nan
    if y == 1.0:
        return x
    if y == 2.0:
        return x * x
    if y == 0.5:
        return math.sqrt(x)
    high, low = _log_in_two(x)
    size = y * high
    if not abs(size) < 800.0:
        return _exp_of_sum(size, 0.0)
    size, rest = exact_product(y, high)
    return _exp_of_sum(size, rest + y * low)


@kernel
def quick_log(x: float) -> float:
    """Return the natural logarithm with an error of about 2e-16 (1 + |ln x|), without branches.

    It is `_log_in_two` with fewer digits; x below 1e-300, or not a number, counts as 1e-300.
    """
    m, e = math.frexp(min(x, 1e300) if x > 1e-300 else 1e-300)
    j, turns = int(2.0 * _STEPS * m), e - 1.0
    r = 2.0 * m * _INVERSE[j] - 1.0
    t = r * r
    series = (0.5 - _THIRD * r) + t * ((0.25 - 0.2 * r) + t * 0.16666666666666666)
    low = turns * _LN2_REST + _LOG_REST[j] + (r - t * series)
    value: float = turns * _LN2 + _LOG[j] + low
    return value


@kernel
def swift_log(x: float) -> float:
    """Return the natural logarithm with an error of about 1e-16 (1 + |ln x|), without branches.

    It can be computed for many numbers at the same time; x below 1e-300, or not a number, counts as
    1e-300.
    """
    m, e = math.frexp(min(x, 1e300) if x > 1e-300 else 1e-300)
    high = 1.0 if m > 0.5 * _ROOT_TWO else 0.0
    f = m * (2.0 - high) - 1.0
    s = f / (2.0 + f)
    z = s * s
    rest = 2.0 * s * (1.0 + z * (_THIRD + z * _log_series(z)))
    turns = e - 1.0 + high
    return turns * _LN2 + (turns * _LN2_REST + rest)


@kernel
def swift_exp(x: float) -> float:
    """Return e^x with a relative error of about 2e-16, without branches.

    It can be computed for many numbers at the same time; results are from 1e-304 to 1e304.
    """
    x = min(max(x, -700.0), 700.0)
    whole = (x * 1.4426950408889634 + _ROUND) - _ROUND
    r = (x - whole * _LN2) - whole * _LN2_REST
    t = r * r
    tt = t * t
    even = 2.755731922398589e-07 + t * 2.08767569878681e-09
    even = (0.5 + t * 0.041666666666666664) + tt * (
        (0.001388888888888889 + t * 2.48015873015873e-05) + tt * even
    )
    odd = 2.755731922398589e-06 * t + (0.0001984126984126984 + tt * 2.505210838544172e-08)
    odd = (0.16666666666666666 + t * 0.008333333333333333) + tt * odd
    value = 1.0 + (r + t * (even + r * odd))
    return value * _POWERS_OF_TWO[(int(whole) + 1022) & 2047]


@kernel
def near_root(x: float, n: int) -> float:
    """Return x^(1/n) for x >= 0, with a relative error below 2e-4: enough to choose a step.

    Polynomials stand for log2 of a significand and for 2^f, |f| <= 1/2.
    """
    if not 0.0 < x < math.inf:
        return x
    m, e = _significand(x)
    series = -2.07833517 + m * (0.62603218 + m * -0.07844068)
    y = (e + (-2.49835315 + m * (4.02921139 + m * series))) / n
    whole = (y + _ROUND) - _ROUND
    f = y - whole
    root = 0.99992456 + f * (0.69313673 + f * (0.24263948 + f * 0.05583828))
    return times_power_of_two(root, int(whole))


@kernel
def _within_eighth_turn(x: float) -> tuple[int, float, float]:
    """Return a whole number of quarter turns, and the rest of the angle x as a sum of two doubles.

    The rest is at most about an eighth of a turn. Up to 2^24 quarter turns (Cody and Waite,
    Software Manual for the Elementary Functions, 1980) its relative error is that of a double.
    Larger angles first lose their whole turns, with an absolute error below 1e-15. From 2^50 on
    neighbouring doubles are up to a turn apart or more: the angle counts as 0.
    """
    if not abs(x) < _FEW_TURNS:
        if not abs(x) < _COARSE:
            return 0, 0.0 * x, 0.0  # not a number for an infinity
        turns = math.floor(x * _PER_TURN)
        product, rest = exact_product(float(turns), _TURN)
        x = ((x - product) - rest) - turns * _TURN_REST
    quarters = (x * _PER_QUARTER_TURN + _ROUND) - _ROUND
    first = x - quarters * _QUARTER_TURN
    part = quarters * _QUARTER_TURN_2
    second = first - part
    lost = first - second
    error = (first - (second + lost)) + (lost - part)
    part = quarters * _QUARTER_TURN_3 - error
    third = second - part
    low = ((second - third) - part) - quarters * _QUARTER_TURN_4
    high = third + low
    return int(quarters), high, (third - high) + low


@kernel
def _near_sine(x: float, low: float) -> float:
    """Return sin(x + low), for an angle up to about an eighth of a turn."""
    z = x * x
    v = z * x
    r = 2.7557316100128336e-06 + z * (-2.5051131339848143e-08 + z * 1.5918092905114907e-10)
    r = 0.008333333333330946 + z * (-0.000198412698367539 + z * r)
    return x - ((z * (0.5 * low - v * r) - low) - v * -0.16666666666666666)


@kernel
def _near_cosine(x: float, low: float) -> float:
    """Return cos(x + low), for an angle up to about an eighth of a turn."""
    z = x * x
    r = -2.755731727021332e-07 + z * (2.0876145952384525e-09 + z * -1.1382609660408365e-11)
    r = 0.041666666666666664 + z * (-0.0013888888888887395 + z * (2.4801587298762765e-05 + z * r))
    half = 0.5 * z
    one = 1.0 - half
    return one + (((1.0 - one) - half) + (z * z * r - x * low))


@kernel
def sine_and_cosine(x: float) -> tuple[float, float]:
    """Return sin x and cos x; the errors are below 1 unit up to 2^24 quarter turns.

    Larger angles lose whole turns first, with an absolute error below 1e-15. From 2^50 on, where
    neighbouring doubles are up to a turn apart or more, the angle counts as 0.
    """
    quarters, high, low = _within_eighth_turn(x)
    sin, cos = _near_sine(high, low), _near_cosine(high, low)
    if quarters & 1:
        sin, cos = cos, -sin
    if quarters & 2:
        sin, cos = -sin, -cos
    return sin, cos


@kernel
def hypotenuse(a: float, b: float) -> float:
    """Return the square root of a^2 + b^2 without overflow, to about 2 units."""
    larger, smaller = abs(a), abs(b)
    if larger < smaller:
        larger, smaller = smaller, larger
    if larger == 0.0 or larger == math.inf:
        return larger
    ratio = smaller / larger
    return larger * math.sqrt(1.0 + ratio * ratio)
