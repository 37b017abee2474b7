"""A sweep larger than memory, written to a file block by block; it can be stopped and resumed.

Until it is complete the file is called ``NAME.partial``, and ``NAME.begun`` until all but the
results is there. ``NAME.progress`` beside it says who writes it: one process writes at a time. It
is locked for as long as a process writes to ``NAME.partial``, and removed then. The system ends the
lock with the process, however that ends; a file that is left has no meaning. The final bytes do not
depend on how often the sweep was stopped. A file that is complete has all its blocks, and each can
be read; those that cannot are computed again.
"""

import contextlib
import itertools
import math
import os
import platform
import re
import shutil
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TypeAlias

from stackbounce.errors import FileError, InvalidValue, instance, shown, whole
from stackbounce.library_types import Dataset
from stackbounce.model import Drop
from stackbounce.run.batch import Block, size
from stackbounce.sweeps import files
from stackbounce.sweeps.dataset import check_along, read_values, sweep
from stackbounce.sweeps.files import Axes, Form, sizes

if TYPE_CHECKING:
    from distributed import Client

_WRITER = b"# process "
_ATTEMPTS, _PAUSE = 100, 0.01  # s: as long is waited for a writer to say who it is
BLOCK = 2**16
"""Drops in a block, at most."""

_TOGETHER = 4  # blocks submitted to a cluster at a time, for each of its threads
_DIMENSION = re.compile(r"\w[\w.-]*")  # a name that all kinds of file can have
_Done: TypeAlias = Iterator[tuple[Block, Dataset]]


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
    """Open and lock a file that a writer that ends may remove at any time.

    One that has just locked it has not said yet who it is, and is waited for.
    """
    for attempt in itertools.count():
        with os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b", buffering=0) as file:
            if not _locked(file):
                writer = _writer(path)
                if writer or attempt == _ATTEMPTS:
                    raise FileError(
                        f"{out} is being written by {writer or 'another process'}: wait until it "
                        "has ended"
                    )
                time.sleep(_PAUSE)
            elif _is_at(path, file):
                yield file
                return


