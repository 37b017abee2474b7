"""Two balls on a floor as one would solve them with `scipy.integrate.solve_ivp`: the comparison.

A good script, not a straw man: it stops at every touch and release and goes on from there, so that
no step goes over the place where c^1.5 is not smooth, and its tolerances fit each number's size.
"""

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

END = 1.0  # s; all is over long before


def rebound(case: dict[str, Any], rtol: float) -> np.ndarray:
    """Return the velocities in m/s after the impact of two balls on Hertz or HuntCrossley contacts.

    Parameters
    ----------
    case : dict
        Masses, contacts, gaps and velocities in SI units, as in `tests/data/laws.json`.
    rtol : float
        The tolerance that DOP853 gets.
    """
    (m0, m1), (gap,) = case["masses"], case["gaps"]
    k = [law["stiffness"] for law in case["contacts"]]
    p = [law.get("exponent", 1.5) for law in case["contacts"]]
    chi = [law.get("dissipation", 0.0) for law in case["contacts"]]
    speed = max(map(abs, case["velocities"]))
    length = max((m0 * speed**2 / k[0]) ** (1.0 / (p[0] + 1.0)), gap)

    def force(i: int, c: float, rate: float) -> float:
        return max(0.0, k[i] * c ** p[i] * (1.0 + chi[i] * rate)) if c > 0.0 else 0.0

    def slope(_: float, y: np.ndarray) -> list[float]:
        q0, q1, v0, v1 = y.tolist()
        floor = force(0, -q0, -v0)
        upper = force(1, q0 - q1 - gap, v0 - v1)
        return [v0, v1, (floor - upper) / m0, upper / m1]

    def event(i: int, closed: bool) -> Any:
        def compression(_: float, y: np.ndarray) -> float:
            return -y[0] if i == 0 else y[0] - y[1] - gap

        compression.terminal, compression.direction = True, -1 if closed else 1
        return compression

    t, y = 0.0, np.array([0.0, 0.0, *case["velocities"]])
    closed = [True, gap == 0.0]
    atol = rtol * np.array([length, length, speed, speed])
    while any(closed) or y[2] < 0.0 or y[3] < y[2]:
        events = [event(i, closed[i]) for i in (0, 1)]
        done = solve_ivp(slope, (t, END), y, "DOP853", events=events, rtol=rtol, atol=atol)
        t, y = done.t[-1], done.y[:, -1]
        for i in (0, 1):
            closed[i] ^= len(done.t_events[i]) > 0
    return y[2:]
