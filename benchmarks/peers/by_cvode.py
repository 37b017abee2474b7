"""CVODE of SUNDIALS through scikit-sundae: Adams steps, with the compressions as root functions."""

from typing import Any

import numpy as np

from benchmarks.peers.common import RTOL, Leg, Peer, State, one_by_one


def prepare() -> Any:
    """Return the function that solves drops."""
    from sksundae.cvode import CVODE

    def slope(_: float, y: np.ndarray, rates: np.ndarray, data: list[float]) -> None:
        c0, c1, u0, u1 = y.tolist()
        lower = data[0] * c0 - data[1] * c1
        rates[0], rates[1] = u0, u1
        rates[2], rates[3] = -lower, lower - data[2] * c1

    def jacobian(_: float, __: Any, ___: Any, matrix: np.ndarray, data: list[float]) -> None:
        floor, upper, lift = data[:3]
        matrix[0, 2] = matrix[1, 3] = 1.0
        matrix[2, 0], matrix[2, 1] = -floor, upper
        matrix[3, 0], matrix[3, 1] = floor, -upper - lift

    def compressions(_: float, y: np.ndarray, values: np.ndarray, data: list[float]) -> None:
        values[0], values[1] = data[3] * y[0], data[4] * y[1]

    compressions.terminal, compressions.direction = [True, True], [-1, -1]

    def leg_of(*numbers: float) -> Leg:
        data = [0.0] * 5
        solver = CVODE(  # one for each drop: it keeps all events that it has seen, and gets slow
            slope,
            method="Adams",
            rtol=RTOL,
            atol=RTOL,
            jacfn=jacobian,
            eventsfn=compressions,
            num_events=2,
            userdata=data,
        )

        def leg(state: State, closed: list[bool], end: float) -> tuple[State, list[int]]:
            signs = [1.0 if c else -1.0 for c in closed]  # all that is watched falls through zero
            springs = numbers[0] * closed[0], numbers[1] * closed[1], numbers[2] * closed[1]
            data[:] = [*springs, *signs]
            done = solver.solve([0.0, end], state)
            hit = [] if done.i_events is None else np.flatnonzero(done.i_events[-1]).tolist()
            return done.y[-1].tolist(), hit

        return leg

    return one_by_one(leg_of)


PEER = Peer("CVODE", "scikit-sundae", "Adams, root functions", prepare)
