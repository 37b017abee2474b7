"""The sixth row of Table II, the tennis ball on the basketball, fitted separately.

Of the basketball only the restitution is known, of the stack the impact duration. The basketball's
contact time and the stiffness between the balls are fitted to three values: both rebound ratios,
from the film, and the duration, from the force record of a lower drop. What else the record shows
is compared and not fitted.
"""

import math
from collections.abc import Mapping
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.data import PAPER
from stackbounce.cross2007.drops import fallen_speed, force_above, pair
from stackbounce.cross2007.stacks import gap_for_delay, stack_masses
from stackbounce.fitting import FitProblem, Model
from stackbounce.model import ContactLaw, HollowBall, HuntCrossley, Hysteretic, Spring
from stackbounce.run.calibration import calibrate
from stackbounce.run.result import Result
from studies.table2 import inputs
from studies.table2.searches import fit_model
from studies.table2.theories import ELASTIC, SHARED

__all__ = [
    "GAPS",
    "HOLLOW",
    "HOLLOW_BOTH",
    "READINGS",
    "THEORIES",
    "Buckling",
    "Limits",
    "Reading",
    "Stack",
    "StackTheory",
    "find_limits",
    "fit_bucklings",
    "fit_stack",
    "fit_stacks",
    "read_restitution",
]

GAPS = (0.0, PAPER["stack.gap"].value)
"""The smallest and the largest gap in m that the paper allows."""

_BENCH = Bench(PAPER)
_MASSES = stack_masses(_BENCH)
_TENNIS_TIME = PAPER["tennis.contact_time"].value
_TIMES = (0.014, 0.040)  # s; a basketball with less comes back to the floor in the 30 ms
_STIFFNESS = {1.0: (2e2, 1e4), 1.5: (2e3, 2e5)}  # N/m**exponent, between the balls
_QUIET, _FAST = 0.03, 0.5  # of the peak: the ball-ball force begins; the floor force has risen
_SHOWN = 0.06  # s: the first impact is over
_ONCE = 0.02  # s: a contact time at which a law is calibrated, and scaled from


class Reading(NamedTuple):
    """What the heights of section III mean.

    `fall` and `recorded` are how far the basketball's bottom falls in the film and for the force
    record, in m; `speed` is the impact speed of the film in m/s; `ratios` are v1/v0 and v2/v0.
    """

    name: str
    fall: float
    recorded: float
    speed: float
    ratios: tuple[float, float]


class Buckling(NamedTuple):
    """When the basketball's wall buckles: part of its contact time, and share of its peak force."""

    part: float = 0.04
    share: float = 0.5


class StackTheory(NamedTuple):
    """Laws of both contacts: at the floor, between the balls, and where the balls lose energy."""

    name: str
    floor: Any
    exponent: float
    where: str
    between: Any


class Stack(NamedTuple):
    """A fit of the basketball's row.

    `contact_time` is that of the basketball alone at the film's impact speed, in s; `stiffness` is
    k of the ball-ball contact, in N/m**exponent; `gap` is in m. `ratios` and `duration`, in s, are
    the fitted values and `chi_squared` is theirs. The others, in s, are of the force record and not
    fitted: `touch` is when the balls touch, `quiet` is when their force passes 3 % of its peak,
    `fast` is when the floor force passes half of its peak, and `parted` is when they
    first part.
    `needed` is the gap in m with which they would touch after the measured 7 ms.
    """

    theory: str
    where: str
    exponent: float
    reading: str
    buckling: Buckling
    gap: float
    contact_time: float
    stiffness: float
    ratios: tuple[float, float]
    duration: float
    chi_squared: float
    touch: float
    quiet: float
    fast: float
    parted: float
    needed: float


def read_restitution(name: str, fall: float = PAPER["stack.drop_height"].value) -> float:
    """Return the restitution of a single ball, from the heights in m that the paper gives."""
    return math.sqrt(PAPER[f"{name}.rebound_height"].value / fall)


def _list_readings() -> tuple[Reading, ...]:
    fall, recorded = PAPER["stack.drop_height"].value, PAPER["fig8.drop_height"].value
    speed, radius = PAPER["stack.impact_speed"].value, 0.5 * PAPER["basketball.diameter"].value
    printed = tuple(PAPER[f"tennis_on_basketball.{one}"].value for one in ("lower", "upper"))
    heights = tuple(
        math.sqrt(PAPER[f"stack.{one}_height"].value / fall) for one in ("lower", "upper")
    )
    return (
        Reading("as printed", fall, recorded, speed, (printed[0], printed[1])),
        Reading("heights only", fall, recorded, fallen_speed(fall), (heights[0], heights[1])),
        Reading("to the centre", fall - radius, recorded - radius, speed, (printed[0], printed[1])),
    )


READINGS = _list_readings()
"""Table II's ratios with a fall of 0.71 m; all ratios from heights over 0.71 m; Table II's ratios
with falls that are 0.08 m shorter, which the printed impact speed fits."""

