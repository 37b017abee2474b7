"""Write `benchmarks/impacts/answers.json` from the reference solvers.

Run `PYTHONPATH=tests python -m benchmarks.impacts.make_answers [NAME ...]`; all take some minutes.
Each problem is solved in two ways that share as little as they can (`methods`), and `sure` is to
how many digits both agree. A third kind of run, with inputs that are off by 1e-20 or so, tells how
many times more the answer moves than the inputs (`conditioning`).
"""

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any
from unittest.mock import patch

from mpmath import mp, mpf

from benchmarks.impacts import hysteretic_series, normal_modes
from reference import falling, precise, rigid, taylor
from reference.common import Outcome

FOLDER = Path(__file__).parent
SHOWN = 20  # digits of an answer
MOST_SURE = 30  # digits that are claimed
CARRIED = 60  # digits of the arithmetic here
OFF = mpf(10) ** -20  # of the inputs, relatively
NOTHING = mpf(10) ** -28  # speeds below this, in units of v0, are zero where contacts are finite
TRIALS, TRIED = 3, 12  # runs with other inputs; how many are tried, as some change a count
FEW = 3  # balls, for which the older series takes seconds rather than minutes
EXACT = 40  # rigid collisions that are followed in fractions, which get longer with each
SMOOTH = ("Spring", "Hertz", "Hysteretic")  # laws that `hysteretic_series` knows

Problem = dict[str, Any]
Solver = Callable[[Problem], "Solution"]


@dataclass
class Solution:
    """What came out; times are None where a contact never touched, or is still closed."""

    velocities: list[Any]
    counts: list[int]
    first_touch: list[Any]
    last_release: list[Any]
    peak_force: list[Any]
    status: str
    end: Any

    def numbers(self, problem: Problem) -> dict[str, list[Any]]:
        """Return the quantities as differences are measured: speeds over v0, others as they are."""
        speed = max(abs(mpf(v)) for v in problem["velocities"])
        times = [t for t in (*self.first_touch, *self.last_release, self.end) if t is not None]
        return {
            "velocities": [number(v) / speed for v in self.velocities],
            "times": [number(t) for t in times],
            "forces": [number(f) for f in self.peak_force if f is not None],
        }


def number(value: Any) -> mpf:
    """Return a fraction, a float or an mpf as an mpf."""
    return mpf(value.numerator) / value.denominator if isinstance(value, Fraction) else mpf(value)


def difference(one: Solution, other: Solution, problem: Problem) -> dict[str, mpf]:
    """Return by how much two solutions differ: times and forces relatively."""
    a, b = one.numbers(problem), other.numbers(problem)
    return {
        name: max(
            (
                abs(x - y) / (abs(x) if name != "velocities" and x else 1)
                for x, y in zip(a[name], b[name], strict=True)
            ),
            default=mpf(0),
        )
        for name in a
    }


def finite(problem: Problem, outcome: Outcome) -> Solution:
    """Return what a run of finite contacts says."""
    balls = range(len(problem["masses"]))
    rows = [[i for i in outcome.intervals if i.contact == k] for k in balls]
    speed = max(abs(mpf(v)) for v in problem["velocities"])
    last = [max((i.end or mp.inf for i in row), default=None) for row in rows]
    return Solution(
        [v if abs(v) > NOTHING * speed else mpf(0) for v in outcome.velocities],
        [len(row) for row in rows],
        [min((i.start for i in row), default=None) for row in rows],
        [None if end == mp.inf else end for end in last],
        [max((i.peak_force for i in row), default=None) for row in rows],
        "parted" if problem["until"] is None else "stopped",
        None,
    )


def by_series(problem: Problem) -> Solution:
    """Solve finite contacts by Taylor series (`precise`)."""
    gravity, until = problem["gravity"], problem["until"]
    return finite(problem, precise.run(*_inputs(problem), gravity, until))


def by_finer_series(problem: Problem) -> Solution:
    """Solve them by longer series, shorter steps, and smaller forces left out."""
    with (
        patch.multiple(taylor, TERMS=70, PRECISION=-140, CONVERGED=-20),
        patch.multiple(precise, NEGLECTED=mpf(10) ** -42, LEAST=mpf(10) ** -43),
    ):
        return by_series(problem)


def by_modes(problem: Problem) -> Solution:
    """Solve springs without gravity by closed forms (`normal_modes`)."""
    masses, contacts, gaps, velocities = _inputs(problem)
    stiffnesses = [law and law["stiffness"] for law in contacts]
    return finite(problem, normal_modes.run(masses, stiffnesses, gaps, velocities))


def by_older_series(problem: Problem) -> Solution:
    """Solve springs, Hertz's and hysteretic contacts by `hysteretic_series`."""
    masses, contacts, gaps, velocities = _inputs(problem)
    laws = [law and _hysteretic(**law) for law in contacts]
    return finite(problem, hysteretic_series.run(masses, laws, gaps, velocities))


