"""Rigid balls as a sequence of collisions (eqs 1 to 4), exactly or with many digits.

A restitution is a number, or a function of the closing speed that is called once for each
collision. With `fractions.Fraction` arguments everything is exact, ties included. With mpmath
numbers, velocities that differ by less than `TINY` of their own size are equal; a run that comes to
such a pair with constant restitutions below 1 is not finished, as it may be on its way to an
inelastic collapse.
Several contacts closing at once: the lowest approaching one collides first.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from mpmath import mp, mpf

from reference.common import DIGITS, TINY, Row


@dataclass(frozen=True)
class Collision:
    """A collision: when, which contact, and the velocities below and above it afterwards."""

    time: Any
    contact: int
    lower: Any
    upper: Any


@dataclass(frozen=True)
class RigidOutcome:
    """Velocities at the end, every collision, and whether the run came to an end by itself."""

    velocities: list[Any]
    collisions: list[Collision]
    finished: bool

    def counts(self) -> list[int]:
        """Return the number of collisions of every contact."""
        return [sum(c.contact == k for c in self.collisions) for k in range(len(self.velocities))]


@mp.workdps(DIGITS)
def run(
    masses: Row, restitutions: Row, gaps: Row, velocities: Row, limit: int = 100_000
) -> RigidOutcome:
    """Collide until nothing approaches, at most `limit` times; no floor: first restitution None."""
    exact = isinstance(masses[0], Fraction)
    tiny = Fraction(0) if exact else TINY
    zero = masses[0] * 0
    v, q, now = list(velocities), [zero], zero
    for gap in gaps:
        q.append(q[-1] + gap)
    first = 1 if restitutions[0] is None else 0
    decided = exact or all(callable(e) or e == 1 for e in restitutions[first:])
    done: list[Collision] = []
    while len(done) < limit:
        waits, close = [], False
        for i in range(first, len(v)):
            below, height = (v[i - 1], q[i - 1]) if i else (zero, zero)
            approach = below - v[i]
            if approach > tiny * (abs(below) + abs(v[i])):
                waits.append(((q[i] - height) / approach, i))
            close = close or 0 < abs(approach) <= tiny * (abs(below) + abs(v[i]))
        if close and not decided:
            break
        if not waits:
            return RigidOutcome(v, done, True)
        soonest = min(wait for wait, _ in waits)
        i = min(i for wait, i in waits if wait - soonest <= tiny * (now + abs(soonest)))
        q = [x + soonest * u for x, u in zip(q, v, strict=True)]
        now += soonest
        e = restitution_of(restitutions[i], (v[i - 1] if i else zero) - v[i])
        if i == 0:
            q[0], v[0] = zero, -e * v[0]
        else:
            q[i] = q[i - 1]
            v[i - 1], v[i] = collide(masses[i - 1], masses[i], e, v[i - 1], v[i])
        done.append(Collision(now, i, v[i - 1] if i else zero, v[i]))
    return RigidOutcome(v, done, False)


def restitution_of(given: Any, speed: Any) -> Any:
    """Return the restitution of a collision: a number as it is, or a function at the speed."""
    return given(speed) if callable(given) else given


def collide(m: Any, n: Any, e: Any, v: Any, w: Any) -> tuple[Any, Any]:
    """Return the velocities after a collision: momentum kept, relative velocity times -e."""
    centre = (m * v + n * w) / (m + n)
    return centre - n * e * (v - w) / (m + n), centre + m * e * (v - w) / (m + n)


def collapse_threshold(floor: Any, balls: Any) -> mpf:
    """Return the m2/m1 from which two balls falling together collide infinitely often."""
    with mp.workdps(DIGITS):
        a, b = mp.sqrt(mpf(floor)), mp.sqrt(mpf(balls))
        return ((a + b) / (1 - a * b)) ** 2


def elastic_pair(lower: Any, upper: Any, collisions: int) -> tuple[mpf, mpf]:
    """Return both velocities after that many elastic collisions of a pair falling at speed 1.

    In the plane (sqrt(m1) v1, sqrt(m2) v2) a collision is a reflection, and a floor collision
    followed by one of the balls a rotation by twice atan(sqrt(m1/m2)): a closed form.
    """
    with mp.workdps(DIGITS):
        a, b = mp.sqrt(mpf(lower)), mp.sqrt(mpf(upper))
        speed = mp.hypot(a, b)
        angle = mp.atan2(-b, -a) - (collisions // 2) * 2 * mp.atan2(a, b)
        if collisions % 2:
            angle = mp.pi - angle
        return speed * mp.cos(angle) / a, speed * mp.sin(angle) / b


def elastic_counts(lower: Any, upper: Any) -> tuple[int, int]:
    """Return the floor and the ball-ball collisions of an elastic pair, by the same reflections."""
    with mp.workdps(DIGITS):
        edge = mp.atan2(mp.sqrt(mpf(upper)), mp.sqrt(mpf(lower)))  # here v1 = v2
        angle, floor, balls = edge + mp.pi, 0, 0
        while angle > mp.pi / 2 + TINY:  # v1 < 0
            angle, floor = mp.pi - angle, floor + 1
            if angle >= edge - TINY:  # v1 <= v2
                break
            angle, balls = 2 * edge - angle, balls + 1
        return floor, balls
