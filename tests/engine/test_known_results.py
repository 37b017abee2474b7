"""Known results: limits in which the models agree, rows of balls, continuity, thirty digits."""

import functools
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.special import jn_zeros, jv

import stackbounce as sb
from drops import compared, drop_of, rigid, springs
from reference import data, precise

PRECISION = 1e-11


def overlapping(result):
    """Return whether two contacts were closed at one time."""
    rows = result.intervals
    return bool((rows["start"][1:] < np.maximum.accumulate(rows["end"])[:-1]).any())


@given(
    masses=st.lists(st.floats(-1, 1).map(lambda x: 10**x), min_size=1, max_size=4),
    stiffness=st.floats(0.2, 5.0),
    gap=st.floats(3.0, 50.0),
)
@example(masses=[1.0, 1.000000002302585], stiffness=3.0, gap=10.0)  # a touch 2e9 times later
def test_disjoint_contacts_meet_rigid_collisions(masses, stiffness, gap):
    """Where no two springs are compressed at one time, each contact is a collision with e = 1."""
    gaps = [gap * (i + 1) ** 2 for i in range(len(masses) - 1)]
    soft = sb.simulate(springs(masses, [stiffness**i for i in range(len(masses))], gaps))
    if overlapping(soft):
        return
    hard = sb.simulate(rigid(masses, gaps=gaps))
    if soft.intervals["contact"].tolist() != hard.intervals["contact"].tolist():
        return  # contacts that last change who comes first
    assert soft.rebound_ratios == pytest.approx(hard.rebound_ratios, abs=PRECISION)
    assert soft.intervals["impulse"] == pytest.approx(hard.intervals["impulse"], rel=1e-9)


@pytest.mark.parametrize("gap", [20.0, 20.5, 33.0])
def test_tie_at_the_end_on_springs(gap):
    """m2/m1 = 3, wide gap: five contacts, then both leave with v1 = v2 = 1."""
    result = sb.simulate(springs([1.0, 3.0], [1.0, 1.0], [gap]))
    assert result.collisions.tolist() == [3, 2]
    assert result.rebound_ratios == pytest.approx([1.0, 1.0], abs=PRECISION)
    assert result.status is sb.Status.FINISHED


# --- rows of equal balls, of which the first strikes the others: known results
# The page on towers shows how a cradle breaks up, and the solitary wave of a long chain.
LAWS = {"Spring": sb.Spring(1.0), "Hertz": sb.Hertz(1.0)}
finite = pytest.mark.parametrize("law", LAWS)


@functools.cache
def row(law, count):
    """Return the run of a row of balls of mass 1, the first of which has speed 1."""
    contacts, velocities = [None] + [LAWS[law]] * (count - 1), [1.0] + [0.0] * (count - 1)
    return sb.simulate(sb.Drop([sb.Ball(1.0)] * count, contacts, velocities=velocities))


@pytest.mark.slow
@finite
def test_cradle_against_thirty_digits(law):
    contact = {"law": law, "stiffness": 1}
    exact = precise.run([1] * 5, [None] + [contact] * 4, [0] * 4, [1, 0, 0, 0, 0])
    result = row(law, 5)
    assert result.collisions.tolist() == exact.counts(5) == [0, 1, 1, 1, 1]
    assert result.rebound_speeds == pytest.approx([float(v) for v in exact.velocities], abs=1e-11)
    ends = sorted(float(interval.end) for interval in exact.intervals)
    assert sorted(result.intervals["end"]) == pytest.approx(ends, rel=1e-10)


@finite
@pytest.mark.parametrize("count", [5, 30, 300, 1000])
def test_momentum_and_energy_are_kept(law, count):
    result = row(law, count)
    assert result.status is sb.Status.FINISHED
    assert result.collisions.tolist() == [0] + [1] * (count - 1)
    assert (result.intervals["start"] == 0.0).all()
    assert math.fsum(result.rebound_speeds) == pytest.approx(1.0, abs=1e-12)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-11)


