"""Rebound ratios and the retained energy, from the velocities before and after."""

import math

from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.records import Drops, Outcomes


@kernel
def find_ratios(drops: Drops, out: Outcomes, row: int) -> None:
    """Compute the rebound ratios and the retained energy of a drop.

    An engine has written the balls' velocities after the impact to ``out.rebound_ratio``; here they
    are divided by the impact speed.
    """
    before, after = drops.velocity[row], out.rebound_ratio[row]
    out.energy_retained[row] = energy_kept(drops.mass[row], before, after)
    speed = largest_speed(before)
    for b in range(len(after)):
        after[b] /= speed


@kernel
def energy_kept(mass: Floats, before: Floats, after: Floats) -> float:
    """Return the ratio of the kinetic energies after and before the impact; nan if it was 0."""
    heaviest, speed = 0.0, largest_speed(before)
    for m in mass:
        heaviest = max(heaviest, m)
    came, left = 0.0, 0.0
    for b in range(len(mass)):
        share, start, end = mass[b] / heaviest, before[b] / speed, after[b] / speed
        came += share * (start * start)
        left += share * (end * end)
    return left / came if came > 0.0 else math.nan


@kernel
def largest_speed(velocity: Floats) -> float:
    """Return the largest absolute velocity: the impact speed v0, the unit of rebound ratios."""
    speed = 0.0
    for v in velocity:
        speed = max(speed, abs(v))
    return speed
