"""The audit's checks of section IV's force records: durations, delays and counts of peaks.

The paper measured these numbers. Here the models compute them for the same drops. Stiffnesses that
the paper does not give are guesses.
"""

from dataclasses import replace

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import peak_times
from stackbounce.cross2007.stacks import (
    early_pair,
    early_twins,
    gap_for_delay,
    late_pair,
    parted_twins,
    reversed_pair,
    small_fit,
    smallest_fit,
    stiffen,
    twin_pair,
)
from stackbounce.model.drop import Drop
from stackbounce.run.result import Result


def _delayed(b: Bench, drop: Drop) -> Drop:
    """The drop with the gap for the measured delay of 2 ms."""
    return replace(drop, gaps=(gap_for_delay(b, drop, b("superballs.delay")),))


def _nearer(drop: Drop) -> Drop:
    """The drop with the smallest gap that rounds to the printed one."""
    return replace(drop, gaps=(drop.gaps[0] - 0.05e-3,))


def _subpeaks(result: Result) -> int:
    return len(peak_times(result, 1, result.end_time))


def _one_mm_apart(b: Bench) -> Drop:
    return reversed_pair(b, b("superballs.gap"))


COMPUTED: dict[str, Compute] = {
    "IV.record_delay": lambda b: b.simulate(small_fit(b, b("B1.mass"))).first_touch[1],
    "IV.record_gap": lambda b: gap_for_delay(b, small_fit(b, b("B1.mass")), b("superballs.delay")),
    "IV.record_reversed_gap": lambda b: gap_for_delay(
        b, reversed_pair(b, 0.0), b("superballs.delay")
    ),
    "IV.record_duration": lambda b: max(b.simulate(small_fit(b, b("B1.mass"))).last_release),
    "IV.record_reversed_duration": lambda b: max(b.simulate(_one_mm_apart(b)).last_release),
    "IV.record_B3_delay": lambda b: b.simulate(smallest_fit(b, b("B1.mass"))).first_touch[1],
    "IV.record_peaks": lambda b: b.simulate(late_pair(b)).collisions[1],
    "IV.record_merged": lambda b: b.simulate(early_pair(b)).collisions[1],
    "IV.record_subpeaks": lambda b: _subpeaks(b.simulate(early_pair(b))),
    "IV.record_twin_late_duration": lambda b: b.simulate(parted_twins(b)).last_release[0],
    "IV.record_twin_duration": lambda b: b.simulate(early_twins(b)).last_release[0],
}

READINGS: dict[str, tuple[Compute, ...]] = {
    "IV.record_reversed_gap": (
        lambda b: gap_for_delay(b, reversed_pair(b, 0.0), b("superballs.delay") - 0.5e-3),
    ),
    "IV.record_reversed_duration": (
        lambda b: b.simulate(_one_mm_apart(b)).last_release[1],
        lambda b: b.simulate(_delayed(b, reversed_pair(b, 0.0))).last_release[0],
        lambda b: b.simulate(stiffen(b, _one_mm_apart(b))).last_release[0],
        lambda b: max(b.simulate(stiffen(b, _one_mm_apart(b))).last_release),
        lambda b: b.simulate(_delayed(b, stiffen(b, reversed_pair(b, 0.0)))).last_release[0],
    ),
    "IV.record_B3_delay": (
        lambda b: b.simulate(_nearer(smallest_fit(b, b("B1.mass")))).first_touch[1],
    ),
    "IV.record_twin_late_duration": (
        lambda b: b.simulate(stiffen(b, parted_twins(b))).last_release[0],
        lambda b: b.simulate(
            twin_pair(b, gap_for_delay(b, twin_pair(b, 0.0), 3.8e-3))
        ).last_release[0],
    ),
}
