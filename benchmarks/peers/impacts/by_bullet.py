"""Bullet through PyBullet: spheres on a vertical line, Newton's restitution."""

from collections.abc import Sequence

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve, Unsupported, require
from benchmarks.peers.impacts.worlds import PER_GAP, play

ITERATIONS = 50
NEAR = 1e-5  # of the widest gap: Bullet lets balls that are nearer bounce before they touch


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import pybullet as bullet

    client = bullet.connect(bullet.DIRECT)

    class Stack:
        """Spheres above a plane; the product of two restitutions counts, so the floor has 1."""

        def __init__(self, problem: Problem, dt: float) -> None:
            gaps = [0.0, *problem["gaps"]]
            bullet.resetSimulation()
            bullet.setGravity(0.0, 0.0, -problem["gravity"])
            bullet.setPhysicsEngineParameter(
                fixedTimeStep=dt,
                numSolverIterations=ITERATIONS,
                restitutionVelocityThreshold=0.0,
                contactSlop=0.0,
                contactBreakingThreshold=NEAR * max(gaps),
                erp=0.0,
                contactERP=0.0,
            )
            self.radius = 10.0 * max(gaps) or 1.0
            e = problem["contacts"][-1]["restitution"]
            shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=self.radius)
            quiet = {"linearDamping": 0.0, "angularDamping": 0.0, "lateralFriction": 0.0}
            self.balls: list[int] = []
            height = 0.0
            for gap, mass, v in zip(gaps, problem["masses"], problem["velocities"], strict=True):
                height += gap + self.radius
                ball = bullet.createMultiBody(mass, shape, basePosition=(0.0, 0.0, height))
                bullet.changeDynamics(ball, -1, restitution=e**0.5, **quiet)
                bullet.resetBaseVelocity(ball, (0.0, 0.0, v))
                height += self.radius
                self.balls.append(ball)
            if problem["contacts"][0]:
                plane = bullet.createCollisionShape(bullet.GEOM_PLANE)
                floor = bullet.createMultiBody(0.0, plane)
                bullet.changeDynamics(floor, -1, restitution=e**0.5, lateralFriction=0.0)

        def step(self, _: float) -> None:
            bullet.stepSimulation()

        def look(self) -> tuple[Sequence[float], Sequence[float]]:
            heights = [
                bullet.getBasePositionAndOrientation(ball)[0][2] - self.radius
                for ball in self.balls
            ]
            tops = [0.0, *(height + 2.0 * self.radius for height in heights)]
            distances = [x - top for x, top in zip(heights, tops, strict=False)]
            return distances, [bullet.getBaseVelocity(ball)[0][2] for ball in self.balls]

    def solve(problem: Problem) -> Answer:
        require(problem, "Rigid")
        if len({law["restitution"] for law in problem["contacts"] if law}) > 1:
            raise Unsupported("a restitution for each contact (a body has one)")
        if client < 0:
            raise ArithmeticError("the engine did not start")
        return play(problem, Stack)

    return solve


PEER = Peer(
    "PyBullet",
    "pybullet",
    "rigid bodies and robots in three dimensions",
    f"{PER_GAP} steps to the narrowest gap, {ITERATIONS} iterations, no threshold",
    prepare,
)
