"""Sweeps of two balls: nonlinear contacts beside `solve_ivp`, rigid ones beside a division.

Random drops, half of them with a gap. The reference is this package at its smallest tolerance,
which `tests/engine/test_known_results.py` compares with 30 digits. Our runs use four tolerances
per decade, so that our error shown beside that of `solve_ivp` is no larger and hardly smaller.
Times are processor times without compilation: the shortest of some rounds, in which both take
turns.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import process_time
from typing import Any

import numpy as np
from kernel_build.jit import compile_kernel

import stackbounce as sb
from benchmarks.by_scipy import rebound
from stackbounce.engine.kernels import kernel

LAWS: dict[str, dict[str, Any]] = {
    "Hertz": {"law": "Hertz"},
    "Viscoelastic": {"law": "Viscoelastic", "dissipative_time": 2e-5},
    "HuntCrossley": {"law": "HuntCrossley", "exponent": 1.5, "dissipation": 0.1},
    "Hysteretic": {"law": "Hysteretic", "restitution": 0.8},
}
OURS = tuple(10.0 ** (-0.25 * n) for n in range(12, 53))  # from 1e-3 to 1e-13
THEIRS = (1e-6, 1e-9, 1e-12)
TRUTH = 1e-14
DROPS = 10_000  # of ours ...
THEIR_DROPS = 60  # ... the first of which are solve_ivp's, too
SPEED = 3.0  # m/s
DIVISIONS = 10**7
RIGID = 10**5
ROUNDS = 5


@dataclass(frozen=True)
class Entry:
    """One law at one tolerance of solve_ivp: its median error in units of v0, its time in s a drop.

    Ours are those at the loosest tolerance whose error is no larger.
    """

    law: str
    error: float
    seconds: float
    our_rtol: float
    our_error: float
    our_seconds: float


@dataclass(frozen=True)
class Rigid:
    """Collisions of rigid balls and divisions that wait for each other, in s each."""

    collision: float
    division: float


def nonlinear(progress: Callable[[str], None], drops: int = DROPS) -> list[Entry]:
    """Return how sweeps of each law compare with `solve_ivp`."""
    found = []
    for law in LAWS:
        cases, base, values = _drops(law, drops)
        progress(f"{law}: a sweep")
        truth = _swept(base, values, TRUTH)
        ours = {rtol: _error(_swept(base, values, rtol), truth) for rtol in OURS}
        few = cases[:THEIR_DROPS]
        for rtol in THEIRS:
            progress(f"{law}: solve_ivp at {rtol:g}")
            error = _error(_one_by_one(few, rtol), truth[: len(few)])
            level = next((one for one in OURS if ours[one] <= error), OURS[-1])
            seconds, spent = _timed(
                partial(_one_by_one, few, rtol), partial(_swept, base, values, level)
            )
            found.append(
                Entry(law, error, seconds / len(few), level, ours[level], spent / len(truth))
            )
    return found


def rigid(progress: Callable[[str], None]) -> Rigid:
    """Return the time of a collision in a sweep of two rigid balls, and that of a division."""
    progress("rigid balls")
    rng = np.random.default_rng(1)
    drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Rigid(0.9)] * 2, impact_speed=1.0)
    values = {"balls.1.mass": np.exp(rng.uniform(*np.log((1.0, 50.0)), RIGID))}
    swept = sb.sweep(drop, values)
    (spent,) = _timed(partial(sb.sweep, drop, values))
    count = int(np.maximum(swept.collisions.values, 0).sum())
    divide = compile_kernel(divisions)
    divide(10)
    begin = process_time()
    divide(DIVISIONS)
    return Rigid(spent / count, (process_time() - begin) / DIVISIONS)


@kernel
def divisions(count: int) -> float:
    """Return what comes of so many divisions, each of which needs the last one's result."""
    x = 1.5
    for _ in range(count):
        x = 3.0 / x
    return x


def _drops(law: str, count: int) -> tuple[list[dict[str, Any]], sb.Drop, dict[str, Any]]:
    """Return random drops as cases, and as a base with what varies."""
    import xarray as xr

    rng = np.random.default_rng(2007)
    mass, floor = 0.1, 3e4
    upper = mass * np.exp(rng.uniform(*np.log((0.05, 5.0)), count))
    stiff = floor * np.exp(rng.uniform(*np.log((0.1, 10.0)), count))
    gap = rng.uniform(0.0, 5e-3, count) * (np.arange(count) % 2)
    numbers = LAWS[law]
    cases = [
        {
            "masses": [mass, m],
            "gaps": [g],
            "velocities": [-SPEED, -SPEED],
            "contacts": [numbers | {"stiffness": floor}, numbers | {"stiffness": k}],
        }
        for m, k, g in zip(upper.tolist(), stiff.tolist(), gap.tolist(), strict=True)
    ]
    given = {key: value for key, value in numbers.items() if key != "law"}
    make = partial(getattr(sb, law), floor, **given)
    base = sb.Drop([sb.Ball(mass), sb.Ball(mass)], [make(), make()], impact_speed=SPEED)
    names = ("balls.1.mass", "contacts.1.stiffness", "gaps.0")
    values = {
        name: xr.DataArray(one, dims="drop")
        for name, one in zip(names, (upper, stiff, gap), strict=True)
    }
    return cases, base, values


def _swept(base: sb.Drop, values: dict[str, Any], rtol: float) -> np.ndarray:
    """Return the rebound ratios of a sweep."""
    ratios: np.ndarray = sb.sweep(base, values, rtol=rtol).rebound_ratio.values
    return ratios


def _one_by_one(cases: list[dict[str, Any]], rtol: float) -> np.ndarray:
    """Return the rebound ratios that `solve_ivp` finds."""
    return np.array([rebound(case, rtol) for case in cases]) / SPEED


def _timed(*ways: Callable[[], Any]) -> list[float]:
    """Return the shortest times in s of ways that take turns."""
    spent = [math.inf] * len(ways)
    for _ in range(ROUNDS):
        for n, way in enumerate(ways):
            begin = process_time()
            way()
            spent[n] = min(spent[n], process_time() - begin)
    return spent


def _error(found: np.ndarray, truth: np.ndarray) -> float:
    """Return the median over drops of the larger error of both velocities."""
    return float(np.median(np.abs(found - truth).max(axis=1)))
