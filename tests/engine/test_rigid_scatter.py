"""Restitutions that scatter from collision to collision: the draws, and how runs end."""

import numpy as np
import pytest
from scipy import stats

import stackbounce as sb
from reference import restitution

SEEDS = np.arange(4000.0)


def granite(seed=0.0, scatter=0.06):
    """Return the contact of granite spheres: 0.83 ± 0.06 at all speeds (Durda et al., 2011)."""
    return sb.RigidBySpeed(0.83, speed=1.0, speed_exponent=0.0, scatter=scatter, seed=seed)


def drawn(result):
    """Return the restitution of each collision on the floor, from the speeds of one ball."""
    after = result.events["upper_velocity"]
    before = np.concatenate([[result.drop.reference_speed], after[:-1]])
    return after / before


def bounces(law, count):
    """Return the result of so many bounces of one ball under gravity."""
    drop = sb.Drop([sb.Ball(1.3)], [law], impact_speed=1.0, gravity=9.81)
    return sb.simulate(drop, until=1e9, event_limit=count)


@pytest.mark.parametrize("seed", [0.0, 1.0, 7.25, 4294967295.0])
def test_each_draw_is_that_of_the_reference(seed):
    law = granite(seed, scatter=0.02)
    expected = [float(0.83 + 0.02 * restitution.normal(seed, 0, hit)) for hit in range(50)]
    assert max(expected) < 1.0
    assert drawn(bounces(law, 50)) == pytest.approx(expected, abs=1e-14)


def test_scatter_is_normal():
    found = sb.sweep(
        sb.Drop([sb.Ball(1.0)], [granite(scatter=0.03)], impact_speed=2.0),
        {"contacts.0.seed": SEEDS},
    ).rebound_ratio.values[:, 0]
    assert stats.kstest((found - 0.83) / 0.03, "norm").pvalue > 1e-3
    later = drawn(bounces(granite(5.0, scatter=0.03), 100))
    assert stats.kstest((later - 0.83) / 0.03, "norm").pvalue > 1e-3


def test_draws_of_neighbouring_seeds_contacts_and_collisions_are_independent():
    draws = np.array(
        [
            [[float(restitution.normal(s, i, k)) for k in range(6)] for i in range(3)]
            for s in range(200)
        ]
    )
    columns = draws.reshape(200, -1)
    correlation = np.corrcoef(columns.T) - np.eye(columns.shape[1])
    assert np.abs(correlation).max() < 5.0 / np.sqrt(200)
    assert abs(np.corrcoef(columns[:-1].ravel(), columns[1:].ravel())[0, 1]) < 5.0 / np.sqrt(3600)


def test_e_is_kept_from_0_to_1():
    law = sb.RigidBySpeed(0.9, speed=1.0, speed_exponent=0.0, scatter=1.0)
    found = sb.sweep(
        sb.Drop([sb.Ball(1.0)], [law], impact_speed=2.0), {"contacts.0.seed": SEEDS}
    ).rebound_ratio.values[:, 0]
    assert (found.min(), found.max()) == (0.0, 1.0)
    z = stats.norm
    assert np.mean(found == 0.0) == pytest.approx(z.cdf(-0.9), abs=0.03)
    assert np.mean(found == 1.0) == pytest.approx(z.sf(0.1), abs=0.03)


def stack(seed=0.0):
    """Return three balls under gravity whose contacts scatter."""
    law = sb.RigidLossBySpeed(0.8, 3.0, 0.2, scatter=0.05, seed=seed)
    balls = [sb.Ball(0.6), sb.Ball(0.06), sb.Ball(0.02)]
    return sb.Drop(balls, [law] * 3, [0.0, 0.001], height=0.5)


def test_the_same_in_plain_python_again_in_parts_and_in_a_sweep():
    seeds = [0.0, 3.0, 0.5, 1e9]
    number = ("run", seeds)
    swept = sb.sweep(stack(), {f"contacts.{i}.seed": number for i in range(3)})
    for row, seed in enumerate(seeds):
        one, other = (sb.simulate(stack(seed), compiled=way) for way in (False, True))
        assert one.log == other.log
        assert swept.rebound_ratio[row].values.tolist() == one.rebound_ratios.tolist()
        middle = 0.5 * one.end_time
        later = one.sample([middle, one.end_time + 1.0]).velocity.values[:, 1]
        assert later.tolist() == one.rebound_speeds.tolist()
        assert list(sb.simulate(stack(seed), until=middle).events) == [
            event for event in one.events if event["time"] <= middle
        ]


def test_a_drop_of_a_sweep_does_not_depend_on_the_others():
    """A grid that several threads work on, whole and in pieces."""
    mass = np.linspace(0.01, 0.1, 90)
    seed = np.arange(100.0)
    vary = {"balls.1.mass": mass, "contacts.0.seed": seed}
    whole = sb.sweep(stack(), vary).rebound_ratio.values
    for rows in (slice(0, 1), slice(37, 39), slice(89, 90)):
        part = sb.sweep(stack(), vary | {"balls.1.mass": mass[rows]}).rebound_ratio.values
        assert part.tolist() == whole[rows].tolist()


def test_one_ball_comes_to_rest():
    """On average each bounce is 0.83 times as long; far below, 0.4 times the scatter is lost."""
    for law in (granite(1.0), sb.RigidLossBySpeed(0.83, 1.0, 0.5, scatter=0.06, seed=2.0)):
        drop = sb.Drop([sb.Ball(1.0)], [law], height=1.0, gravity=9.81)
        result = sb.simulate(drop, until=1e3)
        assert result.status is sb.Status.SETTLED
        assert result.collisions.tolist() == [-1]
        flights = 2.0 / 9.81 * result.events["upper_velocity"]
        assert result.end_time == pytest.approx(flights.sum(), rel=1e-11)


@pytest.mark.parametrize("compiled", [False, True])
def test_a_collapse_with_scatter(compiled):
    """Two balls go on until their rates come close to underflow: then they lie still."""
    law = sb.RigidBySpeed(0.3, 1.0, 0.0, scatter=0.05)
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(20.0)], [law, law], impact_speed=1.0)
    result = sb.simulate(drop, compiled=compiled)
    assert result.status is sb.Status.COLLAPSED
    assert result.collisions.tolist() == [-1, -1]
    assert result.rebound_speeds.tolist() == [0.0, 0.0]
