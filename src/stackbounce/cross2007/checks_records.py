"""The audit's checks of what section IV reads off the force records: durations and delays.

The paper measured these numbers. Here the models give them for the same drops, so that a reader
sees how far each model goes; the stiffnesses that the paper does not give are guesses.
"""

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Number, Section
from stackbounce.cross2007.stacks import (
    early_twins,
    gap_for_delay,
    reversed_pair,
    small_fit,
    smallest_fit,
    stiffening,
)

__all__ = ["RECORDS"]

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
    reason="The lighter ball turns round sooner, so that the same delay takes a larger gap; 1 mm "
    "gives a shorter delay than the 2 ms that the text reports for either order.",
)
def _(b: Bench) -> Number:
    return gap_for_delay(b, reversed_pair(b, 0.0), b("superballs.delay"))


@RECORDS.other("delay in ms of a 1 mm gap, against 2", number="2")
def _(b: Bench) -> Number:
    return b.simulate(reversed_pair(b, b("superballs.gap"))).first_touch[1]


@RECORDS.check(
    "IV.record_duration",
    "impact duration of B2 on B1, by section V's model",
    "6.0",
    "ms",
    where="Sec. IV, Fig. 10a",
    reason="A measured duration; the model's fades out softly, and its two stiffnesses leave this "
    "open.",
)
def _(b: Bench) -> Number:
    return max(b.simulate(small_fit(b, b("B1.mass"))).last_release)


@RECORDS.check(
    "IV.record_reversed_duration",
    "impact duration of B1 on B2",
    "9.0",
    "ms",
    where="Sec. IV, Fig. 10b",
    reason="Linear springs with the stiffnesses of Table I and Fig. 13 are too soft here. They "
    "were found with the small ball's own weight; with the large ball on it, it is compressed "
    "further, and real contacts stiffen. Hertz's law with the same contact times gives the "
    "measured duration.",
)
def _(b: Bench) -> Number:
    return b.simulate(reversed_pair(b, b("superballs.gap"))).last_release[0]


@RECORDS.other("end of the ball-ball force")
def _(b: Bench) -> Number:
    return b.simulate(reversed_pair(b, b("superballs.gap"))).last_release[1]


@RECORDS.other("with Hertz's law, the same contact times at the impact speed")
def _(b: Bench) -> Number:
    return b.simulate(stiffening(b, reversed_pair(b, b("superballs.gap")))).last_release[0]


@RECORDS.check(
    "IV.record_B3_delay",
    "delay of B3 on B1 at section V's 2.4 mm",
    "2",
    "ms",
    where="Sec. IV, Fig. 11a",
    reason="The text has 'about 2 ms'; with the gap of 2.4 mm, chosen to fit the bounce, it is "
    "2.5 ms.",
)
def _(b: Bench) -> Number:
    return b.simulate(smallest_fit(b, b("B1.mass"))).first_touch[1]


@RECORDS.check(
    "IV.record_twin_duration",
    "impact duration of two large balls that meet after 1 ms",
    "9",
    "ms",
    where="Sec. IV, Fig. 12, text",
)
def _(b: Bench) -> Number:
    return b.simulate(early_twins(b)).last_release[0]
