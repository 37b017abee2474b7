"""Tables I and II recomputed, with the paper's errors propagated by `uncertainties`."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks_tables import PAIRS
from stackbounce.cross2007.claims import CLAIMS
from stackbounce.measure.constants import dynamic_stiffness

if TYPE_CHECKING:
    from uncertainties import UFloat


@dataclass(frozen=True)
class Table:
    """A recomputed table as text: its number, title, column heads, rows and notes."""

    name: str
    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]


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
    cells = tuple(tuple(row.values()) for row in rows)
    return Table(name, title, tuple(rows[0]), cells, notes)


def _text(value: "UFloat") -> str:
    return f"{value:P}"
