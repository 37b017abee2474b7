"""Drops in which something was wrong, mostly found by the fuzz: `data/bugs.json` says what."""

import math

import numpy as np
import pytest

import stackbounce as sb
from drops import drop_of, rigid, springs
from fuzz.check import faults_of
from reference import data
from stackbounce.engine.memory import FINITE, memory
from stackbounce.engine.slots import EVENTS, STEPS
from stackbounce.errors import ScenarioError
from stackbounce.fitting import FitProblem
from stackbounce.run import options
from stackbounce.run.batch import solve

ROWS = data.read("bugs")
STOPS = np.linspace(0.0, 1.0, 200, endpoint=False)[1:]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["was"])
def test_nothing_is_wrong_any_more(row):
    options = {name: row[name] for name in ("until", "event_limit") if name in row}
    for rtol in row["rtols"]:
        result = sb.simulate(drop_of(row["case"]), rtol=rtol, **options)
        assert result.status.name == row["status"]
        assert result.energy_retained < 1.0 + rtol
        assert faults_of(result, STOPS) == []
        if "rebound_speeds" in row:  # by thirty digits
            within = row["within"] * rtol * result.drop.reference_speed
            assert result.rebound_speeds == pytest.approx(row["rebound_speeds"], abs=within)
            assert result.collisions.tolist() == row["collisions"]


# --- A damped stack never came to rest if a contact with hysteresis stayed inside a cycle
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


# --- whether a soft damped stack came to rest hung on round-off
@pytest.mark.parametrize(
    ("laws", "height"),
    [([sb.Viscoelastic(4e4, 3e-3)], 3e-3), ([sb.Dashpot(2500, 3), sb.Dashpot(1000, 1)], 5e-3)],
)
def test_a_soft_damped_stack_comes_to_rest(laws, height):
    balls = [sb.Ball(0.15), sb.Ball(0.057)][: len(laws)]
    result = sb.simulate(sb.Drop(balls, laws, height=height, gravity=9.81), until=50.0)
    assert result.status is sb.Status.SETTLED
    assert result.end_time < 10.0


# --- bugs of force curves: chords near the touch, steep curves, loading again
@pytest.mark.parametrize("rtol", [1e-10, 1e-12, 1e-14])
def test_faint_contact_under_a_weight(rtol):
    """A chord that oscillated about a distant static state lost all digits near c = 0."""
    drop = sb.Drop([sb.Ball(1.0)], [sb.PowerLaw(1.0, 3.0)], impact_speed=1.0, gravity=0.1)
    assert sb.simulate(drop, rtol=rtol).rebound_ratios == pytest.approx([1.0], abs=10 * rtol)


def test_steep_curve_without_a_force():
    """A lossy contact that turned on a steep curve without a force had forces of nan."""
    x = (0.0, 7.782028918825447e-06, 8.258240129118271e-06)
    force = (0.0, 0.02601113649956332, 0.026290450529335183)
    laws = [
        sb.Tabulated(x, force, unloading=(0.0, 0.013061570526707682, force[2])),
        sb.Hysteretic(23559.248428320974, restitution=0.05),
        sb.Bond(24902.980888266327, damping=0.0170163037599283),
        sb.HuntCrossley(3817924.3498970917, 1.5, dissipation=0.15546519049400043),
    ]
    mass = (0.10519654480600871, 0.16402630726019218, 0.03657033188038414, 0.31313266447978316)
    gaps = [1.1126457695723777e-06, 0.0, 0.0]
    drop = sb.Drop(list(map(sb.Ball, mass)), laws, gaps, impact_speed=0.03128275786851308)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    motion = result.sample(np.linspace(0.0, result.end_time, 20))
    assert np.isfinite(motion.force.values).all()
    assert np.isfinite(motion.energy.values).all()


# --- under strong damping the force passes zero so gently that its end was found too late
# The end was where the sign of the force was clear of its round-off. An end is now the zero itself.
LAW_ROWS = data.read("laws")


