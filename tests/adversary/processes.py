"""The command line in processes of their own, which are stopped, killed and started together."""

import contextlib
import functools
import importlib
import io
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

PATIENCE = 60.0  # s; what takes longer hangs
_TICK = 0.002  # s
_STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_INNER = re.compile(r"Traceback|unexpected |Exception ignored|RuntimeWarning|Segmentation")


class Ended(NamedTuple):
    """How a process ended: its exit status, negative after a signal, and what it said."""

    code: int
    out: str
    err: str

    @property
    def inner(self) -> bool:
        """Whether it said anything that is for programmers only."""
        return self.code == 1 or bool(_INNER.search(self.err))

    @property
    def refused(self) -> bool:
        """Whether it ended with one line that says what is wrong."""
        return self.code == 2 and self.err.count("\n") == 1 and not self.inner


class Started:
    """A command that runs in a folder; its output goes to files in another."""

    def __init__(self, arguments: Sequence[str], folder: Path, logs: Path) -> None:
        logs.mkdir(parents=True, exist_ok=True)
        self._said = [logs / f"{time.monotonic_ns()}.{name}" for name in ("out", "err")]
        for path in self._said:
            path.touch()
        _listen_to_signals()  # what is ignored here, a new process would ignore, too
        self.begun = time.monotonic()
        self.number = self._start(arguments, folder)

    def _start(self, arguments: Sequence[str], folder: Path) -> int:
        """Start a new Python; return the number of its process."""
        with self._said[0].open("wb") as out, self._said[1].open("wb") as err:
            process = subprocess.Popen(
                [sys.executable, "-m", "stackbounce", *arguments],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
            )
        process.returncode = 0  # `wait` asks the system
        return process.pid

    def send(self, number: signal.Signals, delay: float) -> None:
        """Send a signal so many seconds after the start, unless the process has ended."""
        time.sleep(max(0.0, self.begun + delay - time.monotonic()))
        os.kill(self.number, number)  # until `wait` its number is not given to another process

    def wait(self) -> Ended:
        while time.monotonic() < self.begun + PATIENCE:
            number, status = os.waitpid(self.number, os.WNOHANG)
            if number:
                break
            time.sleep(_TICK)
        else:
            os.kill(self.number, signal.SIGKILL)
            _, status = os.waitpid(self.number, 0)
        code = os.waitstatus_to_exitcode(status)
        return Ended(code, *(path.read_text("utf-8", "replace") for path in self._said))


class Forked(Started):
    """A command in a copy of this process: it starts at once, and sweeps have small blocks."""

    def _start(self, arguments: Sequence[str], folder: Path) -> int:
        _warm()
        number = os.fork()
        if number:
            return number
        code = 1
        try:
            for stream, path in zip((1, 2), self._said, strict=True):
                os.dup2(os.open(path, os.O_WRONLY), stream)
            os.chdir(folder)
            code = _main(arguments)
        except BaseException:
            traceback.print_exc()
        finally:
            for stream in (sys.stdout, sys.stderr):
                stream.flush()
            os._exit(code)


def run(arguments: Sequence[str], folder: Path, logs: Path, kind: type[Started] = Forked) -> Ended:
    return kind(arguments, folder, logs).wait()


def _main(arguments: Sequence[str]) -> int:
    from stackbounce.cli import main

    return main(arguments)


def _listen_to_signals() -> None:
    """Have signals do what they usually do, however this process was started."""
    for number in _STOPS:
        signal.signal(number, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)


@functools.cache
def _warm() -> None:
    """Import what the commands need, once for all copies, and give sweeps small blocks."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [*sweep(f"{folder}/{STORE}"), "--plot", f"{folder}/map.svg"]
        with contextlib.redirect_stdout(io.StringIO()):
            _main(arguments)
    importlib.import_module("stackbounce.sweeps").write.__kwdefaults__["block"] = BLOCK


BLOCK = 64
STORE = "map.zarr"
_DROP = ("basketball", "tennis", "--height", "1m")


def sweep(out: str, masses: int = 30) -> list[str]:
    """Return the arguments of a sweep; with another number of masses it is another sweep."""
    over = ("--over", f"balls.0.mass=50g:500g:{masses}:log", "--over", "gaps.0=0mm:4mm:20")
    return ["sweep", *_DROP, *over, "--out", out]


def content(path: Path) -> dict[str, bytes]:
    """Return all files of a folder, or a file, by their names below it."""
    paths = [path] if path.is_file() else sorted(path.rglob("*"))
    return {str(one.relative_to(path)): one.read_bytes() for one in paths if one.is_file()}


class Undisturbed(NamedTuple):
    """A sweep that nothing disturbs: the files of its store, what it says, and how long it runs."""

    files: dict[str, bytes]
    out: str
    seconds: float


def undisturbed(folder: Path, masses: int = 30) -> Undisturbed:
    folder = folder / f"undisturbed-{masses}"
    folder.mkdir()
    for _ in range(2):  # the first time some modules are imported
        begun = time.monotonic()
        ended = run(sweep(STORE, masses), folder, folder.parent / "logs")
        seconds = time.monotonic() - begun
    if ended.code:
        raise RuntimeError(f"the sweep does not run at all: {ended.err}")
    return Undisturbed(content(folder / STORE), ended.out, seconds)
