"""Any stack of finite contacts, of any law and mixture, to thirty digits, by Taylor series.

A contact is open, or its force follows a curve of `laws`, or it is compressed and yet without
force (`CLIPPED`, where the curve would pull). All changes between these are roots of polynomials
that cannot be missed (`bernstein`).

Powers that are not whole numbers have no Taylor series at c = 0. Where c is so small that the
force would change its ball's momentum by less than `NEGLECTED` of the impact's, it is left out
(`FAINT`); steps towards and away from that place shrink and grow with the distance to it.

An interval starts at the time after which c > 0: when c rises through 0, or, of a contact that
rests at c = 0, when the force begins that presses it (at t = 0 in a stack without gaps). It ends
when c is back at 0, or at the last zero of the force if that was clipped from then on.

Exponents must be at least 1/2.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mpmath import mp, mpf

from reference.bernstein import roots, sign_after_zero, slope, value
from reference.common import Interval, Number, Outcome, Row, kinetic
from reference.laws import Curve, Law, read
from reference.taylor import (
    BITS,
    DIGITS,
    ONE,
    Piece,
    accelerations,
    couplings,
    expand,
    fixed,
    floating,
    forces_of,
)

NEGLECTED = mpf(10) ** -38  # momentum, in units of the impact's
LEAST = mpf(10) ** -40  # compression below which every force is left out, in the problem's length
EQUAL = mpf(10) ** -24  # velocities that differ by less, in units of the largest, are equal
AT_REST = mpf(10) ** -45  # what counts as zero where a touching contact may be pressed
PULL = 1 << (BITS - 113)  # 1e-34: 1 + χ ċ, which may creep to 0, is clipped below minus that
GROWTH = 4  # of the steps

OPEN, FAINT, LOADING, UNLOADING, CLIPPED = range(5)


class Contact:
    """One contact: its law, phase, what its elements remember (see `laws`), curves, interval."""

    def __init__(self, index: int, law: Law, mass: Number, speed: Number) -> None:
        self.index, self.law, self.mass = index, law, mass
        self.momentum = mass * speed
        p, k = law.exponent, law.loading.k
        self.length = ((p + 1) * self.momentum * speed / (2 * k)) ** (1 / (p + 1))
        self.phase, self.level = OPEN, mpf(0)
        self._open()
        self.touching: Number | None = None  # since when it may have been pressed from rest
        self.clipped: Number | None = None
        self.interval = Interval(index, mpf(0))

    def _open(self) -> None:
        self.bundle: list[tuple[Number, Number | None]] = [(mpf(0), None)]
        self.curves = [self.law.loading]

    @property
    def active(self) -> list[Curve]:
        """Return the curves whose sum is the force now."""
        return self.curves if self.phase in (LOADING, UNLOADING) else []

    def faint(self, rate: Number, least: Number) -> Number:
        """Return the compression below which the force is left out at that rate."""
        curve = self.curves[0]
        if curve.power == 0:
            return mpf(0)
        factor = curve.k * (curve.constant + curve.slope * self.length + curve.rate * abs(rate))
        level = (NEGLECTED * self.momentum * abs(rate) / factor) ** (1 / (curve.power + 1))
        return max(level, least)

    def prepare(self, c: Number, rate: Number, now: Number, least: Number, speed: Number) -> None:
        """Note since when it has been touching, or how far the present curve is followed down."""
        if self.phase == OPEN:
            if abs(c) > AT_REST * self.length or abs(rate) > AT_REST * speed:
                self.touching = None
            elif self.touching is None:
                self.touching = now
        elif self.bundle[-1][0]:
            self.level = self.bundle[-1][0]
        elif self.phase in (LOADING, UNLOADING):
            level = self.faint(rate, least)
            self.level = level if rate < 0 else min(level, c / 2)

    def events(self, piece: Piece) -> Iterator[tuple[list[int], int]]:
        """Yield polynomials that are positive in this phase, and the phase after a zero of each."""
        c = piece.rescaled(piece.compressions[self.index])
        unit = piece.lengths[self.index]
        above = [c[0] - fixed(self.level / unit), *c[1:]]
        (low, peak), curve = self.bundle[-1], self.curves[0]
        if self.phase == OPEN:
            yield _negative(c), FAINT if curve.power else LOADING
        elif self.phase == FAINT:
            yield c, OPEN
            yield _negative(slope(c) if peak else above), LOADING
        elif self.phase == CLIPPED:
            yield c, OPEN
            yield _negative(self._weight(c, piece)), LOADING
        elif self.phase == UNLOADING:
            yield above, UNLOADING if low else FAINT if curve.power else OPEN
            yield _negative(slope(c)), LOADING
        elif self.law.unloading is not None:
            yield slope(c), UNLOADING
            for _, before in self.bundle[-2:-1]:
                yield [fixed(before / unit) - c[0], *_negative(c[1:])], LOADING
        else:
            yield above, FAINT if curve.power else OPEN
            if curve.rate:
                weight = self._weight(c, piece)
                if curve.constant:
                    weight[0] += PULL
                yield weight, CLIPPED

    def _weight(self, c: Sequence[int], piece: Piece) -> list[int]:
        """Return the polynomial of the curve's bracket, which has the sign of the force."""
        length = piece.lengths[self.index]
        curve = self.curves[0]
        factors = [curve.slope * length, curve.rate * length / piece.duration(ONE)]
        norm = curve.constant + sum(factors)
        in_c, in_rate = (fixed(x / norm) for x in factors)
        found = [(in_c * x + in_rate * y) >> BITS for x, y in zip(c, [*slope(c), 0], strict=True)]
        found[0] += fixed(curve.constant / norm)
        return found

    def enter(
        self, phase: int, c: Number, rate: Number, now: Number, least: Number
    ) -> Interval | None:
        """Change the phase; return the interval that begins."""
        before, self.phase = self.phase, phase
        low, peak = self.bundle[-1]
        if phase == CLIPPED:
            self.clipped = now
        elif phase == OPEN:
            self.interval.end = self.clipped if before == CLIPPED else now
            self._open()
        elif phase == before:  # at the last but one turning point again
            self.bundle.pop()
            if phase == LOADING:
                self.bundle[-1] = (self.bundle[-1][0], None)
        elif phase == UNLOADING:
            self.bundle[-1] = (low, c)
        elif phase == LOADING and peak is not None:
            self.bundle.append((c, None))
        self.curves = self.law.curves(self.bundle)
        if before != OPEN:
            return None
        self.level = self.faint(rate, least)
        start = now if self.touching is None else self.touching
        self.touching, self.interval = None, Interval(self.index, start)
        return self.interval

    def record(self, piece: Piece, at: int) -> None:
        """Add a step, up to the fraction `at` of the piece, to peaks and impulse."""
        interval, forces = self.interval, piece.forces[self.index]
        interval.impulse += piece.impulse(self.index, at)
        c = piece.compressions[self.index], piece.lengths[self.index]
        interval.peak_compression = _largest(piece, *c, at, interval.peak_compression)
        if forces and self.law.loading.rate:
            terms = forces[0].terms, forces[0].unit
            interval.peak_force = _largest(piece, *terms, at, interval.peak_force)
        elif forces:
            interval.peak_force = self.law.loading.force(interval.peak_compression, mpf(0))


