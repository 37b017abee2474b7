"""Time against error of sweeps of two balls: in lanes, drop by drop, and by a loop by hand.

The loop is what an engineer would write instead: the classical Runge-Kutta method with a fixed
step, a part of the shorter contact time, compiled by numba. The drops are random: masses of 0.05
to 0.5 kg and 0.02 to 0.2 kg, stiffnesses over two decades, gaps of 0, 1 and 3 mm, 1 to 5 m/s. An
error is the larger one of both balls' velocities over the impact speed; times are the shortest of
some rounds on one thread, without compilation. Run `python -m benchmarks.pairs`.
"""

import math
from collections.abc import Callable
from time import process_time
from typing import Any

import numba
import numpy as np
from rich.console import Console
from rich.table import Table as Printed

import stackbounce as sb
from stackbounce.engine import native
from stackbounce.engine.memory import FINITE, lane_workspace, memory
from stackbounce.engine.records import Drops, Outcomes
from stackbounce.engine.tables import Table
from stackbounce.model.laws import contact_numbers
from stackbounce.run.batch import new_outcomes

LAWS = {
    "Hertz": sb.Hertz(1e6),
    "PowerLaw 2.2": sb.PowerLaw(1e6, 2.2),
    "Viscoelastic": sb.Viscoelastic(1e6, 1e-5),
    "HuntCrossley": sb.HuntCrossley(1e6, 1.5, 0.1),
    "Dashpot": sb.Dashpot(1e4, 1.0),
}
STEPS = (10, 20, 40, 80, 160)  # of the loop, in the shorter contact time
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-9, 1e-12)
TRUTH = 1e-13
COUNT = 4000
ROUNDS = 5


def random_drops(law: sb.Law, count: int = COUNT, seed: int = 1) -> Drops:
    """Return random drops, both of whose contacts have a law with other stiffnesses."""
    random, one = np.random.default_rng(seed), np.ones((count, 2))
    form, stiffness, *others = contact_numbers(law)
    speed = random.uniform(1.0, 5.0, (count, 1))
    gap = np.column_stack([np.zeros(count), random.choice([0.0, 1e-3, 3e-3], count)])
    mass = np.column_stack([random.uniform(0.05, 0.5, count), random.uniform(0.02, 0.2, count)])
    return Drops(
        mass,
        np.full((count, 2), form),
        stiffness * 10.0 ** random.uniform(-1.0, 1.0, (count, 2)),
        *(number * one for number in others),
        gap,
        -speed * one,
        np.zeros(count),
    )


@numba.njit  # type: ignore[untyped-decorator]
def _force(k: float, p: float, a: float, b: float, d: float, c: float, r: float) -> float:
    """Return k c^(p - 1) (a + b c + d r) (b + a c), which holds all of `LAWS`."""
    if c <= 0.0:
        return 0.0
    base = 1.0 if p == 1.0 else (math.sqrt(c) if p == 1.5 else c ** (p - 1.0))
    return max(0.0, k * base * (a + b * c + d * r) * (b + a * c))


@numba.njit  # type: ignore[untyped-decorator]
def _rates(m: Any, law: Any, y: Any) -> Any:
    q0, q1, v0, v1 = y
    k0, k1, p, a, b, d0, d1 = law
    floor = _force(k0, p, a, b, d0, -q0, -v0)
    balls = _force(k1, p, a, b, d1, q0 - q1, v0 - v1)
    return v0, v1, (floor - balls) / m[0], balls / m[1]


@numba.njit  # type: ignore[untyped-decorator]
def _moved(y: Any, h: float, f: Any) -> Any:
    return y[0] + h * f[0], y[1] + h * f[1], y[2] + h * f[2], y[3] + h * f[3]


@numba.njit  # type: ignore[untyped-decorator]
def by_hand(m: Any, laws: Any, gap: Any, speed: Any, dt: Any, final: Any) -> None:
    """Solve drops by the classical Runge-Kutta method; the velocities are written to ``final``."""
    for i in range(len(gap)):
        y, h, law = (0.0, gap[i], -speed[i], -speed[i]), dt[i], laws[i]
        for _ in range(1_000_000):
            f = _rates(m[i], law, y)
            g = _rates(m[i], law, _moved(y, 0.5 * h, f))
            u = _rates(m[i], law, _moved(y, 0.5 * h, g))
            w = _rates(m[i], law, _moved(y, h, u))
            y = _moved(_moved(_moved(y, h / 6.0, f), h / 3.0, g), h / 3.0, u)
            y = _moved(y, h / 6.0, w)
            apart = y[0] > 0.0 and y[1] > y[0]
            if apart and y[2] >= 0.0 and y[3] >= y[2]:
                break
            # free flight until the next touch
            if apart:
                floor = -y[0] / y[2] if y[2] < 0.0 else math.inf
                balls = (y[1] - y[0]) / (y[2] - y[3]) if y[2] > y[3] else math.inf
                wait = min(floor, balls)
                y = (y[0] + wait * y[2], y[1] + wait * y[3], y[2], y[3])
        final[i, 0], final[i, 1] = y[2], y[3]


