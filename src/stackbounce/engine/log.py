"""Rows of the log of events."""

from stackbounce.engine import codes
from stackbounce.engine.kernels import Floats, Integers, kernel
from stackbounce.engine.slots import LOG_ROWS


@kernel
def append_row(
    log: Floats,
    counter: Integers,
    kind: int,
    contact: int,
    start: float,
    time: float,
    lower_velocity: float,
    upper_velocity: float,
) -> int:
    """Append an event to the log, all other columns 0; return where its row begins."""
    at = counter[LOG_ROWS] * codes.LOG_COLUMNS
    counter[LOG_ROWS] += 1
    for column in range(codes.LOG_COLUMNS):
        log[at + column] = 0.0
    log[at + codes.KIND] = kind
    log[at + codes.CONTACT] = contact
    log[at + codes.START] = start
    log[at + codes.TIME] = time
    log[at + codes.LOWER_VELOCITY] = lower_velocity
    log[at + codes.UPPER_VELOCITY] = upper_velocity
    return at


@kernel
def convert_log(log: Floats, rows: int, unit: float) -> None:
    """Convert rows of a log to SI units: with kg and m fixed, energies go with forces."""
    for line in range(rows):
        at = line * codes.LOG_COLUMNS
        for column in (codes.TIME, codes.START, codes.PEAK_TIME):
            log[at + column] *= unit
        for column in (codes.LOWER_VELOCITY, codes.UPPER_VELOCITY, codes.IMPULSE):
            log[at + column] /= unit
        log[at + codes.PEAK_FORCE] /= unit * unit
