"""Two rigid balls that fall together on a floor, without gravity: many drops, fast.

The contacts collide in turns, since a contact that has just collided opens. The arithmetic is that
of `rigid` and `flight`, so that the results have the same bits. A drop that might collapse (see
`collapse`), or near the limits of floating-point numbers, is left to the general engine, with the
status ASK.
"""

import math

from stackbounce.engine.codes import ASK, FINISHED
from stackbounce.engine.flight import is_late, rate_after
from stackbounce.engine.kernels import kernel
from stackbounce.engine.ratios import find_ratios
from stackbounce.engine.records import Drops, Outcomes, Workspace

_LARGE = 1e50  # largest ratio of masses, speed in m/s, and gap in m
_SMALL = 1e-50  # smallest ratio of masses, speed in m/s, and closing rate over that
_ROUND_OFF = 1e-12  # relative, in the criterion of a collapse


@kernel
def run_two_rigid(drops: Drops, event_limit: int, out: Outcomes, space: Workspace) -> None:  # noqa: ARG001 - no scratch is needed
    """Compute the outcomes of many drops of two rigid balls on a floor, without gravity.

    Parameters
    ----------
    drops : Drops
        The parameters of n drops, of the form RIGID. Both balls come with the lower one's velocity.
    event_limit : int
        The number of collisions after which the general engine must solve a drop.
    out : Outcomes
        Gets the ratios, numbers of collisions, and times. The status is FINISHED, or
        ASK where the general engine must solve the drop; its other results are then meaningless.
    space : Workspace
        Not used: all engines in lanes take the same arguments.
    """
    for row in range(len(out.status)):
        lower, upper, gap = drops.mass[row, 0], drops.mass[row, 1], drops.gap[row, 1]
        e0, e1, speed = drops.third[row, 0], drops.third[row, 1], -drops.velocity[row, 0]
        lower_share, upper_share = 1.0 / (1.0 + lower / upper), 1.0 / (1.0 + upper / lower)
        # a b < (sqrt(e1) + sqrt(e2))^2: there is no collapse
        product = (1.0 + e0) * (1.0 + e1) * lower_share
        far = product * (1.0 + _ROUND_OFF) < e0 + e1 + 2.0 * math.sqrt(e0 * e1)
        fair = _SMALL < upper / lower < _LARGE and _SMALL < speed < _LARGE and gap < _LARGE
        out.status[row] = ASK
        if not (fair and (far or e0 * e1 == 1.0)):
            continue
        velocity0, velocity1, rate0, rate1 = -speed, -speed, speed, 0.0
        noise0, noise1, compression0, compression1 = 0.0, 0.0, 0.0, -gap
        count0, count1, first1, last0, last1 = 0, 0, math.nan, 0.0, math.nan
        now, time = 0.0, 0.0  # local time, see `flight`
        while count0 + count1 < event_limit:
            # the floor's contact
            count0, last0 = count0 + 1, time
            change = (1.0 + e0) * rate0
            velocity0 = e0 * rate0
            rate0, noise0, compression0 = -e0 * rate0, noise0 * e0, 0.0
            rate1, noise1 = rate_after(rate1, change, velocity0, velocity1)
            if not rate1 > noise1:
                out.status[row] = FINISHED
                break
            before, wait = _wait(now, -compression1 / rate1)
            now, time = before + wait, time + wait
            compression0 += rate0 * (now - before)
            # that of the balls
            count1, last1 = count1 + 1, time
            first1 = time if count1 == 1 else first1
            up, down = (1.0 + e1) * rate1 * upper_share, (1.0 + e1) * rate1 * lower_share
            if upper >= lower:
                velocity1 += up
                velocity0 = velocity1 - e1 * rate1
            else:
                velocity0 -= down
                velocity1 = velocity0 + e1 * rate1
            rate1, noise1, compression1 = -e1 * rate1, noise1 * e1, 0.0
            rate0, noise0 = rate_after(rate0, down, 0.0, velocity0)
            if not rate0 > noise0:
                out.status[row] = FINISHED
                break
            before, wait = _wait(now, -compression0 / rate0)
            now, time = before + wait, time + wait
            compression1 += rate1 * (now - before)
            if rate0 < _SMALL * speed:
                break
        out.rebound_ratio[row, 0], out.rebound_ratio[row, 1] = velocity0, velocity1
        out.collisions[row, 0], out.collisions[row, 1] = count0, count1
        out.first_touch[row, 0], out.first_touch[row, 1] = 0.0, first1
        out.last_release[row, 0], out.last_release[row, 1] = last0, last1
        find_ratios(drops, out, row)


@kernel
def _wait(now: float, wait: float) -> tuple[float, float]:
    """Return the local time, with a new origin where that is needed, and the wait rounded in it."""
    start = 0.0 if is_late(now, wait) else now
    return start, start + max(0.0, wait) - start
