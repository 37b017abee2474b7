"""A video's track of a ball or two -> drop height, impact and rebound speeds, restitution."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue, counted, finite, positive
from stackbounce.measure.drag import Drag, with_difference, with_error_of_drag
from stackbounce.measure.finding import no_gain
from stackbounce.measure.kinds.track import motion, steadiness
from stackbounce.measure.kinds.track.free_flight import no_flight, what_is_seen
from stackbounce.measure.kinds.track.motion import shape_of
from stackbounce.measure.kinds.track.parabolas import Parabolas
from stackbounce.measure.kinds.track.paths import Columns, Upward, flights_of, positions_of, upward
from stackbounce.measure.kinds.track.result import Track, Tracks, notes_of, stays_long
from stackbounce.measure.kinds.track.time_base import SI, TrackUnits, check_time_base, units_of
from stackbounce.measure.messages import PART, Message, OptionHint
from stackbounce.measure.quantities import Array, known_to, nominal
from stackbounce.measure.setup import Setup, above_bottom, places
from stackbounce.measure.statistics.regression import widening
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.units import checked

_TOGETHER = 0.15  # of the time of fall, within which two balls' impacts are one drop's
_RESTITUTION_OFF = 0.07  # of the change within a flight: restitutions in simulated distortions
_HEIGHT_OFF = 0.12  # the same of heights
_HEIGHT_BY_SCATTER = 0.7  # of the accelerations' scatter, by which heights are off there
_SPEED_POWER = 0.67  # of the scale of heights, which is that of speeds there
_ON_THE_WHOLE = 0.25  # of a swaying camera's acceleration, in the mean of simulated flights
_NEWTON_ROUNDS = 3  # from the middle between two flights in air to where they meet
_WANTED = "data must hold a ball that falls and bounces, got "


class _Flown(NamedTuple):
    """A ball, its positions by axis, the flights in its track, and after which it bounces."""

    name: str
    position: dict[str, Array]
    fit: Parabolas
    bounces: list[int]

    def along(self, up: Upward) -> "_Flown":
        """Return the same flights, with heights along another direction."""
        heights = up.heights(self.position)
        return self._replace(fit=Parabolas(self.fit.times, heights, self.fit.flights))


def analyse(data: Any, setup: Setup) -> Tracks:
    """Analyse a track; the floor's level becomes that of the point that was followed."""
    _, point = places(setup.measured_to)
    floor = setup.floor
    if floor is not None:
        floor += nominal(above_bottom(point, setup.diameter))
    found = track(data, gravity=setup.gravity, floor=floor, drag=setup.drag)
    if floor is not None and len(found.balls) > 1:
        raise InvalidValue(
            f"floor is for the track of one ball, as the others bounce on balls, got "
            f"{len(found.balls)}"
        )
    return found


