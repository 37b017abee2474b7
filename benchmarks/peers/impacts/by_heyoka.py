"""heyoka's Taylor integrator with terminal events, which it finds as roots of polynomials.

A Taylor series in time needs forces that are smooth where a contact begins: springs, dashpots, and
Hunt-Crossley contacts of exponent 1. One integrator is compiled for a problem; which contacts
press, and the signs of the events, are its parameters.
"""

from itertools import pairwise
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve, Unsupported
from benchmarks.peers.impacts.events import (
    CLIPPED,
    OPEN,
    PRESSING,
    Contact,
    Event,
    Slopes,
    Story,
    follow,
    scales,
)

RTOL = 1e-15  # about the integrator's own
STEPS = 50  # at least, of a leg: in longer ones heyoka's search may lose a root
NOTHING = 1e-18  # of a length: after an event exactly at a step's beginning a later one is lost
WIDTH = (
    4  # parameters of a contact: 1 if it presses; signs of c and of the bracket; 1 if it is open
)


def parameters(contact: Contact | None) -> tuple[float, float, float, float]:
    """Return the parameters of a contact in its phase."""
    if contact is None:
        return 0.0, 0.0, 0.0, 0.0
    is_open, loads = contact.phase == OPEN, contact.phase == PRESSING
    clip = 1.0 if loads else -1.0 if contact.phase == CLIPPED else 0.0
    return float(loads), -1.0 if is_open else 1.0, clip, float(is_open)


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import heyoka as hy
    import numpy as np

    def integrator(story: Story) -> tuple[Any, list[int]]:
        """Return it, and the contact of each event: c, then the bracket if there is a rate."""
        n = len(story.masses)
        c = [hy.expression(f"c{i}") for i in range(n)]
        u = [hy.expression(f"u{i}") for i in range(n)]
        zero = hy.expression(0.0)
        forces, events, owners = [], [], []
        for i, x in enumerate(story.contacts):
            if not x:
                forces.append(zero)
                continue
            bracket = x.constant + x.slope * c[i] + x.rate * u[i]
            on, touch, clip, idle = (hy.par[WIDTH * i + k] for k in range(WIDTH))
            whole = on * x.stiffness * bracket
            forces.append(whole * c[i] if x.power else whole)
            watched = [touch * c[i]] + ([clip * bracket + idle] if x.rate else [])
            events += [hy.t_event(f, direction=hy.event_direction.negative) for f in watched]
            owners += [i] * len(watched)
        net = [
            (low - high) / m
            for low, high, m in zip(forces, [*forces[1:], zero], story.masses, strict=True)
        ]
        rates = [story.problem["gravity"] - net[0]]
        rates += [below - x for below, x in pairwise(net)]
        equations = [*zip(c, u, strict=True), *zip(u, rates, strict=True)]
        return hy.taylor_adaptive(equations, np.zeros(2 * n), t_events=events), owners

    def solve(problem: Problem) -> Answer:
        story = Story(problem, RTOL)
        if any(x and (x.power not in (0.0, 1.0) or x.bundle) for x in story.contacts):
            raise Unsupported("a force that has no Taylor series where the contact begins")
        made, owners = integrator(story)
        nothing = NOTHING * scales(story)[0]

        def leg(
            _: Slopes, events: list[Event], t: float, y: Any, end: float, step: float
        ) -> tuple[float, Any, list[int]]:
            values = [number for x in story.contacts for number in parameters(x)]
            made.pars[:] = values[: len(made.pars)]
            made.reset_cooldowns()
            made.time, made.state[:] = t, y
            for i, x in enumerate(story.contacts):
                if x and y[i] == 0.0:
                    made.state[i] = -nothing if x.phase == OPEN else nothing
            longest = min(step, (end - t) / STEPS)
            outcome = made.propagate_until(end, max_delta_t=longest)[0].value
            if outcome == hy.taylor_outcome.err_nf_state.value:
                raise ArithmeticError("the integrator met numbers that are not finite")
            number = -outcome - 1
            if number < 0 or number >= len(owners):
                return made.time, made.state.copy(), []
            of_bracket = number > 0 and owners[number - 1] == owners[number]
            mine = [k for k, (i, *_) in enumerate(events) if i == owners[number]]
            return made.time, made.state.copy(), [mine[of_bracket]]

        return follow(story, leg)

    return solve


PEER = Peer(
    "heyoka",
    "heyoka",
    "smooth ordinary differential equations, to round-off",
    "taylor_adaptive, terminal events",
    prepare,
)
