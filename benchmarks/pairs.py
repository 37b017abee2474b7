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
from stackbounce.model.laws import ContactLaw, contact_numbers
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


def random_drops(law: ContactLaw, count: int = COUNT, seed: int = 1) -> Drops:
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
def _hertz(k: float, d: float, c: float, r: float) -> float:  # noqa: ARG001 - one signature for all
    return k * c * math.sqrt(c) if c > 0.0 else 0.0


@numba.njit  # type: ignore[untyped-decorator]
def _power(k: float, d: float, c: float, r: float) -> float:  # noqa: ARG001 - the same
    return k * c**2.2 if c > 0.0 else 0.0


@numba.njit  # type: ignore[untyped-decorator]
def _viscoelastic(k: float, d: float, c: float, r: float) -> float:
    return max(0.0, k * math.sqrt(c) * (c + 1.5 * d * r)) if c > 0.0 else 0.0


@numba.njit  # type: ignore[untyped-decorator]
def _hunt_crossley(k: float, d: float, c: float, r: float) -> float:
    return max(0.0, k * c * math.sqrt(c) * (1.0 + d * r)) if c > 0.0 else 0.0


@numba.njit  # type: ignore[untyped-decorator]
def _dashpot(k: float, d: float, c: float, r: float) -> float:
    return max(0.0, k * c + d * r) if c > 0.0 else 0.0


FORCES = dict(zip(LAWS, (_hertz, _power, _viscoelastic, _hunt_crossley, _dashpot), strict=True))


def by_hand(force: Any) -> Any:
    """Return the loop for a force, which writes the final velocities of drops to ``final``."""

    @numba.njit  # type: ignore[untyped-decorator]
    def accelerations(
        m0: float, m1: float, k: Any, d: Any, q0: float, q1: float, v0: float, v1: float
    ) -> Any:
        floor, balls = force(k[0], d[0], -q0, -v0), force(k[1], d[1], q0 - q1, v0 - v1)
        return (floor - balls) / m0, balls / m1

    @numba.njit  # type: ignore[untyped-decorator]
    def loop(m: Any, k: Any, d: Any, gap: Any, speed: Any, dt: Any, final: Any) -> None:
        for i in range(len(gap)):
            h, half, m0, m1, ki, di = dt[i], 0.5 * dt[i], m[i, 0], m[i, 1], k[i], d[i]
            q0, q1, v0, v1 = 0.0, gap[i], -speed[i], -speed[i]
            for _ in range(1_000_000):
                a0, a1 = accelerations(m0, m1, ki, di, q0, q1, v0, v1)
                u0, u1 = v0 + half * a0, v1 + half * a1
                b0, b1 = accelerations(m0, m1, ki, di, q0 + half * v0, q1 + half * v1, u0, u1)
                w0, w1 = v0 + half * b0, v1 + half * b1
                e0, e1 = accelerations(m0, m1, ki, di, q0 + half * u0, q1 + half * u1, w0, w1)
                x0, x1 = v0 + h * e0, v1 + h * e1
                f0, f1 = accelerations(m0, m1, ki, di, q0 + h * w0, q1 + h * w1, x0, x1)
                q0 += h / 6.0 * (v0 + 2.0 * (u0 + w0) + x0)
                q1 += h / 6.0 * (v1 + 2.0 * (u1 + w1) + x1)
                v0 += h / 6.0 * (a0 + 2.0 * (b0 + e0) + f0)
                v1 += h / 6.0 * (a1 + 2.0 * (b1 + e1) + f1)
                if q0 > 0.0 and q1 > q0:  # free flight, to the next touch if there is one
                    if v0 >= 0.0 and v1 >= v0:
                        break
                    wait = -q0 / v0 if v0 < 0.0 else math.inf
                    if v0 > v1:
                        wait = min(wait, (q1 - q0) / (v0 - v1))
                    q0, q1 = q0 + wait * v0, q1 + wait * v1
            final[i, 0], final[i, 1] = v0, v1

    return loop


def _loop(drops: Drops, loop: Any, steps: int) -> Callable[[], Any]:
    """Return what solves drops by hand and returns the velocities."""
    speed, p = -drops.velocity[:, 0], drops.second[0, 0]
    reduced = np.column_stack([drops.mass[:, 0], 1.0 / (1.0 / drops.mass).sum(axis=1)])
    depth = (reduced * speed[:, None] ** 2 / drops.first) ** (1.0 / (p + 1.0))
    dt = 3.0 * depth.min(axis=1) / speed / steps
    gap, final = np.ascontiguousarray(drops.gap[:, 1]), np.empty((len(speed), 2))

    def call() -> Any:
        loop(drops.mass, drops.first, drops.third, gap, speed, dt, final)
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


def measure(name: str) -> list[tuple[str, float, float, float]]:
    """Return the ways to solve random drops of a law: name, time in s a drop, errors.

    The errors are the median, and that which 1 % of the drops exceed.
    """
    drops, loop = random_drops(LAWS[name]), by_hand(FORCES[name])
    truth, _ = _general(drops, TRUTH)
    right = truth().copy()
    ways = {f"loop, {steps} steps": _loop(drops, loop, steps) for steps in STEPS}
    ways |= {f"lanes, rtol {rtol:.0e}": _lanes(drops, rtol)[0] for rtol in TOLERANCES}
    ways |= {f"drop by drop, rtol {rtol:.0e}": _general(drops, rtol)[0] for rtol in TOLERANCES}
    found = dict.fromkeys(ways, math.inf)
    errors: dict[str, Any] = {}
    for _ in range(ROUNDS + 1):  # the first one compiles
        for way, solve in ways.items():
            start = process_time()
            velocity = solve()
            found[way] = min(found[way], process_time() - start)
            error = np.abs(velocity - right).max(axis=1) / -drops.velocity[:, 0]
            errors[way] = np.nanquantile(error, [0.5, 0.99])
    return [(way, time / COUNT, *map(float, errors[way])) for way, time in found.items()]


def main() -> None:
    """Measure and print."""
    console = Console(highlight=False)
    for name in LAWS:
        table = Printed(title=name)
        for head in ("way", "µs a drop", "median error", "99 %"):
            table.add_column(head, justify="left" if head == "way" else "right")
        for way, time, median, most in measure(name):
            table.add_row(way, f"{1e6 * time:.2f}", f"{median:.1e}", f"{most:.1e}")
        console.print(table)


if __name__ == "__main__":
    main()
