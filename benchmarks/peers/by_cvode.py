"""CVODE of SUNDIALS through scikit-sundae: Adams steps, with the compressions as root functions."""

from typing import Any

import numpy as np

from benchmarks.peers.by_hand import spring
from benchmarks.peers.common import RTOL, Force, Leg, Peer, State, one_by_one


def prepare(force: Force = spring, rtol: float = RTOL) -> Any:
    """Return the function that solves drops under a force, to a tolerance.

    Only that of springs has its Jacobian matrix; CVODE finds that of others by differences.
    """
    from sksundae.cvode import CVODE

    plain = force.py_func

    def slope(_: float, y: np.ndarray, rates: np.ndarray, data: list[float]) -> None:
        c0, c1, u0, u1 = y.tolist()
        k0, k1, d0, d1, over_0, over_1 = data[:6]
        floor = plain(k0, d0, c0, u0, 0.0) if data[6] > 0.0 else 0.0
        balls = plain(k1, d1, c1, u1, 0.0) if data[7] > 0.0 else 0.0
        lower = over_0 * (floor - balls)
        rates[0], rates[1] = u0, u1
        rates[2], rates[3] = -lower, lower - over_1 * balls

    def jacobian(_: float, __: Any, ___: Any, matrix: np.ndarray, data: list[float]) -> None:
        floor, balls = max(0.0, data[6]) * data[0], max(0.0, data[7]) * data[1]
        matrix[0, 2] = matrix[1, 3] = 1.0
        matrix[2, 0], matrix[2, 1] = -data[4] * floor, data[4] * balls
        matrix[3, 0], matrix[3, 1] = data[4] * floor, -(data[4] + data[5]) * balls

    def compressions(_: float, y: np.ndarray, values: np.ndarray, data: list[float]) -> None:
        values[0], values[1] = data[6] * y[0], data[7] * y[1]

    compressions.terminal, compressions.direction = [True, True], [-1, -1]

    def leg_of(*numbers: float) -> Leg:
        data = [*numbers, 0.0, 0.0]
        solver = CVODE(  # one for each drop: it keeps all events that it has seen, and gets slow
            slope,
            method="Adams",
            rtol=rtol,
            atol=rtol,
            jacfn=jacobian if force is spring else None,
            eventsfn=compressions,
            num_events=2,
            userdata=data,
        )

        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            data[6:] = [1.0 if c else -1.0 for c in closed]  # all that is watched falls through 0
            done = solver.solve([0.0, end], state)
            hit = [] if done.i_events is None else np.flatnonzero(done.i_events[-1]).tolist()
            return done.y[-1].tolist(), hit

        return leg

    return one_by_one(leg_of)


PEER = Peer("CVODE", "scikit-sundae", "Adams, root functions", prepare)
