"""Time against error of sweeps of two balls: ours, a loop by hand, and general solvers.

The drops are random: masses of 0.05 to 0.5 kg and 0.02 to 0.2 kg, stiffnesses over two decades,
gaps of 0, 1 and 3 mm, 1 to 5 m/s. An error is the larger one of both balls' velocities over the
impact speed. Times are processor times of one thread without compilation, the shortest of some
rounds in which all ways take turns. A slow solver gets the first drops only, and two rounds. Run
`python -m benchmarks.pairs`.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table as Printed

import stackbounce as sb
from benchmarks.by_scipy import rebound
from benchmarks.peers import by_cvode, by_cyrk, by_scipy
from benchmarks.peers.by_hand import FORCES, loop_of, solve_rigid
from benchmarks.random_drops import PairDrops
from stackbounce.engine.memory import FINITE, RIGID, Engine, memory
from stackbounce.engine.records import Drops
from stackbounce.engine.work import EVENT_LIMIT
from stackbounce.model.laws import ContactLaw, contact_numbers
from stackbounce.run.batch import new_outcomes, run_lanes
from stackbounce.run.engines import choose_lanes
from stackbounce.run.options import Options

LAWS = {
    "Hertz": sb.Hertz(1e6),
    "PowerLaw": sb.PowerLaw(1e6, 2.2),
    "Viscoelastic": sb.Viscoelastic(1e6, 1e-5),
    "HuntCrossley": sb.HuntCrossley(1e6, 1.5, 0.1),
    "Dashpot": sb.Dashpot(1e4, 1.0),
    "StandardLinearSolid": sb.StandardLinearSolid(1e4, 0.5, 2e-3),
    "Hysteretic": sb.Hysteretic(1e4, restitution=0.8),
}
LANES, DROPS, LOOP, RIGID_BALLS = "sweep", "drop by drop", "loop by hand", "Rigid"
STEPS = (10, 20, 40, 80, 160)  # of the loop, in the shorter contact time
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-9, 1e-12)
THEIRS = (1e-4, 1e-6, 1e-9, 1e-12)
TRUTH = 1e-13
COUNT, RIGID_COUNT = 4000, 100_000
LEAST, SECONDS = 10, 0.3  # drops of a slow solver: so many, or those of so many seconds
ROUNDS, SLOW_ROUNDS = 5, 2  # the first round more, and those that a slow solver takes part in
SAME = 1e-3  # an error: with a smaller one, the rule for a second compression made none
_WIDTH = 120  # characters of a printed table, at least: a narrower one cuts numbers off


Way = Callable[[], np.ndarray]
"""Solves its drops and returns the velocities over the impact speed."""


@dataclass(frozen=True)
class Entry:
    """One way at one setting: time in s a drop, median error, and that which 1 % exceed."""

    law: str
    way: str
    setting: float  # steps of the loop, or a tolerance; nan where there is none
    drops: int
    seconds: float
    median: float
    most: float


def random_drops(law: ContactLaw, count: int = COUNT, seed: int = 1) -> Drops:
    """Return random drops, both of whose contacts have a law with other stiffnesses."""
    random, one = np.random.default_rng(seed), np.ones((count, 2))
    form, stiffness, *others = contact_numbers(law)
    speed = random.uniform(1.0, 5.0, (count, 1))
    gap = np.column_stack([np.zeros(count), random.choice([0.0, 1e-3, 3e-3], count)])
    mass = np.column_stack([random.uniform(0.05, 0.5, count), random.uniform(0.02, 0.2, count)])
    first = stiffness * 10.0 ** random.uniform(-1.0, 1.0, (count, 2))
    second, third, fourth = (number * one for number in others)
    if isinstance(law, sb.Rigid):
        third = random.uniform(0.7, 1.0, (count, 2))
    form = np.full((count, 2), form)
    return Drops(mass, form, first, second, third, fourth, gap, -speed * one, np.zeros(count))


def _some(drops: Drops, rows: Any) -> Drops:
    return Drops._make(np.ascontiguousarray(array[rows]) for array in drops)


def _in_units(drops: Drops) -> PairDrops:
    """Return drops in units of the lower ball's mass, the impact speed, and the floor's contact."""
    speed, p = -drops.velocity[:, :1], drops.second[0, 0]
    mass, stiffness = drops.mass[:, :1], drops.first[:, :1]
    length = (mass * speed**2 / stiffness) ** (1.0 / (p + 1.0))
    time = length / speed
    unit = {"Dashpot": mass / time, "Viscoelastic": time, "HuntCrossley": 1.0 / speed}
    name = next((law for law, some in LAWS.items() if contact_numbers(some)[0] == drops.form[0, 0]))
    losses, gaps = drops.third / unit.get(name, math.inf), drops.gap[:, 1] / length[:, 0]
    return PairDrops(drops.mass / mass, drops.first / stiffness, losses, gaps)


def _lanes(drops: Drops, kernel: str, rtol: float) -> Way:
    """Return an engine in lanes, with what solves again the drops that it is not sure of."""
    out, options = new_outcomes(len(drops.gravity), 2), Options(math.inf, rtol, EVENT_LIMIT)

    def call() -> np.ndarray:
        run_lanes(kernel, drops, out, options, compiled=True, pause=lambda: None)
        return out.rebound_ratio

    return call


def _general(drops: Drops, engine: Engine, rtol: float) -> Way:
    out, room = new_outcomes(len(drops.gravity), 2), memory(engine, 2, compiled=True)
    options = math.inf, rtol, 10**6, 10**12

    def call() -> np.ndarray:
        room.run_batch(engine.run_batch, drops, options, out)
        return out.rebound_ratio

    return call


def _scipy_with_cycles(drops: Drops, rtol: float) -> np.ndarray:
    """Return what `benchmarks.by_scipy` finds, which follows cycles of hysteresis."""
    found, law = [], {"law": "Hysteretic", "restitution": LAWS["Hysteretic"].restitution}
    for m, k, gap, v in zip(drops.mass, drops.first, drops.gap[:, 1], drops.velocity, strict=True):
        contacts = [law | {"stiffness": stiffness} for stiffness in k]
        case = {"masses": m, "contacts": contacts, "gaps": [gap], "velocities": v}
        found.append(rebound(case, rtol) / -v[0])
    return np.array(found)


def _solvers(law: str) -> dict[str, Callable[[Drops, float], np.ndarray]]:
    """Return the general solvers that are installed and can solve drops under a law, by name."""
    if law == "StandardLinearSolid":
        return {}
    if law == "Hysteretic":
        return {"SciPy": _scipy_with_cycles}
    peers = (by_cvode.PEER, by_cvode), (by_cyrk.PEER, by_cyrk), (by_scipy.PEER, by_scipy)

    def solver(prepare: Any) -> Callable[[Drops, float], np.ndarray]:
        prepared = {rtol: prepare(FORCES[law], rtol) for rtol in THEIRS}
        return lambda some, rtol: prepared[rtol](_in_units(some))[0]

    return {peer.name: solver(module.prepare) for peer, module in peers if peer.available()}


def _ways(law: str, drops: Drops) -> dict[tuple[str, float], tuple[int, Way]]:
    """Return the number of drops and the ways by name and setting, all compiled."""
    speed, loop, count = -drops.velocity[:, :1], loop_of(law), len(drops.gravity)
    ways: dict[tuple[str, float], tuple[int, Way]] = {}
    for steps in STEPS:
        ways[LOOP, steps] = count, lambda steps=steps: loop(drops, steps) / speed
    base = sb.Drop([sb.Ball(0.2), sb.Ball(0.1)], [LAWS[law]] * 2, impact_speed=1.0)
    for rtol in TOLERANCES:
        kernel = choose_lanes(base, [], Options(math.inf, rtol, EVENT_LIMIT))
        general = _general(drops, FINITE, rtol)
        ways[LANES, rtol] = count, _lanes(drops, kernel, rtol) if kernel else general
        ways[DROPS, rtol] = count, general
    for name, solve in _solvers(law).items():
        for rtol in THEIRS:
            few = _some(drops, slice(LEAST))
            solve(few, rtol)
            start = process_time()
            solve(few, rtol)
            each = (process_time() - start) / LEAST
            few = _some(drops, slice(min(count, max(LEAST, int(SECONDS / each)))))
            ways[name, rtol] = (
                len(few.gravity),
                lambda few=few, solve=solve, rtol=rtol: solve(few, rtol),
            )
    return ways


def measure(law: str, progress: Callable[[str], None], count: int = COUNT) -> list[Entry]:
    """Return what all ways need for random drops of a law."""
    progress(f"{law}: compiling")
    drops = random_drops(LAWS[law], count)
    right = _general(drops, FINITE, TRUTH)().copy()
    if law == "Hysteretic":  # the loop's rule for a second compression is another one
        found = loop_of(law)(drops, STEPS[-1]) / -drops.velocity[:, :1]
        alike = np.abs(found - right).max(axis=1) < SAME
        drops, right = _some(drops, alike), right[alike]
    return _raced(law, _ways(law, drops), right, progress)


def rigid(progress: Callable[[str], None], count: int = RIGID_COUNT) -> list[Entry]:
    """Return what rigid balls need: a sweep, the general engine, and a loop by hand."""
    drops = random_drops(sb.Rigid(0.9), count)
    general, speed = _general(drops, RIGID, TRUTH), -drops.velocity[:, :1]
    ways = {
        (LOOP, math.nan): (count, lambda: solve_rigid(drops) / speed),
        (LANES, math.nan): (count, _lanes(drops, "run_two_rigid", TRUTH)),
        (DROPS, math.nan): (count, general),
    }
    return _raced(RIGID_BALLS, ways, general().copy(), progress)


def _raced(
    law: str,
    ways: dict[tuple[str, float], tuple[int, Way]],
    right: np.ndarray,
    progress: Callable[[str], None],
) -> list[Entry]:
    """Return the times and errors of ways that take turns; the first round compiles."""
    spent = dict.fromkeys(ways, math.inf)
    errors: dict[tuple[str, float], Any] = {}
    for number in range(ROUNDS + 1):
        for way, (count, solve) in ways.items():
            if number >= SLOW_ROUNDS and count < len(right):
                continue
            progress(f"{law}: round {number} of {ROUNDS}, {way[0]}")
            start = process_time()
            ratio = solve()
            spent[way] = min(spent[way], process_time() - start)
            errors[way] = np.nanquantile(np.abs(ratio - right[:count]).max(axis=1), [0.5, 0.99])
    return [
        Entry(law, *way, count, spent[way] / count, *map(float, errors[way]))
        for way, (count, _) in ways.items()
    ]


def all_entries(progress: Callable[[str], None]) -> list[Entry]:
    """Return what all ways need under all laws, and with rigid balls."""
    return [entry for law in LAWS for entry in measure(law, progress)] + rigid(progress)


def rows(entries: list[Entry]) -> list[list[str]]:
    """Return the entries as rows of text."""
    return [
        [
            *(entry.law, entry.way, "–" if math.isnan(entry.setting) else f"{entry.setting:g}"),
            *(f"{entry.drops}", f"{1e6 * entry.seconds:.3g}"),
            *(f"{entry.median:.1e}", f"{entry.most:.1e}"),
        ]
        for entry in entries
    ]


HEADS = ["law", "way", "steps or rtol", "drops", "µs a drop", "median error", "99 %"]


def show(heads: list[str], measure: Callable[[Callable[[str], None]], list[list[str]]]) -> None:
    """Print the rows of a table, and while they are measured what is done."""
    console = Console(highlight=False)
    console.width = max(console.width, _WIDTH)
    with console.status("starting") as status:
        found = measure(status.update)
    table = Printed(*heads)
    for row in found:
        table.add_row(*row)
    console.print(table)


if __name__ == "__main__":
    show(HEADS, lambda progress: rows(all_entries(progress)))
