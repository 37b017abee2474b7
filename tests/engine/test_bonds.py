"""Bonds: bodies that vibrate, floors of finite mass, and when bodies have parted for good."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import stackbounce as sb
from stackbounce import errors


def followed(masses, contacts, velocities, gravity, until):
    """Return times and states (T, 2N) of springs and bonds, by SciPy, until a time."""
    count = len(masses)
    bonded = np.array([isinstance(law, sb.Bond) for law in contacts])
    k = np.array([law.stiffness for law in contacts])
    b = np.array([law.damping if isinstance(law, sb.Bond) else 0.0 for law in contacts])

    def force(y):
        x, v = y[:count], y[count:]
        c = np.append(0.0, x[:-1]) - x
        rate = np.append(0.0, v[:-1]) - v
        f = k * c + b * rate
        return np.where(bonded, f, np.where(c > 0.0, k * c, 0.0))

    def slope(_, y):
        f = force(y)
        return np.concatenate([y[count:], (f - np.append(f[1:], 0.0)) / masses - gravity])

    rest = np.zeros(count)
    if gravity and bonded[0]:  # the body on the floor carries its own weight
        own = int(np.argmin(np.append(bonded, False)))
        weights = np.cumsum(np.array(masses)[:own][::-1])[::-1] * gravity
        rest[:own] = -np.cumsum(weights / k[:own])
        rest[own:] = rest[own - 1]
    start = np.concatenate([rest, velocities])
    return solve_ivp(slope, (0.0, until), start, "DOP853", rtol=1e-12, atol=1e-14, max_step=1e-3,
                     dense_output=True)  # fmt: skip


def of_centres(masses, contacts, velocities):
    """Return the velocity of the centre of each ball's body: 0 if it is bonded to the floor."""
    bodies = np.cumsum([not isinstance(law, sb.Bond) for law in contacts])
    sums = [np.bincount(bodies, np.multiply(masses, v)) for v in (velocities, np.ones(len(masses)))]
    with np.errstate(invalid="ignore"):  # without a body on the floor there is no body 0
        return np.where(bodies > 0, (sums[0] / sums[1])[bodies], 0.0)


STACKS = {
    "two halves": ([0.5, 0.7], [sb.Spring(300.0), sb.Bond(900.0)], None, 0.0),
    "damped halves": ([0.5, 0.7], [sb.Spring(300.0), sb.Bond(900.0, 3.0)], None, 0.0),
    "overdamped halves": ([0.5, 0.7], [sb.Spring(300.0), sb.Bond(900.0, 200.0)], None, 0.0),
    "three parts": ([0.3, 0.4, 0.5], [sb.Spring(200.0), sb.Bond(1e3), sb.Bond(500.0)], None, 0.0),
    "a ball on halves": (
        [0.5, 0.5, 0.1], [sb.Spring(300.0), sb.Bond(2e3, 1.0), sb.Spring(100.0)], None, 0.0,
    ),
    "two such balls": (
        [0.4, 0.2, 0.1, 0.3],
        [sb.Spring(300.0), sb.Bond(2e3), sb.Spring(400.0), sb.Bond(800.0)], None, 0.0,
    ),
    "a plate": ([5.0, 0.2], [sb.Bond(4e3, 2.0), sb.Spring(300.0)], [0.0, -1.0], 0.0),
    "a heavy ball on a plate with gravity": (
        [1.0, 2.0], [sb.Bond(4e3, 2.0), sb.Spring(900.0)], [0.0, -1.0], 9.81,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", STACKS)
def test_against_another_integration(name):
    """Also while bodies touch; the rebound speeds are those of the bodies' centres at any end."""
    masses, laws, velocities, gravity = STACKS[name]
    start = {"impact_speed": 1.0} if velocities is None else {"velocities": velocities}
    drop = sb.Drop([sb.Ball(m) for m in masses], laws, gravity=gravity, **start)
    result = sb.simulate(drop, until=0.6)
    run = followed(masses, laws, drop.start_velocities, gravity, 0.6)
    times = np.linspace(0.0, 0.6, 31)
    states = run.sol(times)
    for until, moved in zip(times[1::5], states[len(masses) :, 1::5].T, strict=True):
        speeds = sb.simulate(drop, until=until).rebound_speeds
        assert speeds == pytest.approx(of_centres(masses, laws, moved), abs=3e-9)
    sampled = result.sample(times)
    assert sampled.position.values == pytest.approx(states[: len(masses)], abs=3e-9)
    assert sampled.velocity.values == pytest.approx(states[len(masses) :], abs=3e-9)


@pytest.mark.parametrize("name", [name for name in STACKS if "gravity" not in name])
def test_a_run_ends_when_bodies_have_parted(name):
    """Their velocities are those of their centres, which a much later time confirms."""
    masses, laws, velocities, _ = STACKS[name]
    start = {"impact_speed": 1.0} if velocities is None else {"velocities": velocities}
    drop = sb.Drop([sb.Ball(m) for m in masses], laws, **start)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    later = sb.simulate(drop, until=30.0)
    assert later.collisions.tolist() == result.collisions.tolist()
    moved = later.sample([30.0]).velocity.values[:, 0]
    assert later.rebound_speeds == pytest.approx(of_centres(masses, laws, moved), abs=1e-11)
    assert later.rebound_speeds == pytest.approx(result.rebound_speeds, abs=1e-11)
    assert result.collisions[[isinstance(law, sb.Bond) for law in laws]].max() == 0


def test_a_stiff_bond_is_none_and_a_soft_one_hides_the_upper_half():
    whole = sb.simulate(sb.Drop([sb.Ball(1.0)], [sb.Spring(100.0)], impact_speed=1.0))
    halves = [sb.Ball(0.5), sb.Ball(0.5)]
    stiff = sb.simulate(sb.Drop(halves, [sb.Spring(100.0), sb.Bond(1e9)], impact_speed=1.0))
    assert stiff.rebound_ratios == pytest.approx([1.0, 1.0], abs=1e-3)
    assert stiff.last_release[0] == pytest.approx(whole.last_release[0], rel=1e-3)
    result = sb.simulate(sb.Drop(halves, [sb.Spring(100.0), sb.Bond(1e-4)], impact_speed=1.0))
    assert result.intervals["end"][0] == pytest.approx(math.pi * (0.5 / 100.0) ** 0.5, rel=1e-4)


def test_samples_beyond_what_can_be_followed_are_refused():
    drop = sb.Drop([sb.Ball(0.1), sb.Ball(0.05)], [sb.Spring(4e4), sb.Bond(1e4)], impact_speed=2.0)
    result = sb.simulate(drop, event_limit=1000)
    assert result.sample([0.1]).energy.values == pytest.approx([0.3], rel=1e-9)
    with pytest.raises(errors.InvalidValue, match=r"times must be seconds up to .*, got 10000"):
        result.sample([1e4])


def test_a_ball_rests_on_a_plate():
    laws = [sb.Bond(4e3, 40.0), sb.Dashpot(900.0, damping=9.0)]
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(2.0)], laws, velocities=[0.0, -0.3], gravity=9.81)
    result = sb.simulate(drop)
    assert result.status is sb.Status.SETTLED
    still = result.sample([result.end_time + 1.0])
    assert still.force.values[:, 0] == pytest.approx([3.0 * 9.81, 2.0 * 9.81], rel=1e-6)
    assert result.collisions.tolist() == [0, 1]


