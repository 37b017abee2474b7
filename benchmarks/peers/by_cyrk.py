"""CyRK's pysolve_ivp with events: a compiled DOP853, its right-hand side compiled by numba."""

from typing import Any

import numba
import numpy as np

from benchmarks.peers.common import RTOL, Leg, Peer, State, one_by_one


def prepare() -> Any:
    """Return the function that solves drops."""
    from CyRK import pysolve_ivp

    @numba.njit
    def slope(rates: Any, _: float, y: Any, floor: float, upper: float, lift: float) -> None:
        lower = floor * y[0] - upper * y[1]
        rates[0], rates[1] = y[2], y[3]
        rates[2], rates[3] = -lower, lower - lift * y[1]

    def event(i: int, closed: bool) -> Any:
        def compression(_: float, y: Any, *__: float) -> float:
            return y[i]

        compression.terminal, compression.direction = True, -1 if closed else 1
        return compression

    events = {(i, closed): event(i, closed) for i in (0, 1) for closed in (False, True)}

    def leg_of(*numbers: float) -> Leg:
        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            done = pysolve_ivp(
                slope,
                (0.0, end),
                np.array(state),
                method="DOP853",
                events=tuple(events[i, closed[i]] for i in (0, 1)),
                args=(numbers[0] * closed[0], numbers[1] * closed[1], numbers[2] * closed[1]),
                rtol=RTOL,
                atol=RTOL,
                pass_dy_as_arg=True,
            )
            return done.y[:, -1].tolist(), [i for i in (0, 1) if len(done.t_events[i])]

        return leg

    return one_by_one(leg_of)


PEER = Peer("CyRK", "CyRK", "pysolve_ivp, DOP853, events", prepare)