def _negative(terms: Sequence[int]) -> list[int]:
    return [-x for x in terms]


def _largest(piece: Piece, terms: Sequence[int], unit: Number, at: int, best: Number) -> Number:
    """Return the largest value of unit * polynomial up to `at`, or `best` if that is larger."""
    terms = piece.rescaled(terms)
    if unit * floating(terms[0] + sum(abs(x) for x in terms[1:])) <= best:
        return best
    places = [0, at, *(x for x in roots(slope(terms), BITS) if x < at)]
    return max([best, *(unit * floating(value(terms, x, BITS)) for x in places)])


def run(
    masses: Sequence[float],
    contacts: Sequence[Mapping[str, Any] | None],
    gaps: Sequence[float],
    velocities: Sequence[float],
    gravity: float = 0,
    until: float | None = None,
    limit: float = mp.inf,
) -> Outcome:
    """Solve a drop: ball 0 starts at the floor's height, the others above it by the gaps.

    Arguments are numbers that are taken as they are (floats are exact), bottom first. A contact is
    what `laws.read` reads, the first may be None (no floor). Without `until` the run ends once no
    force acts and no contact approaches. Intervals that go on at the end have the end None.
    What takes more steps than the limit ends in an ArithmeticError.
    """
    with mp.workdps(DIGITS):
        m, v, gap = ([mpf(x) for x in row] for row in (masses, velocities, gaps))
        speed = max(abs(x) for x in v) or mpf(gravity) * mpf(until or 0)
        running = [
            Contact(i, read(law), min(m[max(i - 1, 0) : i + 1]), speed) if law else None
            for i, law in enumerate(contacts)
        ]
        stop = mp.inf if until is None else mpf(until)
        stack = Stack(m, running, mpf(gravity), speed)
        return stack.advance([mpf(0), *(-x for x in gap)], _rates(v), stop, limit)


