"""Full disks: `python -m adversary.disks --count 60`, in tests.

A small file system in memory is filled up to a random place. Each command ends with one line, keeps
the files that were there, and with room again makes what it makes undisturbed.
"""

import contextlib
import functools
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from adversary.processes import content, run, sweep
from adversary.table import Case, NotPermitted, begin, expect

SIZE = 2**22  # bytes of the disk
_INSIDE = "STACKBOUNCE_OWN_MOUNTS"
_PAIR = ("basketball", "tennis", "--height", "63cm")
_FIT = (
    *("fit", *_PAIR, "--measured", "rebound_ratios.1=1.64 ± 0.02"),
    *("--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m"),
)
COMMANDS = (
    sweep("map.zarr"),
    [*sweep("map.zarr"), "--plot", "new.png", "--overwrite"],
    ["simulate", *_PAIR, "--plot", "new.svg", "--overwrite"],
    ["simulate", *_PAIR, "--plot", "new.pdf", "--overwrite"],
    ["simulate", *_PAIR, "--plot", "new.png", "--overwrite"],
    [*_FIT, "--save", "new.toml", "--overwrite"],
    [*_FIT, "--plot", "new.svg", "--overwrite"],
)


@contextlib.contextmanager
def attack(folder: Path) -> Iterator[Case]:
    """Run a command on a disk with so little room, all of them in turn."""
    disk, logs = folder / "disk", folder / "logs"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={SIZE}", "none", str(disk)]
    done = subprocess.run(mount, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NotPermitted(f"mounting is not permitted: {done.stderr.strip()}")

    @functools.cache
    def undisturbed(number: int) -> dict[str, bytes]:
        """Return the files of a command that has room enough."""
        ended = run(COMMANDS[number], disk, logs)
        if ended.code:
            raise RuntimeError(f"{' '.join(COMMANDS[number])} does not run at all: {ended.err}")
        return _emptied(disk)

    def case(index: int, random: np.random.Generator, _: Path) -> None:
        number = index % len(COMMANDS)
        files = undisturbed(number)
        try:
            _fail_and_go_on(COMMANDS[number], disk, logs, files, random)
        finally:
            _emptied(disk)

    try:
        yield case
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def _fail_and_go_on(arguments, disk, logs, files, random):
    """Run a command on a disk that is full somewhere, then with room."""
    old = {name: b"a good old file" for name in files if name.startswith("new.")}
    if random.integers(2):
        for name, text in old.items():
            (disk / name).write_bytes(text)
    before = content(disk)
    most = SIZE if random.integers(3) == 0 else 1.2 * sum(map(len, files.values()))
    _fill(disk / "ballast", int(random.integers(0, most)))
    ended = run(arguments, disk, logs)
    (disk / "ballast").unlink()
    said = f"({' '.join(arguments)}): {ended.err}"
    expect(not ended.inner and (ended.refused or not ended.code), "inner error", said)
    if ended.code:
        now = content(disk)
        kept = all(now.get(name) == text for name, text in before.items())
        expect(kept, "a good file lost", said)
        new = [name for name in old if name in now and name not in before]
        expect(not new, "half a file", f"{new} {said}")
    again = run(arguments, disk, logs)
    same = not again.code and content(disk) == files
    expect(same, "not as undisturbed", f"{said} {again.err} {sorted(content(disk))[:9]}")


def _fill(path: Path, room: int) -> None:
    """Fill a disk but for so many bytes, about."""
    with path.open("wb") as file:
        space = os.statvfs(path.parent)
        file.write(bytes(max(0, space.f_bavail * space.f_frsize - room)))


def _emptied(disk: Path) -> dict[str, bytes]:
    """Remove all from a disk; return its files."""
    files = content(disk)
    for path in disk.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return files


def _with_own_mounts() -> int:
    """Run this file in a name space of its own for mounts, for which no privilege is needed."""
    inside = ["unshare", "--map-root-user", "--mount", sys.executable, "-m", "adversary.disks"]
    if shutil.which("unshare") and not subprocess.call(["unshare", "-rm", "true"]):
        return subprocess.call([*inside, *sys.argv[1:]], env=os.environ | {_INSIDE: "1"})
    return begin("disks", attack, 60)


if __name__ == "__main__":
    sys.exit(begin("disks", attack, 60) if _INSIDE in os.environ else _with_own_mounts())
