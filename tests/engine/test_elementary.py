"""Parts of the engine: functions with their errors, limits and bits, series, the event queue."""

import itertools
import math
import random
from random import Random

import mpmath
import numpy as np
import pytest
from kernel_build.jit import compile_kernel

from stackbounce.engine import elementary
from stackbounce.engine.event_queue import clear_queue, schedule
from stackbounce.engine.series import evaluate, lower_bound
from stackbounce.engine.trigonometry import cosine, half_turns, nudge_mode, sinc

INF, NAN = math.inf, math.nan
SUBNORMAL, TINY, HUGE = 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308
CASES = 1500  # of each range

uniform = random.Random(1).uniform


def near_one():
    return 1.0 + uniform(-1.0, 1.0) * 10.0 ** uniform(-14.0, -1.0)


def anything():
    return 2.0 ** uniform(-1074.0, 1023.9)


def steep():
    """A number near 1 to a power that is nearly the largest."""
    x = uniform(0.6, 1.6)
    return x, uniform(-744.0, 709.0) / (math.log(x) or 1.0)


def wide():
    x = anything()
    return x, uniform(-744.0, 709.0) / (math.log(x) or 1.0)


def quarter_turns():
    """The double nearest to a whole number of quarter turns."""
    return float(int(uniform(1.0, 2.0**14)) * mpmath.pi / 2)


RANGES = {
    "exp": [
        lambda: (uniform(-708.0, 709.7),),
        lambda: (uniform(-1.0, 1.0),),
        lambda: (uniform(-745.0, -708.0),),
        lambda: (uniform(-1.0, 1.0) * 10.0 ** uniform(-300.0, 0.0),),
    ],
    "log": [
        lambda: (anything(),),
        lambda: (uniform(0.3, 3.0),),
        lambda: (near_one(),),
        lambda: (uniform(0.0, TINY),),
    ],
    "power": [
        lambda: (uniform(0.0, 3.0), uniform(0.1, 6.0)),
        lambda: (10.0 ** uniform(-20.0, 1.0), 1.37),
        lambda: (near_one(), uniform(-1e3, 1e3)),
        lambda: (uniform(0.0, TINY), uniform(-1.0, 1.0)),
        steep,
        wide,
    ],
    "sine_and_cosine": [
        lambda: (uniform(-1.0, 1.0),),
        lambda: (uniform(-1e4, 1e4),),
        lambda: (uniform(-2.6e7, 2.6e7),),
        lambda: (uniform(-1.0, 1.0) * 10.0 ** uniform(-300.0, 0.0),),
        lambda: (quarter_turns(),),
    ],
}
EXACT = {"exp": mpmath.exp, "log": mpmath.log, "power": mpmath.power}


def units(value, exact):
    """Return the error of a value in units of the last place of the exact one."""
    return abs(mpmath.mpf(value) - exact) / math.ulp(float(exact))


def arguments(name, count):
    return [draw() for draw in RANGES[name] for _ in range(count)]


@pytest.mark.parametrize("name", EXACT)
def test_errors_are_below_one_unit(name):
    function, exact = getattr(elementary, name), EXACT[name]
    with mpmath.workprec(200):
        for case in arguments(name, CASES):
            true = exact(*map(mpmath.mpf, case))  # a subnormal result is rounded twice
            assert units(function(*case), true) <= (0.9 if abs(true) >= TINY else 1.0)


def test_sine_with_cosine():
    with mpmath.workprec(200):
        for (x,) in arguments("sine_and_cosine", CASES):
            sin, cos = elementary.sine_and_cosine(x)
            assert units(sin, mpmath.sin(x)) < 0.9
            assert units(cos, mpmath.cos(x)) < 0.9


def test_sines_of_large_angles():
    with mpmath.workprec(200):
        for _ in range(CASES):
            x = 10.0 ** uniform(7.4, 15.0)
            sin, cos = elementary.sine_and_cosine(x)
            assert abs(sin - mpmath.sin(x)) < 1e-15
            assert abs(cos - mpmath.cos(x)) < 1e-15
    assert elementary.sine_and_cosine(2.0**50) == elementary.sine_and_cosine(1e300) == (0.0, 1.0)
    for x in (INF, -INF, NAN):
        assert all(map(math.isnan, elementary.sine_and_cosine(x)))