def _hysteretic(
    law: str,
    stiffness: Any,
    exponent: Any = 1,
    restitution: Any = None,
    unloading_exponent: Any = None,
) -> hysteretic_series.Law:
    if restitution is not None:
        return hysteretic_series.Law.of_restitution(stiffness, exponent, restitution)
    return hysteretic_series.Law(stiffness, 1.5 if law == "Hertz" else exponent, unloading_exponent)


def by_collisions(problem: Problem, digits: int = 50, limit: int = 10_000) -> Solution:
    """Solve rigid balls without gravity collision by collision (`rigid`), with so many digits."""
    masses, contacts, gaps, velocities = _inputs(problem)
    with patch.multiple(rigid, DIGITS=digits, TINY=mpf(10) ** (10 - digits)):
        restitutions = [law and mpf(law["restitution"]) for law in contacts]
        rows = [[mpf(x) for x in row] for row in (masses, gaps, velocities)]
        return _collided(rigid.run(rows[0], restitutions, rows[1], rows[2], limit))


def by_fractions(problem: Problem) -> Solution:
    """Solve them exactly."""
    masses, contacts, gaps, velocities = _inputs(problem)
    restitutions = [law and Fraction(law["restitution"]) for law in contacts]
    rows = [[Fraction(x) for x in row] for row in (masses, gaps, velocities)]
    return _collided(rigid.run(rows[0], restitutions, rows[1], rows[2]))


def _collided(outcome: rigid.RigidOutcome) -> Solution:
    solution = _of_collisions(outcome.collisions, outcome.velocities)
    if outcome.finished:
        return solution
    struck = [count > 0 for count in solution.counts]
    speed = max(map(abs, outcome.velocities))
    solution.velocities = [v if speed > NOTHING else mpf(0) for v in outcome.velocities]
    solution.counts = [-1 if yes else 0 for yes in struck]
    solution.last_release = [None for _ in struck]
    solution.status, solution.end = "collapsed", outcome.collisions[-1].time
    return solution


def _of_collisions(done: Sequence[rigid.Collision], velocities: list[Any]) -> Solution:
    times = [[c.time for c in done if c.contact == k] for k in range(len(velocities))]
    return Solution(
        velocities,
        [len(row) for row in times],
        [row[0] if row else None for row in times],
        [row[-1] if row else None for row in times],
        [],
        "parted",
        None,
    )


def by_parabolas(problem: Problem, digits: int = 50) -> Solution:
    """Solve rigid balls under gravity up to a time (`falling`), with so many digits."""
    masses, contacts, gaps, velocities = _inputs(problem)
    restitutions = [law and law["restitution"] for law in contacts]
    with patch.multiple(falling, DIGITS=digits, TINY=mpf(10) ** (10 - digits)):
        done, _, after = falling.fall(
            masses, restitutions, gaps, velocities, problem["gravity"], problem["until"]
        )
    solution = _of_collisions(done, after)
    solution.status = "stopped"
    return solution


def by_closed_form(problem: Problem) -> Solution:
    """Return the rest of one rigid ball: flights of 2 v e^k / g for k = 1, 2 and so on."""
    e, v, g = (
        number(x)
        for x in (
            problem["contacts"][0]["restitution"],
            -problem["velocities"][0],
            problem["gravity"],
        )
    )
    end = 2 * v * e / (g * (1 - e))
    return Solution([mpf(0)], [-1], [mpf(0)], [None], [], "settled", end)


def by_bounces(problem: Problem) -> Solution:
    """Return the same from flight to flight, until 1e-40 of the first is left."""
    e, now = mpf(problem["contacts"][0]["restitution"]), mpf(0)
    flight = -2 * mpf(problem["velocities"][0]) * e / mpf(problem["gravity"])
    shortest = flight * mpf(10) ** -40
    while flight > shortest:
        now += flight
        flight *= e
    return Solution([mpf(0)], [-1], [mpf(0)], [None], [], "settled", now)


def _inputs(problem: Problem) -> tuple[list[Any], list[Any], list[Any], list[Any]]:
    return tuple(problem[name] for name in ("masses", "contacts", "gaps", "velocities"))


def methods(problem: Problem) -> tuple[Solver, Solver]:
    """Return the two ways to solve a problem; the first one's answer is written."""
    laws = {law["law"] for law in problem["contacts"] if law}
    if laws == {"Rigid"} and problem["gravity"]:
        if "end" in problem["ask"]:
            return by_closed_form, by_bounces
        return by_parabolas, partial(by_parabolas, digits=80)
    if laws == {"Rigid"}:
        begun = by_collisions(problem, limit=EXACT + 1)
        if begun.status == "parted" and sum(begun.counts) <= EXACT:
            return by_fractions, by_collisions
        return partial(by_collisions, digits=80), partial(by_collisions, limit=9_000)
    few = len(problem["masses"]) <= normal_modes.MOST
    if laws == {"Spring"} and not problem["gravity"] and few:
        return by_finer_series, by_modes
    older = laws <= set(SMOOTH) and len(problem["masses"]) <= FEW
    older &= problem["group"] != "grazing"  # which takes more digits than it has
    if older and not problem["gravity"] and not _steep(problem):
        return by_finer_series, by_older_series
    return by_finer_series, by_series


