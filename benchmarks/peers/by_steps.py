"""A fixed-step loop as a student would write it: velocity Verlet, compiled by numba.

A thousand steps to the shortest contact time; a contact counts when its compression has risen
above zero from one step to the next. It stops once both contacts are open and none approaches, or
after `PATIENCE` times the longest contact time.
"""

import math
from typing import Any

import numba
import numpy as np

from benchmarks.peers.common import Answer, Peer
from benchmarks.random_drops import Drops

STEPS = 1000  # to a contact time
PATIENCE = 100.0


@numba.njit
def _accelerations(q0: float, q1: float, m: Any, k: Any) -> tuple[float, float]:
    floor = k[0] * max(0.0, -q0)
    upper = k[1] * max(0.0, q0 - q1)
    return (floor - upper) / m[0], upper / m[1]


@numba.njit
def _bounce(m: Any, k: Any, gap: float, velocities: Any, counts: Any) -> None:
    """Solve one drop; the velocities and counts are written to where they belong."""
    times = (
        math.pi * math.sqrt(m[0] / k[0]),
        math.pi * math.sqrt(m[0] * m[1] / (m[0] + m[1]) / k[1]),
    )
    dt, end = min(times) / STEPS, PATIENCE * max(times)
    q0, q1, v0, v1, t = 0.0, gap, -1.0, -1.0, 0.0
    a0, a1 = _accelerations(q0, q1, m, k)
    while t < end:
        closed0, closed1 = q0 < 0.0, q0 > q1
        q0 += dt * (v0 + 0.5 * dt * a0)
        q1 += dt * (v1 + 0.5 * dt * a1)
        b0, b1 = _accelerations(q0, q1, m, k)
        v0 += 0.5 * dt * (a0 + b0)
        v1 += 0.5 * dt * (a1 + b1)
        a0, a1 = b0, b1
        t += dt
        counts[0] += q0 < 0.0 and not closed0
        counts[1] += q0 > q1 and not closed1
        if q0 >= 0.0 and q0 <= q1 and v0 >= 0.0 and v0 <= v1:
            break
    velocities[0], velocities[1] = v0, v1


@numba.njit
def _all(masses: Any, stiffnesses: Any, gaps: Any, velocities: Any, counts: Any) -> None:
    for i in range(len(gaps)):
        _bounce(masses[i], stiffnesses[i], gaps[i], velocities[i], counts[i])


def prepare() -> Any:
    """Return the function that solves drops."""

    def solve(drops: Drops) -> Answer:
        velocities, counts = np.zeros((len(drops), 2)), np.zeros((len(drops), 2), dtype=np.int64)
        _all(drops.masses, drops.stiffnesses, drops.gaps, velocities, counts)
        return velocities, counts

    return solve


PEER = Peer("fixed steps", "numba", f"velocity Verlet, {STEPS} steps to a contact", prepare)
