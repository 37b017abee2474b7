"""Curves of pieces, of hollow balls and tables: closed forms, another integration, limits."""

import math

import numpy as np
import pytest

import stackbounce as sb
from drops import one_ball
from reference import pieces
from stackbounce.model.laws.tabulated import monotone_spline

CLOSE = 1e-9
TABLE = [0.0, 0.01, 0.03, 0.06, 0.1], [0.0, 0.5, 2.5, 4.0, 9.0], [0.0, 0.0, 0.7, 2.0, 9.0]


def reference_of(law):
    """Return the reference of a law, whose loading curve has the law's own spline if a table."""
    if isinstance(law, sb.Hysteretic):
        p, n = law.exponent, law.unloading_exponent
        return pieces.Contact(lambda c: law.stiffness * c**p, [], lambda x, _: x ** (n - p))
    if isinstance(law, sb.HollowBall):
        k, knee, kept = law.stiffness, law.buckling_compression, law.restitution**2
        power = 2.0 / kept - 2.0

        def loading(c):
            return k * (min(c, knee) + law.stiffness_ratio * max(c - knee, 0.0))

        knots = [knee]
    else:
        spline = monotone_spline(law.compression, law.force)
        _, _, kept, _, power = law.engine_numbers()

        def loading(c):
            begin, a, b, s = next(piece for piece in reversed(spline) if piece[0] <= c)
            return a + (c - begin) * (b + (c - begin) * s)

        knots = [piece[0] for piece in spline[1:]]
        if law.unloading is not None:
            return pieces.Contact(loading, knots, *measured_share(law))
    if kept == 1.0:
        return pieces.Contact(loading, knots)
    return pieces.Contact(loading, knots, pieces.returned_share(loading, knots, power, kept))


def measured_share(law):
    """Return unloading over loading, straight between the points and on to 0, and its corners."""
    x = np.array(law.compression[1:]) / law.compression[-1]
    share = np.divide(law.unloading[1:], law.force[1:])
    share = np.minimum.accumulate(share[::-1])[::-1]
    foot = max(0.0, share[0] - (share[1] - share[0]) / (x[1] - x[0]) * x[0])
    return (lambda at, _: np.interp(at, [0.0, *x], [foot, *share])), x[:-1].tolist()


@pytest.mark.parametrize("e", [0.05, 0.3, 0.75, 0.999, 1.0])
@pytest.mark.parametrize("ratio", [0.01, 0.3, 1.0])
@pytest.mark.parametrize("speed", [0.1, 1.0, 10.0])
def test_a_hollow_ball_returns_its_share(e, ratio, speed):
    result = one_ball(sb.HollowBall(100.0, 0.05, ratio, e), speed)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [1]
    assert result.rebound_ratios[0] == pytest.approx(e, rel=1e-11)


@pytest.mark.parametrize("ratio", [0.01, 0.3, 0.9])
@pytest.mark.parametrize("speed", [0.6, 1.0, 10.0])
def test_a_hollow_ball_without_loss_in_closed_form(ratio, speed):
    """Twice: a sine to the knee, then one about the point where the soft line has no force."""
    knee, omega = 0.05, 10.0
    first = math.asin(knee * omega / speed) / omega
    left = math.sqrt(speed**2 - (knee * omega) ** 2)
    slow = omega * math.sqrt(ratio)
    ahead = math.atan(left * ratio / (slow * knee)) / slow
    result = one_ball(sb.HollowBall(100.0, knee, ratio, 1.0), speed)
    assert result.last_release[0] == pytest.approx(2.0 * (first + ahead), rel=1e-12)
    (interval,) = result.intervals
    force = math.sqrt((100.0 * knee) ** 2 + ratio * 100.0 * left**2)
    assert interval["peak_force"] == pytest.approx(force, rel=1e-12)
    assert interval["peak_time"] == pytest.approx(first + ahead, rel=1e-7)
    assert interval["impulse"] == pytest.approx(2.0 * speed, rel=1e-12)


