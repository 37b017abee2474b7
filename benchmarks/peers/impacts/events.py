"""The story of finite contacts from event to event, for programs that integrate equations.

The unknowns are the compressions c of all contacts and their rates u, so that a contact far above
the floor loses no digits. A contact is open, pressing, or clipped: still compressed, while the
formula of its force would pull. An integration ends where one of these changes, and where the
elements of a contact with hysteresis change (`Bundle`), so that no step goes over a place where a
force is not smooth.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from benchmarks.bundle import Bundle
from benchmarks.peers.impacts.common import Answer, Problem, Unsupported

OPEN, PRESSING, CLIPPED = range(3)
TURNED, WENT_ON = range(3, 5)  # within a contact with hysteresis: see `Bundle`
MOST_EVENTS = 20_000
LONGEST = 1e6  # times the problem's own time, for a leg on which contacts press
NOISE = 1e-12  # of its length: round-off of a compression that begins at rest
SURE = 1e3  # times the tolerance: approaches that are slower, in v0, are none
STEPS = 10  # at least, on the shortest contact that presses

Event = tuple[int, Callable[[float, float], float], int]
"""A contact, a function of its compression and rate that falls through zero, the phase then."""

Slopes = Callable[[Any], list[float]]
"""From c and u, one after the other, to their derivatives."""

Leg = Callable[[Slopes, list[Event], float, Any, float, float], tuple[float, Any, list[int]]]
"""From slopes, events, a time, a state, an end and the longest step to the time and the state at
the first event or the end, and which events are met there."""


@dataclass
class Contact:
    """One contact: F = stiffness c**power (constant + slope c + rate u), and where it is in it."""

    law: str
    stiffness: float
    power: float
    constant: float = 1.0
    slope: float = 0.0
    rate: float = 0.0
    bundle: Bundle | None = None  # the elements of one with hysteresis
    phase: int = OPEN
    begun: float = 0.0
    clipped: float = 0.0
    noise: float = 0.0  # m, of a compression that begins at rest

    def bracket(self, c: float, u: float) -> float:
        """Return what has the sign of the formula's force."""
        return self.constant + self.slope * c + self.rate * u

    def force(self, c: float, u: float) -> float:
        """Return the force in the present phase."""
        if self.phase in (OPEN, CLIPPED) or (c <= 0.0 and self.power > 0.0):
            return 0.0
        if self.bundle:
            return float(self.bundle.force(c))
        return float(self.stiffness * c**self.power * self.bracket(c, u))

    def events(self) -> list[tuple[Callable[[float, float], float], int]]:
        """Return functions that fall through zero where the phase ends, and the phase after it."""
        if self.phase == OPEN:
            return [(lambda c, _: -c, PRESSING)]
        found: list[tuple[Callable[[float, float], float], int]] = [
            (lambda c, _: c + self.noise, OPEN)
        ]
        if self.phase == CLIPPED:
            found.append((lambda c, u: -self.bracket(c, u), PRESSING))
        elif self.bundle:
            way, end = 1.0 if self.bundle.loading else -1.0, self.bundle.end
            found.append((lambda _, u: way * u, TURNED))
            if 0.0 < end < inf:
                found.append((lambda c, _: way * (end - c), WENT_ON))
        elif self.rate:
            found.append((self.bracket, CLIPPED))
        return found


def read(fields: dict[str, Any]) -> Contact:
    """Return the contact of a problem's law."""
    law, k = fields["law"], fields["stiffness"]
    if law == "Spring":
        return Contact(law, k, 0.0, 0.0, 1.0)
    if law == "Dashpot":
        return Contact(law, k, 0.0, 0.0, 1.0, fields["damping"] / k)
    if law == "Viscoelastic":
        return Contact(law, k, 0.5, 0.0, 1.0, 1.5 * fields["dissipative_time"])
    if law == "HuntCrossley":
        return Contact(law, k, fields["exponent"], 1.0, 0.0, fields["dissipation"])
    p = fields.get("exponent", 1.5)
    if law != "Hysteretic":
        return Contact(law, k, p)
    if "unloading_exponent" in fields:
        return Contact(law, k, p, bundle=Bundle(k, p, fields["unloading_exponent"]))
    n = (p + 1.0) / fields["restitution"] ** 2 - 1.0
    return Contact(law, k, p, bundle=Bundle(k, p, n))


