"""Full disks: `python -m adversary.disks --count 60`, in tests.

A small file system in memory is filled up to a random place. Each command ends with one line, keeps
the files that were there, and with room again makes what it makes undisturbed.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from adversary.processes import Ended, content, random_of, run, sweep
from adversary.table import Failure, NotPermitted, begin

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


def attack(count: int, seed: int, folder: Path) -> list[Failure]:
    """Run commands on a disk with so little room, each so often that all are run `count` times."""
    disk = folder / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={SIZE}", "none", str(disk)]
    done = subprocess.run(mount, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NotPermitted(f"mounting is not permitted: {done.stderr.strip()}")
    try:
        return _attack(count, seed, disk, folder / "logs")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def _attack(count: int, seed: int, disk: Path, logs: Path) -> list[Failure]:
    failures = []
    whole: dict[int, tuple[Ended, dict[str, bytes]]] = {}
    for index in range(count):
        random, number = random_of(seed, index), index % len(COMMANDS)
        arguments = COMMANDS[number]
        if number not in whole:
            whole[number] = _emptied(disk, run(arguments, disk, logs))
        ended, files = whole[number]
        if ended.code:
            raise RuntimeError(f"{' '.join(arguments)} does not run at all: {ended.err}")
        wrong, said = _wrong(arguments, disk, logs, files, random)
        if wrong:
            failures.append(Failure(wrong, f"{index} ({' '.join(arguments)}): {said.strip()}"))
        _emptied(disk, ended)
    return failures


def _wrong(
    arguments: list[str],
    disk: Path,
    logs: Path,
    files: dict[str, bytes],
    random: np.random.Generator,
) -> tuple[str, str]:
    """Run a command on a disk that is full somewhere, then with room; return what is wrong."""
    old = {name: b"a good old file" for name in files if name.startswith("new.")}
    if random.integers(2):
        for name, text in old.items():
            (disk / name).write_bytes(text)
    before = content(disk)
    most = SIZE if random.integers(3) == 0 else 1.2 * sum(map(len, files.values()))
    room = int(random.integers(0, most))
    _fill(disk / "ballast", room)
    ended = run(arguments, disk, logs)
    (disk / "ballast").unlink()
    if ended.inner or (ended.code and not ended.refused):
        return "inner error", ended.err
    if ended.code:
        now = content(disk)
        if any(now.get(name) != text for name, text in before.items()):
            return "a good file lost", ended.err
        if new := [name for name in old if name in now and name not in before]:
            return "half a file", f"{new}: {ended.err}"
    again = run(arguments, disk, logs)
    if again.code or content(disk) != files:
        return "not as undisturbed", f"{ended.err} {again.err} {sorted(content(disk))[:9]}"
    return "", ""


def _fill(path: Path, room: int) -> None:
    """Fill a disk but for so many bytes, about."""
    with path.open("wb") as file:
        space = os.statvfs(path.parent)
        file.write(bytes(max(0, space.f_bavail * space.f_frsize - room)))


def _emptied(disk: Path, ended: Ended) -> tuple[Ended, dict[str, bytes]]:
    """Remove all from a disk; return how a command ended, and all its files."""
    files = content(disk)
    for path in disk.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return ended, files


def _with_own_mounts() -> int:
    """Run this file in a name space of its own for mounts, for which no privilege is needed."""
    inside = ["unshare", "--map-root-user", "--mount", sys.executable, "-m", "adversary.disks"]
    if shutil.which("unshare") and not subprocess.call(["unshare", "-rm", "true"]):
        return subprocess.call([*inside, *sys.argv[1:]], env=os.environ | {_INSIDE: "1"})
    return begin("disks", attack, 60)


if __name__ == "__main__":
    sys.exit(begin("disks", attack, 60) if _INSIDE in os.environ else _with_own_mounts())