@pytest.mark.parametrize(
    ("time", "rtol", "error"),
    [
        (0.1, 1e-12, 1e-11),  # it was 1e-9
        (0.1, 1e-14, 1e-12),  # 2e-10
        (1.0, 1e-12, 2e-9),  # 2e-6
        (1.0, 1e-14, 2e-11),  # 2e-7
    ],
)
def test_one_viscoelastic_ball(time, rtol, error):
    law = {"law": "Viscoelastic", "stiffness": 2e5, "dissipative_time": time}
    row = next(row for row in LAW_ROWS if row["case"]["contacts"] == [law])
    drop = drop_of(row["case"])
    ends = {sb.simulate(drop, rtol=rtol, compiled=c).intervals["end"][0] for c in (True, False)}
    assert len(ends) == 1
    assert ends.pop() == pytest.approx(row["intervals"][0][2], rel=error)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("time", [0.1, 1.0, 10.0])
def test_no_run_ends_before_its_contact(time, rtol):
    """At a coarse tolerance, too, the run ends with the contact."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Viscoelastic(2e5, time)], impact_speed=2.0)
    result = sb.simulate(drop, rtol=rtol)
    [row] = result.intervals
    assert 0.0 < row["end"] <= result.end_time
    assert result.sample([row["end"] * (1.0 + 1e-9)]).force.values.max() == 0.0


# --- plain Python raised where compiled code divides by zero, and runs ended as INVALID
@pytest.mark.parametrize("compiled", [False, True])
def test_restitution_zero(compiled):
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], [sb.Rigid(0.0), sb.Rigid(1.0)], impact_speed=1.0)
    result = sb.simulate(drop, compiled=compiled)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [2, 1]
    assert result.rebound_speeds.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("drop", "status"),
    [
        (rigid([0.01, 0.04, 1.0], [1.0, 0.452, 1.0], [1.0, 1.0], impact_speed=24.0), "COLLAPSED"),
        (springs([1e300], [1e-300]), "INVALID"),
        (springs([1e-300], [1.0]), "INVALID"),
        (springs([1.0], [1e308]), "INVALID"),
    ],
)
def test_gaps_that_vanish_and_numbers_out_of_range(drop, status, compiled):
    result = sb.simulate(drop, compiled=compiled)
    assert result.status.name == status
    assert np.isnan(result.rebound_ratios).all() == (status == "INVALID")


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(("stiffness", "speed"), [(1.0, 1e-300), (1e80, 1e40)])
def test_a_very_slow_ball_and_a_very_fast_one(stiffness, speed, compiled):
    drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(stiffness)], impact_speed=speed)
    assert sb.simulate(drop, compiled=compiled).rebound_ratios == pytest.approx([1.0], rel=1e-15)


# --- bugs of round-off and of numbers out of range
def test_joined_with_a_heavy_ball():
    """Balls joined by infinitely many collisions changed a heavy ball's velocity by round-off."""
    masses = [0.004254298, 0.010710843, 0.004948328, 4748.0783, 70.136967]
    gaps = [0.0, 0.121746412, 184.568918, 0.435116550]
    drop = rigid(masses, [None, 0.0, 0.0, 0.0, 0.0], gaps, [1.0, 0.0, 0.0, 0.0, 0.0])
    result = sb.simulate(drop)
    momentum = math.fsum(m * v for m, v in zip(masses, result.rebound_speeds, strict=True))
    assert result.status is sb.Status.COLLAPSED
    assert momentum == pytest.approx(masses[0], rel=1e-14, abs=0.0)


def test_second_impact_after_a_long_flight():
    """Late in a run, the round-off of time exceeded that of the solution, and events alternated."""
    balls = [sb.Ball(0.1), sb.Ball(0.002)]
    result = sb.simulate(sb.Drop(balls, [sb.Spring(1e4)] * 2, height=1.0, gravity=9.81), until=3.0)
    assert result.status is sb.Status.TIME_REACHED
    assert result.collisions.tolist() == [4, 2]
    energy = result.sample([0.0, 1.5, 3.0]).energy.values
    assert abs(energy / energy[0] - 1.0).max() < 1e-12


def test_light_ball_under_a_great_weight():
    """A very large static compression under a heavy ball cost the first microns their digits."""
    mass, gravity = 7680.765321260328, 14978.377780237126
    drop = sb.Drop(
        [sb.Ball(1.566e-06), sb.Ball(mass)],
        [sb.Spring(493506.0), sb.Spring(2632.0)],
        velocities=[-3.53, -3.53],
        gravity=gravity,
    )
    motion = sb.simulate(drop, until=0.0005).sample(np.linspace(0.0, 0.0005, 400))
    height = mass * gravity * np.abs(motion.position.values).max()
    assert np.ptp(motion.energy.values) < 1e-14 * height + 1e-13 * motion.energy.values[0]


