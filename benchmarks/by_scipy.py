"""Two balls on a floor as one would solve them with `scipy.integrate.solve_ivp`: the comparison.

A good script, not a straw man: it stops at every touch and release and goes on from there, so that
no step goes over the place where c^1.5 is not smooth or a force changes its curve, and its
tolerances fit each number's size. What `solve_ivp` cannot see, two crossings of one level within a
step, it loses: one in a hundred drops with hysteresis comes out wrong, and its error says so.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.bundle import Bundle

END = 1e6  # s: an event comes before, however slowly a ball approaches
EVENTS = 300  # of one drop, at most: one that lost an event can go on for ever


def rebound(case: dict[str, Any], rtol: float) -> np.ndarray:
    """Return the velocities in m/s after the impact of two balls on nonlinear contacts.

    Parameters
    ----------
    case : dict
        Masses, contacts, gaps and velocities in SI units, as in `tests/data/laws.json`. The laws
        are Hertz, PowerLaw, HuntCrossley, Viscoelastic and Hysteretic.
    rtol : float
        The tolerance that DOP853 gets.
    """
    (m0, m1), (gap,) = case["masses"], case["gaps"]
    forces = [_Force(law) for law in case["contacts"]]
    speed = max(map(abs, case["velocities"]))
    p = forces[0].p
    length = max((m0 * speed**2 / forces[0].k) ** (1.0 / (p + 1.0)), gap)

    def contacts(y: np.ndarray) -> tuple[tuple[float, float], ...]:
        q0, q1, v0, v1 = y.tolist()
        return (-q0, -v0), (q0 - q1 - gap, v0 - v1)

    def slope(_: float, y: np.ndarray) -> list[float]:
        floor, upper = (
            force(c, rate) for force, (c, rate) in zip(forces, contacts(y), strict=True)
        )
        return [*y[2:].tolist(), (floor - upper) / m0, upper / m1]

    def event(i: int, part: int, level: float, direction: int) -> Any:
        def distance(_: float, y: np.ndarray) -> float:
            return contacts(y)[i][part] - level

        distance.terminal, distance.direction = True, direction
        return distance

    y = np.array([0.0, 0.0, *case["velocities"]])
    closed = [True, gap == 0.0]
    atol = rtol * np.array([length, length, speed, speed])
    for _ in range(EVENTS):
        if not any(closed) and 0.0 <= y[2] <= y[3]:
            break
        events = [event(i, 0, 0.0, -1 if closed[i] else 1) for i in (0, 1)]
        turns = [i for i in (0, 1) if closed[i] and forces[i].bundle]
        ends = [i for i in turns if 0.0 < forces[i].bundle.end < math.inf]
        ways = {i: -1 if forces[i].bundle.loading else 1 for i in turns}  # of the rate at a turn
        events += [event(i, 1, 0.0, ways[i]) for i in turns]
        events += [event(i, 0, forces[i].bundle.end, -ways[i]) for i in ends]
        done = solve_ivp(slope, (0.0, END), y, "DOP853", events=events, rtol=rtol, atol=atol)
        y = done.y[:, -1]
        happened = [len(times) > 0 for times in done.t_events]
        for i in (0, 1):
            closed[i] ^= happened[i]
            if happened[i] and forces[i].bundle:
                forces[i].bundle.forget()
        for i, turned in zip(turns, happened[2:], strict=False):
            if turned and closed[i]:
                forces[i].bundle.turn(contacts(y)[i][0])
        for i, ended in zip(ends, happened[2 + len(turns) :], strict=True):
            if ended and closed[i]:
                forces[i].bundle.go_on()
    return y[2:]


class _Force:
    """The force of one contact; one with hysteresis is a bundle of elements."""

    def __init__(self, law: dict[str, Any]) -> None:
        self.k = law["stiffness"]
        self.p = law.get("exponent", 1.0 if law["law"] == "Hysteretic" else 1.5)
        self.chi = law.get("dissipation", 0.0)
        self.time = law.get("dissipative_time", 0.0)
        e = law.get("restitution", 1.0)
        n = law.get("unloading_exponent", (self.p + 1.0) / e**2 - 1.0)
        self.bundle: Any = Bundle(self.k, self.p, n) if n > self.p else None

    def __call__(self, c: float, rate: float) -> float:
        if c <= 0.0:
            return 0.0
        if self.bundle:
            return float(self.bundle.force(c))
        elastic = c**self.p + 1.5 * self.time * math.sqrt(c) * rate
        return float(max(0.0, self.k * elastic * (1.0 + self.chi * rate)))