def _rates(v: Sequence[Number]) -> list[Number]:
    return [below - x for below, x in zip([mpf(0), *v], v, strict=False)]


class Stack:
    """The balls, the contacts and the problem's scales."""

    def __init__(
        self, masses: Row, contacts: Sequence[Contact | None], gravity: Number, speed: Number
    ) -> None:
        self.masses, self.contacts, self.gravity, self.speed = masses, contacts, gravity, speed
        self.closed = [x for x in contacts if x]
        self.length = min(x.length for x in self.closed)
        self.rows = couplings(masses)

    def advance(self, c: list[Number], rates: list[Number], stop: Number, limit: float) -> Outcome:
        """Step, at most to the next event, until the end."""
        energy, now, done = kinetic(self.masses, self._velocities(rates)), mpf(0), []
        unit = self.length / self.speed
        least, step, steps = LEAST * self.length, unit, 0
        while now < stop and not (stop == mp.inf and self._parting(rates)):
            for x in self.closed:
                x.prepare(c[x.index], rates[x.index], now, least, self.speed)
            piece = self._piece(c, rates, min(GROWTH * step or unit, stop - now))
            at, contact, phase = self._next_event(piece)
            for x in self.closed:
                if x.phase != OPEN:
                    x.record(piece, at)
            c, rates = piece.state(at)
            step = piece.duration(at)
            now += step
            steps += 1
            if steps > limit:
                raise ArithmeticError(f"the drop takes more than {limit} steps")
            if contact:
                i = contact.index
                if OPEN in (contact.phase, phase):
                    c[i] = mpf(0)
                resumed = (contact.phase, phase) == (CLIPPED, LOADING)
                begun = contact.enter(phase, c[i], rates[i], now, least)
                done += [begun] if begun else []
                if begun or resumed:
                    self._press(begun.start if begun else now)
        for x in self.closed:
            if x.phase == CLIPPED and stop == mp.inf:
                x.interval.end = x.clipped
        velocities = self._velocities(rates)
        return Outcome(velocities, done, now, kinetic(self.masses, velocities) / energy)

    def _press(self, start: Number) -> None:
        """Note that a force has begun, by which contacts that touch may be pressed."""
        for x in self.closed:
            if x.touching is not None:
                x.touching = start

    def _velocities(self, rates: Sequence[Number]) -> list[Number]:
        return [-mp.fsum(rates[: i + 1]) for i in range(len(rates))]

    def _parting(self, rates: Sequence[Number]) -> bool:
        """Return whether no force acts and no contact approaches."""
        return all(
            x.phase in (OPEN, CLIPPED) and rates[x.index] <= EQUAL * self.speed for x in self.closed
        )

    def _piece(self, c: Sequence[Number], rates: Sequence[Number], time: Number) -> Piece:
        """Return the series, for a time that is not much longer than where they converge."""
        curves = [x.active if x else [] for x in self.contacts]
        second = accelerations(self.rows, forces_of(curves, c, rates), self.gravity)
        for i, (a, b) in enumerate(zip(c, rates, strict=True)):
            for x in curves[i]:
                if x.power:
                    time = min(time, 2 * a / (abs(b) + mp.sqrt(a * abs(second[i]))))
                damping = x.k * a**x.power * x.rate / self.contacts[i].mass
                stiffness = abs(x.k) * x.slope * a**x.power / self.contacts[i].mass
                time = min(time, 8 / (damping + mp.sqrt(stiffness) + 1 / time))
        return expand(self.rows, self.gravity, curves, c, rates, time, (self.length, self.speed))

    def _next_event(self, piece: Piece) -> tuple[int, Contact | None, int]:
        """Return the next event: where in the piece, its contact and the phase after it."""
        best: tuple[int, Contact | None, int] = (ONE, None, OPEN)
        for contact in self.closed:
            for polynomial, phase in contact.events(piece):
                if sign_after_zero(polynomial) < 0:
                    return 0, contact, phase
                found = next(roots(polynomial, BITS), None)
                if found is not None and found < best[0]:
                    best = (found, contact, phase)
        return best
