"""Standard linear solids: closed forms, another integration, limits, energy, surfaces."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import exp, findroot, mp, mpf, polyroots

import stackbounce as sb
from drops import one_ball
from reference.relaxing import integrate

Solid = sb.StandardLinearSolid
STRENGTHS = (0.01, 1.0, 8.0, 30.0, 1000.0)
TIMES = (1e-4, 0.02, 0.2, 1.0, 100.0)


def collision(strength, time):
    """Return e and contact time of mass and stiffness 1, as the law has them."""
    law = Solid(1.0, strength, time)
    return law.restitution_at(1.0, 1.0), law.contact_time_at(1.0, 1.0)


def by_laplace(strength, time):
    """Return e and contact time of mass and stiffness 1, from the residues of the transform."""
    with mp.workdps(40):
        delta, tau = mpf(strength), mpf(time)
        ascending = [1, (1 + delta) * tau, 1, tau]
        roots = polyroots(ascending, maxsteps=500, extraprec=200, asc=True)
        residues = [1 / (3 * tau * x * x + 2 * x + (1 + delta) * tau) for x in roots]

        def force(t):
            terms = zip(roots, residues, strict=True)
            return sum(((1 + delta) * tau * x + 1) * a * exp(x * t) for x, a in terms).real

        def speed(t):
            terms = zip(roots, residues, strict=True)
            return sum(x * (tau * x + 1) * a * exp(x * t) for x, a in terms).real

        step = mp.pi / mp.sqrt(1 + delta) / 20
        t = step
        while force(t + step) > 0:
            t += step
        end = findroot(force, (t, t + step), solver="anderson", tol=1e-30)
        return float(-speed(end)), float(end)


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("strength", STRENGTHS)
def test_one_ball_in_closed_form(strength, time):
    kept, lasts = by_laplace(strength, time)
    assert collision(strength, time) == pytest.approx((kept, lasts), rel=1e-11, abs=1e-14)
    result = one_ball(Solid(1.0, strength, time))
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [1]
    assert result.rebound_ratios[0] == pytest.approx(kept, rel=1e-10, abs=1e-12)
    assert result.last_release[0] == pytest.approx(lasts, rel=1e-10)


@pytest.mark.parametrize("off", [0.0, 1e-12, -1e-9, 1e-6])
def test_three_equal_exponents(off):
    """At Δ = 8 they can meet, and the closed form would divide by their distance."""
    time = (1.0 + off) / 27.0**0.5
    assert collision(8.0, time) == pytest.approx(by_laplace(8.0, time), rel=1e-10)


@given(st.floats(-6.0, 3.0), st.floats(-5.0, 5.0))
def test_every_ball_leaves_and_loses_energy(strength, time):
    kept, lasts = collision(10.0**strength, 10.0**time)
    assert 0.0 < kept <= 1.0
    stiff = np.pi / np.sqrt(1.0 + 10.0**strength)
    assert lasts >= stiff * (1.0 - 1e-12)


def test_limits_of_the_relaxation_time():
    """A short one leaves the soft spring, a long one the stiff one; the loss peaks between."""
    strength, times = 3.0, np.geomspace(1e-5, 1e7, 49)
    kept, lasts = np.transpose([collision(strength, time) for time in times])
    lag = strength * times[0]  # to first order
    assert (kept[0], lasts[0]) == pytest.approx((1.0 - np.pi / 2.0 * lag, np.pi - lag), abs=2e-8)
    assert kept[-1] == pytest.approx(1.0, abs=2e-6)
    assert lasts[-1] == pytest.approx(0.5 * np.pi, rel=1e-6)
    least = int(np.argmin(kept))
    assert kept[least] < 0.5
    assert (np.diff(kept[: least + 1]) < 0.0).all()
    assert (np.diff(kept[least:]) > 0.0).all()


def test_the_ball_leaves_still_compressed():
    result = one_ball(Solid(1.0, 1.0, 0.5))
    end = result.last_release[0]
    sample = result.sample(end * np.array([1.0 - 1e-9, 1.0, 1.001]))
    left = float(sample.compression.sel(contact=0)[1])
    assert left > 0.2 * result.intervals["peak_compression"][0]
    force = sample.force.values[0]
    assert 1e-10 < force[0] < 1e-8
    assert force[1] == pytest.approx(0.0, abs=1e-15)
    assert force[2] == 0.0


STACKS = {  # of contacts that meet again before they have recovered, and others
    "small on large": ([1.0, 0.3], [(1.0, 1.0, 0.5), (2.0, 0.7, 0.3)], [0.2]),
    "large on small": ([0.1, 1.0], [(1.0, 3.0, 3.0), (2.0, 0.7, 2.3)], [0.05]),
    "larger on smaller": ([0.02, 1.0], [(1.0, 3.0, 10.0), (2.0, 2.0, 5.0)], [0.01]),
    "soft on hard": ([0.5, 0.4], [(9.0, 0.5, 0.1), (0.5, 4.0, 0.8)], [0.0]),
    "three": ([0.1, 0.5, 1.0], [(1.0, 3.0, 3.0), (2.0, 0.7, 2.3), (5.0, 2.0, 1.0)], [0.05, 0.3]),
    "three, slow surfaces": (
        [0.02, 1.0, 0.5],
        [(1.0, 3.0, 10.0), (2.0, 2.0, 5.0), (20.0, 2.0, 0.5)],
        [0.001, 0.1],
    ),
}


def drop_of(name, gravity=0.0):
    masses, laws, gaps = STACKS[name]
    solids = [Solid(*numbers) for numbers in laws]
    balls = [sb.Ball(mass) for mass in masses]
    return sb.Drop(balls, solids, gaps, impact_speed=1.0, gravity=gravity)


@pytest.mark.parametrize("name", STACKS)
def test_stacks_by_another_method(name):
    drop = drop_of(name)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    story = integrate(drop, result.end_time * (1.0 + 1e-6))
    assert result.rebound_speeds == pytest.approx(story.velocities, abs=2e-11)
    found = sorted(result.intervals[["contact", "start", "end"]].tolist())
    assert np.array(found) == pytest.approx(np.array(sorted(story.intervals)), abs=1e-10)
    assert min(story.leaving) > 0.0


@pytest.mark.parametrize("name", ["large on small", "three"])
def test_bounces_under_gravity_by_another_method(name):
    drop = drop_of(name, gravity=0.05)
    result = sb.simulate(drop, until=40.0)
    story = integrate(drop, 40.0)
    assert result.rebound_speeds == pytest.approx(story.velocities, abs=1e-9)
    assert len(result.intervals[result.intervals["end"] < 40.0]) == len(story.intervals) > 5


@pytest.mark.parametrize("name", ["large on small", "three, slow surfaces"])
def test_energy_lost_is_the_work_of_the_dashpots(name):
    """The energy of balls and springs, also in surfaces, falls by just that work."""
    drop = drop_of(name)
    result = sb.simulate(drop)
    before = float(result.sample([0.0]).energy[0])
    for part in (0.5, 1.2):
        time = part * result.end_time
        story = integrate(drop, time)
        energy = float(result.sample([time]).energy[0])
        assert before - energy == pytest.approx(story.lost, rel=1e-9)
    fall = result.sample(np.linspace(0.0, 2.0 * result.end_time, 400)).energy.values
    assert (np.diff(fall) <= 1e-13).all()


def test_a_balls_energy_after_all_is_kinetic():
    result = one_ball(Solid(1.0, 1.0, 0.5))
    late = float(result.sample([60.0]).energy[0])
    assert late == pytest.approx(0.5 * result.rebound_speeds[0] ** 2, rel=1e-12)
    soon = float(result.sample(result.last_release).energy[0])
    assert soon > 1.001 * late  # the surface still holds some


def test_a_stack_comes_to_rest():
    solids = [Solid(2e4, 0.6, 2e-3), Solid(3e4, 0.4, 1e-3)]
    drop = sb.Drop([sb.Ball(0.1), sb.Ball(0.05)], solids, height=0.2, gravity=9.81)
    result = sb.simulate(drop, until=600.0)
    assert result.status is sb.Status.SETTLED
    assert result.rebound_speeds.tolist() == [0.0, 0.0]
    weight = result.sample([600.0])
    assert weight.force.values[:, 0] == pytest.approx([0.15 * 9.81, 0.05 * 9.81])
    assert weight.compression.values[:, 0] == pytest.approx([0.15 * 9.81 / 2e4, 0.05 * 9.81 / 3e4])


def test_a_stack_with_other_laws_by_limits():
    """Beside a Hertz contact, whose series is one in the root of time, too."""
    balls = [sb.Ball(0.1), sb.Ball(0.05)]

    def ratios(law, hertz=3e6, gap=1e-4, **options):
        drop = sb.Drop(balls, [law, sb.Hertz(hertz)], [gap], impact_speed=1.0)
        return sb.simulate(drop, **options).rebound_ratios

    exact = ratios(Solid(2e4, 0.5, 1e-3), rtol=1e-14)
    assert ratios(Solid(2e4, 0.5, 1e-3), rtol=1e-8) == pytest.approx(exact, abs=1e-7)
    soft = Solid(2e4, 0.5, 1e-6), 1e-8, 0.0  # a touch without a speed is noticed late
    assert ratios(*soft, rtol=1e-8) == pytest.approx(ratios(*soft, rtol=1e-13), abs=1e-7)
    assert ratios(Solid(2e4, 0.5, 1e3)) == pytest.approx(ratios(sb.Spring(3e4)), abs=1e-5)
    assert ratios(Solid(2e4, 0.5, 1e-9)) == pytest.approx(ratios(sb.Spring(2e4)), abs=1e-5)


@pytest.mark.parametrize("strength", [1e-300, 1e-100, 1e-30, 1e-8])
def test_a_faint_relaxation_is_followed_too(strength):
    """Steps must be short against its time, though no velocity shows it."""
    balls = [sb.Ball(1.0), sb.Ball(0.4)]

    def run(law):
        drop = sb.Drop(balls, [law, law], [0.01], impact_speed=1.0, gravity=9.81)
        return sb.simulate(drop, until=12.0)

    found, spring = run(Solid(1.0, strength, 1e-3)), run(sb.Spring(1.0))
    assert found.rebound_speeds == pytest.approx(spring.rebound_speeds, rel=1e-8)
    assert found.collisions.tolist() == spring.collisions.tolist()
