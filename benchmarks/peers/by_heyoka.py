"""heyoka's Taylor integrator with terminal events, one drop at a time and eight side by side.

Compiled once; masses, stiffnesses and which contacts are closed are its parameters. An event's
callback counts and opens or closes the contact. In a batch, the callback of a drop's last event
puts the next drop in its place, so that all eight places stay busy.
"""

from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.common import HORIZON, LONGEST_CONTACT, Answer, Peer, stiffness_over_mass
from benchmarks.random_drops import Drops

LANES = 8
WINDOW = LONGEST_CONTACT  # of time, to whose end a straight flight is one step
COOLDOWN = 1e-9  # of time; heyoka's own, after a slow event, would outlast the next drop
FURTHER = 1e3  # times as long the next, if a flight is not over; in far longer ones roots are lost
CLOSED, FLOOR, UPPER, LIFT = (0, 1), 2, 3, 4  # the parameters: 0 or 1, k0/m0, k1/m0, k1/m1
PARAMETERS = 5


def system(hy: Any) -> tuple[list[Any], list[Any]]:
    """Return the equations of motion, and the compressions with signs so that all are to fall."""
    c0, c1, u0, u1 = hy.make_vars("c0", "c1", "u0", "u1")
    floor, upper = (hy.par[i] for i in CLOSED)
    lower = floor * hy.par[FLOOR] * c0 - upper * hy.par[UPPER] * c1
    equations = [(c0, u0), (c1, u1), (u0, -lower), (u1, lower - upper * hy.par[LIFT] * c1)]
    return equations, [(2.0 * floor - 1.0) * c0, (2.0 * upper - 1.0) * c1]


class Callback:
    """Hands an event of a contact on."""

    def __init__(self, owner: "Lanes", contact: int) -> None:
        self.owner, self.contact = owner, contact

    def __call__(self, _: Any, __: int, lane: int = 0) -> bool:
        """Return whether to go on."""
        return self.owner.hit(self.contact, lane)

    def __deepcopy__(self, _: Any) -> "Callback":
        """Return itself: heyoka copies callbacks, and this one has to tell its owner."""
        return self


class Lanes:
    """An integrator of so many drops side by side, and which drop is where."""

    def __init__(self, hy: Any, lanes: int) -> None:
        self.lanes = lanes
        equations, compressions = system(hy)
        event = hy.t_event if lanes == 1 else hy.t_event_batch
        kind = {"direction": hy.event_direction.negative, "cooldown": COOLDOWN}
        events = [event(c, callback=Callback(self, i), **kind) for i, c in enumerate(compressions)]
        make = hy.taylor_adaptive if lanes == 1 else hy.taylor_adaptive_batch
        shape = () if lanes == 1 else (lanes,)
        self.integrator = make(
            equations, np.zeros((4, *shape)), pars=np.zeros((PARAMETERS, *shape)), t_events=events
        )
        self.state = self.integrator.state.reshape(4, lanes)  # views
        self.pars = self.integrator.pars.reshape(PARAMETERS, lanes)

    def hit(self, i: int, lane: int) -> bool:
        """Return whether to go on after an event of contact i of the drop in that lane."""
        closed, state, go_on = self.closed[lane], self.state, self.end[lane] == WINDOW
        self.quiet[lane], closed[i] = False, not closed[i]
        self.count[lane][i] += closed[i]
        self.pars[i, lane] = closed[i]
        state[i, lane] = 0.0
        if closed[0] or closed[1] or state[2, lane] > 0.0 or state[3, lane] > 0.0:
            self.end[lane] = WINDOW
            return go_on
        self.replace(lane)
        return go_on and self.left > 0

    def rewind(self) -> None:
        """Let all clocks start anew."""
        if self.lanes == 1:
            self.integrator.time = 0.0
        else:
            self.integrator.set_time(0.0)

    def replace(self, lane: int) -> None:
        """Keep what came of the drop in a lane, and start the next one there."""
        lower, upper = self.state[2:, lane].tolist()
        self.velocities[self.number[lane]] = -lower, -lower - upper
        self.counts[self.number[lane]] = self.count[lane]
        self.left -= 1
        self.fill(lane)

    def fill(self, lane: int) -> None:
        """Put the next drop in a lane, or let nothing move there if there is none."""
        self.number[lane], (springs, gap) = next(self.waiting, (-1, ([1.0] * 3, 1.0)))
        waits = self.number[lane] < 0
        self.closed[lane] = closed = [not waits, gap == 0.0]
        self.count[lane], self.end[lane] = [1, int(closed[1])], WINDOW
        self.state[:, lane] = -float(waits), -gap, float(not waits), 0.0
        self.pars[:, lane] = *closed, *springs

    def solve(self, drops: Drops) -> Answer:
        """Solve the drops, all lanes busy."""
        self.velocities = np.zeros((len(drops), 2))
        self.counts = np.zeros((len(drops), 2), dtype=int)
        numbers = zip(stiffness_over_mass(drops).tolist(), drops.gaps.tolist(), strict=True)
        self.left, self.waiting = len(drops), enumerate(numbers)
        self.number, self.closed, self.count, self.end = ([0] * self.lanes for _ in range(4))
        for lane in range(self.lanes):
            self.fill(lane)
        while self.left:
            self.rewind()
            self.quiet = [True] * self.lanes
            self.integrator.propagate_until(self.end if self.lanes > 1 else self.end[0])
            self.look()
        return self.velocities, self.counts

    def look(self) -> None:
        """Give a lane where nothing happened until its end more time; without end, give it up."""
        for lane, time in enumerate(np.ravel(self.integrator.time)):
            if self.number[lane] < 0 or time < self.end[lane] or not self.quiet[lane]:
                continue
            self.end[lane] *= FURTHER
            if any(self.closed[lane]) or self.end[lane] > HORIZON:
                self.replace(lane)  # as it is: an event was lost


def prepare(lanes: int) -> Any:
    """Return the function that solves drops, so many at a time."""
    import heyoka as hy

    return Lanes(hy, lanes).solve


SCALAR = Peer("heyoka", "heyoka", "taylor_adaptive, terminal events", partial(prepare, 1))
BATCH = Peer(
    "heyoka, batch",
    "heyoka",
    f"taylor_adaptive_batch, terminal events, {LANES} drops at once",
    partial(prepare, LANES),
)
