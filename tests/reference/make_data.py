"""Write `tests/data/springs.json` and `tests/data/hysteretic.json` from the reference solutions.

Run it in `tests` as `python -m reference.make_data`; it takes some minutes (less with gmpy2, which
mpmath uses where it is installed). A row is a drop, from seeded random numbers or from the paper,
with its solution to twenty digits: velocities, retained energy, end time, and the contact
intervals as [contact, start, end, peak force, peak compression, impulse].
"""

import json
from collections.abc import Iterable, Iterator
from itertools import product
from math import sqrt
from pathlib import Path
from random import Random
from typing import Any

from mpmath import mp, mpf

from reference import precise, springs
from reference.common import Interval, Outcome

DATA = Path(__file__).parents[1] / "data"
WORST = 1e3  # amplification of a relative change of the inputs
Case = dict[str, Any]


def fall(masses: list[float], contacts: list[Case], gaps: list[float], speed: float) -> Case:
    """Return a case in which all the balls come down together."""
    velocities = [-speed] * len(masses)
    return {"masses": masses, "contacts": contacts, "gaps": gaps, "velocities": velocities}


def log_uniform(random: Random, low: float, high: float) -> float:
    """Return a random number whose logarithm is uniform."""
    return low * (high / low) ** random.random()


def spring_cases() -> Iterator[Case]:
    """Yield random stacks of two to six balls, equal ones, then the corners of the range of two.

    Of the taller stacks, whose many collisions one after the other may amplify a rounding error of
    the inputs, those are left out that do so more than `WORST` times.
    """
    random = Random(2007)
    for balls in [2] * 240 + [3] * 40 + [4] * 12 + [5] * 6 + [6] * 4:
        masses = [log_uniform(random, 0.01, 1)]
        stiffnesses = [log_uniform(random, 1e3, 1e5)]
        speed = log_uniform(random, 0.1, 10)
        unit = speed * sqrt(masses[0] / stiffnesses[0])
        wide = 50 if balls == 2 else 5
        for _ in range(balls - 1):
            masses.append(masses[-1] / log_uniform(random, 1 / wide, wide))
            stiffnesses.append(stiffnesses[-1] / log_uniform(random, 1 / (2 * wide), 2 * wide))
        kinds = [random.randrange(4) for _ in masses[1:]]
        gaps = [
            (0.0, unit * log_uniform(random, 1e-6, 1), *[unit * random.uniform(0, 6)] * 2)[kind]
            for kind in kinds
        ]
        case = fall(masses, [{"stiffness": k} for k in stiffnesses], gaps, speed)
        if balls == 2 or condition(case, solve_springs(case)) < WORST:
            yield case
    for balls in (1, 3, 4, 5, 6):
        yield fall([1.0] * balls, [{"stiffness": 1.0}] * balls, [0.0] * (balls - 1), 1.0)
    for mass, stiffness, gap in product((0.02, 50.0), (0.01, 100.0), (0.0, 1.0, 5.0)):
        yield fall([mass, 1.0], [{"stiffness": stiffness}, {"stiffness": 1.0}], [gap], 1.0)


def hysteretic_cases() -> Iterator[Case]:
    """Yield section V's drops and random ones, some with power-law loading, some of three balls."""
    speed = sqrt(2 * 9.80665 * 0.2)
    for lower, law in product((0.101, 0.105), ({"unloading_exponent": 2.3}, {"restitution": 0.78})):
        for upper, gap, k1, k2 in ((0.0248, 1e-3, 5.6e4, 1.6e4), (0.0085, 2.4e-3, 5.4e4, 1.4e4)):
            floor = {"stiffness": k1, "exponent": 1.0, **law}
            yield fall([lower, upper], [floor, {"stiffness": k2}], [gap], speed)
    random = Random(1009)
    for balls in [2] * 30 + [3] * 4:
        ratios = [log_uniform(random, 0.05, 10) for _ in range(balls - 1)]
        masses = [1.0]
        for ratio in ratios:
            masses.append(masses[-1] / ratio)
        contacts: list[Case] = []
        for _ in masses:
            law = {"stiffness": log_uniform(random, 0.1, 10)}
            if random.random() < 0.85:
                law["exponent"] = 1.5 if random.random() < 0.3 else 1.0
                law["restitution"] = random.uniform(0.45, 0.98)
            contacts.append(law)
        gaps = [random.choice([0.0, random.uniform(0, 3)]) for _ in ratios]
        yield fall(masses, contacts, gaps, 1.0)


