"""Hysteretic contacts (section V) against closed forms and the Taylor-series reference."""

import math

import numpy as np
import pytest

import stackbounce as sb
from drops import compared, drop_of
from reference import data

RESTITUTION = 1e-10
EVENT = 1e-12  # of the contact time
ROWS = data.read("hysteretic")
SPEED = (2 * 9.80665 * 0.2) ** 0.5

TIGHT = 1e-14  # of the tolerances a user can ask for


def quarter(power):
    """Return the integral of dx / sqrt(1 - x**(power + 1)) from 0 to 1."""
    s = 1.0 / (power + 1.0)
    return math.sqrt(math.pi) * math.exp(math.lgamma(1.0 + s) - math.lgamma(0.5 + s))


@pytest.mark.parametrize("e", [0.05, 0.3, 0.78, 0.9, 0.999, 1.0])
@pytest.mark.parametrize("exponent", [1.0, 1.25, 1.5, 2.0, 3.0])
def test_one_ball(e, exponent):
    law = sb.Hysteretic(5.6e4, exponent=exponent, restitution=e)
    result = sb.simulate(sb.Drop([sb.Ball(0.101)], [law], impact_speed=SPEED), rtol=TIGHT)
    assert abs(result.rebound_ratios[0] - e) <= RESTITUTION
    assert result.collisions.tolist() == [1]
    peak = ((exponent + 1.0) * 0.101 * SPEED**2 / (2.0 * 5.6e4)) ** (1.0 / (exponent + 1.0))
    unloading = (exponent + 1.0) / e**2 - 1.0
    lasts = peak / SPEED * (quarter(exponent) + quarter(unloading) / e)
    (interval,) = result.intervals
    assert interval["start"] == 0.0
    assert interval["end"] == pytest.approx(lasts, rel=2.0 * EVENT)
    assert interval["peak_compression"] == pytest.approx(peak, rel=RESTITUTION)
    assert interval["peak_force"] == pytest.approx(5.6e4 * peak**exponent, rel=RESTITUTION)
    assert interval["impulse"] == pytest.approx(0.101 * SPEED * (1.0 + e), rel=RESTITUTION)


@pytest.mark.parametrize("row", ROWS, ids=range(len(ROWS)))
def test_reference(row):
    result = sb.simulate(drop_of(row["case"]), rtol=TIGHT)
    assert result.status is sb.Status.FINISHED
    found, expected = compared(row, result, RESTITUTION)
    assert abs(result.energy_retained - row["energy_retained"]) <= RESTITUTION
    duration = expected[:, 2:3] - expected[:, 1:2]
    assert (np.abs(found[:, 1:3] - expected[:, 1:3]) <= EVENT * duration).all()
    assert (np.abs(found[:, 3:] - expected[:, 3:]) <= RESTITUTION * expected[:, 3:]).all()


def maxima(values):
    inner = values[1:-1]
    return int(np.sum((inner > values[:-2]) & (inner >= values[2:])))


def bundle_force(law, c):
    """Return the force at the last of the compressions c, from the history of each element."""
    back = c[::-1]
    parted, highest = np.minimum.accumulate(back), np.maximum.accumulate(back)
    carried = -law.stiffness * np.diff(parted**law.exponent, append=0.0)
    return np.sum(carried * (c[-1] / highest) ** (law.unloading_exponent - law.exponent))


@pytest.mark.slow
def test_several_cycles_in_one_interval_follow_the_rule():
    """An element touches and parts at its own compression, and remembers the highest since then."""
    seen = 0
    for row in ROWS[8:]:
        drop = drop_of(row["case"])
        result = sb.simulate(drop, rtol=TIGHT)
        sample = result.sample(np.linspace(0.0, result.end_time, 4001))
        for interval in result.intervals:
            law = drop.contacts[interval["contact"]]
            if isinstance(law, sb.Spring):
                continue
            at = (sample.time > interval["start"]) & (sample.time < interval["end"])
            c = sample.compression.sel(contact=interval["contact"], time=at).values
            force = sample.force.sel(contact=interval["contact"], time=at).values
            seen += maxima(c) > 1
            expected = [bundle_force(law, c[: k + 1]) for k in range(0, len(c), 12)]
            # between the samples the turning points lie further out
            near = pytest.approx(np.array(expected), abs=2e-4 * interval["peak_force"])
            assert force[::12] == near
            loading = law.stiffness * c**law.exponent
            assert (force <= loading + 1e-11 * interval["peak_force"]).all()
    assert seen >= 20


@pytest.mark.slow
def test_a_vibration_loses_energy_in_more_cycles_than_are_remembered():
    """The loss of a small cycle is as its third power, so that the amplitude falls as 1/t."""
    laws = [sb.Hysteretic(1.0, restitution=0.9), sb.Hysteretic(1000.0, restitution=0.9)]
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], laws, velocities=[-1.0, -1.0], gravity=1.0)
    result = sb.simulate(drop, until=2000.0)  # 225 cycles
    c = result.sample(np.linspace(480.0, 2000.0, 15_001)).compression.values[0]
    early, late = np.ptp(c[:200]), np.ptp(c[-200:])  # 20 s
    assert late / early == pytest.approx(490.0 / 1990.0, rel=0.05)


@pytest.mark.slow
def test_stacks_with_hysteresis_come_to_rest_where_their_curves_carry_them():
    """At rest each force is its weight, at about the compression of the last moment before."""
    random, seen = np.random.default_rng(8), 0
    for _ in range(8):
        size = int(random.integers(1, 4))
        laws = [
            sb.Hysteretic(10 ** random.uniform(3.0, 5.0), restitution=random.uniform(0.3, 0.95))
            for _ in range(size)
        ]
        balls = [sb.Ball(10 ** random.uniform(-2.0, 0.0)) for _ in range(size)]
        gaps = 10 ** random.uniform(-5.0, -2.0, size - 1)
        drop = sb.Drop(balls, laws, gaps.tolist(), impact_speed=1.0, gravity=9.81)
        result = sb.simulate(drop, until=1000.0)
        assert result.status is sb.Status.SETTLED
        weights = 9.81 * np.cumsum([ball.mass for ball in balls][::-1])[::-1]
        rest = result.sample([result.end_time * 0.999, 1000.0])
        assert rest.force.values[:, 1] == pytest.approx(weights)
        before, at_rest = rest.compression.values.T
        assert at_rest == pytest.approx(before, rel=0.2)
        seen += size > 1
    assert seen > 3
