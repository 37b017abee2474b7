"""Lossy reloading against an integration of its rule, where the work done is an integral."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import stackbounce as sb

OPEN, LOADING, UNLOADING, RELOADING = range(4)


class Contact:
    """A contact that gives back what it held when a loading began, plus e^2 of the work since."""

    def __init__(self, law):
        self.k, self.p, self.n = law.stiffness, law.exponent, law.unloading_exponent
        self.kept = law.restitution**2
        self.phase, self.held = OPEN, 0.0

    def force(self, c):
        """Return the force at a compression in m, in N."""
        if self.phase == OPEN or c <= 0.0:
            return 0.0
        if self.phase == LOADING:
            return self.k * c**self.p
        return self.peak_force * (c / self.peak) ** self.curve

    def next(self, kind, c, work):
        """Change the phase at a compression; that work was done since the last event."""
        if kind == "zero":
            self.phase, self.held = (LOADING if self.phase == OPEN else OPEN), 0.0
        elif kind == "passed":
            self.phase = LOADING
        elif self.phase == UNLOADING:  # it dips
            self.held = self.force(c) * c / (self.curve + 1.0)
            self.phase = RELOADING
        else:
            pressing, energy = self.force(c), self.held + self.kept * work
            self.curve = min(pressing * c / energy - 1.0, 10.0 * self.n)
            self.peak, self.peak_force = c, pressing
            meeting = math.log(self.k * c**self.p / pressing) / (self.curve - self.p)
            self.top = c * math.exp(max(meeting, 0.0))
            self.phase = UNLOADING


def speeds_after(masses, laws, speed):
    """Return the speeds in m/s after balls that touch have hit the floor."""
    masses, contacts = np.array(masses), [Contact(law) for law in laws]
    many = len(masses)
    state = np.concatenate([np.zeros(many), np.full(many, -speed), np.zeros(many)])
    contacts[0].phase = LOADING

    def motion(_, y):
        compressions, rates = compressed(y)
        forces = np.array([one.force(c) for one, c in zip(contacts, compressions, strict=True)])
        pull = forces - np.append(forces[1:], 0.0)
        return np.concatenate([y[many : 2 * many], pull / masses, forces * rates])

    def compressed(y):
        positions, velocities = y[:many], y[many : 2 * many]
        return -np.diff(positions, prepend=0.0), -np.diff(velocities, prepend=0.0)

    def watched():
        found = []
        for i, one in enumerate(contacts):
            if one.phase == OPEN:
                found.append((i, "zero", 1.0, lambda _, y, i=i: compressed(y)[0][i]))
                continue
            turn = 1.0 if one.phase == UNLOADING else -1.0
            found.append((i, "turn", turn, lambda _, y, i=i: compressed(y)[1][i]))
            if one.phase == UNLOADING:
                found.append((i, "zero", -1.0, lambda _, y, i=i: compressed(y)[0][i] - 1e-13))
            if one.phase == RELOADING:
                top = one.top
                found.append(
                    (i, "passed", 1.0, lambda _, y, i=i, top=top: compressed(y)[0][i] - top)
                )
        for _, _, direction, event in found:
            event.terminal, event.direction = True, direction
        return found

    now = 0.0
    for _ in range(200):
        events = watched()
        run = solve_ivp(
            motion, (now, now + 0.1), state, "DOP853", rtol=1e-11, atol=1e-14, max_step=1e-4,
            events=[event for *_, event in events],
        )  # fmt: skip
        state, now = run.y[:, -1].copy(), run.t[-1]
        if run.status == 0:
            break
        i, kind, *_ = next(
            one for one, times in zip(events, run.t_events, strict=True) if len(times)
        )
        work = state[2 * many + i]
        contacts[i].next(kind, compressed(state)[0][i], work)
        if kind != "passed":
            state[2 * many + i] = 0.0
    return state[many : 2 * many]


def law_of(random):
    return sb.Hysteretic(
        random.uniform(1e4, 6e4), restitution=random.uniform(0.6, 0.95), reloading="lossy"
    )


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("seed", range(20))
def test_speeds_are_those_of_the_rule(seed):
    random = np.random.default_rng(seed)
    masses = [random.uniform(0.005, 0.03), 0.1]
    laws = [law_of(random), law_of(random)]
    drop = sb.Drop([sb.Ball(mass) for mass in masses], laws, impact_speed=2.0)
    expected = speeds_after(masses, laws, 2.0)
    assert sb.simulate(drop).rebound_speeds == pytest.approx(expected, abs=1e-6)
