"""Two balls on springs (eqs 5 and 6) without gravity: many drops, fast.

The drops pass through the lanes of `lockstep`; a drop that has ended makes room for the next one. A
drop near the limits of accuracy is left to the general engine, with the status ASK.
"""

import math

from stackbounce.engine import lockstep as lane
from stackbounce.engine.codes import ASK, EVENT_LIMIT, FINISHED, INVALID
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.lockstep import LANES, advance_lanes
from stackbounce.engine.ratios import find_ratios
from stackbounce.engine.records import Drops, Outcomes, Workspace

# The slots of waiting drops: initial values, and the numbers given.
NEXT = lane.SLOTS * LANES
GIVEN = NEXT + lane.OWN * LANES
MASS1, MASS2, STIFFNESS1, STIFFNESS2, GAP, SPEED = (GIVEN + k * LANES for k in range(6))
SLOTS = GIVEN + 6 * LANES

_RATIO = 256.0  # largest ratio of masses and of stiffnesses; its inverse is the smallest
_GAP = 1e3  # largest gap in v0/omega
_OMEGA = 1e100  # largest frequency in 1/s; its inverse is the smallest


@kernel
def run_two_springs(drops: Drops, event_limit: int, out: Outcomes, space: Workspace) -> None:
    """Compute the outcomes of many drops of two balls on springs, without gravity.

    Parameters
    ----------
    drops : Drops
        The parameters of n drops. Both balls come with the lower one's velocity.
    event_limit : int
        The number of touches and releases after which a drop ends with EVENT_LIMIT.
    out : Outcomes
        Gets the ratios, numbers of collisions, and times. The status is FINISHED;
        EVENT_LIMIT; INVALID for input that is out of range; or ASK where the general engine must
        solve the drop. The other results of such a drop are meaningless.
    space : Workspace
        Its ``floats`` are scratch space, of the size `records.SCRATCH`.
    """
    x = space.floats
    rows = len(out.status)
    left, waiting, row = rows, 0, 0
    for i in range(LANES):
        x[lane.STATUS + i], x[lane.ROW + i] = ASK, -1.0  # free
    while left > 0:
        for i in range(LANES):
            while x[lane.STATUS + i] != 0.0:
                done = int(x[lane.ROW + i])
                if done >= 0:
                    _write_outcome(drops, out, x, i, done)
                    left -= 1
                if waiting == 0 and row < rows:
                    waiting = min(LANES, rows - row)
                    _fetch(drops, row, waiting, x)
                    _find_constants(x, waiting)
                    row += waiting
                if waiting == 0:
                    x[lane.STATUS + i], x[lane.ROW + i] = 0.0, -1.0
                    break
                waiting -= 1
                _begin(x, i, waiting)
        advance_lanes(x, event_limit)


@kernel
def _begin(x: Floats, i: int, waiting: int) -> None:
    """Start one of the fetched drops in lane i, at t = 0."""
    # no change: it shows a compiler the range
    i, waiting = i & (LANES - 1), waiting & (LANES - 1)
    for k in range(lane.OWN):
        x[k * LANES + i] = x[NEXT + k * LANES + waiting]
    x[lane.W0 + i], x[lane.U0 + i], x[lane.TIME + i], x[lane.FLOOR + i] = 0.0, -1.0, 0.0, 1.0
    x[lane.ROUNDS + i], x[lane.VAIN + i] = 0.0, 0.0
    x[lane.N0 + i], x[lane.N1 + i] = 1.0, x[lane.BALLS + i]
    x[lane.FIRST + i], x[lane.LAST0 + i], x[lane.LAST1 + i] = 0.0, 0.0, 0.0


@kernel
def _fetch(drops: Drops, row: int, count: int, x: Floats) -> None:
    """Copy the parameters of the next ``count`` drops, from a row on, to the waiting slots."""
    for i in range(count):
        x[NEXT + lane.ROW + i] = row + i
        x[MASS1 + i], x[MASS2 + i] = drops.mass[row + i, 0], drops.mass[row + i, 1]
        x[STIFFNESS1 + i] = drops.first[row + i, 0]
        x[STIFFNESS2 + i] = drops.first[row + i, 1]
        x[GAP + i], x[SPEED + i] = drops.gap[row + i, 1], -drops.velocity[row + i, 0]


