"""Can a vibration inside a ball give energy back? Each ball is two masses, joined by a spring.

A ball of one mass on elastic contacts loses nothing. A ball of two masses leaves the floor with a
part of its energy in a vibration of one against the other, which a measurement counts as lost. In
a pair the second collision finds the vibration of the first one and may take energy out of it.
`bound_energy` takes the loss of a single bounce for the least loss in a pair. That argument holds
for a contact that loses energy for good, not for a vibration: `InnerMode.excess` says by how much a
pair can retain more.

The contacts push only, and the spring inside a ball also pulls. While the same contacts are closed
the motion is a sum of normal modes; their changes are found as roots on a fine grid of times.
"""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.cross2007.drops import fallen_speed
from stackbounce.errors import between, positive
from stackbounce.model import Drop, Spring
from stackbounce.run.driver import simulate
from studies.table2 import inputs

__all__ = ["RATIOS", "SHARES", "InnerMode", "bounce_alone", "collide_pair", "compare_inner_modes"]

Array: TypeAlias = NDArray[np.float64]

RATIOS = (2.0, 3.0, 5.0, 10.0)
"""The frequency of a free ball's inner vibration over that of the ball on its contact, π/T."""

SHARES = (0.7, 0.3)
"""The share of a ball's mass that is in its lower part."""

_SPEED = fallen_speed(inputs.HEIGHT)
_PARTS = 60  # of the shortest period: the grid on which changes of contacts are looked for
_WINDOWS = 10_000  # of one period of a ball on its contact: more have never been needed
_ROUND = 1e-13  # of a typical compression


class InnerMode(NamedTuple):
    """A pair of elastic balls with an inner vibration, beside balls without.

    `first` and `second` are e1 and e2 of the centres of mass, and `rigid_first` and `rigid_second`
    are those of balls without an inner vibration. `kept` is the share of the energy in the motion
    of the centres, and `left` that in the vibrations: nothing is lost. `alone` is the restitution
    of the lower ball alone, and `bound` the share of the energy that the pair retains at most if
    what a ball loses alone is lost for good.
    """

    pair: str
    ratio: float
    share: float
    first: float
    second: float
    rigid_first: float
    rigid_second: float
    kept: float
    left: float
    alone: float
    bound: float

    @property
    def excess(self) -> float:
        """By how much the energy retained exceeds the bound; negative where the bound holds."""
        return self.kept - self.bound


class _Ball(NamedTuple):
    """A ball of two masses: mass in kg, floor stiffness in N/m, and the spring inside."""

    mass: float
    stiffness: float
    share: float
    ratio: float

    @property
    def masses(self) -> tuple[float, float]:
        return self.share * self.mass, (1.0 - self.share) * self.mass

    @property
    def inner_rate(self) -> float:
        return self.ratio * math.sqrt(self.stiffness / self.mass)

    @property
    def inner_stiffness(self) -> float:
        return self.share * (1.0 - self.share) * self.mass * self.inner_rate**2


def bounce_alone(ratio: float, share: float) -> float:
    """Return the restitution of one ball on an elastic floor, of its centre of mass.

    Parameters
    ----------
    ratio, share : float
        As in `RATIOS`, above 0, and in `SHARES`, from 0.001 to 0.999.

    Raises
    ------
    InvalidValue
        If one of them is out of its range.

    Examples
    --------
    >>> [round(bounce_alone(ratio, 0.7), 4) for ratio in (2.0, 10.0)]
    [0.9476, 0.9999]
    """
    ball = _ball(1.0, math.pi, ratio, share)
    speeds, _, _ = _run([ball], [ball.stiffness], 0.0, 1.0)
    return speeds[0]