def _loop(drops: Drops, law: sb.Law, steps: int) -> Callable[[], Any]:
    """Return what solves drops by hand and returns the velocities."""
    k, speed = drops.first, -drops.velocity[:, 0]
    p, loss, name = drops.second[0, 0], drops.third, type(law).__name__
    a, b, d = 1.0, 0.0, loss
    if name == "Dashpot":
        p, a, b, d = 1.0, 0.0, 1.0, loss / k
    elif name == "Viscoelastic":
        p, a, b, d = 1.5, 0.0, 1.0, 1.5 * loss
    elif name != "HuntCrossley":
        d = 0.0 * loss
    one = np.ones(len(speed))
    laws = np.column_stack([k, p * one, a * one, b * one, d])
    reduced = np.column_stack([drops.mass[:, 0], 1.0 / (1.0 / drops.mass).sum(axis=1)])
    depth = (reduced * speed[:, None] ** 2 / k) ** (1.0 / (p + 1.0))
    dt = 3.0 * depth.min(axis=1) / speed / steps
    gap, final = np.ascontiguousarray(drops.gap[:, 1]), np.empty((len(speed), 2))

    def call() -> Any:
        by_hand(drops.mass, laws, gap, speed, dt, final)
        return final

    return call


def _lanes(drops: Drops, rtol: float) -> tuple[Callable[[], Any], Outcomes]:
    out, space = new_outcomes(len(drops.gravity), 2), lane_workspace(compiled=True)
    solve, given = native.compiled("run_pairs"), (Table(drops), rtol, Table(out), Table(space))

    def call() -> Any:
        solve(*given)
        return np.where((out.status == sb.Status.FINISHED)[:, None], out.velocity, np.nan)

    return call, out


def _general(drops: Drops, rtol: float) -> tuple[Callable[[], Any], Outcomes]:
    out, room = new_outcomes(len(drops.gravity), 2), memory(FINITE, 2, compiled=True)
    options = math.inf, rtol, 10**6, 10**12

    def call() -> Any:
        room.run_batch(FINITE.run_batch, drops, options, out)
        return out.velocity

    return call, out


def measure(law: sb.Law) -> list[tuple[str, float, float, float]]:
    """Return the ways to solve random drops of a law: name, time in s a drop, errors.

    The errors are the median, and that which 1 % of the drops exceed.
    """
    drops = random_drops(law)
    truth, _ = _general(drops, TRUTH)
    right = truth().copy()
    ways = {f"loop, {steps} steps": _loop(drops, law, steps) for steps in STEPS}
    ways |= {f"lanes, rtol {rtol:.0e}": _lanes(drops, rtol)[0] for rtol in TOLERANCES}
    ways |= {f"drop by drop, rtol {rtol:.0e}": _general(drops, rtol)[0] for rtol in TOLERANCES}
    found = dict.fromkeys(ways, math.inf)
    errors: dict[str, Any] = {}
    for _ in range(ROUNDS + 1):  # the first one compiles
        for name, solve in ways.items():
            start = process_time()
            velocity = solve()
            found[name] = min(found[name], process_time() - start)
            error = np.abs(velocity - right).max(axis=1) / -drops.velocity[:, 0]
            errors[name] = np.nanquantile(error, [0.5, 0.99])
    return [(name, time / COUNT, *map(float, errors[name])) for name, time in found.items()]


def main() -> None:
    """Measure and print."""
    console = Console(highlight=False)
    for name, law in LAWS.items():
        table = Printed(title=name)
        for head in ("way", "µs a drop", "median error", "99 %"):
            table.add_column(head, justify="left" if head == "way" else "right")
        for way, time, median, most in measure(law):
            table.add_row(way, f"{1e6 * time:.2f}", f"{median:.1e}", f"{most:.1e}")
        console.print(table)


if __name__ == "__main__":
    main()
