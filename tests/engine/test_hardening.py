"""A force k c^p (1 + (c/a)^2), which no law of the package has, against other methods."""

import dataclasses
from typing import ClassVar

import numpy as np
import pytest
from mpmath import mp, mpf
from scipy.integrate import solve_ivp

import stackbounce as sb
from hardening import Hardening

MASS, SPEED = 0.1, 2.0


@dataclasses.dataclass(frozen=True)
class HardSphere(Hardening):
    """Spheres that harden, so that the force has no power series where it begins."""

    exponent: ClassVar[float] = 1.5


@dataclasses.dataclass(frozen=True)
class Steep(Hardening):
    """A power that has no series in the root of time either."""

    exponent: ClassVar[float] = 1.3


LAWS = {
    "soft": Hardening(1e4, 0.1),
    "even": Hardening(1e4, 2e-3),
    "hard": Hardening(1e4, 1e-5),
    "sphere": HardSphere(3e5, 2e-3),
    "steep": Steep(1e5, 1e-3),
}


def force(law, c):
    return law.stiffness * c**law.exponent * (1 + (c / law.length) ** 2) if c > 0 else 0.0


def exact_contact(law):
    """Return the peak compression and the contact time, 2 ∫ dc / sqrt(v^2 - 2 U(c)/m)."""
    with mp.workdps(40):
        p, k, a, mass, speed = map(mpf, (law.exponent, law.stiffness, law.length, MASS, SPEED))

        def left(c):
            return speed**2 - 2 * k / mass * c ** (p + 1) * (1 / (p + 1) + (c / a) ** 2 / (p + 3))

        low, peak = mpf(0), (mass * speed**2 * (p + 1) / (2 * k)) ** (1 / (p + 1))
        while peak - low > mpf(10) ** -38 * peak:
            middle = (low + peak) / 2
            low, peak = (middle, peak) if left(middle) > 0 else (low, middle)
        peak = low
        return float(peak), float(2 * mp.quad(lambda c: 1 / mp.sqrt(left(c)), [0, peak]))


def drop_of(law, **more):
    return sb.Drop([sb.Ball(MASS)], [law], impact_speed=SPEED, **more)


def pair_of(law, gap=0.0, **more):
    return sb.Drop([sb.Ball(MASS), sb.Ball(0.03)], [law, law], [gap], impact_speed=SPEED, **more)


@pytest.mark.parametrize("name", LAWS)
def test_one_ball_agrees_with_a_quadrature(name):
    law = LAWS[name]
    peak, lasts = exact_contact(law)
    result = sb.simulate(drop_of(law), rtol=1e-13)
    (interval,) = result.intervals
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios[0] == pytest.approx(1.0, abs=1e-11)
    assert interval["end"] == pytest.approx(lasts, rel=1e-9)
    assert interval["peak_compression"] == pytest.approx(peak, rel=1e-9)
    assert interval["peak_force"] == pytest.approx(force(law, peak), rel=1e-9)
    assert interval["impulse"] == pytest.approx(2.0 * MASS * SPEED, rel=1e-11)


@pytest.mark.parametrize("name", LAWS)
def test_energy_is_conserved(name):
    for drop in (drop_of(LAWS[name]), pair_of(LAWS[name]), pair_of(LAWS[name], gap=1e-3)):
        result = sb.simulate(drop, rtol=1e-13)
        energy = result.sample(np.linspace(0.0, result.end_time, 200)).energy.values
        assert energy == pytest.approx(np.full(200, energy[0]), rel=1e-11)
        assert result.energy_retained == pytest.approx(1.0, abs=1e-11)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("name", LAWS)
def test_two_balls_agree_with_an_adaptive_method(name):
    law, masses = LAWS[name], np.array([MASS, 0.03])
    result = sb.simulate(pair_of(law), rtol=1e-13)

    def rates(_, state):
        floor, between = force(law, -state[0]), force(law, state[0] - state[1])
        return [*state[2:], (floor - between) / masses[0], between / masses[1]]

    end = 1.01 * result.end_time
    start = [0.0, 0.0, -SPEED, -SPEED]
    found = solve_ivp(
        rates, (0, end), start, method="DOP853", rtol=1e-12, atol=1e-15, max_step=end / 2000
    )
    assert result.rebound_speeds == pytest.approx(found.y[2:, -1], abs=1e-8 * SPEED)


@pytest.mark.parametrize("name", LAWS)
def test_plain_and_compiled_runs_have_the_same_bits(name):
    for drop in (pair_of(LAWS[name]), pair_of(LAWS[name], gap=1e-3, gravity=9.81)):
        plain, compiled = (sb.simulate(drop, compiled=way) for way in (False, True))
        assert plain.rebound_speeds.tobytes() == compiled.rebound_speeds.tobytes()
        assert plain.intervals.tobytes() == compiled.intervals.tobytes()


@pytest.mark.parametrize("name", LAWS)
def test_a_stack_at_rest_carries_its_weight(name):
    law, weights = LAWS[name], 9.81 * np.array([MASS + 0.03, 0.03])
    balls = [sb.Ball(MASS), sb.Ball(0.03)]
    drop = sb.Drop(balls, [law, sb.Dashpot(1e3, 5.0)], impact_speed=1e-3, gravity=9.81)
    result = sb.simulate(drop, compiled=False)
    assert result.status is sb.Status.SETTLED
    rest = result.sample([2.0 * result.end_time])
    assert rest.force.values[:, 0] == pytest.approx(weights, rel=1e-12)
    assert force(law, rest.compression.values[0, 0]) == pytest.approx(weights[0], rel=1e-12)


def test_a_length_that_is_never_reached_is_a_spring():
    hard = sb.simulate(pair_of(Hardening(1e4, 1e6)), rtol=1e-13)
    soft = sb.simulate(pair_of(sb.Spring(1e4)), rtol=1e-13)
    assert hard.rebound_speeds == pytest.approx(soft.rebound_speeds, abs=1e-12 * SPEED)
    assert hard.last_release == pytest.approx(soft.last_release, rel=1e-11)
