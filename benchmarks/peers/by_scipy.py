"""SciPy's solve_ivp with events, started again at each touch and release."""

from typing import Any

import numpy as np

from benchmarks.peers.by_hand import spring
from benchmarks.peers.common import FIRST_STEP, RTOL, Force, Leg, Peer, State, one_by_one


def prepare(force: Force = spring, rtol: float = RTOL) -> Any:
    """Return the function that solves drops under a force, to a tolerance."""
    from scipy.integrate import solve_ivp

    plain = force.py_func

    def event(i: int, closed: bool) -> Any:
        def compression(_: float, y: np.ndarray) -> float:
            return y[i]

        compression.terminal, compression.direction = True, -1 if closed else 1
        return compression

    events = {(i, closed): event(i, closed) for i in (0, 1) for closed in (False, True)}

    def leg_of(k0: float, k1: float, d0: float, d1: float, *over_mass: float) -> Leg:
        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            def slope(_: float, y: np.ndarray) -> list[float]:
                c0, c1, u0, u1 = y.tolist()
                floor = plain(k0, d0, c0, u0, 0.0) if closed[0] else 0.0
                balls = plain(k1, d1, c1, u1, 0.0) if closed[1] else 0.0
                lower = over_mass[0] * (floor - balls)
                return [u0, u1, -lower, lower - over_mass[1] * balls]

            watched = [events[i, closed[i]] for i in (0, 1)]
            done = solve_ivp(
                *(slope, (0.0, end), state, "DOP853"),
                events=watched,
                rtol=rtol,
                atol=rtol,
                first_step=FIRST_STEP if any(closed) else None,
            )
            return done.y[:, -1].tolist(), [i for i in (0, 1) if len(done.t_events[i])]

        return leg

    return one_by_one(leg_of)


PEER = Peer("SciPy", "scipy", "solve_ivp, DOP853, events", prepare)
