"""A folder with all files that commands are tried on, and the command line within this process."""

import contextlib
import importlib.util
import io
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

import stackbounce as sb
from stackbounce.cli import main

ROOT = Path(__file__).parents[2]
FILES = (
    *("docs/lab/" + name for name in "basketball-press.csv basketball.wav".split()),
    *("docs/lab/" + name for name in "stack-video.txt tennis-force.csv tennis.wav".split()),
    *("docs/fit/" + name for name in "drops.csv equal.toml".split()),
)
EXAMPLES = ROOT / "src" / "stackbounce" / "explorer" / "static" / "examples"
MAKERS = ROOT / "tests" / "measure" / "make_files.py"
TEXTS = Path(__file__).parent / "files"
_ASKED_OF_THE_SYSTEM = ("COLUMNS", "LINES", "FORCE_COLOR", "TTY_COMPATIBLE", "NO_COLOR", "TERM")


class Ran(NamedTuple):
    """What a command answered."""

    code: int
    out: str
    err: str


def run(arguments: Sequence[str]) -> Ran:
    """Run a command in this process, and return what it printed."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(list(arguments))
    return Ran(code, out.getvalue(), err.getvalue())


@contextlib.contextmanager
def folder() -> Iterator[Path]:
    """Enter a folder of its own that holds all files; leave it as the last thing."""
    kept = {name: os.environ.pop(name) for name in _ASKED_OF_THE_SYSTEM if name in os.environ}
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name, contextlib.chdir(name):
        try:
            fill(Path(name))
            yield Path(name)
        finally:
            os.environ.update(kept)


def fill(place: Path) -> None:
    """Copy and make all files that commands are tried on."""
    for name in FILES:
        shutil.copy(ROOT / name, place)
    for source in (EXAMPLES, TEXTS):
        for file in sorted(source.iterdir()):
            shutil.copy(file, place)
    for name, content in made().items():
        (place / name).write_bytes(content)
    gap = sb.Drop(
        [sb.Ball(0.101), sb.Ball(0.0248)],
        [sb.Hysteretic(54e3, restitution=0.9), sb.Spring(24e3)],
        [0.001],
        height=0.2,
    )
    (place / "stack.csv").write_text(force_record(gap, 1), encoding="utf-8")
    alone = sb.Drop(gap.balls[:1], gap.contacts[:1], height=0.2)
    (place / "ball.csv").write_text(force_record(alone, 2), encoding="utf-8")
    (place / "rolls.csv").write_text(track_of_one(), encoding="utf-8")
    (place / "acceleration.csv").write_text(shaken(), encoding="utf-8")


def made() -> dict[str, bytes]:
    """Return the files of all programs that the tests of reading make, by name."""
    spec = importlib.util.spec_from_file_location("frozen_make_files", MAKERS)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {name: maker() for name, maker in module.MAKERS.items()}


def force_record(drop: sb.Drop, seed: int) -> str:
    """Return the force on the floor with noise, to four digits, as a spreadsheet has it."""
    times = np.arange(-3e-3, 12e-3, 1e-5)
    force = np.where(times < 0.0, 0.0, 1.0)
    force *= sb.simulate(drop).sample(np.maximum(times, 0.0)).force.values[0]
    force += np.random.default_rng(seed).normal(0.0, 0.5, len(times))
    rows = [f"{t:.5f},{one:.3f}" for t, one in zip(times, force, strict=True)]
    return "\n".join(["Time (s),Force (N)", *rows, ""])


def track_of_one() -> str:
    """Return the track of a soft ball that falls and bounces, as long as it clearly flies."""
    law = sb.Dashpot(2500.0, 2.0)
    drop = sb.Drop([sb.Ball(0.1)], [law], height=0.5, gravity=9.81)
    result = sb.simulate(drop, until=0.8)
    times = np.arange(0.0, 1.0, 1.0 / 240.0)
    early = np.minimum(times - 0.25, 0.0)
    place = result.sample(np.maximum(times - 0.25, 0.0)).position.values[0]
    place -= drop.reference_speed * early + 0.5 * 9.81 * early**2
    place += np.random.default_rng(3).normal(0.0, 3e-4, len(times))
    rows = [f"{t:.6f},{y:.6f}" for t, y in zip(times, place, strict=True)]
    return "\n".join(["t (s),y (m)", *rows, ""])


def shaken() -> str:
    """Return the acceleration of a falling phone, with two bounces, as its program writes it."""
    times = np.arange(0.0, 1.8, 2e-3)
    felt = np.full(len(times), 9.81)
    for begin, end in ((0.3, 0.7), (0.71, 1.03), (1.04, 1.29)):
        felt[(begin <= times) & (times < end)] = 0.0
    for begin, peak in ((0.7, 900.0), (1.03, 700.0), (1.29, 550.0)):
        pulse = np.sin(np.pi * np.clip((times - begin) / 0.01, 0.0, 1.0))
        felt = np.where(pulse > 1e-9, peak * pulse, felt)
    felt += np.random.default_rng(4).normal(0.0, 0.05, len(times))
    rows = [f"{t:.4f},0.0,{a:.3f},0.0,{abs(a):.3f}" for t, a in zip(times, felt, strict=True)]
    axes = ",".join(f"Acceleration {axis} (m/s^2)" for axis in "xyz")
    return "\n".join([f"Time (s),{axes},Absolute acceleration (m/s^2)", *rows, ""])
