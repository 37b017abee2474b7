"""Grazing, ties, zero gaps, contacts that open without speed, and stacks that never touch."""

from itertools import pairwise

import numpy as np
import pytest

import stackbounce as sb
from drops import of_contact, rigid, springs
from reference import springs as reference

PRECISION = 1e-11


def assert_reference(masses, stiffnesses, gaps, velocities):
    """Compare velocities and counts with the reference; return the result."""
    result = sb.simulate(springs(masses, stiffnesses, gaps, velocities))
    expected = reference.run(masses, stiffnesses, gaps, velocities)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == expected.counts(len(masses))
    assert result.rebound_speeds == pytest.approx(
        [float(v) for v in expected.velocities], abs=PRECISION
    )
    return result


@pytest.mark.parametrize("size", [2, 3, 4, 5, 6])
def test_zero_gaps_are_closed_from_the_start(size):
    """There c = c' = c'' = 0, and the first derivative that is not 0 is positive."""
    result = sb.simulate(springs([1.0] * size, [1.0] * size))
    for i in range(size):
        assert of_contact(result, i)["start"][0] == 0.0
    assert abs(result.energy_retained - 1) <= 1e-12


@pytest.mark.parametrize("size", [2, 3])
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_zero_gaps_are_closed_from_the_start_with_power_laws(size, exponent):
    laws = [sb.Hysteretic(1.0, exponent=exponent, restitution=0.8)] * size
    result = sb.simulate(sb.Drop([sb.Ball(1.0)] * size, laws, impact_speed=1.0))
    assert result.intervals["start"] == pytest.approx(0.0, abs=1e-12)


def test_ties_are_listed_by_contact():
    result = sb.simulate(springs([1.0] * 4, [1.0] * 4))
    assert result.intervals["contact"].tolist() == [0, 1, 2, 3]


def test_tiny_gaps_meet_zero_gaps():
    """The outcome does not jump where the gap closes."""
    closed = sb.simulate(springs([1.0, 2.0, 0.5], [1.0, 3.0, 0.7])).rebound_ratios
    for gap in (1e-300, 1e-100, 1e-18, 1e-15, 1e-12):
        result = sb.simulate(springs([1.0, 2.0, 0.5], [1.0, 3.0, 0.7], [gap, gap]))
        assert result.rebound_ratios == pytest.approx(closed, abs=PRECISION + 10 * gap)
        assert result.collisions.tolist() == [1, 1, 1]


def test_touch_times_of_tiny_gaps():
    """With c = t**3/6 - gap the touch comes at the cube root of six gaps, to leading order."""
    for gap in (1e-6, 1e-8, 1e-10, 1e-12):
        result = sb.simulate(springs([1.0, 1.0], [1.0, 1.0], [gap]))
        touch = (6 * gap) ** (1 / 3)
        start = of_contact(result, 1)["start"][0]
        assert start == pytest.approx(touch, rel=touch**2 / 50, abs=PRECISION)


@pytest.mark.parametrize("stiffness", [0.03, 1.0, 30.0])
def test_a_contact_opens_as_another_closes(stiffness):
    """Equal balls, gap pi v/omega: they meet as the lower one leaves the floor, to rounding.

    The lower ball comes back to the floor as they part; both leave at the same speed.
    """
    result = sb.simulate(springs([1.0, 1.0], [1.0, stiffness], [np.pi]))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.collisions.tolist() == [2, 1]
    assert of_contact(result, 0)["end"][0] == pytest.approx(np.pi, abs=PRECISION)
    assert of_contact(result, 1)["start"][0] == pytest.approx(np.pi, abs=PRECISION)


@pytest.mark.parametrize(
    ("masses", "stiffness"),
    [((1.0, 1.0), 1.0), ((1.0, 0.3), 1.0), ((1.0, 0.1), 0.4)],
)
def test_contacts_that_open_without_speed(masses, stiffness):
    """A drop with a zero gap, played backwards: both contacts open together, at speed 1.

    The upper one opens with c = c' = c'' = 0.
    """
    forward = sb.simulate(springs(masses, [1.0, stiffness]))
    assert forward.collisions.tolist() == [1, 1]
    assert of_contact(forward, 0)["end"] == forward.end_time
    position = forward.sample([forward.end_time]).position.values[:, 0]
    gap, velocities = position[1] - position[0], -forward.rebound_speeds
    drop = springs(masses, [1.0, stiffness], [gap], velocities.tolist())
    result = sb.simulate(drop, event_limit=1000)
    assert result.status is sb.Status.FINISHED
    assert result.rebound_speeds == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.intervals["end"].max() == pytest.approx(forward.end_time, abs=1e-4)
    assert abs(result.energy_retained - 1) <= 1e-12


def verges(family, parameters):
    """Yield neighbouring parameters between which the number of contact intervals changes."""

    def counts(x):
        return sb.simulate(family(x)).collisions.tolist()

    for low, high in pairwise(parameters):
        before = counts(low)
        if counts(high) != before:
            while (middle := 0.5 * (low + high)) not in (low, high):
                low, high = (middle, high) if counts(middle) == before else (low, middle)
            yield low, high


