"""The references agree with closed forms, with published values and with each other."""

import json
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from reference import make_data, rigid, springs

# Computed outside this project: m2/m1, k2/k1, gap omega1/v0, and both velocities.
PUBLISHED_SPRINGS = [
    ((1, 3), 1, 0, (0.888123, 1.278167)),
    ((1, 3), 0.01, 0, (0.009420, 1.999933)),
    ((1, 3), 100, 0, (0.999788, 1.000636)),
    ((1, 1), 1, 0, (0.766350, 1.188574)),
    ((1, 10), 0.1, 0, (0.751498, 2.313548)),
    ((1, 3), 1, 1, (0.322171, 1.920577)),
    ((10, 1), 1, mp.pi, (0.168, None)),
]


@pytest.mark.parametrize(("ratio", "stiffness", "delay", "published"), PUBLISHED_SPRINGS)
def test_springs_published(ratio, stiffness, delay, published):
    upper, lower = ratio
    gap = delay * mp.sqrt(lower)
    outcome = springs.run([lower, upper], [1, stiffness], [gap], [-1, -1])
    for velocity, value in zip(outcome.velocities, published, strict=True):
        if value is not None:
            assert abs(velocity - value) < (6e-7 if value != 0.168 else 6e-4)


def test_springs_against_the_modes_of_equations_5_and_6():
    """Equal balls and springs: until the first contact opens, golden-ratio frequencies."""
    with mp.workdps(40):
        modes = [(mp.sqrt(5) - 1) / 2, (mp.sqrt(5) + 1) / 2]
        shapes = [2 - w**2 for w in modes]  # of the upper ball where the lower one's is 1
        weights = [(s - 1) * (1 + s) / (1 + s**2) / w for s, w in zip(shapes, modes, strict=True)]
        pairs = list(zip(weights, modes, strict=True))
        release = mp.findroot(lambda t: sum(a * mp.sin(w * t) for a, w in pairs), 4.5)
        interval = springs.run([1, 1], [1, 1], [0], [-1, -1]).intervals[1]
        assert interval.contact == 1
        assert abs(interval.end - release) < mpf(10) ** -30
        impulse = sum(a * (1 - mp.cos(w * release)) / w for a, w in pairs)
        assert abs(interval.impulse - impulse) < mpf(10) ** -30


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


def test_collapse_of_three_meets_collapse_of_two():
    """A very heavy lower ball is a floor."""
    for upper, collapses in ((7.99, False), (8.01, True)):
        assert rigid.ends_in_collapse([1e9, 1, upper], 0.5, 0.5) is collapses
    # equal balls: e below 7 - 4 sqrt(3) (McNamara and Young 1992)
    assert rigid.ends_in_collapse([1, 1, 1], 0.0717, 0.0717)
    assert not rigid.ends_in_collapse([1, 1, 1], 0.0719, 0.0719)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "rows"), [("springs", (0, 7, 100)), ("hysteretic", (0, 3))])
def test_data_files_are_what_the_script_writes(name, rows):
    cases = {
        "springs": (make_data.spring_cases, make_data.solve_springs),
        "hysteretic": (make_data.hysteretic_cases, make_data.solve_hysteretic),
    }
    make_cases, solve = cases[name]
    stored = make_data.read(name)
    for index, case in enumerate(make_cases()):
        if index in rows:
            assert stored[index] == json.loads(make_data.row(case, solve(case)))
        if index == max(rows):
            return
