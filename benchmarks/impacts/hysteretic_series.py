"""Section V's hysteretic contacts, mixed with springs, by Taylor series to twenty digits and more.

A contact of `Law(stiffness k, loading p, unloading n)` is a bundle of elements, of which the one
that touches and parts at the compression l carries k dl**p times (c/H)**(n - p), where H is the
highest compression since it touched. `Law(k)` is a spring, `Law(k, 1.5)` Hertz's contact.

Powers that are not whole numbers have no Taylor series at c = 0. A force that is less than
10**-24 of its scale (that of the impact speed, or of the peak) is therefore left out there; the
steps towards and away from that place shrink and grow with the distance to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from mpmath import mp, mpf

from benchmarks.impacts.first_zero import first_zero, leading_order
from reference.common import DIGITS, TINY, Interval, Number, Outcome, kinetic

TERMS = 44  # of a Taylor series
PRECISION = mpf(10) ** -27  # of a step, in units of the problem's length
CONVERGED = mpf(10) ** -12  # the last term of a force series, over the first
NEGLECTED = 24  # digits of a force that are left out near c = 0
EQUAL = mpf(10) ** -20  # velocities that differ by less, in units of the largest, are equal

OPEN, FAINT, LOADING, UNLOADING = range(4)


@dataclass(frozen=True)
class Law:
    """F = stiffness c**loading, back along c**unloading from the peak; None: the same way back."""

    stiffness: float
    loading: float = 1
    unloading: Number | None = None

    @classmethod
    def of_restitution(cls, stiffness: float, loading: float, restitution: float) -> "Law":
        """Return the law whose restitution, e**2 = (p + 1) / (n + 1), is the given one."""
        with mp.workdps(DIGITS):
            return cls(stiffness, loading, (mpf(loading) + 1) / mpf(restitution) ** 2 - 1)


def one_ball(mass: float, law: Law, speed: float) -> Interval:
    """Return the one contact of a single ball in closed form; its impulse is m v (1 + e)."""
    with mp.workdps(DIGITS):
        m, k, v, p = mpf(mass), mpf(law.stiffness), mpf(speed), mpf(law.loading)
        n = p if law.unloading is None else mpf(law.unloading)
        e = mp.sqrt((p + 1) / (n + 1))
        peak = _peak(law, m, v)
        time = peak / v * (_quarter(p) + _quarter(n) / e)
        return Interval(0, mpf(0), time, k * peak**p, peak, m * v * (1 + e))


def _quarter(power: Number) -> Number:
    """Return the integral of dx / sqrt(1 - x**(power + 1)) from 0 to 1."""
    s = 1 / (power + 1)
    return mp.sqrt(mp.pi) * mp.gamma(1 + s) / mp.gamma(mpf(1) / 2 + s)


def _peak(law: Law, mass: Number, speed: Number) -> Number:
    """Return the peak compression of that mass at that speed."""
    p = mpf(law.loading)
    return ((p + 1) * mass * speed**2 / (2 * mpf(law.stiffness))) ** (1 / (p + 1))


class Polynomial:
    """A Taylor polynomial, used on [0, step]."""

    def __init__(self, terms: Sequence[Number], step: Number) -> None:
        last = max((i for i, a in enumerate(terms) if a), default=0)
        self.terms, self.step = list(terms[: last + 1]), step

    def derivatives(self, t: Number, orders: int = 10) -> list[Number]:
        """Return the value and the first derivatives at t."""
        left, found, factorial = self.terms + [mpf(0)] * orders, [], 1
        for order in range(orders):
            if t:
                for i in range(len(left) - 2, order - 1, -1):
                    left[i] += t * left[i + 1]
            found.append(left[order] * factorial)
            factorial *= order + 1
        return found

    def bound(self, order: int) -> Number:
        """Return a bound of the size of a derivative on [0, step]."""
        total, power = mpf(0), mpf(1)
        for i in range(order, len(self.terms)):
            total += abs(self.terms[i]) * mp.ff(i, order) * power
            power *= self.step
        return total

    def slope(self, unit: Number) -> "Polynomial":
        """Return the derivative times a unit of time."""
        terms = [unit * i * a for i, a in enumerate(self.terms)]
        return Polynomial(terms[1:] or [mpf(0)], self.step)

    def integral(self) -> Number:
        """Return the integral over [0, step]."""
        return sum((a * self.step ** (i + 1) / (i + 1) for i, a in enumerate(self.terms)), mpf(0))

    def above(self, level: Number) -> "Polynomial":
        """Return the polynomial minus a constant."""
        return Polynomial([self.terms[0] - level, *self.terms[1:]], self.step)

    def below(self, level: Number) -> "Polynomial":
        """Return a constant minus the polynomial."""
        return Polynomial([-a for a in self.above(level).terms], self.step)


class Contact:
    """One contact: its law, its phase, what its elements remember, its interval.

    `bundle` has pairs of l and H: the elements from l to that of the next pair remember H, or None
    if they are on the loading curve.
    """

    def __init__(self, index: int, law: Law, scale: Number) -> None:
        self.index, self.scale = index, scale
        self.k, self.p = mpf(law.stiffness), mpf(law.loading)
        self.n = self.p if law.unloading is None else mpf(law.unloading)
        self.phase = OPEN
        self.bundle: list[tuple[Number, Number | None]] = [(mpf(0), None)]
        self.interval = Interval(index, mpf(0))

    @property
    def faint(self) -> Number:
        """Return the compression below which the force is left out."""
        peak = self.bundle[0][1]
        power, scale = (self.n, peak) if peak else (self.p, self.scale)
        return mpf(0) if power == 1 else scale * mpf(10) ** (-NEGLECTED / power)

    @property
    def terms(self) -> list[tuple[Number, Number]]:
        """Return the factors and the powers of c that are the present force."""
        if self.phase in (OPEN, FAINT):
            return []
        fade, held = self.n - self.p, mpf(0)
        for (low, peak), (high, _) in pairwise(self.bundle):
            held += (self._load(high) - self._load(low)) / peak**fade
        low, peak = self.bundle[-1]
        if peak is None:
            found = [(self.k, self.p), (held, fade), (-self._load(low), mpf(0))]
        else:
            found = [(self.k / peak**fade, self.n), (held - self._load(low) / peak**fade, fade)]
        return [(factor, power) for factor, power in found if factor]

    def _load(self, c: Number) -> Number:
        return self.k * c**self.p

    def events(self, c: Polynomial, unit: Number) -> list[tuple[Polynomial, int]]:
        """Return curves that are positive in this phase, and the phase after the zero of each."""
        (low, peak), faint = self.bundle[-1], self.faint
        turns_back = c.slope(-unit), LOADING
        if self.phase == OPEN:
            return [(c.below(mpf(0)), FAINT if faint else LOADING)]
        if self.phase == FAINT:
            return [(c, OPEN), turns_back if peak else (c.below(faint), LOADING)]
        if self.phase == UNLOADING:
            ends = (c.above(low), UNLOADING) if low else (c.above(faint), FAINT if faint else OPEN)
            return [turns_back, ends]
        return [
            (c.slope(unit), UNLOADING),
            *((c.below(before), LOADING) for _, before in self.bundle[-2:-1]),
        ]

    def enter(self, phase: int, c: Number, now: Number, done: list[Interval]) -> None:
        """Change the phase."""
        before, self.phase = self.phase, phase
        low, peak = self.bundle[-1]
        if before == OPEN:
            self.interval = Interval(self.index, now)
            done.append(self.interval)
        elif phase == OPEN:
            self.interval.end, self.bundle = now, [(mpf(0), None)]
        elif phase == UNLOADING and before == LOADING:
            self.bundle[-1] = (low, c)
            self.interval.peak_compression = max(self.interval.peak_compression, c)
            self.interval.peak_force = self._load(self.interval.peak_compression)
        elif phase == LOADING and peak:
            self.bundle.append((c, None))
        elif phase == before:  # at the last but one turning point again
            del self.bundle[-1]
            if phase == LOADING:
                self.bundle[-1] = (self.bundle[-1][0], None)


def _differences(q: Sequence[Number]) -> list[Number]:
    """Return q[i-1] - q[i], and -q[0] at the floor."""
    return [below - x for below, x in zip([mpf(0), *q], q, strict=False)]


def _series(
    masses: Sequence[Number],
    contacts: Sequence[Contact | None],
    q: Sequence[Number],
    v: Sequence[Number],
) -> tuple[list[list[Number]], list[list[Number]], list[list[Number]], list[list[Number]]]:
    """Return the Taylor coefficients of positions, compressions, forces, and powers of these."""
    n = len(q)
    balls = [[a, b] for a, b in zip(q, v, strict=True)]
    c = [[a, b] for a, b in zip(_differences(q), _differences(v), strict=True)]
    terms = [(i, *term) for i, x in enumerate(contacts) if x for term in x.terms]
    powers: list[list[Number]] = [[] for _ in terms]
    forces: list[list[Number]] = [[] for _ in range(n + 1)]  # nothing is above the last ball
    for order in range(TERMS):
        for force in forces:
            force.append(mpf(0))
        for (i, factor, power), series in zip(terms, powers, strict=True):
            series.append(_power_term(c[i], series, power))
            forces[i][order] += factor * series[order]
        for j in range(n):
            push = forces[j][order] - forces[j + 1][order]
            balls[j].append(push / masses[j] / ((order + 1) * (order + 2)))
        for i, x in enumerate(_differences([b[-1] for b in balls])):
            c[i].append(x)
    return balls, c, forces[:n], powers


def _power_term(c: Sequence[Number], before: Sequence[Number], power: Number) -> Number:
    """Return the next Taylor coefficient of c**power, from c (c**power)' = power c' c**power."""
    k = len(before)
    if power == 1:
        return c[k]
    if power == 0:
        return mpf(k == 0)
    if k == 0:
        return c[0] ** power
    terms = ((power * j - (k - j)) * c[j] * before[k - j] for j in range(1, k + 1))
    return sum(terms, mpf(0)) / (k * c[0])


def _reach(
    balls: Sequence[Sequence[Number]], powers: Sequence[Sequence[Number]], length: Number
) -> Number:
    """Return a step on which the Taylor series are precise, well inside their convergence."""
    terms = [(abs(b[i]) / (PRECISION * length), i) for b in balls for i in (TERMS, TERMS + 1)]
    terms += [(abs(x[-1] / x[0]) / CONVERGED, TERMS - 1) for x in powers if x[0]]
    return min((a ** (-mpf(1) / i) for a, i in terms if a), default=mp.inf)


def run(
    masses: Sequence[float],
    laws: Sequence[Law | None],
    gaps: Sequence[float],
    velocities: Sequence[float],
) -> Outcome:
    """Solve a drop: ball 0 starts at the floor's height, the others above it by the gaps."""
    with mp.workdps(DIGITS):
        m, v, q = [mpf(x) for x in masses], [mpf(x) for x in velocities], [mpf(0)]
        for gap in gaps:
            q.append(q[-1] + mpf(gap))
        speed = max(abs(x) for x in v)
        scales = [_peak(law, max(m), speed) if law else mp.inf for law in laws]
        contacts = [
            Contact(i, law, scale) if law else None
            for i, (law, scale) in enumerate(zip(laws, scales, strict=True))
        ]
        return _advance(m, contacts, q, v, min(scales))