def collide_pair(pair: str, ratio: float, share: float) -> InnerMode:
    """Return what an inner vibration changes in a pair of Table II.

    The contact times of Table I give the floor stiffnesses, two of which in series are that between
    the balls. The gap is the one that gives the delay of the pair's record, if the lower ball is
    alone until then.

    Parameters
    ----------
    pair : str
        A key of `studies.table2.inputs.PAIRS`.
    ratio, share : float
        As in `bounce_alone`, for both balls.

    Examples
    --------
    >>> found = collide_pair("B2_on_B1", 3.0, 0.3)
    >>> [round(number, 3) for number in (found.first, found.rigid_first, found.left)]
    [0.436, 0.452, 0.014]
    >>> round(found.excess, 3)
    0.046
    """
    solos = [inputs.read_solo(name) for name in inputs.PAIRS[pair]]
    balls = inputs.make_balls(pair)
    parts = [
        _ball(ball.mass, solo.contact_time, ratio, share)
        for ball, solo in zip(balls, solos, strict=True)
    ]
    lower, upper = (part.stiffness for part in parts)
    contacts = [lower, lower * upper / (lower + upper)]
    gap = _gap(inputs.MEASURED[pair][inputs.DELAY][0], solos[0].contact_time)
    speeds, kept, left = _run(parts, contacts, gap, _SPEED)
    drop = Drop(balls, [Spring(k) for k in contacts], [gap], impact_speed=_SPEED)
    rigid = simulate(drop).rebound_ratios
    alone = bounce_alone(ratio, share)
    masses = [ball.mass for ball in balls]
    bound = (masses[0] * alone**2 + masses[1]) / sum(masses)
    own = float(rigid[0]), float(rigid[1])
    e1, e2 = speeds
    return InnerMode(pair, ratio, share, e1, e2, *own, kept, left, alone, bound)


def compare_inner_modes(
    pairs: Iterable[str] = tuple(inputs.PAIRS),
    ratios: Iterable[float] = RATIOS,
    shares: Iterable[float] = SHARES,
) -> list[InnerMode]:
    """Return `collide_pair` of all pairs, ratios and shares, in this order."""
    ratios, shares = tuple(ratios), tuple(shares)
    return [
        collide_pair(pair, ratio, share) for pair in pairs for ratio in ratios for share in shares
    ]


def _ball(mass: float, contact_time: float, ratio: float, share: float) -> _Ball:
    stiffness = mass * (math.pi / contact_time) ** 2
    return _Ball(
        mass, stiffness, between("share", share, 0.001, 0.999), positive("ratio", ratio, "")
    )


def _gap(delay: float, contact_time: float) -> float:
    """Return the gap in m that closes at a delay, by a lower ball that bounces alone."""
    rate = math.pi / contact_time
    closed = min(delay, contact_time)
    lower = -math.sin(rate * closed) / rate + max(0.0, delay - contact_time)
    return _SPEED * (delay + lower)


class _Chain:
    """Masses in a row, the springs between them, and where the contacts are among these."""

    def __init__(self, parts: list[_Ball], contacts: list[float]) -> None:
        self.mass = np.array([mass for part in parts for mass in part.masses])
        pairs = zip(contacts, (part.inner_stiffness for part in parts), strict=True)
        self.stiffness = np.array([k for pair in pairs for k in pair])
        size = len(self.mass)
        self.compression = -np.eye(size) + np.eye(size, k=-1)  # of spring i, below mass i
        self.is_contact = np.arange(size) % 2 == 0

    def modes(self, closed: Array) -> tuple[Array, Array]:
        """Return frequencies, and shapes as columns, orthonormal with the masses as weights."""
        rows = self.compression * np.sqrt(self.stiffness * closed)[:, None] / np.sqrt(self.mass)
        square, shapes = np.linalg.eigh(rows.T @ rows)
        return np.sqrt(np.maximum(square, 0.0)), shapes / np.sqrt(self.mass)[:, None]


