"""The audit's checks of section IV's force records: durations, delays and counts of peaks.

The paper measured these numbers. Here the models compute them for the same drops. Stiffnesses that
the paper does not give are guesses.
"""

from dataclasses import replace

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Number, Section
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

RECORDS = Section("Sec. IV")


@RECORDS.check(
    "IV.record_delay",
    "delay of B2 on B1, if 1 mm apart",
    "2",
    "ms",
    where="Sec. IV, Fig. 10a",
)
def _(b: Bench) -> Number:
    return b.simulate(small_fit(b, b("B1.mass"))).first_touch[1]


@RECORDS.check(
    "IV.record_gap",
    "separation of B2 from B1 that gives the delay of 2 ms",
    "1",
    "mm",
    where="Sec. IV, Fig. 10a",
)
def _(b: Bench) -> Number:
    return gap_for_delay(b, small_fit(b, b("B1.mass")), b("superballs.delay"))


@RECORDS.check(
    "IV.record_reversed_gap",
    "separation of B1 from B2 below it that gives the delay of 2 ms",
    "1",
    "mm",
    where="Sec. IV, Fig. 10b",
    reason="No agreement: the gap is 2.9 times the printed one. The text has about 2 ms and about "
    "1 mm for either order, but a lighter lower ball rebounds sooner, so that the same delay "
    "requires a larger gap. The gap is 1 mm only if the delay is 1.5 ms, which rounds to 2 ms.",
)
def _(b: Bench) -> Number:
    return gap_for_delay(b, reversed_pair(b, 0.0), b("superballs.delay"))


RECORDS.other(
    "for 1.5 ms, the shortest delay that rounds to 2 ms",
    lambda b: gap_for_delay(b, reversed_pair(b, 0.0), b("superballs.delay") - 0.5e-3),
)


@RECORDS.check(
    "IV.record_duration",
    "impact duration of B2 on B1, to the end of the last contact, by section V's model",
    "6.0",
    "ms",
    where="Sec. IV, Fig. 10a",
    reason="The printed duration was measured. The model's force decreases gradually, and its two "
    "stiffnesses do not determine the duration.",
)
def _(b: Bench) -> Number:
    return max(b.simulate(small_fit(b, b("B1.mass"))).last_release)


def _delayed(b: Bench, drop: Drop) -> Drop:
    """The drop with the gap for the measured delay of 2 ms."""
    return replace(drop, gaps=(gap_for_delay(b, drop, b("superballs.delay")),))


@RECORDS.check(
    "IV.record_reversed_duration",
    "impact duration of B1 on B2, to the end of the last contact",
    "9.0",
    "ms",
    where="Sec. IV, Fig. 10b",
    reason="Linear springs with the stiffnesses of Table I and Fig. 13 are too soft here. They "
    "were found with the small ball's own weight; with the large ball on it, it is compressed "
    "further, and real contacts stiffen. With Hertz's law and the same contact times the floor "
    "force, which P1 records, ends at 9.0 ms if the gap is 1 mm. But just before that the balls "
    "touch once more, weakly, until 13.7 ms, and with the gap of the measured 2 ms delay the floor "
    "force ends later. So stiffening shortens the impact; that it meets 9.0 ms proves little.",
)
def _(b: Bench) -> Number:
    return max(b.simulate(reversed_pair(b, b("superballs.gap"))).last_release)


RECORDS.other(
    "on springs, end of the ball-ball force",
    lambda b: b.simulate(reversed_pair(b, b("superballs.gap"))).last_release[1],
)
RECORDS.other(
    "on springs, end of the floor force, with the gap of the 2 ms delay",
    lambda b: b.simulate(_delayed(b, reversed_pair(b, 0.0))).last_release[0],
)
RECORDS.other(
    "Hertz's law, end of the floor force",
    lambda b: b.simulate(stiffen(b, reversed_pair(b, b("superballs.gap")))).last_release[0],
)
RECORDS.other(
    "Hertz's law, end of the last contact",
    lambda b: max(b.simulate(stiffen(b, reversed_pair(b, b("superballs.gap")))).last_release),
)
RECORDS.other(
    "Hertz's law, end of the floor force, with the gap of the 2 ms delay",
    lambda b: b.simulate(_delayed(b, stiffen(b, reversed_pair(b, 0.0)))).last_release[0],
)


@RECORDS.check(
    "IV.record_B3_delay",
    "delay of B3 on B1 at section V's 2.4 mm",
    "2",
    "ms",
    where="Sec. IV, Fig. 11a",
    reason="The text has 'also about 2 ms'; the gap of 2.4 mm was chosen to fit the bounce, and "
    "makes half a millisecond more.",
)
def _(b: Bench) -> Number:
    return b.simulate(smallest_fit(b, b("B1.mass"))).first_touch[1]


def _nearer(drop: Drop) -> Drop:
    """The drop with the smallest gap that rounds to the printed one."""
    return replace(drop, gaps=(drop.gaps[0] - 0.05e-3,))


RECORDS.other(
    "with 2.35 mm, the smallest gap that rounds to 2.4 mm",
    lambda b: b.simulate(_nearer(smallest_fit(b, b("B1.mass")))).first_touch[1],
)


@RECORDS.check(
    "IV.record_peaks",
    "ball-ball collisions, B1 on B3, on springs that meet at 7 ms: a first and the 'last four'",
    "five",
    number="5",
    counted=True,
    where="Sec. IV, Fig. 11b",
    reason="The text says only that there are four last peaks, hence at least five.",
)
def _(b: Bench) -> Number:
    return b.simulate(late_pair(b)).collisions[1]


@RECORDS.check(
    "IV.record_merged",
    "ball-ball collisions, B1 on B3, when they meet at 2 ms: the peaks merge",
    "one",
    number="1",
    counted=True,
    where="Sec. IV, Fig. 11b",
)
def _(b: Bench) -> Number:
    return b.simulate(early_pair(b)).collisions[1]


@RECORDS.check(
    "IV.record_subpeaks",
    "peaks of the ball-ball force in that one collision",
    "four",
    number="4",
    counted=True,
    where="Sec. IV, Fig. 11b",
    reason="The text has the last four peaks in it; here there is no first one beside them.",
)
def _(b: Bench) -> Number:
    merged = b.simulate(early_pair(b))
    return len(peak_times(merged, 1, merged.end_time))


@RECORDS.check(
    "IV.record_twin_late_duration",
    "impact duration of two large balls that meet as the lower one leaves the floor",
    "12",
    "ms",
    where="Sec. IV, Fig. 12, text",
    reason="Section VI has the lower ball off the floor before it meets the upper one. On springs "
    "such an impact lasts longer than 12 ms; by Hertz's law with the same contact times it does, "
    "too. With 12 ms the balls touch 0.6 ms before the lower one would leave; the 3.8 ms were "
    "chosen to fit.",
)
def _(b: Bench) -> Number:
    return b.simulate(parted_twins(b)).last_release[0]


RECORDS.other("by Hertz's law", lambda b: b.simulate(stiffen(b, parted_twins(b))).last_release[0])
RECORDS.other(
    "on springs, if they meet after 3.8 ms",
    lambda b: b.simulate(twin_pair(b, gap_for_delay(b, twin_pair(b, 0.0), 3.8e-3))).last_release[0],
)


@RECORDS.check(
    "IV.record_twin_duration",
    "impact duration of two large balls that meet after 1 ms",
    "9",
    "ms",
    where="Sec. IV, Fig. 12, text",
)
def _(b: Bench) -> Number:
    return b.simulate(early_twins(b)).last_release[0]
