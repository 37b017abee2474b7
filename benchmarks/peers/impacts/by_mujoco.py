"""MuJoCo: spheres on vertical slides, whose contacts are springs and dashpots that may not pull.

A MuJoCo contact is soft. Its `solref` is a stiffness and a damping over the reduced mass of both
balls, and its impedance d says how it acts together with other contacts: near 0 each contact has
its own force, as springs have, and near 1 each has its own acceleration. So Spring and Dashpot get
the smallest d that is allowed, and the result is off by about as much. There is no restitution: a
rigid contact is a short, stiff spring with the damping that has this restitution.
"""

import math
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve, Unsupported, require

SMALLEST, LARGEST = 1e-4, 0.9999  # impedances
STEPS = 200  # of RK4 to the shortest contact
BRIEF = 0.02  # the time of a rigid contact, over the time in which v0 crosses the narrowest gap
EQUAL = 1e-3  # approaches that are slower, in v0, are within its errors, and count as none
MOST_STEPS = 1_000_000
RADIUS = 1.0  # m; the balls may be of any size


def damping_ratio(restitution: float) -> float:
    """Return the ratio to critical damping of a dashpot with that restitution, by halving.

    The contact ends when its force is zero.
    """
    low, high = 0.0, 1.0 - 1e-9
    for _ in range(60):
        z = 0.5 * (low + high)
        r = math.sqrt(1.0 - z * z)
        e = math.exp(-z / r * math.atan2(2.0 * z * r, 2.0 * z * z - 1.0))
        low, high = (z, high) if e > restitution else (low, z)
    return 0.5 * (low + high)


class Stack:
    """A model, its data, and how to read contacts off it."""

    def __init__(self, mujoco: Any, problem: Problem) -> None:
        self.mujoco, self.problem = mujoco, problem
        masses, v = problem["masses"], problem["velocities"]
        self.gaps, speed = [0.0, *problem["gaps"]], max(map(abs, v))
        narrow = min((gap for gap in self.gaps if gap > 0.0), default=speed**2 / 1e3)
        self.contacts = []
        shortest = math.inf
        for i, law in enumerate(problem["contacts"]):
            inverse = 1.0 / masses[i] + (1.0 / masses[i - 1] if i else 0.0)
            if law is None:
                self.contacts.append(None)
            elif law["law"] == "Rigid":
                duration = BRIEF * narrow / speed
                omega = math.pi / duration
                ratio = 0.0 if law["restitution"] == 1.0 else damping_ratio(law["restitution"])
                self.contacts.append((omega**2, 2.0 * ratio * omega, LARGEST))
                shortest = min(shortest, duration)
            else:
                stiffness, damping = law["stiffness"] * inverse, law.get("damping", 0.0) * inverse
                self.contacts.append((stiffness, damping, SMALLEST))
                shortest = min(shortest, math.pi / math.sqrt(stiffness))
        self.dt = shortest / STEPS
        self.model = mujoco.MjModel.from_xml_string(self._xml())
        self.data = mujoco.MjData(self.model)
        for i, rate in enumerate(v):
            self.data.qvel[i] = rate
        mujoco.mj_forward(self.model, self.data)

    def _xml(self) -> str:
        bodies, pairs, height = "", "", 0.0
        for i, mass in enumerate(self.problem["masses"]):
            height += self.gaps[i] + RADIUS
            bodies += (
                f'<body pos="0 0 {height!r}"><joint type="slide" axis="0 0 1"/>'
                f'<geom name="g{i}" type="sphere" size="{RADIUS}" mass="{mass!r}"/></body>'
            )
            height += RADIUS
            if self.contacts[i]:
                stiffness, damping, d = self.contacts[i]
                below = f"g{i - 1}" if i else "floor"
                pairs += (
                    f'<pair geom1="{below}" geom2="g{i}" condim="1" margin="0" '
                    f'solref="{-stiffness!r} {-damping!r}" solimp="{d} {d} 1 0.5 1"/>'
                )
        return (
            f'<mujoco><option timestep="{self.dt!r}" integrator="RK4" '
            f'gravity="0 0 {-self.problem["gravity"]!r}" tolerance="0" iterations="100"/>'
            '<default><geom contype="0" conaffinity="0"/></default><worldbody>'
            f'<geom name="floor" type="plane" size="9 9 1"/>{bodies}</worldbody>'
            f"<contact>{pairs}</contact></mujoco>"
        )

    def step(self) -> None:
        """Go on by a step."""
        self.mujoco.mj_step(self.model, self.data)

    def look(self) -> tuple[list[float], list[float]]:
        """Return how far all contacts are compressed, and at which rates."""
        q, v = self.data.qpos.tolist(), self.data.qvel.tolist()
        lengths = [low - x - gap for low, x, gap in zip([0.0, *q], q, self.gaps, strict=False)]
        return lengths, [low - x for low, x in zip([0.0, *v], v, strict=False)]


def play(mujoco: Any, problem: Problem) -> Answer:
    """Step a stack to the end of its story; a contact lasts while it is compressed."""
    stack = Stack(mujoco, problem)
    until, contacts = problem["until"], [i for i, x in enumerate(stack.contacts) if x]
    equal = EQUAL * max(map(abs, problem["velocities"]))
    closed = {i for i in contacts if stack.gaps[i] == 0.0}
    intervals: list[list[list[float | None]]] = [
        [[0.0, None]] if i in closed else [] for i in range(len(stack.gaps))
    ]
    for number in range(MOST_STEPS):
        lengths, rates = stack.look()
        time = number * stack.dt
        for i in contacts:
            if lengths[i] > 0.0 and i not in closed:
                closed.add(i)
                intervals[i].append([time - lengths[i] / rates[i] if rates[i] else time, None])
            elif lengths[i] < 0.0 and i in closed:
                closed.discard(i)
                intervals[i][-1][1] = time - lengths[i] / rates[i] if rates[i] else time
        if until is None and not closed and all(rates[i] <= equal for i in contacts):
            break
        if until is not None and time >= until:
            break
        stack.step()
    else:
        raise ArithmeticError(f"not over after {MOST_STEPS} steps")
    last = [[end for _, end in row] for row in intervals]
    return {
        "velocities": stack.data.qvel.tolist(),
        "counts": [len(row) for row in intervals],
        "first_touch": [row[0][0] if row else None for row in intervals],
        "last_release": [max(x) if x and None not in x else None for x in last],
        "status": "parted" if until is None else "stopped",
    }


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import mujoco

    def solve(problem: Problem) -> Answer:
        require(problem, "Spring", "Dashpot", "Rigid")
        if "end" in problem["ask"] and problem["gravity"] == 0.0:
            raise Unsupported("infinitely many collisions in a finite time")
        return play(mujoco, problem)

    return solve


PEER = Peer(
    "MuJoCo",
    "mujoco",
    "robots: many bodies with soft contacts, in real time",
    f"RK4, {STEPS} steps to the shortest contact, slides, solref and solimp for each contact",
    prepare,
)
