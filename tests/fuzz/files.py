"""Measure files that were changed at random: each ends in results or in one line of refusal.

`python -m fuzz.files --count 5000 [FOLDER]`, in tests: files of a folder, or minimal ones of each
format.
"""

import argparse
import collections
import contextlib
import io
import multiprocessing
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

import numpy as np

from fuzz.mutate import OPTIONS, minimal_cases, mutated
from stackbounce.cli import main

KEPT = Path(__file__).parents[2] / "build" / "fuzz" / "files"
SECONDS = 10.0
MEBIBYTES = 1024.0
_HANGS = 6.0  # times `SECONDS` by the clock: then its process is ended
_INNER = re.compile(
    r"unexpected|Traceback|\w+Error\b|array|slice|nan\b|singular matrix|broadcast|out of bounds"
)


class Case(NamedTuple):
    """What came of a file: its number, options, what was wrong, and how it was refused."""

    index: int
    source: str
    options: tuple[str, ...]
    wrong: str
    seconds: float
    mebibytes: float
    code: int


class _TooLongError(BaseException):
    """The time is over; nothing may catch it."""


def made(sources: dict[str, bytes], seed: int, index: int) -> tuple[str, bytes, tuple[str, ...]]:
    """Return the name of a source, its changed content, and options."""
    random = np.random.default_rng([seed, index])
    name = sorted(sources)[int(random.integers(len(sources)))]
    options = OPTIONS[int(random.integers(len(OPTIONS)))]
    return name, mutated(sources[name], random), options


def measured(sources: dict[str, bytes], seed: int, index: int, folder: Path) -> Case:
    """Measure a changed file in this process, and say what is wrong with the answer."""
    name, content, options = made(sources, seed, index)
    path = folder / "changed"
    path.write_bytes(content)
    out, err = io.StringIO(), io.StringIO()
    begun, code = time.process_time(), 1
    signal.signal(signal.SIGPROF, _end)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)  # of the processor: others may be at work
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["measure", str(path), *options])
        wrong = _wrong(code, err.getvalue())
    except _TooLongError as error:
        wrong = f"longer than {SECONDS:g} s: {_places(error)}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    if not wrong and most > MEBIBYTES:
        wrong = f"more than {MEBIBYTES:g} MiB of memory"
    seconds = time.process_time() - begun
    return Case(index, name, options, wrong, seconds, most, code)


def _places(error: BaseException | None) -> str:
    """Return where in the package an error came from, the innermost place last."""
    frames = traceback.extract_tb(None if error is None else error.__traceback__)
    own = [frame for frame in frames if "stackbounce" in frame.filename]
    return ", ".join(
        f"{Path(frame.filename).name}:{frame.lineno} {frame.name}" for frame in own[-4:]
    )


def _end(*_: object) -> None:
    raise _TooLongError


def _wrong(code: int, err: str) -> str:
    """Return what is wrong with an exit status and what was said on stderr."""
    if code not in (0, 2):
        return f"exit status {code}: {err}"
    if err.count("\n") != (code == 2):
        return f"not one line: {err}"
    own = re.sub(
        r"'[^']*'|--column \S+|known: .*|got .*|it has [^:]*", "", err
    )  # what the file itself says
    return f"inner words: {err}" if _INNER.search(own) else ""


def _serve(sources: dict[str, bytes], seed: int, todo: list[int], answers: Connection) -> None:
    with tempfile.TemporaryDirectory() as folder:
        for index in todo:
            answers.send(measured(sources, seed, index, Path(folder)))


def run(sources: dict[str, bytes], seed: int, count: int) -> list[Case]:
    """Measure changed files in a process of their own, a new one where one hangs or swells."""
    cases: list[Case] = []
    context = multiprocessing.get_context("fork")
    while len(cases) < count:
        mine, theirs = context.Pipe()
        todo = list(range(len(cases), count))
        worker = context.Process(target=_serve, args=(sources, seed, todo, theirs), daemon=True)
        worker.start()
        theirs.close()
        while len(cases) < count:
            try:
                case = mine.recv() if mine.poll(_HANGS * SECONDS) else None
            except EOFError:
                case = None
            if case is None:
                name, _, options = made(sources, seed, len(cases))
                case = Case(len(cases), name, options, "its process hung or died", 30.0, 0.0, 1)
            cases.append(case)
            if sys.stderr.isatty():
                wrong = sum(bool(done.wrong) for done in cases)
                sys.stderr.write(f"\r{len(cases)} files, {wrong} wrong ")
            if case.mebibytes > MEBIBYTES or not case.mebibytes:
                break
        worker.kill()
        worker.join()
    return cases


def report(cases: list[Case], sources: dict[str, bytes], seed: int) -> str:
    """Return what came of all files; those that went wrong are kept."""
    codes = collections.Counter(case.code for case in cases)
    slowest = max(cases, key=lambda case: case.seconds)
    most = max(case.mebibytes for case in cases)
    lines = [
        f"{len(cases)} files: {codes[0]} measured, {codes[2]} refused; at most {most:.0f} MiB",
        f"slowest: {slowest.seconds:.1f} s, number {slowest.index}, of {slowest.source}",
    ]
    for case in cases:
        if case.wrong:
            kept = keep(case, sources, seed)
            lines.append(f"{kept} {' '.join(case.options)} (of {case.source}): {case.wrong}")
    return "\n".join(lines) + "\n"


def keep(case: Case, sources: dict[str, bytes], seed: int) -> Path:
    """Write the file of a case, to be looked at; return where."""
    KEPT.mkdir(parents=True, exist_ok=True)
    kept = KEPT / f"{seed}-{case.index}"
    kept.write_bytes(made(sources, seed, case.index)[1])
    return kept


def _sources(folder: Path | None) -> dict[str, bytes]:
    if folder is None:
        return minimal_cases()
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def begin() -> int:
    """Measure what the command line asks for; return 1 if anything is wrong."""
    parser = argparse.ArgumentParser(prog="python -m fuzz.files", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    sources = _sources(asked.folder)
    cases = run(sources, asked.seed, asked.count)
    sys.stdout.write(report(cases, sources, asked.seed))
    return int(any(case.wrong for case in cases))


if __name__ == "__main__":
    sys.exit(begin())
