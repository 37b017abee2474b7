"""Write `tests/data/laws.json` from `precise`: stacks of all finite laws, pure and mixed.

Run it in `tests` as `python -m reference.make_laws`; it takes some minutes. Rows are like those of
`make_data`, with the law's name in every contact, a contact that may be null (no floor), and in a
few cases `gravity` and `until`. Numbers have 28 digits.

Random cases are left out where `integrate` calls a count doubtful or moves the velocities `WORST`
times more than the inputs; any case, where it does not confirm the solution (`confirmed`).
"""

from collections.abc import Callable, Iterable, Iterator
from itertools import chain, islice
from math import sqrt
from random import Random

import numpy as np

from reference import precise
from reference.common import Outcome
from reference.integrate import Solution, integrate
from reference.make_data import Case, fall, log_uniform, row, write

WORST = 1e4  # amplification of a relative change of the inputs
DIGITS = 28  # that are written
STEPS = 4000  # of `integrate`: a longer story takes `precise` too long
NAMES = ("Spring", "Hertz", "PowerLaw", "Dashpot", "Viscoelastic", "HuntCrossley", "Hysteretic")


def law(random: Random, name: str, stiffness: float, mass: float) -> Case:
    """Return a random law that stops that mass at speed 1 about as far as the linear stiffness."""
    length = sqrt(mass / stiffness)
    fields: Case = {"law": name}
    exponent = {"Spring": 1.0, "Dashpot": 1.0, "Hertz": 1.5, "Viscoelastic": 1.5}.get(name)
    if exponent is None:
        exponent = random.choice([1.0, 1.5, 1.5, round(random.uniform(1.0, 3.0), 3)])
        if name == "Hysteretic":
            exponent = random.choice([1.0, 1.5])
    fields["stiffness"] = stiffness * length ** (1.0 - exponent)
    if name in ("PowerLaw", "HuntCrossley", "Hysteretic"):
        fields["exponent"] = exponent
    if name == "Dashpot":
        fields["damping"] = 2.0 * log_uniform(random, 0.01, 5.0) * sqrt(stiffness * mass)
    elif name == "Viscoelastic":
        fields["dissipative_time"] = log_uniform(random, 0.01, 3.0) * length
    elif name == "HuntCrossley":
        fields["dissipation"] = log_uniform(random, 0.01, 30.0)
    elif name == "Hysteretic":
        fields["restitution"] = random.uniform(0.3, 0.98)
    return fields


def one_ball() -> Iterator[Case]:
    """Yield single balls, from weak damping to overdamped."""
    contacts: list[Case] = [{"law": "Spring", "stiffness": 2500.0}]
    contacts += [{"law": "Hertz", "stiffness": 2e6}]
    contacts += [{"law": "PowerLaw", "stiffness": 1.0, "exponent": p} for p in (1.2, 2.0, 3.7)]
    root = sqrt(0.1 * 2500.0)
    for zeta in (0.01, 0.1, 0.3, 0.9, 0.999999, 1.0, 1.000001, 2.0, 5.0):
        contacts += [{"law": "Dashpot", "stiffness": 2500.0, "damping": 2.0 * zeta * root}]
    contacts += [{"law": "Dashpot", "stiffness": 1.6, "damping": 0.8}]  # critical in every digit
    for time in (1e-5, 1e-3, 1e-2, 0.1, 1.0):
        contacts += [{"law": "Viscoelastic", "stiffness": 2e5, "dissipative_time": time}]
    for exponent, loss in (
        (1.0, 0.01),
        (1.0, 1.0),
        (1.5, 0.1),
        (1.5, 1.0),
        (1.5, 10.0),
        (2.0, 15.0),
    ):
        contacts += [
            {"law": "HuntCrossley", "stiffness": 1e5, "exponent": exponent, "dissipation": loss}
        ]
    contacts += [
        {"law": "Hysteretic", "stiffness": 5.6e4, "exponent": 1.0, "unloading_exponent": 2.3},
        {"law": "Hysteretic", "stiffness": 2e6, "exponent": 1.5, "restitution": 0.3},
    ]
    for contact in contacts:
        yield fall([0.1], [contact], [], 2.0)


