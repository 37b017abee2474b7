"""Observations of the force records that no fit uses: durations and numbers of peaks."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from stackbounce import Result, simulate
from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import peak_times
from stackbounce.cross2007.stacks import gap_for_delay
from studies.table2.catalogue import CHOSEN
from studies.table2.comparison import FittedModels

_RTOL = 1e-9


class Fact(NamedTuple):
    """An observation of the force records: as printed, and as each model gives it."""

    what: str
    printed: str
    found: dict[str, str]


def simulate_at_delay(compared: FittedModels, name: str, pair: str, delay: float) -> Result:
    """Simulate a pair by a fitted model, with the gap for a delay in s."""
    drop = compared.drop(name, pair)
    return simulate(replace(drop, gaps=(gap_for_delay(Bench(PAPER), drop, delay),)), rtol=_RTOL)


def compare_records(compared: FittedModels) -> list[Fact]:
    """Return the observations of Figs 10 to 12 beside the chosen models at the recorded delays."""
    return [
        Fact(
            what,
            shown,
            {name: look(simulate_at_delay(compared, name, pair, delay)) for name in CHOSEN},
        )
        for what, shown, pair, delay, look in _FACTS
    ]


def _over(result: Result) -> str:
    return f"{1e3 * float(max(result.last_release)):.1f} ms"


def _floor(result: Result) -> str:
    return f"{1e3 * float(result.last_release[0]):.1f} ms"


def _peaks(contact: int) -> Callable[[Result], str]:
    return lambda result: str(len(peak_times(result, contact, result.end_time)))


def _contacts(result: Result) -> str:
    """Count the contacts from the first to the last one between the balls."""
    rows = result.intervals
    met = [k for k, row in enumerate(rows) if row["contact"] == 1]
    return str(met[-1] - met[0] + 1)


_EARLY, _LATE = PAPER["superballs.delay"].value, PAPER["superballs.late_delay"].value
_SHORTEST = PAPER["superballs.twin_delay"].value
_AWAY = 3.9e-3  # s: so late that the impact of two balls B1 lasts the 12 ms of Fig. 12

_FACTS: tuple[tuple[str, str, str, float, Callable[[Result], str]], ...] = (
    ("B2 on B1, delay 2 ms: impact lasts", "6.0 ms", "B2_on_B1", _EARLY, _over),
    ("B1 on B2, delay 2 ms: force on the floor ends", "9.0 ms", "B1_on_B2", _EARLY, _floor),
    ("B1 on B2, delay 2 ms: peaks between the balls", "3", "B1_on_B2", _EARLY, _peaks(1)),
    ("B1 on B3, delay 2 ms: peaks between the balls", "4", "B1_on_B3", _EARLY, _peaks(1)),
    (
        "B1 on B3, delay 7 ms: contacts, first to last of the balls",
        "9",
        "B1_on_B3",
        _LATE,
        _contacts,
    ),
    ("B1 on B1, delay 1 ms: impact lasts", "9 ms", "B1_on_B1", _SHORTEST, _over),
    ("B1 on B1, delay 1 ms: peaks at the floor", "2", "B1_on_B1", _SHORTEST, _peaks(0)),
    ("B1 on B1, delay 3.9 ms: impact lasts", "12 ms", "B1_on_B1", _AWAY, _over),
)