def test_a_plate_under_its_own_weight_is_still():
    drop = sb.Drop(
        [sb.Ball(2.0), sb.Ball(0.1)],
        [sb.Bond(1e3), sb.Spring(100.0)],
        velocities=[0.0, -1.0],
        gaps=[0.5],
        gravity=9.81,
    )
    before = sb.simulate(drop, until=0.1).sample([0.0, 0.05, 0.1])
    assert before.force.values[0] == pytest.approx(2.0 * 9.81, rel=1e-12)
    assert np.abs(before.velocity.values[0]).max() < 1e-12
    assert set(sb.simulate(drop, until=3.0).apexes["ball"].tolist()) == {1}


def test_a_body_has_the_highest_point_of_its_centre():
    laws = [sb.Spring(300.0), sb.Bond(900.0)]
    drop = sb.Drop([sb.Ball(0.5), sb.Ball(0.7)], laws, height=1.0, gravity=9.81)
    result = sb.simulate(drop, until=1.0)
    times = np.linspace(0.0, 1.0, 20_001)
    centre = np.average(result.sample(times).position.values, axis=0, weights=[0.5, 0.7])
    assert result.apexes["ball"].tolist() == [0, 1]
    assert result.apexes["height"] == pytest.approx(centre.max(), rel=1e-7)
    assert result.apexes["time"] == pytest.approx(times[centre.argmax()], abs=5e-5)


@pytest.mark.parametrize("until", [None, 0.1, 1.0])
def test_sweeps_and_predictions_have_the_same_numbers(until):
    drop = sb.Drop([sb.Ball(0.5), sb.Ball(0.7)], [sb.Spring(300.0), sb.Bond(900.0)], impact_speed=1)
    swept = sb.sweep(drop, {"contacts.1.stiffness": [90.0, 900.0]}, until=until)
    ratios = sb.simulate(drop, until=until).rebound_ratios.tolist()
    assert swept.rebound_ratio.values[1].tolist() == ratios
    found = sb.predict(drop, {"contacts.0.stiffness": "300 ± 1 N/m"}, until=until)
    assert [ratio.n for ratio in found.rebound_ratios] == pytest.approx(ratios)
    assert swept.rebound_ratio.values[0, 0] != swept.rebound_ratio.values[1, 0]


def test_a_bond_has_no_gap_and_no_collision():
    balls = [sb.Ball(1.0), sb.Ball(1.0)]
    laws = [sb.Spring(1.0), sb.Bond(1.0)]
    with pytest.raises(errors.InvalidValue, match=r"^gaps.0 must be 0 at a Bond, got 0.1$"):
        sb.Drop(balls, laws, gaps=[0.1], impact_speed=1.0)
    for measure in (sb.restitution, sb.contact_time):
        with pytest.raises(errors.InvalidValue, match="got Bond, which never opens"):
            measure(sb.Bond(1.0), 1.0, 1.0)
    with pytest.raises(errors.InvalidValue, match="that open: contact 1 is a Bond"):
        sb.simulate(sb.Drop(balls, laws, impact_speed=1.0)).sideways()
    with pytest.raises(errors.InvalidValue, match="got Bond, which never opens"):
        sb.separate(sb.Drop(balls, laws, impact_speed=1.0))


def test_bonds_in_series_have_one_damping_over_stiffness():
    both = sb.series(sb.Bond(1e4, 2.0), sb.Bond(2e4, 4.0))
    assert (both.stiffness, both.damping) == pytest.approx((2e4 / 3.0, 4.0 / 3.0))
    with pytest.raises(errors.InvalidValue, match="same damping/stiffness"):
        sb.series(sb.Bond(1e4, 2.0), sb.Bond(2e4, 3.0))
