"""The arrays that hold a stack of balls: lists in plain Python, numpy arrays when compiled.

Index b runs over balls from the lowest up, index i over contacts; contact i lies below ball i.
A *cluster* is a run of balls joined by pressing contacts, identified by its lowest ball; a ball in
flight is a cluster of its own. Each cluster has an anchor, a time at which the arrays give its
velocities and the compressions of its pressing contacts. For a contact between two clusters,
``compression[i]`` is such that its compression at any time is that number plus the displacement of
the ball below it minus that of the ball above it, both since the anchors of their clusters.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from stackbounce.engine import slots
from stackbounce.engine.kernels import Floats, Integers, Rows

MODES = 8  # the most linear contacts of a cluster that moves in normal modes
WIDTH = MODES + 1  # balls of that cluster, without a floor
TERMS = 40  # numbers of a power series
MOST_PIECES = 64  # of the curves of a contact, see `pieces`
PIECE_NUMBERS = 4  # numbers of a piece
TURNS = 64  # the most cycles inside one another that a contact remembers, see `cycles`


class Stack(NamedTuple):
    """A stack on finite contacts."""

    # constants: one entry per ball or contact
    mass: Floats
    law: Integers
    stiffness: Floats
    exponent: Floats
    unloading: Floats  # exponent of the unloading curve
    loss_exponent: Floats  # M of the share f + g (c/C)^M of the force that is left, see `cycles`
    factor_exponent: Floats  # q of a product k c^q (a + b c + s c^2 + d c' - m u), see `forces`
    gain_constant: Floats  # a of that gain
    gain_slope: Floats  # b
    gain_square: Floats  # s
    gain_origin: Floats  # the compression that c counts from in this gain; not 0 in pieces only
    gain_rate: Floats  # d
    gain_creep: Floats  # m
    creep_rate: Floats  # 1/w, at which u follows c
    bonded: Integers  # 1 if the contact also pulls, and never opens
    scale: Floats  # a typical compression of the contact
    number: Floats  # see `slots`
    # the state
    velocity: Floats
    velocity_noise: Floats  # bound on the accumulated round-off of the velocity
    compression: Floats
    phase: Integers
    creep: Floats  # u at the cluster's anchor; of an open contact at creep_time
    creep_time: Floats
    curve_force: Floats  # present force curve: curve_force (c/curve_unit)^curve_exponent
    curve_unit: Floats
    curve_exponent: Floats
    flat: Floats  # its part that is the gain alone, without the power
    top: Floats  # compression at which the present curve ends upwards; inf on the loading curve
    depth: Integers  # number of cycles that the present curve is inside of, see `cycles`
    highs: Floats  # their turning points: peaks, and the compressions where reloading began
    lows: Floats
    offset: Floats  # what elements that remember a peak add to the force: offset
    held_force: Floats  # + held_force (c/held_unit)^loss_exponent
    held_unit: Floats
    loading_pieces: Integers  # number of them; 0 if the force is no curve of pieces
    unloading_pieces: Integers
    returned: Floats  # share of the work of loading that unloading returns; see `pieces`
    piece_low: Floats  # where the present one begins and ends
    piece_high: Floats
    linearised_below: Floats
    linearised: Integers  # 1 if the force follows the chord of its curve up to linearised_below
    linearised_impulse: Floats  # impulse exerted along that chord
    touching: Floats  # time since which a contact touches without a force; nan if not touching
    released: Floats  # time of the last release
    pushed: Integers  # 1 if a ball at an open contact has been pressed since the last event
    clip_time: Floats  # time at which an unloaded contact was clipped, and velocities then
    clip_lower: Floats
    clip_upper: Floats
    # the present interval of each contact
    start: Floats
    peak_force: Floats
    peak_time: Floats  # of the peak force
    peak_compression: Floats
    impulse: Floats
    # clusters
    first: Integers  # lowest ball of the cluster that a ball belongs to
    last: Integers
    modal: Integers  # 1 if the cluster moves in normal modes or flies (entry of its lowest ball)
    order: Integers  # order of the cluster's power series otherwise
    root: Integers  # root of time in which it is a power series, 1 or 2
    speed: Floats  # speed to which its tolerance refers
    anchor: Floats
    # a queue of checks: contacts, then the ends of clusters' series (slot of the lowest ball)
    due: Floats
    event: Integers
    heap: Integers
    place: Integers
    # normal modes, indexed by contact
    rate: Floats  # stiffness F/c of a linear contact, or of the chord of a linearised one
    weight: Floats  # square root of rate over that of the cluster's lowest contact
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
    power_series: Rows  # of (c/curve_unit)^power
    gain_series: Rows
    held_series: Rows  # of (c/held_unit)^loss_exponent
    creep_series: Rows
    power: Floats  # of the power series; 0 if none is needed
    # scratch space and counters
    scratch: Floats
    watched: Floats
    margin: Floats
    changed: Floats
    counter: Integers  # see `slots`
    pieces: Floats  # room for MOST_PIECES of PIECE_NUMBERS numbers for each contact


class RigidStack(NamedTuple):
    """A stack of rigid balls."""

    mass: Floats
    law: Integers
    restitution: Floats  # of a contact for which it is the same in all collisions
    coefficient: Floats  # of a contact for which it is not, see `restitution`
    exponent: Floats
    scatter: Floats
    seed: Floats
    hits: Integers  # collisions so far
    velocity: Floats
    rate: Floats  # closing rate, more exact than the difference of velocities
    rate_noise: Floats  # bound on the accumulated round-off of the rate
    compression: Floats  # minus the gap
    infinite: Integers  # 1 if a contact has collided infinitely often
    # local times: of a ball's velocity, of a contact's rate and gap, and now (one number)
    since: Floats
    anchor: Floats
    now: Floats
    # a queue of the next collisions of contacts
    due: Floats
    heap: Integers
    place: Integers
    # the search for collapse: the reference state, and the contacts that have collided since
    kept_rate: Floats
    kept_gap: Floats
    involved: Integers
    last_hit: Integers  # the number of a contact's last collision, counted from 1
    number: Floats  # see `slots`
    counter: Integers


class Samples(NamedTuple):
    """The state at given times: rows of times, columns of balls or contacts."""

    time: Floats
    position: Floats
    velocity: Floats
    compression: Floats
    force: Floats
    stored: Floats


# lengths of arrays that do not have one number for each ball: of any stack, and of a `Stack`
_LENGTHS = {"number": slots.NUMBERS, "counter": slots.COUNTERS, "now": 1}
_LENGTHS |= dict.fromkeys(("scratch", "watched", "margin", "changed"), TERMS)
_KEPT = "pieces"  # the caller fills it before a run, which does not clear it
_PER_BALL = {_KEPT: MOST_PIECES * PIECE_NUMBERS}
_PER_BALL |= dict.fromkeys(("due", "event", "heap", "place"), 2)
_PER_BALL |= dict.fromkeys(("shape", "rows"), WIDTH) | dict.fromkeys(("highs", "lows"), TURNS)
_INTEGERS = {
    name
    for record in (Stack, RigidStack)
    for name, kind in record.__annotations__.items()
    if kind is Integers
}
_ROWS = {name for name, kind in Stack.__annotations__.items() if kind is Rows}


def new_stack(size: int) -> Stack:
    """Return an empty stack of ``size`` balls as plain lists of zeros."""
    rows = {name: [[0.0] * TERMS for _ in range(size)] for name in _ROWS}
    return Stack(**_zeros(Stack, size, _PER_BALL) | rows)


def new_rigid_stack(size: int) -> RigidStack:
    """Return an empty stack of ``size`` rigid balls as plain lists of zeros."""
    return RigidStack(**_zeros(RigidStack, size, {}))


def _zeros(record: Any, size: int, per_ball: dict[str, int]) -> dict[str, Any]:
    """Return a list of zeros for each field of a record; of some there are several per ball."""
    lengths = {name: size * per_ball.get(name, 1) for name in record._fields} | _LENGTHS
    return {name: [0 if name in _INTEGERS else 0.0] * lengths[name] for name in record._fields}


def new_samples(times: Sequence[float], size: int) -> Samples:
    """Return room for samples at given times, in ascending order."""
    return Samples(list(times), *([0.0] * (len(times) * size) for _ in range(5)))


def as_arrays(record: Any) -> Any:
    """Return a Stack or Samples of lists as one of numpy arrays, for compiled kernels."""
    import numpy as np

    return record._make(
        np.array(values, dtype=np.int64 if name in _INTEGERS else np.float64)
        for name, values in zip(record._fields, record, strict=True)
    )


def in_one_room(record: Any) -> tuple[Any, tuple[Any, Any]]:
    """Return a stack whose arrays are views of two arrays, and these two: floats and integers.

    Such a stack is cleared by filling the two arrays; its pieces are not among them, see `_KEPT`.
    """
    import numpy as np

    arrays = as_arrays(record)
    kept = {name: array for name, array in arrays._asdict().items() if name == _KEPT}
    arrays = arrays._replace(**dict.fromkeys(kept, np.zeros(0)))
    rooms: dict[Any, Any] = {}
    for kind in (np.float64, np.int64):
        sizes = [array.size for array in arrays if array.dtype == kind]
        room: Any = np.zeros(sum(sizes), dtype=kind)
        rooms[kind] = room, iter(np.split(room, np.cumsum(sizes)[:-1]))
    views = record._make(next(rooms[one.dtype.type][1]).reshape(one.shape) for one in arrays)
    return views._replace(**kept), (rooms[np.float64][0], rooms[np.int64][0])
