"""Whether numbers with errors are right, and as often as they should be."""

from scipy.stats import binom


def near(found, true, errors=3.0):
    """Return whether a number is within some of its errors of the true one."""
    return abs(found.nominal_value - true) <= errors * found.std_dev + 1e-9 * abs(true)


def nominal(numbers):
    return [number.nominal_value for number in numbers]


def possible(hits, count, least=0.683, most=0.683):
    """Return whether so many of some trials can be right, by chance of 1 in 100."""
    return binom.cdf(hits, count, least) > 0.005 and binom.sf(hits - 1, count, most) > 0.005
