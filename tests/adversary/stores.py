"""Damaged stores of sweeps: `python -m adversary.stores --count 200`, in tests.

The same command says what is damaged, and mends it or refuses. It never takes a damaged store for
a whole one, and it never deletes what is not its own.
"""

import contextlib
import shutil
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from adversary.processes import STORE, Forked, content, run, sweep, undisturbed
from adversary.table import Case, begin, expect

FOREIGN = b"somebody's own notes"
_RESULTS = "collisions energy_retained first_touch last_release rebound_ratio status".split()
_ARRAYS = (*_RESULTS, *_RESULTS, "balls_0_mass", "gaps_0")
Random = np.random.Generator
Harm = Callable[[Path, Random], None]


def _files(store: Path, name: str) -> list[Path]:
    return sorted(one for one in store.rglob(name) if one.is_file())


def _one(paths: list[Path], random: Random) -> Path:
    return paths[int(random.integers(len(paths)))]


def _remove(path: Path, _: Random) -> None:
    path.unlink()


def _shorten(path: Path, random: Random) -> None:
    path.write_bytes(path.read_bytes()[: int(random.integers(max(1, path.stat().st_size // 2)))])


def _garble(path: Path, random: Random) -> None:
    path.write_bytes(random.bytes(path.stat().st_size))


_WAYS = (_remove, _shorten, _garble)


def chunk(store: Path, random: Random) -> None:
    for _ in range(int(random.integers(1, 4))):
        own = _ARRAYS[int(random.integers(len(_ARRAYS)))]
        if paths := _files(store / own, "[0-9]*"):  # a part of a store may have no more
            _WAYS[int(random.integers(len(_WAYS)))](_one(paths, random), random)


def metadata(store: Path, random: Random) -> None:
    """Damage a file that says what the store holds."""
    _WAYS[int(random.integers(len(_WAYS)))](_one(_files(store, ".z*"), random), random)


def array(store: Path, random: Random) -> None:
    """Remove a whole array, or its chunks."""
    name = _ARRAYS[int(random.integers(len(_ARRAYS)))]
    shutil.rmtree(store / name)
    if random.integers(2):
        (store / name).mkdir()


def log(store: Path, random: Random) -> None:
    """Damage the file beside the store that says what is done."""
    path = store.with_name(f"{store.name.removesuffix('.partial')}.progress")
    old = path.read_bytes() if path.is_file() else b""
    path.write_bytes(
        (
            random.bytes(50),
            b"",
            old[: len(old) // 2],
            old + b"9999999999999999999999999\n-1\n",
            old + b"".join(b"%d\n" % number for number in range(10)),
            old.replace(b"\n", b"\n\n") + FOREIGN,
            b"# process 1 on x since 2026-01-01 00:00:00\n0 0\n1\n",
            b"# process 1 on x since 2026-01-01 00:00:00\n7 7 7\n1\n",
            b"# process 1 on x since 2026-01-01 00:00:00\n30 20\n0\n",
        )[int(random.integers(9))]
    )


def nothing(_: Path, __: Random) -> None:
    """Leave the store as it is: the foreign files alone are to be kept."""


HARMS: tuple[Harm, ...] = (chunk, chunk, metadata, array, log, nothing)


@contextlib.contextmanager
def attack(folder: Path) -> Iterator[Case]:
    """Damage a store, every other one complete and the others part of a sweep; sweep again."""
    whole, logs = undisturbed(folder), folder / "logs"

    def case(index: int, random: Random, own: Path) -> None:
        store = _made(own, logs, complete=bool(index % 2))
        harm = HARMS[int(random.integers(len(HARMS)))]
        before = content(store)
        harm(store, random)
        harmed = content(store) != before
        foreign = _add_foreign(store, random)
        ended = run(sweep(STORE), own, logs)
        said = f"({store.name}, {harm.__name__}): {ended.code} {ended.err}"
        expect(not ended.inner and (ended.refused or not ended.code), "inner error", said)
        expect(all(_is_kept(path, own) for path in foreign), "foreign file deleted", said)
        if ended.code == 0:
            files = content(own / STORE)
            ours = {name: file for name, file in files.items() if file != FOREIGN}
            expect(ours == whole.files, "wrong success", said)
            silent = harmed and store.suffix != ".partial" and not ended.err
            expect(not silent, "mended without a word", said)

    yield case


def _made(own: Path, logs: Path, *, complete: bool) -> Path:
    """Return a complete store, or a part of one whose writer was killed."""
    out = own / STORE
    partial = out.with_name(f"{out.name}.partial")
    while True:
        process = Forked(sweep(out.name), own, logs)
        if complete:
            process.wait()
            return out
        while not out.exists() and len(_files(partial / "status", "[0-9]*")) < 3:
            time.sleep(0.001)
        process.send(signal.SIGKILL, 0.0)
        process.wait()
        if partial.exists():
            return partial
        shutil.rmtree(out) if out.is_dir() else out.unlink()


def _add_foreign(store: Path, random: Random) -> list[Path]:
    """Put foreign files into a store and beside it."""
    paths = [store.with_name(f"{store.name}.notes")]
    if store.is_dir():
        folders = [one for one in (store, store / "status") if one.is_dir()]
        names = ("notes.txt", "notes.partial", ".notes", "notes.0")
        paths.append(_one(folders, random) / names[int(random.integers(len(names)))])
    for path in paths:
        path.write_bytes(FOREIGN)
    return paths


def _is_kept(path: Path, own: Path) -> bool:
    return any(
        one.is_file() and one.name == path.name and one.read_bytes() == FOREIGN
        for one in own.rglob(path.name)
    )


if __name__ == "__main__":
    sys.exit(begin("stores", attack, 200))
