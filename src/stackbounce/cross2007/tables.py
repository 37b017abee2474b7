"""Tables I and II: the audit's checks of them, and both recomputed.

The paper's errors are propagated by `uncertainties`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt

from stackbounce import shown
from stackbounce.cross2007.bench import CLAIMS, Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import fallen_speed
from stackbounce.cross2007.stacks import heavier_b1, hollow_pair
from stackbounce.library_types import DataFrame, UFloat
from stackbounce.measure.constants import dynamic_stiffness

PAIRS = ("B2_on_B1", "B1_on_B2", "B3_on_B1", "B1_on_B3", "B1_on_B1", "tennis_on_basketball")
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


@dataclass(frozen=True, repr=False)
class Table(shown.Shown):
    """A recomputed table as text: its number, title, column heads, rows and notes."""

    name: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]

    @property
    def table(self) -> DataFrame:
        """The rows, by their first cell."""
        import pandas as pd

        return pd.DataFrame(list(self.rows), columns=list(self.head)).set_index(self.head[0])

    def _tables(self) -> Sequence[shown.Table]:
        return (shown.Table(f"Table {self.name}: {self.title}", self.head, self.rows),)


def make_table_one(bench: Bench) -> Table:
    """Return Table I: the superballs, with their dynamic stiffness from the contact time.

    Parameters
    ----------
    bench : Bench
        The paper's data.

    Returns
    -------
    Table
    """
    rows = []
    for ball in ("B1", "B2", "B3"):
        time, mass = bench.measured(f"{ball}.contact_time"), bench.measured(f"{ball}.mass")
        diameter = bench.measured(f"{ball}.diameter")
        static = bench.measured(f"{ball}.static_stiffness")
        dynamic = dynamic_stiffness(mass, time)
        row = {
            "ball": ball,
            "D (mm)": _text(1e3 * diameter),
            "m (g)": _text(1e3 * mass),
            "static k (1e4 N/m)": _text(1e-4 * static),
            "contact time (ms)": _text(1e3 * time),
            "dynamic k printed (1e4 N/m)": f"{1e-4 * bench(f'{ball}.dynamic_stiffness'):.1f}",
            "dynamic k = m (π/time)²": _text(1e-4 * dynamic),
            "dynamic/static": _text(dynamic / static),
            "dynamic k/D (kN/m per mm)": _text(1e-3 * dynamic / (1e3 * diameter)),
        }
        rows.append(row)
    notes = (
        "Errors are the paper's (0.1 ms, 5 %), or half a unit in the last printed digit.",
        "The last column is what the text calls proportional to the radius.",
    )
    return _as_table("I", "Properties of the superballs", rows, notes)


def make_table_two(bench: Bench) -> Table:
    """Return Table II: mass ratios, and bounce heights as squares of the rebound ratios.

    Parameters
    ----------
    bench : Bench
        The paper's data.

    Returns
    -------
    Table
    """
    balls = ("B1", "B2", "B3", "basketball", "tennis")
    masses = {ball: bench.measured(f"{ball}.mass") for ball in balls}
    heavier = bench.measured("B1_on_B1.mass_ratio") * masses["B1"]
    rows = []
    for pair in PAIRS:
        upper, lower = pair.split("_on_")
        below, above = masses[lower], masses[upper]
        with_heavier = (heavier if lower == "B1" else below) / (
            heavier if upper == "B1" and lower != "B1" else above
        )
        e1, e2 = bench.measured(f"{pair}.lower"), bench.measured(f"{pair}.upper")
        row = {
            "bottom": lower,
            "top": upper,
            "m1/m2 printed": CLAIMS[f"T2.{pair}.ratio"].printed,
            "from Table I": "" if lower == upper else _text(below / above),
            "B1 = 105 g": _text(with_heavier) if "B1" in (lower, upper) else "",
            "e1": _text(e1),
            "e2": _text(e2),
            "h1/h0 printed": CLAIMS[f"T2.{pair}.lower_height"].printed,
            "e1 squared": _text(e1**2),
            "h2/h0 printed": CLAIMS[f"T2.{pair}.upper_height"].printed,
            "e2 squared": _text(e2**2),
        }
        rows.append(row)
    notes = (
        "Errors: 0.02 for e1 and e2 of the superballs; else half a unit in the last digit.",
        "105 g is 1.040 times Table I's 101 g; the lower ball of B1 on B1 is the heavier one.",
    )
    return _as_table("II", "Rebound ratios of the pairs", rows, notes)


def _as_table(name: str, title: str, rows: list[dict[str, str]], notes: tuple[str, ...]) -> Table:
    return Table(name, title, tuple(rows[0]), tuple(tuple(row.values()) for row in rows), notes)


def _text(value: UFloat) -> str:
    return f"{value:P}"
