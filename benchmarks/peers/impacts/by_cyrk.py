"""CyRK's pysolve_ivp with events: a compiled DOP853 that calls Python for slopes and events."""

from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve
from benchmarks.peers.impacts.events import Event, Slopes, Story, follow, scales

RTOL = 1e-13


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import numpy as np
    from CyRK import pysolve_ivp

    def watched(n: int, one: Event) -> Any:
        i, function, _ = one

        def value(_: float, y: Any, *__: Any) -> float:
            return float(function(y[i], y[n + i]))

        value.terminal, value.direction = True, -1
        return value

    def solve(problem: Problem) -> Answer:
        story, n = Story(problem, RTOL), len(problem["masses"])
        atol = RTOL * np.array(scales(story))

        def leg(
            slopes: Slopes, events: list[Event], t: float, y: Any, end: float, step: float
        ) -> tuple[float, Any, list[int]]:
            def rates(out: Any, _: float, y: Any) -> None:
                out[:] = slopes(y)

            done = pysolve_ivp(
                rates,
                (t, end),
                np.array(y),
                method="DOP853",
                events=tuple(watched(n, one) for one in events),
                rtol=RTOL,
                atol=atol,
                max_step=min(step, 1e300),
                pass_dy_as_arg=True,
            )
            if not done.success:
                raise ArithmeticError(done.message)
            met = [k for k, times in enumerate(done.t_events) if len(times)]
            return done.t[-1], done.y[:, -1], met

        return follow(story, leg)

    return solve


PEER = Peer(
    "CyRK",
    "CyRK",
    "ordinary differential equations, compiled",
    f"pysolve_ivp, DOP853, rtol {RTOL:g}, terminal events",
    prepare,
)
