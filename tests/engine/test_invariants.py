"""Invariants of every drop: momentum, energy, scaling, order of intervals, sampling."""

import functools
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import stackbounce as sb
from drops import masses_of, of_contact
from fuzz.check import faults_of

simulate = functools.partial(sb.simulate, rtol=1e-14)
MOMENTUM = 1e-12
ENERGY = 1e-12
STOPS = np.linspace(0.0, 1.0, 80, endpoint=False)[1:]


def powers(low, high):
    return st.floats(low, high).map(lambda x: 10**x)


@st.composite
def laws(draw, kind):
    k = draw(powers(-1, 1))
    if kind == "spring":
        return sb.Spring(k)
    if kind == "rigid":
        return sb.Rigid(draw(st.one_of(st.just(1.0), st.floats(0.55, 1.0))))
    exponent = draw(st.sampled_from([1.0, 1.0, 1.5]))
    if kind == "power":
        return draw(st.sampled_from([sb.Hertz(k), sb.PowerLaw(k, exponent), sb.PowerLaw(k, 2.5)]))
    if kind == "damped":
        loss = draw(powers(-3, 0.7))
        damped = [
            sb.Dashpot(k, loss),
            sb.Viscoelastic(k, loss),
            sb.HuntCrossley(k, exponent, loss),
            sb.StandardLinearSolid(k, loss, draw(powers(-1.5, 1.5))),
        ]
        return draw(st.sampled_from(damped))
    return sb.Hysteretic(k, exponent=exponent, restitution=draw(st.floats(0.4, 1.0)))


@st.composite
def drops(draw, kinds=("spring",), largest=4):
    size = draw(st.integers(1, largest))
    kind = draw(st.sampled_from(kinds))
    finite = ["spring", "hysteretic", "power", "damped"] if kind == "mixed" else [kind]
    contacts = [draw(laws(draw(st.sampled_from(finite)))) for _ in range(size)]
    gaps = [draw(st.one_of(st.just(0.0), st.floats(0.01, 3.0))) for _ in range(size - 1)]
    masses = [draw(powers(-1, 1)) for _ in range(size)]
    if draw(st.booleans()):
        return sb.Drop([sb.Ball(m) for m in masses], contacts, gaps, impact_speed=1.0)
    upper = st.floats(-2.0, 0.5, allow_subnormal=False)  # else digits are lost in the scaling
    velocities = [-1.0, *[draw(upper) for _ in masses[1:]]]
    return sb.Drop([sb.Ball(m) for m in masses], contacts, gaps, velocities=velocities)


EVERY = ("spring", "mixed", "hysteretic", "power", "damped", "rigid")
FINITE = EVERY[:-1]


def scaled(drop, *, mass=1.0, stiffness=1.0, speed=1.0, gap=1.0):
    """Return the drop with its masses, stiffnesses, speeds and gaps multiplied."""
    factors = {"stiffness": stiffness, "damping": stiffness, "dissipation": 1.0 / speed}
    contacts = []
    for law in drop.contacts:
        known = {field.name: getattr(law, field.name) for field in fields(law) if field.init}
        if isinstance(law, sb.Hysteretic):
            known[law.derived] = None
        new = {name: value * factors[name] for name, value in known.items() if name in factors}
        contacts.append(type(law)(**(known | new)))
    return sb.Drop(
        [sb.Ball(ball.mass * mass) for ball in drop.balls],
        contacts,
        [x * gap for x in drop.gaps],
        velocities=[v * speed for v in drop.start_velocities],
    )


def assert_identical(one, other, *, time=1.0, speed=1.0, force=1.0, length=1.0, impulse=1.0):
    """Compare two results bit by bit, after multiplication by powers of two."""
    assert one.status is other.status
    assert (one.rebound_speeds * speed).tolist() == other.rebound_speeds.tolist()
    assert one.collisions.tolist() == other.collisions.tolist()
    factors = {
        "contact": 1,
        "start": time,
        "end": time,
        "peak_force": force,
        "peak_compression": length,
        "impulse": impulse,
    }
    for name, factor in factors.items():
        assert (one.intervals[name] * factor).tolist() == other.intervals[name].tolist()


@given(drops(EVERY))
def test_momentum(drop):
    """The change of every ball's momentum is the impulse from below less the one from above."""
    result = simulate(drop)
    mass = masses_of(drop)
    if (result.collisions < 0).any():
        return  # infinitely many impulses, of which the first ones are listed
    impulse = np.array([of_contact(result, i)["impulse"].sum() for i in range(len(mass))])
    change = mass * (result.rebound_speeds - drop.start_velocities)
    scale = mass.sum() * drop.reference_speed * max(1, len(result.intervals))
    assert impulse - np.append(impulse[1:], 0.0) == pytest.approx(change, abs=MOMENTUM * scale)
    assert change.sum() == pytest.approx(impulse[0], abs=MOMENTUM * scale)
    assert (result.intervals["impulse"] > 0.0).all()


@given(drops(EVERY))
def test_nothing_is_wrong(drop):
    """Energy never rises, and a run ends when nothing approaches: as the fuzz looks at it."""
    result = simulate(drop)
    assert result.status in (sb.Status.FINISHED, sb.Status.COLLAPSED)
    assert faults_of(result, STOPS) == []


