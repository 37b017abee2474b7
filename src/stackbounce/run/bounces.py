"""One ball that bounces on and on in air: impacts by the engine, flights in closed form."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, instance, whole
from stackbounce.model import Air, ContactLaw, Drop
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.run.driver import simulate
from stackbounce.run.result import STOPPED

_FIELDS = ("time", "impact_speed", "rebound_speed", "contact_time", "apex_time", "height")
BOUNCE = np.dtype([(name, "f8") for name in _FIELDS])
_MOST = 1_000_000


def bounces_in_air(drop: Drop, count: int, air: Air | None = None) -> NDArray[Any]:
    """Return the successive bounces of one ball on the floor, with drag in its flights.

    Parameters
    ----------
    drop : Drop
        One ball with a diameter, and the contact with the floor. A height is that of a fall in air.
        Flights have its gravity, or 9.80665 m/s**2 if that is 0.
    count : int
        How many bounces, from 1 to a million.
    air : Air, optional
        By default ``Air()``.

    Returns
    -------
    ndarray
        A row per bounce: `time` of the touch in s from the first one, `impact_speed` and
        `rebound_speed` in m/s, `contact_time` in s, and `apex_time` in s and `height` in m of the
        highest point after it. There are fewer rows where a ball stays on the floor: its last
        bounce has a height of 0.

    Raises
    ------
    InvalidType
        If something has the wrong type.
    InvalidValue
        If a number is out of its range, there is not one ball on a floor that lets go, it has no
        diameter or no drag coefficient, or it moves up at first.

    Notes
    -----
    Drag is left out during a contact. Gravity is left out there if that of the drop is 0. With the
    gravity of the drop the bounces without air are those of `simulate` until rest, to round-off,
    but for a `StandardLinearSolid` that recovers slowly: here each impact finds the floor at rest.
    Without, on a spring a ball bounces as high, and the contact is shorter by
    ``2 atan(g/(w v))/w`` with ``w = sqrt(k/m)``; on a contact with a loss it loses a little less.

    A law with a scatter draws by its seed and the number of the bounce: other draws than those of
    `simulate`, from the same distribution.

    Examples
    --------
    A table tennis ball from 1 m: how high it rises in air, and without.

    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0027, 0.040)], [sb.Rigid(0.9)], height=1.0)
    >>> sb.bounces_in_air(drop, 4)["height"].round(3)
    array([0.645, 0.448, 0.326, 0.244])
    >>> sb.bounces_in_air(drop, 4, sb.Air(density=0.0))["height"].round(3)
    array([0.81 , 0.656, 0.531, 0.43 ])
    """
    air = Air() if air is None else air
    law, speed = _start(drop, air)
    count = whole("count", count, 1, _MOST)
    ball, gravity = drop.balls[0], drop.gravity or STANDARD_GRAVITY
    time, rows = 0.0, []
    for number in range(count):
        contact = drop.replace(contacts=[law.of_collision(number)], impact_speed=speed)
        rebound, lasting, depth = _impact(contact)
        row, released = (time, speed, rebound, lasting), time + lasting
        # what is released while it is still flattened rises to its shape first
        square = rebound**2 - 2.0 * gravity * depth
        if square <= 0.0:
            rows.append((*row, released, 0.0))
            break
        leaving = math.sqrt(square)
        flight = air.flight(ball, leaving, gravity)
        top = released + (rebound - leaving) / gravity + flight.rise_time
        rows.append((*row, top, flight.height))
        time, speed = top + flight.fall_time, flight.landing_speed
    return np.array(rows, dtype=BOUNCE)


def _start(drop: object, air: object) -> tuple[ContactLaw, float]:
    """Return the floor's law and the first impact speed of a drop that is checked here."""
    drop, air = instance("drop", drop, Drop), instance("air", air, Air)
    if len(drop.balls) != 1:
        raise InvalidValue(f"drop must be of one ball, got {len(drop.balls)}")
    law = drop.contacts[0]
    if law is None or law.pulls:
        got = "none" if law is None else f"a {type(law).__name__}"
        raise InvalidValue(f"contacts.0 must be a floor that lets go, got {got}")
    fallen = drop if drop.height is None else air.dropped(drop)
    speed = -fallen.start_velocities[0]
    if speed <= 0.0:
        raise InvalidValue(f"velocities.0 must be downward, below 0, got {-speed!r}")
    return law, speed


def _impact(drop: Drop) -> tuple[float, float, float]:
    """Return speed after an impact in m/s, its duration in s, and how deep in m it is released."""
    result = simulate(drop)
    speed = float(result.rebound_speeds[0])
    if result.status in STOPPED:
        raise InvalidValue(
            f"drop must have impacts that can be computed, got {result.status.name} at "
            f"{drop.impact_speed!r} m/s: {result.advice}"
        )
    end = float(result.intervals["end"][-1])
    if not math.isfinite(end):
        return 0.0, end, 0.0
    depth = -float(result.rerun([end]).samples.position[0]) if end > 0.0 else 0.0
    return speed, end, max(depth, 0.0)
