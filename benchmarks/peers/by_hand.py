"""Loops as an engineer would write them for two balls on a floor, instead of a sweep.

Of contacts with a force: the classical Runge-Kutta method with a fixed step, a part of the shorter
contact time, and a jump over free flights. Of rigid balls: one collision after the other. Both are
compiled by numba.
"""

import math
from collections.abc import Callable
from typing import Any

import numba
import numpy as np

from stackbounce.engine.records import Drops

Solver = Callable[[Drops, int], np.ndarray]
"""Returns the final velocities in m/s, of drops and for a number of steps in a contact."""


@numba.njit
def spring(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - one signature for all
    """A spring that pulls, too: who solves event by event lets it go where its force is 0."""
    return k * c


@numba.njit
def _hertz(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    return k * c * math.sqrt(c) if c > 0.0 else 0.0


@numba.njit
def _power(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    return k * c**2.2 if c > 0.0 else 0.0


@numba.njit
def _viscoelastic(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    return max(0.0, k * math.sqrt(c) * (c + 1.5 * d * r)) if c > 0.0 else 0.0


@numba.njit
def _hunt_crossley(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    return max(0.0, k * c * math.sqrt(c) * (1.0 + d * r)) if c > 0.0 else 0.0


@numba.njit
def _dashpot(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    return max(0.0, k * c + d * r) if c > 0.0 else 0.0


@numba.njit
def _hysteretic(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    """Unload from the peak s along a power d; when compressed again, go back the same way."""
    return (k * c if c >= s else k * s * (c / s) ** d) if c > 0.0 else 0.0


@numba.njit
def _relaxing(k: float, d: float, c: float, r: float, s: float) -> float:  # noqa: ARG001 - the same
    """A spring, and beside it one of d times its stiffness whose dashpot has given way by s."""
    return max(0.0, k * (c + d * (c - s)))


FORCES = {
    "Hertz": _hertz,
    "PowerLaw": _power,
    "Viscoelastic": _viscoelastic,
    "HuntCrossley": _hunt_crossley,
    "Dashpot": _dashpot,
    "Hysteretic": _hysteretic,
    "StandardLinearSolid": _relaxing,
}
"""The forces by their laws; s is what a contact remembers."""


def loop_of(law: str) -> Solver:
    """Return the loop for a law: two contacts with other stiffnesses and the same exponent."""
    force, creeps, remembers = FORCES[law], law == "StandardLinearSolid", law == "Hysteretic"

    @numba.njit
    def rate(c: float, s: float, d: float, w: float) -> float:
        """Return the rate at which the dashpot of a relaxing contact gives way, or recovers."""
        open_ = c + d * (c - s) <= 0.0
        return -s / ((1.0 + d) * w) if open_ else (c - s) / w

    @numba.njit
    def slope(m: Any, k: Any, d: Any, w: Any, y: Any) -> Any:
        q0, q1, v0, v1, s0, s1 = y
        floor, balls = force(k[0], d[0], -q0, -v0, s0), force(k[1], d[1], q0 - q1, v0 - v1, s1)
        u0 = rate(-q0, s0, d[0], w[0]) if creeps else 0.0
        u1 = rate(q0 - q1, s1, d[1], w[1]) if creeps else 0.0
        return v0, v1, (floor - balls) / m[0], balls / m[1], u0, u1

    @numba.njit
    def moved(y: Any, h: float, f: Any) -> Any:
        s0, s1 = (y[4] + h * f[4], y[5] + h * f[5]) if creeps else (y[4], y[5])
        return y[0] + h * f[0], y[1] + h * f[1], y[2] + h * f[2], y[3] + h * f[3], s0, s1

    @numba.njit
    def loop(m: Any, k: Any, d: Any, w: Any, gap: Any, speed: Any, dt: Any, final: Any) -> None:
        for i in range(len(gap)):
            h, mi, ki, di, wi = dt[i], m[i], k[i], d[i], w[i]
            y = 0.0, gap[i], -speed[i], -speed[i], 0.0, 0.0
            for _ in range(1_000_000):
                a = slope(mi, ki, di, wi, y)
                b = slope(mi, ki, di, wi, moved(y, 0.5 * h, a))
                e = slope(mi, ki, di, wi, moved(y, 0.5 * h, b))
                f = slope(mi, ki, di, wi, moved(y, h, e))
                y = moved(moved(y, h / 6.0, a), h / 3.0, b)
                y = moved(moved(y, h / 3.0, e), h / 6.0, f)
                q0, q1, v0, v1, s0, s1 = y
                if remembers:
                    s0 = max(s0, -q0) if q0 < 0.0 else 0.0
                    s1 = max(s1, q0 - q1) if q1 < q0 else 0.0
                    y = q0, q1, v0, v1, s0, s1
                if q0 > 0.0 and q1 > q0:  # free flight, to the next touch if there is one
                    if v0 >= 0.0 and v1 >= v0:
                        break
                    wait = -q0 / v0 if v0 < 0.0 else math.inf
                    if v0 > v1:
                        wait = min(wait, (q1 - q0) / (v0 - v1))
                    if creeps:
                        s0 *= math.exp(-wait / ((1.0 + di[0]) * wi[0]))
                        s1 *= math.exp(-wait / ((1.0 + di[1]) * wi[1]))
                    y = q0 + wait * v0, q1 + wait * v1, v0, v1, s0, s1
            final[i, 0], final[i, 1] = y[2], y[3]

    def solve(drops: Drops, steps: int) -> np.ndarray:
        speed, p = -drops.velocity[:, 0], drops.second[0, 0]
        reduced = np.column_stack([drops.mass[:, 0], 1.0 / (1.0 / drops.mass).sum(axis=1)])
        stiffness = drops.first * (1.0 + drops.third) if creeps else drops.first
        depth = (reduced * speed[:, None] ** 2 / stiffness) ** (1.0 / (p + 1.0))
        dt = 3.0 * depth.min(axis=1) / speed / steps
        gap, final = np.ascontiguousarray(drops.gap[:, 1]), np.empty((len(speed), 2))
        loop(drops.mass, drops.first, drops.third, drops.fourth, gap, speed, dt, final)
        return final

    return solve


@numba.njit
def collide(m: Any, e: Any, gap: Any, speed: Any, final: Any) -> None:
    """Solve rigid balls, which collide with the floor and with each other in turns."""
    for i in range(len(gap)):
        m0, m1, e0, e1 = m[i, 0], m[i, 1], e[i, 0], e[i, 1]
        v0, v1, height, above = -speed[i], -speed[i], 0.0, gap[i]
        while v0 < 0.0:
            v0 *= -e0
            if v0 <= v1:
                break
            wait = above / (v0 - v1)
            height, above, rate = height + wait * v0, 0.0, v0 - v1
            v0 -= (1.0 + e1) * rate * m1 / (m0 + m1)
            v1 = v0 + e1 * rate
            if v0 < 0.0:
                wait = -height / v0
                height, above = 0.0, above + wait * (v1 - v0)
        final[i, 0], final[i, 1] = v0, v1


def solve_rigid(drops: Drops) -> np.ndarray:
    """Return the final velocities in m/s of rigid balls."""
    gap, final = np.ascontiguousarray(drops.gap[:, 1]), np.empty(drops.mass.shape)
    collide(drops.mass, drops.third, gap, -np.ascontiguousarray(drops.velocity[:, 0]), final)
    return final
