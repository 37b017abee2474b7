"""One ball on the viscoelastic law: everything follows from one number, and that from a run.

In units of ``L = (m v**2/k)**(2/5)`` and L/v the motion is ``x'' = -(x**1.5 + v*² sqrt(x) x')``
with ``v*² = 1.5 A (k/m)**(2/5) v**(1/5)``.

Source: P. Müller and T. Pöschel, Phys. Rev. E 84, 021302 (2011), whose contact ends, too, when the
force is back at zero.
"""

import functools

from stackbounce.calibrate import elastic
from stackbounce.calibrate.roots import root
from stackbounce.errors import InvalidValue
from stackbounce.model import Ball, Drop, Viscoelastic
from stackbounce.result import Status
from stackbounce.simulate import simulate

__all__ = ["duration", "restitution", "squared_speed"]


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
    return _collision(squared)[0] if squared > 0.0 else 1.0


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
    if restitution == 1.0:
        return 0.0
    # 1 - e is below 1.154 v*², its limit for small v*, and e below 1.311 v***(-10/3), for large
    low, high = (1.0 - restitution) / 1.154, (1.311 / restitution) ** 0.6
    return root(lambda squared: _collision(squared)[0] - restitution, low, high)
