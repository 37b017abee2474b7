"""How long one waits for the first answer, next to numpy's import.

Each start is a process of its own, with what Python keeps of the files it has read (compiled
bytecode) at hand. The starts take turns, so that a busy second does not fall on all tries of one.
What each import takes of a start is Python's own account, `-X importtime`.
"""

import os
import re
import resource
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter

ROUNDS = 20
IMPORT_ROUNDS = 3
_DOCS = Path(__file__).parents[1] / "docs"
_KEEPS = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
BASE = "import numpy"
SIMULATE = (
    "import stackbounce as sb; "
    "sb.simulate(sb.Drop([sb.Ball(0.150), sb.Ball(0.057)], "
    "[sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53))"
)
PICTURE = (
    "import stackbounce as sb; "
    "result = sb.simulate(sb.stack('basketball', 'tennis', height='63 cm')); "
    "sb.plots.bounce(result)._repr_png_()"
)


def _command(*arguments: str) -> str:
    return f"from stackbounce.cli import main; main({list(arguments)})"


STARTS = {
    "python": "pass",
    BASE: BASE,
    "import stackbounce": "import stackbounce",
    "stackbounce --help": _command("--help"),
    "simulate basketball tennis": _command("simulate", "basketball", "tennis"),
    "measure tennis.wav": _command("measure", f"{_DOCS}/lab/tennis.wav"),
    "fit heights.csv": _command("fit", f"{_DOCS}/fit/heights.csv"),
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


def imports(progress: Callable[[str], None], rounds: int = IMPORT_ROUNDS) -> list[dict[str, float]]:
    """Return what each package's modules take to import in each of `STARTS`: the least, in s."""
    found: list[list[Counter[str]]] = [[] for _ in STARTS]
    for number in range(1, rounds + 1):
        progress(f"imports of starts: round {number} of {rounds}")
        for tries, code in zip(found, STARTS.values(), strict=True):
            tries.append(_imported(code))
    return [{name: min(x[name] for x in tries) for name in tries[0]} for tries in found]


def _imported(code: str) -> Counter[str]:
    command = [sys.executable, "-X", "importtime", "-c", code]
    told = subprocess.run(command, check=True, capture_output=True, text=True, env=_KEEPS).stderr
    seconds: Counter[str] = Counter()
    for own, package in re.findall(
        r"^import time: +(\d+) \| +\d+ \| +([^.\s]+)", told, re.MULTILINE
    ):
        seconds[package] += 1e-6 * int(own)
    return seconds


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
