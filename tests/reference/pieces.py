"""Contacts with curves of pieces, solved by SciPy from event to event: nothing of the engine."""

from itertools import pairwise

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

TOLERANCE = 1e-13
PRESSED = 1e-12
HORIZON = 100.0
CLEAR = 1e-10  # a step without events after each: no event is found twice


class Contact:
    """One contact: a loading curve, its corners, and the way back from a peak.

    Parameters
    ----------
    loading : callable
        Force in N over compression in m.
    knots : sequence of float
        Its corners, in m.
    returned : float
        Share of the work that unloading along ``loading(c) (c/C)**m`` returns.
    back : (callable, sequence of float), optional
        The unloading curve in units of the peak, and its corners; used where it suits the peak.
    """

    def __init__(self, loading, knots, returned=1.0, back=None):
        self.loading, self.knots, self.returned, self.back = loading, list(knots), returned, back
        self.closed, self.peak, self.factor, self.rescaled = False, None, 0.0, False

    def open(self):
        self.closed, self.peak = False, None

    def work(self, end, power=0.0):
        corners = [0.0, *(one for one in self.knots if 0.0 < one < end), end]
        return sum(
            quad(lambda c: self.loading(c) * (c / end) ** power, a, b, epsabs=0, epsrel=1e-13)[0]
            for a, b in pairwise(corners)
        )

    def turn(self, c):
        """Take the unloading curve from the peak c."""
        self.peak = c
        self.rescaled = self.back is not None and self.suits(c)
        if not self.rescaled and self.returned < 1.0:
            whole = self.work(c)
            self.factor = brentq(
                lambda m: self.work(c, m) / whole - self.returned, 0.0, 4.0 / self.returned,
                xtol=1e-14, rtol=1e-14,
            )  # fmt: skip

    def suits(self, c):
        """Tell whether the unloading curve, in units of the peak c, is below the loading curve."""
        curve, corners = self.back
        ends = [0.0, *corners, 1.0]
        area = sum(quad(curve, a, b, epsabs=0, epsrel=1e-13)[0] for a, b in pairwise(ends))
        peak = self.loading(c)
        if peak * c * area > self.work(c):
            return False
        places = [*self.knots, *(one * c for one in corners)]
        return all(peak * curve(x / c) <= self.loading(x) + 1e-9 * peak for x in places if x < c)

    def corners(self):
        if self.peak is None or not self.rescaled:
            return self.knots
        return [one * self.peak for one in self.back[1]]

    def force(self, c):
        c = max(c, 0.0)
        if self.peak is None or self.has_one_curve:
            return self.loading(c)
        if not self.rescaled:
            return self.loading(c) * (c / self.peak) ** self.factor
        return self.loading(self.peak) * self.back[0](c / self.peak)

    @property
    def has_one_curve(self):
        return self.back is None and self.returned >= 1.0


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
        f = np.array([one.force(x) if one.closed else 0.0
                      for one, x in zip(contacts, c, strict=True)])  # fmt: skip
        return np.concatenate([y[count:], (f - np.append(f[1:], 0.0)) / masses])

    for one, c, rate in zip(contacts, compressions(state), rates(state), strict=True):
        one.closed = c == 0.0 and rate >= 0.0
    started = [0.0 if one.closed else None for one in contacts]
    for _ in range(2000):
        clear = solve_ivp(slope, (time, time + CLEAR), state, "DOP853", rtol=TOLERANCE, atol=1e-18)
        time, state = clear.t[-1], clear.y[:, -1]
        events, what = [], []

        def watch(kind, i, function, direction, events=events, what=what):
            function.terminal, function.direction = True, direction
            events.append(function)
            what.append((kind, i))

        for i, one in enumerate(contacts):
            if not one.closed:
                watch("touch", i, lambda _, y, i=i: compressions(y)[i], 1)
                continue
            if compressions(state)[i] < PRESSED:  # touching since the start, without a force
                watch("pressed", i, lambda _, y, i=i: compressions(y)[i] - PRESSED, 1)
                continue
            watch("release", i, lambda _, y, i=i: compressions(y)[i], -1)
            for corner in one.corners():
                if corner > 0.0:
                    watch("knot", i, lambda _, y, i=i, k=corner: compressions(y)[i] - k, 0)
            if one.has_one_curve:
                continue
            if one.peak is None:
                watch("peak", i, lambda _, y, i=i: rates(y)[i], -1)
            else:
                watch("again", i, lambda _, y, i=i, k=one.peak: compressions(y)[i] - k, 1)
        step = 2e-2 if any(one.closed for one in contacts) else np.inf
        run = solve_ivp(slope, (time, time + HORIZON), state, "DOP853", rtol=TOLERANCE, atol=1e-16,
                        events=events, max_step=step)  # fmt: skip
        fired = [k for k, hits in enumerate(run.t_events) if len(hits)]
        if not fired:
            raise ArithmeticError("no event for a long time")
        k = min(fired, key=lambda k: run.t_events[k][0])
        (kind, i), time, state = what[k], run.t_events[k][0], run.y_events[k][0].copy()
        one = contacts[i]
        if kind == "touch":
            one.closed, started[i] = True, time
        elif kind == "release":
            intervals[i].append((started[i], time))
            one.open()
        elif kind == "peak":
            one.turn(compressions(state)[i])
        elif kind == "again":
            one.peak = None
        apart = all(not one.closed for one in contacts) and np.all(rates(state) <= 0.0)
        if apart:
            return state[count:], intervals
    raise ArithmeticError("too many events")
