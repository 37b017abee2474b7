"""Springs (eqs 5 and 6) against the thirty-digit reference and published values."""

import math
from itertools import product
from random import Random

import numpy as np
import pytest

import stackbounce as sb
from drops import compared, drop_of, interval_table, table_of
from reference import data

PRECISION = 1e-11
ENERGY = 1e-12
ROWS = data.read("springs")


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("row", ROWS, ids=range(len(ROWS)))
def test_reference(row):
    result = sb.simulate(drop_of(row["case"]))
    assert result.status is sb.Status.FINISHED
    found, expected = compared(row, result, PRECISION)
    assert abs(result.energy_retained - 1) <= ENERGY
    unit = np.sqrt(result.drop.balls[0].mass / result.drop.contacts[0].stiffness)
    scale = np.abs(expected)
    scale[:, 1:3] = np.maximum(scale[:, 1:3], unit)
    assert (np.abs(found - expected) <= PRECISION * scale).all()
    assert result.end_time == found[:, 2].max()


def test_gravity_one_ball():
    """With c'' = g - w**2 c a contact lasts 2 (pi - atan(v w / g)) / w, every flight 2 v / g."""
    gravity, speed, w = 9.8, 1.5, 100.0
    drop = sb.Drop([sb.Ball(2.0)], [sb.Spring(2.0 * w**2)], impact_speed=speed, gravity=gravity)
    contact = 2 * (np.pi - np.arctan(speed * w / gravity)) / w
    period = contact + 2 * speed / gravity
    result = sb.simulate(drop, until=4.5 * period)
    assert result.status is sb.Status.TIME_REACHED
    bounces = np.arange(5)
    assert result.intervals["start"] == pytest.approx(bounces * period, abs=PRECISION)
    assert result.intervals["end"][:4] == pytest.approx(bounces[:4] * period + contact, rel=1e-11)
    assert result.apexes["height"] == pytest.approx(speed**2 / (2 * gravity), rel=PRECISION)
    energy = result.sample(np.linspace(0.0, 4.5 * period, 400)).energy.values
    assert energy == pytest.approx(speed**2, rel=ENERGY)


# --- starts and ends of contacts are as exact as `docs/models.md` says, gentle ones too
# A start or an end is where a length passes through zero: the compression, or c + τ ċ where a
# force is cut off before the compression is gone. It is off by no more than `rtol`, times the
# conditioning (1 at least), times the distance that the balls go at the impact speed during the
# run, over the rate at which the length passes through zero.
TIMED_ROWS = data.read("laws")
DRAWN = TIMED_ROWS[46:-2]  # at random, of all laws
GENTLE = data.read("gentle")
ROUND_OFF = 4e-16  # of a time
CUT = 1e-6  # of the peak compression: above it a contact has ended because its force was cut off


def kept(drop, expected, fine, rtol, until):
    """Assert that the times of a run are as near to the expected ones as is promised."""
    found = table_of(sb.simulate(drop, until=until, rtol=rtol))
    assert found[:, 0].tolist() == expected[:, 0].tolist()
    error = rtol * max(1.0, fine.conditioning.max()) * drop.reference_speed
    ends = np.concatenate([expected[:, 1], expected[:, 2]])
    known = np.isfinite(ends)
    moments = fine.sample(np.minimum(np.where(known, ends, 0.0), fine.end_time))
    differences = np.abs(ends - np.concatenate([found[:, 1], found[:, 2]]))
    for k in np.flatnonzero(known):
        is_end, row = divmod(k, len(expected))
        contact, peak = int(expected[row, 0]), expected[row, 4]
        rate, change, compression = motion(drop, contact, moments.isel(time=k))
        lead = lead_of(drop.contacts[contact]) if is_end and compression > CUT * peak else 0.0
        off = differences[k] - ROUND_OFF * ends[k]
        if math.isinf(lead):  # 1 + χ ċ passes through zero
            assert off * abs(change) <= error
        else:
            assert off * abs(rate + lead * change) <= error * (fine.end_time + lead)


def motion(drop, contact, moment):
    """Return the first and the second derivative of a compression, and itself."""
    velocity, force = moment.velocity.values, np.append(moment.force.values, 0.0)
    mass = np.array([ball.mass for ball in drop.balls])
    acceleration = -np.diff(force) / mass - drop.gravity
    rate, change = (
        (x[contact - 1] if contact else 0.0) - x[contact] for x in (velocity, acceleration)
    )
    return rate, change, float(moment.compression.values[contact])


def lead_of(law):
    """Return τ, where a law's force is c + τ ċ times something; infinite where it is 1 + χ ċ."""
    if isinstance(law, sb.Dashpot):
        return law.damping / law.stiffness
    return 1.5 * law.dissipative_time if isinstance(law, sb.Viscoelastic) else math.inf


@pytest.mark.parametrize(
    ("row", "rtol"),
    [
        *product(TIMED_ROWS, (1e-6, 1e-12)),
        *product(GENTLE, (1e-8, 1e-12)),  # coarser ones may part what all but parts
    ],
)
def test_times_against_thirty_digits(row, rtol):
    drop, until = drop_of(row["case"]), row["case"].get("until")
    kept(drop, interval_table(row["intervals"]), exact_run(drop, until), rtol, until)


def exact_run(drop, until):
    return sb.simulate(drop, until=until, rtol=1e-14, event_limit=3000)


def varied(case, random):
    """Return a case with other masses, stiffnesses and gaps."""

    def other(number):
        return number * 10.0 ** random.uniform(-0.5, 0.5)

    contacts = [law and law | {"stiffness": other(law["stiffness"])} for law in case["contacts"]]
    masses, gaps = ([other(number) for number in case[name]] for name in ("masses", "gaps"))
    return case | {"masses": masses, "gaps": gaps, "contacts": contacts}


@pytest.mark.parametrize(
    "seed", [*range(4), *(pytest.param(k, marks=pytest.mark.slow) for k in range(4, 10))]
)
def test_times_of_random_stacks_against_a_finer_run(seed):
    random, compared = Random(seed), 0
    for _ in range(30):
        case, until = varied(random.choice(DRAWN)["case"], random), None
        if random.random() < 0.3:
            case["gravity"] = 10.0 ** random.uniform(-2.0, 1.0)
            until = 10.0 ** random.uniform(0.0, 1.5)
        drop = drop_of(case)
        fine = exact_run(drop, until)
        if fine.status in (sb.Status.FINISHED, sb.Status.TIME_REACHED):
            compared += 1
            for rtol in (1e-6, 1e-9, 1e-11):
                kept(drop, table_of(fine), fine, rtol, until)
    assert compared > 20
