"""A bond: what joins two parts of one body, or a body to the floor."""

import math
from dataclasses import dataclass
from typing import Annotated, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, non_negative
from stackbounce.model.laws.dashpot import DampedSpring
from stackbounce.model.laws.law import Given, number_in, stiffness_in
from stackbounce.model.laws.registry import register


@register
@dataclass(frozen=True)  # which shows a damping of 0, too
class Bond(DampedSpring):
    """A spring and a dashpot that push and pull, and never open: two parts of one body.

    ``F = k c + b ċ``, for compression and extension alike. Two balls with a bond between them are
    one ball with an inner mode of vibration. A lowest ball with a bond below it is a floor of
    finite mass on a spring: a table, or a force plate; with gravity it carries its own weight from
    the start. There is no gap at a bond. `stackbounce.calibrate` gives the bond that vibrates with
    a measured frequency and decay.

    The rebound speed of a ball with bonds is that of the centre of its body, and 0 for a body that
    is bonded to the floor, wherever the run ends: the vibration is no motion of the body.
    `Result.sample` has the velocities of the parts. A run without `until` ends once the bodies can
    no longer meet, however they vibrate. A bond has no contact intervals.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0.
    damping : float, optional
        b, in N s/m, 0 or above; default 0.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `damping` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section II, which considers a rapid vibration of
    the basketball's upper surface; the linear bond is the simplest body that has one.

    Examples
    --------
    A ball of two halves loses speed to its vibration, though no energy is lost.

    >>> from stackbounce.model import Ball, Drop, Spring
    >>> from stackbounce.run.driver import simulate
    >>> halves = [Ball(0.05), Ball(0.05)]
    >>> drop = Drop(halves, [Spring(2e4), Bond(2e4)], impact_speed=1.0)
    >>> [round(ratio, 4) for ratio in simulate(drop).rebound_ratios.tolist()]
    [0.9738, 0.9738]
    """

    formula = "F = stiffness c + damping c'"
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), section II"
    form = codes.BOND
    listed = False
    pulls = True
    needs = ("mass", "frequency")

    stiffness: Annotated[float, stiffness_in("N/m")]
    damping: Annotated[float, number_in("N s/m", non_negative, (0.0, 0.0, 1e3))] = 0.0

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the bond of a vibration ``exp(-t/T) cos(2 π f t)`` of a (reduced) mass m.

        It is the solution of ``m c'' + b c' + k c = 0`` with ``k = m (4 π² f² + 1/T²)`` and
        ``b = 2 m/T``.
        """
        rate = 2.0 * math.pi * given["frequency"]
        decay = 1.0 / given["decay_time"] if "decay_time" in given else 0.0
        return cls(given["mass"] * (rate * rate + decay * decay), 2.0 * given["mass"] * decay)

    def restitution_at(self, mass: float, speed: float) -> float:
        """Raise an error: a bond has no collision."""
        raise InvalidValue("law must be that of a collision, got Bond, which never opens")

    contact_time_at = restitution_at
