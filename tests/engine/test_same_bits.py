"""Plain Python, and the compiled code of every processor level: the same bits of random drops."""

import functools
import json
from pathlib import Path

import numpy as np
import pytest

import stackbounce as sb
from batches import bits, numbers_of, on_two_springs, swept
from fuzz.draw import balls_of, drops_of, is_rigid
from fuzz.replay import drop_of, options_of
from stackbounce.engine import native
from stackbounce.engine.memory import FINITE, RIGID
from stackbounce.run.options import Options

SEED = 11
BATCHES = [batch for batch in range(50) if balls_of(batch) > 1]  # of 2 to 6 balls
EVENTS = 100  # at most
TIMES = 20  # of samples
EACH = 500  # drops of a batch that the processor levels are given


def everything(result):
    """Return the bits of all that is known of a run: its log, its end, and samples."""
    known = [result.status, result.end_time, result.rebound_speeds, result._rows]
    if np.isfinite(result.end_time) and result.end_time > 0.0:
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
    "drops", [200, pytest.param(2000, marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_plain_python_and_compiled_code(drops):
    share = drops // len(BATCHES)
    for batch in BATCHES:
        drawn = drops_of(SEED, batch, share)
        for row in range(share):
            drop, options = drop_of(drawn, row), options_of(drawn, row)
            options["event_limit"] = min(options["event_limit"], EVENTS)
            one, other = (
                everything(sb.simulate(drop, **options, compiled=way)) for way in (False, True)
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


def springs():
    """Return the bits of the outcomes of ten thousand drops of two balls on springs."""
    drops = numbers_of(drops_of(SEED, 0, 10_000))
    drops = drops._replace(velocity=np.repeat(-np.abs(drops.velocity[:, :1]), 2, axis=1))
    out = on_two_springs(drops, 10_000)
    done = out.status == sb.Status.FINISHED
    assert done.any()
    return [bits(array[done]) for array in out] + [bits(out.status)]


def test_processor_levels(at_level):
    known, library = levels()
    if len(known) < 2:
        pytest.skip("the library of this machine has one level")
    by_level = []
    for level in known:
        at_level(library, level)
        by_level.append((outcomes(), springs()))
    assert all(found == by_level[0] for found in by_level)