class Story:
    """A problem on its way from event to event."""

    def __init__(self, problem: Problem, rtol: float) -> None:
        if any(law and law["law"] == "Rigid" for law in problem["contacts"]):
            raise Unsupported("rigid collisions are no differential equation")
        self.problem = problem
        self.masses = problem["masses"]
        self.contacts = [law and read(law) for law in problem["contacts"]]
        v = problem["velocities"]
        self.speed = max(map(abs, v))
        self.equal = SURE * rtol * self.speed
        rates = [below - x for below, x in zip([0.0, *v], v, strict=False)]
        self.state = np.array([0.0, *(-gap for gap in problem["gaps"]), *rates])
        self.durations = [self._duration(i) for i in range(len(v))]
        self.time = 0.0
        self.intervals: list[tuple[int, float, float | None]] = []
        for i, contact in enumerate(self.contacts):
            if contact and self.state[i] == 0.0:
                contact.phase = PRESSING
                if rates[i] == 0.0:
                    contact.noise = NOISE * self.durations[i] * self.speed

    def _duration(self, i: int) -> float:
        """Return about how long a contact lasts, from the lighter ball's mass and v0."""
        contact = self.contacts[i]
        if not contact:
            return np.inf
        mass = min(self.masses[max(i - 1, 0) : i + 1])
        p = contact.power + (1.0 if contact.constant == 0.0 else 0.0)
        longest = ((p + 1.0) * mass * self.speed**2 / (2.0 * contact.stiffness)) ** (1 / (p + 1))
        return float(3.0 * longest / self.speed)

    @property
    def pressing(self) -> list[int]:
        """Return which contacts have a force."""
        return [i for i, x in enumerate(self.contacts) if x and x.phase == PRESSING]

    def slopes(self, y: Any) -> list[float]:
        """Return c' = u and u' = the difference of what accelerates both balls."""
        n, y = len(self.masses), [float(x) for x in y]
        forces = [
            x.force(c, u) if x else 0.0 for x, c, u in zip(self.contacts, y[:n], y[n:], strict=True)
        ]
        net = [
            (low - high) / m
            for low, high, m in zip(forces, [*forces[1:], 0.0], self.masses, strict=True)
        ]
        rates = [below - x for below, x in zip([0.0, *net], net, strict=False)]
        rates[0] += self.problem["gravity"]
        return [*y[n:], *rates]

    def over(self) -> bool:
        """Return whether the story is at its end."""
        until = self.problem["until"]
        if until is not None:
            return bool(self.time >= until)
        pairs = zip(self.contacts, self.state[len(self.masses) :], strict=True)
        return not self.pressing and all(u <= self.equal for x, u in pairs if x)

    def horizon(self) -> float:
        """Return the latest end of the next leg."""
        until, n = self.problem["until"], len(self.masses)
        if until is not None:
            return float(until)
        if self.pressing:
            return self.time + LONGEST * max(x for x in self.durations if x < np.inf)
        pairs = zip(self.state[:n], self.state[n:], strict=True)
        waits = [abs(c / u) for c, u in pairs if u > self.equal]
        return self.time + 2.0 * max([*waits, *(x for x in self.durations if x < np.inf)])

    def longest_step(self) -> float:
        """Return how long a step may be, so that no short contact is stepped over."""
        return min((self.durations[i] for i in self.pressing), default=np.inf) / STEPS

    def enter(self, i: int, phase: int) -> None:
        """Change a contact's phase."""
        x = self.contacts[i]
        if x.bundle and phase in (TURNED, WENT_ON):
            if x.phase == PRESSING:  # it has not opened at the same time
                x.bundle.turn(float(self.state[i])) if phase == TURNED else x.bundle.go_on()
            return
        before, x.phase = x.phase, phase
        if before == OPEN:
            x.begun = self.time
            if x.bundle:
                x.bundle.forget()
        if OPEN in (before, phase):
            self.state[i], x.noise = 0.0, 0.0
        if phase == CLIPPED:
            x.clipped = self.time
        elif phase == OPEN:
            self.intervals.append((i, x.begun, x.clipped if before == CLIPPED else self.time))

    def answer(self) -> Answer:
        """Return what came of it."""
        n = len(self.masses)
        for i, x in enumerate(self.contacts):
            if x and x.phase != OPEN:
                parted = self.problem["until"] is None and x.phase == CLIPPED
                self.intervals.append((i, x.begun, x.clipped if parted else None))
        rows = [[row[1:] for row in self.intervals if row[0] == i] for i in range(n)]
        last = [[end for _, end in row] for row in rows]
        return {
            "velocities": (-np.cumsum(self.state[n:])).tolist(),
            "counts": [len(row) for row in rows],
            "first_touch": [min((start for start, _ in row), default=None) for row in rows],
            "last_release": [None if not x or None in x else max(x) for x in last],
            "status": "parted" if self.problem["until"] is None else "stopped",
        }


def follow(story: Story, leg: Leg) -> Answer:
    """Follow a story leg by leg to its end."""
    for _ in range(MOST_EVENTS):
        if story.over():
            return story.answer()
        events = [
            (i, function, phase)
            for i, x in enumerate(story.contacts)
            if x
            for function, phase in x.events()
        ]
        end = story.horizon()
        story.time, state, met = leg(
            story.slopes, events, story.time, story.state, end, story.longest_step()
        )
        story.time, story.state = float(story.time), np.array(state)
        if not met and story.time < end:
            raise ArithmeticError("the integrator stopped before the end")
        if not met and story.problem["until"] is None:
            raise ArithmeticError("an event was not found")
        for index in met:
            i, _, phase = events[index]
            story.enter(i, phase)
        for i, x in enumerate(story.contacts):  # an integrator may stop at one event of several
            if x and (story.state[i] > 0.0 if x.phase == OPEN else story.state[i] < -x.noise):
                story.enter(i, PRESSING if x.phase == OPEN else OPEN)
    raise ArithmeticError(f"more than {MOST_EVENTS} events")


def scales(story: Story) -> Sequence[float]:
    """Return the size of each unknown, for absolute tolerances."""
    n = len(story.masses)
    length = story.speed * min(x for x in story.durations if x < np.inf)
    return [length] * n + [story.speed] * n
