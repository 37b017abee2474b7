"""Any number of balls on linear springs with gaps, no gravity (eqs 5 and 6), to thirty digits.

While the set of closed contacts does not change, the equations are linear, and every compression
is a straight line plus a sum of sinusoids (the modes). The end of such a piece is the first zero
of a compression, found by `first_zero`, whose bounds of the derivatives are the sums of the
modes' amplitudes.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from mpmath import mp, mpf

from benchmarks.impacts.first_zero import first_zero, leading_order
from reference.common import DIGITS, TINY, Interval, Number, Outcome, kinetic

MOST = 8  # balls; with more that touch, the highest contact begins with an order above `ORDERS`
ORDERS = 16  # of the derivatives that are looked at


@dataclass(frozen=True)
class Wave:
    """offset + drift t + the sum of a cos(w t) + b sin(w t) over the terms (w, a, b)."""

    offset: Number
    drift: Number
    terms: tuple[tuple[Number, Number, Number], ...]

    def derivatives(self, t: Number, orders: int = ORDERS) -> list[Number]:
        """Return the value and the derivatives at t."""
        total = [self.offset + self.drift * t, self.drift] + [mpf(0)] * (orders - 2)
        for w, a, b in self.terms:
            cos, sin = mp.cos_sin(w * t)
            now, quarter = a * cos + b * sin, b * cos - a * sin
            for order in range(orders):
                total[order] += now
                now, quarter = w * quarter, -w * now
        return total

    def integral(self, t: Number) -> Number:
        """Return the integral from 0 to t."""
        total = self.offset * t + self.drift * t * t / 2
        for w, a, b in self.terms:
            cos, sin = mp.cos_sin(w * t)
            total += (a * sin + b * (1 - cos)) / w
        return total

    def bound(self, order: int) -> Number:
        """Return a bound of the size of a derivative (order 1 up) at all times."""
        drift = abs(self.drift) if order == 1 else mpf(0)
        return drift + sum((w**order * mp.hypot(a, b) for w, a, b in self.terms), mpf(0))

    def minus(self, other: "Wave") -> "Wave":
        """Return the difference; both have the same frequencies."""
        pairs = zip(self.terms, other.terms, strict=True)
        terms = tuple((w, a - c, b - d) for (w, a, b), (_, c, d) in pairs)
        return Wave(self.offset - other.offset, self.drift - other.drift, terms)

    def negative(self) -> "Wave":
        """Return minus the wave."""
        return Wave(-self.offset, -self.drift, tuple((w, -a, -b) for w, a, b in self.terms))

    def derivative(self) -> "Wave":
        """Return the wave's time derivative."""
        terms = tuple((w, b * w, -a * w) for w, a, b in self.terms)
        return Wave(self.drift, mpf(0), terms)


@dataclass(frozen=True)
class Stack:
    """Masses, stiffnesses (of contact i below ball i; 0 for no contact), and the units of zero."""

    masses: list[Number]
    stiffnesses: list[Number]
    length: Number
    time: Number

    def compressions(self, positions: Sequence[Number]) -> list[Number]:
        """Return q[i-1] - q[i], and -q[0] at the floor."""
        return [below - q for below, q in zip([mpf(0), *positions], positions, strict=False)]

    def closed(self, q: Sequence[Number], v: Sequence[Number]) -> list[bool]:
        """Return which contacts are closed just after now.

        The first Taylor coefficient of a compression that is not zero decides, order by order; a
        contact still undecided exerts no force at that order. So a zero gap whose c''' > 0 is
        closed from the start, and a contact at rest at c = 0 is open.
        """
        n = len(self.masses)
        state: list[bool | None] = [None if k else False for k in self.stiffnesses]
        rows = [list(q), list(v)]
        for order in range(2 * n + 4):
            c = self.compressions(rows[order])
            for i in range(n):
                if state[i] is None and abs(c[i]) * self.time**order > 1000 * TINY * self.length:
                    state[i] = c[i] > 0
            springs = zip(self.stiffnesses, c, state, strict=True)
            force = [k * x if s else mpf(0) for k, x, s in springs]
            net = [a - b for a, b in zip(force, [*force[1:], mpf(0)], strict=True)]
            scale = (order + 1) * (order + 2)
            rows.append([f / m / scale for f, m in zip(net, self.masses, strict=True)])
        return [bool(s) for s in state]

    def waves(self, q: Sequence[Number], v: Sequence[Number], closed: Sequence[bool]) -> list[Wave]:
        """Return the positions as functions of the time from now, for that set of contacts."""
        n = len(self.masses)
        root = [mp.sqrt(m) for m in self.masses]
        matrix = mp.zeros(n)
        for i, k in enumerate(self.stiffnesses):
            if closed[i]:
                matrix[i, i] += k / self.masses[i]
                if i:
                    matrix[i - 1, i - 1] += k / self.masses[i - 1]
                    matrix[i, i - 1] = matrix[i - 1, i] = -k / (root[i] * root[i - 1])
        squares, shapes = mp.eigsy(matrix)
        largest = max([abs(x) for x in squares])
        modes = []
        for k in range(n):
            at = sum((shapes[j, k] * root[j] * q[j] for j in range(n)), mpf(0))
            rate = sum((shapes[j, k] * root[j] * v[j] for j in range(n)), mpf(0))
            w = mp.sqrt(squares[k]) if squares[k] > TINY * largest else mpf(0)
            modes.append((w, at, rate, [shapes[j, k] / root[j] for j in range(n)]))
        return [
            Wave(
                sum((at * s[j] for w, at, _, s in modes if w == 0), mpf(0)),
                sum((rate * s[j] for w, _, rate, s in modes if w == 0), mpf(0)),
                tuple((w, at * s[j], rate * s[j] / w) for w, at, rate, s in modes if w),
            )
            for j in range(n)
        ]


