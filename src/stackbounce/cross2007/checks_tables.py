"""The audit's checks of Tables I and II."""

from math import pi, sqrt

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import fallen_speed
from stackbounce.cross2007.stacks import heavier_b1, hollow_pair

PAIRS = (
    "B2_on_B1",
    "B1_on_B2",
    "B3_on_B1",
    "B1_on_B3",
    "B1_on_B1",
    "tennis_on_basketball",
)
"""Table II's rows, by upper and lower ball."""


def _stiffness(ball: str) -> Compute:
    return lambda b: b(f"{ball}.mass") * (pi / b(f"{ball}.contact_time")) ** 2


def _mass_ratio(pair: str) -> Compute:
    upper, lower = pair.split("_on_")
    return lambda b: b(f"{lower}.mass") / b(f"{upper}.mass")


def _mass_ratio_with_105(pair: str) -> Compute:
    upper, lower = pair.split("_on_")
    return lambda b: _mass_with_105(b, lower) / _mass_with_105(b, upper)


def _mass_with_105(b: Bench, ball: str) -> float:
    return heavier_b1(b) if ball == "B1" else b(f"{ball}.mass")


def _square(pair: str, ball: str) -> Compute:
    return lambda b: b(f"{pair}.{ball}") ** 2


def _most(b: Bench, fall: float) -> float:
    """Return the largest e2 with Table II's e1, if the basketball alone bounces after `fall` m.

    Its contact with the floor takes up at least its own kinetic energy, and returns the share e**2.
    """
    kept = b("basketball.rebound_height") / fall
    ratio = b("basketball.mass") / b("tennis.mass")
    return sqrt(1.0 + ratio * (kept - b("tennis_on_basketball.lower") ** 2))


def _fall_to_bottom(b: Bench) -> float:
    """How far the basketball's bottom falls if 0.71 m was measured to its centre."""
    return b("stack.drop_height") - b("basketball.diameter") / 2


COMPUTED: dict[str, Compute] = {
    **{f"T1.{ball}": _stiffness(ball) for ball in ("B1", "B2", "B3")},
    **{f"T2.{pair}.ratio": _mass_ratio(pair) for pair in PAIRS},
    "T2.B1_on_B1.ratio": lambda b: b("B2_on_B1.mass_ratio") * b("B2.mass") / b("B1.mass"),
    "T2.tennis_on_basketball.lower": lambda b: b("stack.lower_speed") / b("stack.impact_speed"),
    "T2.tennis_on_basketball.upper": lambda b: b("stack.upper_speed") / b("stack.impact_speed"),
    **{f"T2.{pair}.lower_height": _square(pair, "lower") for pair in PAIRS},
    **{f"T2.{pair}.upper_height": _square(pair, "upper") for pair in PAIRS},
    "T2.tennis_on_basketball.lower_bounce": lambda b: (
        b("stack.lower_height") / b("stack.drop_height")
    ),
    "T2.tennis_on_basketball.upper_bounce": lambda b: (
        b("stack.upper_height") / b("stack.drop_height")
    ),
}

READINGS: dict[str, tuple[Compute, ...]] = {
    **{
        f"T2.{pair}.ratio": (_mass_ratio_with_105(pair),)
        for pair in ("B2_on_B1", "B1_on_B2", "B3_on_B1", "B1_on_B3")
    },
    "T2.tennis_on_basketball.lower": (
        lambda b: fallen_speed(b("stack.lower_height")) / b("stack.impact_speed"),
        lambda b: fallen_speed(b("stack.lower_height") + 0.01) / b("stack.impact_speed"),
    ),
    "T2.tennis_on_basketball.upper": (
        lambda b: b.simulate(hollow_pair(b)).rebound_ratios[1],
        lambda b: _most(b, b("stack.drop_height")),
        lambda b: _most(b, _fall_to_bottom(b)),
    ),
    "T2.tennis_on_basketball.lower_bounce": (
        lambda b: b("stack.lower_height") / _fall_to_bottom(b),
        lambda b: (b("stack.lower_height") + 0.01) / b("stack.drop_height"),
    ),
    "T2.tennis_on_basketball.upper_bounce": (
        lambda b: b("stack.upper_height") / _fall_to_bottom(b),
    ),
}
