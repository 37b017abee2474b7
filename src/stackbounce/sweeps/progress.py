"""The file beside a sweep that is being written: who writes it, and which blocks are done.

``NAME.progress`` is locked for as long as a process writes to ``NAME.partial``. The system ends the
lock with the process, however that ends. The lines of the file are::

    # process 4711 on host since 2026-11-22 18:50:03     a writer; the last one is the present one
    3 2                                                  the sides of a block
    17                                                   the number of a block that is written

The second line comes when the coordinates are there; before, nothing in ``NAME.partial`` counts.
"""

import contextlib
import os
import platform
from collections.abc import Iterable, Iterator
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from stackbounce.errors import FileError, shown

__all__ = ["Progress", "only_writer"]

_WRITER = "# "


class Progress:
    """What is done of a sweep, in a file that this process has locked.

    Parameters
    ----------
    path : Path
        The file.
    file : binary file
        It, open and locked.
    """

    def __init__(self, path: Path, file: BinaryIO) -> None:
        self._path, self._file = path, file
        file.seek(0)
        content = file.read()
        whole = content[: content.rfind(b"\n") + 1]  # the last line may be half written
        lines = whole.decode("ascii", "replace").splitlines()
        self.is_known = any(line.startswith(_WRITER) for line in lines)
        """Whether the file was there, and so ``NAME.partial`` is of this program."""
        numbers = [line.split() for line in lines if not line.startswith(_WRITER)]
        try:
            values = [[int(word) for word in words] for words in numbers]
            self.sides = tuple(values[0]) if values else None
            """The sides of a block; None before the coordinates are there."""
            self.done = {number for (number,) in values[1:]}
            """The numbers of the blocks that are written."""
        except ValueError:
            raise FileError(f"{path} is damaged, it has {shown(whole[:40])}") from None
        self._length = len(whole)

    def sign(self) -> None:
        """Note that this process is the writer from now on."""
        self._file.truncate(self._length)
        self._append(f"{_WRITER}{_this_process()}")

    def begin(self, sides: Iterable[int], done: Iterable[int] = ()) -> None:
        """Note that the coordinates are there, in blocks of these sides, some written already."""
        self._file.truncate(0)
        self.sides, self.done = tuple(sides), set(done)
        words = " ".join(map(str, self.sides))
        self._append("\n".join([f"{_WRITER}{_this_process()}", words, *map(str, self.done)]))

    def add(self, number: int) -> None:
        """Note that a block is written."""
        self._append(str(number))

    def remove(self) -> None:
        """Remove the file: the sweep is complete, or nothing of it is there."""
        with contextlib.suppress(PermissionError):  # of Windows, while it is open
            self._path.unlink(missing_ok=True)

    def _append(self, line: str) -> None:
        self._file.seek(0, os.SEEK_END)
        self._file.write(f"{line}\n".encode("ascii", "replace"))
        self._file.flush()


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
    path = out.with_name(f"{out.name}.progress")
    with _opened(path, out) as file:
        yield Progress(path, file)


@contextlib.contextmanager
def _opened(path: Path, out: Path) -> Iterator[BinaryIO]:
    """Open and lock a file that a writer that ends may remove at any time."""
    while True:
        with os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b", buffering=0) as file:
            if not _locked(file):
                raise FileError(f"{out} is being written {_writer(path)}: wait until it has ended")
            if path.exists() and os.path.samestat(path.stat(), os.fstat(file.fileno())):
                yield file
                return


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
        lines = path.read_text("ascii", "replace").splitlines()
    except OSError:
        lines = []
    return next(
        (f"by {line[len(_WRITER) :]}" for line in reversed(lines) if line.startswith(_WRITER)),
        "by another process",
    )


def _this_process() -> str:
    now = datetime.now().astimezone().isoformat(" ", "seconds")
    return f"process {os.getpid()} on {platform.node() or 'this machine'} since {now}"
