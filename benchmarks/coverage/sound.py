"""Coverage of what `knocks` and `bounces` find in recordings."""

from collections.abc import Callable
from typing import Any

from stackbounce.measure.bounces import bounces
from stackbounce.measure.sound import knocks
from stackbounce.measure.synthetic.falls import Falls, falls
from stackbounce.measure.synthetic.sound import sound

__all__ = ["CASES"]

Trial = Callable[[int], list[tuple[str, Any, float]]]

STEADY = falls(0.1, 0.75, bounces=7)
FALLING = falls(0.3, lambda speed: 0.86 - 0.03 * speed, bounces=9)


def recorded(fall: Falls, **options: Any) -> Trial:
    """Return a trial: a recording, its knocks, and what they tell."""

    def trial(seed: int) -> list[tuple[str, Any, float]]:
        data = sound(fall, before=0.1, after=0.1, seed=seed, **options)
        found = knocks(data)
        if len(found.times) < 4 or any(found.missed):
            return []
        told = bounces(found)
        triples: list[tuple[str, Any, float]] = [
            (f"flight {k}", found.times[k + 1] - found.times[k], float(true))
            for k, true in enumerate((fall.touches[1:] - fall.touches[:-1])[: len(found.times) - 1])
        ]
        triples.extend(
            (f"restitution {k}", kept, float(fall.restitutions[k]))
            for k, kept in zip(told.numbers, told.restitutions, strict=True)
        )
        if fall is FALLING:
            triples.append(("restitution at 0", told.laws[0].coefficient, 0.86))
            triples.append(("its fall", told.laws[0].slope, 0.03))
        else:
            triples.append(("mean restitution", told.mean, 0.75))
        return triples

    return trial


CASES: dict[str, Trial] = {
    "sound, quiet": recorded(STEADY),
    "sound, noise and hum": recorded(STEADY, noise=0.01, hum=0.05),
    "sound, echo and second sounds": recorded(STEADY, echo=(0.03, 0.3), double=(0.003, 0.6)),
    "sound, restitution that falls with speed": recorded(FALLING, noise=0.005),
}
