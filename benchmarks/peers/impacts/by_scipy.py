"""SciPy's solve_ivp with events, started again at each touch, release and change of a curve."""

from functools import partial
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve
from benchmarks.peers.impacts.events import Event, Slopes, Story, follow, scales

SAMPLES = 100  # of a leg, where the largest force is looked for


def prepare(method: str, rtol: float) -> Solve:
    """Return the function that solves a problem."""
    import numpy as np
    from scipy.integrate import solve_ivp
    from scipy.optimize import minimize_scalar

    def watched(n: int, one: Event) -> Any:
        i, function, _ = one

        def value(_: float, y: Any) -> float:
            return function(y[i], y[n + i])

        value.terminal, value.direction = True, -1
        return value

    def solve(problem: Problem) -> Answer:
        story, n = Story(problem, rtol), len(problem["masses"])
        atol = rtol * np.array(scales(story))
        strongest = [0.0] * n

        def record(done: Any) -> None:
            times = np.linspace(done.t[0], done.t[-1], SAMPLES)
            for i in story.pressing:

                def minus_force(t: float, i: int = i) -> float:
                    y = done.sol(t)
                    return -story.contacts[i].force(y[i], y[n + i])

                sampled = [minus_force(t) for t in times]
                best = int(np.argmin(sampled))
                inside = times[max(best - 1, 0)], times[min(best + 1, SAMPLES - 1)]
                top = minimize_scalar(
                    minus_force, bounds=inside, method="bounded", options={"xatol": 0.0}
                )
                strongest[i] = max(strongest[i], -min(*sampled, top.fun))

        def leg(
            slopes: Slopes, events: list[Event], t: float, y: Any, end: float, step: float
        ) -> tuple[float, Any, list[int]]:
            done = solve_ivp(
                lambda _, y: slopes(y),
                (t, end),
                y,
                method,
                events=[watched(n, one) for one in events],
                rtol=rtol,
                atol=atol,
                max_step=step,
                dense_output="forces" in problem["ask"],
            )
            if done.status < 0:
                raise ArithmeticError(done.message)
            if "forces" in problem["ask"]:
                record(done)
            met = [k for k, times in enumerate(done.t_events) if len(times)]
            return done.t[-1], done.y[:, -1], met

        answer = follow(story, leg)
        if "forces" in problem["ask"]:
            answer["peak_force"] = [f or None for f in strongest]
        return answer

    return solve


def _peer(method: str, rtol: float) -> Peer:
    return Peer(
        f"SciPy {method}",
        "scipy",
        "ordinary differential equations",
        f"solve_ivp, {method}, rtol {rtol:g}, terminal events",
        partial(prepare, method, rtol),
    )


DOP853, RADAU = _peer("DOP853", 1e-13), _peer("Radau", 1e-10)
