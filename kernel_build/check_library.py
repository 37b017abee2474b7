"""Compare a library of another platform with that of this machine, bit for bit, by an emulator.

A program of a few lines (`check_library.c`) is compiled for the platform. It loads the library and
calls its kernels on the memory of random drops. With Debian's packages ``qemu-user-static`` and
``libc6-arm64-cross``, from the root of the repository::

    python -m kernel_build --platform linux-aarch64 --folder build/kernels
    export PYTHONPATH=.:tests RUN='qemu-aarch64-static -L /usr/aarch64-linux-gnu'
    python -m kernel_build.check_library linux-aarch64 build/kernels --run "$RUN"
"""

import argparse
import math
import shlex
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from fuzz import draw
from kernel_build.targets import TARGETS
from stackbounce.engine import codes, native
from stackbounce.engine.memory import FINITE, RIGID, lane_workspace, memory
from stackbounce.engine.records import Drops, Outcomes
from stackbounce.engine.work import WORK_LIMIT
from stackbounce.run.batch import new_outcomes

_ENTRIES = ("run_batch", "run_rigid_batch", "run_two_springs")
_ARGUMENTS = 11
_WORD, _LINE = 8, 8  # bytes of a word, words of a cache line
_LIMIT, _RTOL = 300, 1e-9
_PROGRAM = Path(__file__).with_suffix(".c")
_C = {"linux-x86_64": "x86_64-linux-gnu.2.28", "linux-aarch64": "aarch64-linux-gnu.2.28"}