def test_spring_row_is_bessel_functions_until_it_breaks():
    """v_n = J_2n(2t) + J_2n+2(2t), so that a force is 4n J_2n(2t) / (2t), until J_2 is 0."""
    result, n = row("Spring", 40), np.arange(40)
    release = 0.5 * jn_zeros(2, 1)[0]
    assert result.intervals["end"].min() == pytest.approx(release, rel=1e-12)
    times = np.linspace(0.1, release, 9)
    found = result.sample(times)
    for j, t in enumerate(times):
        velocities = jv(2 * n, 2 * t) + jv(2 * n + 2, 2 * t)
        assert found.velocity.values[:, j] == pytest.approx(velocities, abs=1e-13)
        forces = 2 * n[1:] * jv(2 * n[1:], 2 * t) / t
        assert found.force.values[1:, j] == pytest.approx(forces, abs=1e-13)


# --- what balls do is a continuous function of gap, mass and speed, also where a count changes
MASSES = 0.0248, 0.101  # superballs B2 and, on it, B1: contacts reload several times
CONTACTS = {
    "Hysteretic": (sb.Hysteretic(3.6e4, restitution=0.78), sb.Hysteretic(2.2e4, restitution=0.9)),
    "Hysteretic, Hertz loading": (
        sb.Hysteretic(1e6, exponent=1.5, restitution=0.78),
        sb.Hysteretic(6e5, exponent=1.5, restitution=0.9),
    ),
    "Hysteretic, great loss": (
        sb.Hysteretic(3.6e4, restitution=0.3),
        sb.Hysteretic(2.2e4, restitution=0.2),
    ),
    "HollowBall": (sb.HollowBall(6e4, 1e-4, 0.3, 0.8), sb.HollowBall(4e4, 2e-4, 0.1, 0.95)),
    "Tabulated": (
        sb.Tabulated([0.0, 5e-4, 1e-3, 2e-3], [0.0, 9.0, 30.0, 80.0], [0.0, 4.0, 21.0, 80.0]),
        sb.Tabulated([0.0, 5e-4, 1e-3, 2e-3], [0.0, 15.0, 22.0, 50.0], restitution=0.85),
    ),
    "Spring": (sb.Spring(3.6e4), sb.Spring(2.2e4)),
    "Dashpot": (sb.Dashpot(3.6e4, 5.0), sb.Dashpot(2.2e4, 2.0)),
    "PowerLaw": (sb.PowerLaw(2e5, 1.3), sb.PowerLaw(1e5, 1.3)),
    "Hertz": (sb.Hertz(1e6), sb.Hertz(6e5)),
    "Viscoelastic": (sb.Viscoelastic(1e6, 1e-4), sb.Viscoelastic(6e5, 5e-5)),
    "HuntCrossley": (sb.HuntCrossley(1e6, 1.5, 0.2), sb.HuntCrossley(6e5, 1.5, 0.1)),
    "StandardLinearSolid": (
        sb.StandardLinearSolid(3e4, 0.6, 5e-4),
        sb.StandardLinearSolid(2e4, 0.4, 1e-3),
    ),
}
AXES = {
    "gaps.0": np.linspace(0.0, 8e-3, 3_000),
    "balls.1.mass": np.geomspace(0.005, 1.0, 3_000),
    "impact_speed": np.geomspace(0.1, 10.0, 3_000),
}
SUSPECTS = 6  # steps between neighbours that are looked at closely
FINEST = 1e-15  # of a value
JUMP = 1e-8


def outcomes(contacts, axis, values):
    """Return the rebound ratios at each value, and the number of collisions."""
    balls = [sb.Ball(mass) for mass in MASSES]
    found = sb.sweep(sb.Drop(balls, contacts, gaps=[2e-3], impact_speed=1.98), {axis: values})
    assert (found.status == sb.Status.FINISHED).all()
    return (
        found.rebound_ratio.transpose(..., "ball").values,
        found.collisions.transpose(..., "contact").values,
    )


