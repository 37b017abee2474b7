"""Many drops at once, as kernels take them and leave them, by compiled code."""

import numpy as np

from stackbounce.engine import codes, native
from stackbounce.engine.memory import lane_workspace, memory
from stackbounce.engine.records import Drops, Outcomes
from stackbounce.engine.tables import Table
from stackbounce.run import batch
from stackbounce.run.batch import new_outcomes


def bits(values):
    """Return the bits of numbers, where all that is not a number is alike."""
    array = np.asarray(values)
    if array.dtype.kind == "f":
        array = np.where(np.isnan(array), np.nan, array)
    return array.tobytes()


def numbers_of(drawn, rows=slice(None)):
    """Return some drops, also of `fuzz.draw`, as kernels take them."""
    return Drops._make(np.ascontiguousarray(getattr(drawn, name)[rows]) for name in Drops._fields)


def swept(engine, drops, options):
    out = _room(drops)
    room = memory(engine, drops.mass.shape[1], compiled=True)
    room.run_batch(engine.run_batch, drops, options, out)
    return out


def in_lanes(entry, drops, limit):
    """Return the outcomes of two balls by an engine in lanes."""
    out, space = _room(drops), lane_workspace(compiled=True)
    space.record.floats[:] = np.nan  # what is left of an earlier run has no effect
    native.compiled(entry)(Table(drops), limit, Table(out), space)
    return out


def swept_in_lanes(entry, drops, options):
    """Return the outcomes of two balls, and of how many of them the lanes are not sure at first."""
    out, limit = _room(drops), options.rtol if entry == "run_pairs" else options.event_limit
    asked = int((in_lanes(entry, drops, limit).status == codes.ASK).sum())
    batch.run_lanes(entry, drops, out, options, True, lambda: None)
    return out, asked


def pairs(count, seed, reach=3.0, gravity=False, forms=codes.PAIR_FORMS):
    """Return drops of two balls under laws of all forms that an engine in lanes knows.

    Masses and stiffnesses differ by up to ten to the power ``reach``; losses are weak to strong; a
    third of the balls touch, gaps of the others are 1e-6 to 10 compressions. Gravity, if any, is
    1e-6 to 1/300 of a typical acceleration in the impact.
    """
    random = np.random.default_rng(seed)
    form = random.choice(forms, (count, 2))
    mass = 10.0 ** random.uniform(-0.5 * reach, 0.5 * reach, (count, 2))
    stiffness = 10.0 ** (6.0 + random.uniform(-0.5 * reach, 0.5 * reach, (count, 2)))
    speed = np.repeat(10.0 ** random.uniform(-1.0, 1.0, (count, 1)), 2, axis=1)
    exponent = random.choice([1.5, 1.5, 1.0, 2.2], (count, 2))
    if forms == codes.LINEAR_FORMS:
        exponent[:] = 1.0
    exponent[form == codes.VISCOELASTIC] = 1.5
    exponent[(form == codes.DASHPOT) | (form == codes.RELAXING)] = 1.0
    depth = (mass * speed**2 / stiffness) ** (1.0 / (exponent + 1.0))
    # a loss in the unit of its form
    lossy = (form == code for code in (codes.DASHPOT, codes.VISCOELASTIC, codes.HUNT_CROSSLEY))
    unit = np.select(list(lossy), [np.sqrt(stiffness * mass), depth / speed, 1.0 / speed], 1.0)
    loss = unit * 10.0 ** random.uniform(-3.0, 0.0, (count, 2))
    loss[form == codes.RELAXING] *= 10.0
    loss[form == codes.HYSTERETIC] = (exponent + 10.0 * loss)[form == codes.HYSTERETIC]
    relaxing = depth / speed * 10.0 ** random.uniform(-1.0, 1.0, (count, 2))  # its time
    gap = depth * 10.0 ** random.uniform(-6.0, 1.0, (count, 2))
    gap[random.random(count) < 1.0 / 3.0] = 0.0
    gap[:, 0] = 0.0
    g = np.zeros(count)
    if gravity:
        g = speed[:, 0] ** 2 / depth.max(axis=1) * 10.0 ** random.uniform(-6.0, -2.5, count)
    return Drops(mass, form, stiffness, exponent, loss, relaxing, gap, -speed, g)


def rigid_pairs(count, seed, reach=3.0, least=0.0):
    """Return drops of two rigid balls; some touch, are elastic, or end at one speed or at rest."""
    random, drops = np.random.default_rng(seed), pairs(count, seed, reach)
    some = random.random(count) < 0.1
    ratio = random.choice([1 / 3, 0.5, 1.0, 2.0, 3.0], some.sum())
    drops.mass[some, 1] = drops.mass[some, 0] * ratio
    e = np.where(random.random((count, 1)) < 0.2, 1.0, random.uniform(least, 1.0, (count, 2)))
    return drops._replace(form=np.full((count, 2), codes.RIGID), third=e)


def _room(drops):
    return Outcomes._make(map(np.zeros_like, new_outcomes(*drops.mass.shape)))
