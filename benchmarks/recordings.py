"""How long long recordings take to measure: `python -m benchmarks.recordings [--rounds 3]`."""

import argparse
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

import stackbounce as sb
from benchmarks.timing import best
from stackbounce.measure import knocks, press, waveform
from synthetic.falls import falls
from synthetic.press import press_record
from synthetic.sound import sound

__all__ = ["CASES"]

_SECONDS = 600  # of sound
_RATE = 48000.0  # Hz


def _pulses(count: int, rate: float, noise: float) -> tuple[Any, Any]:
    """Return times and forces of half sines of 4 ms and 100 N, one each 20 ms."""
    times = np.arange(0.0, 0.02 * (count + 0.5), 1.0 / rate)
    phase = (times - 0.01) % 0.02
    inside = (times >= 0.01) & (phase <= 4e-3)
    force = np.where(inside, 100.0 * np.sin(np.pi * phase / 4e-3), 0.0)
    return times, force + np.random.default_rng(0).normal(0.0, noise, len(times))


def _press() -> Any:
    ball = sb.Hysteretic(4e4, exponent=1.3, restitution=0.78)
    return press_record(ball, points=1_000_000, peak=5e-3, slack=1e-3, noise=0.1, seed=1)


def _sound() -> Any:
    noise = np.random.default_rng(1).normal(0.0, 0.002, int(_SECONDS * _RATE)).astype(np.float32)
    short = sound(falls(0.5, 0.8, bounces=10), seed=1).sound.values
    noise[1_000_000 : 1_000_000 + len(short)] += short
    return noise


CASES: dict[str, tuple[Callable[[], Any], Callable[[Any], Any]]] = {
    "waveform, 100 contacts": (partial(_pulses, 100, 5e4, 0.5), waveform),
    "waveform, a million samples": (partial(_pulses, 3, 1.4e7, 5.0), waveform),
    "press curve, a million points": (_press, press),
    "sound, ten minutes": (_sound, partial(knocks, rate=_RATE)),
}
"""What is measured: its name, how it is made, and how it is analysed."""


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.recordings", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="of which the fastest counts")
    rounds = parser.parse_args().rounds
    calls = [partial(analyse, make()) for make, analyse in CASES.values()]
    console = Console(highlight=False)
    with console.status("starting") as status:
        calls[0]()  # imports
        times = best(calls, status.update, rounds=rounds)
    table = Table("recording", "time in s", box=None, pad_edge=False)
    for name, time in zip(CASES, times, strict=True):
        table.add_row(name, f"{time:.2f}")
    console.print(table)


if __name__ == "__main__":
    main()
