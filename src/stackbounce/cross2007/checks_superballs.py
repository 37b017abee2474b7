"""The audit's checks of section IV's text: drops of two superballs."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Number, Section
from stackbounce.cross2007.checks_tables import WITH_105
from stackbounce.cross2007.drops import Two, bisect, rigid_pair
from stackbounce.cross2007.stacks import heavier_b1, late_pair
from stackbounce.model.laws import Hertz
from stackbounce.run.collision import contact_time
from stackbounce.run.result import Result

STEEL = Section("Sec. IV")
SUPERBALLS = Section("Sec. IV")


@STEEL.check(
    "IV.stiffness_by_radius",
    "dynamic stiffness over radius, of the ball that is furthest from the mean of the three",
    "proportional",
    number="1.0",
    reason="The mean is 1. 'To a good approximation' is read as 5 %: B1, B2 and B3 have 0.0931, "
    "0.0947 and 0.0885 kN/m for each mm of diameter.",
)
def _(b: Bench) -> Number:
    ratios = (
        b("B1.dynamic_stiffness") / b("B1.diameter"),
        b("B2.dynamic_stiffness") / b("B2.diameter"),
        b("B3.dynamic_stiffness") / b("B3.diameter"),
    )
    mean = sum(ratios) / 3
    return max((ratio / mean for ratio in ratios), key=lambda share: abs(share - 1.0))


@STEEL.check("IV.steel_diameters", "ratio of the steel balls' diameters", "1.411")
def _(b: Bench) -> Number:
    return b("steel.large_diameter") / b("steel.small_diameter")


@STEEL.check(
    "IV.steel_masses",
    "ratio of the steel balls' masses, as the cube of their diameters' ratio",
    "2.815",
    reason="The masses were weighed, not computed; the diameters, to 0.1 mm, agree with them.",
)
def _(b: Bench) -> Number:
    return (b("steel.large_diameter") / b("steel.small_diameter")) ** 3


def _hertz_times(large: float, small: float) -> float:
    """The ratio of the collision times of two pairs of steel balls at 1 m/s, from diameters."""
    times = [contact_time(Hertz(d**0.5), d**3, 1.0) for d in (large, small)]
    return times[0] / times[1]


@STEEL.check(
    "IV.steel_times",
    "ratio of the steel balls' collision times, by Hertz's law at equal speeds",
    "1.407",
    reason="By Hertz's law the time is proportional to the diameter, like the printed 1.411. "
    "Diameters at the edge of what rounds to the printed ones give 1.407. So would a speed of the "
    "larger balls that is higher by 1.5 %; the paper does not give the speeds.",
)
def _(b: Bench) -> Number:
    return _hertz_times(b("steel.large_diameter"), b("steel.small_diameter"))


STEEL.other(
    "with 38.05 and 27.05 mm, which round to the printed diameters",
    lambda b: _hertz_times(b("steel.large_diameter") - 5e-5, b("steel.small_diameter") + 5e-5),
)


@STEEL.check("IV.steel_stiffness", "ratio of the steel balls' dynamic stiffnesses", "1.422")
def _(b: Bench) -> Number:
    return b("steel.mass_ratio") / b("steel.time_ratio") ** 2


@SUPERBALLS.check("IV.B2_height", "B2's bounce on B1 over the drop height", "3.65")
def _(b: Bench) -> Number:
    return b("B2_on_B1.upper") ** 2


@SUPERBALLS.check("IV.B1_height", "B1's bounce under B2", "8", "%")
def _(b: Bench) -> Number:
    return b("B2_on_B1.lower") ** 2


@SUPERBALLS.check("IV.reversed_B1_height", "B1's bounce on B2", "71", "%")
def _(b: Bench) -> Number:
    return b("B1_on_B2.upper") ** 2


@SUPERBALLS.check(
    "IV.reversed_B2_height",
    "B2's bounce under B1",
    "3.3",
    "%",
    reason="0.17 squared is 2.9 %. Within the error of 0.02 the two agree; a mean of squares over "
    "unequal bounces also lies above the square of the mean.",
)
def _(b: Bench) -> Number:
    return b("B1_on_B2.lower") ** 2


def _apart(b: Bench, masses: Two, restitution: str) -> Result:
    """Separate collisions of two superballs with impact speed 1 m/s and one restitution."""
    return b.simulate(rigid_pair(masses, b(restitution)))


def _light_on_heavy(b: Bench, heavy: float) -> Result:
    return _apart(b, (heavy, b("B2.mass")), "fit.restitution")


_REASON_3_68 = (
    "Table I's 101 g give less. With the mass ratio that Table II prints, the height agrees within "
    "the error of that ratio."
)


@SUPERBALLS.check("IV.apart_B2", "B2's bounce on B1, e = 0.90", "3.68", reason=_REASON_3_68)
def _(b: Bench) -> Number:
    return _light_on_heavy(b, b("B1.mass")).rebound_ratios[1] ** 2


SUPERBALLS.other(WITH_105, lambda b: _light_on_heavy(b, heavier_b1(b)).rebound_ratios[1] ** 2)
SUPERBALLS.other(
    "with the printed mass ratio 4.23",
    lambda b: _apart(b, (b("B2_on_B1.mass_ratio"), 1.0), "fit.restitution").rebound_ratios[1] ** 2,
)


@SUPERBALLS.check(
    "IV.apart_B1",
    "B1's bounce under B2, e = 0.90",
    "4",
    "%",
    reason="Both masses of B1 give it. The lower ball leaves upward after one collision.",
)
def _(b: Bench) -> Number:
    return _light_on_heavy(b, b("B1.mass")).rebound_ratios[0] ** 2


SUPERBALLS.other(WITH_105, lambda b: _light_on_heavy(b, heavier_b1(b)).rebound_ratios[0] ** 2)


def _heavy_on_light(b: Bench, heavy: float, restitution: str) -> Result:
    return _apart(b, (b("B2.mass"), heavy), restitution)


@SUPERBALLS.check(
    "IV.reversed_count",
    "ball-ball collisions, B1 on B2, e = 0.90",
    "three",
    number="3",
    counted=True,
)
def _(b: Bench) -> Number:
    return _heavy_on_light(b, b("B1.mass"), "fit.restitution").collisions[1]


def _check_reversed(
    name: str,
    what: str,
    printed: str,
    restitution: str,
    ball: int,
    *,
    number: str = "",
    reason: str = "Again the heavier B1 fits.",
) -> None:
    """Add a bounce height of B1 on B2, separate collisions, with B1 of 101 g and of 105 g."""
    SUPERBALLS.check(name, what, printed, "%", number=number, reason=reason)(
        lambda b: _heavy_on_light(b, b("B1.mass"), restitution).rebound_ratios[ball] ** 2
    )
    SUPERBALLS.other(
        WITH_105,
        lambda b: _heavy_on_light(b, heavier_b1(b), restitution).rebound_ratios[ball] ** 2,
    )


_check_reversed("IV.reversed_apart_B1", "B1's bounce on B2, e = 0.90", "59", "fit.restitution", 1)
_check_reversed(
    "IV.reversed_apart_B2",
    "B2's bounce under B1, e = 0.90",
    "essentially zero",
    "fit.restitution",
    0,
    number="0",
)


@SUPERBALLS.check(
    "IV.better_count", "ball-ball collisions, B1 on B2, e = 0.92", "three", number="3", counted=True
)
def _(b: Bench) -> Number:
    return _heavy_on_light(b, b("B1.mass"), "fit.reversed_restitution").collisions[1]


_check_reversed(
    "IV.better_B1",
    "B1's bounce on B2, e = 0.92",
    "71",
    "fit.reversed_restitution",
    1,
    reason="Neither mass of B1 gives 71 %, which is the measured height. It is very sensitive: the "
    "restitution that does give it still rounds to 0.92.",
)


def _restitution_for_71(b: Bench) -> float:
    """Return the restitution with which B1 of 105 g bounces to the measured height on B2."""
    masses = b("B2.mass"), heavier_b1(b)

    def excess(restitution: float) -> float:
        upper = float(b.simulate(rigid_pair(masses, restitution)).rebound_ratios[1])
        return upper**2 - b("B1_on_B2.upper_height")

    return bisect(excess, 0.8, 1.0)


SUPERBALLS.other(
    "the restitution that gives 71 % " + WITH_105 + ", against 0.92",
    _restitution_for_71,
    number="92",
)
_check_reversed(
    "IV.better_B2", "B2's bounce under B1, e = 0.92", "0.1", "fit.reversed_restitution", 0
)


def _heavy_on_small(b: Bench, heavy: float) -> Result:
    return _apart(b, (b("B3.mass"), heavy), "fit.B3_restitution")


@SUPERBALLS.check(
    "IV.small_count",
    "collisions of B3 with floor and B1, e = 0.88",
    "nine",
    number="9",
    counted=True,
    reason="Eqs 1 to 4 give six floor and five ball-ball collisions with either mass of B1, and no "
    "two restitutions give fewer: with more loss the count goes up, without end in the end. From "
    "the first to the last ball-ball collision there are nine: five with B1 and the four floor "
    "collisions between them. Left out are the first bounce, which eqs 1 and 2 take as given, and "
    "the last one, after the balls have parted for good. That agrees with the text's 'last four' "
    "ball-ball peaks, which follow a first one; that it counted so is a guess.",
)
def _(b: Bench) -> Number:
    return sum(_heavy_on_small(b, b("B1.mass")).collisions)


def _while_meeting(contacts: NDArray[Any]) -> int:
    """How many collisions there are from the first to the last ball-ball one."""
    met = np.flatnonzero(contacts == 1)
    return int(met[-1] - met[0]) + 1


SUPERBALLS.other(
    "from the first to the last ball-ball collision",
    lambda b: _while_meeting(_heavy_on_small(b, b("B1.mass")).events["contact"]),
)
SUPERBALLS.other(
    "the same, " + WITH_105,
    lambda b: _while_meeting(_heavy_on_small(b, heavier_b1(b)).events["contact"]),
)
SUPERBALLS.other(
    "the same, on springs that meet at the measured 7 ms",
    lambda b: _while_meeting(b.simulate(late_pair(b)).intervals["contact"]),
)
SUPERBALLS.other("all, " + WITH_105, lambda b: sum(_heavy_on_small(b, heavier_b1(b)).collisions))


def _fewest_collisions(b: Bench) -> int:
    masses = b("B3.mass"), b("B1.mass")
    steps = [0.05 * step for step in range(2, 21)]
    drops = [rigid_pair(masses, floor, between=between) for floor in steps for between in steps]
    counts = [b.simulate(drop).collisions for drop in drops]
    return min(sum(count) for count in counts if min(count) >= 0)  # -1 stands for infinitely many


SUPERBALLS.other(
    "all, the fewest for two restitutions from 0.10 to 1.00, in steps of 0.05", _fewest_collisions
)


_RATIO_NOT_HEIGHT = (
    "A likely reading, not a proven one. If it is right, the text's 'very good agreement' is with "
    "the wrong column of Table II: it measured the ratios 0.70 (B1) and 0.51 (B3), whose squares "
    "are the heights 0.49 and 0.26, and the calculated ratios are 0.487 and 0.300."
)


def _check_small(name: str, what: str, printed: str, ball: int, reason: str) -> None:
    """Add a bounce height of B1 on B3, and its velocity ratio as the other reading."""
    SUPERBALLS.check(name, what, printed, "%", reason=reason + _RATIO_NOT_HEIGHT)(
        lambda b: _heavy_on_small(b, b("B1.mass")).rebound_ratios[ball] ** 2
    )
    SUPERBALLS.other(
        "the velocity ratio, with B1 = 101 g",
        lambda b: _heavy_on_small(b, b("B1.mass")).rebound_ratios[ball],
    )
    SUPERBALLS.other(
        "the velocity ratio, " + WITH_105,
        lambda b: _heavy_on_small(b, heavier_b1(b)).rebound_ratios[ball],
    )


_check_small(
    "IV.small_B1",
    "B1's bounce height on B3, e = 0.88",
    "49",
    1,
    "With the heavier B1 the velocity ratio gives the printed number, its square does not. ",
)
_check_small(
    "IV.small_B3",
    "B3's bounce height under B1, e = 0.88",
    "28",
    0,
    "Close to the velocity ratio with the heavier B1, not to its square; what remains is within "
    "the error of the masses, on which this ratio depends strongly. ",
)


def _twins(b: Bench) -> Result:
    """Two large balls as separate collisions with one restitution."""
    return _apart(b, (b("B1_on_B1.mass_ratio"), 1.0), "fit.twin_restitution")


def _split_twins(b: Bench, ratio: float) -> Result:
    """Two large balls as separate collisions, each contact with its restitution."""
    drop = rigid_pair((ratio, 1.0), b("fit.twin_floor"), between=b("fit.twin_balls"))
    return b.simulate(drop)


@SUPERBALLS.check("IV.twin_lower", "e1 of two large balls, e = 0.88", "0.75")
def _(b: Bench) -> Number:
    return _twins(b).rebound_ratios[0]


@SUPERBALLS.check("IV.twin_upper", "e2 of two large balls, e = 0.88", "0.80")
def _(b: Bench) -> Number:
    return _twins(b).rebound_ratios[1]


def _check_split(name: str, what: str, ball: int) -> None:
    """Add a rebound ratio of two large balls with a loss at the floor only."""
    reason = "The printed value is that of equal balls; these differ by 4 %."
    SUPERBALLS.check(name, what, "0.76", reason=reason)(
        lambda b: _split_twins(b, b("B1_on_B1.mass_ratio")).rebound_ratios[ball]
    )
    SUPERBALLS.other("with equal balls", lambda b: _split_twins(b, 1.0).rebound_ratios[ball])


_check_split("IV.twin_split_lower", "e1, floor 0.76, ball-ball 1.0", 0)
_check_split("IV.twin_split_upper", "e2, floor 0.76, ball-ball 1.0", 1)
