"""Times and speeds of the successive bounces of one ball, by its law's restitution."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stackbounce.model import ContactLaw, Rigid
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.collision import contact_time, restitution

_LEAST_FLIGHT = 1e-3  # s; shorter ones are no flights of a measured ball


@dataclass(frozen=True)
class Falls:
    """The bounces of one ball: when each begins and ends, its impact speed and restitution (N,).

    t = 0 is the release from the height; all numbers are in SI units.
    """

    height: float
    gravity: float
    touches: NDArray[np.float64]
    releases: NDArray[np.float64]
    speeds: NDArray[np.float64]
    restitutions: NDArray[np.float64]

    def position(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the height in m of the ball's lowest point; it is held before its release."""
        held = np.maximum(times, 0.0)
        heights = self.height - 0.5 * self.gravity * held**2
        for k, (release, speed) in enumerate(zip(self.releases, self.rebounds, strict=True)):
            since = times - release
            flown = np.maximum(speed * since - 0.5 * self.gravity * since**2, 0.0)
            heights = np.where(times >= self.touches[k], np.where(since > 0, flown, 0.0), heights)
        return heights

    @property
    def rebounds(self) -> NDArray[np.float64]:
        """The speed after each bounce, (N,), in m/s."""
        return self.speeds * self.restitutions


def falls(
    height: float,
    law: float | ContactLaw | Callable[[float], float],
    *,
    mass: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    bounces: int = 12,
) -> Falls:
    """Return the bounces of a ball that is released from rest.

    The law is a restitution, that of the floor's contact, or a function from the impact speed to
    the restitution; the mass is for laws whose restitution depends on it. The ball stops where its
    flights become shorter than 1 ms.

    Examples
    --------
    >>> falls(1.0, lambda speed: 0.8 - 0.02 * speed, bounces=3).restitutions.round(4)
    array([0.7114, 0.737 , 0.7536])
    """
    if not (callable(law) or isinstance(law, ContactLaw)):
        law = Rigid(law)
    speed, time = math.sqrt(2.0 * gravity * height), math.sqrt(2.0 * height / gravity)
    rows = []
    for _ in range(bounces):
        kept, contact = _bounce(law, mass, speed)
        rows.append((time, time + contact, speed, kept))
        flight = 2.0 * kept * speed / gravity
        if flight < _LEAST_FLIGHT:
            break
        time, speed = time + contact + flight, kept * speed
    return Falls(height, gravity, *np.array(rows).T)


def _bounce(law, mass, speed):
    """Return restitution and contact time of a bounce at a speed."""
    if isinstance(law, ContactLaw):
        time = 0.0 if mass is None else contact_time(law, mass, speed)
        return restitution(law, mass, speed), time
    return law(speed), 0.0
