"""The audit's checks of section IV: drops of two superballs, and their force records.

Of the records, the paper measured durations, delays and counts of peaks. Here the models compute
them for the same drops. Stiffnesses that the paper does not give are guesses.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.cross2007 import stacks
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import Two, bisect, peak_times, rigid_pair
from stackbounce.model.drop import Drop
from stackbounce.model.laws import Hertz
from stackbounce.run.collision import contact_time
from stackbounce.run.result import Result


def _stiffness_by_radius(b: Bench) -> float:
    """Return the stiffness over radius that differs most from the mean, over that mean."""
    ratios = (
        b("B1.dynamic_stiffness") / b("B1.diameter"),
        b("B2.dynamic_stiffness") / b("B2.diameter"),
        b("B3.dynamic_stiffness") / b("B3.diameter"),
    )
    mean = sum(ratios) / 3
    return max((ratio / mean for ratio in ratios), key=lambda share: abs(share - 1.0))


def _diameter_ratio(b: Bench) -> float:
    return b("steel.large_diameter") / b("steel.small_diameter")


def _hertz_times(large: float, small: float) -> float:
    """The ratio of the collision times of two pairs of steel balls at 1 m/s, from diameters."""
    times = [contact_time(Hertz(d**0.5), d**3, 1.0) for d in (large, small)]
    return times[0] / times[1]


def _apart(b: Bench, masses: Two, restitution: str) -> Result:
    """Separate collisions of two superballs with impact speed 1 m/s and one restitution."""
    return b.simulate(rigid_pair(masses, b(restitution)))


def _light_on_heavy(b: Bench, heavy: float) -> Result:
    return _apart(b, (heavy, b("B2.mass")), "fit.restitution")


def _heavy_on_light(b: Bench, heavy: float, restitution: str) -> Result:
    return _apart(b, (b("B2.mass"), heavy), restitution)


def _heavy_on_small(b: Bench, heavy: float) -> Result:
    return _apart(b, (b("B3.mass"), heavy), "fit.B3_restitution")


def _with_ratio(b: Bench) -> Result:
    """B2 on B1 with the mass ratio that Table II prints."""
    return _apart(b, (b("B2_on_B1.mass_ratio"), 1.0), "fit.restitution")


def _restitution_for_71(b: Bench) -> float:
    """Return the restitution with which B1 of 105 g bounces to the measured height on B2."""
    masses = b("B2.mass"), stacks.heavier_b1(b)

    def excess(restitution: float) -> float:
        upper = float(b.simulate(rigid_pair(masses, restitution)).rebound_ratios[1])
        return upper**2 - b("B1_on_B2.upper_height")

    return bisect(excess, 0.8, 1.0)


def _while_meeting(contacts: NDArray[Any]) -> int:
    """How many collisions there are from the first to the last ball-ball one."""
    met = np.flatnonzero(contacts == 1)
    return int(met[-1] - met[0]) + 1


def _fewest_collisions(b: Bench) -> int:
    masses = b("B3.mass"), b("B1.mass")
    steps = [0.05 * step for step in range(2, 21)]
    drops = [rigid_pair(masses, floor, between=between) for floor in steps for between in steps]
    counts = [b.simulate(drop).collisions for drop in drops]
    return min(sum(count) for count in counts if min(count) >= 0)  # -1 stands for infinitely many


def _twins(b: Bench) -> Result:
    """Two large balls as separate collisions with one restitution."""
    return _apart(b, (b("B1_on_B1.mass_ratio"), 1.0), "fit.twin_restitution")


def _split_twins(b: Bench, ratio: float) -> Result:
    """Two large balls as separate collisions, each contact with its restitution."""
    return b.simulate(rigid_pair((ratio, 1.0), b("fit.twin_floor"), between=b("fit.twin_balls")))


def _delayed(b: Bench, drop: Drop) -> Drop:
    """The drop with the gap for the measured delay of 2 ms."""
    return drop.replace(gaps=(stacks.gap_for_delay(b, drop, b("superballs.delay")),))


def _nearer(drop: Drop) -> Drop:
    """The drop with the smallest gap that rounds to the printed one."""
    return drop.replace(gaps=(drop.gaps[0] - 0.05e-3,))


def _subpeaks(result: Result) -> int:
    return len(peak_times(result, 1, result.end_time))


def _one_mm_apart(b: Bench) -> Drop:
    return stacks.reversed_pair(b, b("superballs.gap"))


_REVERSED: dict[str, tuple[str, int]] = {
    "IV.reversed_apart_B1": ("fit.restitution", 1),
    "IV.reversed_apart_B2": ("fit.restitution", 0),
    "IV.better_B1": ("fit.reversed_restitution", 1),
    "IV.better_B2": ("fit.reversed_restitution", 0),
}
"""The claims on a bounce height of B1 on B2 by separate collisions: the restitution, the ball."""


def _reversed_height(restitution: str, ball: int) -> Compute:
    return lambda b: _heavy_on_light(b, b("B1.mass"), restitution).rebound_ratios[ball] ** 2


def _reversed_with_105(restitution: str, ball: int) -> Compute:
    return lambda b: _heavy_on_light(b, stacks.heavier_b1(b), restitution).rebound_ratios[ball] ** 2


COMPUTED: dict[str, Compute] = {
    "IV.stiffness_by_radius": _stiffness_by_radius,
    "IV.steel_diameters": _diameter_ratio,
    "IV.steel_masses": lambda b: _diameter_ratio(b) ** 3,
    "IV.steel_times": lambda b: _hertz_times(b("steel.large_diameter"), b("steel.small_diameter")),
    "IV.steel_stiffness": lambda b: b("steel.mass_ratio") / b("steel.time_ratio") ** 2,
    "IV.B2_height": lambda b: b("B2_on_B1.upper") ** 2,
    "IV.B1_height": lambda b: b("B2_on_B1.lower") ** 2,
    "IV.reversed_B1_height": lambda b: b("B1_on_B2.upper") ** 2,
    "IV.reversed_B2_height": lambda b: b("B1_on_B2.lower") ** 2,
    "IV.apart_B2": lambda b: _light_on_heavy(b, b("B1.mass")).rebound_ratios[1] ** 2,
    "IV.apart_B1": lambda b: _light_on_heavy(b, b("B1.mass")).rebound_ratios[0] ** 2,
    "IV.reversed_count": lambda b: _heavy_on_light(b, b("B1.mass"), "fit.restitution").collisions[
        1
    ],
    "IV.better_count": lambda b: _heavy_on_light(
        b, b("B1.mass"), "fit.reversed_restitution"
    ).collisions[1],
    **{name: _reversed_height(*given) for name, given in _REVERSED.items()},
    "IV.small_count": lambda b: sum(_heavy_on_small(b, b("B1.mass")).collisions),
    "IV.small_B1": lambda b: _heavy_on_small(b, b("B1.mass")).rebound_ratios[1] ** 2,
    "IV.small_B3": lambda b: _heavy_on_small(b, b("B1.mass")).rebound_ratios[0] ** 2,
    "IV.twin_lower": lambda b: _twins(b).rebound_ratios[0],
    "IV.twin_upper": lambda b: _twins(b).rebound_ratios[1],
    "IV.twin_split_lower": lambda b: _split_twins(b, b("B1_on_B1.mass_ratio")).rebound_ratios[0],
    "IV.twin_split_upper": lambda b: _split_twins(b, b("B1_on_B1.mass_ratio")).rebound_ratios[1],
    "IV.record_delay": lambda b: b.simulate(stacks.small_fit(b, b("B1.mass"))).first_touch[1],
    "IV.record_gap": lambda b: stacks.gap_for_delay(
        b, stacks.small_fit(b, b("B1.mass")), b("superballs.delay")
    ),
    "IV.record_reversed_gap": lambda b: stacks.gap_for_delay(
        b, stacks.reversed_pair(b, 0.0), b("superballs.delay")
    ),
    "IV.record_duration": lambda b: max(b.simulate(stacks.small_fit(b, b("B1.mass"))).last_release),
    "IV.record_reversed_duration": lambda b: max(b.simulate(_one_mm_apart(b)).last_release),
    "IV.record_B3_delay": lambda b: b.simulate(stacks.smallest_fit(b, b("B1.mass"))).first_touch[1],
    "IV.record_peaks": lambda b: b.simulate(stacks.late_pair(b)).collisions[1],
    "IV.record_merged": lambda b: b.simulate(stacks.early_pair(b)).collisions[1],
    "IV.record_subpeaks": lambda b: _subpeaks(b.simulate(stacks.early_pair(b))),
    "IV.record_twin_late_duration": lambda b: b.simulate(stacks.parted_twins(b)).last_release[0],
    "IV.record_twin_duration": lambda b: b.simulate(stacks.early_twins(b)).last_release[0],
}


def _velocity_ratios(ball: int) -> tuple[Compute, ...]:
    """Return readings of a bounce height of B1 on B3 as the ratio of velocities."""
    return (
        lambda b: _heavy_on_small(b, b("B1.mass")).rebound_ratios[ball],
        lambda b: _heavy_on_small(b, stacks.heavier_b1(b)).rebound_ratios[ball],
    )


READINGS: dict[str, tuple[Compute, ...]] = {
    "IV.steel_times": (
        lambda b: _hertz_times(b("steel.large_diameter") - 5e-5, b("steel.small_diameter") + 5e-5),
    ),
    "IV.apart_B2": (
        lambda b: _light_on_heavy(b, stacks.heavier_b1(b)).rebound_ratios[1] ** 2,
        lambda b: _with_ratio(b).rebound_ratios[1] ** 2,
    ),
    "IV.apart_B1": (lambda b: _light_on_heavy(b, stacks.heavier_b1(b)).rebound_ratios[0] ** 2,),
    **{name: (_reversed_with_105(*given),) for name, given in _REVERSED.items()},
    "IV.better_B1": (_reversed_with_105("fit.reversed_restitution", 1), _restitution_for_71),
    "IV.small_count": (
        lambda b: _while_meeting(_heavy_on_small(b, b("B1.mass")).events["contact"]),
        lambda b: _while_meeting(_heavy_on_small(b, stacks.heavier_b1(b)).events["contact"]),
        lambda b: _while_meeting(b.simulate(stacks.late_pair(b)).intervals["contact"]),
        lambda b: sum(_heavy_on_small(b, stacks.heavier_b1(b)).collisions),
        _fewest_collisions,
    ),
    "IV.small_B1": _velocity_ratios(1),
    "IV.small_B3": _velocity_ratios(0),
    "IV.twin_split_lower": (lambda b: _split_twins(b, 1.0).rebound_ratios[0],),
    "IV.twin_split_upper": (lambda b: _split_twins(b, 1.0).rebound_ratios[1],),
    "IV.record_reversed_gap": (
        lambda b: stacks.gap_for_delay(
            b, stacks.reversed_pair(b, 0.0), b("superballs.delay") - 0.5e-3
        ),
    ),
    "IV.record_reversed_duration": (
        lambda b: b.simulate(_one_mm_apart(b)).last_release[1],
        lambda b: b.simulate(_delayed(b, stacks.reversed_pair(b, 0.0))).last_release[0],
        lambda b: b.simulate(stacks.stiffen(_one_mm_apart(b))).last_release[0],
        lambda b: max(b.simulate(stacks.stiffen(_one_mm_apart(b))).last_release),
        lambda b: b.simulate(
            _delayed(b, stacks.stiffen(stacks.reversed_pair(b, 0.0)))
        ).last_release[0],
    ),
    "IV.record_B3_delay": (
        lambda b: b.simulate(_nearer(stacks.smallest_fit(b, b("B1.mass")))).first_touch[1],
    ),
    "IV.record_twin_late_duration": (
        lambda b: b.simulate(stacks.stiffen(stacks.parted_twins(b))).last_release[0],
        lambda b: b.simulate(
            stacks.twin_pair(b, stacks.gap_for_delay(b, stacks.twin_pair(b, 0.0), 3.8e-3))
        ).last_release[0],
    ),
}
