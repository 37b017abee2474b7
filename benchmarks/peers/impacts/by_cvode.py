"""CVODE of SUNDIALS through scikit-sundae: Adams steps with root functions."""

from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve
from benchmarks.peers.impacts.events import Event, Slopes, Story, follow, scales

RTOL = 1e-12
MOST_STEPS = 1_000_000


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import numpy as np
    from sksundae.cvode import CVODE

    def solve(problem: Problem) -> Answer:
        story, n = Story(problem, RTOL), len(problem["masses"])
        atol = RTOL * np.array(scales(story))

        def leg(
            slopes: Slopes, events: list[Event], t: float, y: Any, end: float, step: float
        ) -> tuple[float, Any, list[int]]:
            def rates(_: float, y: Any, out: Any) -> None:
                out[:] = slopes(y)

            def values(_: float, y: Any, out: Any) -> None:
                out[:] = [function(y[i], y[n + i]) for i, function, _ in events]

            values.terminal, values.direction = [True] * len(events), [-1] * len(events)
            solver = CVODE(
                rates,
                method="Adams",
                rtol=RTOL,
                atol=atol,
                max_step=step if step < np.inf else 0.0,
                max_num_steps=MOST_STEPS,
                eventsfn=values,
                num_events=len(events),
            )
            done = solver.solve([t, end], np.array(y))
            met = [] if done.i_events is None else np.flatnonzero(done.i_events[-1]).tolist()
            if not done.success and not met:
                raise ArithmeticError(str(done.message))
            return float(done.t[-1]), done.y[-1], met

        return follow(story, leg)

    return solve


PEER = Peer(
    "CVODE",
    "scikit-sundae",
    "ordinary differential equations, also stiff ones",
    f"Adams, rtol {RTOL:g}, root functions",
    prepare,
)
