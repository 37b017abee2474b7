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
from synthetic.falls import Falls, falls
from synthetic.sound import sound

__all__ = ["CASES", "LIMITS"]

KEPT = 0.75
ALL = {"alike": 0.5, "wind": 0.01, "coarse": 0.4, "level": 2.0}  # the last is clipped
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
    flights = zip(told.times[1:], told.times[:-1], np.diff(fall.touches), strict=True)
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


def _ugly(seed: int, **how: Any) -> list[Any]:
    """Return what an ugly recording tells; all knocks, flights and restitutions together.

    What all times have in common, which no flight contains, is no error. A knock may be missed. A
    false one counts as a wrong time of the nearest. One recording in some hundreds is refused.
    """
    random = np.random.default_rng([seed, 1])
    fall = _falling(random)
    before = 0.1 + random.uniform() / how.get("rate", 48000.0)
    data = sound(fall, before=before, after=0.1, seed=seed, uneven=0.2, room=0.4, **how)
    found = knocks(data)
    if found.against:
        return []
    told = bounces(found)
    every = fall.touches - fall.touches[0] + before
    seen = np.array([time.nominal_value for time in told.times])
    which = np.abs(np.subtract.outer(seen, every)).argmin(axis=1)
    weights = np.array([time.std_dev**-2 for time in told.times])
    late = [time - float(every[k]) for time, k in zip(told.times, which, strict=True)]
    common = sum(w * off for w, off in zip(weights / weights.sum(), late, strict=True))
    times = [time - common for time in told.times]
    true = np.diff(every)
    law = told.laws[0]
    return [
        *(("knock times", one, float(every[k])) for one, k in zip(times, which, strict=True)),
        *(
            ("flights", times[k + 1] - times[k], float(true[which[k]]))
            for k in range(len(times) - 1)
            if which[k + 1] == which[k] + 1
        ),
        *(
            ("restitutions", kept, float(fall.restitutions[k + which[0]]))
            for k, kept in zip(told.numbers, told.restitutions, strict=True)
        ),
        ("restitution at 0", law.coefficient, AT_REST),
        ("its fall", law.slope, FALL),
    ]


CASES: dict[str, Trial] = {
    "sound, noise and hum": partial(_recorded, steady=True, noise=0.01, hum=0.05),
    "sound, restitution that falls with speed": partial(_recorded, steady=False, noise=0.005),
    "sound, 8 bits at 44.1 kHz": partial(_recorded, steady=False, rate=44100.0, bits=8),
    **{
        f"ugly sound, {name}": partial(_ugly, **how)
        for name, how in (
            ("knocks that differ, 48 kHz", {}),
            ("knocks half alike, 44.1 kHz", {"alike": 0.5, "rate": 44100.0}),
            ("soft knocks, 32 kHz", {"attack": 0.4e-3, "rate": 32000.0}),
            ("8 kHz", {"rate": 8000.0}),
            ("wind, 16 kHz", {"wind": 0.01, "rate": 16000.0}),
            ("clipped, 22.05 kHz", {"level": 4.0, "rate": 22050.0}),
            ("as MP3, 44.1 kHz", {"coarse": 0.5, "rate": 44100.0}),
            ("all of it, 44.1 kHz", {**ALL, "rate": 44100.0}),
            ("as MP3 out of silence, 48 kHz", {"coarse": 0.5, "noise": 1e-5}),
        )
    },
}

LIMITS: dict[str, Trial] = {  # timid
    "sound, quiet": partial(_recorded, steady=True),
    "sound, echo and second sounds": partial(
        _recorded, steady=True, echo=(0.03, 0.3), double=(0.003, 0.6)
    ),
    "sound, 8 bits at 8 kHz": partial(_recorded, steady=False, rate=8000.0, bits=8),
    "sound, restitution that falls and scatters": partial(_recorded, steady=False, scatter=0.01),
}