HOLLOW, HOLLOW_BOTH = "hollow ball", "hollow ball, also between the balls"
"""The names of the theories with a hollow ball at the floor, and in both contacts."""

THEORIES = (
    StackTheory("springs", Spring, 1.0, ELASTIC, Spring),
    StackTheory("hysteresis", Hysteretic, 1.0, ELASTIC, Spring),
    StackTheory("hysteresis", Hysteretic, 1.0, SHARED, Hysteretic),
    StackTheory("Hunt and Crossley", HuntCrossley, 1.0, ELASTIC, HuntCrossley),
    StackTheory("Hunt and Crossley", HuntCrossley, 1.0, SHARED, HuntCrossley),
    StackTheory("Hunt and Crossley", HuntCrossley, 1.5, ELASTIC, HuntCrossley),
    StackTheory("Hunt and Crossley", HuntCrossley, 1.5, SHARED, HuntCrossley),
    StackTheory(HOLLOW, HollowBall, 1.0, ELASTIC, Spring),
    StackTheory(HOLLOW_BOTH, HollowBall, 1.0, ELASTIC, HollowBall),
    StackTheory(HOLLOW_BOTH, HollowBall, 1.0, SHARED, HollowBall),
)
"""All theories; each has the same two fitted numbers."""


class Limits(NamedTuple):
    """What no law can change, for one reading.

    `retained` is the share of all energy that the balls have after the impact, and `most` the share
    that is left if the floor contact loses the share 1 - e**2 of its work, as for the basketball
    alone. `early` is the floor's mean force in N, weighted with the time left, that moves the
    basketball by the largest gap in the measured time without a ball-ball force; `mean` is the
    floor's mean force over the impact.
    """

    reading: str
    retained: float
    most: float
    early: float
    mean: float


def find_limits(reading: Reading) -> Limits:
    """Return the limits that follow from the balls' speeds and the record's times alone.

    Examples
    --------
    >>> limits = find_limits(READINGS[0])
    >>> round(limits.retained, 3), round(limits.most, 3)
    (0.764, 0.704)
    >>> round(limits.early, 1), round(limits.mean, 1)
    (12.2, 26.5)
    """
    masses, ratios = np.array(_MASSES), np.array(reading.ratios)
    kept = np.array([read_restitution("basketball", reading.fall) ** 2, 1.0])
    quiet, duration = PAPER["stack.delay"].value, PAPER["stack.duration"].value
    impulse = fallen_speed(reading.recorded) * masses @ (1.0 + ratios)
    return Limits(
        reading.name,
        float(masses @ ratios**2 / masses.sum()),
        float(masses @ kept / masses.sum()),
        2.0 * _MASSES[0] * GAPS[1] / quiet**2,
        float(impulse / duration),
    )


def fit_stacks() -> list[Stack]:
    """Fit all theories, with each reading and each gap."""
    return [fit_stack(*one) for one in product(THEORIES, READINGS, GAPS)]


def fit_bucklings() -> list[Stack]:
    """Fit the hollow ball at the floor, 2 mm apart, that buckles sooner or later, at less or more.

    Returns
    -------
    list of Stack
        Nine choices of buckling for the readings with Table II's ratios.
    """
    hollow = next(one for one in THEORIES if one.name == HOLLOW)
    choices = [Buckling(*one) for one in product((0.02, 0.04, 0.08), (0.3, 0.5, 0.7))]
    read = READINGS[0], READINGS[2]
    return [fit_stack(hollow, one, GAPS[1], buckling) for one in read for buckling in choices]


def fit_stack(
    theory: StackTheory, reading: Reading, gap: float, buckling: Buckling | None = None
) -> Stack:
    """Fit one theory, with a gap in m; `buckling` concerns the hollow ball only."""
    chosen = buckling or Buckling()
    found = fit_model(_model(theory, reading, gap, chosen), _data(reading))
    film, record = (_BENCH.simulate(found.drops[key]) for key in ("film", "record"))
    best, (lower, upper) = found.best, film.rebound_ratios.tolist()
    return Stack(
        theory.name,
        theory.where,
        theory.exponent,
        reading.name,
        chosen,
        gap,
        best["time"],
        best["between"],
        (lower, upper),
        _first_end(record, 0),
        found.chi_squared,
        *_shown(record),
    )


def _shown(record: Result) -> tuple[float, float, float, float, float]:
    """Return the last five numbers of a `Stack`."""
    return (
        float(record.first_touch[1]),
        force_above(record, 1, _QUIET, _SHOWN)[0],
        force_above(record, 0, _FAST, _SHOWN)[0],
        _first_end(record, 1),
        gap_for_delay(_BENCH, record.drop, PAPER["stack.delay"].value),
    )


def _first_end(result: Result, contact: int) -> float:
    """Return when a contact first opens; both may close again, seconds later."""
    return float(result.intervals[result.intervals["contact"] == contact]["end"][0])