def test_limits_of_exponential_and_logarithm():
    exp, log = elementary.exp, elementary.log
    assert [exp(x) for x in (0.0, -0.0, INF, 709.79, 1e300, -INF, -745.2, -1e300)] == [
        *(1.0, 1.0, INF, INF, INF, 0.0, 0.0, 0.0)
    ]
    assert exp(709.782712893384) == pytest.approx(HUGE, rel=1e-12)
    assert exp(-745.133) == SUBNORMAL
    assert [log(x) for x in (0.0, -0.0, 1.0, INF)] == [-INF, -INF, 0.0, INF]
    assert log(SUBNORMAL) == math.log(SUBNORMAL)
    assert all(map(math.isnan, [exp(NAN), log(NAN), log(-1.0), log(-INF)]))


def test_limits_of_powers():
    some = (0.0, 0.5, 1.0, 1.37, 2.0, 3.0, INF, NAN, 1e300, SUBNORMAL)
    for x, y in itertools.product(some, (*some, -1.0, -2.0, -INF, -1e300)):
        try:
            expected = x**y
        except (OverflowError, ZeroDivisionError):
            expected = INF
        assert elementary.power(x, y) == pytest.approx(expected, rel=3e-16, abs=0.0, nan_ok=True)
    for y in (1.0, 2.0, 0.5):
        for _ in range(100):
            x = uniform(0.0, 10.0)
            assert elementary.power(x, y) == {1.0: x, 2.0: x * x, 0.5: math.sqrt(x)}[y]
    assert math.isnan(elementary.power(-2.0, 3.0))


def test_roots_that_are_near():
    random = np.random.default_rng(4)
    for x in 10.0 ** random.uniform(-307.0, 308.0, 2000):
        n = int(random.integers(1, 61))
        assert elementary.near_root(x, n) == pytest.approx(x ** (1.0 / n), rel=2e-4)
    for x in (0.0, math.inf):
        assert elementary.near_root(x, 7) == x
    assert math.isnan(elementary.near_root(math.nan, 7))


def test_hypotenuse():
    for _ in range(CASES):
        a, b = uniform(-1.0, 1.0) * 10.0 ** uniform(-300.0, 300.0), anything()
        for other in (b, a * uniform(0.0, 2.0)):
            found = elementary.hypotenuse(a, other)
            assert found == pytest.approx(math.hypot(a, other), rel=5e-16, abs=0.0)
    assert elementary.hypotenuse(0.0, 0.0) == 0.0
    assert elementary.hypotenuse(3.0, -4.0) == 5.0


def test_exponents_and_powers_of_two():
    edges = (SUBNORMAL, TINY, HUGE, 0.5, 1.0, 2.0, 65536.0, 2.0**-16, 0.0, INF)
    for x in (*edges, *(anything() for _ in range(CASES))):
        assert elementary.exponent_of(x) == elementary.exponent_of(-x) == math.frexp(x)[1]
        if 0.0 < x < INF:
            assert abs(elementary.nearest_exponent(x) - math.log2(x)) <= 0.5 + 1e-12
        for n in (0, 1, -1, int(uniform(-2200.0, 2200.0)), int(-1050 - math.frexp(x)[1])):
            with np.errstate(over="ignore"):
                assert elementary.times_power_of_two(x, n) == np.ldexp(x, n)
    assert elementary.exponent_of(NAN) == 0
    assert elementary.nearest_exponent(1.4142135623730951) == 0
    assert elementary.nearest_exponent(1.4142135623730954) == 1


def test_an_exact_product():
    for _ in range(CASES):
        a, b = uniform(-1e9, 1e9), 10.0 ** uniform(-9.0, 9.0)
        product, rest = elementary.exact_product(a, b)
        with mpmath.workprec(200):
            assert product == a * b
            assert mpmath.mpf(a) * mpmath.mpf(b) == mpmath.mpf(product) + mpmath.mpf(rest)


