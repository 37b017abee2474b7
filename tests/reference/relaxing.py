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


class Story(NamedTuple):
    """What came of a stack: speeds, intervals as (contact, start, end), and energies.

    `held` is the energy of the springs at the end, `lost` the work of the dashpots, of pressing
    contacts and of surfaces that recover.
    """

    velocities: np.ndarray
    intervals: list[tuple[int, float, float]]
    leaving: list[float]  # the compressions at which the intervals ended
    held: float
    lost: float


def integrate(drop: sb.Drop, until: float) -> Story:
    """Follow a drop of standard linear solids, at most until a time in s."""
    mass = np.array([ball.mass for ball in drop.balls])
    size = len(mass)
    k = np.array([law.stiffness for law in drop.contacts])
    arm = k * [law.relaxation_strength for law in drop.contacts]
    tau = np.array([law.relaxation_time for law in drop.contacts])

    def compressions(q):
        return np.append(0.0, q[:-1]) - q

    def slopes(t, state, pressed):
        q, v, r, _ = np.split(state, [size, 2 * size, 3 * size])
        c, rate = compressions(q), compressions(v)
        force = np.where(pressed, k * c + r, 0.0)
        free = -k * r / (k + arm) / tau  # k x + r = 0
        pull = np.where(pressed, arm * rate - r / tau, free)
        power = r * r / (arm * tau)
        net = force - np.append(force[1:], 0.0)
        return np.concatenate([v, net / mass - drop.gravity, pull, [power.sum()]])

    def watch(i, pressed):
        def sign(t, state):
            q, r = state[:size], state[2 * size : 3 * size]
            c = compressions(q)
            return k[i] * c[i] + r[i]  # the force; for an open contact k times overlap

        sign.terminal, sign.direction = True, -1.0 if pressed[i] else 1.0
        return sign

    heights = np.append(0.0, np.cumsum(drop.gaps))
    state = np.concatenate([heights, drop.start_velocities, np.zeros(size), [0.0]])
    pressed = np.zeros(size, dtype=bool)
    pressed[0] = True
    touches = [0.0 if i == 0 else np.nan for i in range(size)]
    for i in range(1, size):  # zero gaps count as pressed from the start, without a force
        if drop.gaps[i - 1] == 0.0:
            pressed[i], touches[i] = True, 0.0
    time, intervals, leaving = 0.0, [], []
    while time < until:
        found = solve_ivp(
            slopes,
            (time, until),
            state,
            args=(pressed,),
            events=[_of(watch(i, pressed)) for i in range(size)],
            max_step=0.02 * np.sqrt(mass.min() / (k + arm).max()) * 20.0,
            **_ACCURACY,
        )
        time, state = found.t[-1], found.y[:, -1]
        if found.status != 1:
            break
        i = next(i for i in range(size) if len(found.t_events[i]))
        pressed = pressed.copy()
        pressed[i] = not pressed[i]
        if pressed[i]:
            touches[i] = time
        else:
            intervals.append((i, touches[i], time))
            leaving.append(compressions(state[:size])[i])
    q, r = state[:size], state[2 * size : 3 * size]
    c = np.where(pressed, compressions(q), -r / k)
    held = float(np.sum(0.5 * k * c * c + 0.5 * r * r / arm))
    return Story(state[size : 2 * size], intervals, leaving, held, float(state[-1]))


def _of(sign):
    """Return an event function that takes the arguments of the right-hand side, too."""

    def event(t, state, pressed):
        return sign(t, state)

    event.terminal, event.direction = sign.terminal, sign.direction
    return event
