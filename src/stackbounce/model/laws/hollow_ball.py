"""A hollow ball, which is stiff until its wall buckles, and softer then.

In units of the mass m, the speed v and ``1/ω = sqrt(m/k)`` the compression is ``sin(t)`` up to the
time t_b of buckling. With the share φ of the peak force F_p at which it buckles, the stiffness
ratio is ``r = tan(t_b)**2 (1/φ**2 - 1)``: the energy left, ``cos(t_b)**2/2``, is the integral of
the force from ``F_b = sin(t_b) = φ F_p`` to ``F_p``, ``(F_p**2 - F_b**2)/(2 r)``.
"""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, fraction, positive
from stackbounce.model.collision.roots import root
from stackbounce.model.laws.law import (
    RESTITUTION,
    ContactLaw,
    EngineNumbers,
    Flank,
    Given,
    Quantity,
    number_in,
    stiffness_in,
)
from stackbounce.model.laws.registry import register

_BUCKLING_TIME = 0.04  # of the contact time
_BUCKLING_SHARE = 0.5  # of the peak force
_SOFTEST = 6.0  # exponent of a release


@register
class HollowBall(ContactLaw):
    """A hollow ball: stiff until its wall buckles, softer then, with hysteresis.

    Loading follows ``F = k c`` up to the compression c_b at which the wall buckles, then
    ``F = k (c_b + r (c - c_b))``. From the peak compression C on the ball unloads along its loading
    curve times ``1 - g + g (c/C)**m`` with ``m = 2/e**2 - 2``, where g is such that the fraction
    e**2 of the work of loading is returned, at any speed; g is 1 below c_b. Compressed again before
    it has opened, the contact follows the rule of `Hysteretic`. For r = 1 it is a `Hysteretic`
    contact with a linear loading curve.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0, before the wall buckles.
    buckling_compression : float
        c_b, in m, above 0.
    stiffness_ratio : float
        r, above 0 and at most 1: the stiffness after buckling over that before.
    restitution : float
        e, from 1e-5 to 1: a contact that returns less is `Rigid`, with the restitution 0.

    Raises
    ------
    InvalidValue
        If a number is out of its range.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section III, on the force of a basketball: a
    hollow ball is very stiff for the short time that its bottom takes to buckle, and then soft. The
    straight pieces and the unloading curve are this package's own.

    Examples
    --------
    >>> ball = HollowBall(4e4, 1e-3, stiffness_ratio=0.3, restitution=0.75)
    >>> ball.described()
    'HollowBall, stiffness 40000 N/m, buckling compression 0.001 m, stiffness ratio 0.3, \
restitution 0.75'
    """

    formula = (
        "F = stiffness c up to buckling_compression b, then stiffness (b + stiffness_ratio (c - b))"
        "; from the peak C on times 1 - g + g (c/C)**m, so that restitution**2 of the work is "
        "returned"
    )
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), section III"
    form = codes.TWO_STAGE
    page_code: ClassVar = {
        "numbers": """({ stiffness, restitution, buckling_compression, stiffness_ratio }) =>
          [stiffness, restitution ** 2, buckling_compression, stiffness_ratio]""",
        "others": f"""({{ mass, contact_time, impact_speed }}, {{ stiffness }}) => {{
          const rate = Math.sqrt(stiffness / mass);
          const share = {_BUCKLING_SHARE};
          const start = Math.min({_BUCKLING_TIME} * contact_time * rate, Math.asin(share));
          return {{
            buckling_compression: (impact_speed * Math.sin(start)) / rate,
            stiffness_ratio: Math.min(1, Math.tan(start) ** 2 * (1 / share ** 2 - 1)),
          }};
        }}""",
    }
    rate_free = True
    loss = "restitution"
    least_restitution = 0.0873  # at which it buckles after 4 % of the contact time at the softest
    usual_flanks = Flank(1.0, 1.0), Flank(1.0, _SOFTEST)

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
    buckling_compression: Annotated[float, number_in("m", positive, (2e-3, 1e-5, 0.1))]
    stiffness_ratio: Annotated[
        float, Quantity("", lambda n, v: fraction(n, v, zero=False), (0.3, 0.01, 1.0))
    ]
    restitution: Annotated[float, RESTITUTION]

    def engine_numbers(self, varied: Mapping[str, Any] = {}) -> EngineNumbers:
        """Return the law's numbers: k, the share e**2 of energy returned, c_b and r."""
        k, knee, ratio, e = self.values(varied)
        return self.form, k, e * e, knee, ratio

    @classmethod
    def _needs_speed(cls, exponent: float) -> bool:
        return True  # a faster ball buckles further

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured restitution and contact time.

        It buckles at the ``buckling_time`` and at the ``buckling_share`` of the peak force; by
        default after 4 % of the contact time, at half the peak force.
        """
        kept, lasts = given["restitution"], given["contact_time"]
        share = given.get("buckling_share", _BUCKLING_SHARE)
        part = given.get("buckling_time", _BUCKLING_TIME * lasts) / lasts
        latest = math.asin(share)
        if part >= _latest_part(share, kept):
            raise InvalidValue(_out_of_reach(part, share, kept))
        start = root(
            lambda start: start - part * _unit_law(start, share, kept).contact_time_at(1.0, 1.0),
            0.1 * min(part, latest),
            latest,
        )
        rate = start / (part * lasts)  # ω
        unit = _unit_law(start, share, kept)
        knee = unit.buckling_compression * given["impact_speed"] / rate
        return cls(given["mass"] * rate * rate, knee, unit.stiffness_ratio, kept)

    def series_constants(self) -> dict[str, Any]:
        """Return what two laws in series must have in common: all but the stiffness."""
        return {
            "buckling force": self.stiffness * self.buckling_compression,
            "stiffness_ratio": self.stiffness_ratio,
            "restitution": self.restitution,
        }

    def series_changes(self, stiffness: float, share: float) -> dict[str, float]:
        """Return the stiffness of both in series, and the compression at which both buckle."""
        knee = self.buckling_compression * (self.stiffness / stiffness)
        return {"stiffness": stiffness, "buckling_compression": knee}


def _latest_part(share: float, restitution: float) -> float:
    """Return the largest buckling time over the contact time: that with the stiffness ratio 1."""
    latest = math.asin(share)
    return latest / _unit_law(latest, share, restitution).contact_time_at(1.0, 1.0)


def _out_of_reach(part: float, share: float, restitution: float) -> str:
    """Return the message that a ball of this restitution does not buckle so late."""
    text = (
        f"buckling_time must be below {_latest_part(share, restitution):.3g} times contact_time "
        f"for a buckling_share of {share:g} and a restitution of {restitution:g}, "
        f"got {part:.3g} times"
    )
    if part >= _latest_part(share, 1.0):
        return text
    least = root(
        lambda e: _latest_part(share, min(max(e, restitution), 1.0)) - part, restitution, 1.0
    )
    return f"{text}, for which restitution must be at least {1.005 * least:.3g}"


def _unit_law(start: float, share: float, restitution: float) -> HollowBall:
    """Return the law with k = 1 that buckles at the time t_b, for a mass and a speed of 1."""
    ratio = min(1.0, math.tan(start) ** 2 * (1.0 / share**2 - 1.0))
    return HollowBall(1.0, math.sin(start), ratio, restitution)
