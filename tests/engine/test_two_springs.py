"""Two balls on springs in lock step: against the general engine and the thirty-digit reference."""

import functools
import json
from pathlib import Path

import numpy as np
import pytest
from benchmarks import random_drops

import stackbounce as sb
from batches import bits, in_lanes, numbers_of, pairs, swept
from fuzz.draw import balls_of, drops_of, is_rigid
from fuzz.replay import drop_of, options_of
from reference import precise
from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, RIGID, lane_workspace
from stackbounce.engine.records import Drops
from stackbounce.engine.two_springs import run_two_springs
from stackbounce.run.batch import new_outcomes
from stackbounce.run.options import Options

SPEED = 1e-12
TIME = 1e-11
ENERGY = 1e-12
NAMES = ("rebound_ratio", "collisions", "first_touch", "last_release", "status")


def solve(mass, stiffness, gap, speed, *, plain=False, event_limit=10**6):
    n, table = len(gap), (len(gap), 2)
    law = np.array(stiffness, order="C"), np.ones(table), np.zeros(table), np.zeros(table)
    motion = np.column_stack([np.zeros(n), gap]), -np.column_stack([speed, speed]), np.zeros(n)
    drops = Drops(np.array(mass, order="C"), np.full(table, codes.POWER), *law, *motion)
    if plain:
        out = new_outcomes(n, 2)
        with np.errstate(all="ignore"):
            run_two_springs(drops, event_limit, out, lane_workspace(compiled=False))
    else:
        out = in_lanes("run_two_springs", drops, event_limit)
    found = {name: getattr(out, name) for name in NAMES}
    found["energy"] = (mass * out.rebound_ratio**2).sum(axis=1) / np.sum(mass, axis=1)
    return found


def log_uniform(random, low, high, n):
    return low * (high / low) ** random.random(n)


def sweep(n, seed):
    """Mass ratios 0.05 to 50, stiffness ratios 0.02 to 50, half of the gaps up to 2 v0/omega."""
    random = np.random.default_rng(seed)
    lower, floor = log_uniform(random, 0.01, 1.0, n), log_uniform(random, 1e3, 1e5, n)
    mass = np.stack([lower, lower / log_uniform(random, 0.05, 50.0, n)], axis=1)
    stiffness = np.stack([floor, floor / log_uniform(random, 0.02, 50.0, n)], axis=1)
    speed = log_uniform(random, 0.1, 10.0, n)
    reach = 2.0 * random.random(n) * (random.random(n) < 0.5)
    return mass, stiffness, reach * speed * np.sqrt(lower / floor), speed


def compare(drops, out, loose=1.0):
    """Compare with the general engine; return how many drops were left to it."""
    left = 0
    for r, (mass, stiffness, gap, speed) in enumerate(zip(*drops, strict=True)):
        if out["status"][r] == codes.ASK:
            left += 1
            continue
        assert out["status"][r] == codes.FINISHED
        balls, springs = [sb.Ball(m) for m in mass], [sb.Spring(k) for k in stiffness]
        result = sb.simulate(sb.Drop(balls, springs, [gap], impact_speed=speed))
        assert out["collisions"][r].tolist() == result.collisions.tolist()
        most = loose * SPEED * max(1.0, np.sqrt(mass[1] / mass[0]))
        assert np.abs(out["rebound_ratio"][r] - result.rebound_ratios).max() <= most
        assert abs(out["energy"][r] - 1.0) <= ENERGY
        for i in (0, 1):
            mine = result.intervals[result.intervals["contact"] == i]
            found = np.array([out["first_touch"][r, i], out["last_release"][r, i]])
            if not len(mine):
                assert np.isnan(found).all()
                continue
            expected = np.array([mine["start"].min(), mine["end"].max()])
            unit = np.sqrt(mass[0] / stiffness[0])
            near = loose * TIME * (unit + flight(result))
            if (np.abs(found - expected) > near).any():  # which of the two is it?
                expected = to_thirty_digits(mass, stiffness, gap, speed, i)
            assert (np.abs(found - expected) <= near).all()
    return left


def to_thirty_digits(mass, stiffness, gap, speed, contact):
    springs = [{"law": "Spring", "stiffness": k} for k in stiffness.tolist()]
    run = precise.run(mass.tolist(), springs, [float(gap)], [-float(speed)] * 2)
    mine = [interval for interval in run.intervals if interval.contact == contact]
    return np.array([float(mine[0].start), float(mine[-1].end)])


def flight(result):
    """Return how long the balls fly apart, which a rounding error of slow speeds changes much."""
    times = np.sort(result.intervals, order="start")
    longest = np.maximum(times["start"][1:] - np.maximum.accumulate(times["end"])[:-1], 0.0)
    return 100.0 * longest.max(initial=0.0)