@given(drops(("spring", "power")))
def test_energy_is_kept_without_losses(drop):
    result = simulate(drop)
    assert result.energy_retained == pytest.approx(1.0, abs=ENERGY)
    energy = result.sample(np.linspace(0.0, 1.2 * result.end_time + 0.1, 80)).energy.values
    assert energy == pytest.approx(energy[0], rel=ENERGY)


@given(drops(EVERY), st.floats(0.01, 100.0))
def test_speed_scales(drop, factor):
    """All speeds scale with v0, the times stay, where forces are linear and gaps scale too."""
    if any(getattr(law, "exponent", 1.0) != 1.0 for law in drop.contacts):
        return
    one, other = simulate(drop), simulate(scaled(drop, speed=factor, gap=factor))
    assert one.collisions.tolist() == other.collisions.tolist()
    assert one.rebound_speeds * factor == pytest.approx(other.rebound_speeds, abs=1e-9 * factor)
    for name in ("start", "end"):
        assert one.intervals[name] == pytest.approx(other.intervals[name], rel=1e-7, abs=1e-7)


SCALED = {  # powers of f by which numbers of a drop, and then those of its result, are multiplied
    "speed": ({"speed": 1, "gap": 1}, {"speed": 1, "force": 1, "length": 1, "impulse": 1}),
    "mass and stiffness": ({"mass": 1, "stiffness": 1}, {"force": 1, "impulse": 1}),
    "mass": ({"mass": 2, "gap": 1}, {"time": 1, "force": 1, "length": 1, "impulse": 2}),
}


@pytest.mark.parametrize("name", SCALED)
@given(drop=drops(("spring", "rigid")), power=st.integers(-3, 6))
def test_powers_of_two_change_no_bit(name, drop, power):
    changed, found = (
        {key: 2.0 ** (power * times) for key, times in factors.items()} for factors in SCALED[name]
    )
    one, other = simulate(drop), simulate(scaled(drop, **changed))
    if one.status is sb.Status.COLLAPSED and "gap" in changed:  # gaps shrink until they underflow
        assert other.status is sb.Status.COLLAPSED
        expected = one.rebound_speeds * found.get("speed", 1.0)
        assert other.rebound_speeds.tolist() == expected.tolist()
    else:
        assert_identical(one, other, **found)


@given(drops(EVERY, largest=3))
@pytest.mark.slow
def test_sample_agrees_with_the_result(drop):
    result = simulate(drop)
    before = result.intervals.tolist()
    # a sequence of collisions at one time has its last velocities just after it
    end = result.end_time * (1 + 1e-12) + (1e-300 if drop.rigid else 0.0)
    sample = result.sample([0.0, end, end + 1.0])
    speed = drop.reference_speed
    if not drop.rigid:
        assert sample.velocity.isel(time=0).values.tolist() == list(drop.start_velocities)
    for at in (1, 2):
        assert sample.velocity.isel(time=at).values == pytest.approx(
            result.rebound_speeds, abs=1e-11 * speed
        )
    heights = np.concatenate([[0.0], np.cumsum(drop.gaps)])
    assert sample.position.isel(time=0).values == pytest.approx(heights, abs=1e-15)
    flown = sample.position.isel(time=2) - sample.position.isel(time=1)
    assert flown.values == pytest.approx(result.rebound_speeds, abs=1e-9)
    if not drop.rigid:
        assert (sample.force.isel(time=2) == 0.0).all()
    assert result.intervals.tolist() == before
    assert_identical(result, simulate(drop))


@given(drops(FINITE, largest=3), st.lists(st.floats(0.0, 1.0), min_size=1, max_size=6))
@pytest.mark.slow
def test_sampling_elsewhere_changes_nothing(drop, fractions):
    result = simulate(drop)
    times = np.array(fractions) * result.end_time
    alone = [result.sample([t]) for t in times]
    together = result.sample(times)
    for index, sample in enumerate(alone):
        for name in ("position", "velocity", "force", "compression"):
            assert sample[name].values[:, 0].tolist() == together[name].values[:, index].tolist()


@given(drops(FINITE, largest=3), st.floats(0.05, 1.2))
def test_split_run_equals_the_whole(drop, fraction):
    """Stopped at a time, a run has the whole one's velocities and events up to then."""
    whole = simulate(drop)
    stop = fraction * whole.end_time
    part = simulate(drop, until=stop)
    here = whole.sample([stop]).velocity.values[:, 0]
    if fraction < 1:
        assert part.status is sb.Status.TIME_REACHED
        assert part.rebound_speeds == pytest.approx(here, abs=1e-12 * drop.reference_speed)
    else:
        assert part.rebound_speeds == pytest.approx(whole.rebound_speeds, abs=1e-12)
    earlier = whole.events[whole.events["time"] < stop].tolist()
    # A release is not known before the compression is gone, because the force may come back.
    still = whole.sample([stop]).compression.values[:, 0] > 0.0
    last = {event[1]: event for event in earlier}
    open_ended = [e for e in last.values() if still[e[1]] and e[2] == "release"]
    # One whose force relaxes is left while it is compressed, and its release can be known at once.
    relaxing = [isinstance(law, sb.StandardLinearSolid) for law in drop.contacts]
    known = part.events[part.events["time"] < stop].tolist()
    assert known == [
        event
        for event in earlier
        if event not in open_ended or (relaxing[event[1]] and event in known)
    ]
    unfinished = part.intervals[np.isinf(part.intervals["end"])]
    unknown = {event[1] for event in open_ended if event not in known}
    assert unknown <= set(unfinished["contact"].tolist())