def closed_in(contacts, axis, left, right, step):
    """Return the ends to which halving closes in on where ``step`` of the outcomes is largest."""
    while right - left > FINEST * right:
        inner = np.linspace(left, right, 9)
        if not (np.diff(inner) > 0.0).all():
            break
        j = int(np.argmax(step(*outcomes(contacts, axis, inner))))
        left, right = inner[j], inner[j + 1]
    return np.array([left, right])


def bends(ratios, _):
    return np.abs(np.diff(ratios, axis=0)).max(axis=1)


def changes(_, counts):
    return np.abs(np.diff(counts, axis=0)).max(axis=1)


def jumps(contacts, axis, values):
    """Return the jumps of the ratios where they bend most, and where a count changes."""
    ratios, counts = outcomes(contacts, axis, values)
    third = np.abs(np.diff(ratios, n=3, axis=0)).max(axis=1)
    places = [(k, k + 3, bends) for k in np.argsort(third)[-SUSPECTS:]]
    places += [(k, k + 1, changes) for k in np.flatnonzero(changes(ratios, counts))[:SUSPECTS]]
    ends = [closed_in(contacts, axis, values[i], values[j], step) for i, j, step in places]
    return [bends(*outcomes(contacts, axis, two))[0] for two in ends]


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("law", CONTACTS)
def test_what_balls_do_is_continuous(law, axis):
    assert max(jumps(CONTACTS[law], axis, AXES[axis])) < JUMP


# --- every finite law, pure and mixed, against the thirty-digit reference of `reference.precise`
ROWS = data.read("laws")
TOLERANCES = (1e-4, 1e-6, 1e-9, 1e-12, 1e-13)
ROUND_OFF = 1e-12  # of a time, below which the end of a creeping contact is not known
CREEPING = 1e-3  # of the speed before: of a slower contact the end is less exact


@pytest.mark.parametrize("rtol", TOLERANCES)
@pytest.mark.parametrize("index", range(len(ROWS)))
def test_error_is_below_ten_times_the_tolerance_asked_for(index, rtol):
    row = ROWS[index]
    drop = drop_of(row["case"])
    result = sb.simulate(drop, until=row["case"].get("until"), rtol=rtol, compiled=True)
    found, expected = compared(row, result, 10 * rtol)
    for column in (3, 4, 5):  # peaks and impulses, by the largest of them
        size = np.max(expected[:, column], initial=0.0)
        assert found[:, column] == pytest.approx(expected[:, column], abs=100 * rtol * size)
    # a time's error is that of a length over the speed there, which can be small
    time = max(rtol, ROUND_OFF) * row["end_time"]
    assert found[:, 1] == pytest.approx(expected[:, 1], abs=1e3 * time)
    if len(drop.balls) == 1 and abs(row["rebound_speeds"][0]) < CREEPING * drop.reference_speed:
        return
    assert found[:, 2] == pytest.approx(expected[:, 2], abs=1e3 * time, nan_ok=True)


@pytest.mark.parametrize("rtol", [1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("row", data.read("extreme"))
def test_errors_of_extreme_drops_are_those_that_their_conditioning_tells(row, rtol):
    drop = drop_of(row["case"])
    result, dataset = sb.simulate(drop, rtol=rtol), sb.sweep(drop, {"gaps.0": drop.gaps}, rtol=rtol)
    within = max(10.0 * rtol * max(1.0, result.conditioning.max()), PRECISION)
    ratios = pytest.approx(np.array(row["rebound_speeds"]) / drop.reference_speed, abs=within)
    assert result.rebound_ratios == ratios
    assert dataset.rebound_ratio.values[0] == ratios
    if rtol < 1e-9:
        assert result.collisions.tolist() == row["collisions"]
        assert dataset.collisions.values[0].tolist() == row["collisions"]
