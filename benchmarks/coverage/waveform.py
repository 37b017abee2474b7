"""Coverage of what is read off force records: times, impulses, peaks, stiffness, delays, gaps.

An error allows for not knowing the law: it holds the truth as often as it claims for laws from a
spring's to Hertz's and beyond, with some loss. Where the law is told the error is that of this law,
and smaller. `LIMITS` has cases for which it does not hold.
"""

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

import stackbounce as sb
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.gap import delay, gap_from_delay
from synthetic.waveform import waveform as record_of

MASS, SPEED, TIME = 0.101, 1.98, 4.3e-3  # the paper's ball B1
_EXPONENTS = (1.0, 1.125, 1.25, 1.375, 1.5)  # from a linear spring to Hertz's law


@cache
def _run(exponent: float, gap: float | None = None, between: float = 1.0) -> sb.Result:
    """Return the run of one ball, or of B2 on B1, with exponents of floor and balls."""
    law = sb.calibrate(
        sb.PowerLaw, mass=MASS, contact_time=TIME, impact_speed=SPEED, exponent=exponent
    )
    balls, contacts = [sb.Ball(MASS)], [law]
    if gap is not None:
        balls.append(sb.Ball(0.0248))
        lasting = {"mass": (MASS, 0.0248), "contact_time": 3.5e-3, "impact_speed": SPEED}
        contacts.append(sb.calibrate(sb.PowerLaw, exponent=between, **lasting))
    gaps = [] if gap is None else [gap]
    return sb.simulate(sb.Drop(balls, contacts, gaps=gaps, impact_speed=SPEED))


def _bounce(seed: int, exponent: float | None, **how: Any) -> list[tuple[str, Any, float]]:
    """Analyse one bounce; with no exponent a law between a linear spring and Hertz's."""
    if exponent is None:
        exponent = _EXPONENTS[seed % 5]
    result = _run(exponent)
    row = result.intervals[0]
    record = record_of(result, seed=seed, **how)
    found = waveform(record, mass=MASS, time_constant=how.get("time_constant"))
    (contact,) = found.contacts
    gain = how.get("sensitivity", 1.0)
    true_time = row["end"] - row["start"]
    return [
        ("touch", contact.start, record.attrs["touch"]),
        ("contact time", contact.time, true_time),
        ("stiffness", found.stiffness, MASS * (np.pi / true_time) ** 2),
        ("impulse", contact.impulse, gain * row["impulse"]),
        ("peak force", contact.peak_force, gain * row["peak_force"]),
    ]


@cache
def _bounced(exponent: float, twice: bool) -> sb.Result:
    """Return the run of one ball that bounces once, or twice after 0.1 s."""
    law = sb.calibrate(
        sb.PowerLaw, mass=MASS, contact_time=TIME, impact_speed=0.5, exponent=exponent
    )
    drop = sb.Drop([sb.Ball(MASS)], [law], impact_speed=0.5, gravity=9.81 * twice)
    return sb.simulate(drop, until=0.125) if twice else sb.simulate(drop)


def _ugly(
    seed: int, *, leads: tuple[float, float], hum: float = 0.0, rings: bool = False
) -> list[tuple[str, Any, float]]:
    """Analyse one bounce or two in a record with noise, an offset, steps, and hum or ringing.

    The record begins and stops with a lead in s between two; the hum is relative to the peak.
    """
    random = np.random.default_rng(seed + 10_000)
    result = _bounced(_EXPONENTS[seed % 5], twice=seed % 2 == 1)
    rows = result.intervals
    peak = float(max(rows["peak_force"]))

    def between(least: float, most: float) -> float:
        return float(np.exp(random.uniform(np.log(least), np.log(most))))

    how: dict[str, Any] = {
        "rate": random.choice([2e4, 5e4, 1e5]),
        "before": between(*leads),
        "noise": peak * random.uniform(0.003, 0.01),
        "offset": peak * random.uniform(-0.2, 0.2),
        "bits": int(random.integers(10, 13)),
        "full_scale": 2.0 * peak,
        "hum": hum * peak * between(0.5, 2.0),
        "mains": random.choice([50.0, 60.0]) + random.normal(0.0, 0.03),
        "resonance": (between(600.0, 1100.0), between(0.01, 0.1)) if rings else None,
    }
    record = record_of(result, seed=seed, **how)
    contacts, touch = waveform(record).contacts, record.attrs["touch"]
    found = []
    for row in rows:
        start, end = float(row["start"]), float(row["end"])
        middle = touch + 0.5 * (start + end)
        contact = min(contacts, key=lambda one: abs(one.peaks[0][0].nominal_value - middle))
        found += [
            ("touch", contact.start, touch + start),
            ("contact time", contact.time, end - start),
            ("impulse", contact.impulse, row["impulse"]),
            ("peak force", contact.peak_force, row["peak_force"]),
        ]
    return found