@pytest.mark.parametrize("count", [200, pytest.param(2000, marks=pytest.mark.slow)])
def test_random_drops(count):
    drops = sweep(count, 1)
    assert compare(drops, solve(*drops)) <= count / 200


def test_a_million_events_keep_energy():
    out = solve(*sweep(200_000, 2))
    done = out["status"] == codes.FINISHED
    assert set(out["status"]) <= {codes.FINISHED, codes.ASK}
    assert done.mean() > 0.999
    assert np.abs(out["energy"][done] - 1.0).max() <= ENERGY


@pytest.mark.slow
@pytest.mark.parametrize(("offset", "most"), [(1e-4, 0.2), (1e-7, 0.7), (1e-10, 1.0)])
def test_where_the_number_of_contacts_changes(offset, most):
    hard = random_drops.hard(25, seed=3)[offset]
    drops = hard.masses, hard.stiffnesses, hard.gaps, np.ones(len(hard))
    left = compare(drops, solve(*drops), loose=4.0)  # up to twelve contacts: errors grow
    assert left <= most * len(hard)


def test_units_change_no_bit():
    mass, stiffness, gap, speed = sweep(2000, 4)
    one = solve(mass, stiffness, gap, speed)
    kg, m, s = 2.0**-5, 2.0**7, 2.0**-9
    other = solve(mass * kg, stiffness * kg / s**2, gap * m, speed * m / s)
    other["first_touch"] /= s
    other["last_release"] /= s
    for name in NAMES:
        assert one[name].tobytes() == other[name].tobytes(), name


@pytest.mark.parametrize(
    ("ratio", "softness", "gap"),
    [
        *((m, k, g) for m in (1e-12, 1.0, 1e12) for k in (1e-8, 1.0, 1e8) for g in (0.0, 0.5)),
        *((2.0, 3.0, g) for g in (1e-300, 1e-15, 1e-12, 1e-9, 1e-6, 1e6)),
        (3.0, 1.0, np.pi),  # the lower ball stops
        (1.0, 1.0, np.pi),
        *((m, k, g) for m in (5e-3, 200.0) for k in (5e-3, 200.0) for g in (0.0, 1e-3, 0.9, 500.0)),
    ],
)
def test_extremes_are_right_or_left_to_the_general_engine(ratio, softness, gap):
    drops = (
        np.array([[1.0, 1.0 / ratio]]),
        np.array([[1.0, 1.0 / softness]]),
        np.array([gap]),
        np.ones(1),
    )
    compare(drops, solve(*drops), loose=10.0)  # up to forty contacts: errors grow


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -1.0, 0.0])
@pytest.mark.parametrize("which", range(6))
@pytest.mark.parametrize("plain", [False, True])
def test_what_is_no_drop_is_invalid(wrong, which, plain):
    values = [1.0, 0.5, 1.0, 0.3, 0.2, 1.0]
    good = list(values)
    values[which] = wrong
    rows = np.array([values, good])
    out = solve(rows[:, :2], rows[:, 2:4], rows[:, 4], rows[:, 5], plain=plain)
    zero_gap = which == 4 and wrong == 0.0
    assert out["status"].tolist() == [codes.FINISHED if zero_gap else codes.INVALID, codes.FINISHED]
    assert np.isnan(out["rebound_ratio"][0]).all() == (not zero_gap)


def test_event_limit():
    drops = sweep(50, 8)
    full = solve(*drops)
    out = solve(*drops, event_limit=5)
    events = 2 * full["collisions"].sum(axis=1)
    assert (out["status"] == np.where(events > 5, codes.EVENT_LIMIT, codes.FINISHED)).all()


# --- plain Python, and the compiled code of every processor level: the same bits of random drops
SEED = 11
BATCHES = [batch for batch in range(50) if balls_of(batch) > 1]  # of 2 to 6 balls
EVENTS = 100  # at most
TIMES = 20  # of samples
EACH = 500  # drops of a batch that the processor levels are given


def everything(result, sampled=True):
    """Return the bits of all that is known of a run: its log, its end, and samples if asked for."""
    known = [result.status, result.end_time, result.rebound_speeds, result._rows]
    if sampled and np.isfinite(result.end_time) and result.end_time > 0.0:
        sample = result.sample(np.linspace(0.0, result.end_time, TIMES))
        known += [sample[name].values for name in sample.data_vars]
    return list(map(bits, known))


