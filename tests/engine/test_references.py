"""The references of rigid balls agree with closed forms and with each other."""

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from reference import rigid


@pytest.mark.parametrize("upper", [1, 3, 10, 100])
def test_elastic_collisions_three_ways(upper):
    numbers = [[1, upper], [1, 1], [0], [-1, -1]]
    exact = rigid.run(*[[Fraction(x) for x in row] for row in numbers])
    digits = rigid.run(*[[mpf(x) for x in row] for row in numbers])
    assert tuple(exact.counts()) == tuple(digits.counts()) == rigid.elastic_counts(1, upper)
    turned = rigid.elastic_pair(1, upper, len(exact.collisions))
    with mp.workdps(50):
        for a, b, c in zip(exact.velocities, digits.velocities, turned, strict=True):
            fraction = mpf(a.numerator) / a.denominator
            assert abs(b - fraction) < mpf(10) ** -45
            assert abs(c - fraction) < mpf(10) ** -45


def test_collapse_threshold():
    with mp.workdps(50):
        for percent, upper in ((50, 8), (80, 80), (90, 360)):
            threshold = rigid.collapse_threshold(mpf(percent) / 100, mpf(percent) / 100)
            assert abs(threshold - upper) < mpf(10) ** -40