def _is_at(path: Path, file: BinaryIO) -> bool:
    """Return whether an open file still has its name."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file.fileno()))
    except FileNotFoundError:
        return False


def _locked(file: BinaryIO) -> bool:
    """Lock an open file unless another process has; return whether it is locked."""
    number = file.fileno()
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
    """Return who writes a file that is locked, as it says; "" if it does not, or is gone."""
    try:
        return path.read_text("ascii", "replace").strip().removeprefix("# ")
    except OSError:
        return ""


def write(
    out: str | Path,
    drop: Drop,
    values: Mapping[str, Any],
    *,
    client: "Client | None" = None,
    block: int = BLOCK,
    progress: Callable[[int, int], None] | None = None,
    **options: Any,
) -> Path:
    """Sweep a drop over a grid into a file, or resume a sweep that was stopped.

    Parameters
    ----------
    out : str or path-like
        The Zarr store, whose name ends in ``.zarr``. It must not exist yet unless it is the same
        sweep, complete. ``xarray.open_zarr(out).to_netcdf("map.nc")`` makes a NetCDF file of it.
    drop : Drop
        The base.
    values : mapping
        The numbers that vary, by their paths, as `sweep` takes them: each a 1-D array, which is a
        dimension of the file, or a pair of a dimension's name and such an array. Numbers that share
        a dimension vary together.
    client : distributed.Client, optional
        A cluster to solve the blocks on; by default they are solved here, on all cores.
    block : int, optional
        The most drops that are solved and written at once; a resumed sweep keeps its first value.
    progress : callable, optional
        Called after each block with the number of drops done and the number of all.
    **options
        `until`, `rtol` and `event_limit`, as in `simulate`.

    Returns
    -------
    pathlib.Path
        The file, to be opened with ``xarray.open_zarr``.

    Raises
    ------
    InvalidValue, InvalidType
        As in `sweep`; or the name ends in something else.
    FileError
        If the file cannot be written, another sweep has its name, or another process writes it; or
        if the cluster fails.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> import xarray as xr
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> folder = getfixture("tmp_path")
    >>> path = write(folder / "map.zarr", drop, {"balls.0.mass": np.linspace(1.0, 2.0, 5)})
    >>> xr.open_zarr(path).collisions.values.ravel()
    array([1, 1, 1, 1, 1])
    """
    instance("drop", drop, Drop)
    out, report = Path(out), progress or (lambda *_: None)
    files.check_name(out)
    whole("block", block, 1)
    axes = _read_axes(drop, values)
    first = sweep(drop, {path: (dim, axis[:1]) for path, (dim, axis) in axes.items()}, **options)
    form = Form(first, axes, block)
    total = math.prod(form.grid)
    try:
        if _is_complete(out, form):
            report(total, total)
            return out
        with only_writer(out) as killed:
            if _is_complete(out, form):  # by another process, since then
                report(total, total)
                return out
            partial = _begin(out, form, killed)
            todo, _ = files.lost(partial, form)
            finished = total - sum(map(size, todo))
            report(finished, total)
            with files.writer(partial) as put:
                for part, data in _solved(drop, axes, todo, options, client):
                    put(part, data)
                    finished += size(part)
                    report(finished, total)
            partial.rename(out)
    except FileError:
        raise
    except OSError as error:
        raise FileError(f"{out} cannot be written: {error.strerror or error}") from error
    return out


def _read_axes(drop: Drop, values: Mapping[str, Any]) -> Axes:
    """Return the dimension and the values of each number that varies, all of them checked."""
    axes = {}
    for number, array in zip(*read_values(drop, values), strict=True):
        if array.ndim != 1 or not _DIMENSION.fullmatch(str(array.dims[0])):
            listed = ", ".join(map(str, array.dims)) or "none"
            raise InvalidValue(
                f"{number.path} must have one dimension in a file, with a name of letters, digits, "
                f"_, . and -, got {listed}"
            )
        axes[number.path] = str(array.dims[0]), array.values
    for dim in sizes(axes):
        check_along(drop, dim, {path: axis for path, (own, axis) in axes.items() if own == dim})
    return axes


def _is_complete(out: Path, form: Form) -> bool:
    """Return whether the complete file of this sweep exists; raise if it holds another sweep."""
    if not out.exists():
        return False
    if not _is_same(out, form):
        raise FileError(f"{out} exists, and is not this sweep: remove it or choose another name")
    return not files.lost(out, form)[0]


def _begin(out: Path, form: Form, killed: bool) -> Path:
    """Return the file to go on with: a part of this sweep, or one with lost blocks, or a new one.

    `killed` says whether an earlier writer was killed, which may have left ``NAME.begun``.
    """
    partial = out.with_name(f"{out.name}.partial")
    if partial.exists() and out.exists():
        raise FileError(
            f"{out} has lost blocks, and {partial} is a second one, not complete: "
            "remove one of the two"
        )
    if partial.exists():
        if not _is_same(partial, form):
            raise FileError(
                f"{partial} is part of another sweep: remove it, or choose another name"
            )
    elif out.exists():
        lost, count = files.lost(out, form)
        warnings.warn(
            f"{out}: {len(lost)} of {count} blocks are missing or damaged, and computed again",
            stacklevel=3,
        )
        out.rename(partial)
    else:
        begun = out.with_name(f"{out.name}.begun")
        if begun.exists() and not killed:
            raise FileError(f"{begun} exists, and is not of a sweep: move it away")
        shutil.rmtree(begun, ignore_errors=True)
        try:
            files.create(begun, form)
        except BaseException:  # such as a full disk, or Ctrl+C
            shutil.rmtree(begun, ignore_errors=True)
            raise
        begun.rename(partial)
    return partial


def _is_same(path: Path, form: Form) -> bool:
    """Return whether a file is of this sweep; raise if it cannot be read."""
    try:
        with files.opened(path) as found:
            return form.is_of(found)
    except (KeyError, ValueError):
        return False
    except (OSError, RuntimeError) as error:  # of the file, or of what decompresses it
        raise FileError(
            f"{path} exists, and cannot be read ({' '.join(str(error).split())[:100]}): "
            "remove it or choose another name"
        ) from error


def _solved(
    drop: Drop, axes: Axes, todo: list[Block], options: Mapping[str, Any], client: "Client | None"
) -> _Done:
    """Yield blocks with their results as they are finished; few are in memory at a time."""
    jobs = ((block, _part(axes, block)) for block in todo)
    if client is None:
        return ((block, sweep(drop, part, **options)) for block, part in jobs)
    return _on_cluster(client, drop, list(jobs), options)


def _on_cluster(
    cluster: Any, drop: Drop, jobs: Sequence[tuple[Block, Axes]], options: Mapping[str, Any]
) -> _Done:
    """Yield blocks with their results, some for each thread of the cluster at a time."""
    with _cluster_errors():
        together = _TOGETHER * max(1, sum(cluster.nthreads().values()))
    for start in range(0, len(jobs), together):
        some = jobs[start : start + together]
        with _cluster_errors():
            futures = [cluster.submit(sweep, drop, part, pure=False, **options) for _, part in some]
            found = cluster.gather(futures)
        yield from zip((block for block, _ in some), found, strict=True)


@contextlib.contextmanager
def _cluster_errors() -> Iterator[None]:
    """Convert errors of the cluster to FileError with the advice to resume the sweep."""
    from distributed import KilledWorker, client

    closed = getattr(client, "ClosedClientError", KilledWorker)  # older versions have none
    try:
        yield
    except (OSError, CancelledError, KilledWorker, closed) as error:
        what = " ".join(str(error).split()) or type(error).__name__
        raise FileError(
            "the cluster failed; the blocks done are kept, and the same command goes on from "
            f"there ({what[:200]})"
        ) from error


def _part(axes: Axes, block: Block) -> Axes:
    sides = dict(zip(sizes(axes), block, strict=True))
    return {path: (dim, axis[sides[dim]]) for path, (dim, axis) in axes.items()}
