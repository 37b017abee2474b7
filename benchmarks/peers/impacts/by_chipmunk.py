"""Chipmunk through pymunk: discs on a vertical line, Newton's restitution, impulses in turn."""

from collections.abc import Sequence
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve, require
from benchmarks.peers.impacts.worlds import PER_GAP, play

ITERATIONS = 50


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import pymunk

    class Stack:
        """Discs above a floor, with a restitution of their own for each contact."""

        def __init__(self, problem: Problem, _: float) -> None:
            self.space = pymunk.Space()
            self.space.iterations = ITERATIONS
            self.space.gravity = 0.0, -problem["gravity"]
            self.space.collision_slop = self.space.collision_bias = 0.0
            laws, gaps = problem["contacts"], [0.0, *problem["gaps"]]
            self.radius = 10.0 * max(gaps) or 1.0
            self.discs: list[Any] = []
            height = 0.0
            for i, (mass, v) in enumerate(
                zip(problem["masses"], problem["velocities"], strict=True)
            ):
                disc = pymunk.Body(mass, float("inf"))
                disc.position = 0.0, height + gaps[i] + self.radius
                disc.velocity = 0.0, v
                height += gaps[i] + 2.0 * self.radius
                self._add(disc, pymunk.Circle(disc, self.radius), i)
                self.discs.append(disc)
            if laws[0]:
                wide = 10.0 * self.radius
                ground = pymunk.Segment(
                    self.space.static_body, (-wide, -self.radius), (wide, -self.radius), self.radius
                )
                ground.elasticity, ground.collision_type = 1.0, 0
                self.space.add(ground)
            restitutions = [law and law["restitution"] for law in laws]

            def begin(arbiter: Any, *_: Any) -> None:
                upper = max(shape.collision_type for shape in arbiter.shapes)
                arbiter.restitution = restitutions[upper - 1]

            self.space.on_collision(pre_solve=begin)

        def _add(self, disc: Any, shape: Any, i: int) -> None:
            shape.elasticity, shape.collision_type = 1.0, i + 1  # 0 is the floor
            self.space.add(disc, shape)

        def step(self, dt: float) -> None:
            self.space.step(dt)

        def look(self) -> tuple[Sequence[float], Sequence[float]]:
            heights = [disc.position.y - self.radius for disc in self.discs]
            tops = [0.0, *(height + 2.0 * self.radius for height in heights)]
            distances = [x - top for x, top in zip(heights, tops, strict=False)]
            return distances, [disc.velocity.y for disc in self.discs]

    def solve(problem: Problem) -> Answer:
        require(problem, "Rigid")
        return play(problem, Stack)

    return solve


PEER = Peer(
    "pymunk (Chipmunk)",
    "pymunk",
    "rigid bodies in two dimensions, for games",
    f"{PER_GAP} steps to the narrowest gap, {ITERATIONS} iterations, no slop",
    prepare,
)