@cache
def _law(law: Any, exponent: float | None, restitution: float | None) -> sb.Result:
    """Return the run of one ball on a law with the same contact time."""
    shape = {"exponent": exponent, "restitution": restitution}
    given = {name: value for name, value in shape.items() if value is not None}
    made = sb.calibrate(law, mass=MASS, contact_time=TIME, impact_speed=SPEED, **given)
    return sb.simulate(sb.Drop([sb.Ball(MASS)], [made], impact_speed=SPEED))


def _ends(
    seed: int,
    law: Any,
    exponent: float | None = None,
    restitution: float | None = None,
    told: bool = False,
    only: str = "touch release",
    **how: Any,
) -> list[tuple[str, Any, float]]:
    """Return touch and release, or one, of a bounce on a law of any kind, told or not."""
    result = _law(law, exponent, restitution)
    record = record_of(result, seed=seed, **how)
    known: dict[str, Any] = {"law": law, "exponent": exponent} if told else {}
    (contact,) = waveform(record, **known).contacts
    touch = record.attrs["touch"]
    end = touch + float(result.intervals[0]["end"])
    ends = {"touch": (contact.start, touch), "release": (contact.end, end)}
    return [(name, *ends[name]) for name in only.split()]


def _damped(seed: int, law: Any, **how: Any) -> list[tuple[str, Any, float]]:
    """Return touch and release of a contact that is told, with a strong damping or a weak one."""
    restitution = (0.6, 0.7, 0.8, 0.9)[seed % 4]
    return _ends(seed, law=law, restitution=restitution, told=True, **how)


def _gap(seed: int, gap: float, **how: Any) -> list[tuple[str, Any, float]]:
    """Analyse two channels of two balls that fall a gap apart, the lower one on a spring."""
    result = _run(1.0, gap, _EXPONENTS[seed % 5])
    record = record_of(result, seed=seed, contacts=[0, 1], **how)
    later = delay(*(waveform(record[[name]]) for name in record))
    found = gap_from_delay(later, SPEED, contact_time=TIME)
    return [("delay", later, float(result.first_touch[1])), ("gap", found, gap)]


NOISY: dict[str, Any] = {"rate": 5e4, "noise": 2.0}
SCOPE: dict[str, Any] = {
    "rate": 1e5,
    "noise": 0.01,
    "bits": 8,
    "full_scale": 2.0,
    "sensitivity": 0.01,
}
PIEZO: dict[str, Any] = {"rate": 5e4, "noise": 1.0, "time_constant": 0.02, "offset": 3.0}

FINE: dict[str, Any] = {"rate": 2e5, "noise": 0.2}
CONVERTED: dict[str, Any] = {"rate": 4e4, "noise": 0.3, "bits": 10, "full_scale": 200.0}
SQUARE: dict[str, Any] = {"law": sb.PowerLaw, "exponent": 2.0, **CONVERTED}
SLOW: dict[str, Any] = {
    "law": sb.PowerLaw,
    "exponent": 1.75,
    "rate": 1e4,
    "noise": 0.5,
    "before": 0.02,
}
LOSSY: dict[str, Any] = {"law": sb.HuntCrossley, "exponent": 1.5, "restitution": 0.7}
SOFT: dict[str, Any] = {"law": sb.Hysteretic, "exponent": 1.5, "restitution": 0.75}