def _run(
    parts: list[_Ball], contacts: list[float], gap: float, speed: float
) -> tuple[list[float], float, float]:
    """Return the rebound ratios of the centres, and the energies of centres and vibrations."""
    chain = _Chain(parts, contacts)
    at = np.repeat(gap * np.arange(len(parts)), 2)
    velocity = np.full(len(at), -speed)
    window = max(math.tau / math.sqrt(part.stiffness / part.mass) for part in parts)
    closed = np.where(chain.is_contact, 0.0, 1.0)
    closed[0] = 1.0
    for _ in range(_WINDOWS):
        at, velocity, closed = _advance(chain, at, velocity, closed, window, speed)
        if not closed[chain.is_contact].any() and _apart(parts, at, velocity):
            ratios = [v / speed for v in _centres(parts, velocity)]
            whole = sum(part.mass for part in parts)
            kept = sum(part.mass * e * e for part, e in zip(parts, ratios, strict=True)) / whole
            swings = zip(parts, _swings(parts, at, velocity), strict=True)
            inside = sum(part.inner_stiffness * swing**2 for part, swing in swings)
            return ratios, kept, inside / whole / speed**2
    raise ArithmeticError


def _advance(
    chain: _Chain, at: Array, velocity: Array, closed: Array, window: float, speed: float
) -> tuple[Array, Array, Array]:
    """Return positions, velocities and closed springs after the next change, or after a window."""
    from scipy.optimize import brentq

    rates, shapes = chain.modes(closed)
    start, push = (shapes.T @ (chain.mass * x) for x in (at, velocity))
    signs = np.where(closed > 0.0, 1.0, -1.0)[chain.is_contact]
    observed = (chain.compression @ shapes)[chain.is_contact]
    least = _ROUND * speed * window

    def coordinates(t: Any) -> Any:
        angles = np.multiply.outer(t, rates)
        return start * np.cos(angles) + push * np.sinc(angles / math.pi) * np.asarray(t)[..., None]

    def margins(t: Any) -> Any:
        """Return the compressions of closed contacts, and minus those of open ones."""
        return signs * (coordinates(t) @ observed.T) + least

    times = np.linspace(0.0, window, 2 + int(_PARTS * window * rates.max() / math.tau))
    table = margins(times)
    changed = np.argwhere(table[1:] < 0.0)
    flipped = closed.copy()
    end = window
    if len(changed):
        row, i = changed[0]
        if table[row, i] > 0.0:
            end = brentq(lambda t: margins(t)[i], times[row], times[row + 1], xtol=1e-18)
        else:
            end = times[row]
        flipped[2 * i] = 1.0 - flipped[2 * i]
    turned = push * np.cos(rates * end) - start * rates * np.sin(rates * end)
    return shapes @ coordinates(end), shapes @ turned, flipped


def _centres(parts: list[_Ball], values: Array) -> list[float]:
    return [
        float(part.share * below + (1.0 - part.share) * above)
        for part, (below, above) in zip(parts, values.reshape(-1, 2), strict=True)
    ]


def _swings(parts: list[_Ball], at: Array, velocity: Array) -> list[float]:
    """Return the amplitude of the vibration in each ball, the change of its length."""
    lengths, rates = (np.diff(x.reshape(-1, 2))[:, 0] for x in (at, velocity))
    own = zip(parts, lengths, rates, strict=True)
    return [math.hypot(length, rate / part.inner_rate) for part, length, rate in own]


def _apart(parts: list[_Ball], at: Array, velocity: Array) -> bool:
    """Return whether balls that vibrate freely can never touch again."""
    height, speed, reach = 0.0, 0.0, 0.0  # of the floor, and how far it comes up
    centres, speeds = _centres(parts, at), _centres(parts, velocity)
    swings = _swings(parts, at, velocity)
    for i, part in enumerate(parts):
        below, above = (1.0 - part.share) * swings[i], part.share * swings[i]
        if speeds[i] <= speed or centres[i] - height <= below + reach:
            return False
        height, speed, reach = centres[i], speeds[i], above
    return True
