"""The curve that a contact with hysteresis follows in a lane: the numbers of its force.

What such a contact remembers is said in `cycles`; `pair_events` says when it turns.
"""

from stackbounce.engine import pair_step as lane
from stackbounce.engine.elementary import power
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.pair_step import BOTH


@kernel
def forget(x: Floats, k: int) -> None:
    """Let contact k be on its loading curve; this is all that there is without hysteresis."""
    x[lane.OUTWARD + k], x[lane.DEPTH + k], x[lane.HIGHS + k] = 0.0, 0.0, 1.0
    follow(x, k)


@kernel
def follow(x: Floats, k: int) -> None:
    """Set the numbers of the force of contact k on its present curve (see `cycles`)."""
    out, depth = x[lane.OUTWARD + k], int(x[lane.DEPTH + k])
    peak, held, before = x[lane.TOP + k] if out > 0.0 else x[lane.HIGHS + k], 0.0, 0.0
    for j in range(depth):
        high, low = x[lane.HIGHS + j * BOTH + k], x[lane.LOWS + j * BOTH + k]
        upto = x[lane.STIFFNESS + k] * power(low, x[lane.POWER + k] + 1.0)
        held += (upto - before) * power(peak / high, x[lane.LOSS + k])
        before = upto
    x[lane.OVER_PEAK + k], x[lane.ADDED + k], x[lane.KEPT + k] = 1.0 / peak, 1.0 - out, out
    x[lane.HELD + k], x[lane.OFFSET + k] = held - out * before, (out - 1.0) * before
    ends = lane.LOWS if out > 0.0 else lane.HIGHS
    x[lane.LEVEL + k] = x[ends + (depth - 1) * BOTH + k] if depth > 0 else 0.0
