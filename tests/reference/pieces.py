"""Contacts with hysteresis, solved by SciPy from event to event: nothing of the engine.

A contact is a bundle of elements. The one that touches and parts at the compression l carries dL(l)
of the loading curve L, times a share r(c/H) once the compression c has been higher, up to H.
"""

from functools import cache
from itertools import pairwise

import numpy as np
from scipy.integrate import quad, solve_ivp

TOLERANCE = 1e-13
PRESSED = 1e-12
HORIZON = 100.0
ROUND_OFF = 1e-13
CLEAR = 1e-10  # a step without events after each: no event is found twice


class Contact:
    """One contact: a loading curve L(c) and its corners, the share r(c/H, H) and those over c/H.

    Without a share no energy is lost.
    """

    def __init__(self, loading, knots, share=None, corners=()):
        self.loading, self.knots, self.share, self.corners = loading, knots, share, corners
        self.cycles = 0
        self.open()

    def open(self):
        """Forget all: `bundle` has pairs of l and the H of the elements from there on, if any."""
        self.closed, self.pressed, self.bundle = False, False, [(0.0, None)]

    def force(self, c):
        total, c = 0.0, max(c, 0.0)
        for (low, peak), (high, _) in pairwise([*self.bundle, (c, None)]):
            share = 1.0 if peak is None else self.share(c / peak, peak)
            total += share * (self.loading(high) - self.loading(low))
        return total

    def places(self):
        """Return the compressions at which the force may have a corner."""
        peaks = [peak for _, peak in self.bundle if peak is not None]
        return [*self.knots, *(x * peak for peak in peaks for x in self.corners)]

    def turns(self):
        """Return the events that change what the elements remember: name, level, direction."""
        low, peak = self.bundle[-1]
        if self.share is None:
            return []
        if peak is None:
            again = [("again", before, 1) for _, before in self.bundle[-2:-1]]
            return [("peak", None, -1), *again]
        return [("dip", None, 1), *([("back", low, -1)] if low else [])]

    def turn(self, kind, c):
        if kind in ("again", "back"):
            self.bundle.pop()
        if kind == "dip":
            self.bundle.append((c, None))
            self.cycles += 1
        elif kind != "back":
            self.bundle[-1] = (self.bundle[-1][0], c if kind == "peak" else None)


def work(loading, knots, peak, power=0.0):
    """Return the work of loading up to a peak, weighted with (c/peak)**power."""
    ends = [0.0, *(x for x in knots if 0.0 < x < peak), peak]
    return sum(
        quad(lambda c: loading(c) * (c / peak) ** power, a, b, epsabs=0, epsrel=1e-13)[0]
        for a, b in pairwise(ends)
    )


def returned_share(loading, knots, power, returned):
    """Return r = 1 - g + g x**power, where g(H) is such that a share of the work is returned."""

    @cache
    def lost(peak):
        left = work(loading, knots, peak, power) / work(loading, knots, peak)
        return (1.0 - returned) / (1.0 - left)

    return lambda x, peak: 1.0 - lost(peak) * (1.0 - x**power)


def integrate(masses, contacts, gaps, velocities):
    """Return the final velocities, and per contact the intervals (start, end) in s."""
    masses = np.array(masses)
    count = len(masses)
    position = np.concatenate([[0.0], np.cumsum(gaps)])
    state = np.concatenate([position, velocities])
    intervals = [[] for _ in contacts]
    time = 0.0

    def compressions(y):
        return np.concatenate([[-y[0]], y[: count - 1] - y[1:count]])

    def rates(y):
        return np.concatenate([[-y[count]], y[count : 2 * count - 1] - y[count + 1 :]])

    def slope(_, y):
        c = compressions(y)
        f = np.array([contact.force(x) if contact.closed else 0.0
                      for contact, x in zip(contacts, c, strict=True)])  # fmt: skip
        return np.concatenate([y[count:], (f - np.append(f[1:], 0.0)) / masses])

    for contact, c, rate in zip(contacts, compressions(state), rates(state), strict=True):
        contact.closed, contact.pressed = c == 0.0 and rate >= 0.0, rate > 0.0
    started = [0.0 if contact.closed else None for contact in contacts]
    for _ in range(2000):
        clear = solve_ivp(slope, (time, time + CLEAR), state, "DOP853", rtol=TOLERANCE, atol=1e-18)
        time, state = clear.t[-1], clear.y[:, -1]
        events, what = [], []

        def watch(kind, i, level, direction, events=events, what=what):
            def function(_, y):
                return rates(y)[i] if level is None else compressions(y)[i] - level

            function.terminal, function.direction = True, direction
            events.append(function)
            what.append((kind, i))

        for i, contact in enumerate(contacts):
            if not contact.closed:
                watch("touch", i, 0.0, 1)
                continue
            if not contact.pressed:  # touching since the start, perhaps without a force
                watch("pressed", i, PRESSED, 1)
                continue
            watch("release", i, 0.0, -1)
            for place in contact.places():
                if place > 0.0:
                    watch("knot", i, place, 0)
            for kind, level, direction in contact.turns():
                watch(kind, i, level, direction)
        step = 2e-2 if any(contact.closed for contact in contacts) else np.inf
        end, there = time + HORIZON, None
        for _ in range(9):  # until no level is passed twice inside contact step
            run = solve_ivp(slope, (time, end), state, "DOP853", rtol=TOLERANCE, atol=1e-16,
                            events=events, max_step=step)  # fmt: skip
            fired = [k for k, hits in enumerate(run.t_events) if len(hits)]
            if not fired:
                raise ArithmeticError("no event for a long time")
            k = min(fired, key=lambda k: run.t_events[k][0])
            end, there = run.t_events[k][0], run.y_events[k][0].copy()
            if all(event.direction * event(end, there) <= ROUND_OFF for event in events):
                break
        else:
            raise ArithmeticError("an event was missed")
        (kind, i), time, state = what[k], end, there
        contact = contacts[i]
        if kind == "touch":
            contact.closed = contact.pressed = True
            started[i] = time
        elif kind == "release":
            intervals[i].append((started[i], time))
            contact.open()
        elif kind == "pressed":
            contact.pressed = True
        elif kind != "knot":
            contact.turn(kind, compressions(state)[i])
        apart = all(not contact.closed for contact in contacts) and np.all(rates(state) <= 0.0)
        if apart:
            return state[count:], intervals
    raise ArithmeticError("too many events")