def peak(wave: Wave, duration: Number, tiny: Number, unit: Number) -> Number:
    """Return the largest value of the wave on [0, duration]: every zero of its slope is visited."""
    slope, t = wave.derivative(), mpf(0)
    best = max(wave.derivatives(t)[0], wave.derivatives(duration)[0])
    while t is not None and t < duration:
        d = slope.derivatives(t)
        order = 0 if t == 0 and abs(d[0]) > tiny else leading_order(slope, d, tiny, unit)
        if order is None:  # a constant
            break
        rising = slope if d[order] > 0 else slope.negative()
        t = first_zero(rising, t, duration, tiny, unit)
        if t is not None:
            best = max(best, wave.derivatives(t)[0])
    return best


def run(
    masses: Sequence[float],
    stiffnesses: Sequence[float | None],
    gaps: Sequence[float],
    velocities: Sequence[float],
) -> Outcome:
    """Solve a drop: ball 0 starts at the floor's height, the others above it by the gaps.

    Arguments are numbers that are taken as they are (floats are exact), one per ball, bottom
    first; the gaps are one fewer. A first stiffness of None means that there is no floor.
    """
    if len(masses) > MOST:
        raise ValueError(f"there are {len(masses)} balls; `precise` solves more than {MOST}")
    with mp.workdps(DIGITS):
        m = [mpf(x) for x in masses]
        k = [mpf(x or 0) for x in stiffnesses]
        v = [mpf(x) for x in velocities]
        q = [mpf(0)]
        for gap in gaps:
            q.append(q[-1] + mpf(gap))
        time = mp.sqrt(max(m) / min(x for x in k if x))
        stack = Stack(m, k, max(abs(x) for x in v) * time, time)
        return _advance(stack, q, v)


def _advance(stack: Stack, q: list[Number], v: list[Number]) -> Outcome:
    """Move from event to event until no contact is closed and none approaches."""
    energy, now, n = kinetic(stack.masses, v), mpf(0), len(q)
    tiny = TINY * stack.length
    done: list[Interval] = []
    running: dict[int, Interval] = {}
    while True:
        closed = stack.closed(q, v)
        for i in range(n):
            if closed[i] and i not in running:
                running[i] = Interval(i, now)
                done.append(running[i])
            elif not closed[i] and i in running:
                running.pop(i).end = now
        balls = stack.waves(q, v, closed)
        ground = Wave(mpf(0), mpf(0), tuple((w, mpf(0), mpf(0)) for w, _, _ in balls[0].terms))
        c = [below.minus(ball) for below, ball in zip([ground, *balls], balls, strict=False)]
        c = [x if s else x.negative() for x, s in zip(c, closed, strict=True)]
        first = mp.inf
        for i in sorted(range(n), key=lambda i: not closed[i]):  # a closed one always opens
            if stack.stiffnesses[i]:
                found = first_zero(c[i], mpf(0), first, tiny, stack.time)
                first = first if found is None else found
        if first == mp.inf or (not any(closed) and _parting(stack, v)):
            return Outcome(v, done, now, kinetic(stack.masses, v) / energy)
        for i, interval in running.items():
            top = peak(c[i], first, tiny / stack.time, stack.time)
            interval.peak_compression = max(interval.peak_compression, top)
            interval.peak_force = stack.stiffnesses[i] * interval.peak_compression
            interval.impulse += stack.stiffnesses[i] * c[i].integral(first)
        state = [ball.derivatives(first) for ball in balls]
        q, v = [x[0] for x in state], [x[1] for x in state]
        now += first


def _parting(stack: Stack, v: Sequence[Number]) -> bool:
    """Return whether no contact approaches; equal velocities, to rounding, do not."""
    tiny = 1000 * TINY * stack.length / stack.time
    pairs = zip(stack.compressions(v), stack.stiffnesses, strict=True)
    return all(rate <= tiny for rate, k in pairs if k)