def _advance(
    m: list[Number],
    contacts: list[Contact | None],
    q: list[Number],
    v: list[Number],
    length: Number,
) -> Outcome:
    """Step, at most to the next event, until no contact is closed and none approaches."""
    energy, now, speed = kinetic(m, v), mpf(0), max(abs(x) for x in v)
    done: list[Interval] = []
    while True:
        balls, c, forces, powers = _series(m, contacts, q, v)
        reach = _reach(balls, powers, length)
        curves = [Polynomial(x, reach) for x in c]
        step, contact, phase = _next_event(contacts, curves, reach, length, speed)
        if step == mp.inf or (step > 0 and _parting(contacts, v, speed)):
            return Outcome(v, done, now, kinetic(m, v) / energy)
        for running, force in zip(contacts, forces, strict=True):
            if running:
                running.interval.impulse += Polynomial(force, step).integral()
        state = [Polynomial(b, step).derivatives(step, 2) for b in balls]
        q, v = [x[0] for x in state], [x[1] for x in state]
        now += step
        if contact:
            contact.enter(phase, _differences(q)[contact.index], now, done)


def _next_event(
    contacts: Sequence[Contact | None],
    curves: Sequence[Polynomial],
    reach: Number,
    length: Number,
    speed: Number,
) -> tuple[Number, Contact | None, int]:
    """Return the step to the next event, its contact and the phase after it."""
    best: tuple[Number, Contact | None, int] = (reach, None, OPEN)
    time, tiny = length / speed, TINY * length
    for contact, c in zip(contacts, curves, strict=True):
        for curve, phase in contact.events(c, time) if contact else ():
            d = curve.derivatives(mpf(0))
            order = leading_order(curve, d, tiny, time) if d[0] <= tiny else None
            if order and d[order] < 0:
                return mpf(0), contact, phase
            found = first_zero(curve, mpf(0), best[0], tiny, time)
            if found is not None:
                best = (found, contact, phase)
    return best


def _parting(contacts: Sequence[Contact | None], v: Sequence[Number], speed: Number) -> bool:
    """Return whether all contacts are open and none approaches."""
    pairs = [(x, rate) for x, rate in zip(contacts, _differences(v), strict=True) if x]
    return all(x.phase == OPEN and rate <= EQUAL * speed for x, rate in pairs)