def stack(random: Random, names: list[str | None], widest: float = 1e3) -> Case:
    """Return a random stack of these laws at speed 1; without a floor the top ball strikes."""
    balls = len(names)
    wide = widest if balls == 2 else 10.0
    masses, stiffnesses = [1.0], [log_uniform(random, 0.1, 10.0)]
    for _ in names[1:]:
        masses.append(masses[-1] * log_uniform(random, 1 / wide, wide))
        stiffnesses.append(stiffnesses[-1] * log_uniform(random, 1 / wide, wide))
    lighter = [min(masses[max(i - 1, 0) : i + 1]) for i in range(balls)]
    contacts = [
        law(random, name, k, m) if name else None
        for name, k, m in zip(names, stiffnesses, lighter, strict=True)
    ]
    gaps = [
        random.choice([0.0, log_uniform(random, 1e-6, 1.0), *[random.uniform(0.0, 6.0)] * 2])
        for _ in names[1:]
    ]
    case = fall(masses, contacts, gaps, 1.0)
    if names[0] is None:
        case["velocities"] = [0.0] * (balls - 1) + [-1.0]
    elif random.random() < 0.2:
        case["velocities"] = [random.uniform(-1.0, 0.5) for _ in names]
    return case


def steady(cases: Iterable[Case]) -> Iterator[Case]:
    """Yield those that are short and well-conditioned, and in which something happens."""
    for case in cases:
        found = solve_quickly(case, STEPS)
        if found.status == "finished" and len(found.intervals) and not found.doubtful:
            random = Random(1)
            moved = {
                **case,
                "masses": [x * (1 + random.uniform(-1, 1) * 1e-7) for x in case["masses"]],
                "gaps": [x * (1 + random.uniform(-1, 1) * 1e-7) for x in case["gaps"]],
            }
            other = solve_quickly(moved, STEPS)
            change = np.max(np.abs(found.velocities - other.velocities))
            if change < WORST * 1e-7 and found.counts == other.counts:
                yield case


def random_stacks() -> Iterator[Case]:
    """Yield pairs of one law, mixtures of two to four balls, and chains without a floor."""
    random = Random(1975)

    def endless(names: Callable[[], list[str | None]]) -> Iterator[Case]:
        while True:
            yield stack(random, names())

    for name in NAMES:
        yield from islice(steady(endless(lambda name=name: [name, name])), 4)
        yield from islice(steady(endless(lambda name=name: [None, name, name])), 1)
    for balls, number in ((2, 36), (3, 15), (4, 6)):
        mixed = endless(lambda balls=balls: random.choices(NAMES, k=balls))
        yield from islice(steady(mixed), number)
    for balls, number in ((2, 4), (3, 4), (4, 2)):
        mixed = endless(lambda balls=balls: [None, *random.choices(NAMES, k=balls - 1)])
        yield from islice(steady(mixed), number)


def extremes() -> Iterator[Case]:
    """Yield masses that differ by 1e6 and stiffnesses that differ by 1e8."""
    hertz = {"law": "Hertz", "stiffness": 1.0}
    dashpot = {"law": "Dashpot", "stiffness": 1.0, "damping": 0.2}
    hunt = {"law": "HuntCrossley", "stiffness": 1.0, "exponent": 1.5, "dissipation": 0.3}
    light = {"law": "Dashpot", "stiffness": 1.0, "damping": 1e-3}
    for gap in (0.0, 2.0):
        for lower in (dashpot, hunt):
            yield fall([1.0, 1e-6], [lower, {**hertz, "stiffness": 1e-6}], [gap], 1.0)
        yield fall([1e-4, 1.0], [hertz, light], [gap], 1.0)
        yield fall([1.0, 0.5], [{**hertz, "stiffness": 1e8}, dashpot], [gap], 1.0)
        yield fall([1.0, 0.5], [hunt, {**dashpot, "stiffness": 1e-8, "damping": 1e-4}], [gap], 1.0)


