"""One drop, or many drops one after the other, in the arrays of one stack.

Each row is a drop; columns are its balls, or the contacts below them. The outcome of a row depends
on that row only.
"""

import math

from stackbounce.engine import codes, slots
from stackbounce.engine.bodies import body_velocity_at_end
from stackbounce.engine.kernels import Floats, Integers, kernel
from stackbounce.engine.log import convert_log
from stackbounce.engine.motion import velocity_at
from stackbounce.engine.preparation import prepare, prepare_rigid
from stackbounce.engine.ratios import find_ratios
from stackbounce.engine.records import AFTER, BEGIN, CONTINUE, END, UNIT, Drops, Outcomes, Workspace
from stackbounce.engine.rigid import begin_collisions, collide_all, rigid_velocity
from stackbounce.engine.simultaneous import advance_contacts, begin_contacts, log_unfinished
from stackbounce.engine.stack import RigidStack, Samples, Stack
from stackbounce.engine.work import COLLISION, DROP, SLICE


@kernel
def run_drop(
    stack: Stack,
    space: Workspace,
    drops: Drops,
    samples: Samples,
    row: int,
    stage: int,
    until: float,
    rtol: float,
    event_limit: int,
    work_limit: int,
) -> int:
    """Run a drop with finite contacts; return its status.

    With the status RUNNING, the caller empties the log and continues: the log is full, or a slice
    of work is done, so that the caller can also stop. The number of rows in the log is
    ``counter[LOG_ROWS]``. The times in ``samples`` are in s; they are changed.
    """
    if stage != CONTINUE:
        clear_arrays(space.floats, space.integers)
        stack.counter[slots.RECORDS_PEAKS] = stage - BEGIN
        space.after[UNIT] = prepare(stack, drops, row, rtol)
        _divide(samples.time, space.after[UNIT])
        begin_contacts(stack)
    unit = space.after[UNIT]
    stack.counter[slots.LOG_ROWS] = 0
    status = advance_contacts(stack, until / unit, event_limit, work_limit, space.log, samples)
    if status != codes.RUNNING:
        end, bonded = end_of_run(stack.number, status, until / unit), stack.counter[slots.BONDS] > 0
        if status != codes.FINISHED:
            log_unfinished(stack, end, space.log)
        space.after[END] = end * unit
        for b in range(len(stack.mass)):
            known = status != codes.INVALID
            after = body_velocity_at_end(stack, b, end) if bonded else velocity_at(stack, b, end)
            space.after[AFTER + b] = after / unit if known else math.nan
        _divide(samples.velocity, unit)
        _divide(samples.force, unit * unit)
        _divide(samples.stored, unit * unit)
    convert_log(space.log, stack.counter[slots.LOG_ROWS], unit)
    return status


@kernel
def run_rigid_drop(
    stack: RigidStack,
    space: Workspace,
    drops: Drops,
    samples: Samples,
    row: int,
    stage: int,
    until: float,
    rtol: float,  # noqa: ARG001 - collisions are exact
    event_limit: int,
    work_limit: int,  # noqa: ARG001 - the limit of events is that of the work, too
) -> int:
    """Run a drop of rigid balls; see `run_drop`."""
    if stage != CONTINUE:
        clear_arrays(space.floats, space.integers)
        space.after[UNIT] = prepare_rigid(stack, drops, row)
        begin_collisions(stack)
    stack.counter[slots.LOG_ROWS] = 0
    status = collide_all(stack, until, event_limit, space.log, samples)
    stack.counter[slots.WORK] = COLLISION * stack.counter[slots.EVENTS]
    if status != codes.RUNNING:
        end = end_of_run(stack.number, status, until)
        space.after[END] = end
        for b in range(len(stack.mass)):
            known = status != codes.INVALID
            space.after[AFTER + b] = rigid_velocity(stack, b, end) if known else math.nan
    return status


