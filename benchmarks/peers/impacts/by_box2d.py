"""Box2D through pybox2d: discs on a vertical line, in single precision.

Box2D allows overlaps of 5 mm and takes approaches below 1 m/s for rest. Lengths and times are
therefore scaled, so that the narrowest gap is 1 m and v0 is 50 m/s.
"""

from collections.abc import Sequence
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve, Unsupported, require
from benchmarks.peers.impacts.worlds import PER_GAP, play

SPEED = 50.0
ITERATIONS = 50
RADIUS = 1.0


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import Box2D

    class Stack:
        """Discs above a floor; all contacts have one restitution."""

        def __init__(self, problem: Problem, _: float) -> None:
            speed = max(map(abs, problem["velocities"]))
            gaps = [0.0, *problem["gaps"]]
            self.length = min((gap for gap in gaps if gap > 0.0), default=speed**2 / 100.0)
            self.unit = speed / SPEED
            self.time = self.length / self.unit
            gravity = problem["gravity"] * self.time**2 / self.length
            self.world = Box2D.b2World(gravity=(0.0, -gravity), doSleep=False)
            self.discs: list[Any] = []
            height = 0.0
            for gap, mass, v in zip(gaps, problem["masses"], problem["velocities"], strict=True):
                height += gap / self.length + RADIUS
                disc = self.world.CreateDynamicBody(
                    position=(0.0, height),
                    linearVelocity=(0.0, v / self.unit),
                    fixedRotation=True,
                    bullet=True,
                )
                law = problem["contacts"][-1]
                disc.CreateCircleFixture(
                    radius=RADIUS, density=1.0, friction=0.0, restitution=law["restitution"]
                )
                disc.massData = Box2D.b2MassData(mass=mass, center=(0.0, 0.0), I=0.0)
                height += RADIUS
                self.discs.append(disc)
            if problem["contacts"][0]:
                floor = self.world.CreateStaticBody(position=(0.0, -1.0))
                floor.CreatePolygonFixture(
                    box=(10.0, 1.0),
                    friction=0.0,
                    restitution=problem["contacts"][0]["restitution"],
                )

        def step(self, dt: float) -> None:
            self.world.Step(dt / self.time, ITERATIONS, ITERATIONS)

        def look(self) -> tuple[Sequence[float], Sequence[float]]:
            heights = [disc.position.y - RADIUS for disc in self.discs]
            tops = [0.0, *(height + 2.0 * RADIUS for height in heights)]
            distances = [(x - top) * self.length for x, top in zip(heights, tops, strict=False)]
            return distances, [disc.linearVelocity.y * self.unit for disc in self.discs]

    def solve(problem: Problem) -> Answer:
        require(problem, "Rigid")
        if len({law["restitution"] for law in problem["contacts"] if law}) > 1:
            raise Unsupported("a restitution for each contact (a body has one, the larger counts)")
        return play(problem, Stack)

    return solve


PEER = Peer(
    "Box2D",
    "Box2D",
    "rigid bodies in two dimensions, for games, in single precision",
    f"{PER_GAP} steps to the narrowest gap, scaled to 1 m and {SPEED:g} m/s",
    prepare,
)
