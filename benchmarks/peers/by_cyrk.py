"""CyRK's pysolve_ivp with events: a compiled DOP853, its right-hand side compiled by numba."""

from typing import Any

import numba
import numpy as np

from benchmarks.peers.by_hand import spring
from benchmarks.peers.common import FIRST_STEP, RTOL, Force, Leg, Peer, State, one_by_one


def prepare(force: Force = spring, rtol: float = RTOL) -> Any:
    """Return the function that solves drops under a force, to a tolerance."""
    from CyRK import pysolve_ivp

    @numba.njit
    def slope(
        rates: Any,
        _: float,
        y: Any,
        k0: float,
        k1: float,
        d0: float,
        d1: float,
        m0: float,
        m1: float,
    ) -> None:
        floor, balls = force(k0, d0, y[0], y[2], 0.0), force(k1, d1, y[1], y[3], 0.0)
        lower = m0 * (floor - balls)
        rates[0], rates[1] = y[2], y[3]
        rates[2], rates[3] = -lower, lower - m1 * balls

    def event(i: int, closed: bool) -> Any:
        def compression(_: float, y: Any, *__: float) -> float:
            return y[i]

        compression.terminal, compression.direction = True, -1 if closed else 1
        return compression

    events = {(i, closed): event(i, closed) for i in (0, 1) for closed in (False, True)}

    def leg_of(*numbers: float) -> Leg:
        k0, k1, d0, d1, *over_mass = numbers

        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            done = pysolve_ivp(
                slope,
                (0.0, end),
                np.array(state),
                method="DOP853",
                events=tuple(events[i, closed[i]] for i in (0, 1)),
                args=(
                    *(k0 * closed[0], k1 * closed[1], d0 * closed[0], d1 * closed[1]),
                    *over_mass,
                ),
                rtol=rtol,
                atol=rtol,
                first_step=FIRST_STEP if any(closed) else 0.0,
                pass_dy_as_arg=True,
            )
            return done.y[:, -1].tolist(), [i for i in (0, 1) if len(done.t_events[i])]

        return leg

    return one_by_one(leg_of)


PEER = Peer("CyRK", "CyRK", "pysolve_ivp, DOP853, events", prepare)
