"""One ball on the viscoelastic law: everything follows from one number, and that from a run.

In units of ``L = (m v**2/k)**(2/5)`` and L/v the motion is ``x'' = -(x**1.5 + v*² sqrt(x) x')``
with ``v*² = 1.5 A (k/m)**(2/5) v**(1/5)``.

Source: P. Müller and T. Pöschel, Phys. Rev. E 84, 021302 (2011), whose contact ends, too, when the
force is back at zero.
"""

import functools
import math

from stackbounce.calibration import elastic
from stackbounce.calibration.roots import root
from stackbounce.errors import InvalidValue
from stackbounce.model import Ball, Drop, Viscoelastic
from stackbounce.run.driver import simulate
from stackbounce.run.result import Status

__all__ = ["duration", "restitution", "squared_speed"]

_WEAK = 1e-5
"""Up to this v*² the loss is its power series, of which a run's round-off would leave little."""

_LOSS = 0.8 * 1.25**0.6 * math.gamma(0.6) * math.gamma(1.5) / math.gamma(2.1)
"""What the motion without loss, x'² = 1 - 0.8 x**2.5, dissipates per v*²: the integral of
sqrt(x) x' over x, in and out; 1 - e = u - 0.6 u² + ..., u being this times v*²."""


@functools.lru_cache(maxsize=256)
def _collision(squared: float) -> tuple[float, float]:
    """Return e, and the contact time in units of L/v, at v*²."""
    law = Viscoelastic(1.0, dissipative_time=squared / 1.5)
    result = simulate(Drop([Ball(1.0)], [law], impact_speed=1.0))
    if result.status is not Status.FINISHED:
        raise InvalidValue(
            f"dissipative_time must be such that one collision can be followed, got "
            f"v*² = 1.5 A (k/m)**0.4 v**0.2 = {squared:g}: {result.status.advice}"
        )
    return float(result.rebound_ratios[0]), float(result.last_release[0])


def restitution(squared: float) -> float:
    """Return e at v*², 0 or above.

    Examples
    --------
    >>> [round(restitution(v * v), 6) for v in (0.0, 0.3, 0.5)]
    [1.0, 0.902852, 0.760037]
    """
    if squared <= _WEAK:
        loss = _LOSS * squared
        return float(1.0 - loss * (1.0 - 0.6 * loss))
    return _collision(squared)[0]


def duration(squared: float) -> float:
    """Return the contact time in units of C/v, see `elastic`, at v*², 0 or above.

    Examples
    --------
    >>> round(duration(0.0), 6)
    2.943275
    """
    if squared == 0.0:
        return elastic.duration(1.5)
    return _collision(squared)[1] / elastic.peak_compression(1.0, 1.5, 1.0, 1.0)


def squared_speed(restitution: float) -> float:
    """Return v*² at which e is `restitution`, from above 0 to 1.

    Examples
    --------
    >>> round(squared_speed(0.760037), 5)
    0.25
    """
    loss = 1.0 - restitution
    if loss <= _WEAK:
        return float(2.0 * loss / (1.0 + math.sqrt(1.0 - 2.4 * loss)) / _LOSS)
    # 1 - e is below 1.154 v*², its limit for small v*, and e below 1.311 v***(-10/3), for large
    low, high = (1.0 - restitution) / 1.154, (1.311 / restitution) ** 0.6
    return root(lambda squared: _collision(squared)[0] - restitution, low, high)
