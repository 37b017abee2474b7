"""Rows of equal balls, of which the first strikes the others: known results."""

import functools
import math

import numpy as np
import pytest
from scipy.special import jn_zeros, jv

import stackbounce as sb
from reference import precise

LAWS = {"Spring": sb.Spring(1.0), "Hertz": sb.Hertz(1.0)}
finite = pytest.mark.parametrize("law", LAWS)


@functools.cache
def row(law, count, speed=1.0, gap=0.0):
    """Return the run of a row of balls of mass 1, the first of which has a speed."""
    contact = LAWS.get(law) or sb.Rigid(1.0)
    return sb.simulate(
        sb.Drop(
            [sb.Ball(1.0)] * count,
            [None] + [contact] * (count - 1),
            gaps=[gap] * (count - 1),
            velocities=[speed] + [0.0] * (count - 1),
        )
    )


def peak_forces(result):
    """Return the peak forces by contact, from contact 1, each of which had one interval."""
    rows = result.intervals
    assert sorted(rows["contact"]) == list(range(1, len(result.drop.balls)))
    return rows["peak_force"][np.argsort(rows["contact"])]


def peak(times, values):
    """Return time and height of a curve's peak, by a parabola through its highest samples."""
    top = int(np.argmax(values))
    assert 0 < top < len(values) - 1
    a, b, c = values[top - 1 : top + 2]
    shift = 0.5 * (a - c) / (a - 2.0 * b + c)
    return times[top] + shift * (times[1] - times[0]), b - 0.25 * (a - c) * shift


def wave(speed=1.0, first=40, last=80):
    """Return beads per time, and the last bead's times, velocities and largest velocity."""
    result = row("Hertz", 100, speed)
    times = np.linspace(0.0, 100.0 * speed**-0.2, 20001)
    start, end = result.sample(times).velocity.values[[first, last]]
    pace = (last - first) / (peak(times, end)[0] - peak(times, start)[0])
    return pace, times, end, peak(times, end)[1]


@pytest.mark.slow
@finite
def test_cradle_against_thirty_digits(law):
    contact = {"law": law, "stiffness": 1}
    exact = precise.run([1] * 5, [None] + [contact] * 4, [0] * 4, [1, 0, 0, 0, 0])
    result = row(law, 5)
    assert result.collisions.tolist() == exact.counts(5) == [0, 1, 1, 1, 1]
    assert result.rebound_speeds == pytest.approx([float(v) for v in exact.velocities], abs=1e-11)
    ends = sorted(float(interval.end) for interval in exact.intervals)
    assert sorted(result.intervals["end"]) == pytest.approx(ends, rel=1e-10)


@pytest.mark.parametrize(
    ("law", "last", "next_to_last"), [("Spring", 0.94, 0.3), ("Hertz", 0.99, 0.13)]
)
def test_cradle_breaks_up_in_order(law, last, next_to_last):
    """The first three are thrown back, ever less; the last one takes nearly all."""
    speeds = row(law, 5).rebound_speeds
    assert (np.diff(speeds) > 0.0).all()
    assert (speeds[:3] < 0.0).all()
    assert speeds[3:] == pytest.approx([next_to_last, last], abs=0.005)


@pytest.mark.parametrize("gap", [0.0, 1.0])
@pytest.mark.parametrize("count", [2, 5, 50])
def test_rigid_cradle_hands_on_the_velocity(count, gap):
    result = row("Rigid", count, speed=0.3, gap=gap)
    assert result.rebound_speeds.tolist() == [0.0] * (count - 1) + [0.3]
    assert result.collisions.tolist() == [0] + [1] * (count - 1)


@finite
def test_cradle_with_gaps_meets_rigid_collisions(law):
    """The leak falls with the gap, and is gone where no two contacts are closed at one time."""
    leaks = [row(law, 5, gap=gap).rebound_speeds[3] for gap in (0.0, 0.1, 0.3, 1.0, 3.0)]
    assert (np.diff(leaks) < 0.0).all()
    assert abs(leaks[-1]) < 1e-10


@finite
@pytest.mark.parametrize("count", [5, 30, 300, 1000])
def test_momentum_and_energy_are_kept(law, count):
    result = row(law, count)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [0] + [1] * (count - 1)
    assert (result.intervals["start"] == 0.0).all()
    assert math.fsum(result.rebound_speeds) == pytest.approx(1.0, abs=1e-12)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-11)


def test_solitary_wave_keeps_its_height():
    forces = peak_forces(row("Hertz", 300))
    assert forces[60:290] == pytest.approx(forces[60], rel=1e-9)
    assert forces[4] > forces[60] * 1.005  # and it has to form first


@pytest.mark.slow
def test_solitary_wave_is_five_beads_wide():
    """How far it goes while a bead moves faster than a thousandth of its largest velocity.

    Nesterenko's cos^4 is 5 pi / sqrt(10) = 4.97 beads wide in all, and 4.40 by this measure.
    """
    pace, times, velocity, height = wave()
    inside = times[velocity > 1e-3 * height]
    assert pace * (inside[-1] - inside[0]) == pytest.approx(4.76, abs=0.02)
    moment = times[np.argmax(velocity)]
    beads = row("Hertz", 100).sample([moment]).velocity.values[60:, 0]
    assert np.sum(beads > 1e-3 * height) == 5
    assert np.sort(beads)[-6] < 1e-4 * height


@pytest.mark.slow
def test_solitary_wave_against_nesterenko():
    """Within 1 % of the continuum: V = (16/25)^(1/5) (k/m)^(2/5) v_m^(1/5) beads per time.

    By the peak force, V = (4/5)^(1/2) (k/m)^(1/2) c_m^(1/4), it is within 1.5 %.
    """
    pace, _, _, height = wave()
    assert pace == pytest.approx((0.64 * height) ** 0.2, rel=0.01)
    compression = peak_forces(row("Hertz", 100))[60] ** (2 / 3)
    assert pace == pytest.approx(math.sqrt(0.8) * compression**0.25, rel=0.015)


def test_spring_row_is_bessel_functions_until_it_breaks():
    """v_n = J_2n(2t) + J_2n+2(2t) in a long row, until its first contact opens at a zero of J_2.

    The force at contact n is the time integral of v_(n-1) - v_n, or 4n J_2n(2t) / (2t).
    """
    result, n = row("Spring", 40), np.arange(40)
    release = 0.5 * jn_zeros(2, 1)[0]
    assert result.intervals["end"].min() == pytest.approx(release, rel=1e-12)
    times = np.linspace(0.1, release, 9)
    found = result.sample(times)
    for j, t in enumerate(times):
        velocities = jv(2 * n, 2 * t) + jv(2 * n + 2, 2 * t)
        assert found.velocity.values[:, j] == pytest.approx(velocities, abs=1e-13)
        forces = 2 * n[1:] * jv(2 * n[1:], 2 * t) / t
        assert found.force.values[1:, j] == pytest.approx(forces, abs=1e-13)


def test_spring_row_has_no_solitary_wave():
    """Its front widens as n^(1/3) and keeps nearly all the energy: the height goes as n^(-1/6)."""
    forces = peak_forces(row("Spring", 1000))
    assert math.log(forces[899] / forces[299]) / math.log(3) == pytest.approx(-1 / 6, abs=1e-3)
