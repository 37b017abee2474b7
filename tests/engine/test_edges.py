"""Grazing, ties, zero gaps, contacts that open at zero speed, and stacks that never touch."""

import numpy as np
import pytest

import stackbounce as sb
from drops import every_law, of_contact, rigid, springs
from reference import precise

PRECISION = 1e-11


def test_tiny_gaps_meet_zero_gaps():
    """The outcome does not jump where the gap closes."""
    closed = sb.simulate(springs([1.0, 2.0, 0.5], [1.0, 3.0, 0.7])).rebound_ratios
    for gap in (1e-300, 1e-100, 1e-18, 1e-15, 1e-12):
        result = sb.simulate(springs([1.0, 2.0, 0.5], [1.0, 3.0, 0.7], [gap, gap]))
        assert result.rebound_ratios == pytest.approx(closed, abs=PRECISION + 10 * gap)
        assert result.collisions.tolist() == [1, 1, 1]


def test_touch_times_of_tiny_gaps():
    """With c = t**3/6 - gap the touch comes at the cube root of six gaps, to leading order."""
    for gap in (1e-6, 1e-8, 1e-10, 1e-12):
        result = sb.simulate(springs([1.0, 1.0], [1.0, 1.0], [gap]))
        touch = (6 * gap) ** (1 / 3)
        start = of_contact(result, 1)["start"][0]
        assert start == pytest.approx(touch, rel=touch**2 / 50, abs=PRECISION)


@pytest.mark.parametrize("stiffness", [0.03, 1.0, 30.0])
def test_a_contact_opens_as_another_closes(stiffness):
    """They meet as the lower ball leaves the floor, and part as it comes back, to rounding."""
    result = sb.simulate(springs([1.0, 1.0], [1.0, stiffness], [np.pi]))
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.collisions.tolist() == [2, 1]
    assert of_contact(result, 0)["end"][0] == pytest.approx(np.pi, abs=PRECISION)
    assert of_contact(result, 1)["start"][0] == pytest.approx(np.pi, abs=PRECISION)


@pytest.mark.parametrize(
    ("masses", "stiffness"), [((1.0, 1.0), 1.0), ((1.0, 0.3), 1.0), ((1.0, 0.1), 0.4)]
)
def test_contacts_that_open_without_speed(masses, stiffness):
    """A drop with a zero gap, played backwards: the upper contact opens with c = c' = c'' = 0."""
    forward = sb.simulate(springs(masses, [1.0, stiffness]))
    assert forward.collisions.tolist() == [1, 1]
    assert of_contact(forward, 0)["end"] == forward.end_time
    position = forward.sample([forward.end_time]).position.values[:, 0]
    gap, velocities = position[1] - position[0], -forward.rebound_speeds
    drop = springs(masses, [1.0, stiffness], [gap], velocities.tolist())
    result = sb.simulate(drop, event_limit=1000)
    assert result.status is sb.Status.FINISHED
    assert result.rebound_speeds == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.intervals["end"].max() == pytest.approx(forward.end_time, abs=1e-4)
    assert abs(result.energy_retained - 1) <= 1e-12


@pytest.mark.parametrize("stack", [springs, rigid])
@pytest.mark.parametrize(
    ("floor", "velocities"),
    [(None, [-1.0, -1.0]), (None, [-1.0, 2.0]), (1.0, [1.0, 1.0]), (1.0, [0.0, 0.0, 1.0])],
)
@pytest.mark.parametrize("gap", [0.0, 0.5])
def test_stacks_that_never_touch_finish_at_once(stack, floor, velocities, gap):
    size = len(velocities)
    drop = stack([1.0] * size, [floor] + [1.0] * (size - 1), [gap] * (size - 1), velocities)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    assert result.end_time == 0.0
    assert result.collisions.tolist() == [0] * size
    assert result.rebound_speeds.tolist() == velocities
    assert len(result.intervals) == len(result.events) == 0
    assert result.energy_retained == 1.0


@pytest.mark.parametrize(("gap", "lower"), [(0.0, 0.0), (0.4, 0.0), (0.4, 0.5)])
def test_a_lowest_ball_that_does_not_fall_is_struck(gap, lower):
    result = sb.simulate(springs([1.0, 2.0], [1.0, 3.0], [gap], [lower, -1.0]))
    contacts = [{"law": "Spring", "stiffness": k} for k in (1.0, 3.0)]
    expected = precise.run([1.0, 2.0], contacts, [gap], [lower, -1.0])
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == expected.counts(2)
    speeds = [float(velocity) for velocity in expected.velocities]
    assert result.rebound_speeds == pytest.approx(speeds, abs=PRECISION)


