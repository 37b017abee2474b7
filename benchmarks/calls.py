"""How long one call of `simulate` takes, and how long one waits for a first sweep.

Run `python -m benchmarks.calls`. The kernel alone, the whole call and plain Python take turns in
one run. A first sweep is a process of its own: it starts Python, loads the compiled code, and runs
10 000 drops.
"""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from time import perf_counter

from rich.console import Console
from rich.table import Table

import stackbounce as sb
from benchmarks.timing import best
from stackbounce.engine.memory import memory
from stackbounce.engine.records import BEGIN_WITH_PEAKS
from stackbounce.run.engines import choose_engine
from stackbounce.run.options import run_options
from stackbounce.run.paths import drop_numbers

LAWS = {
    "springs": "Spring(2500.0)",
    "Hertz": "Hertz(1e6)",
    "hysteretic": "Hysteretic(4e4, exponent=1.3, restitution=0.78)",
    "viscoelastic": "Viscoelastic(1e6, 1e-4)",
    "Hunt-Crossley": "HuntCrossley(1e6, 1.5, 0.1)",
    "rigid": "Rigid(0.8)",
}
"""The law of both contacts, in Python."""

HEADS = ["law", "kernel (µs)", "whole (µs)", "plain (µs)", "plain/whole", "first sweep (s)"]
_ROUNDS = 6
_FIRST = (
    "import numpy, stackbounce as sb; "
    "drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [sb.{law}] * 2, impact_speed=3.0); "
    "sb.sweep(drop, {{'balls.1.mass': numpy.linspace(0.03, 0.3, 10_000)}})"
)


@dataclass(frozen=True)
class Call:
    """What one call takes, in s: the kernel alone, the whole of it, and as plain Python."""

    law: str
    kernel: float
    whole: float
    plain: float


def measure(progress: Callable[[str], None], rounds: int = _ROUNDS) -> list[Call]:
    """Return what one call takes for each of `LAWS`: two balls, default arguments."""
    calls: list[Callable[[], object]] = []
    for law in LAWS.values():
        contact = eval(f"sb.{law}")
        drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [contact, contact], impact_speed=3.0)
        room = memory(choose_engine(drop), 2, compiled=True)
        options = run_options(drop, None, 1e-12, 1_000_000)
        numbers = drop_numbers(drop)
        room.put(numbers)
        calls += [
            partial(_run_kernel, room.put, numbers, partial(room.run, BEGIN_WITH_PEAKS, *options)),
            partial(_ratios, drop, None),
            partial(_ratios, drop, False),
        ]
    for call in calls:
        call()
    times = best(calls, progress, rounds)
    return [Call(law, *times[3 * k : 3 * k + 3]) for k, law in enumerate(LAWS)]


def first_sweeps(progress: Callable[[str], None], rounds: int = 3) -> dict[str, float]:
    """Return the shortest time in s of a process that runs a first sweep, by law."""
    found = dict.fromkeys(LAWS, float("inf"))
    for number in range(1, rounds + 1):
        progress(f"first sweeps, round {number} of {rounds}")
        for name, law in LAWS.items():
            begin = perf_counter()
            subprocess.run([sys.executable, "-c", _FIRST.format(law=law)], check=True)
            found[name] = min(found[name], perf_counter() - begin)
    return found


def _run_kernel(put: Callable[[object], None], numbers: object, run: Callable[[], int]) -> None:
    put(numbers)
    run()


def _ratios(drop: sb.Drop, compiled: bool | None) -> object:
    return sb.simulate(drop, compiled=compiled).rebound_ratios


def rows(calls: list[Call], sweeps: dict[str, float]) -> list[list[str]]:
    """Return rows of text: times of calls in µs, their ratio, and of first sweeps in s."""
    return [
        [
            one.law,
            *(f"{1e6 * seconds:.1f}" for seconds in (one.kernel, one.whole, one.plain)),
            f"{one.plain / one.whole:.0f}",
            f"{sweeps[one.law]:.2f}",
        ]
        for one in calls
    ]


def main() -> None:
    """Measure and print."""
    console = Console(highlight=False)
    with console.status("starting") as status:
        found = measure(status.update), first_sweeps(status.update)
    table = Table(title="One call, two balls, rtol 1e-12", title_justify="left", box=None)
    for head in HEADS:
        table.add_column(head, justify="left" if head == HEADS[0] else "right")
    for row in rows(*found):
        table.add_row(*row)
    console.print(table)


if __name__ == "__main__":
    main()
