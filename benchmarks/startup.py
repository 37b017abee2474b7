"""How long one waits for the first answer, next to numpy's import.

Each start is a process of its own, with what Python keeps of the files it has read (compiled
bytecode) at hand. The starts take turns, so that a busy second does not fall on all tries of one.
"""

import os
import resource
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from time import perf_counter

ROUNDS = 20
_KEEPS = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
BASE = "import numpy"
SIMULATE = (
    "import stackbounce as sb; "
    "sb.simulate(sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], "
    "[sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53))"
)
HELP = "from stackbounce.cli import main; main(['--help'])"
PICTURE = (
    "import stackbounce as sb; "
    "result = sb.simulate(sb.stack('basketball', 'tennis', height='63 cm')); "
    "sb.plots.bounce(result)._repr_png_()"
)
STARTS = {
    "python": "pass",
    BASE: BASE,
    "import stackbounce": "import stackbounce",
    "stackbounce --help": HELP,
    "simulate, plain numbers": SIMULATE,
    "first picture in a notebook": PICTURE,
}
"""What is started: its name, and its code."""


@dataclass(frozen=True)
class Start:
    """What one start takes: medians in s of all its threads, and as seen on a clock.

    The ratios are medians of those to numpy's import in the same round.
    """

    name: str
    processor: float
    clock: float
    processor_ratio: float
    clock_ratio: float


def measure(progress: Callable[[str], None], rounds: int = ROUNDS) -> list[Start]:
    """Return what each of `STARTS` takes."""
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in STARTS}
    for code in STARTS.values():
        _spent(code)
    for number in range(1, rounds + 1):
        progress(f"starting: round {number} of {rounds}")
        for name, code in STARTS.items():
            found[name].append(_spent(code))
    return [_start(name, found[name], found[BASE]) for name in STARTS]


def _spent(code: str) -> tuple[float, float]:
    """Return processor time and time by the clock, in s, of a process that runs some code."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL, env=_KEEPS)
    clock, after = perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, clock


def _start(name: str, own: list[tuple[float, float]], base: list[tuple[float, float]]) -> Start:
    pairs = list(zip(own, base, strict=True))
    return Start(
        name,
        *(median(times[i] for times in own) for i in (0, 1)),
        *(median(one[i] / other[i] for one, other in pairs) for i in (0, 1)),
    )
