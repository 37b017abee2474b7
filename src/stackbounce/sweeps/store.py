"""A sweep larger than memory, written to a file block by block; it can be stopped and resumed.

Until it is complete the file is called ``NAME.partial``. The file ``NAME.progress`` beside it holds
the sides of a block in its first line, and the number of each block written in the lines after it.
The final bytes do not depend on how often the sweep was stopped.
"""

import contextlib
import math
import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import CancelledError
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError, InvalidValue
from stackbounce.model import Drop
from stackbounce.run.blocks import Block, blocks, sides, size
from stackbounce.sweeps.dataset import check_axis, sweep
from stackbounce.sweeps.files import Form, Format, format_of

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

__all__ = ["Grid", "opened", "write"]

BLOCK = 2**16
"""Drops in a block, at most."""

_AHEAD = 3  # blocks submitted to a cluster for each of its threads
Grid: TypeAlias = Mapping[str, NDArray[np.float64]]
_Todo: TypeAlias = Iterator[tuple[int, Block]]
_Done: TypeAlias = Iterator[tuple[int, Block, "xr.Dataset"]]


def write(
    out: str | Path,
    drop: Drop,
    values: Grid,
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
        The file: a Zarr store if it ends in ``.zarr``, NetCDF-4 if in ``.nc``, for which the extra
        ``netcdf`` must be installed. It must not exist yet unless it is the same sweep, complete.
    drop : Drop
        The base.
    values : mapping
        The numbers that vary, by their paths, each a 1-D array: a dimension of the file.
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
        The file, to be opened with ``xarray.open_zarr`` or ``xarray.open_dataset``.

    Raises
    ------
    InvalidValue, InvalidType
        As in `sweep`; or the name ends in something else.
    FileError
        If the file cannot be written, or another sweep has its name; or if the cluster fails.

    Examples
    --------
    >>> import stackbounce as sb
    >>> import xarray as xr
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> folder = getfixture("tmp_path")
    >>> path = write(folder / "map.zarr", drop, {"balls.0.mass": np.linspace(1.0, 2.0, 5)})
    >>> xr.open_zarr(path).collisions.values.ravel()
    array([1, 1, 1, 1, 1])
    """
    out, tell = Path(out), progress or _tell_nobody
    kind = format_of(out)
    if block < 1:
        raise InvalidValue(f"block must be a number of drops, 1 or above, got {block}")
    for path, axis in values.items():
        check_axis(drop, path, axis)
    shape = tuple(len(axis) for axis in values.values())
    first = sweep(drop, {path: axis[:1] for path, axis in values.items()}, **options)
    form = Form(first, values, sides(shape, block))
    total = math.prod(shape)
    partial, log = out.with_name(f"{out.name}.partial"), out.with_name(f"{out.name}.progress")
    try:
        if _is_complete(out, kind, form, log):
            tell(total, total)
            return out
        cut, done = _begin(partial, kind, form, log)
        finished = sum(size(one) for k, one in enumerate(blocks(shape, cut)) if k in done)
        tell(finished, total)
        todo = ((k, one) for k, one in enumerate(blocks(shape, cut)) if k not in done)
        with kind.writer(partial) as put, log.open("a", encoding="ascii") as lines:
            for k, one, data in _solved(drop, values, todo, options, client):
                put(one, data)
                lines.write(f"{k}\n")
                lines.flush()
                finished += size(one)
                tell(finished, total)
        partial.rename(out)
        log.unlink()
    except FileError:
        raise
    except OSError as error:
        raise FileError(f"{out} cannot be written: {error.strerror or error}") from error
    return out


def opened(path: str | Path) -> "xr.Dataset":
    """Open what `write` has written; numbers are read when they are needed."""
    return format_of(Path(path)).opened(Path(path))


def _tell_nobody(done: int, total: int) -> None:
    pass


def _is_complete(out: Path, kind: Format, form: Form, log: Path) -> bool:
    """Return whether the complete file of this sweep exists; raise if it holds another sweep."""
    if not out.exists():
        return False
    if not _is_same(out, kind, form):
        raise FileError(f"{out} exists, and is not this sweep: remove it or choose another name")
    log.unlink(missing_ok=True)
    return True


def _begin(partial: Path, kind: Format, form: Form, log: Path) -> tuple[tuple[int, ...], set[int]]:
    """Create the partial file, or resume it; return the shape of a block and the blocks done."""
    lines = log.read_text("ascii").splitlines(keepends=True) if log.exists() else []
    whole = [line for line in lines if line.endswith("\n")]  # the last one may be half written
    if whole and partial.exists():
        if not _is_same(partial, kind, form):
            raise FileError(
                f"{partial} is part of another sweep: remove it and {log.name}, "
                "or choose another name"
            )
        os.truncate(log, sum(map(len, whole)))
        return tuple(map(int, whole[0].split())), {int(line) for line in whole[1:]}
    if partial.exists():  # stopped while it was being made
        kind.remove(partial)
    kind.create(partial, form)
    log.write_text(" ".join(map(str, form.sides)) + "\n", "ascii")
    return form.sides, set()


def _is_same(path: Path, kind: Format, form: Form) -> bool:
    try:
        with kind.opened(path) as found:
            return form.is_of(found)
    except (KeyError, ValueError, OSError):
        return False


def solve_block(drop: Drop, values: Grid, options: Mapping[str, Any]) -> "xr.Dataset":
    """Return the results of one block, which fits in memory."""
    return sweep(drop, values, **options)


def _solved(
    drop: Drop, values: Grid, todo: _Todo, options: Mapping[str, Any], client: "Client | None"
) -> _Done:
    """Yield blocks with their results as they are finished; few are in memory at a time."""
    jobs = ((k, block, (drop, _part(values, block), options)) for k, block in todo)
    if client is None:
        return ((k, block, solve_block(*job)) for k, block, job in jobs)
    return _on_cluster(client, jobs)


def _on_cluster(cluster: Any, jobs: Iterator[tuple[int, Block, Any]]) -> _Done:
    import distributed

    ready: Any = distributed.as_completed
    running = ready()
    waiting: dict[Any, tuple[int, Block]] = {}
    with _cluster_errors():
        ahead = _AHEAD * max(1, sum(cluster.nthreads().values()))
    for k, block, job in jobs:
        with _cluster_errors():
            future = cluster.submit(solve_block, *job, pure=False)
            running.add(future)
        waiting[future] = k, block
        if len(waiting) >= ahead:
            yield _next(running, waiting)
    while waiting:
        yield _next(running, waiting)


def _next(running: Any, waiting: dict[Any, tuple[int, Block]]) -> tuple[int, Block, "xr.Dataset"]:
    with _cluster_errors():
        future = next(running)
        data = future.result()
        future.release()
    return *waiting.pop(future), data


@contextlib.contextmanager
def _cluster_errors() -> Iterator[None]:
    """Convert errors of the cluster to FileError with the advice to resume the sweep."""
    from distributed import KilledWorker
    from distributed.client import ClosedClientError

    try:
        yield
    except (OSError, CancelledError, KilledWorker, ClosedClientError) as error:
        what = " ".join(str(error).split()) or type(error).__name__
        raise FileError(
            "the cluster failed; the blocks done are kept, and the same command goes on from "
            f"there ({what[:200]})"
        ) from error


def _part(values: Grid, block: Block) -> dict[str, NDArray[np.float64]]:
    return {path: axis[side] for (path, axis), side in zip(values.items(), block, strict=True)}
