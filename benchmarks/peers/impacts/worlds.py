"""A stack in a program that moves rigid bodies by small steps, as games and robots need it.

Such a program is told the bodies and steps them; what collides is read off from one step to the
next. There are `PER_GAP` steps while v0 crosses the narrowest gap. The time of a collision is that
at which both balls would have met with the velocities before the step.
"""

from collections.abc import Callable, Sequence
from typing import Protocol

from benchmarks.peers.impacts.common import Answer, Problem, Unsupported

PER_GAP = 500
MOST_STEPS = 750_000
EQUAL = 1e-9  # approaches that are slower, in v0, are none


class World(Protocol):
    """A stack in a program."""

    def step(self, dt: float) -> None:
        """Go on by dt."""

    def look(self) -> tuple[Sequence[float], Sequence[float]]:
        """Return the distances of all contacts, 0 where they touch, and the balls' velocities."""


def play(problem: Problem, build: Callable[[Problem, float], World]) -> Answer:
    """Build a world from a problem and a step, and step it to the end of the story."""
    if "end" in problem["ask"] and problem["gravity"] == 0.0:
        raise Unsupported("infinitely many collisions in a finite time")
    v = list(problem["velocities"])
    speed = max(map(abs, v))
    until, distances = problem["until"], [0.0, *problem["gaps"]]
    narrow = min((x for x in distances if x > 0.0), default=None)
    dt = (narrow / speed if narrow else speed / problem["gravity"]) / PER_GAP
    world, floor = build(problem, dt), problem["contacts"][0] is not None
    times: list[list[float]] = [[] for _ in v]
    first = 0 if floor else 1
    for step in range(1, MOST_STEPS + 1):
        rates = _approaches(v)
        if until is None and all(u <= EQUAL * speed for u in rates[first:]):
            break
        if until is not None and step * dt > until:
            break
        before = distances
        world.step(dt)
        distances, v = world.look()
        reach = 2.0 * dt * max(map(abs, [*rates, *_approaches(v)]))
        for i, (earlier, now) in enumerate(zip(rates, _approaches(v), strict=True)):
            near = min(before[i], distances[i]) < reach
            if i >= first and earlier > 0.0 >= now and near:
                times[i].append((step - 1) * dt + before[i] / earlier)
    else:
        raise ArithmeticError(f"not over after {MOST_STEPS} steps")
    return {
        "velocities": [float(x) for x in v],
        "counts": [len(row) for row in times],
        "first_touch": [row[0] if row else None for row in times],
        "last_release": [row[-1] if row else None for row in times],
        "status": "parted" if until is None else "stopped",
    }


def _approaches(v: Sequence[float]) -> list[float]:
    return [below - x for below, x in zip([0.0, *v], v, strict=False)]