CASES: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "spring, 1 % noise": partial(_bounce, exponent=1.0, **NOISY),
    "Hertz, 1 % noise": partial(_bounce, exponent=1.5, **NOISY),
    "any law, 8 bits": partial(_bounce, exponent=None, **SCOPE),
    "any law, droop": partial(_bounce, exponent=None, **PIEZO),
    "any law, 30 samples": partial(_bounce, exponent=None, rate=7e3, noise=3.0, before=0.02),
    "any law, hum": partial(_bounce, exponent=None, rate=2e4, noise=2.0, hum=4.0, before=0.05),
    "gap of 1 mm": partial(_gap, gap=1e-3, rate=5e4, noise=1.0),
    "gap of 12 mm": partial(_gap, gap=12e-3, rate=5e4, noise=1.0),
    "exponent 1.25, 0.1 % noise": partial(_bounce, exponent=1.25, **FINE),
    "exponent 2, 10 bits": partial(_ends, **SQUARE, only="touch"),
    "exponent 1.75, 43 samples": partial(_ends, **SLOW, only="touch"),
    "Hunt-Crossley of restitution 0.9": partial(
        _ends, law=sb.HuntCrossley, exponent=1.5, restitution=0.9, **CONVERTED
    ),
    "hysteretic of restitution 0.9": partial(
        _ends, law=sb.Hysteretic, exponent=1.25, restitution=0.9, **CONVERTED
    ),
}
"""Case name to a trial: seed to (quantity, estimate, truth)."""

HUMMING: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "ugly: hum of 3 %": partial(_ugly, leads=(8e-3, 0.06), hum=0.03),
    "ugly: hum of 10 %": partial(_ugly, leads=(8e-3, 0.06), hum=0.1),
    "ugly: hum of 3 %, 3 to 8 ms beside contacts": partial(_ugly, leads=(3e-3, 8e-3), hum=0.03),
}
"""The same with hum, steps, and one bounce or two."""

RINGING: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "ugly: a sensor that rings": partial(_ugly, leads=(5e-3, 0.06), rings=True)
}
"""Records of a sensor that rings at 0.6 to 1.1 kHz, whose errors are on the timid side."""

CASES |= HUMMING

TOLD: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    "told: dashpot": partial(_damped, law=sb.Dashpot, **NOISY),
    "told: viscoelastic": partial(_damped, law=sb.Viscoelastic, **NOISY),
    "told: Hunt-Crossley of restitution 0.7": partial(_ends, **LOSSY, told=True, **NOISY),
    "told: hysteretic of restitution 0.75": partial(
        _ends, **SOFT, told=True, **NOISY, only="touch"
    ),
    "told: exponent 2, 10 bits": partial(_ends, **SQUARE, told=True),
    "told: exponent 1.75, 43 samples": partial(_ends, **SLOW, told=True),
}
"""The same where the law is told."""

CASES |= TOLD

LIMITS: dict[str, Callable[[int], list[tuple[str, Any, float]]]] = {
    **RINGING,
    "exponent 2, 10 bits": partial(_ends, **SQUARE, only="release"),
    "exponent 1.75, 43 samples": partial(_ends, **SLOW, only="release"),
    "Dashpot, a jump at the touch": partial(_ends, law=sb.Dashpot, restitution=0.8, **NOISY),
    "Viscoelastic, a root at the touch": partial(
        _ends, law=sb.Viscoelastic, restitution=0.8, **NOISY
    ),
    "Hunt-Crossley of restitution 0.7": partial(_ends, **LOSSY, **SCOPE),
    "hysteretic of restitution 0.75": partial(_ends, **SOFT, **SCOPE),
    "told: hysteretic, 1 % noise": partial(_ends, **SOFT, **NOISY, told=True, only="release"),
    "told: hysteretic, 8 bits": partial(_ends, **SOFT, **SCOPE, told=True),
    "told: hysteretic, 0.1 % noise": partial(_ends, **SOFT, **FINE, told=True),
    "told: viscoelastic, 0.1 % noise": partial(_damped, law=sb.Viscoelastic, **FINE),
    "told: exponent 2, 0.1 % noise": partial(
        _ends, law=sb.PowerLaw, exponent=2.0, told=True, **FINE
    ),
}
"""Cases in which some errors hold the truth too seldom or too often: not in the tests."""
