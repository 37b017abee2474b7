"""The result of the analysis of a track, and the notes on each ball, a sentence each."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from stackbounce.measure.drag import Drag
from stackbounce.measure.finding import Curve, Finding, as_ratios, rigid_contact
from stackbounce.measure.kinds.track.motion import Shape, curve
from stackbounce.measure.kinds.track.parabolas import Parabolas
from stackbounce.measure.kinds.track.time_base import SI, TimeBase, TrackUnits
from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array, Number, Row, nominal

_NOTICED = 1.0  # standard errors of a speed, from which on its bias is mentioned


@dataclass(frozen=True)
class Track:
    """One ball's flights and bounces.

    Attributes
    ----------
    name : str
        Of the ball.
    impact_times : tuple of ufloat
        When the parabolas before and after each bounce meet, in s.
    levels : tuple of ufloat
        Height at these times, in m, as tracked.
    impact_speeds, rebound_speeds : tuple of ufloat
        Before and after each bounce, in m/s; a rebound speed is up-positive.
    drop_height : ufloat
        Above the level of the first bounce, in m, of a fall from rest.
    apex_heights : tuple of ufloat
        Above the level of the bounce before, in m.
    restitutions : tuple of ufloat
        Of each bounce: rebound over impact speed.
    gravity : ufloat
        Of the flights, as tracked, in m/s².
    heights : ndarray
        (N,) of the points, in m, up-positive.
    fit : Parabolas
        Those of the flights, with the times of the points.
    bounces : tuple of int
        After which flights it bounces.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    name: str
    impact_times: tuple[Number, ...]
    levels: tuple[Number, ...]
    impact_speeds: tuple[Number, ...]
    rebound_speeds: tuple[Number, ...]
    drop_height: Number
    apex_heights: tuple[Number, ...]
    restitutions: tuple[Number, ...]
    gravity: Number
    heights: Array
    fit: Parabolas
    bounces: tuple[int, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class Tracks(Finding):
    """The drop and the bounces of one ball or more; made by `track`.

    Attributes
    ----------
    balls : tuple of Track
        The lowest ball first.
    rebound_ratios : tuple of ufloat
        Of a stacked drop: each ball's rebound speed over the lowest one's impact speed; empty for
        one ball, or where the balls do not bounce together.
    time_base : TimeBase
        The track's frame rate and scale, checked against gravity.
    axis : str
        The one that is up: x, y, -x or -y.
    tilt : float
        Angle between this axis and the vertical, in radians; corrected where it was found.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    units : TrackUnits
        Of lengths and times: pixels or frames in place of m and s where these are not known.
    drag : Drag or None
        Of the air, where it was taken into account. The parabolas are then those of points from
        which its part is taken.
    """

    picture: ClassVar[str] = "track"

    balls: tuple[Track, ...]
    rebound_ratios: tuple[Number, ...]
    time_base: TimeBase
    axis: str
    tilt: float
    notes: tuple[str, ...]
    units: TrackUnits = SI
    drag: Drag | None = None

    def rows(self) -> list[Row]:
        """Return the table, the most important first."""
        length, time, speed = *self.units, self.units.speed
        stacked = zip(self.balls, self.rebound_ratios, strict=False)
        rows = [Row(f"{ball.name}: rebound ratio", ratio) for ball, ratio in stacked]
        for ball in self.balls:
            of = f"{ball.name}: " if len(self.balls) > 1 else ""
            rows.append(Row(f"{of}drop height", ball.drop_height, length))
            for k in range(len(ball.impact_times)):
                bounce = f" of bounce {k}" if len(ball.impact_times) > 1 else ""
                rows.append(Row(f"{of}impact speed{bounce}", ball.impact_speeds[k], speed))
                rows.append(Row(f"{of}rebound speed{bounce}", ball.rebound_speeds[k], speed))
                # In a stack only the lowest ball's later bounces are on the floor alone.
                if not self.rebound_ratios or (k > 0 and ball is self.balls[0]):
                    rows.append(Row(f"{of}restitution{bounce}", ball.restitutions[k]))
                after = bounce.replace(" of", " after")
                rows.append(Row(f"{of}apex height{after}", ball.apex_heights[k], length))
                rows.append(Row(f"{of}time{bounce}", ball.impact_times[k], time))
        rows.append(Row("gravity of the flights", self.time_base.gravity, f"{speed}^2"))
        return [*rows, *(self.drag.rows() if self.drag else ())]

    def fitted(self, ball: Track, flight: int, times: Array) -> Array:
        """Return the heights of a flight of a ball at some times, as they were fitted."""
        return curve(ball.fit, flight, times, self.drag)

    def parts(self) -> dict[str, Any]:
        """Return impact speed and, of a single ball, the floor's contact, as in a drop's TOML."""
        lowest = self.balls[0]
        contact = rigid_contact(lowest.restitutions[0]) if len(self.balls) == 1 else {}
        speed = {"impact_speed": nominal(lowest.impact_speeds[0])} if self.units.known else {}
        return {**speed, **contact}

    def law_arguments(self) -> dict[str, Any]:
        """Return the first impact speed and, of a single ball, the restitution of that bounce."""
        ball = self.balls[0]
        told = {"impact_speed": ball.impact_speeds[0]} if self.units.known else {}
        return told | ({"restitution": ball.restitutions[0]} if len(self.balls) == 1 else {})

    def measured(self, data: Any) -> dict[str, str]:  # noqa: ARG002
        """Return the rebound ratios of a stacked drop, or that of the lowest ball alone."""
        return as_ratios(self.rebound_ratios or self.balls[0].restitutions[:1])

    def curves(self, data: Any) -> list[Curve]:  # noqa: ARG002
        """Return each ball's height above where it first bounces."""
        curves = []
        for ball in self.balls:
            above = ball.heights - nominal(ball.levels[0])
            curves.append(Curve(ball.name, "position", ball.fit.times, above, self.units.length))
        return curves

    def first_touch(self) -> float | None:
        """Return when the lowest ball first bounces, in s; None where the clock is not known."""
        return nominal(self.balls[0].impact_times[0]) if self.units.time == "s" else None


def notes_of(ball: Track, shape: Shape, fall_time: Any, unit: str) -> list[str]:
    """Return the notes on a ball's track; its time of fall from rest is in a unit."""
    name, fit = ball.name, ball.fit
    notes = []
    if shape.widening > 1.0:
        notes.append(
            f"{name}: the accelerations of its flights differ by {shape.scatter:.1%}, as where a "
            "lens or the distance to the camera changes the scale; each flight has its own, and "
            "heights and restitutions are as uncertain"
        )
    if shape.bent:
        notes.append(
            f"{name}: within its flights the acceleration changes by {shape.change:+.0%}, as where "
            "a lens or air changes it; the errors of heights and restitutions allow for it"
        )
    first = fit.flights[ball.bounces[0]]
    late = float(fit.times[first.first] - (ball.impact_times[0] - fall_time).nominal_value)
    if late > 0.2 * fall_time.nominal_value:
        notes.append(
            f"{name}: its track begins {late:.2g} {unit} after the fall did; the drop height is "
            "that of a fall from rest with the same impact speed."
        )
    least = min(last - start for start, last in fit.flights)
    if least < 5:
        notes.append(f"{name}: a flight has only {least} points; a higher frame rate would help.")
    return notes


def stays_long(ball: Track, *, alone: bool) -> list[str]:
    """Return a note where a long contact biases the speeds at the touch."""
    fit, bounce = ball.fit, ball.bounces[0]
    before, after = fit.flights[bounce].last, fit.flights[bounce + 1].first
    lasts = max(after - before - 1, 0) * float(np.median(np.diff(fit.times)))  # at least
    excess = 0.5 * ball.gravity.nominal_value * lasts
    if excess < _NOTICED * ball.impact_speeds[0].std_dev:
        return []
    hint = ("; ", OptionHint({"floor": None}), " tells the floor's level, for those at the touch")
    biased = (
        f"{ball.name} is in contact for {1e3 * lasts:.0f} ms or more: its speeds, where the "
        f"flights before and after meet, are too high by {excess:.2g} m/s or more, beyond their "
        "errors, and so are its heights"
    )
    return [Message(biased, *hint * alone)]