@kernel
def run_batch(
    stack: Stack,
    space: Workspace,
    drops: Drops,
    samples: Samples,
    until: float,
    rtol: float,
    event_limit: int,
    work_limit: int,
    out: Outcomes,
    row: int,
) -> int:
    """Run drops with finite contacts one after the other, from a row on, for a slice of work.

    Returns the first row whose drop has not ended: the caller continues there until all have. The
    same stack is used for all drops. At first no status in ``out`` may be RUNNING.
    """
    work = 0
    while row < len(out.status) and work < SLICE:
        stage = _stage(out, row)
        status = run_drop(
            stack, space, drops, samples, row, stage, until, rtol, event_limit, work_limit
        )
        work += _read_outcome(space, stack.counter, status, out, row)
        if status != codes.RUNNING:
            find_ratios(drops, out, row)
            row += 1
    return row


@kernel
def run_rigid_batch(
    stack: RigidStack,
    space: Workspace,
    drops: Drops,
    samples: Samples,
    until: float,
    rtol: float,
    event_limit: int,
    work_limit: int,
    out: Outcomes,
    row: int,
) -> int:
    """Run drops of rigid balls and write their results to ``out``; see `run_batch`."""
    work = 0
    while row < len(out.status) and work < SLICE:
        stage = _stage(out, row)
        status = run_rigid_drop(
            stack, space, drops, samples, row, stage, until, rtol, event_limit, work_limit
        )
        work += _read_outcome(space, stack.counter, status, out, row)
        if status != codes.RUNNING:
            for i in range(len(stack.infinite)):
                if stack.infinite[i] == 1:
                    out.collisions[row, i] = -1
            find_ratios(drops, out, row)
            row += 1
    return row


@kernel
def clear_arrays(floats: Floats, integers: Integers) -> None:
    """Set all numbers of a stack to zero."""
    for k in range(len(floats)):
        floats[k] = 0.0
    for k in range(len(integers)):
        integers[k] = 0


@kernel
def _divide(values: Floats, unit: float) -> None:
    """Divide all values by a unit."""
    for k in range(len(values)):
        values[k] /= unit


@kernel
def end_of_run(number: Floats, status: int, until: float) -> float:
    """Return the time of the end of a run: that of its last event, or that at which it stopped."""
    if status == codes.TIME_REACHED:
        return until
    if status == codes.FINISHED:
        return number[slots.LAST_EVENT]
    return max(number[slots.LAST_EVENT], number[slots.LAST_CHECK])


@kernel
def _stage(out: Outcomes, row: int) -> int:
    """Return the stage of a row: a drop that is not under way begins, with empty outcomes."""
    if out.status[row] == codes.RUNNING:
        return CONTINUE
    out.work[row] = 0
    for i in range(len(out.collisions[row])):
        out.collisions[row, i] = 0
        out.first_touch[row, i] = math.nan
        out.last_release[row, i] = math.nan
    return BEGIN


@kernel
def _read_outcome(space: Workspace, counter: Integers, status: int, out: Outcomes, row: int) -> int:
    """Write what a run of a drop, or a slice of it, has given to ``out``; return its work."""
    for line in range(counter[slots.LOG_ROWS]):
        at = line * codes.LOG_COLUMNS
        kind = int(space.log[at + codes.KIND])
        if kind not in (codes.RELEASE, codes.COLLISION):
            continue
        i = int(space.log[at + codes.CONTACT])
        begin, end = space.log[at + codes.START], space.log[at + codes.TIME]
        out.collisions[row, i] += 1
        if not out.first_touch[row, i] <= begin:
            out.first_touch[row, i] = begin
        if not out.last_release[row, i] >= end:
            out.last_release[row, i] = end
    for b in range(len(out.rebound_ratio[row])):
        out.rebound_ratio[row, b] = space.after[AFTER + b]
    work: int = DROP + counter[slots.WORK] - out.work[row]
    out.status[row], out.work[row] = status, counter[slots.WORK]
    return work
