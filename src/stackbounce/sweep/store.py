"""A sweep larger than memory, written to a Zarr store block by block; stopped, it can be resumed.

Until it is complete the store is called ``NAME.partial``; beside it ``NAME.progress`` has a line
for each block that is written. Blocks are whole chunks of the store, so that a block that was
being written when the process died is simply written again, and a sweep ends with the same bytes
however often it was stopped.
"""

import itertools
import math
import shutil
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError, InvalidValue
from stackbounce.model import Drop
from stackbounce.sweep.dataset import check_axis, sweep

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

__all__ = ["Grid", "write"]

BLOCK = 2**16
"""Drops in a block, at most."""

_AHEAD = 3  # blocks that a cluster has in hand for each of its threads
Grid = Mapping[str, NDArray[np.float64]]
_Block = dict[str, slice]


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
    """Sweep a drop over a grid into a Zarr store, or go on where that was stopped.

    Parameters
    ----------
    out : str or path-like
        The store, which must not exist yet unless it is the same sweep, complete.
    drop : Drop
        The base.
    values : mapping
        The numbers that vary, by their paths, each a 1-D array: a dimension of the store.
    client : distributed.Client, optional
        A cluster to solve the blocks on; by default they are solved here, on all cores.
    block : int, optional
        How many drops are solved and written at once, at most.
    progress : callable, optional
        Told how many drops are done, and of how many, after each block.
    **options
        `until`, `rtol` and `event_limit`, as in `simulate`.

    Returns
    -------
    pathlib.Path
        The store, to be opened with ``xarray.open_zarr``.

    Raises
    ------
    InvalidValue, InvalidType
        As in `sweep`.
    FileError
        If the store cannot be written, or another sweep has its name.

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
    for path, axis in values.items():
        check_axis(drop, path, axis)
    shape = tuple(len(axis) for axis in values.values())
    chunks = _chunks(shape, block)
    template = _template(drop, values, chunks, options)
    total = math.prod(shape)
    partial, log = out.with_name(f"{out.name}.partial"), out.with_name(f"{out.name}.progress")
    try:
        if _is_complete(out, template, log):
            tell(total, total)
            return out
        done = _begin(partial, log, template)
        finished = sum(_size(one) for k, one in enumerate(_blocks(values, chunks)) if k in done)
        tell(finished, total)
        todo = ((k, one) for k, one in enumerate(_blocks(values, chunks)) if k not in done)
        with log.open("a", encoding="ascii") as lines:
            for k, one, data in _solved(drop, values, todo, options, client):
                data.drop_vars(list(data.coords)).to_zarr(partial, region=one, consolidated=False)
                lines.write(f"{k}\n")
                lines.flush()
                finished += _size(one)
                tell(finished, total)
        partial.rename(out)
        log.unlink()
    except OSError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"{out} cannot be written: {error.strerror or error}") from error
    return out


def _tell_nobody(done: int, total: int) -> None:
    pass


def _template(drop: Drop, values: Grid, chunks: tuple[int, ...], options: Any) -> "xr.Dataset":
    """Return the Dataset to come, without its numbers."""
    import dask.array
    import xarray as xr

    from_array: Any = dask.array.from_array
    lazy = {
        path: xr.DataArray(from_array(axis, chunks=size), dims=path)
        for (path, axis), size in zip(values.items(), chunks, strict=True)
    }
    data = sweep(drop, lazy, **options)
    units = {path: data[path].attrs for path in values}
    return data.assign_coords({path: (path, axis, units[path]) for path, axis in values.items()})


def _is_complete(out: Path, template: "xr.Dataset", log: Path) -> bool:
    """Tell whether the store is there, and complete; refuse to touch another one."""
    if not out.exists():
        return False
    if not _is_same(out, template):
        raise FileError(f"{out} exists, and is not this sweep: remove it or choose another name")
    log.unlink(missing_ok=True)
    return True


def _begin(partial: Path, log: Path, template: "xr.Dataset") -> set[int]:
    """Make an empty store, or return the blocks that the one found has."""
    if log.exists() and partial.exists():
        if not _is_same(partial, template):
            raise FileError(
                f"{partial} is part of another sweep: remove it and {log.name}, "
                "or choose another name"
            )
        for leftover in partial.rglob("*.partial"):  # of a chunk that was being written
            leftover.unlink()
        lines = log.read_text("ascii").splitlines(keepends=True)
        return {int(line) for line in lines if line.endswith("\n")}
    if partial.exists():  # stopped before it was all there
        shutil.rmtree(partial)
    template.to_zarr(partial, compute=False, zarr_format=2, consolidated=True)
    log.touch()
    return set()


def _is_same(store: Path, template: "xr.Dataset") -> bool:
    import xarray as xr

    try:
        with xr.open_zarr(store) as found:
            same_axes = all(
                path in found and np.array_equal(found[path].values, template[path].values)
                for path in template.sizes
            )
            same_chunks = all(
                found[name].encoding.get("chunks") == one.data.chunksize
                for name, one in template.items()
            )
            return same_axes and same_chunks and found.attrs == template.attrs
    except (KeyError, ValueError, OSError):
        return False


def _chunks(shape: tuple[int, ...], block: int) -> tuple[int, ...]:
    """Return the sides of a block of at most so many drops, filled from the last dimension on."""
    if block < 1:
        raise InvalidValue(f"block must be a number of drops, 1 or above, got {block}")
    sides, left = [], block
    for size in reversed(shape):
        side = max(1, min(size, left))
        left //= side
        sides.append(side)
    return tuple(reversed(sides))


def _blocks(values: Grid, chunks: tuple[int, ...]) -> Iterator[_Block]:
    ranges = [
        [slice(start, min(start + side, len(axis))) for start in range(0, len(axis), side)]
        for axis, side in zip(values.values(), chunks, strict=True)
    ]
    for sides in itertools.product(*ranges):
        yield dict(zip(values, sides, strict=True))


def _size(block: _Block) -> int:
    return math.prod(side.stop - side.start for side in block.values())


def solve_block(drop: Drop, values: Grid, options: Mapping[str, Any]) -> "xr.Dataset":
    """Return one block, whose numbers fit in memory."""
    return sweep(drop, values, **options)


def _solved(
    drop: Drop,
    values: Grid,
    todo: Iterator[tuple[int, _Block]],
    options: Mapping[str, Any],
    client: "Client | None",
) -> Iterator[tuple[int, _Block, "xr.Dataset"]]:
    """Yield blocks with their results as they are ready, never many at a time."""
    if client is None:
        for k, block in todo:
            yield k, block, solve_block(drop, _part(values, block), options)
        return
    import distributed

    cluster: Any = client
    ahead = _AHEAD * max(1, sum(cluster.nthreads().values()))
    waiting: dict[Any, tuple[int, _Block]] = {}
    ready: Any = distributed.as_completed
    running = ready()
    for k, block in todo:
        future = cluster.submit(solve_block, drop, _part(values, block), options, pure=False)
        running.add(future)
        waiting[future] = k, block
        if len(waiting) >= ahead:
            yield _next(running, waiting)
    while waiting:
        yield _next(running, waiting)


def _submit(
    client: Any, running: Any, drop: Drop, values: Grid, block: _Block, options: Any
) -> Any:
    future = client.submit(solve_block, drop, _part(values, block), options, pure=False)
    running.add(future)
    return future


def _next(running: Any, waiting: dict[Any, tuple[int, _Block]]) -> tuple[int, _Block, "xr.Dataset"]:
    future = next(running)
    k, block = waiting.pop(future)
    data = future.result()
    future.release()
    return k, block, data


def _part(values: Grid, block: _Block) -> dict[str, NDArray[np.float64]]:
    return {path: axis[block[path]] for path, axis in values.items()}