def resumed() -> Iterator[Case]:
    """Yield cases in which a clipped force comes back before the compression is gone."""
    strong = {"law": "Dashpot", "stiffness": 0.06, "damping": 5.3}
    hunt = {"law": "HuntCrossley", "stiffness": 1.0, "exponent": 1.17, "dissipation": 1.08}
    yield fall([0.2, 2.3], [strong, hunt], [0.94], 1.0)
    loose = {"law": "Viscoelastic", "stiffness": 0.65, "dissipative_time": 6.6}
    firm = {"law": "HuntCrossley", "stiffness": 40.0, "exponent": 1.0, "dissipation": 11.6}
    top = {"law": "Viscoelastic", "stiffness": 45.7, "dissipative_time": 0.43}
    yield fall([0.175, 0.035, 0.0195], [loose, firm, top], [0.0, 3.44], 1.0)
    slow = {"law": "Viscoelastic", "stiffness": 13.0, "dissipative_time": 1.23}
    soft = {"law": "Dashpot", "stiffness": 0.176, "damping": 17.5}
    hard = {"law": "Dashpot", "stiffness": 10.8, "damping": 0.82}
    yield fall([0.39, 0.02, 3.3], [slow, soft, hard], [2.8, 3.36], 1.0)
    three = [(24.3, 5.26), (17.3, 3.79), (4.72, 2.08)]
    dashpots = [{"law": "Dashpot", "stiffness": k, "damping": b} for k, b in three]
    yield fall([1.45, 0.46, 1.21], dashpots, [5.82, 3.58], 1.0)
    wide = [(0.45, 1.16), (15.4, 7.5), (7.1, 1.48)]
    dashpots = [{"law": "Dashpot", "stiffness": k, "damping": b} for k, b in wide]
    crossed = fall([2.8, 28.5, 71.6], dashpots, [0.0, 0.0], 1.0)
    yield {**crossed, "velocities": [-0.78, 0.84, -0.34]}


def gravity() -> Iterator[Case]:
    """Yield drops with gravity that are followed through several bounces."""
    spring, hertz = {"law": "Spring", "stiffness": 900.0}, {"law": "Hertz", "stiffness": 4e4}
    dashpot = {"law": "Dashpot", "stiffness": 900.0, "damping": 3.0}
    hunt = {"law": "HuntCrossley", "stiffness": 4e4, "exponent": 1.5, "dissipation": 0.2}
    for contacts, gaps in (([dashpot], []), ([hunt, spring], [0.01]), ([dashpot, hertz], [0.0])):
        case = fall([0.2, 0.05][: len(contacts)], contacts, gaps, 2.0)
        yield {**case, "gravity": 9.81, "until": 0.7}


def nested() -> Iterator[Case]:
    """Yield drops in which a contact has more than twenty cycles inside one another."""
    for floor, exponent, weight, until in ((0.3, 1.5, 0.045, 35.0), (0.1, 1.0, 0.1, 30.0)):
        contacts = [
            {"law": "Hysteretic", "stiffness": k, "exponent": p, "restitution": e}
            for k, p, e in ((10.0, 2.5 - exponent, floor), (0.1, exponent, 0.9))
        ]
        yield {**fall([1.0, 1.0], contacts, [0.0], 1.0), "gravity": weight, "until": until}


def solve(case: Case) -> Outcome:
    """Solve a case to thirty digits."""
    return precise.run(**case)


def solve_quickly(case: Case, limit: int = 1_000_000) -> Solution:
    """Solve a case in double precision."""
    return integrate(**case, limit=limit)


def confirmed(case: Case, outcome: Outcome) -> bool:
    """Return whether `integrate` finds the same counts, velocities to 1e-9, and times to 1e-7."""
    found = solve_quickly(case)
    speed, time = max(map(abs, case["velocities"])), float(outcome.end_time)
    velocities = np.array([float(x) for x in outcome.velocities])
    if found.counts != outcome.counts(len(velocities)):
        return False
    listed = [(i.contact, i.start, np.nan if i.end is None else i.end) for i in outcome.intervals]
    times = np.array(sorted(listed, key=lambda x: x[:2]), dtype=float)
    other = np.array(sorted(found.intervals[:, :3].tolist(), key=lambda x: x[:2]))
    return bool(
        np.max(np.abs(velocities - found.velocities)) < 1e-9 * speed
        and np.allclose(times, other, rtol=0, atol=1e-7 * time, equal_nan=True)
    )


def cases() -> Iterator[Case]:
    """Yield all cases."""
    return chain(one_ball(), resumed(), gravity(), extremes(), random_stacks(), nested())


def confirmed_rows(cases: Iterable[Case]) -> Iterator[str]:
    """Yield the rows of the cases whose solutions are confirmed, with 28 digits."""
    for case in cases:
        outcome = solve(case)
        if confirmed(case, outcome):
            yield row(case, outcome, DIGITS)


if __name__ == "__main__":
    write("laws", confirmed_rows(cases()))
