"""The file beside a sweep that is being written, which says who writes it.

``NAME.progress`` is locked for as long as a process writes to ``NAME.partial``. The system ends the
lock with the process, however that ends. The lines of the file are::

    # process 4711 on host since 2026-11-22 18:50:03     a writer; the last one is the present one
    ready                                                the coordinates are there

Before the second line, nothing in ``NAME.partial`` counts; then all blocks that it has do.
"""

import contextlib
import errno
import os
import platform
import stat
import time
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from stackbounce.errors import FileError, shown

_WRITER, _READY = "# ", "ready"
_PATIENCE = 2.0  # s, for a writer to say who it is
_PAUSE = 0.01  # s
_LONGEST = 2**20  # bytes: ten thousand writers


class Progress:
    """Who writes a sweep, in a file that this process has locked.

    Parameters
    ----------
    path : Path
        The file.
    file : binary file
        It, open and locked.
    """

    def __init__(self, path: Path, file: BinaryIO) -> None:
        self._path, self._file = path, file
        content = file.read(_LONGEST + 1)
        whole = content[: content.rfind(b"\n") + 1]  # the last line may be half written
        lines = list(filter(None, whole.decode("ascii", "replace").splitlines()))
        others = [line for line in lines if line != _READY and not line.startswith(_WRITER)]
        if others or len(content) > _LONGEST or content[:2] not in (b"", b"#", b"# "):
            raise FileError(
                f"{path} is damaged, it has {shown(others[0] if others else content[:40])}: remove "
                f"it, and move {path.stem}.partial away or remove it"
            )
        self.is_known = bool(lines)
        """Whether the file was there, and so ``NAME.partial`` is of this program."""
        self.is_ready = _READY in lines
        """Whether the coordinates are there."""
        self._length = len(whole)

    def sign(self) -> None:
        """Note that this process is the writer from now on."""
        self._file.truncate(self._length)
        now = datetime.now().astimezone().isoformat(" ", "seconds")
        host = platform.node() or "this machine"
        self._append(f"{_WRITER}process {os.getpid()} on {host} since {now}")

    def withdraw(self) -> None:
        """Take back that this process is the writer: leave the file as it was found."""
        self._file.truncate(self._length)
        if not self._length:
            self.remove()

    def begin(self) -> None:
        """Note that the coordinates are there."""
        self._append(_READY)

    def remove(self) -> None:
        """Remove the file: the sweep is complete, or nothing of it is there."""
        with contextlib.suppress(PermissionError):  # of Windows, while it is open
            self._path.unlink(missing_ok=True)

    def _append(self, line: str) -> None:
        self._file.seek(0, os.SEEK_END)
        content = f"{line}\n".encode("ascii", "replace")
        if self._file.write(content) != len(content):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@contextlib.contextmanager
def only_writer(out: Path) -> Iterator[Progress]:
    """Lock the progress of a sweep for as long as the context lasts.

    Raises
    ------
    FileError
        If another process writes it; the message says which, and since when.
    OSError
        If the file cannot be opened.
    """
    path = _path(out)
    with _opened(path, out) as file:
        yield Progress(path, file)


def tidy(out: Path) -> None:
    """Remove what is left of a writer that was killed when the sweep was already complete."""
    if _path(out).exists():
        with contextlib.suppress(OSError), only_writer(out) as log:
            if log.is_known:
                log.remove()


def _path(out: Path) -> Path:
    return out.with_name(f"{out.name}.progress")


@contextlib.contextmanager
def _opened(path: Path, out: Path) -> Iterator[BinaryIO]:
    """Open and lock a file that a writer that ends may remove at any time."""
    end = time.monotonic() + _PATIENCE
    while True:
        with os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b", buffering=0) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise FileError(f"{path} is no ordinary file: remove it")
            locked = _locked(file)
            if locked and _is_at(path, file):
                yield file
                return
        if not locked:
            writer = _writer(path)
            if writer or time.monotonic() > end:
                who = writer or "another process"
                raise FileError(f"{out} is being written by {who}: wait until it has ended")
            time.sleep(_PAUSE)  # it has not said who it is, or has just ended


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
    """Return who writes a file that is locked, as it says; nothing if it does not."""
    try:
        lines = path.read_text("ascii", "replace").splitlines()
    except OSError:
        return ""
    signed = [line[len(_WRITER) :] for line in lines if line.startswith(_WRITER)]
    return signed[-1] if signed else ""