@pytest.mark.parametrize("drop", [rigid([1.0, 1e4]), springs([1.0, 50.0], [1.0, 1.0], [3.0])])
def test_event_limit(drop):
    limited, full = sb.simulate(drop, event_limit=5), sb.simulate(drop)
    assert limited.status is sb.Status.EVENT_LIMIT
    assert full.status is sb.Status.FINISHED
    reached = len(limited.events)
    assert 0 < reached <= 5 < len(full.events)
    assert limited.events.tolist() == full.events[:reached].tolist()


def test_event_limit_of_collisions():
    assert sb.simulate(rigid([1.0, 1e4]), event_limit=314).status is sb.Status.FINISHED
    assert sb.simulate(rigid([1.0, 1e4]), event_limit=313).status is sb.Status.EVENT_LIMIT


LAWS = sorted(every_law(1.0))


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("masses", [(1.0, 1e-6), (1e-6, 1.0), (1.0, 1e-4, 1.0), (1.0, 1e6, 1.0)])
def test_masses_of_many_orders(name, masses):
    law = every_law(1.0)[name]
    drop = sb.Drop([sb.Ball(m) for m in masses], [law] * len(masses), impact_speed=1.0)
    result = sb.simulate(drop, rtol=1e-9)
    assert result.status is sb.Status.FINISHED
    assert (np.diff(result.rebound_speeds, prepend=0.0) >= -1e-9).all()
    assert 0.0 < result.energy_retained <= 1.0 + 1e-7


@pytest.mark.slow
@pytest.mark.parametrize("name", ["Hertz", "Spring", "PowerLaw"])
def test_a_mass_of_twelve_orders_on_a_light_one(name):
    """The light ball below is only felt as a part of the floor, or the limit is met and said."""
    light = sb.Drop([sb.Ball(1.0), sb.Ball(1e-12)], [every_law(1.0)[name]] * 2, impact_speed=1.0)
    result = sb.simulate(light)
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios[0] == pytest.approx(1.0, abs=1e-6)
    heavy = sb.Drop([sb.Ball(1e-12), sb.Ball(1.0)], [every_law(1.0)[name]] * 2, impact_speed=1.0)
    stopped = sb.simulate(heavy, event_limit=20_000)
    assert stopped.status is sb.Status.EVENT_LIMIT
    assert "raise event_limit" in stopped.status.advice
    assert np.isfinite(stopped.rebound_speeds).all()
    assert np.isinf(stopped.intervals["end"]).any()  # of what was still under way
    half = stopped.sample([0.5 * stopped.end_time])
    assert half.energy.item() == pytest.approx(0.5, rel=1e-9)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("power", [-8, 8])
def test_stiffnesses_of_many_orders(name, power):
    """A far stiffer contact above joins the balls to one; a far softer one lets them bounce."""
    if name == "Dashpot" and power == 8:
        power = 6  # its damping grows too, and its motion is stiff: see the next test
    laws = [every_law(1.0)[name], every_law(10.0**power)[name]]
    result = sb.simulate(sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], laws, impact_speed=1.0), rtol=1e-9)
    assert result.status is sb.Status.FINISHED
    if power > 0:
        together = sb.simulate(sb.Drop([sb.Ball(2.0)], laws[:1], impact_speed=1.0)).rebound_ratios
        assert result.rebound_ratios == pytest.approx([together[0]] * 2, abs=0.05)
    else:
        assert result.collisions.tolist() == [2, 1]


def test_a_slow_contact_after_a_fast_one():
    """Terms of its series in the unit of the faster one are below the least of all numbers."""

    def ratios(scale):
        laws = [sb.Dashpot(1e16, 1e5), sb.Hertz(1e-10 / scale)]
        drop = sb.Drop([sb.Ball(100.0), sb.Ball(1e-5)], laws, impact_speed=1e-19 * scale**2)
        return sb.simulate(drop, rtol=1e-13).rebound_ratios

    assert ratios(1.0) == pytest.approx(ratios(2.0**30), rel=1e-10)


@pytest.mark.parametrize("zeta", [10.0, 1e3])
def test_stiff_dashpots(zeta):
    """So overdamped a contact holds the two balls together while the other one works."""
    laws = [sb.Spring(1.0), sb.Dashpot(1.0, 2.0 * zeta)]
    result = sb.simulate(sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], laws, impact_speed=1.0))
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=0.5 / zeta)
    assert result.rebound_ratios[1] > result.rebound_ratios[0]


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("gap", [1e-12, 1e6])
def test_gaps_from_none_to_a_million_contacts(name, gap):
    law = every_law(1.0)[name]
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(0.3)], [law, law], [gap], impact_speed=1.0)
    result = sb.simulate(drop)
    assert result.status is sb.Status.FINISHED
    if gap > 1.0:
        sequence = sb.simulate(sb.separate(drop))
        assert result.rebound_ratios == pytest.approx(sequence.rebound_ratios, abs=1e-9)
    else:
        closed = sb.simulate(sb.Drop([sb.Ball(1.0), sb.Ball(0.3)], [law, law], impact_speed=1.0))
        assert result.rebound_ratios == pytest.approx(closed.rebound_ratios, abs=1e-10)