def track(
    data: Any,
    *,
    gravity: float = STANDARD_GRAVITY,
    floor: float | None = None,
    drag: Drag | None = None,
) -> Tracks:
    """Analyse the drop and the bounces in a track of one ball or more.

    The track is cut into free flights, to which parabolas of one acceleration are fitted; a bounce
    is where the parabolas before and after it meet. The acceleration is fitted and compared with
    gravity. A note says what a difference means for frame rate and scale; nothing is corrected.

    Parameters
    ----------
    data : Dataset or (times, heights) or (times, x, y)
        As `stackbounce.read` gives it, or arrays in s and m; NaN where a point is missing.
    gravity : float, optional
        In m/s², above 0, to compare with.
    floor : float, optional
        The height in m, along the upward axis and as tracked, of the tracked point while the ball
        just touches the floor: of its middle, one radius above the floor. By default a bounce is
        where two parabolas meet; for soft balls give it, see Notes.
    drag : Drag, optional
        Of the air, on the one ball of a track in m and s; by default there is none.

    Returns
    -------
    Tracks

    Raises
    ------
    InvalidValue
        If no ball bounces, or a number is out of its range.
    InvalidType
        If `data` is no track.

    Notes
    -----
    Errors follow the residuals and their correlation between neighbouring points; they are widened
    by Student's t where there are few. With drag, what it does to each flight is computed and taken
    from the points, so that parabolas are left.

    A soft ball is on the floor for a time T, and the parabolas before and after it meet below the
    level at which it touches, by about v T/2 at a speed v. They are followed too far down, and both
    speeds come out too high, by g T/2 or so: by 2 % for 15 ms and 3 m/s. With `floor` they are
    those with which the parabolas pass that level. Read it off the frames: the place of the tracked
    point when the ball touches and is not yet flattened. An error of the level by d changes a speed
    v by g d / v, 1 % for 1 cm at 3 m/s.

    Examples
    --------
    >>> import numpy as np
    >>> times = np.arange(40) / 60
    >>> since = times - 0.4
    >>> heights = np.where(since < 0, -3.92 * since, 2.94 * since) - 4.9 * since**2
    >>> seen = heights + np.random.default_rng(1).normal(0.0, 1e-3, 40)
    >>> print(f"{track((times, seen)).balls[0].restitutions[0]:.1uS}")
    0.751(1)
    """
    gravity = checked(positive, "gravity", gravity, "m/s^2")
    found = positions_of(data)
    notes: list[str] = []
    if found.many > 1:
        notes.append(f"It is so long that means of {found.many} neighbouring points were taken.")
    if found.apart:
        notes.append(f"{counted(found.apart, 'point')} left out: far from both neighbours.")
    up = upward(found, gravity)
    if up.sign < 0.0:
        notes.append(f"{up.axis} points down; heights are counted upwards.")
    units = units_of(data)
    flown = _bouncing(found, up, gravity, units)
    turn = _turn(flown, up)
    if turn is not None:
        up = up._replace(tilt=turn.angle)
        flown = _bouncing(found, up, gravity, units)
    left_out = [name for name in found.names if name not in {ball.name for ball in flown}]
    notes.extend(f"{name}: no bounce was found, and it is left out." for name in left_out)
    level = None if floor is None else checked(finite, "floor", floor, "metres")

    def found_at(tilt: float) -> list[Track]:
        seen = [ball.along(up._replace(tilt=tilt)) for ball in flown]
        if drag is not None:
            return [_track_in_air(seen, level, units, drag)]
        return [_track(ball, level, units, alone=len(seen) == 1) for ball in seen]

    balls = found_at(up.tilt)
    if turn is not None:
        moved = zip(balls, found_at(turn.other), balls, strict=True)
        off = known_to(0.0, 1.0)
        balls = [with_difference(*row, off=off) for row in moved]
        notes.append(f"{turn.words}.")
    if drag is not None:
        notes.append(drag.note(_track(flown[0], level, units, alone=True).restitutions[0]))
    notes.extend(note for ball in balls for note in ball.notes)
    balls.sort(key=lambda ball: float(ball.levels[0].nominal_value))
    rate = float(1.0 / np.median(np.diff(found.times)))
    base = check_time_base(_common_gravity(balls), gravity, rate, units)
    notes.extend([base.note] * (not base.agrees))
    ratios = _rebound_ratios(balls, notes)
    for ball in balls[:1] if ratios else balls:
        if gains := no_gain(ball.restitutions, ball.impact_times):
            raise InvalidValue(_WANTED + gains)
    upwards = up.axis if up.sign > 0.0 else f"-{up.axis}"
    return Tracks(tuple(balls), ratios, base, upwards, up.tilt, tuple(notes), units, drag)


def _turn(flown: list[_Flown], up: Upward) -> steadiness.Turn | None:
    """Return the turn of the camera that the lowest ball and its floor show, None for none."""
    side = "x" if up.axis == "y" else "y"
    ball = min(flown, key=lambda ball: float(ball.fit.heights.min()))
    if side not in ball.position:
        return None
    across = ball.position[side]
    known = np.isfinite(across)
    if known.sum() < 2:
        return None
    seen = _track(ball, None, SI, alone=False)
    times, moments = ball.fit.times[known], [nominal(moment) for moment in seen.impact_times]
    floor = steadiness.floor_angle(seen.levels, np.interp(moments, times, across[known]))
    speed = float(np.polyfit(times, across[known], 1)[0])
    slow = steadiness.acceleration_angle(ball.fit, across)
    return steadiness.turn_of(slow, floor, speed / nominal(seen.impact_speeds[0]), up.axis)


