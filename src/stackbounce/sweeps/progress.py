"""The lock beside a sweep that is being written: ``NAME.progress`` says who writes.

It is locked for as long as a process writes to ``NAME.partial``, and removed then. The system ends
the lock with the process, however that ends; a file that is left has no meaning.
"""

import contextlib
import os
import platform
import stat
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from stackbounce.errors import FileError, shown

_WRITER = b"# process "


@contextlib.contextmanager
def only_writer(out: Path) -> Iterator[bool]:
    """Be the only process that writes a sweep, and yield whether an earlier one was killed.

    Raises
    ------
    FileError
        If another process writes it, or the file of that name is not of this program.
    """
    path = out.with_name(f"{out.name}.progress")
    with _opened(path, out) as file:
        content = file.read(100)
        if content[: len(_WRITER)] != _WRITER[: len(content)]:
            raise FileError(
                f"{path} is damaged, it has {shown(content[:40])}: remove it or choose another name"
            )
        now = datetime.now().astimezone().isoformat(" ", "seconds")
        host = platform.node() or "this machine"
        file.seek(0)
        file.truncate()
        file.write(_WRITER + f"{os.getpid()} on {host} since {now}\n".encode("ascii", "replace"))
        try:
            yield bool(content)
        finally:
            with contextlib.suppress(PermissionError):  # of Windows, while it is open
                path.unlink(missing_ok=True)


@contextlib.contextmanager
def _opened(path: Path, out: Path) -> Iterator[BinaryIO]:
    """Open and lock a file that a writer that ends may remove at any time."""
    while True:
        with os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b", buffering=0) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise FileError(f"{path} is no ordinary file: remove it")
            if not _locked(file):
                raise FileError(
                    f"{out} is being written by {_writer(path)}: wait until it has ended"
                )
            if _is_at(path, file):
                yield file
                return


def _is_at(path: Path, file: BinaryIO) -> bool:
    """Return whether an open file still has its name."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file.fileno()))
    except FileNotFoundError:
        return False


def _locked(file: object) -> bool:
    """Lock an open file unless another process has; return whether it is locked."""
    number: int = file.fileno()  # type: ignore[attr-defined]
    try:
        if os.name == "nt":
            import msvcrt

            os.lseek(number, 2**30, os.SEEK_SET)  # beyond what is read by others
            msvcrt.locking(number, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        else:
            import fcntl

            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def _writer(path: Path) -> str:
    """Return who writes a file that is locked, as it says."""
    try:
        line = path.read_text("ascii", "replace").strip()
    except OSError:
        line = ""
    return line.removeprefix("# ") or "another process"
