"""The engine in a browser, here in node: the bits are those of this machine's library."""

import math
import shutil
import subprocess
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

import stackbounce as sb
from batches import bits, numbers_of, pairs, swept, swept_in_lanes
from fuzz import draw
from fuzz.replay import drop_of, options_of
from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, RIGID
from stackbounce.engine.records import Drops
from stackbounce.run.options import Options

SEED = 3
BATCHES = 12  # all heights that have rigid and finite batches, and a third rigid
SAMPLED = 4  # one drop in so many is looked at on its way
LIMIT = 300
SIMULATE, SWEEP, SPRINGS, PAIRS, LINEAR = range(5)
RUN = Path(__file__).with_name("run_engine.mjs")
ENGINE = files("stackbounce.explorer").joinpath("static/js/engine/engine.js")

pytestmark = pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")


def job(kind, drops, rigid, options, times=()):
    """Return the numbers that tell node what to run."""
    head = [kind, *drops.mass.shape, rigid, options.rtol, options.until, options.event_limit]
    return np.concatenate([[*head, len(times), *times], *map(np.ravel, drops)])


def simulated(drop, options, times=()):
    """Return what `engine.js` returns of one drop, and the time of its end."""
    result = sb.simulate(drop, **options, compiled=True)
    samples = result.rerun(list(times)).samples if len(times) else ()
    head = [result.status, result.end_time, len(result.log)]
    parts = [head, result.final_velocities, result.log, result.infinite, *samples[1:]]
    return np.concatenate(parts), result.end_time


def compare(jobs, expected, folder):
    """Let the page's engine do jobs, lists of numbers, and compare its answers."""
    asked = folder / "asked"
    asked.write_bytes(np.concatenate(jobs).astype("<f8").tobytes())
    command = ["node", RUN, str(ENGINE), native.FOLDER, asked, folder / "answered"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    found, wanted = np.fromfile(folder / "answered", dtype="<f8"), np.concatenate(expected)
    assert len(found) == len(wanted)
    same = bits(found) == bits(wanted)
    assert same


@pytest.mark.parametrize(
    ("batches", "count"), [(BATCHES, 25), pytest.param(len(draw.BALLS), 80, marks=pytest.mark.slow)]
)
def test_random_drops(tmp_path, batches, count):
    jobs, expected = [], []
    for batch in range(batches):
        drawn, rigid = draw.drops_of(SEED, batch, count), draw.is_rigid(batch)
        for row in range(count):
            drop, own = drop_of(drawn, row), options_of(drawn, row)
            answer, end = simulated(drop, own)
            times = ()
            if row % SAMPLED == 0 and 0.0 < end < math.inf:
                times = [0.0, 0.3 * end, 0.7 * end, end, 1.1 * end]
                answer, _ = simulated(drop, own, times)
            options = Options(drawn.until[row], drawn.rtol[row], int(drawn.limit[row]))
            drops = numbers_of(drawn, slice(row, row + 1))
            jobs.append(job(SIMULATE, drops, drop.rigid, options, times))
            expected.append(answer)
        drops, options = numbers_of(drawn), Options(math.inf, 1e-9, LIMIT)
        jobs.append(job(SWEEP, drops, rigid, options))
        expected += map(np.ravel, swept(RIGID if rigid else FINITE, drops, options))
    compare(jobs, expected, tmp_path)


def two_springs(count):
    """Return drops of two balls on springs, some of them beyond the reach of their own engine."""
    random = np.random.default_rng(SEED)
    mass = 10.0 ** random.uniform(-1.6, 1.6, (count, 2))
    stiffness = 10.0 ** random.uniform(2.0, 5.0, (count, 2))
    reach = np.where(random.random(count) < 0.5, 2.0 * random.random(count), 0.0)
    gap = np.column_stack([np.zeros(count), reach * np.sqrt(mass[:, 0] / stiffness[:, 0])])
    one, nothing = np.ones((count, 2)), np.zeros((count, 2))
    kind = np.full((count, 2), codes.POWER)
    return Drops(mass, kind, stiffness, one, nothing, nothing, gap, -one, np.zeros(count))


@pytest.mark.parametrize(
    ("lanes", "drops", "rtol"),
    [
        (SPRINGS, two_springs(1), 1e-12),
        (SPRINGS, two_springs(300), 1e-12),
        pytest.param(SPRINGS, two_springs(10_800), 1e-12, marks=pytest.mark.slow),
        (PAIRS, pairs(300, SEED), 1e-4),
        (PAIRS, pairs(300, SEED), 1e-9),
        (LINEAR, pairs(300, SEED, forms=codes.LINEAR_FORMS), 1e-12),
    ],
)
def test_two_balls_in_lanes(tmp_path, lanes, drops, rtol):
    options, count = Options(math.inf, rtol, 1_000_000), len(drops.gravity)
    entry = {SPRINGS: "run_two_springs", PAIRS: "run_pairs", LINEAR: "run_linear"}[lanes]
    out, asked = swept_in_lanes(entry, drops, options)
    compare([job(lanes, drops, False, options)], list(map(np.ravel, out)), tmp_path)
    assert asked <= count // 2
    assert (asked > 0) == (count > 1)


def test_memory_grows_while_stacks_are_kept(tmp_path):
    options, stacks = Options(math.inf, 1e-12, 1_000_000), [two_springs(n) for n in (5, 4000, 5)]
    outs = [swept(FINITE, drops, options) for drops in stacks]
    jobs = [job(SWEEP, drops, False, options) for drops in stacks]
    compare(jobs, [np.ravel(array) for out in outs for array in out], tmp_path)


def test_a_log_longer_than_its_room(tmp_path):
    """A ball on a spring bounces for ever, if it is watched so long."""
    one = np.ones((1, 1))
    kind = np.full((1, 1), codes.POWER)
    drops = Drops(one, kind, 1e3 * one, one, *[0.0 * one] * 3, -one, np.full(1, 9.8))
    drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1e3)], velocities=[-1.0], gravity=9.8)
    options = Options(1e4, 1e-9, 3000)
    answer, _ = simulated(drop, {"until": 1e4, "rtol": 1e-9, "event_limit": 3000})
    assert answer[0] == codes.EVENT_LIMIT
    assert answer[2] == 2000 * codes.LOG_COLUMNS  # without the changes that are not logged
    compare([job(SIMULATE, drops, False, options)], [answer], tmp_path)