@pytest.mark.parametrize("name", LAWS)
def test_equal_and_opposite_balls_tie(name):
    """Two like pairs that meet at one instant do the same, whatever the law."""
    law = every_law(1.0)[name]
    drop = sb.Drop(
        [sb.Ball(1.0)] * 4,
        [None, law, law, law],
        [1.0, 9.0, 1.0],
        velocities=[1.0, -1.0, 1.0, -1.0],
    )
    result = sb.simulate(drop)
    first, last = of_contact(result, 1)[0], of_contact(result, 3)[0]
    for field in ("start", "end", "peak_force", "impulse"):
        assert first[field] == pytest.approx(last[field], rel=1e-12)


def test_restitution_one_loses_nothing():
    """Laws with losses set to none are their lossless selves, to the last bit."""
    pairs = [
        (sb.Dashpot(2.0, 0.0), sb.Spring(2.0)),
        (sb.Viscoelastic(2.0, 0.0), sb.Hertz(2.0)),
        (sb.HuntCrossley(2.0, 1.7, 0.0), sb.PowerLaw(2.0, 1.7)),
        (sb.PowerLaw(2.0, 1.0), sb.Spring(2.0)),
        (sb.Hysteretic(2.0, restitution=1.0), sb.Spring(2.0)),
        (sb.StandardLinearSolid(2.0, 0.0, 1.0), sb.Spring(2.0)),
        (sb.PowerLaw(2.0, 1.5), sb.Hertz(2.0)),
    ]
    for lossy, lossless in pairs:
        balls = [sb.Ball(1.0), sb.Ball(0.4)]
        one = sb.simulate(sb.Drop(balls, [lossy] * 2, impact_speed=1.0))
        other = sb.simulate(sb.Drop(balls, [lossless] * 2, impact_speed=1.0))
        assert one.rebound_speeds.tolist() == other.rebound_speeds.tolist()
        assert one.intervals.tolist() == other.intervals.tolist()


def test_a_force_that_is_cut_off_resumes_in_the_same_interval():
    """The floor's dashpot yields too slowly to stay pressed, until the upper ball lands."""
    hunt = sb.HuntCrossley(1.0, 1.17, 1.08)
    balls = [sb.Ball(0.2), sb.Ball(2.3)]
    result = sb.simulate(sb.Drop(balls, [sb.Dashpot(0.06, 5.3), hunt], [0.94], impact_speed=1.0))
    (interval,) = of_contact(result, 0)
    sample = result.sample(np.linspace(0.0, interval["end"], 4001)[1:-1])
    force, compression = sample.force.values[0], sample.compression.values[0]
    assert (compression > 0.0).all()
    assert (force >= 0.0).all()
    (slack,) = np.nonzero(force == 0.0)
    assert len(slack) > 100
    assert (np.diff(slack) == 1).all()
    assert force[slack[0] - 2] > 0.0
    assert force[slack[-1] + 2] > 0.0


def test_a_thousand_contacts_again_and_again():
    """A light ball between the floor and a heavy one, on stiff Hertz contacts."""
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1e5)], [sb.Hertz(1e14)] * 2, [0.5], impact_speed=1.0)
    result = sb.simulate(drop, rtol=1e-9, compiled=True)
    sequence = sb.simulate(sb.separate(drop))
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == sequence.collisions.tolist() == [497, 496]
    assert result.energy_retained == pytest.approx(1.0, abs=1e-7)


def test_a_fast_ball_on_a_hard_contact_late():
    """The clock is too coarse to tell when so short a contact's force sinks below round-off."""
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1e6)], [sb.Hertz(1e16)] * 2, [0.5], impact_speed=1.0)
    result = sb.simulate(drop, compiled=True)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [1571, 1570]


@pytest.mark.parametrize("exponent", [1.5, 2.5, 3.5])
@pytest.mark.parametrize("stiffness", [3e4, 1e7, 3.5e9])
def test_a_steep_power_that_begins_at_a_speed(exponent, stiffness):
    """In the root of time all but one of 2 p + 2 terms of the series may be 0."""
    contacts = [sb.PowerLaw(1e7, exponent), sb.PowerLaw(stiffness, exponent)]
    for gap in (0.0, 9e-4):
        drop = sb.Drop([sb.Ball(0.1), sb.Ball(0.2)], contacts, gaps=[gap], impact_speed=4.0)
        known = sb.simulate(drop, rtol=1e-12).rebound_ratios
        for rtol in (1e-4, 1e-6, 1e-8):
            ratios = sb.simulate(drop, rtol=rtol).rebound_ratios
            assert ratios == pytest.approx(known, abs=10.0 * rtol)