def _bouncing(found: Columns, up: Upward, gravity: float, units: TrackUnits) -> list[_Flown]:
    """Return the balls that fly freely and bounce; refuse a track without any."""
    flown, reasons = [], []
    compared = gravity if units.known else None
    for name, position in zip(found.names, found.positions, strict=True):
        heights = up.heights(position)
        good = np.isfinite(heights)
        flights = flights_of(found.times[good], heights[good], gravity) if good.sum() > 4 else None
        if flights is None:
            continue
        if reason := no_flight(*flights, up.axis, compared):
            reasons.append(reason)
        else:
            known = {axis: values[good] for axis, values in position.items()}
            flown.append(_Flown(name, known, *flights))
    if flown:
        return flown
    reason = reasons[0] if reasons else _seen(found, up, compared)
    many = (f" (means of {found.many} of its points were taken: ", PART, " choose the bounces)")
    raise InvalidValue(Message(_WANTED, reason, *many[: 3 * (found.many > 1)]))


def _seen(found: Columns, up: Upward, gravity: float | None) -> str:
    """Return what the track of the ball that moves most shows."""
    if up.axis == "x" and "y" in found.positions[0]:
        up = Upward("y", 1.0)
    every = [up.heights(position) for position in found.positions]
    heights = max(
        every, key=lambda seen: np.nanmax(seen, initial=-np.inf) - np.nanmin(seen, initial=np.inf)
    )
    known = np.isfinite(heights)
    return what_is_seen(found.times[known], heights[known], up.axis, gravity)


def _track_in_air(flown: list[_Flown], level: float | None, units: TrackUnits, drag: Drag) -> Track:
    """Return the bounces of the one ball of a track in air, with the error of the drag."""
    if len(flown) > 1:
        raise InvalidValue(
            f"drag is for the track of one ball of known mass and diameter, got {len(flown)}"
        )
    if not units.known:
        wrong = f"drag needs lengths in m and times in s, got {units.length} and {units.time}: "
        hint = OptionHint({"frame_rate": None, "scale": None})
        raise InvalidValue(Message(wrong, hint, " tell them"))

    def found_with(drag: Drag) -> Track:
        return _track(flown[0], level, units, alone=True, drag=drag)

    try:
        return with_error_of_drag(found_with(drag.exact()), found_with, drag)
    except OverflowError:
        raise InvalidValue(
            "mass, diameter and drag_coefficient must be those of the ball that was tracked, got "
            f"{nominal(drag.rate):.3g} 1/m of drag: it flies faster than it could fall"
        ) from None


def _track(
    ball: _Flown, floor: float | None, units: TrackUnits, *, alone: bool, drag: Drag | None = None
) -> Track:
    """Return a ball's bounces from its parabolas; a drag is taken to be exact."""
    name, _, fit, bounces = ball
    if drag is not None:
        fit = motion.straightened(fit, drag)
    shape = shape_of(fit.times, fit.heights, fit.flights)
    numbers = motion.flight_numbers(fit, shape)
    met = [_bounce(fit, numbers, flight, floor, drag) for flight in bounces]
    moments, levels, impacts, rebounds = (tuple(column) for column in zip(*met, strict=True))
    gravity = numbers[0][0]
    if shape.widening > 1.0:
        wider = widening(max(fit.freedom, 1)) * shape.widening
        gravity = known_to(fit.values[0], wider * math.sqrt(fit.covariance[0, 0]))
    size, sway = 0.0, 0.0
    if alone and floor is None:
        gaps = fit.times[fit.firsts[1:]] - fit.times[fit.lasts[:-1] - 1]
        size, sway = steadiness.sway_of(moments, levels, impacts, float(gaps[bounces].max()))
    if sway > 0.0:
        off = [known_to(0.0, sway) for _ in bounces]  # the camera's speed at each
        impacts = tuple(speed - sways for speed, sways in zip(impacts, off, strict=True))
        rebounds = tuple(speed + sways for speed, sways in zip(rebounds, off, strict=True))
        gravity += known_to(0.0, _ON_THE_WHOLE * sway**2 / size)
    # the scale after a bounce over that before, and the scale of heights
    ratio = known_to(1.0, math.hypot(shape.scatter, _RESTITUTION_OFF * shape.bent))
    place = known_to(1.0, math.hypot(_HEIGHT_BY_SCATTER * shape.scatter, _HEIGHT_OFF * shape.bent))
    height, fall_time = motion.fallen(impacts[0], numbers[bounces[0]][0], drag)
    found = Track(
        name=name,
        impact_times=moments,
        levels=levels,
        impact_speeds=tuple(speed * place**_SPEED_POWER for speed in impacts),
        rebound_speeds=tuple(speed * place**_SPEED_POWER for speed in rebounds),
        drop_height=height * place,
        apex_heights=tuple(
            motion.risen(speed, numbers[flight + 1][0], drag) * place
            for flight, speed in zip(bounces, rebounds, strict=True)
        ),
        restitutions=tuple(out / into * ratio for into, out in zip(impacts, rebounds, strict=True)),
        gravity=gravity,
        heights=ball.fit.heights,
        fit=fit,
        bounces=tuple(bounces),
        notes=(),
    )
    notes = notes_of(found, shape, fall_time, units.time)
    if sway > 0.0:
        notes.append(
            f"{name}: it bounces at levels that differ by {size:.2g} {units.length}, as where a "
            "hand sways the camera or the floor is uneven; speeds may be off by "
            f"{sway:.2g} {units.speed}, which the errors allow for"
        )
    if floor is None and units.known:
        notes += stays_long(found, alone=alone)
    return replace(found, notes=tuple(notes))


