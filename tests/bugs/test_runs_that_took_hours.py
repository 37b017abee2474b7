"""Runs whose limits of events and steps multiplied went on for minutes or hours."""

import pytest

import stackbounce as sb
from stackbounce.engine.memory import FINITE, memory
from stackbounce.engine.slots import EVENTS, STEPS
from stackbounce.engine.work import WORK_LIMIT
from stackbounce.run.batch import solve
from stackbounce.run.options import run_options


def counts(drop, **options):
    """Return the status of a run, its events and its steps."""
    status = sb.simulate(drop, **options).status
    counter = memory(FINITE, len(drop.balls), True).stack.counter
    return status, int(counter[EVENTS]), int(counter[STEPS])


def test_a_stack_that_swings_with_many_events_is_left():
    """Each swing has events, so that there are few steps without one."""
    laws = [sb.Hysteretic(20763.5, restitution=0.7), sb.Hysteretic(5.656e7, restitution=0.05)]
    balls = [sb.Ball(9.878), sb.Ball(34.344)]
    drop = sb.Drop(balls, laws, gaps=[5e-7], impact_speed=0.277, gravity=9.81)
    status, events, steps = counts(drop)
    assert status is sb.Status.EVENT_LIMIT
    assert events > 1000
    assert 50_000 <= steps < 51_000
    assert "stop earlier with until" in status.advice


LIGHT, HEAVY = [sb.Ball(1e-12), sb.Ball(1.0)], [sb.Ball(1e308), sb.Ball(1.0)]
STEPS_OF_ALL_KINDS = {
    "a heavy ball bounces for ever on a light one with a bond": sb.Drop(
        [sb.Ball(0.419), sb.Ball(0.184), sb.Ball(8.4505)],
        [sb.Bond(13354.8), sb.Bond(8123.41), sb.Hertz(678211.0)],
        [0.0, 4.3e-8],
        impact_speed=0.01,
        gravity=9.81,
    ),
    "time stands still": sb.Drop(HEAVY, [sb.Spring(1e4)] * 2, impact_speed=1.0),
    "an overdamped contact": sb.Drop(LIGHT, [sb.HuntCrossley(1e4, 1.5, 0.2)] * 2, impact_speed=1.0),
    "a force in each step": sb.Drop(
        LIGHT, [sb.StandardLinearSolid(1e4, 0.5, 0.01)] * 2, impact_speed=1.0
    ),
    "a tall stack": sb.Drop(
        [sb.Ball(10.0 ** (i % 3)) for i in range(300)],
        [sb.Viscoelastic(10.0 ** (i % 4), 1e-3) for i in range(300)],
        impact_speed=1.0,
    ),
    "cycles inside one another": sb.Drop(
        [sb.Ball(0.184), sb.Ball(0.0078)],
        [sb.Hysteretic(0.357, unloading_exponent=14.5), sb.Spring(1.47)],
        [2.3e-5],
        velocities=[0.0, -3.53],
        gravity=14.8,
    ),
    "collisions": sb.Drop([sb.Ball(1.0)], [sb.Rigid(1.0)], impact_speed=1.0, gravity=9.81),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", STEPS_OF_ALL_KINDS)
def test_no_run_of_the_default_limits_costs_more_than_its_work(name):
    """The limit is five seconds or less; `stackbounce.engine.work` has the price of a step."""
    result = sb.simulate(STEPS_OF_ALL_KINDS[name], until=1e300 if name == "collisions" else None)
    assert result.status is sb.Status.EVENT_LIMIT
    assert result.work < 1.01 * WORK_LIMIT


@pytest.mark.slow
def test_who_asks_for_more_gets_more_by_each_way():
    """The work is counted alike in a sweep and in plain Python, which is slower."""
    drop, work = STEPS_OF_ALL_KINDS["time stands still"], []
    for limit in (1_000_000, 1_200_000):
        result = sb.simulate(drop, event_limit=limit)
        out = solve(drop, {}, (1,), run_options(drop, None, 1e-12, limit))
        assert (out.status[0], out.work[0]) == (result.status, result.work)
        assert out.velocity[0].tolist() == list(result.final_velocities)
        work.append(result.work)
    assert work[1] == pytest.approx(1.2 * work[0], rel=1e-3)
    few = [sb.simulate(drop, event_limit=100, compiled=way).work for way in (True, False)]
    assert few[0] == few[1] > 0


def test_the_status_says_why():
    soft = [sb.Spring(1.0), sb.Dashpot(1.0, 1e3)]
    stiff = sb.Drop([sb.Ball(1.0)] * 2, soft, impact_speed=1.0)
    said = {sb.simulate(stiff, event_limit=100).advice: "so stiff or so damped"}
    extreme = STEPS_OF_ALL_KINDS["an overdamped contact"]
    said[sb.simulate(extreme, event_limit=100).advice] = "of very different sizes"
    endless = STEPS_OF_ALL_KINDS["collisions"]
    said[sb.simulate(endless, until=1e9, event_limit=100).advice] = "perhaps for ever: stop earlier"
    assert len(said) == 3
    assert all(words in advice and "raise event_limit" in advice for advice, words in said.items())
    assert sb.simulate(endless).advice == sb.Status.FINISHED.advice


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
