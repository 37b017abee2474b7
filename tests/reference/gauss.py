"""Gauss collocation for c'' = a(c, c'): its matrices, one step, and the dense output, compiled.

On a step the accelerations are the polynomial of degree 7 through the eight Gauss points (Hairer,
Norsett, Wanner, Solving Ordinary Differential Equations I, section II.7); rates and compressions
are its integrals. The end of a step is of order 16, the polynomials inside are of order 8.
"""

import numpy as np
from numba import njit

NODES = 8
SWEEPS = 60
DEGREE = NODES + 1  # of a compression


def _tables() -> tuple[np.ndarray, ...]:
    """Return places in (0, 1), weights, both integration matrices, monomials and the last mode."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    monomials = np.linalg.inv(np.vander(x, increasing=True))  # a's coefficients on [-1, 1]
    modes = np.linalg.inv(np.polynomial.legendre.legvander(x, NODES - 1))
    basis = [np.polynomial.Polynomial(column) for column in monomials.T]
    once = [p.integ(1, lbnd=-1) for p in basis]
    twice = [p.integ(2, lbnd=-1) for p in basis]
    rate = np.array([[p(place) / 2 for p in once] for place in x])
    length = np.array([[p(place) / 4 for p in twice] for place in x])
    return (1 + x) / 2, w / 2, rate, length, monomials, modes[-2:]


PLACES, WEIGHTS, TO_RATE, TO_LENGTH, MONOMIALS, LAST = _tables()


@njit
def evaluate(polynomial, x):
    """Return the polynomial at x in [-1, 1]."""
    total = 0.0
    for k in range(len(polynomial) - 1, -1, -1):
        total = total * x + polynomial[k]
    return total


@njit
def derivative(polynomial, x):
    """Return the derivative of the polynomial at x in [-1, 1]."""
    total = 0.0
    for k in range(len(polynomial) - 1, 0, -1):
        total = total * x + k * polynomial[k]
    return total


@njit
def dense(c, rate, a, h, lengths, rates):
    """Write the polynomials on [-1, 1] of one compression and its rate, from a at the nodes."""
    half = h / 2
    rates[:] = 0.0
    lengths[:] = 0.0
    for k in range(NODES):
        term = 0.0
        for j in range(NODES):
            term += MONOMIALS[k, j] * a[j]
        rates[k + 1] = half * term / (k + 1)
    for k in range(DEGREE):
        lengths[k + 1] = half * rates[k] / (k + 1)
    shift = rate - evaluate(rates, -1.0)
    rates[0] += shift
    lengths[1] += half * shift
    lengths[0] += c - evaluate(lengths, -1.0)


@njit
def crossing(f, samples):
    """Return where f rises above 0 on [-1, 1] (2.0: nowhere), and its highest peak below 0.

    f is looked at in sample points; a peak between two of them is found from the derivative.
    """
    left, value, slope, peak = -1.0, evaluate(f, -1.0), derivative(f, -1.0), -np.inf
    if value >= 0.0 and slope > 0.0:
        return -1.0, peak
    for j in range(1, samples + 1):
        right = -1.0 + 2.0 * j / samples
        there, incline = evaluate(f, right), derivative(f, right)
        if there > 0.0:
            return _root(f, left, right, False), peak
        if slope > 0.0 > incline:
            top = _root(f, left, right, True)
            height = evaluate(f, top)
            if height > 0.0:
                return _root(f, left, top, False), peak
            peak = max(peak, height)
        left, value, slope = right, there, incline
    return 2.0, peak


@njit
def _root(f, left, right, of_slope):
    """Return by halving where f becomes positive, or where its derivative becomes negative."""
    for _ in range(60):
        middle = 0.5 * (left + right)
        if middle <= left or middle >= right:
            break
        if (derivative(f, middle) < 0.0) if of_slope else (evaluate(f, middle) > 0.0):
            right = middle
        else:
            left = middle
    return 0.5 * (left + right) if of_slope else right


@njit
def highest(f, samples, best):
    """Return the largest value of f on [-1, 1], or `best` if that is larger."""
    left, slope = -1.0, derivative(f, -1.0)
    best = max(best, evaluate(f, -1.0), evaluate(f, 1.0))
    for j in range(1, samples + 1):
        right = -1.0 + 2.0 * j / samples
        incline = derivative(f, right)
        if slope > 0.0 > incline:
            best = max(best, evaluate(f, _root(f, left, right, True)))
        left, slope = right, incline
    return best
