"""The cases of `reference` as drops of stackbounce, and what the tests compare."""

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from mpmath import mpf

import stackbounce as sb
from reference import falling, restitution
from reference import rigid as rigid_reference

INTERVAL = ["contact", "start", "end", "peak_force", "peak_compression", "impulse"]
STACK = sb.Drop(
    [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.5
)
"""The paper's tennis ball on a basketball, on springs."""


def drop_of(case: Mapping[str, Any]) -> sb.Drop:
    """Return the drop of a case of the data files."""
    contacts = []
    for law in case["contacts"]:
        numbers = dict(law or {})
        contacts.append(getattr(sb, numbers.pop("law"))(**numbers) if law else None)
    return sb.Drop(
        [sb.Ball(mass) for mass in case["masses"]],
        contacts,
        case["gaps"],
        velocities=case["velocities"],
        gravity=case.get("gravity", 0.0),
    )


def interval_table(rows: Sequence[Sequence[Any]]) -> np.ndarray:
    """Return intervals in order of contact and start; nan for an end that is open."""
    rows = sorted(tuple(math.nan if x is None else float(x) for x in row) for row in rows)
    out = np.array(rows).reshape(-1, len(INTERVAL))
    out[~np.isfinite(out)] = math.nan
    return out


def table_of(result: sb.Result) -> np.ndarray:
    """Return the intervals of a result as `interval_table` does."""
    return interval_table(result.intervals[INTERVAL].tolist())


def compared(row: Mapping[str, Any], result: sb.Result, precision: float) -> list[np.ndarray]:
    """Compare speeds and counts with a row of a data file; return both tables of intervals."""
    expected = interval_table(row["intervals"])
    counts = np.bincount(expected[:, 0].astype(int), minlength=len(result.drop.balls))
    assert result.collisions.tolist() == counts.tolist()
    error = np.abs(result.rebound_speeds - row["rebound_speeds"])
    assert error.max() <= precision * result.drop.reference_speed
    return [table_of(result), expected]


def every_law(stiffness):
    """Return one contact of each finite law, for a ball of 1 kg at 1 m/s."""
    return {
        "Spring": sb.Spring(stiffness),
        "Hertz": sb.Hertz(stiffness),
        "PowerLaw": sb.PowerLaw(stiffness, 2.5),
        "Dashpot": sb.Dashpot(stiffness, 0.2 * stiffness**0.5),
        "Viscoelastic": sb.Viscoelastic(stiffness, 0.05),
        "HuntCrossley": sb.HuntCrossley(stiffness, 1.5, 0.2),
        "Hysteretic": sb.Hysteretic(stiffness, exponent=1.5, restitution=0.8),
    }


def one_ball(law, speed=1.0, mass=1.0):
    """Return the run of one ball on a contact."""
    return sb.simulate(sb.Drop([sb.Ball(mass)], [law], impact_speed=speed))


def springs(masses, stiffnesses, gaps=None, velocities=None):
    """Return a drop on springs, at speed 1 unless velocities are given; None: no floor."""
    return sb.Drop(
        balls=[sb.Ball(mass) for mass in masses],
        contacts=[None if k is None else sb.Spring(k) for k in stiffnesses],
        gaps=gaps,
        velocities=velocities or [-1.0] * len(masses),
    )


def rigid(masses, restitutions=1.0, gaps=None, velocities=None, gravity=0.0, **start):
    """Return a drop of rigid balls, at speed 1 unless something else is given; None: no floor."""
    if isinstance(restitutions, float):
        restitutions = [restitutions] * len(masses)
    return sb.Drop(
        balls=[sb.Ball(mass) for mass in masses],
        contacts=[None if e is None else sb.Rigid(e) for e in restitutions],
        gaps=gaps,
        gravity=gravity,
        **(start or {"velocities": velocities or [-1.0] * len(masses)}),
    )


def masses_of(drop: sb.Drop) -> np.ndarray:
    return np.array([ball.mass for ball in drop.balls])


def of_contact(result: sb.Result, index: int) -> np.ndarray:
    return result.intervals[result.intervals["contact"] == index]


def restitution_of(law, contact, number=mpf):
    """Return the restitution of a rigid law, where it changes as a function of the speed."""
    if law is None or type(law) is sb.Rigid:
        return law and number(law.restitution)
    make = {
        sb.RigidBySpeed: restitution.falling_power,
        sb.RigidLossBySpeed: restitution.loss_power,
    }[type(law)]
    mean = make(law.restitution, law.speed, law.speed_exponent)
    return restitution.scattered(mean, law.scatter, law.seed, contact) if law.scatter else mean


def precise(drop, limit=100_000, number=mpf):
    """Return the solution of a drop of rigid balls to fifty digits."""
    return rigid_reference.run(
        [number(ball.mass) for ball in drop.balls],
        [restitution_of(law, i, number) for i, law in enumerate(drop.contacts)],
        [number(gap) for gap in drop.gaps],
        [number(v) for v in drop.start_velocities],
        limit,
    )


def exact(drop, limit=2000):
    """Return the exact solution of a drop of rigid balls."""
    return precise(drop, limit, Fraction)


def fallen(drop, until):
    """Return the solution of rigid balls under gravity to fifty digits, and the last heights."""
    collisions, heights, velocities = falling.fall(
        [ball.mass for ball in drop.balls],
        [restitution_of(law, i) for i, law in enumerate(drop.contacts)],
        drop.gaps,
        drop.start_velocities,
        drop.gravity,
        until,
    )
    return rigid_reference.RigidOutcome(velocities, collisions, True), heights


def assert_collisions(result, expected, precision=1e-11):
    """Compare collisions, their times, and the velocities after each and at the end."""
    scale = precision * result.drop.reference_speed
    assert result.events["contact"].tolist() == [c.contact for c in expected.collisions]
    for name, field in (("lower_velocity", "lower"), ("upper_velocity", "upper")):
        values = np.array([float(getattr(c, field)) for c in expected.collisions])
        assert np.abs(result.events[name] - values).max(initial=0.0) <= scale
    times = np.array([float(c.time) for c in expected.collisions])
    late = precision * times.max(initial=0.0)
    assert np.abs(result.events["time"] - times).max(initial=0.0) <= late
    assert np.abs(result.rebound_speeds - [float(v) for v in expected.velocities]).max() <= scale