@pytest.mark.parametrize("speed", [0.05, 0.3, 0.8, 3.0])
@pytest.mark.parametrize("loss", ["none", "unloading", "restitution"])
def test_one_ball_on_a_table_against_quadrature(speed, loss):
    x, y, back = TABLE
    own = {"none": {}, "unloading": {"unloading": back}, "restitution": {"restitution": 0.6}}[loss]
    law = sb.Tabulated(x, y, **own)
    speeds, intervals = pieces.integrate([1.0], [reference_of(law)], [], [-speed])
    result = one_ball(law, speed)
    assert result.rebound_speeds == pytest.approx(speeds, abs=CLOSE * speed)
    assert result.last_release[0] == pytest.approx(intervals[0][0][1], rel=CLOSE)
    if loss == "restitution":
        assert result.rebound_ratios[0] == pytest.approx(0.6, rel=1e-11)
    assert law.restitution_at(1.0, speed) == pytest.approx(result.rebound_ratios[0], rel=1e-12)
    assert law.contact_time_at(1.0, speed) == pytest.approx(result.last_release[0], rel=1e-12)


def random_stack(seed):
    """Return a stack of two or three balls, the upper ones mostly heavier, on lossy contacts."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 4))
    laws = []
    for _ in range(count):
        k = 10.0 ** rng.uniform(1.0, 3.0)
        e = rng.uniform(0.3, 1.0)
        kind = rng.integers(5)
        if kind == 0:
            laws.append(sb.Hysteretic(k, exponent=rng.uniform(1.0, 2.0), restitution=e))
            continue
        if kind == 1:
            knee = 10.0 ** rng.uniform(-2.5, -1.0)
            laws.append(sb.HollowBall(k, knee, rng.uniform(0.05, 1.0), e))
            continue
        points = int(rng.integers(3, 6))
        x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.2, 1.0, points))]) * 0.1
        y = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 1.0, points))]) * 0.1 * k
        back = y * np.append(rng.uniform(0.2, 1.0, points), 1.0)
        own = [{}, {"unloading": np.maximum.accumulate(back)}, {"restitution": e}][kind - 2]
        laws.append(sb.Tabulated(x, y, **own))
    gaps = rng.choice([0.0, 0.01, 0.2], count - 1)
    masses = np.cumprod(rng.uniform(0.5, 5.0, count))
    return sb.Drop([sb.Ball(m) for m in masses], laws, gaps, impact_speed=1.0)


@pytest.mark.parametrize(("first", "count"), [(4, 2), pytest.param(8, 8, marks=pytest.mark.slow)])
def test_stacks_against_another_integration(first, count):
    """Contacts are compressed again before they open, in cycles inside one another."""
    cycles = dict.fromkeys((sb.Hysteretic, sb.HollowBall, sb.Tabulated), 0)
    for seed in range(first, first + count):
        drop = random_stack(seed)
        contacts = [reference_of(law) for law in drop.contacts]
        masses = [ball.mass for ball in drop.balls]
        speeds, intervals = pieces.integrate(masses, contacts, drop.gaps, drop.start_velocities)
        result = sb.simulate(drop)
        assert result.status is sb.Status.FINISHED
        assert result.collisions.tolist() == [len(pairs) for pairs in intervals]
        assert result.rebound_speeds == pytest.approx(speeds, abs=1e-9)
        for found, ends in zip(result.last_release, intervals, strict=True):
            assert not ends or found == pytest.approx(ends[-1][1], rel=1e-7)
        energy = result.sample(np.linspace(0.0, 1.1 * result.end_time, 400)).energy.values
        assert np.diff(energy).max() <= 1e-11 * energy[0]
        assert energy[-1] == pytest.approx(result.energy_retained * energy[0], rel=1e-11)
        for law, contact in zip(drop.contacts, contacts, strict=True):
            cycles[type(law)] += contact.cycles
    assert min(cycles.values()) >= count


STEP = sb.Tabulated(
    [0.0, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3],
    [0.0, 20.0, 32.0, 40.0, 50.0, 62.0, 80.0],
    [0.0, 15.0, 26.0, 34.0, 44.0, 57.0, 80.0],
)
TABLES = [
    STEP,
    sb.Tabulated([0.0, 1e-3, 2e-3, 3e-3, 4e-3], [0.0, 30, 36, 45, 120], [0.0, 25, 30, 38, 120]),
    sb.Tabulated([0.0, 1e-3, 2e-3, 3e-3], [0.0, 76.0, 96.0, 99.5], [0.0, 40.0, 90.0, 99.5]),
    sb.Tabulated([0.0, 1e-3, 2e-3], [0.0, 100.0, 101.0], [0.0, 99.0, 101.0]),
    sb.Tabulated(*TABLE),
]


@pytest.mark.parametrize("speed", [1e-3, 0.5, 1.0, 3.0, 30.0])
@pytest.mark.parametrize("law", TABLES)
def test_a_table_never_returns_more_than_it_took(law, speed):
    result = one_ball(law, speed, 0.1)
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios[0] <= 1.0
    sample = result.sample(np.linspace(0.0, result.end_time, 1000))
    energy, force = sample.energy.values, sample.force.values[0]
    assert np.diff(energy).max() <= 1e-11 * energy[0]
    loading = [reference_of(law).loading(max(c, 0.0)) for c in sample.compression.values[0]]
    assert (force <= np.array(loading) + 1e-11 * force.max()).all()


@pytest.mark.parametrize("law", TABLES)
def test_a_table_unloads_through_its_points_from_the_last_one(law):
    contact = reference_of(law)
    work = pieces.work(contact.loading, contact.knots, law.compression[-1])
    result = one_ball(law, math.sqrt(2.0 * work / 0.1), 0.1)
    (interval,) = result.intervals
    assert interval["peak_compression"] == pytest.approx(law.compression[-1], rel=1e-9)
    back = result.sample(np.linspace(interval["peak_time"], interval["end"], 4000))
    c, force = back.compression.values[0], back.force.values[0]
    share = np.divide(law.unloading[1:], law.force[1:])
    assert (np.diff(share) >= 0.0).all()  # else it is made to rise
    found = np.interp(law.compression, c[::-1], force[::-1])
    assert found == pytest.approx(np.array(law.unloading), abs=1e-4 * law.force[-1])


def test_a_table_has_a_restitution_without_steps():
    """It jumped from 0.981 to 0.938 in the middle of these speeds."""
    restitutions = [STEP.restitution_at(0.057, v) for v in np.linspace(3.5564, 3.5574, 11)]
    assert np.ptp(restitutions) < 1e-4


@pytest.mark.parametrize("width", [1.5e-3, 1e-2, 0.1])
def test_a_steep_table_without_loss_keeps_its_energy(width):
    law = sb.Tabulated([0.0, 1e-3, 1e-3 * (1.0 + width), 1.5e-3], [0.0, 30.0, 70.0, 71.0])
    result = one_ball(law, 1.2, 0.05)
    energy = result.sample(np.linspace(0.0, result.end_time, 500)).energy.values
    assert energy == pytest.approx(np.full(500, energy[0]), rel=1e-10)


@pytest.mark.parametrize("restitution", [0.6, 1.0])
def test_a_ball_comes_to_rest_or_is_stopped(restitution):
    law = sb.HollowBall(1e4, 1e-3, 0.3, restitution)
    result = sb.simulate(sb.Drop([sb.Ball(0.1)], [law], height=0.05, gravity=9.81), until=20.0)
    if restitution < 1.0:
        assert result.status in (sb.Status.SETTLED, sb.Status.TIME_REACHED)
        assert abs(result.rebound_speeds[0]) < 1e-3
    else:
        assert result.status is sb.Status.TIME_REACHED
        assert result.energy_retained <= 1.0 + 1e-9
