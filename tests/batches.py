"""Many drops at once, as kernels take them and leave them, by compiled code."""

import numpy as np

from stackbounce.engine import native
from stackbounce.engine.memory import lane_workspace, memory
from stackbounce.engine.records import Drops, Outcomes
from stackbounce.engine.tables import Table
from stackbounce.run.batch import new_outcomes


def bits(values):
    """Return the bits of numbers, where all that is not a number is alike."""
    array = np.asarray(values)
    if array.dtype.kind == "f":
        array = np.where(np.isnan(array), np.nan, array)
    return array.tobytes()


def numbers_of(drawn, rows=slice(None)):
    """Return some drops of `fuzz.draw` as kernels take them."""
    return Drops._make(np.ascontiguousarray(getattr(drawn, name)[rows]) for name in Drops._fields)


def swept(engine, drops, options):
    out = _room(drops)
    room = memory(engine, drops.mass.shape[1], compiled=True)
    room.run_batch(engine.run_batch, drops, options, out)
    return out


def in_lanes(entry, drops, limit):
    """Return the outcomes of two balls by an engine in lanes."""
    out, space = _room(drops), Table(lane_workspace(compiled=True))
    native.compiled(entry)(Table(drops), limit, Table(out), space)
    return out


def _room(drops):
    return Outcomes._make(map(np.zeros_like, new_outcomes(*drops.mass.shape)))
