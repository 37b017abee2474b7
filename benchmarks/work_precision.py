"""How exact nonlinear contacts are for the tolerance asked for, and for the time spent.

The velocities of `tests/data/laws.json` and of `tests/reference/precise.py` are the reference:
they have about thirty digits and come from another method altogether.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import stackbounce as sb
from benchmarks.by_scipy import rebound
from benchmarks.timing import best
from reference import precise

TESTS = Path(__file__).parents[1] / "tests"
TOLERANCES = tuple(float(f"1e-{n}") for n in range(3, 15))
LEAST_OF_SCIPY = 5e-14  # it does not go below 100 units of round-off
FAMILIES = {
    "power laws": {"Hertz", "PowerLaw"},
    "Viscoelastic": {"Viscoelastic"},
    "HuntCrossley": {"HuntCrossley"},
    "Hysteretic": {"Hysteretic"},
    "mixed": {"Hertz", "PowerLaw", "Viscoelastic", "HuntCrossley", "Hysteretic"},
}
Case = dict[str, Any]
PLAIN_HERTZ = {"law": "Hertz", "stiffness": 3e4}
LOSSY = {"law": "HuntCrossley", "stiffness": 3e4, "exponent": 1.5, "dissipation": 0.1}
STACK = {"masses": [0.15, 0.057], "gaps": [0.002], "velocities": [-3.53, -3.53]}
DROPS: dict[str, Case] = {
    "Hertz": {**STACK, "contacts": [PLAIN_HERTZ] * 2},
    "HuntCrossley": {**STACK, "contacts": [LOSSY] * 2},
}
"""A basketball and a tennis ball 2 mm above it, as to mass, at the paper's speed."""


@dataclass(frozen=True)
class Spread:
    """Errors of the velocities in units of v0 at one tolerance, over the rows of one family.

    ``rows`` is their number; `ten` and `ninety` are the percentiles beside the median.
    """

    family: str
    rtol: float
    rows: int
    ten: float
    median: float
    ninety: float
    worst: float


@dataclass(frozen=True)
class Work:
    """Error of the velocities in units of v0, and time in s, of one drop at one tolerance."""

    drop: str
    method: str
    rtol: float
    error: float
    seconds: float


def drop_of(case: Case) -> sb.Drop:
    """Return the drop of a reference case."""
    laws = [dict(law) if law else None for law in case["contacts"]]
    return sb.Drop(
        [sb.Ball(mass) for mass in case["masses"]],
        [getattr(sb, law.pop("law"))(**law) if law else None for law in laws],
        case["gaps"],
        velocities=case["velocities"],
        gravity=case.get("gravity", 0.0),
    )


def family(case: Case) -> str | None:
    """Return the family that has all of a case's nonlinear laws; None if it has no such law."""
    laws = {law["law"] for law in case["contacts"] if law} & FAMILIES["mixed"]
    return next(name for name, known in FAMILIES.items() if laws <= known) if laws else None


def errors(progress: Callable[[str], None]) -> list[Spread]:
    """Return the errors of all reference rows with a nonlinear law; family "all" is last."""
    rows = json.loads((TESTS / "data" / "laws.json").read_text())
    groups: dict[str, list[tuple[sb.Drop, Any]]] = {name: [] for name in FAMILIES}
    for row in rows:
        if name := family(row["case"]):
            groups[name].append((drop_of(row["case"]), row))
    found = []
    for rtol in TOLERANCES:
        progress(f"error against tolerance: rtol = {rtol:g}")
        every = {}
        for name, group in groups.items():
            every[name] = [
                error(
                    sb.simulate(drop, until=row["case"].get("until"), rtol=rtol, compiled=True),
                    row["rebound_speeds"],
                )
                for drop, row in group
            ]
        every["all"] = [one for group in every.values() for one in group]
        found += [
            Spread(name, rtol, len(e), *np.quantile(e, [0.1, 0.5, 0.9, 1.0]).tolist())
            for name, e in every.items()
        ]
    return found


def error(result: sb.Result, expected: list[float]) -> float:
    """Return the largest error of a velocity in units of v0."""
    found = np.abs(result.rebound_speeds - expected).max()
    return float(found) / result.drop.reference_speed


def work(progress: Callable[[str], None]) -> list[Work]:
    """Return error and time of `DROPS` by this package, compiled and plain, and by scipy."""
    kinds, off, calls = [], [], []
    for name, case in DROPS.items():
        progress(f"work and precision: thirty digits of two balls, {name}")
        exact = np.array([float(v) for v in precise.run(**case).velocities])
        for method, rtol in product(METHODS, TOLERANCES):
            if method == SCIPY and rtol < LEAST_OF_SCIPY:
                continue
            progress(f"work and precision: {name}, {method}, rtol = {rtol:g}")
            call = partial(METHODS[method], case if method == SCIPY else drop_of(case), rtol)
            kinds.append((name, method, rtol))
            off.append(float(np.abs(call() - exact).max()) / np.abs(case["velocities"]).max())
            calls.append(call)
    times = best(calls, lambda text: progress(f"work and precision: {text}"), rounds=5)
    return [Work(*kind, *found) for kind, *found in zip(kinds, off, times, strict=True)]


def compiled(drop: sb.Drop, rtol: float) -> np.ndarray:
    """Return the rebound speeds in m/s by compiled code."""
    return sb.simulate(drop, rtol=rtol, compiled=True).rebound_speeds


def plain(drop: sb.Drop, rtol: float) -> np.ndarray:
    """Return the rebound speeds in m/s by plain Python."""
    return sb.simulate(drop, rtol=rtol, compiled=False).rebound_speeds


SCIPY = "scipy, DOP853"
METHODS: dict[str, Callable[[Any, float], np.ndarray]] = {
    "stackbounce, compiled": compiled,
    "stackbounce, plain Python": plain,
    SCIPY: rebound,
}
