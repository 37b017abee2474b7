"""Rigid balls under gravity, every ball on its own parabola, with many digits.

Nothing is relative here: each ball has a height, a velocity and an acceleration, which is 0 for one
that rests on the floor or on a resting ball and -g for any other. A collision is the first zero of
the difference of two parabolas. Several at once: the lowest approaching contact first.
"""

from typing import Any

from mpmath import mp, mpf

from reference.common import DIGITS, TINY, Row
from reference.rigid import Collision, collide, restitution_of


@mp.workdps(DIGITS)
def fall(
    masses: Row, restitutions: Row, gaps: Row, velocities: Row, gravity: Any, until: Any
) -> tuple[list[Collision], list[mpf], list[mpf]]:
    """Return the collisions up to a time, and heights and velocities then; no floor: e[0] None."""
    masses, gaps, v = ([mpf(x) for x in row] for row in (masses, gaps, velocities))
    restitutions = [e if e is None or callable(e) else mpf(e) for e in restitutions]
    gravity, until, q, now = mpf(gravity), mpf(until), [mpf(0)], mpf(0)
    for gap in gaps:
        q.append(q[-1] + gap)
    first = 1 if restitutions[0] is None else 0
    done: list[Collision] = []
    while True:
        a = _accelerations(q, v, gravity, first)
        waits = [(_meeting(q, v, a, i), i) for i in range(first, len(v))]
        soonest = min(wait for wait, _ in waits)
        step = min(soonest, until - now)
        q = [x + (u + b * step / 2) * step for x, u, b in zip(q, v, a, strict=True)]
        v = [u + b * step for u, b in zip(v, a, strict=True)]
        now += step
        if soonest > step:
            return done, q, v
        i = min(i for wait, i in waits if wait - soonest <= TINY * (now + soonest))
        e = restitution_of(restitutions[i], (v[i - 1] if i else mpf(0)) - v[i])
        if i == 0:
            q[0], v[0] = mpf(0), -e * v[0]
        else:
            q[i] = q[i - 1]
            v[i - 1], v[i] = collide(masses[i - 1], masses[i], e, v[i - 1], v[i])
        done.append(Collision(now, i, v[i - 1] if i else mpf(0), v[i]))


def _accelerations(q: list[mpf], v: list[mpf], gravity: mpf, first: int) -> list[mpf]:
    """Return 0 for each ball at rest, the lowest ones, and -g for those above them."""
    resting = 0
    while first == 0 and resting < len(q) and abs(q[resting]) + abs(v[resting]) < TINY:
        resting += 1
    return [mpf(0)] * resting + [-gravity] * (len(q) - resting)


def _meeting(q: list[mpf], v: list[mpf], a: list[mpf], i: int) -> mpf:
    """Return how long contact i takes to close: gap + r t + s t^2/2 = 0, first zero going down."""
    below = (q[i - 1], v[i - 1], a[i - 1]) if i else (mpf(0), mpf(0), mpf(0))
    gap, r, s = q[i] - below[0], v[i] - below[1], a[i] - below[2]
    gap = gap if gap > TINY else mpf(0)
    if s == 0:
        return -gap / r if r < -TINY else mp.inf
    return (r + mp.sqrt(r * r - 2 * s * gap)) / -s if gap or abs(r) > TINY else mpf(0)