TABLE = [0.0, 0.01, 0.03, 0.1], [0.0, 0.5, 2.5, 9.0]
SCATTERS = sb.RigidLossBySpeed(0.8, 3.0, 0.2, scatter=0.05, seed=3.0)
SPECIAL = {  # contacts that `fuzz.draw` does not draw, masses, gravity
    "hollow": ([sb.HollowBall(100.0, 0.05, 0.3, 0.8)] * 2, [1.0, 3.0], 0.0),
    "tables": (
        [sb.Tabulated(*TABLE, [0.0, 0.0, 0.7, 9.0]), sb.Tabulated(*TABLE, restitution=0.6)],
        [1.0, 3.0],
        0.0,
    ),
    "bond": ([sb.Spring(300.0), sb.Bond(2e3, 1.0), sb.Spring(100.0)], [0.5, 0.5, 0.1], 0.0),
    "plate": ([sb.Bond(4e3, 2.0), sb.Spring(900.0)], [1.0, 2.0], 9.81),
    "by speed": ([sb.RigidBySpeed(0.7, 1.0), SCATTERS, sb.Rigid(0.9)], [1.0, 0.5, 2.0], 9.81),
    "scatter": ([SCATTERS] * 3, [1.0, 0.5, 2.0], 0.0),
    "collapse": ([sb.Rigid(0.5)] * 2, [1.0, 7.999], 0.0),
    "joined": ([sb.Rigid(e) for e in (1.0, 0.95, 0.1)], [6.0, 0.3, 1.5], 1.0),
    "cradle": ([None] + [sb.Spring(1.0)] * 5, [1.0] * 6, 0.0),
}


@pytest.mark.parametrize("options", [{}, {"until": 0.7}, {"event_limit": 3}], ids=str)
@pytest.mark.parametrize("name", SPECIAL)
def test_plain_python_and_compiled_code_of_special_stacks(name, options):
    laws, masses, gravity = SPECIAL[name]
    gaps = [0.0 if isinstance(law, sb.Bond) else 0.01 for law in laws[1:]]
    velocities = [-1.0] * (len(laws) - 1) + [-2.0]
    balls = [sb.Ball(mass) for mass in masses]
    drop = sb.Drop(balls, laws, gaps, velocities=velocities, gravity=gravity)
    options = {"event_limit": EVENTS} | options
    plain, compiled = (
        everything(sb.simulate(drop, **options, compiled=way)) for way in (False, True)
    )
    assert plain == compiled


@pytest.mark.parametrize(
    "drops", [100, pytest.param(250, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_plain_python_and_compiled_code(drops):
    share = drops // len(BATCHES)
    for batch in BATCHES:
        drawn = drops_of(SEED, batch, share)
        for row in range(share):
            drop, options = drop_of(drawn, row), options_of(drawn, row)
            options["event_limit"] = min(options["event_limit"], EVENTS)
            one, other = (
                everything(sb.simulate(drop, **options, compiled=way), sampled=row % 4 == 0)
                for way in (False, True)
            )
            assert one == other, (batch, row)


def levels():
    """Return the processor levels of this machine's library that its processor can run."""
    library = native._library()
    manifest = json.loads((Path(native.FOLDER) / native.MANIFEST).read_text("utf-8"))
    known = manifest["libraries"][native.platform_name()]["levels"]
    return [level for level in known if level <= library.level], library


@pytest.fixture
def at_level(monkeypatch):
    """Let one level be chosen."""

    def choose(library, level):
        monkeypatch.setattr(native, "_library", lambda: library._replace(level=level))
        native.compiled.cache_clear()

    yield choose
    native.compiled.cache_clear()


@functools.cache
def batches():
    """Return ten thousand random drops as kernels take them, and how precisely to run them."""
    return [
        (RIGID if is_rigid(batch) else FINITE, numbers_of(drops_of(SEED, batch, EACH)))
        for batch in BATCHES[: 10_000 // EACH]
    ]


def outcomes():
    """Return the bits of all outcomes of the drops of `batches`, by the level that is chosen."""
    found, statuses = [], set()
    for engine, drops in batches():
        out = swept(engine, drops, Options(np.inf, 1e-6, EVENTS))
        found.append([bits(array) for array in out])
        statuses |= set(out.status.tolist())
    assert sb.Status.FINISHED in statuses
    return found


def two_balls():
    """Return the bits of the outcomes of two balls by the engines in lanes."""
    drops = numbers_of(drops_of(SEED, 0, 10_000))
    drops = drops._replace(velocity=np.repeat(-np.abs(drops.velocity[:, :1]), 2, axis=1))
    found = []
    for entry, some, limit in (
        ("run_two_springs", drops, 10_000),
        ("run_pairs", pairs(2000, SEED), 1e-6),
        ("run_linear", pairs(2000, SEED, forms=codes.LINEAR_FORMS), 10_000),
    ):
        out = in_lanes(entry, some, limit)
        done = out.status == sb.Status.FINISHED
        assert done.any()
        found += [bits(array[done]) for array in out] + [bits(out.status)]
    return found


@pytest.mark.slow
def test_processor_levels(at_level):
    known, library = levels()
    if len(known) < 2:
        pytest.skip("the library of this machine has one level")
    by_level = []
    for level in known:
        at_level(library, level)
        by_level.append((outcomes(), two_balls()))
    assert all(found == by_level[0] for found in by_level)
