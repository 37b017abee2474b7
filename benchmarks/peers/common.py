"""What the peers share: their interface, and the story of two balls from event to event."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from importlib import metadata
from typing import Any

import numpy as np

from benchmarks.random_drops import Drops, PairDrops

RTOL = 1e-10  # what the general solvers are asked for, absolute and relative
FIRST_STEP = 1e-3  # after an event: in a long one a contact could close and open, unseen
HORIZON = 1e13  # by when the longest flight is over: balls may approach at 1e-10 v0
LONGEST_CONTACT = 1e3  # ten times what the softest spring and the heaviest balls need
MOST_EVENTS = 100  # per drop; a solver that needs more has lost its way

Answer = tuple[np.ndarray, np.ndarray]
"""Final velocities in v0, up-positive, and numbers of contacts; both (n, 2)."""

Force = Any
"""A force of `by_hand`: of stiffness, loss, compression, its rate, and what is remembered."""

State = list[float]
"""Compressions of the floor's contact and the balls', then their rates: c0, c1, u0, u1."""

Leg = Callable[[State, list[bool], float], tuple[State, list[int]]]
"""From a state, and which contacts are closed there, to the next touch or release, but for no
longer than a time: the state there and the contacts that change."""


@dataclass(frozen=True)
class Peer:
    """One way to solve drops: its name, the distribution it needs, and how it does it.

    `prepare` imports and compiles, and returns the function that solves.
    """

    name: str
    needs: str
    how: str
    prepare: Callable[[], Callable[[Any], Answer]]

    def available(self) -> bool:
        """Return whether what it needs is installed."""
        return self.version() is not None

    def version(self) -> str | None:
        """Return the version of what it needs; None if that is not installed."""
        try:
            return metadata.version(self.needs)
        except metadata.PackageNotFoundError:
            return None

    @cached_property
    def solve(self) -> Callable[[Any], Answer]:
        """The function that solves drops, made once."""
        return self.prepare()


def stiffness_over_mass(drops: Drops) -> np.ndarray:
    """Return k0/m0, k1/m0 and k1/m1, shape (n, 3), which is all that the motion depends on.

    With the forces (eqs 5, 6) c0'' = -k0/m0 c0 + k1/m0 c1 and c1'' = k0/m0 c0 - (k1/m0 + k1/m1) c1,
    where a contact that is open has k = 0.
    """
    return drops.stiffnesses[:, [0, 1, 1]] / drops.masses[:, [0, 0, 1]]


def story(leg: Leg, gap: float) -> tuple[list[float], list[int]]:
    """Return final velocities and contacts of one drop, solved leg by leg between its events.

    The unknowns are compressions, so that a contact far above the floor loses no digits.
    """
    state, closed = [0.0, -gap, 1.0, 0.0], [True, gap == 0.0]
    counts = [1, int(closed[1])]
    for _ in range(MOST_EVENTS):
        if not any(closed) and max(state[2:]) <= 0.0:
            break
        state, changed = leg(state, closed, LONGEST_CONTACT if any(closed) else HORIZON)
        if not changed:  # an event was lost
            break
        for i in changed:
            state[i], closed[i] = 0.0, not closed[i]
            counts[i] += closed[i]
    return [-state[2], -state[2] - state[3]], counts


def one_by_one(leg_of: Callable[..., Leg]) -> Callable[[Drops | PairDrops], Answer]:
    """Return the function that solves drops in turn.

    `leg_of` has the stiffnesses and the losses of both contacts, 1/m0, and 1/m1.
    """

    def solve(drops: Drops | PairDrops) -> Answer:
        contacts = np.hstack([drops.stiffnesses, drops.losses, 1.0 / drops.masses]).tolist()
        numbers = zip(contacts, drops.gaps.tolist(), strict=True)
        stories = [story(leg_of(*contact), gap) for contact, gap in numbers]
        velocities, counts = zip(*stories, strict=True)
        return np.array(velocities), np.array(counts)

    return solve