@pytest.mark.parametrize("gap", [1e-3, 1e-2])
def test_noise_after_a_cannon(gap):
    """Balls at rest kept speeds of round-off, and collided again after a million years."""
    balls = [sb.Ball(1e-3 * mass) for mass in (30.0, 10.0, 5.0, 3.0, 2.0)]
    result = sb.simulate(sb.Drop(balls, [sb.Hertz(1e9)] * 5, [gap] * 4, impact_speed=1.0))
    assert result.collisions.tolist() == [1] * 5
    assert result.rebound_ratios == pytest.approx([0.0, 0.0, 0.0, 0.0, 5.0], abs=1e-11)


def test_tiny_times_stay_in_range():
    """In seconds, series overflowed; restitution: of 1.5 A (k/m)^(2/5) v^(1/5) alone."""
    tiny = sb.Drop([sb.Ball(1e-9**2.5)], [sb.Viscoelastic(1.0, 1e-10)], impact_speed=1.0)
    plain = sb.Drop([sb.Ball(1.0)], [sb.Viscoelastic(1.0, 0.1)], impact_speed=1.0)
    expected = sb.simulate(plain).rebound_ratios
    assert sb.simulate(tiny).rebound_ratios == pytest.approx(expected, rel=1e-10)


def test_a_list_of_stiffnesses_is_refused():
    """A list in place of a stiffness in N/m**exponent ended in pint's TypeError, not in words."""
    contact = {"law": "HuntCrossley", "stiffness": [1.5, "2 mm"], "exponent": 1.0, "dissipation": 0}
    drop = {"balls": [{"mass": 1.0}], "contacts": [contact], "impact_speed": 1.0}
    with pytest.raises(ScenarioError, match=r"contacts.0.stiffness.1 must be a stiffness"):
        sb.Drop.from_mapping(drop)


def test_every_sample_of_a_record_has_a_force():
    """A record whose times are not exact in binary lost samples when its times were shifted."""
    drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2.2e4)], height=1.0)
    times = np.arange(0.0, 0.01068, 2e-5)
    force = 150.0 * np.sin(np.clip((times - 0.0027) * 620.0, 0.0, np.pi))
    noisy = force + np.random.default_rng(1).normal(0.0, 0.5, len(times))
    data = {"force.0": (times, noisy)}
    objective = FitProblem(drop, data, ["contacts.0.stiffness"]).objective
    starts = np.linspace(*objective.spans[1], 50)
    for start in starts:
        (forces,) = objective.forces("", np.array([objective.spans[0, 0], start]))
        assert forces.shape == objective.measured[""].waveforms[0].times.shape


@pytest.mark.parametrize("gap", [7.601865069378338, 7.601865069378339, 7.601865069378181])
def test_a_touch_long_after_a_tie(gap):
    """A touch 1e14 contact times later began with its position's round-off as stored energy."""
    balls, springs = [sb.Ball(1.0), sb.Ball(6.0)], [sb.Spring(1.0), sb.Spring(0.2)]
    result = sb.simulate(sb.Drop(balls, springs, [gap], impact_speed=1.0))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=1e-11)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-12)


# --- runs whose limits of events and steps multiplied went on for minutes or hours
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
@pytest.mark.usefixtures("little_work")
@pytest.mark.parametrize("name", STEPS_OF_ALL_KINDS)
def test_no_run_costs_more_than_its_work(name):
    """The default is five seconds or less; `stackbounce.engine.work` has the price of a step."""
    result = sb.simulate(STEPS_OF_ALL_KINDS[name], until=1e300 if name == "collisions" else None)
    assert result.status is sb.Status.EVENT_LIMIT
    assert result.work < 1.01 * options.WORK_LIMIT


@pytest.mark.slow
@pytest.mark.usefixtures("little_work")
def test_who_asks_for_more_gets_more_by_each_way():
    """The work is counted alike in a sweep and in plain Python, which is slower."""
    drop, work = STEPS_OF_ALL_KINDS["time stands still"], []
    for limit in (1_000_000, 1_200_000):
        result = sb.simulate(drop, event_limit=limit)
        out = solve(drop, {}, (1,), options.run_options(drop, None, 1e-12, limit))
        assert (out.status[0], out.work[0]) == (result.status, result.work)
        assert out.rebound_ratio[0].tolist() == list(result.rebound_ratios)
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