def _data(reading: Reading) -> dict[str, Any]:
    duration = PAPER["stack.duration"]
    return {
        "film": {"rebound_ratios": [(ratio, inputs.ERROR) for ratio in reading.ratios]},
        "record": {"durations.0": (duration.value, duration.spread)},
    }


def _model(theory: StackTheory, reading: Reading, gap: float, buckling: Buckling) -> FitProblem:
    ties = _ties(theory, reading, _floor(theory, reading, buckling))
    middle = {"time": np.array([_ONCE]), "between": np.array([_STIFFNESS[theory.exponent][0]])}
    contacts = []
    for i, law in enumerate((theory.floor, theory.between)):
        own = {name: float(tie(middle)[0]) for (j, name), tie in ties.items() if j == i}
        contacts.append(law(**own, **_fixed(law, theory.exponent)))
    speeds = {"film": reading.speed, "record": fallen_speed(reading.recorded)}
    drops = {key: pair(_MASSES, contacts, speed=one, gap=gap) for key, one in speeds.items()}
    vary = {"time": _TIMES, "between": _STIFFNESS[theory.exponent]}
    tie = {f"{key}.contacts.{i}.{name}": one for key in drops for (i, name), one in ties.items()}
    return Model(drops, vary, tie)


def _fixed(law: Any, exponent: float) -> dict[str, float]:
    return {"exponent": exponent} if law is HuntCrossley else {}


def _floor(theory: StackTheory, reading: Reading, buckling: Buckling) -> ContactLaw:
    """Return the basketball's law for a contact time of 20 ms."""
    options: dict[str, Any] = _fixed(theory.floor, theory.exponent)
    if theory.floor is HollowBall:
        options = {"buckling_time": buckling.part * _ONCE, "buckling_share": buckling.share}
    if theory.floor is not Spring:
        options["restitution"] = read_restitution("basketball", reading.fall)
    found: ContactLaw = calibrate(
        theory.floor,
        mass=_MASSES[0],
        contact_time=_ONCE,
        impact_speed=reading.speed,
        **options,
    )
    return found


def _ties(theory: StackTheory, reading: Reading, floor: Any) -> dict[tuple[int, str], Any]:
    """Return the numbers of both contacts, by contact and name, from those that are fitted.

    With a contact time that is s times as long the stiffness is s**-(p + 1) times as large and the
    compression at which the wall buckles s times; the loss is the same. Both contacts buckle at the
    same force.
    """
    p = theory.exponent

    def slower(values: Mapping[str, Any]) -> Any:
        return values["time"] / _ONCE

    def constant(value: float) -> Any:
        return lambda values: np.full_like(values["time"], value)

    ties: dict[tuple[int, str], Any] = {
        (0, "stiffness"): lambda values: floor.stiffness * slower(values) ** -(p + 1.0),
        (1, "stiffness"): lambda values: values["between"],
    }
    if theory.floor is not Spring:
        ties[0, theory.floor.loss] = constant(getattr(floor, theory.floor.loss))
    if theory.between is not Spring:
        ties[1, theory.between.loss] = _lost(theory, reading, floor)
    if theory.floor is HollowBall:
        force = floor.stiffness * floor.buckling_compression
        ties[0, "stiffness_ratio"] = constant(floor.stiffness_ratio)
        ties[0, "buckling_compression"] = lambda v: floor.buckling_compression * slower(v)
    if theory.between is HollowBall:
        ties[1, "stiffness_ratio"] = ties[0, "stiffness_ratio"]
        ties[1, "buckling_compression"] = lambda v: force / slower(v) / v["between"]
    return ties


def _lost(theory: StackTheory, reading: Reading, floor: Any) -> Any:
    """Return the loss of the ball-ball contact as a function of the fitted numbers.

    The basketball has the share f of the compression and of the work; the rest is the tennis
    ball's. A loss proportional to the compression rate also counts the share of the rate.
    """
    rate = theory.between is HuntCrossley
    tennis: Any = calibrate(
        HuntCrossley if rate else Hysteretic,
        mass=_MASSES[1],
        contact_time=_TENNIS_TIME,
        restitution=read_restitution("tennis", reading.fall),
        impact_speed=reading.speed,
        exponent=theory.exponent,
    )

    def lost(values: Mapping[str, Any]) -> Any:
        if theory.where == ELASTIC:
            return np.full_like(values["between"], 0.0 if rate else 1.0)
        softer = (tennis.stiffness / values["between"]) ** (1.0 / theory.exponent)
        f = np.clip(1.0 - 1.0 / softer, 0.0, 1.0)
        if rate:
            return f**2 * floor.dissipation + (1.0 - f) ** 2 * tennis.dissipation
        return np.sqrt(f * floor.restitution**2 + (1.0 - f) * tennis.restitution**2)

    return lost
