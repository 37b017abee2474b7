"""The one place that chooses how drops are run: the engine, and compiled code or plain Python.

============= =================================================================================
engine        solves
============= =================================================================================
`RIGID`       sequences of instantaneous collisions (eqs 1 to 4)
`FINITE`      simultaneous contacts of finite duration (eqs 5, 6 and section V)
two rigid     batches of two rigid balls without gravity (`engine.two_rigid`)
two springs   batches of two balls on springs without gravity (`engine.two_springs`)
linear        batches of two balls under any linear law, with or without gravity (`engine.pairs`)
pairs         batches of two balls under other laws, with or without gravity (`engine.pairs`)
============= =================================================================================

The last four do not answer drops that are near the limits of their accuracy (`batch.run_lanes`).

Compiled code is used wherever there is some for this machine (`engine.native`). Plain Python gives
the same bits, about a hundred times slower.
"""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, RIGID, Engine
from stackbounce.engine.work import LANE_EVENTS, LANES_RTOL, LOOPS_RTOL
from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.model import Drop
from stackbounce.model.laws import contact_numbers
from stackbounce.run.options import Options

if TYPE_CHECKING:
    from stackbounce.run.paths import Number


def choose_compiled(compiled: bool | None) -> bool:
    """Return whether compiled code is run; by default wherever there is some.

    Parameters
    ----------
    compiled : bool or None
        What the user asked for; None leaves the choice to what there is.

    Raises
    ------
    InvalidType
        If it is none of these.
    InvalidValue
        If compiled code is asked for and there is none for this machine.
    """
    if compiled is None:
        return native.available()
    if not isinstance(compiled, bool):
        raise InvalidType(f"compiled must be True, False or None, got {shown(compiled)}")
    if compiled and not native.available():
        raise InvalidValue(f"compiled must be False or None here: {native.reason()}")
    return compiled


def choose_engine(drop: Drop) -> Engine:
    """Return the engine that solves a drop."""
    return RIGID if drop.rigid else FINITE


def choose_lanes(drop: Drop, numbers: "Iterable[Number]", options: Options) -> str | None:
    """Return the kernel of the engine in lanes that can solve a batch of drops, if there is one.

    ``numbers`` are the parameters that differ between the drops. Their values are not considered,
    because the result of a drop must not depend on the other drops of the batch.
    """
    contacts = [contact_numbers(law)[0:3:2] for law in drop.contacts]
    together = len(set(drop.start_velocities)) == 1 and drop.start_velocities[0] < 0.0
    together &= all(n.part != "velocities" for n in numbers)
    whole = options.until == math.inf and options.event_limit >= LANE_EVENTS
    if len(contacts) != 2 or not (together and whole):
        return None
    forms, varied = {form for form, _ in contacts}, {n.field for n in numbers}
    weightless = drop.gravity == 0.0 and "gravity" not in varied
    linear = forms <= set(codes.LINEAR_FORMS) and "exponent" not in varied
    if weightless and forms == {codes.RIGID}:
        return "run_two_rigid"
    if linear and all(exponent == 1.0 for _, exponent in contacts):
        return "run_two_springs" if weightless and forms == {codes.POWER} else "run_linear"
    least = LOOPS_RTOL if codes.HYSTERETIC in forms else LANES_RTOL
    known = forms <= set(codes.PAIR_FORMS) and options.rtol >= least
    return "run_pairs" if known else None
