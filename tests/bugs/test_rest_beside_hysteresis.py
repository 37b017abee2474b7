"""A damped stack never came to rest if a contact with hysteresis stayed inside a cycle."""

import pytest

import stackbounce as sb

WEIGHTS = [0.15 * 9.81, 0.05 * 9.81]


@pytest.mark.parametrize(
    "law", [sb.Hysteretic(2e4, restitution=0.75), sb.HollowBall(2e4, 1e-3, 0.3, 0.8)]
)
def test_a_damped_stack_comes_to_rest_where_it_swings_out(law):
    laws = [law, sb.Dashpot(2e4, 10.0)]
    drop = sb.Drop([sb.Ball(0.1), sb.Ball(0.05)], laws, height=0.1, gravity=9.81)
    result = sb.simulate(drop, until=100.0)
    assert result.status is sb.Status.SETTLED
    end = result.sample([result.end_time - 1e-9, 100.0])
    # the run ends at 1e-9 of the impact speed: 1e-9 sqrt(k m) of it is left of the force
    assert end.force.values[:, 1] == pytest.approx(WEIGHTS, rel=1e-7)
    assert end.force.values[:, 0] == pytest.approx(WEIGHTS, rel=1e-7)
    assert end.compression.values[:, 1] == pytest.approx(end.compression.values[:, 0], rel=1e-6)
