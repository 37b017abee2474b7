"""Commands that are stopped by signals: `python -m adversary.signals --count 156`, in tests.

No traceback, an exit status that says so, no half a file, no wait; afterwards the same command
answers as if it had never been stopped.
"""

import contextlib
import functools
import itertools
import re
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from adversary.processes import Ended, Started, content, run, sweep
from adversary.table import Case, begin, expect

START = 0.15  # s; every third signal comes that early
ANSWERED = 1.0  # s from a signal to the end; half of it on an idle machine
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_PAIR = ("basketball", "tennis", "--height", "63cm")
_HERTZ = ("--contact", "Hertz stiffness=1e6", "--contact", "Hertz stiffness=1e6")
_OURS = re.compile(r'File "(?!<frozen )(?!.*lib.python3)')  # a place outside of Python's own
_SITE = 'File "<frozen site>"'  # Python sets itself up, .pth files of any package included
_FALL = np.abs((np.arange(120) / 60.0) % 0.9 - 0.45)  # s from the top of each of three flights
_RECORD = "\n".join(
    ["t,y", *(f"{row / 60.0:.4f},{1.0 - 4.903 * t**2:.5f}" for row, t in enumerate(_FALL))]
)


class Command(NamedTuple):
    arguments: list[str]
    files: tuple[str, ...]


COMMANDS = (
    Command(sweep("map.zarr", 3000), ("map.zarr",)),
    Command(["simulate", *_PAIR, "--plot", "new.svg"], ("new.svg",)),
    Command(
        [
            *("fit", *_PAIR, "--measured", "rebound_ratios.1=1.64 ± 0.02"),
            *("--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m", "--save", "new.toml"),
        ],
        ("new.toml",),
    ),
    Command(["simulate", *_PAIR, *_HERTZ, "--error", "balls.0.mass=1000kg"], ()),  # slow drops
    Command(["measure", "ball.csv", "--json"], ()),
    Command(["paper", "--out", "paper"], ("paper",)),
)
_ATTACKS = tuple(itertools.product(COMMANDS, SIGNALS))


@contextlib.contextmanager
def attack(folder: Path) -> Iterator[Case]:
    logs = folder / "logs"

    @functools.cache
    def undisturbed(number: int) -> tuple[Ended, dict[str, bytes], float]:
        """Return how a command ends that nothing stops, its files, and how long it runs."""
        own = folder / f"undisturbed-{number}"
        own.mkdir()
        (own / "ball.csv").write_text(_RECORD)
        begun = time.monotonic()
        ended = run(COMMANDS[number].arguments, own, logs, Started)
        if ended.code:
            raise RuntimeError(f"{COMMANDS[number]} does not run at all: {ended.err}")
        return ended, content(own), time.monotonic() - begun

    def case(index: int, random: np.random.Generator, own: Path) -> None:
        place = 7 * index % len(_ATTACKS)  # each command soon, with another signal
        (command, number), (whole, files, lasts) = (
            _ATTACKS[place],
            undisturbed(place // len(SIGNALS)),
        )
        (own / "ball.csv").write_text(_RECORD)
        early = index % 3 == index // len(_ATTACKS) % 3
        delay = random.uniform(0.0, START if early else lasts)
        process = Started(command.arguments, own, logs)
        process.send(number, delay)
        sent = time.monotonic()
        ended = process.wait()
        what = f"({command.arguments[0]}, {number.name} after {delay:.3f} s)"
        said = f"{what}: {ended.code} {ended.err[-1500:]}"
        expect(time.monotonic() - sent <= ANSWERED, "late", said)
        wrong = judge(command, number, ended, own, files)
        expect(not wrong, wrong, said)
        again = run(command.arguments, own, logs, Started)
        expect((again.code, again.out) == (0, whole.out), "another answer afterwards", said)
        expect(content(own) == files, "other files afterwards", said)

    yield case


def judge(command, number, ended, own, files):
    """Return what is wrong with the end of a command that a signal came to."""
    if _OURS.search(ended.err) and _SITE not in ended.err:
        return "traceback"
    if ended.code not in (0, -number, 128 + number):
        at_start = ended.code == 1 and "KeyboardInterrupt" in ended.err  # before any of our code
        return "" if at_start else "another exit status"
    now = content(own)
    parts = [
        name
        for name, bytes_ in now.items()
        if name.split("/")[0] in command.files and files.get(name) != bytes_
    ]
    return "half a file" if parts else ""


if __name__ == "__main__":
    sys.exit(begin("signals", attack, 156))
