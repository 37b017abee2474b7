"""The arrays that hold a stack of balls: lists in plain Python, numpy arrays when compiled.

Index b runs over balls from the lowest up, index i over contacts; contact i lies below ball i.
A *cluster* is a run of balls joined by pressing contacts, known by its lowest ball; a ball in
flight is a cluster of its own. Each cluster is anchored at a time of its own: velocities (and
compressions of its pressing contacts) are those of the anchor. A contact between two clusters keeps
a ``compression[i]`` such that its compression at any time is that number plus the displacement of
the ball below it less that of the ball above it, both since the anchors of their clusters.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from stackbounce.engine.kernel import Floats, Integers, Rows
from stackbounce.engine.series import TERMS

MODES = 8  # linear contacts of one cluster up to which it moves in normal modes
WIDTH = MODES + 1  # their balls, where there is no floor


class Stack(NamedTuple):
    """A stack on finite contacts."""

    # what does not change: one entry per ball or contact
    mass: Floats
    law: Integers
    stiffness: Floats
    exponent: Floats
    unloading: Floats  # exponent of the unloading curve
    factor_exponent: Floats  # q of a damped contact's force k c^q (a + b c + d c') ...
    gain_constant: Floats  # ... a of its gain ...
    gain_slope: Floats  # ... b ...
    gain_rate: Floats  # ... and d
    scale: Floats  # a typical compression of the contact
    number: Floats  # [gravity, reference speed, tolerance of a velocity per step, faint work]
    # [order of the power series by which nonlinear clusters move, 1 where there can be any,
    # 1 where the peaks and the impulses of forces are asked for]
    setting: Integers
    # the state
    velocity: Floats
    velocity_noise: Floats  # round-off that the velocity may have gathered
    compression: Floats
    phase: Integers
    curve_force: Floats  # the curve that the force follows now: curve_force (c/curve_unit)^exponent
    curve_unit: Floats
    curve_exponent: Floats
    dip_energy: Floats  # energy stored when the compression last stopped falling
    base: Floats  # where a lossy contact came onto its loading curve, and what it held there
    base_energy: Floats
    top: Floats  # where an unloading curve joins the loading curve; infinite on the latter
    faint_below: Floats
    faint: Integers  # 1 where the force follows the chord of its curve below faint_below
    faint_impulse: Floats  # what the contact has exerted since it took that chord
    touching: Floats  # since when a contact has been touching without a force; nan if it is not
    released: Floats  # when a contact last came open
    pushed: Integers  # 1 where a ball at an open contact has been pressed since the last event
    clip_time: Floats  # since when a slack contact has had no force, and both velocities then
    clip_lower: Floats
    clip_upper: Floats
    # the interval of each contact that is under way
    start: Floats
    peak_force: Floats
    peak_compression: Floats
    impulse: Floats
    # clusters
    first: Integers  # lowest ball of the cluster that a ball belongs to
    last: Integers
    modal: Integers  # 1 where the cluster moves in normal modes or flies (entry of its lowest ball)
    order: Integers  # of the cluster's power series otherwise
    root: Integers  # which root of time it is a series in, 1 or 2
    speed: Floats  # to which its tolerance refers
    anchor: Floats
    # when to look: contacts, then ends of the series' validity by lowest ball; a queue of both
    due: Floats
    event: Integers
    heap: Integers
    place: Integers
    # normal modes, known by contact index
    rate: Floats  # effective stiffness F/c of a linear contact, or of a faint one's power of c
    weight: Floats  # square root of the rate over that of the cluster's lowest contact
    omega: Floats
    shape: Floats
    static: Floats
    cosine: Floats
    sine: Floats
    rows: Floats
    # power series about the anchor, a row for each ball or contact
    compression_series: Rows
    force_series: Rows
    velocity_series: Rows
    power_series: Rows  # of (c/curve_unit)^power ...
    gain_series: Rows
    power: Floats  # ... 0 where the force needs none
    # scratch space and counters
    scratch: Floats
    watched: Floats
    margin: Floats
    changed: Floats
    # [rows in the log, events so far, looks since the last one, next sample, contacts not open,
    # a contact that approached when last asked]
    counter: Integers
    clock: Floats  # [time of the last event, time of the last look]


class RigidStack(NamedTuple):
    """A stack of rigid balls."""

    mass: Floats
    law: Integers
    restitution: Floats
    velocity: Floats
    rate: Floats  # at which a contact closes, to more digits than the velocities' difference has
    rate_noise: Floats  # round-off that the rate may have gathered
    compression: Floats  # minus the gap
    infinite: Integers  # 1 where a contact has collided infinitely often
    # local times: of the velocity of a ball, of the rate and the gap of a contact, of the present
    since: Floats
    anchor: Floats
    now: Floats
    resting: Integers  # [balls at rest on the floor, lowest contact that loses energy]
    # when a contact collides next, and a queue of these times
    due: Floats
    heap: Integers
    place: Integers
    # what the search for collapse keeps: a state, the contacts hit since, where it was taken
    kept_rate: Floats
    kept_gap: Floats
    involved: Integers
    last_hit: Integers  # the collision, counted from 1, in which a contact was last hit
    # [contact hit then, collisions after which to keep another, those since, lowest and highest
    # contact involved]
    memory: Integers
    # [factor of velocities and gaps, time of the state kept, largest first speed, gravity]
    number: Floats
    counter: Integers  # as in a Stack
    clock: Floats


class Samples(NamedTuple):
    """What a run leaves at given times: rows of times, columns of balls or contacts."""

    time: Floats
    position: Floats
    velocity: Floats
    compression: Floats
    force: Floats
    stored: Floats


_PER_STACK = {"number": 4, "setting": 3, "counter": 6, "clock": 2}
_PER_SERIES = {"scratch": TERMS, "watched": TERMS, "margin": TERMS, "changed": TERMS}
_PER_SLOT = ("due", "event", "heap", "place")  # two slots for each ball
_PER_MODE = ("shape", "rows")
_INTEGERS = {
    name
    for record in (Stack, RigidStack)
    for name, kind in record.__annotations__.items()
    if kind is Integers
}
_ROWS = {name for name, kind in Stack.__annotations__.items() if kind is Rows}


def new_stack(size: int) -> Stack:
    """Return an empty stack of ``size`` balls as plain lists of zeros."""
    lengths = dict.fromkeys(Stack._fields, size)
    lengths |= dict.fromkeys(_PER_SLOT, 2 * size)
    lengths |= dict.fromkeys(_PER_MODE, size * WIDTH)
    lengths |= _PER_STACK | _PER_SERIES
    rows = {name: [[0.0] * TERMS for _ in range(size)] for name in _ROWS}
    return Stack(**_zeros(lengths) | rows)


def new_rigid_stack(size: int) -> RigidStack:
    """Return an empty stack of ``size`` rigid balls as plain lists of zeros."""
    lengths = dict.fromkeys(RigidStack._fields, size)
    lengths |= {"memory": 5, "number": 4, "now": 1, "resting": 2, "counter": 4, "clock": 2}
    return RigidStack(**_zeros(lengths))


def _zeros(lengths: dict[str, int]) -> dict[str, Any]:
    return {name: [0 if name in _INTEGERS else 0.0] * length for name, length in lengths.items()}


def new_samples(times: Sequence[float], size: int) -> Samples:
    """Return room for what a run leaves at given times, in ascending order."""
    return Samples(list(times), *([0.0] * (len(times) * size) for _ in range(5)))


def as_arrays(record: Any) -> Any:
    """Return a Stack or Samples of lists as one of numpy arrays, for compiled kernels."""
    import numpy as np

    return type(record)(
        *(
            np.array(values, dtype=np.int64 if name in _INTEGERS else np.float64)
            for name, values in zip(record._fields, record, strict=True)
        )
    )


def in_one_room(record: Any) -> tuple[Any, tuple[Any, Any]]:
    """Return a stack's copy of arrays that lie in one of floats and one of integers, and these two.

    To empty such a stack is to fill two arrays.
    """
    import numpy as np

    arrays = as_arrays(record)
    rooms: dict[Any, Any] = {}
    for kind in (np.float64, np.int64):
        sizes = [array.size for array in arrays if array.dtype == kind]
        room: Any = np.zeros(sum(sizes), dtype=kind)
        rooms[kind] = room, iter(np.split(room, np.cumsum(sizes)[:-1]))
    views = type(record)(
        *(next(rooms[array.dtype.type][1]).reshape(array.shape) for array in arrays)
    )
    return views, (rooms[np.float64][0], rooms[np.int64][0])
