"""Coverage of what `track` finds in tracks of one ball and of two."""

from collections.abc import Callable
from typing import Any

from stackbounce.measure.kinds.track.analysis import track
from stackbounce.model import Ball, Drop, HuntCrossley, Rigid
from stackbounce.run.calibration import calibrate
from stackbounce.run.driver import simulate
from synthetic.falls import Falls, falls
from synthetic.track import track as tracked

__all__ = ["CASES", "LIMITS"]

Trial = Callable[[int], list[tuple[str, Any, float]]]

ONE = falls(0.5, 0.8)
LAW = calibrate(HuntCrossley, mass=0.06, restitution=0.8, contact_time=0.015, impact_speed=3.13)
SOFT = falls(0.5, LAW, mass=0.06)
BALLS = ([Ball(0.6, diameter=0.2), Ball(0.1, diameter=0.1)], [Rigid(0.8)] * 2)
STACK = simulate(Drop(*BALLS, height=0.5, gravity=ONE.gravity), until=0.2)
OBLIQUE = {"drift": 3.0, "before": -0.02, "until": 1.2}
RATIOS = simulate(Drop(*BALLS, height=0.5)).rebound_ratios  # right after the impact


def one_ball(fall: Falls = ONE, floor: float | None = None, **options: Any) -> Trial:
    """Return a trial: a track of one ball that bounces twice."""
    factor = options.get("read_as", options.get("frame_rate", 60.0)) / options.get(
        "frame_rate", 60.0
    )

    def trial(seed: int) -> list[tuple[str, Any, float]]:
        options_here = {"frame_rate": 60.0, "until": 0.95, "noise": 1.5e-3} | options
        ball = track(tracked(fall, seed=seed, **options_here), floor=floor).balls[0]
        kept = float(fall.restitutions[0])
        return [
            ("drop height", ball.drop_height, fall.height),
            ("impact speed", ball.impact_speeds[0], float(fall.speeds[0]) * factor),
            ("rebound speed", ball.rebound_speeds[0], float(fall.rebounds[0]) * factor),
            ("apex height", ball.apex_heights[0], fall.height * kept**2),
            ("restitution", ball.restitutions[0], kept),
            ("gravity of the flights", ball.gravity, fall.gravity * factor**2),
        ]

    return trial


def two_balls(seed: int) -> list[tuple[str, Any, float]]:
    """Return the rebound ratios of two balls that touch."""
    found = track(tracked(STACK, frame_rate=120.0, noise=1.5e-3, seed=seed))
    return [
        (f"rebound ratio {k}", ratio, float(true))
        for k, (ratio, true) in enumerate(zip(found.rebound_ratios, RATIOS, strict=True))
    ]


CASES: dict[str, Trial] = {
    "track, 60 frames per second": one_ball(),
    "track, errors that go together": one_ball(correlation=0.5, frame_rate=100.0, until=1.2),
    "track, pixels of 4 mm": one_ball(pixel=0.004, noise=1e-3),
    "track, one point in five missing": one_ball(missing=0.2),
    "track, axes tilted by 4 degrees": one_ball(tilt=0.07, drift=0.1),
    "track, 240 frames per second read as 60": one_ball(frame_rate=240.0, read_as=60.0, until=0.7),
    "track, a soft ball and its floor": one_ball(SOFT, floor=0.0, frame_rate=120.0),
    "track, two balls": two_balls,
}
LIMITS: dict[str, Trial] = {
    "track, slowed across by 0.3 m/s^2": one_ball(**OBLIQUE, slowing=0.3),
    "track, slowed across by 1 m/s^2": one_ball(**OBLIQUE, slowing=1.0),
    "track, oblique and axes tilted by 2 degrees": one_ball(**OBLIQUE, tilt=0.035),
    "track, air or tilt, one bounce": one_ball(**OBLIQUE | {"until": 0.6}, slowing=0.3),
    "track, hand-held, 6 mm at 0.7 Hz": one_ball(sway=0.006, frame_rate=120.0, until=1.4),
    "track, lens": one_ball(lens=0.1, drift=0.5, before=-0.02, frame_rate=120.0, until=1.4),
}
