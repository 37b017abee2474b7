"""The records of arrays that a run takes besides its stack: drops, outcomes, and its memory.

No kernel is imported here: who only loads the compiled code needs these.
"""

from typing import NamedTuple

from stackbounce.engine.kernels import (
    FloatColumn,
    Floats,
    FloatTable,
    IntegerColumn,
    Integers,
    IntegerTable,
)


class Drops(NamedTuple):
    """The numbers of drops: (rows, balls) arrays, and (rows,) gravity."""

    mass: FloatTable
    form: IntegerTable  # of force, and its four numbers, see `forces`
    first: FloatTable
    second: FloatTable
    third: FloatTable
    fourth: FloatTable
    gap: FloatTable  # below each ball; the lowest one's is 0
    velocity: FloatTable
    gravity: FloatColumn


class Outcomes(NamedTuple):
    """The results of drops: (rows, balls) arrays, and (rows,) energy and status."""

    rebound_ratio: FloatTable  # velocity over the impact speed v0; until `find_ratios` in m/s
    collisions: IntegerTable  # -1 where infinitely many
    first_touch: FloatTable  # s; nan where none
    last_release: FloatTable  # s; nan where none, infinity where the run stopped in an interval
    energy_retained: FloatColumn  # kinetic energy after over that before
    status: IntegerColumn
    work: IntegerColumn  # what the run cost, see `work`; 0 of springs and rigid balls in lanes


class Workspace(NamedTuple):
    """The memory of a run, besides its stack."""

    floats: Floats  # the array of all floats of the stack; empty for a stack that is new
    integers: Integers
    log: Floats  # rows of `codes.LOG_COLUMNS`, in SI units
    after: Floats  # unit of time (s) and end of the run (s), then the balls' velocities (m/s)


CONTINUE, BEGIN, BEGIN_WITH_PEAKS = 0, 1, 2  # stages: the latter records peaks and impulses
SCRATCH = 6144
UNIT, END, AFTER = 0, 1, 2  # slots of `Workspace.after`; AFTER is that of the lowest ball
