"""Coverage of delays and gaps by the floor's force alone, under two balls and under the lower."""

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import stackbounce as sb
from stackbounce.measure.kinds.waveform.gap.floor_gap import floor_gap
from synthetic.waveform import waveform as record_of

__all__ = ["CASES", "runs"]

MASS, UPPER, SPEED, TIME = 0.101, 0.0248, 1.98, 4.3e-3  # the paper's B1 with B2 on it
_MEASURED = {"contact_time": TIME, "restitution": 0.8, "impact_speed": SPEED}
_FLOORS: tuple[tuple[type[Any], dict[str, Any]], ...] = (
    (sb.Spring, {"contact_time": TIME}),
    (sb.Hysteretic, _MEASURED),
    (sb.Hertz, {"contact_time": TIME, "impact_speed": SPEED}),
    (sb.HuntCrossley, _MEASURED),
    (sb.Dashpot, _MEASURED),
    (sb.Viscoelastic, _MEASURED),
    (sb.Hysteretic, _MEASURED | {"exponent": 1.3}),
)
_BALLS = ((1.0, 3.0e-3), (1.25, 3.5e-3), (1.5, 4.0e-3), (1.0, 4.0e-3), (1.5, 3.0e-3))


@cache
def runs(gap: float, floor: int, between: int) -> tuple[sb.Result, sb.Result]:
    """Return the runs of both balls and of the lower one, on one of the floors."""
    kind, told = _FLOORS[floor]
    exponent, time = _BALLS[between]
    lower = sb.calibrate(kind, mass=MASS, **told)
    lasting = {"mass": (MASS, UPPER), "contact_time": time, "impact_speed": SPEED}
    upper = sb.calibrate(sb.PowerLaw, exponent=exponent, **lasting)
    both = sb.Drop([sb.Ball(MASS), sb.Ball(UPPER)], [lower, upper], gaps=[gap], impact_speed=SPEED)
    alone = sb.Drop([sb.Ball(MASS)], [lower], impact_speed=SPEED)
    return sb.simulate(both), sb.simulate(alone)


def _trial(seed: int, gap: float, **how: Any) -> list[tuple[str, Any, float]]:
    """Analyse a pair of records; nothing where it says that the gap cannot be told."""
    both, alone = runs(gap, seed % len(_FLOORS), seed // len(_FLOORS) % len(_BALLS))
    records = (record_of(one, seed=2 * seed + k, **how) for k, one in enumerate((both, alone)))
    found = floor_gap(*records, mass=MASS)
    if found.delay is None:
        return []
    return [("delay", found.delay, float(both.first_touch[1])), ("gap", found.gap, gap)]


CASES: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "floor's force alone, gap of 1 mm, 0.3 % noise": partial(_trial, gap=1e-3, rate=1e5, noise=0.5),
    "floor's force alone, gap of 2 mm, 0.3 % noise": partial(_trial, gap=2e-3, rate=1e5, noise=0.5),
}
"""Case name to a trial: seed to (quantity, estimate, truth)."""