def _steep(problem: Problem) -> bool:
    return any((law or {}).get("unloading_exponent", 0) > 10 for law in problem["contacts"])


def name_of(solver: Solver) -> str:
    """Return the name of a way to solve."""
    if isinstance(solver, partial):
        options = ", ".join(f"{key}={value}" for key, value in solver.keywords.items())
        return f"{solver.func.__name__}({options})"
    return solver.__name__


def moved(problem: Problem, seed: int) -> Problem:
    """Return the problem with inputs that are off by up to `OFF`; equal ones stay equal."""
    random = Random(seed)
    factors: dict[Any, mpf] = {}

    def off(name: str, value: Any) -> Any:
        if (name, value) not in factors:
            factors[name, value] = 1 + random.uniform(-1, 1) * OFF
        return mpf(value) * factors[name, value]

    def law(fields: dict[str, Any] | None) -> dict[str, Any] | None:
        kept = ("law", "exponent", "unloading_exponent")
        return fields and {
            name: value if name in kept or value == 1.0 else off(name, value)
            for name, value in fields.items()
        }

    lists = ("masses", "gaps", "velocities")
    return {
        **problem,
        **{name: [off(name, x) for x in problem[name]] for name in lists},
        "contacts": [law(fields) for fields in problem["contacts"]],
        "gravity": off("gravity", problem["gravity"]),
    }


def conditioning(problem: Problem, solver: Solver) -> dict[str, mpf]:
    """Return how many times more an answer moves than the inputs, the most of some runs."""
    base = solver(problem)

    def changes() -> Iterator[dict[str, mpf]]:
        for seed in range(TRIED):
            other = solver(moved(problem, seed))
            if other.counts == base.counts:
                yield difference(base, other, problem)

    found = list(islice(changes(), TRIALS))
    if not found:
        raise ArithmeticError(f"{problem['name']}: every change of the inputs changes a count")
    return {name: max(change[name] for change in found) / OFF for name in found[0]}


def answer(problem: Problem) -> dict[str, Any]:
    """Return the answer to a problem as the file has it."""
    with mp.workdps(CARRIED):
        first, second = methods(problem)
        solution, other = first(problem), second(problem)
        if (solution.counts, solution.status) != (other.counts, other.status):
            raise ArithmeticError(f"{problem['name']}: two methods give different counts")
        worst = max(difference(solution, other, problem).values())
        sure = int(mp.floor(-mp.log10(worst))) if worst else MOST_SURE
        quick = {by_fractions: by_collisions, by_finer_series: by_series}.get(first, first)
        factors = conditioning(problem, quick)
        quantities = dict(_asked(solution, problem["ask"]))
        needed = [word for word in factors if word in problem["ask"]]
        needed += ["times"] if "end" in problem["ask"] else []
        return {
            "name": problem["name"],
            **quantities,
            "methods": [name_of(first), name_of(second)],
            "sure": min(sure, MOST_SURE),
            "conditioning": {word: float(f"{float(factors[word]):.2g}") for word in needed},
        }


def _asked(solution: Solution, ask: Sequence[str]) -> Iterator[tuple[str, Any]]:
    fields = {
        "velocities": ["velocities"],
        "counts": ["counts"],
        "times": ["first_touch", "last_release"],
        "forces": ["peak_force"],
        "end": ["end"],
        "status": ["status"],
    }
    for word in ask:
        for field in fields[word]:
            yield field, written(getattr(solution, field))


def written(value: Any) -> Any:
    """Return numbers as texts of `SHOWN` digits; counts, words and nothing as they are."""
    if isinstance(value, list):
        return [written(item) for item in value]
    if value is None or isinstance(value, int | str):
        return value
    return mp.nstr(number(value), SHOWN, strip_zeros=True)


def main() -> None:
    """Write the answers, or those to the problems named."""
    file = FOLDER / "answers.json"
    names = sys.argv[1:]
    known = {}
    if names:
        known = {
            solved["name"]: solved for solved in json.loads(file.read_text("utf-8"))["answers"]
        }
    given = json.loads((FOLDER / "problems.json").read_text("utf-8"))
    wanted = [problem for problem in given["problems"] if not names or problem["name"] in names]
    with ProcessPoolExecutor() as pool:
        for future in as_completed(pool.submit(answer, problem) for problem in wanted):
            solved = future.result()
            known[solved["name"]] = solved
            sys.stderr.write(f"{solved['name']}: {solved['sure']} digits\n")
    rows = ",\n".join(
        json.dumps(known[problem["name"]])
        for problem in given["problems"]
        if problem["name"] in known
    )
    head = f'"version": {json.dumps(given["version"])}, "licence": {json.dumps(given["licence"])}'
    file.write_text(f'{{{head}, "answers": [\n{rows}\n]}}\n', "utf-8")


if __name__ == "__main__":
    main()