@pytest.mark.parametrize("name", [*RANGES, "hypotenuse", "exponent_of"])
def test_compiled_bits(name):
    like = {"hypotenuse": "power", "exponent_of": "log"}.get(name, name)
    cases = arguments(like, 10_000 // len(RANGES[like]))
    special = (0.0, -0.0, 1.0, SUBNORMAL, TINY, HUGE, INF, -INF, NAN)
    cases += itertools.product(special, repeat=len(cases[0]))
    plain, compiled = getattr(elementary, name), compile_kernel(getattr(elementary, name))
    found = np.array([compiled(*case) for case in cases])
    assert np.array_equal(np.array([plain(*case) for case in cases]), found, equal_nan=True)


# --- bounds of power series next to their values on a grid
RNG = np.random.default_rng(4)
SERIES = [(RNG.normal(size=n + 1) * 0.7 ** np.arange(n + 1), n) for n in range(1, 25)]
SERIES += [(np.abs(a) * (-1.0) ** np.arange(n + 1), n) for a, n in SERIES]


@pytest.mark.parametrize("limit", [1e-3, 0.3, 1.0])
@pytest.mark.parametrize("low", [0, 1])
def test_a_series_is_never_below_its_bound(low, limit):
    for a, n in SERIES:
        bound = lower_bound(list(a), low, n, limit)
        least = min(evaluate(list(a[low:]), n - low, s) for s in np.linspace(0.0, limit, 101))
        assert bound <= least + 1e-12
        assert compile_kernel(lower_bound)(a, low, n, limit) == bound


def test_the_bound_is_sharp_for_a_parabola_that_falls():
    assert lower_bound([1.0, -0.5, -0.25], 0, 2, 1.0) == 0.25


@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_lost_number_is_handed_on(place):
    a = np.array([1.0, 2.0, 3.0])
    a[place] = math.nan
    assert math.isnan(lower_bound(list(a), 0, 2, 0.5))
    assert math.isnan(compile_kernel(lower_bound)(a, 0, 2, 0.5))


# --- cosine and sine without branches, compared with the standard library's
ROUNDING = 5e-16  # of numbers up to 1, with the standard library's own


def test_polynomials_begin_as_taylor_series():
    assert cosine(0.0) == sinc(0.0) == 1.0
    for x in (1e-9, 1e-7, 1e-3):
        assert cosine(x * x) == pytest.approx(math.cos(x), rel=2.3e-16, abs=0.0)
        assert x * sinc(x * x) == pytest.approx(math.sin(x), rel=2.3e-16, abs=0.0)


def test_half_turns():
    for x in np.linspace(-70.0, 70.0, 2001).tolist():
        sign, angle = half_turns(x)
        assert abs(angle) <= 0.5 * math.pi * (1.0 + 1e-15)
        assert abs(sign * cosine(angle * angle) - math.cos(x)) <= ROUNDING
        assert abs(sign * (angle * sinc(angle * angle)) - math.sin(x)) <= ROUNDING


@pytest.mark.parametrize("omega", [0.0, 0.3, 1.0, 16.0])
def test_nudged(omega):
    for angle in np.linspace(-0.01, 0.01, 201).tolist():
        d = angle / max(omega, 1.0)
        y, z = nudge_mode(omega, d, 0.6, -0.8)
        travel = math.sin(omega * d) / omega if omega else d
        assert abs(y - (0.6 * math.cos(omega * d) - 0.8 * travel)) <= ROUNDING
        rate = -0.8 * math.cos(omega * d) - 0.6 * omega * math.sin(omega * d)
        assert abs(z - rate) <= ROUNDING * max(omega, 1.0)


# --- the event queue gives the earliest slot, the lowest of equal ones, after any changes
@pytest.mark.parametrize("size", [1, 2, 3, 10, 33])
def test_the_earliest_slot_comes_first(size):
    random = Random(size)
    due, heap, place = [0.0] * size, [0] * size, [0] * size
    clear_queue(due, heap, place)
    times = [float("inf")] * size
    for _ in range(500):
        slot = random.randrange(size)
        times[slot] = random.choice([float("inf"), *map(float, range(8))])
        schedule(due, heap, place, slot, times[slot])
        assert heap[0] == min(range(size), key=lambda s: (times[s], s))
        assert due == times
        assert [heap[place[s]] for s in range(size)] == list(range(size))
