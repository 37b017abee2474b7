"""Coverage of what `knocks` and `bounces` find in recordings.

Each seed has a drop height and a beginning of its own, so that knocks begin anywhere between two
samples, as they do in recordings.
"""

from functools import partial
from typing import Any

import numpy as np

from benchmarks.coverage.shares import Trial
from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.sound.analysis import knocks
from stackbounce.synthetic.falls import Falls, falls
from stackbounce.synthetic.sound import sound

__all__ = ["CASES"]

KEPT = 0.75
AT_REST, FALL = 0.86, 0.03  # restitution at no speed, and its fall per m/s


def _steady(random: np.random.Generator) -> Falls:
    return falls(0.1 * random.uniform(0.97, 1.03), KEPT, bounces=7)


def _falling(random: np.random.Generator, scatter: float = 0.0) -> Falls:
    def kept(speed: float) -> float:
        return AT_REST - FALL * speed + scatter * float(random.standard_normal())

    return falls(0.3 * random.uniform(0.97, 1.03), kept, bounces=9)


def _recorded(seed: int, steady: bool, scatter: float = 0.0, **how: Any) -> list[Any]:
    """Return what the knocks of a recording tell; a missed or a false one is an error."""
    random = np.random.default_rng([seed, 1])
    fall = _steady(random) if steady else _falling(random, scatter)
    before = 0.1 + random.uniform() / how.get("rate", 48000.0)
    found = knocks(sound(fall, before=before, after=0.1, seed=seed, **how))
    if len(found.times) != len(fall.touches) or any(found.missed):
        raise ValueError(f"{len(fall.touches)} knocks, of which {len(found.times)} were found")
    told = bounces(found)
    flights = zip(found.times[1:], found.times[:-1], np.diff(fall.touches), strict=True)
    triples: list[Any] = [
        *((f"flight {k}", b - a, float(true)) for k, (b, a, true) in enumerate(flights)),
        *(
            (f"restitution {k}", kept, float(fall.restitutions[k]))
            for k, kept in zip(told.numbers, told.restitutions, strict=True)
        ),
    ]
    if steady:
        return [*triples, ("mean restitution", told.mean, KEPT)]
    law = told.laws[0]
    return [*triples, ("restitution at 0", law.coefficient, AT_REST), ("its fall", law.slope, FALL)]


CASES: dict[str, Trial] = {
    "sound, quiet": partial(_recorded, steady=True),
    "sound, noise and hum": partial(_recorded, steady=True, noise=0.01, hum=0.05),
    "sound, echo and second sounds": partial(
        _recorded, steady=True, echo=(0.03, 0.3), double=(0.003, 0.6)
    ),
    "sound, restitution that falls with speed": partial(_recorded, steady=False, noise=0.005),
    "sound, restitution that falls and scatters": partial(_recorded, steady=False, scatter=0.01),
    "sound, 8 bits at 8 kHz": partial(_recorded, steady=False, rate=8000.0, bits=8),
    "sound, 8 bits at 44.1 kHz": partial(_recorded, steady=False, rate=44100.0, bits=8),
}
