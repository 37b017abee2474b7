"""How far errors of a drop's numbers grow, against runs of drops whose numbers are off."""

from dataclasses import replace

import numpy as np
import pytest

import stackbounce as sb

ERROR = 1e-9


def random_drop(random):
    """Return a stack of two to four balls under gravity, and when to stop."""
    count = int(random.integers(2, 5))
    law = (
        sb.Rigid(0.8),
        sb.Spring(1e4),
        sb.Hertz(1e6),
        sb.HuntCrossley(1e6, 1.5, 0.2),
        sb.Hysteretic(2e4, restitution=0.8),
    )[int(random.integers(5))]
    balls = [sb.Ball(float(random.uniform(0.01, 0.3))) for _ in range(count)]
    gaps = random.uniform(0.0, 1e-2, count - 1).tolist()
    drop = sb.Drop(balls, [law] * count, gaps=gaps, impact_speed=2.4, gravity=9.81)
    return drop, float(random.uniform(0.02, 0.8))


def off(drop, random):
    """Return a drop whose numbers have relative errors."""

    def wrong(value):
        return value * (1.0 + ERROR * random.standard_normal())

    def wrong_law(law):
        if isinstance(law, sb.Rigid):
            return law
        return law.replaced({"stiffness": wrong(law.stiffness)})

    return replace(
        drop,
        balls=[replace(ball, mass=wrong(ball.mass)) for ball in drop.balls],
        contacts=[wrong_law(law) for law in drop.contacts],
        gaps=[wrong(gap) for gap in drop.gaps],
        impact_speed=wrong(drop.impact_speed),
        gravity=wrong(drop.gravity),
    )


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(("first", "last"), [(0, 10), (10, 40)])
def test_conditioning_is_the_spread_of_runs_with_errors(first, last):
    compared = 0
    for seed in range(first, last):
        random = np.random.default_rng(seed)
        drop, until = random_drop(random)
        result = sb.simulate(drop, until=until)
        speeds = [sb.simulate(off(drop, random), until=until).rebound_speeds for _ in range(40)]
        spread = np.std(speeds, axis=0) / drop.reference_speed / ERROR
        known = (spread > 1e-6) & (spread * ERROR < 1e-3) & (result.conditioning * 1e-10 < 1e-3)
        ratio = result.conditioning[known] / spread[known]
        assert (ratio > 1.0 / 3.0).all()
        assert (ratio < 3.0).all()
        compared += int(known.sum())
    assert compared > 2 * (last - first)


def test_chaos_is_told():
    law = sb.HuntCrossley(1e6, 1.5, 0.2)
    balls = [sb.Ball(0.1), sb.Ball(0.05), sb.Ball(0.02)]
    drop = sb.Drop(balls, [law] * 3, gaps=[0.0, 1e-3], height=0.3, gravity=9.81)
    rough, fine = (sb.simulate(drop, until=2.97, rtol=rtol) for rtol in (1e-12, 1e-14))
    assert np.abs(rough.rebound_speeds - fine.rebound_speeds).max() > 0.01
    assert rough.conditioning.max() > 1e11
    assert 2.0 < rough.known_until < fine.known_until
    early = [sb.simulate(drop, until=1.8, rtol=rtol).rebound_speeds for rtol in (1e-12, 1e-14)]
    assert early[0] == pytest.approx(early[1], abs=1e-4)


@pytest.mark.parametrize("speed", [1e-300, 1e300, 1.7e308])
def test_speeds_at_the_ends_of_the_range(speed):
    balls = [sb.Ball(0.6), sb.Ball(0.06)]
    result = sb.simulate(sb.Drop(balls, [sb.Rigid(1.0)] * 2, impact_speed=speed))
    assert (result.conditioning >= 0.0).all()
    assert result.known_until >= 0.0


def test_a_run_without_speeds_knows_none():
    result = sb.simulate(sb.Drop([sb.Ball(1e300)], [sb.Spring(1e-300)], impact_speed=1.0))
    assert result.known_until == 0.0
    assert np.isinf(result.conditioning).all()