def _bounce(
    fit: Parabolas,
    numbers: Sequence[motion.Numbers],
    flight: int,
    floor: float | None,
    drag: Drag | None,
) -> tuple[Any, Any, Any, Any]:
    """Return time, level, impact and rebound speed of the bounce after a flight."""
    both = slice(flight, flight + 2)
    before, after = fit.flights[both]
    time = 0.5 * (fit.times[before.last - 1] + fit.times[after.first])

    def states(time: float) -> list[tuple[Any, Any, Any]]:
        sides = zip(numbers[both], fit.origins[both], strict=True)
        return [motion.state(side, float(time - origin), drag) for side, origin in sides]

    # parabolas meet where straight lines do whose speeds differ as much
    for _ in range(_NEWTON_ROUNDS if drag else 0):
        (low, into, _), (high, out, _) = states(time)
        time += nominal((low - high) / (out - into))
    (low, into, fall), (high, out, back) = states(time)
    since = (low - high) / (out - into)
    if floor is not None:
        speeds = _at_level(into, low - floor, fall), _at_level(out, high - floor, back)
        return time + since, low * 0.0 + floor, *speeds
    level = low + into * since - 0.5 * fall * since**2
    return time + since, level, fall * since - into, out - back * since


def _at_level(speed: Any, above: Any, fall: Any) -> Any:
    square = speed**2 + 2.0 * fall * above
    if square.nominal_value <= 0.0:
        raise InvalidValue(
            "floor must be a level that the ball reaches, got one above its flights (it is where "
            "the tracked point is while the ball touches the floor, along the upward axis)"
        )
    return square**0.5


def _common_gravity(balls: list[Track]) -> Any:
    weights = [1.0 / max(float(ball.gravity.std_dev), 1e-12) ** 2 for ball in balls]
    return sum(weights[k] * ball.gravity for k, ball in enumerate(balls)) / sum(weights)


def _rebound_ratios(balls: list[Track], notes: list[str]) -> tuple[Any, ...]:
    """Return rebound speeds of balls that bounce together over the lowest one's impact speed."""
    if len(balls) < 2:
        return ()
    lowest = balls[0]
    start, incoming = lowest.impact_times[0], lowest.impact_speeds[0]
    slack = _TOGETHER * float((incoming / lowest.gravity).nominal_value)
    ratios = []
    for ball in balls:
        apart = [abs(float((time - start).nominal_value)) for time in ball.impact_times]
        k = int(np.argmin(apart))
        if apart[k] > slack:
            notes.append(f"{ball.name} does not bounce when {lowest.name} does: no stacked drop.")
            return ()
        ratios.append(ball.rebound_speeds[k] / incoming)
    return tuple(ratios)
