"""Times of successive bounces -> restitution of each, and how it falls with speed."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, all_real, non_negative, positive, shown
from stackbounce.measure.drag import Drag, drag_given, speed_after_fall, with_error_of_drag
from stackbounce.measure.kinds.bounces.knocks import Knocks, missed_between
from stackbounce.measure.kinds.bounces.restitution_law import fit_line, laws_of
from stackbounce.measure.kinds.bounces.result import Bounces
from stackbounce.measure.kinds.bounces.scatter import meaning_of, scatter_of
from stackbounce.measure.quantities import Number, known_to, nominal
from stackbounce.measure.samples import columns
from stackbounce.measure.setup import Setup, told
from stackbounce.measure.statistics.regression import widening
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.units import checked, magnitude

_MOST_BOUNCES = 200  # of one drop
_ROUNDING = 5e-3  # of an interval: rounding makes equal ones differ by less, and a ball loses more
_INSTANT = 1e-6  # s: no ball bounces twice in so short a time


def analyse(data: Any, setup: Setup) -> Bounces:
    """Return the restitutions that times of bounces tell."""
    return bounces(data, **setup.only("drop_height", "gravity", "contact_time", "drag"))


def bounces(
    times: Any,
    *,
    drop_height: float | Number | None = None,
    gravity: float = STANDARD_GRAVITY,
    time_error: float | None = None,
    contact_time: float | Number | None = None,
    drag: Drag | None = None,
) -> Bounces:
    """Return the restitution of each bounce from the times of bounces.

    A flight of time T ends at the speed with which it began, ``g T/2``, so that the restitution of
    a bounce is the ratio of the flight after it to the one before it. With drag a flight ends at a
    lower speed than it began with, and both follow from its time.

    Parameters
    ----------
    times : Knocks or Dataset or sequence
        What `knocks` found, a Dataset with `knock_time` (phyphox), or at least three times in s,
        ascending; with errors where they are `ufloat`. Two are enough with a drop height.
    drop_height : float or ufloat, optional
        In m, of the ball's lowest point, above 0; with it the first bounce has a restitution too.
    gravity : float, optional
        In m/s**2, above 0.
    time_error : float, optional
        The error in s of each time, where they have none. Without any the errors follow the scatter
        of the restitutions about a straight line.
    contact_time : float or ufloat, optional
        Of one bounce in s, subtracted from each interval to get the flight; the time of a bounce is
        the beginning of its contact.
    drag : Drag, optional
        Of the air on the ball; by default there is none.

    Returns
    -------
    Bounces

    Raises
    ------
    InvalidValue
        If there are too few times, they do not ascend, or a number is out of its range.
    InvalidType
        If `times` holds no numbers.

    Notes
    -----
    Restitutions that alternate by more than the errors of the times tell of the
    timing, others of the floor or spin: see `scatter.scatter_of`. The slope is fitted by
    generalised least squares with correlated errors; error bars that were estimated from few
    bounces are widened by Student's t. An error of the drag changes all restitutions together. The
    fits therefore suppose that the drag is known, and its error is propagated through all of them.

    Examples
    --------
    >>> found = bounces([0.0, 0.8, 1.44, 1.952], time_error=1e-3)
    >>> [f"{kept:.1uS}" for kept in found.restitutions]
    ['0.800(3)', '0.800(3)']
    >>> f"{found.drop_height:.2f}", found.inferred
    ('1.23+/-0.01', True)
    """
    times = magnitude(times, "s", "times")
    gravity = checked(positive, "gravity", gravity, "m/s^2")
    contact_time = told("contact_time", contact_time or 0.0, "seconds", non_negative)
    if drop_height is not None:
        drop_height = told("drop_height", drop_height)
    drag = drag_given(drag)
    if isinstance(times, Knocks) and times.against:
        raise InvalidValue(f"times must be those of a bouncing ball, got {times.against}")
    notes: list[str] = []
    moments, missed = _moments(times, time_error, 3 if drop_height is None else 2, notes)
    if len(moments) > _MOST_BOUNCES:
        raise InvalidValue(
            f"times must be those of one drop's bounces, at most {_MOST_BOUNCES}, "
            f"got {len(moments)}"
        )

    def found_with(drag: Drag | None) -> Bounces:
        return _analysed(moments, _Fall(missed, drop_height, gravity, contact_time, drag))

    found = found_with(None if drag is None else drag.exact())
    if drag is not None:
        found = replace(
            with_error_of_drag(found, found_with, drag),
            drag=drag,
            notes=(drag.note(found_with(None).mean), *found.notes),
        )
    return replace(found, notes=(*notes, *found.notes))


class _Fall(NamedTuple):
    """What is known of the flights: bounces missing after each, and numbers that all share."""

    missed: Sequence[int]
    height: Any
    gravity: float
    contact_time: Number | float
    drag: Drag | None


class _Found(NamedTuple):
    """Times of bounces and the flights between; of bounces: numbers, speeds, restitutions."""

    moments: Sequence[Any]
    flights: Sequence[Any]
    numbers: Sequence[int]
    speeds: Sequence[Any]
    kept: Sequence[Any]


def _analysed(moments: Sequence[Any], fall: _Fall) -> Bounces:
    """Return what follows from times, with a drag that is known exactly."""
    from uncertainties import UFloat

    notes: list[str] = []

    def found_at(moments: Sequence[Any]) -> _Found:
        flights = _flights(moments, fall.missed, fall.contact_time)
        return _Found(moments, flights, *_restitutions(flights, fall))

    found = found_at(moments)
    if not found.kept:
        raise InvalidValue(
            "times must hold two neighbouring flights, got none without a missing bounce between"
        )
    known = isinstance(moments[0], UFloat)
    if not known:
        found = _with_errors_from_scatter(moments, found_at, notes)
    if any(kept.nominal_value > 1.0 + 2.0 * kept.std_dev for kept in found.kept):
        notes.append(
            "A restitution above 1: a bounce was missed before it, or it was not left to itself."
        )
    found, mean, laws, scatter = _with_scatter(found, found_at, known, notes)
    height = fall.height
    if height is None:
        height = _height_before(found, fall)
        if height is not None:
            notes.append(
                "The drop height is inferred from the mean fraction of energy retained; give "
                "it if it is known: the first bounce, the fastest, usually retains less."
            )
    inferred = fall.height is None and height is not None
    rest = (mean, laws, height, inferred, scatter, fall.gravity, tuple(notes), fall.drag)
    moments, flights, numbers, speeds, kept = map(tuple, found)
    return Bounces(moments, flights, numbers, speeds, kept, *rest)


def _moments(
    times: Any, error: float | None, least: int, notes: list[str]
) -> tuple[list[Any], list[int]]:
    """Return times, as ufloats if their errors are known, and the bounces missing after each."""
    from uncertainties import UFloat, ufloat

    values = list(times.times) if isinstance(times, Knocks) else _plain(times)
    if error is not None:
        error = checked(positive, "time_error", error, "seconds")
    plain = np.array([nominal(time) for time in values])
    if len(plain) < least:
        many = "three bounces" if least == 3 else "two bounces where the drop height is known"
        raise InvalidValue(f"times must hold at least {many}, got {len(plain)}")
    if not np.isfinite(plain).all():
        raise InvalidValue("times must be finite numbers of seconds, got one that is not")
    moments: list[Any] = [float(time) for time in plain]
    if all(isinstance(time, UFloat) and time.std_dev > 0.0 for time in values):
        moments = values
    elif error is not None:
        moments = [ufloat(time, error) for time in moments]
    steps = np.diff(plain)
    if (steps <= 0.0).any():
        k = int(np.argmax(steps <= 0.0))
        raise InvalidValue(
            f"times must ascend, got {plain[k + 1]:g} s after {plain[k]:g} s (time {k + 1})"
        )
    if steps.max() < _INSTANT:
        raise InvalidValue(
            f"times must be in s, got intervals of at most {steps.max():.3g} s: is it another unit?"
        )
    if isinstance(times, Knocks):
        notes.extend(times.notes)
        return moments, list(times.missed)
    missed = missed_between(steps)
    notes.extend(
        f"A bounce seems to be missing between {plain[k]:.4g} s and {plain[k + 1]:.4g} s: "
        "its flights are left out."
        for k in np.flatnonzero(missed)
    )
    return moments, missed


def _plain(times: Any) -> list[Any]:
    """Return times out of a Dataset or a sequence."""
    if hasattr(times, "data_vars"):
        (known,) = columns(times, ("knock_time",))
        # phyphox writes 0 for knocks that did not come
        return list(np.trim_zeros(known[np.isfinite(known)], "b"))
    if isinstance(times, str | bytes):
        raise InvalidType(f"times must be a sequence of seconds, got {shown(times)}")
    all_real("times", times)
    try:
        values = list(times)
        for time in values:
            nominal(time)
    except (TypeError, ValueError):
        raise InvalidType(f"times must be a sequence of seconds, got {shown(times)}") from None
    return values


def _flights(moments: Sequence[Any], missed: Sequence[int], contact_time: Any) -> list[Any]:
    flights: list[Any] = []
    for k, lost in enumerate(missed):
        flight = moments[k + 1] - moments[k] - contact_time
        if nominal(flight) <= 0.0:
            raise InvalidValue(
                "contact_time must be shorter than every interval, got "
                f"{nominal(contact_time):g} s and one of {nominal(flight + contact_time):g} s"
            )
        flights.append(None if lost else flight)
    known = [nominal(flight) for flight in flights if flight is not None]
    if len(known) > 1 and max(known) - min(known) < _ROUNDING * max(known):
        raise InvalidValue(
            "times must be those of bounces, which come faster and faster, got "
            f"{len(known)} equal intervals of {known[0]:.4g} s"
        )
    return flights


def _restitutions(flights: Sequence[Any], fall: _Fall) -> tuple[list[int], list[Any], list[Any]]:
    """Return numbers, impact speeds and restitutions of the bounces between known flights."""
    missed = np.array(fall.missed)
    ends = [(None, None) if flight is None else _ends(flight, fall) for flight in flights]
    leaving, landing = np.array(ends, dtype=object).T
    pairs = np.flatnonzero((missed[:-1] == 0) & (missed[1:] == 0))
    numbers = (1 + pairs + np.cumsum(missed)[pairs]).tolist()
    speeds, kept = list(landing[pairs]), list(leaving[pairs + 1] / landing[pairs])
    if fall.height is not None and flights[0] is not None:
        speed = speed_after_fall(fall.height, fall.gravity, fall.drag)
        numbers, speeds, kept = [0, *numbers], [speed, *speeds], [leaving[0] / speed, *kept]
    return numbers, speeds, kept


def _ends(flight: Any, fall: _Fall) -> tuple[Any, Any]:
    """Return the speeds at which a flight begins and ends."""
    if fall.drag is not None:
        return fall.drag.flight_speeds(flight, fall.gravity)
    return 0.5 * fall.gravity * flight, 0.5 * fall.gravity * flight


def _height_before(found: _Found, fall: _Fall) -> Any:
    """Return the drop height that the mean energy retained tells; None where nothing tells it."""
    if found.flights[0] is None:
        return None
    leaving, _ = _ends(found.flights[0], fall)
    speed = leaving / _energy_kept(found.kept) ** 0.5
    if fall.drag is not None:
        return fall.drag.fall_height(speed, fall.gravity)
    return speed**2 / (2.0 * fall.gravity)


def _with_errors_from_scatter(
    moments: Sequence[Any], found_at: Callable[[Sequence[Any]], _Found], notes: list[str]
) -> _Found:
    """Return what follows from times, with errors from the scatter.

    All times have the same error. It follows from chi squared of a straight line, or of a constant
    for two restitutions, fitted to the restitutions over the impact speed.
    """
    from uncertainties import ufloat

    def again(error: float) -> _Found:
        return found_at([ufloat(time, error) for time in moments])

    small = 1e-6  # s; errors are proportional to it
    *_, speeds, kept = again(small)
    if len(kept) < 2:
        notes.append("One restitution and no errors of its times: its error cannot be told.")
        return again(float("nan"))
    fit, _ = fit_line(speeds, kept, 1 if len(kept) > 2 else 0, 0.0)
    error = small * np.sqrt(fit.chi_squared / fit.freedom) * widening(fit.freedom)
    notes.append(
        "The times have no errors: those of the restitutions follow from their scatter about a "
        f"{'straight line' if len(kept) > 2 else 'constant'} ({1e3 * error:.2g} ms for each time)."
    )
    return again(max(float(error), 1e-12))


def _with_scatter(
    found: _Found, found_at: Callable[[Sequence[Any]], _Found], known: bool, notes: list[str]
) -> tuple[_Found, Any, Any, float]:
    """Return what was found, the mean restitution, its laws and its excess scatter.

    Where the scatter is or may be the timing's, the errors of the times are those that explain it.
    The mean and the laws allow for both causes where it is unknown. Errors that are estimated from
    the scatter include an excess scatter already.
    """
    mean, laws, scatter = laws_of(found.speeds, found.kept, **({} if known else {"most": 0.0}))
    if not laws:
        return found, mean, laws, scatter
    meant = scatter_of(found.speeds, found.kept)
    notes.extend(meaning_of(scatter, meant))
    if scatter and meant.cause != "floor or spin":
        found = found_at([known_to(time.n, meant.factor * time.s) for time in found.moments])
        if meant.cause == "timing":
            mean, laws, scatter = laws_of(found.speeds, found.kept, most=0.0)
    return found, mean, laws, scatter


def _energy_kept(kept: Sequence[Any]) -> Any:
    """Return the mean of e²; its error includes the standard deviation from bounce to bounce."""
    energies = [restitution**2 for restitution in kept]
    spread = float(np.std([nominal(energy) for energy in energies], ddof=1)) if kept[1:] else 0.0
    return sum(energies) / len(energies) + known_to(0.0, spread)
