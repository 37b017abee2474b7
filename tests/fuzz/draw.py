"""Random drops, a batch at a time: the same numbers for the same seed and batch, whoever asks."""

from typing import NamedTuple

import numpy as np

from stackbounce.engine import codes
from stackbounce.engine.elementary import power

# laws of random drops
NONE, SPRING, HERTZ, POWER, DASHPOT, VISCOELASTIC, HUNT_CROSSLEY = range(7)
HYSTERETIC, RIGID, RELAXING = range(7, 10)

BATCH = 500
BALLS = (2, 3, 1, 2, 4, 3, 2, 1, 5, 2, 3, 4, 2, 1, 3, 2, 6, 1, 2, 3, 4, 2, 5, 1, 2)  # by batch
RIGID_EVERY = 3  # one batch in so many is of rigid stacks
STOPS = 3  # times in between at which some of the drops are looked at
EVENTS = (300, 10_000)  # limits, usual and rare
RARE = 0.001
RELAXED = 0.1  # contacts whose force relaxes
PULLED = 0.1  # with gravity
STOPPED = (0.04, 0.5)  # run until a given time, without gravity and with it
IN_PARTS = 0.05  # run once more, with stops in between
TOLERANCES = (1e-6, 1e-7, 1e-9, 1e-12, 1e-3, 1e-14)
KINDS = (  # of the laws by their numbers
    codes.ABSENT,
    codes.POWER,
    codes.POWER,
    codes.POWER,
    codes.DASHPOT,
    codes.VISCOELASTIC,
    codes.HUNT_CROSSLEY,
    codes.HYSTERETIC,
    codes.RIGID,
    codes.RELAXING,
)
TOLERANCE_ODDS = (0.6, 0.1, 0.15, 0.1, 0.03, 0.02)


class Drops(NamedTuple):
    """Drops of one height: rows of drops, columns of balls or of the contacts below them."""

    mass: np.ndarray
    law: np.ndarray  # by the numbers above
    form: np.ndarray  # of its force, by `engine.codes`, with its four numbers
    first: np.ndarray  # stiffness
    second: np.ndarray  # exponent
    third: np.ndarray  # damping, dissipative time, dissipation, unloading exponent, restitution,
    # relaxation strength
    fourth: np.ndarray  # relaxation time
    gap: np.ndarray  # below each ball; the lowest one's is 0
    velocity: np.ndarray
    gravity: np.ndarray
    until: np.ndarray
    rtol: np.ndarray
    limit: np.ndarray  # of events
    stops: np.ndarray  # (drops, STOPS) parts of the whole time, ascending; 0 where not stopped


def is_rigid(batch: int) -> bool:
    return batch % RIGID_EVERY == RIGID_EVERY - 1


def balls_of(batch: int) -> int:
    """Return the height of a batch's stacks."""
    return BALLS[batch % len(BALLS)]


def drops_of(seed: int, batch: int, count: int = BATCH) -> Drops:
    random = np.random.default_rng([seed, batch])
    balls, rigid = balls_of(batch), is_rigid(batch)
    shape = (count, balls)
    mass = _masses(random, shape)
    velocity = _velocities(random, shape)
    speed = np.max(np.abs(velocity), axis=1, keepdims=True)
    below = np.column_stack([np.full(count, np.inf), mass[:, :-1]])
    reduced = mass / (1.0 + mass / below)
    linear = _linear_stiffnesses(random, shape)
    length = speed * np.sqrt(reduced / linear)
    law, exponent, extra = _laws(random, shape)
    if rigid:
        law[:] = RIGID
        extra[:] = _restitutions(random, shape)
    law[random.random(count) < 0.3, 0] = NONE
    extra = _damping(random, law, extra, linear, reduced, length, speed)
    slowest = np.max(np.where(law == NONE, 0.0, length), axis=1)
    time = np.where(slowest > 0.0, slowest, 1.0) / speed[:, 0]
    pulled = random.random(count) < PULLED
    gravity = np.where(pulled, speed[:, 0] / time * _decades(random, count, -4.0, 1.0), 0.0)
    stopped = random.random(count) < np.where(pulled, STOPPED[1], STOPPED[0])
    until = np.where(stopped, time * _decades(random, count, -2.0, 3.0), np.inf)
    stops = np.sort(random.random((count, STOPS)), axis=1)
    stops[random.random(count) >= IN_PARTS] = 0.0
    choice = random.choice(len(TOLERANCES), count, p=TOLERANCE_ODDS)
    gap = _gaps(random, shape, np.where(law == NONE, slowest[:, None], length))
    limit = np.where(random.random(count) < RARE, EVENTS[1], EVENTS[0])
    relaxing = (random.random(shape) < RELAXED) & (law != NONE) & (not rigid)
    law, exponent = np.where(relaxing, RELAXING, law), np.where(relaxing, 1.0, exponent)
    extra = np.where(relaxing, _decades(random, shape, -3.0, 2.0), extra)
    relaxation_time = np.where(relaxing, length / speed * _decades(random, shape, -2.5, 2.5), 0.0)
    drops = Drops(
        mass=mass,
        law=law,
        form=np.array(KINDS)[law],
        first=linear * _power(length, 1.0 - exponent),
        second=exponent,
        third=extra,
        fourth=relaxation_time,
        gap=gap,
        velocity=velocity,
        gravity=gravity,
        until=until,
        rtol=np.array(TOLERANCES)[choice],
        limit=limit,
        stops=stops,
    )
    return Drops(*map(np.ascontiguousarray, drops))  # one type of array, compiled once