class Image:
    """Memory with records, wherever it lies, and the calls of kernels on it."""

    def __init__(self) -> None:
        self.parts: list[np.ndarray] = []
        self.known: list[tuple[np.ndarray, int]] = []  # arrays, and where they are, in bytes
        self.places: list[int] = []  # of addresses, in words
        self.calls: list[tuple[int, ...]] = []

    def record(self, record: Any) -> int:
        """Put the arrays of a record, and their table; return where it is."""
        shapes = [(*array.shape, 1)[:2] for array in record]
        rows = [(self._at(array), *shape) for array, shape in zip(record, shapes, strict=True)]
        begin = self._put(np.array(rows, dtype=np.int64))
        self.places += range(begin // _WORD, begin // _WORD + 3 * len(rows), 3)
        return begin

    def call(self, entry: str, *arguments: float) -> None:
        """Add a call of an entry with records, given by where they are, and numbers."""
        words = [_bits(value) if isinstance(value, float) else value for value in arguments]
        words += [0] * (_ARGUMENTS - len(words))
        self.calls.append((_ENTRIES.index(entry), *words))

    def words(self) -> np.ndarray:
        """Return the memory."""
        return np.concatenate(self.parts)

    def _at(self, array: np.ndarray) -> int:
        """Return where an array is, which may be a part of another one; put it if it is new."""
        whole: Any = array if array.base is None else array.base
        for known, begin in self.known:
            if known is whole:
                return begin + array.ctypes.data - whole.ctypes.data
        begin = self._put(whole)
        self.known.append((whole, begin))
        return begin + array.ctypes.data - whole.ctypes.data

    def _put(self, numbers: np.ndarray) -> int:
        begin = sum(part.size for part in self.parts)
        room = np.zeros(-(-numbers.size // _LINE) * _LINE, dtype=np.int64)
        room[: numbers.size] = numbers.reshape(-1).view(np.int64)
        self.parts.append(room)
        return _WORD * begin


def _bits(value: float) -> int:
    number: int = struct.unpack("<q", struct.pack("<d", value))[0]
    return number


def random_image(batch: int, count: int) -> Image:
    """Return the memory of random drops, and the calls that run them."""
    drawn, rigid = draw.drops_of(1, batch, count), draw.is_rigid(batch)
    engine, balls = RIGID if rigid else FINITE, drawn.mass.shape[1]
    image, room = Image(), memory(engine, balls, compiled=True)
    stack, space, _ = (image.record(table.record) for table in room.arguments)
    drops = image.record(Drops._make(getattr(drawn, name) for name in Drops._fields))
    out = image.record(_outcomes(count, balls))
    none = image.record(room.no_samples.record)
    entry = engine.run_batch
    options = math.inf, _RTOL, _LIMIT, WORK_LIMIT
    image.call(entry, stack, space, drops, none, *options, out, 0, count)
    return image


def springs_image(count: int) -> Image:
    """Return the memory of random drops of two balls on springs, and the calls that run them."""
    random = np.random.default_rng(1)
    mass, stiffness = (10.0 ** random.uniform(-1.5, 1.5, (count, 2)) for _ in range(2))
    gap = np.column_stack([np.zeros(count), random.integers(2, size=count) * random.random(count)])
    one, kind = np.ones((count, 2)), np.full((count, 2), codes.POWER)
    numbers = Drops(mass, kind, stiffness, one, 0.0 * one, 0.0 * one, gap, -one, np.zeros(count))
    image = Image()
    drops, out = image.record(numbers), image.record(_outcomes(count, 2))
    space = image.record(lane_workspace(compiled=True).record)
    image.call("run_two_springs", drops, _LIMIT, out, space)
    return image


def _outcomes(count: int, balls: int) -> Outcomes:
    """Return room for outcomes, all of the same bits; no drop is under way."""
    out = new_outcomes(count, balls)
    for array in out:
        array[...] = codes.ASK
    return out


def run_here(image: Image) -> np.ndarray:
    """Return the memory after the calls, done by this machine's library."""
    memory = image.words()
    room = np.zeros(memory.size + _LINE, dtype=np.int64)
    start = -(room.ctypes.data // _WORD) % _LINE
    there = room[start : start + memory.size]
    there[:] = memory
    base = there.ctypes.data
    there[image.places] += base
    for which, *words in image.calls:
        function = native.compiled(_ENTRIES[which])
        kinds = [kind.__name__ for kind in function.argtypes]
        given = [
            word + base if kind == "c_void_p" else _real(word) if kind == "c_double" else word
            for kind, word in zip(kinds, words, strict=False)
        ]
        row = function(*given)
        while row < words[-1]:  # of a batch, whose last word is the number of its drops
            row = function(*given[:-1], row)
    there[image.places] -= base
    return there


def _real(word: int) -> float:
    number: float = struct.unpack("<d", struct.pack("<q", word))[0]
    return number


def run_there(image: Image, command: list[str], library: Path, suffix: str) -> np.ndarray:
    """Return the memory after the calls, done by another library."""
    with tempfile.TemporaryDirectory() as room:
        before, after = Path(room) / "before", Path(room) / "after"
        words = image.words()
        sizes = [len(image.places), len(image.calls), words.size]
        calls = np.array(image.calls, dtype=np.int64).reshape(-1)
        np.concatenate([sizes, image.places, calls, words]).astype("<i8").tofile(before)
        subprocess.run([*command, library, suffix, before, after], check=True)
        return np.fromfile(after, dtype="<i8")


def differing(here: np.ndarray, there: np.ndarray) -> int:
    """Return the number of words that differ; all nans are one, as processors differ in signs."""
    nans = np.isnan(here.view(float)) & np.isnan(there.view(float))
    return int(np.count_nonzero((here != there) & ~nans))


def main() -> int:
    """Compare; return 1 if something differs."""
    parser = argparse.ArgumentParser(prog="python -m kernel_build.check_library")
    parser.add_argument("platform", choices=list(_C))
    parser.add_argument("folder", type=Path, help="where the library is")
    parser.add_argument("--run", default="", help="the command that runs the platform's programs")
    parser.add_argument("--drops", type=int, default=1000)
    parser.add_argument("--level", default="", help="of the processor, such as v3")
    given = parser.parse_args()
    library = (given.folder / TARGETS[given.platform].file).resolve()
    suffix = f"_{given.level}" if given.level else ""
    batches = len(draw.BALLS)
    images = [random_image(batch, -(-given.drops // batches)) for batch in range(batches)]
    images.append(springs_image(given.drops))
    with tempfile.TemporaryDirectory() as room:
        program = str(Path(room) / "check.exe")
        compiler = [sys.executable, "-m", "ziglang", "cc", "-target", _C[given.platform], "-O1"]
        subprocess.run([*compiler, str(_PROGRAM), "-o", program], check=True)
        command = [*shlex.split(given.run), program]
        wrong = sum(
            differing(run_here(image), run_there(image, command, library, suffix))
            for image in images
        )
    words = sum(image.words().size for image in images)
    print(f"{wrong} of {words} words of memory differ")  # noqa: T201 - what the command is for
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
