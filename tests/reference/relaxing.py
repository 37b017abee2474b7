"""Stacks on standard linear solids, integrated by scipy: another formulation, and no exponentials.

A contact's state is its compression and the force r of its relaxing spring, ``r' = k1 c' - r/τ``.
While it is open its surface, at the compression x, has no force: ``k x + r = 0``, so that
``(k + k1) x' = r/τ``.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

import stackbounce as sb

_ACCURACY = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-16}
_STEP = 0.4  # times the shortest of sqrt(m/k): so that no contact is passed over


class Story(NamedTuple):
    """What came of a stack: speeds, intervals as (contact, start, end), and energy.

    `leaving` are the compressions at which the intervals ended, `lost` is the work of the dashpots,
    of pressing contacts and of surfaces that recover.
    """

    velocities: np.ndarray
    intervals: list[tuple[int, float, float]]
    leaving: list[float]
    lost: float


class _Solids:
    """The equations of motion; a state has positions, velocities, forces r, and the work lost."""

    def __init__(self, drop: sb.Drop) -> None:
        self.mass = np.array([ball.mass for ball in drop.balls])
        self.k = np.array([law.stiffness for law in drop.contacts])
        self.arm = self.k * [law.relaxation_strength for law in drop.contacts]
        self.tau = np.array([law.relaxation_time for law in drop.contacts])
        self.gravity = drop.gravity
        self.pressed = np.zeros(len(self.mass), dtype=bool)

    def parts(self, state):
        q, v, r, _ = np.split(state, np.arange(1, 4) * len(self.mass))
        return np.append(0.0, q[:-1]) - q, v, r

    def slopes(self, _, state):
        c, v, r = self.parts(state)
        force = np.where(self.pressed, self.k * c + r, 0.0)
        rate = np.append(0.0, v[:-1]) - v
        free = -self.k * r / (self.k + self.arm) / self.tau
        pull = np.where(self.pressed, self.arm * rate - r / self.tau, free)
        net = (force - np.append(force[1:], 0.0)) / self.mass - self.gravity
        return np.concatenate([v, net, pull, [np.sum(r * r / (self.arm * self.tau))]])

    def change(self, i):
        """Return the event that contact i touches or opens: the force, or k times the overlap."""

        def sign(_, state):
            c, _, r = self.parts(state)
            return self.k[i] * c[i] + r[i]

        sign.terminal, sign.direction = True, -1.0 if self.pressed[i] else 1.0
        return sign


def integrate(drop: sb.Drop, until: float) -> Story:
    """Follow a drop of standard linear solids up to a time in s."""
    solids, size = _Solids(drop), len(drop.balls)
    heights = np.append(0.0, np.cumsum(drop.gaps))
    state = np.concatenate([heights, drop.start_velocities, np.zeros(size + 1)])
    solids.pressed[:] = np.append(0.0, drop.gaps) == 0.0  # those press without a force at first
    step = _STEP * np.sqrt(solids.mass.min() / np.max(solids.k + solids.arm))
    time, touches, intervals, leaving = 0.0, [0.0] * size, [], []
    while time < until:
        events = [solids.change(i) for i in range(size)]
        found = solve_ivp(
            solids.slopes, (time, until), state, events=events, max_step=step, **_ACCURACY
        )
        time, state = found.t[-1], found.y[:, -1]
        for i in range(size):
            if len(found.t_events[i]):
                if solids.pressed[i]:
                    intervals.append((i, touches[i], time))
                    leaving.append(solids.parts(state)[0][i])
                touches[i] = time
                solids.pressed[i] = not solids.pressed[i]
    return Story(solids.parts(state)[1], intervals, leaving, float(state[-1]))