def solve_springs(case: Case) -> Outcome:
    """Solve a case of springs."""
    stiffnesses = [c["stiffness"] for c in case["contacts"]]
    return springs.run(case["masses"], stiffnesses, case["gaps"], case["velocities"])


def condition(case: Case, outcome: Outcome) -> float:
    """Return how many times more the solution moves than the inputs, relatively.

    The inputs move by about 10**-20; the solution's numbers are the velocities, over the impact
    speed, and the touch and release times, over themselves.
    """
    random = Random(1)
    with mp.workdps(50):
        moved = {
            "masses": [x * (1 + random.uniform(-1, 1) * mpf(10) ** -20) for x in case["masses"]],
            "contacts": [
                {"stiffness": c["stiffness"] * (1 + random.uniform(-1, 1) * mpf(10) ** -20)}
                for c in case["contacts"]
            ],
            "gaps": [x * (1 + random.uniform(-1, 1) * mpf(10) ** -20) for x in case["gaps"]],
        }
        other, speed = solve_springs({**case, **moved}), max(map(abs, case["velocities"]))
        changes = [
            (a - b) / speed for a, b in zip(outcome.velocities, other.velocities, strict=True)
        ]
        for a, b in zip(outcome.intervals, other.intervals, strict=True):
            changes += [(a.end - b.end) / a.end, (a.start - b.start) / (a.start or 1)]
        return float(max(map(abs, changes)) * mpf(10) ** 20)


def solve_hysteretic(case: Case) -> Outcome:
    """Solve a case of hysteretic contacts and springs."""
    return precise.run(**with_names(case))


def with_names(case: Case) -> Case:
    """Return a case whose contacts have the names of their laws."""
    contacts = [
        c and {"law": "Hysteretic" if len(c) > 1 else "Spring", **c} for c in case["contacts"]
    ]
    return {**case, "contacts": contacts}


def row(case: Case, outcome: Outcome, shown: int = 20) -> str:
    """Return the case and its solution, to so many digits, as one line of JSON."""

    def digits(number: mpf | None) -> str:
        with mp.workdps(50):
            return "null" if number is None else mp.nstr(mpf(number), shown, strip_zeros=True)

    rows = ", ".join(
        f"[{i.contact}, {', '.join(map(digits, _values(i)))}]" for i in outcome.intervals
    )
    return (
        f'{{"case": {json.dumps(case)}, '
        f'"rebound_speeds": [{", ".join(map(digits, outcome.velocities))}], '
        f'"energy_retained": {digits(outcome.energy_retained)}, '
        f'"end_time": {digits(outcome.end_time)}, "intervals": [{rows}]}}'
    )


def _values(i: Interval) -> list[mpf | None]:
    return [i.start, i.end, i.peak_force, i.peak_compression, i.impulse]


def write(name: str, rows: Iterable[str]) -> None:
    """Write the rows of a data file."""
    (DATA / f"{name}.json").write_text("[\n" + ",\n".join(rows) + "\n]\n")


def read(name: str) -> list[Case]:
    """Return the rows of a data file, their numbers as floats."""
    return json.loads((DATA / f"{name}.json").read_text())


def main() -> None:
    """Write the files."""
    write("springs", (row(case, solve_springs(case)) for case in spring_cases()))
    write("hysteretic", (row(case, solve_hysteretic(case)) for case in hysteretic_cases()))


if __name__ == "__main__":
    main()
