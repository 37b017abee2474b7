"""Flights and apex heights of a recording with too few bounces for a restitution."""

from dataclasses import dataclass

from stackbounce.errors import positive
from stackbounce.measure.drag import Drag
from stackbounce.measure.finding import Finding
from stackbounce.measure.kinds.bounces.knocks import Knocks
from stackbounce.measure.quantities import Number, Row
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.units import checked


@dataclass(frozen=True, repr=False)
class FewBounces(Finding):
    """Flights without a neighbouring flight, which give no restitution.

    Attributes
    ----------
    flights : tuple of (ufloat or None)
        Time in the air after each bounce but the last, in s; None where a bounce is missing.
    apex_heights : tuple of (ufloat or None)
        How high the ball rose in them, in m.
    notes : tuple of str
        What was not found, and what is needed to find it.
    drag : Drag or None
        Of the air, where it was taken into account.
    """

    flights: tuple[Number | None, ...]
    apex_heights: tuple[Number | None, ...]
    notes: tuple[str, ...]
    drag: Drag | None = None

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        rows = []
        for k, (flight, height) in enumerate(zip(self.flights, self.apex_heights, strict=True)):
            if flight is not None and height is not None:
                rows.append(Row(f"flight after bounce {k}", flight, "s"))
                rows.append(Row(f"apex height after bounce {k}", height, "m"))
        return [*rows, *(self.drag.rows() if self.drag else ())]


def few_bounces(
    heard: Knocks, *, gravity: float = STANDARD_GRAVITY, drag: Drag | None = None
) -> FewBounces:
    """Return the flights of knocks among which no two neighbouring flights are known.

    A flight of time T rises to ``g T**2/8``, and a little lower with drag.

    Parameters
    ----------
    heard : Knocks
        One knock, two, or more with bounces missing between them.
    gravity : float, optional
        In m/s**2, above 0.
    drag : Drag, optional
        Of the air on the ball; by default there is none.

    Returns
    -------
    FewBounces

    Raises
    ------
    InvalidValue
        If gravity is not above 0.

    Examples
    --------
    >>> import numpy as np
    >>> from stackbounce.measure.kinds.sound.analysis import knocks
    >>> rate = 44_100
    >>> sound = np.random.default_rng(1).normal(0.0, 1e-3, rate)
    >>> for begin in (0.2, 0.7):  # s
    ...     since = np.arange(2000) / rate
    ...     part = slice(int(begin * rate), int(begin * rate) + 2000)
    ...     sound[part] += 0.5 * np.exp(-since / 5e-3) * np.sin(6000.0 * since)
    >>> found = few_bounces(knocks(sound, rate=rate))
    >>> f"{found.apex_heights[0].nominal_value:.3f} m"
    '0.306 m'
    >>> print(found.notes[0])
    No restitution was found: it needs 3 bounces in a row, or 2 and the drop height; 2 were heard.
    """
    gravity = checked(positive, "gravity", gravity, "m/s^2")
    pairs = zip(heard.times[:-1], heard.times[1:], heard.missed, strict=True)
    flights = tuple(None if lost else later - first for first, later, lost in pairs)
    heights = tuple(None if flight is None else _apex(flight, gravity, drag) for flight in flights)
    count = len(heard.times)
    between = ", with others missing between them" if any(heard.missed) else ""
    note = (
        "No restitution was found: it needs 3 bounces in a row, or 2 and the drop height; "
        f"{count} {'was' if count == 1 else 'were'} heard{between}."
    )
    return FewBounces(flights, heights, (note,), drag)


def _apex(flight: Number, gravity: float, drag: Drag | None) -> Number:
    """Return how high a ball rose in a flight of some time."""
    if drag is None:
        return gravity * flight**2 / 8.0
    return drag.risen(drag.flight_speeds(flight, gravity)[0], gravity)