@pytest.mark.parametrize(
    ("masses", "stiffness"),
    [((1.0, 6.0), 0.2), ((1.0, 20.0), 3.0), ((1.0, 2.0), 0.05), ((3.0, 1.0), 8.0)],
)
def test_contacts_on_the_verge_of_opening(masses, stiffness):
    """Where a contact just opens, or just misses to close, the outcome does not jump."""

    def family(gap):
        return springs(masses, [1.0, stiffness], [gap])

    pairs = list(verges(family, np.linspace(0.0, 8.0, 60).tolist()))
    assert pairs
    for low, high in pairs:
        one, other = sb.simulate(family(low)), sb.simulate(family(high))
        assert one.status is other.status is sb.Status.FINISHED
        assert one.rebound_ratios == pytest.approx(other.rebound_ratios, abs=PRECISION)
        assert abs(one.energy_retained - 1) <= 1e-12
        assert abs(other.energy_retained - 1) <= 1e-12


def test_single_ball():
    result = sb.simulate(springs([2.0], [8.0], velocities=[-3.0]))
    assert result.rebound_speeds == pytest.approx([3.0], abs=1e-14)
    (interval,) = result.intervals
    assert interval["start"] == 0.0
    assert interval["end"] == pytest.approx(np.pi / 2, rel=1e-15)
    assert interval["peak_compression"] == pytest.approx(1.5, rel=1e-15)
    assert interval["peak_force"] == pytest.approx(12.0, rel=1e-15)
    assert interval["impulse"] == pytest.approx(12.0, rel=1e-15)


@pytest.mark.parametrize("stack", [springs, rigid])
@pytest.mark.parametrize(
    ("floor", "velocities"),
    [(None, [-1.0, -1.0]), (None, [-1.0, 2.0]), (1.0, [1.0, 1.0]), (1.0, [0.0, 0.0, 1.0])],
)
@pytest.mark.parametrize("gap", [0.0, 0.5])
def test_stacks_that_never_touch_finish_at_once(stack, floor, velocities, gap):
    size = len(velocities)
    drop = stack([1.0] * size, [floor] + [1.0] * (size - 1), [gap] * (size - 1), velocities)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.end_time == 0.0
    assert result.collisions.tolist() == [0] * size
    assert result.rebound_speeds.tolist() == velocities
    assert len(result.intervals) == len(result.events) == 0
    assert result.energy_retained == 1.0


def test_ball_at_rest_on_the_floor_is_struck():
    for gap in (0.0, 0.4):
        assert_reference([1.0, 2.0], [1.0, 3.0], [gap], [0.0, -1.0])


def test_lowest_ball_on_its_way_up():
    assert_reference([1.0, 2.0], [1.0, 3.0], [0.4], [0.5, -1.0])


def test_cradle_on_springs():
    """Touching balls without a floor: the row spreads, momentum and energy are kept."""
    result = assert_reference([1.0] * 4, [None, 1.0, 1.0, 1.0], [0.0] * 3, [1.0, 0.0, 0.0, 0.0])
    assert result.rebound_speeds.sum() == pytest.approx(1.0, abs=1e-14)
    assert abs(result.energy_retained - 1) <= 1e-12


@pytest.mark.parametrize("gap", [1e3, 1e6, 1e9])
def test_huge_gaps(gap):
    result = sb.simulate(springs([2.0, 1.0], [1.0, 1.0], [gap]))
    separate = sb.simulate(rigid([2.0, 1.0]))
    assert result.rebound_ratios == pytest.approx(separate.rebound_ratios, abs=PRECISION)
    assert result.collisions.tolist() == separate.collisions.tolist()


@pytest.mark.parametrize("drop", [rigid([1.0, 1e4]), springs([1.0, 50.0], [1.0, 1.0], [3.0])])
def test_event_limit(drop):
    limited, full = sb.simulate(drop, event_limit=5), sb.simulate(drop)
    assert limited.status is sb.Status.EVENT_LIMIT
    assert full.status is sb.Status.FINISHED
    reached = len(limited.events)
    assert 0 < reached <= 5 < len(full.events)
    assert limited.events.tolist() == full.events[:reached].tolist()


def test_event_limit_of_collisions():
    assert len(sb.simulate(rigid([1.0, 1e4]), event_limit=100).events) == 100
    assert sb.simulate(rigid([1.0, 1e4]), event_limit=314).status is sb.Status.FINISHED
    assert sb.simulate(rigid([1.0, 1e4]), event_limit=313).status is sb.Status.EVENT_LIMIT


@pytest.mark.parametrize("power", [-8, -4, 4, 8])
def test_extreme_ratios_keep_energy(power):
    for masses, stiffnesses in (([1.0, 10.0**power], [1.0, 1.0]), ([1.0, 1.0], [1.0, 10.0**power])):
        result = sb.simulate(springs(masses, stiffnesses))
        assert result.status is sb.Status.FINISHED
        assert abs(result.energy_retained - 1) <= 1e-12