def _damping(random, law, extra, linear, reduced, length, speed):
    """Return the laws' last numbers with those of damped ones, from faint to overdamped."""
    strength = _decades(random, law.shape, -6.0, 3.0)
    strength = np.where(random.random(law.shape) < 0.1, 1.0, strength)
    units = {
        DASHPOT: 2.0 * np.sqrt(linear * reduced),
        VISCOELASTIC: length / speed,
        HUNT_CROSSLEY: 1.0 / speed + 0.0 * length,
    }
    for kind, unit in units.items():
        extra = np.where(law == kind, strength * unit, extra)
    return extra


def _decades(random, shape, low, high):
    """Return numbers whose logarithms are uniform."""
    return _power(10.0, random.uniform(low, high, shape))


def _spread(random, shape, widths, odds):
    """Return rows of numbers each within its own number of decades."""
    width = random.choice(widths, (shape[0], 1), p=odds)
    return _power(10.0, width * random.uniform(-0.5, 0.5, shape))


def _masses(random, shape):
    mass = _spread(random, shape, [0.0, 1.0, 3.0, 6.0, 12.0], [0.15, 0.4, 0.3, 0.14, 0.01])
    whole = random.choice([1.0, 1.0, 2.0, 3.0, 4.0, 0.5, 0.25, 1.0 / 3.0, 100.0], shape)
    mass = np.where(random.random((shape[0], 1)) < 0.25, whole, mass)
    unit = random.choice([1.0, 0.1, 1e-6, 1e6], (shape[0], 1), p=[0.7, 0.1, 0.1, 0.1])
    return mass * unit


def _velocities(random, shape):
    """Return common, striking, or individual velocities, some of them equal or zero."""
    count, balls = shape
    velocity = np.full(shape, -1.0)
    kind = random.random(count)
    own = random.uniform(-1.0, 1.0, shape)
    own = np.where(random.random(shape) < 0.2, np.round(own), own)
    own[random.random(count) < 0.2] *= 1e-6
    own[:, -1] = np.where(random.random(count) < 0.7, -1.0, own[:, -1])
    own[~np.any(own, axis=1), -1] = -1.0
    velocity = np.where((kind < 0.3)[:, None], own, velocity)
    struck = np.zeros(shape)
    from_below = random.random(count) < 0.5
    struck[from_below, 0] = 1.0
    struck[~from_below, balls - 1] = -1.0
    velocity = np.where((kind > 0.8)[:, None], struck, velocity)
    unit = random.choice([1.0, 3.53, 1e-3, 1e3], (count, 1), p=[0.7, 0.1, 0.1, 0.1])
    return velocity * unit


def _linear_stiffnesses(random, shape):
    """Return the stiffness of the spring that would stop each contact's balls about as well."""
    linear = _spread(random, shape, [0.0, 1.0, 3.0, 8.0], [0.2, 0.4, 0.3, 0.1])
    return linear * random.choice([1.0, 1e3, 1e6], (shape[0], 1), p=[0.7, 0.2, 0.1])


def _laws(random, shape):
    """Return laws, loading exponents and, where they unload otherwise, unloading exponents."""
    law = random.integers(SPRING, HYSTERETIC + 2, shape)  # hysteresis twice as often
    one = random.integers(SPRING, HYSTERETIC + 2, (shape[0], 1))
    law = np.minimum(np.where(random.random((shape[0], 1)) < 0.3, one, law), HYSTERETIC)
    exponent = random.choice([1.0, 1.0, 1.5, 1.5, 2.0, 0.0], shape)
    exponent = np.where(exponent == 0.0, random.uniform(1.0, 4.0, shape), exponent)
    exponent = np.where(np.isin(law, (SPRING, DASHPOT)), 1.0, exponent)
    exponent = np.where(np.isin(law, (HERTZ, VISCOELASTIC)), 1.5, exponent)
    restitution = np.where(random.random(shape) < 0.1, 1.0, random.uniform(0.05, 1.0, shape))
    unloading = np.maximum(exponent, (exponent + 1.0) / restitution**2 - 1.0)
    return law, exponent, np.where(law >= HYSTERETIC, unloading, 0.0)


def _restitutions(random, shape):
    """Return restitutions, often one for a whole stack, often exactly 0 or 1."""
    own = random.random(shape)
    own = np.where(random.random(shape) < 0.1, 0.0, own)
    own = np.where(random.random(shape) < 0.2, 1.0, own)
    one = random.choice([0.0, 0.5, 0.8, 0.9, 1.0, 1.0], (shape[0], 1))
    return np.where(random.random((shape[0], 1)) < 0.5, one, own)


def _gaps(random, shape, length):
    """Return gaps of 0, tiny, about a contact's length, or huge, in a contact's own length."""
    count, balls = shape
    factors = np.select(
        [random.random(shape) < 0.4, random.random(shape) < 0.2, random.random(shape) < 0.8],
        [0.0, _decades(random, shape, -14.0, -3.0), _decades(random, shape, -2.0, 1.0)],
        _decades(random, shape, 1.0, 6.0),
    )
    factors[random.random(count) < 0.2] = 0.0
    gap = factors * length
    other = factors * np.roll(length, 1, axis=1)
    gap = np.where(random.random(shape) < 0.3, other, gap)
    gap[:, 0] = 0.0
    if balls > 1:
        equal = random.random(count) < 0.1
        gap[equal, 1:] = gap[equal, 1:2]
    return gap


def _power(base, exponent):
    """Return base^exponent of arrays with the same bits on every machine, as numpy's has not."""
    values = np.vectorize(power, otypes=[float])(base, exponent)
    return values.reshape(np.broadcast_shapes(np.shape(base), np.shape(exponent)))