@kernel
def _find_constants(x: Floats, count: int) -> None:
    """Compute the initial values of waiting drops and their modes in each regime."""
    for i in range(count):
        m1, m2, k1, k2 = x[MASS1 + i], x[MASS2 + i], x[STIFFNESS1 + i], x[STIFFNESS2 + i]
        gap, speed = x[GAP + i], x[SPEED + i]
        valid = 0.0 < m1 < math.inf and 0.0 < m2 < math.inf and 0.0 <= gap < math.inf
        valid = valid and 0.0 < k1 < math.inf and 0.0 < k2 < math.inf and 0.0 < speed < math.inf
        m1, m2, speed = m1 if valid else 1.0, m2 if valid else 1.0, speed if valid else 1.0
        k1, k2, gap = k1 if valid else 1.0, k2 if valid else 1.0, gap if valid else 0.0
        mu, kappa, omega = m2 / m1, k2 / k1, math.sqrt(k1 / m1)
        distance = gap * omega / speed
        fair = mu > 1.0 / _RATIO and mu < _RATIO and kappa > 1.0 / _RATIO and kappa < _RATIO
        fair = fair and omega > 1.0 / _OMEGA and omega < _OMEGA and distance < _GAP
        mu, kappa = mu if fair else 1.0, kappa if fair else 1.0
        distance, omega = distance if fair else 0.0, omega if fair else 1.0
        x[NEXT + lane.STATUS + i] = (0.0 if fair else ASK) if valid else INVALID
        root = math.sqrt(mu)
        # both: K = ((1 + kappa, corner), (corner, kappa/mu)) (eqs 5 and 6)
        slim = 1.0 / root
        corner, upper = -kappa * slim, kappa * (slim * slim)
        half = 0.5 * (1.0 + kappa - upper)
        spread = math.sqrt(half * half + corner * corner)
        fast = 0.5 * (1.0 + kappa + upper) + spread
        slow = upper / fast
        lean = abs(half) + spread
        unit = 1.0 / math.sqrt(lean * lean + corner * corner)
        c, s = (lean if half >= 0.0 else corner) * unit, (corner if half >= 0.0 else lean) * unit
        x[NEXT + lane.C2 + i], x[NEXT + lane.S2 + i] = c, s
        a, b = math.sqrt(fast), math.sqrt(slow)
        x[NEXT + lane.A2 + i], x[NEXT + lane.B2 + i] = a, b
        x[NEXT + lane.OVER_A2 + i], x[NEXT + lane.OVER_B2 + i] = 1.0 / a, 1.0 / b
        inverse = 1.0 / corner
        # eq 6: the compression of the balls' contact is what moves the upper ball
        x[NEXT + lane.V2 + i], x[NEXT + lane.X2 + i] = fast * s * inverse, slow * c * inverse
        # balls only: K = ((kappa, corner), (corner, kappa/mu))
        unit = 1.0 / math.sqrt(1.0 + mu)
        single = kappa + upper
        x[NEXT + lane.C1 + i], x[NEXT + lane.S1 + i] = root * unit, -unit
        a = math.sqrt(single)
        x[NEXT + lane.A1 + i], x[NEXT + lane.OVER_A1 + i] = a, 1.0 / a
        x[NEXT + lane.V1 + i] = -single * unit * inverse
        x[NEXT + lane.SLIM + i] = slim
        x[NEXT + lane.W1 + i], x[NEXT + lane.U1 + i] = distance * root, -root
        x[NEXT + lane.BALLS + i] = 1.0 if distance == 0.0 else 0.0
        x[NEXT + lane.UNIT + i], x[NEXT + lane.V0 + i] = 1.0 / omega, speed


@kernel
def _write_outcome(drops: Drops, out: Outcomes, x: Floats, i: int, r: int) -> None:
    """Write the outcome of the drop in lane i to row r; unknown numbers are nan."""
    code = int(x[lane.STATUS + i])
    known = code in (FINISHED, EVENT_LIMIT)
    v0, unit = x[lane.V0 + i] if known else math.nan, x[lane.UNIT + i] if known else math.nan
    last0, last1 = x[lane.LAST0 + i], x[lane.LAST1 + i]
    out.status[r] = code
    out.rebound_ratio[r, 0] = v0 * x[lane.U0 + i]
    out.rebound_ratio[r, 1] = v0 * (x[lane.U1 + i] * x[lane.SLIM + i])
    out.collisions[r, 0], out.collisions[r, 1] = int(x[lane.N0 + i]), int(x[lane.N1 + i])
    out.first_touch[r, 0] = unit * 0.0
    out.first_touch[r, 1] = unit * (x[lane.FIRST + i] if x[lane.N1 + i] > 0.0 else math.nan)
    out.last_release[r, 0] = unit * (last0 if last0 > 0.0 else math.nan)
    out.last_release[r, 1] = unit * (last1 if last1 > 0.0 else math.nan)
    find_ratios(drops, out, r)
