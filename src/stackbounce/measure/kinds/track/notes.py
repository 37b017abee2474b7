"""Notes on a ball's track, a sentence each."""

from typing import Any

import numpy as np

from stackbounce.measure.kinds.track.result import Track
from stackbounce.measure.kinds.track.shape import Shape
from stackbounce.measure.messages import Message, OptionHint

_CORRELATED = 0.2  # correlation of neighbouring points' errors that is mentioned
_NOTICED = 1.0  # standard errors of a speed, from which on its bias is mentioned


def notes_of(ball: Track, shape: Shape, fall_time: Any, unit: str) -> list[str]:
    """Return the notes on a ball's track; its time of fall from rest is in a unit."""
    name, fit = ball.name, ball.fit
    notes = _uneven(name, shape)
    first = fit.flights[ball.bounces[0]]
    late = float(fit.times[first.first] - (ball.impact_times[0] - fall_time).nominal_value)
    if late > 0.2 * fall_time.nominal_value:
        notes.append(
            f"{name}: its track begins {late:.2g} {unit} after the fall did; the drop height is "
            "that of a fall from rest with the same impact speed."
        )
    elif late < -0.1 * fall_time.nominal_value:
        notes.append(
            f"{name}: it goes up before it falls; the drop height is that of its highest point."
        )
    least = min(last - start for start, last in fit.flights)
    if least < 5:
        notes.append(f"{name}: a flight has only {least} points; a higher frame rate would help.")
    if fit.correlation > _CORRELATED:
        notes.append(
            f"{name}: the errors of neighbouring points go together (correlation "
            f"{fit.correlation:.2g}), as when a mark drifts on the ball; the errors allow for it."
        )
    return notes


def stays_long(ball: Track, *, alone: bool) -> list[str]:
    """Return a note where a long contact biases the speeds at the touch."""
    fit, bounce = ball.fit, ball.bounces[0]
    before, after = fit.flights[bounce].last, fit.flights[bounce + 1].first
    lasts = max(after - before - 1, 0) * float(np.median(np.diff(fit.times)))  # at least
    excess = 0.5 * ball.gravity.nominal_value * lasts
    if excess < _NOTICED * ball.impact_speeds[0].std_dev:
        return []
    biased = (
        f"{ball.name} is in contact for {1e3 * lasts:.0f} ms or more: its speeds, where the "
        f"flights before and after meet, are too high by {excess:.2g} m/s or more, beyond their "
        "errors, and so are its heights"
    )
    if not alone:
        return [f"{biased}; what is fitted to them is off by as much"]
    hint = OptionHint({"floor": None})
    return [Message(f"{biased}; ", hint, " tells the floor's level, for those at the touch")]


def _uneven(name: str, shape: Shape) -> list[str]:
    """Return notes where the acceleration differs between flights, or changes within them."""
    notes: list[str] = []
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
    return notes
