"""The laws of rigid collisions by speed: numbers, restitutions, calibration, files and sweeps."""

import pytest

import stackbounce as sb
from stackbounce import errors
from stackbounce.model.laws import usual_laws

KINDS = [sb.RigidBySpeed, sb.RigidLossBySpeed]


def test_published_restitutions():
    """Ice (Bridges et al. 1984), and spheres that yield above 0.2 m/s."""
    ice = sb.RigidBySpeed(0.32, speed=0.01, speed_exponent=0.234)
    for speed in (0.002, 0.015, 0.05):
        kept = 0.32 * (speed / 0.01) ** -0.234
        assert sb.restitution(ice, impact_speed=speed) == pytest.approx(kept, rel=1e-14)
        drop = sb.Drop([sb.Ball(0.2)], [ice], impact_speed=speed)
        assert sb.simulate(drop).rebound_ratios[0] == pytest.approx(kept, rel=1e-14)
    steel = sb.RigidBySpeed(1.0, speed=0.2)
    assert [sb.restitution(steel, impact_speed=v) for v in (0.1, 0.2)] == [1.0, 1.0]
    assert sb.restitution(steel, impact_speed=3.2) == pytest.approx(0.5, rel=1e-14)


def test_a_loss_that_grows_with_the_speed():
    law = sb.RigidLossBySpeed(0.8, speed=3.0, speed_exponent=0.43)
    for speed in (0.1, 3.0, 10.0):
        kept = 1.0 - 0.2 * (speed / 3.0) ** 0.43
        assert sb.restitution(law, impact_speed=speed) == pytest.approx(kept, rel=1e-14)
    assert sb.restitution(law, impact_speed=3.0 * 5.0 ** (1.0 / 0.43) * 1.01) == 0.0
    assert sb.RigidLossBySpeed(1.0, 1.0).restitution_at(1.0, 50.0) == 1.0


@pytest.mark.parametrize("kind", KINDS)
def test_calibration_takes_the_usual_exponent(kind):
    law = sb.calibrate(kind, restitution=0.7, impact_speed=2.5)
    assert law == kind(0.7, 2.5)
    assert law.speed_exponent == {"RigidBySpeed": 0.25, "RigidLossBySpeed": 0.2}[kind.__name__]
    assert sb.contact_time(law) == 0.0
    with pytest.raises(errors.InvalidValue, match="impact_speed must be given to calibrate Rigid"):
        sb.calibrate(kind, restitution=0.7)
    with pytest.raises(errors.InvalidValue, match="speed must be given, as the restitution of"):
        sb.restitution(law, mass=0.1)


def test_scatter_is_described_where_there_is_some():
    law = sb.RigidBySpeed(0.8, 3.0)
    assert law.described() == "RigidBySpeed, restitution 0.8, speed 3 m/s, speed exponent 0.25"
    told = sb.RigidBySpeed(0.8, 3.0, scatter=0.05, seed=2).described()
    assert told.endswith("exponent 0.25, scatter 0.05, seed 2")


def test_rigid_laws_stand_together_and_not_with_others():
    balls = [sb.Ball(1.0)] * 2
    law = sb.RigidBySpeed(0.8, 1.0)
    assert sb.Drop(balls, [sb.Rigid(0.5), law], impact_speed=1.0).rigid
    with pytest.raises(errors.InvalidValue, match=r"contacts.0 is RigidBySpeed and contacts.1 is"):
        sb.Drop(balls, [law, sb.Spring(1.0)], impact_speed=1.0)
    assert usual_laws()[:4] == ["Rigid", "RigidBySpeed", "RigidLossBySpeed", "Spring"]


def test_separate_collisions_take_the_restitution_at_the_first_speed():
    law = sb.RigidLossBySpeed(0.8, speed=2.0, speed_exponent=1.0)
    balls = [sb.Ball(3.0), sb.Ball(1.0)]
    floor, between = sb.separate(sb.Drop(balls, [law, law], impact_speed=2.0)).contacts
    assert floor == sb.Rigid(0.8)
    assert between.restitution == pytest.approx(1.0 - 0.1 * (2.0 + 0.8 * 2.0), rel=1e-14)


@pytest.mark.parametrize("exponent", [0.2, 4.0])
def test_restitutions_at_any_speed_are_limits(exponent):
    """Beyond the range of numbers they are those of the formula: 0 or 1."""
    falls, loses = sb.RigidBySpeed(0.5, 1.0, exponent), sb.RigidLossBySpeed(0.5, 1.0, exponent)
    for slow in (5e-324, 1e-100):
        assert sb.restitution(falls, impact_speed=slow) == 1.0
        assert sb.restitution(loses, impact_speed=slow) == pytest.approx(1.0)
    for fast in (1e100, 1e308):
        assert sb.restitution(falls, impact_speed=fast) == pytest.approx(0.0, abs=1e-19)
        assert sb.restitution(loses, impact_speed=fast) == 0.0
    gentle = sb.RigidBySpeed(0.5, 1e-9, 1e-3)  # its ratio of speeds is out of range, not its power
    assert sb.restitution(gentle, impact_speed=1e308) == pytest.approx(0.5 * 10.0**-0.317)
