"""SciPy's solve_ivp with events, started again at each touch and release."""

from typing import Any

import numpy as np

from benchmarks.peers.common import RTOL, Leg, Peer, State, one_by_one


def prepare() -> Any:
    """Return the function that solves drops."""
    from scipy.integrate import solve_ivp

    def event(i: int, closed: bool) -> Any:
        def compression(_: float, y: np.ndarray) -> float:
            return y[i]

        compression.terminal, compression.direction = True, -1 if closed else 1
        return compression

    events = {(i, closed): event(i, closed) for i in (0, 1) for closed in (False, True)}

    def leg_of(*numbers: float) -> Leg:
        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            floor, upper = numbers[0] * closed[0], numbers[1] * closed[1]
            lift = numbers[2] * closed[1]

            def slope(_: float, y: np.ndarray) -> list[float]:
                c0, c1, u0, u1 = y.tolist()
                lower = floor * c0 - upper * c1
                return [u0, u1, -lower, lower - lift * c1]

            watched = [events[i, closed[i]] for i in (0, 1)]
            done = solve_ivp(
                slope, (0.0, end), state, "DOP853", events=watched, rtol=RTOL, atol=RTOL
            )
            return done.y[:, -1].tolist(), [i for i in (0, 1) if len(done.t_events[i])]

        return leg

    return one_by_one(leg_of)


PEER = Peer("SciPy", "scipy", "solve_ivp, DOP853, events", prepare)
