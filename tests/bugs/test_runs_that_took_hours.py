"""Runs whose limits of events and steps multiplied went on for minutes or hours."""

import pytest

import stackbounce as sb
from stackbounce.engine.slots import EVENTS, STEPS
from stackbounce.run.engines import FINITE
from stackbounce.run.memory import memory


def counts(drop, **options):
    """Return the status of a run, its events and its steps."""
    status = sb.simulate(drop, **options).status
    counter = memory(FINITE, len(drop.balls), True).stack.counter
    return status, int(counter[EVENTS]), int(counter[STEPS])


def test_a_stack_that_swings_with_many_events_is_left():
    """Each swing has events, so that there are few steps without one."""
    laws = [
        sb.Hysteretic(20763.5, restitution=0.7),
        sb.Hysteretic(5.656e7, restitution=0.05),
    ]
    balls = [sb.Ball(9.878), sb.Ball(34.344)]
    drop = sb.Drop(balls, laws, gaps=[5e-7], impact_speed=0.277, gravity=9.81)
    status, events, steps = counts(drop)
    assert status is sb.Status.EVENT_LIMIT
    assert events > 1000
    assert 50_000 <= steps < 51_000
    assert "stop earlier with until" in status.advice


@pytest.mark.slow
def test_many_steps_between_many_events_end():
    """A heavy ball bounces for ever on a light one with a bond: thousands of steps each time."""
    laws = [sb.Bond(13354.8), sb.Bond(8123.41), sb.Hertz(678211.0)]
    balls = [sb.Ball(0.419), sb.Ball(0.184), sb.Ball(8.4505)]
    drop = sb.Drop(balls, laws, gaps=[0.0, 4.3e-8], impact_speed=0.01, gravity=9.81)
    status, events, steps = counts(drop)
    assert (status, steps) == (sb.Status.EVENT_LIMIT, 1_000_000)
    assert events < 100_000
    assert counts(drop, event_limit=1_200_000)[2] == 1_200_000


@pytest.mark.parametrize("returned", [1e-5, 1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize(
    "law",
    [
        lambda e: sb.HollowBall(1e4, 1e-3, stiffness_ratio=0.3, restitution=e),
        lambda e: sb.Tabulated([0.0, 1e-3, 5e-3], [0.0, 10.0, 30.0], restitution=e),
        lambda e: sb.Tabulated([0.0, 1e-3, 1.01e-3], [0.0, 1e-6, 3e3], restitution=e),
    ],
)
def test_next_to_total_loss_takes_few_steps(law, returned):
    """The chord began at 0.9 of the peak, where a steep curve has had no force for long."""
    drop = sb.Drop([sb.Ball(0.1)], [law(returned)], impact_speed=1.0)
    result = sb.simulate(drop, event_limit=1000)
    assert result.status is sb.Status.FINISHED
    assert abs(result.rebound_ratios[0] - returned) < 1e-9
