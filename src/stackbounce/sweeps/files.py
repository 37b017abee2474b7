"""The file of a sweep larger than memory: a Zarr store of format 2.

It is first made with all its coordinates and no results. The results are then written block by
block, each a chunk of the store; one whose writing was interrupted is written again. The bytes do
not depend on the order of writing.
"""

import contextlib
import json
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown
from stackbounce.extras import need
from stackbounce.files import write_files
from stackbounce.library_types import DataArray, Dataset
from stackbounce.run.batch import Block, blocks, sides
from stackbounce.run.paths import identifier

_UNFINISHED = re.compile(r"\.[0-9a-f]{32}\.partial$")  # a chunk that zarr was writing
Axes: TypeAlias = Mapping[str, tuple[str, NDArray[np.float64]]]  # dimension and values, by path
Writer: TypeAlias = Callable[[Block, Dataset], None]


class Form:
    """The layout of a file: its variables, coordinates, attributes and block shape.

    Parameters
    ----------
    sample : xarray.Dataset
        As from `sweep`, with the first value of each parameter only.
    axes : mapping
        The dimension and all values of each parameter, by its path.
    block : int
        Drops in a block, at most.
    """

    def __init__(self, sample: Dataset, axes: Axes, block: int) -> None:
        import xarray as xr

        self.sample, self.grid = sample, tuple(sizes(axes).values())
        self.sides = sides(self.grid, block)
        known = {identifier(path): axis for path, (_, axis) in axes.items()}
        coords = {
            name: (variable.dims, known.get(str(name), variable.values), variable.attrs)
            for name, variable in sample.coords.items()
        }
        self.coordinates = xr.Dataset(coords=coords)
        own = ((identifier(path), dim) for path, (dim, _) in axes.items())
        paired = " ".join(name for name, dim in own if name != dim)
        self.marked = {**sample.attrs, **({"coordinates": paired} if paired else {})}
        """The attributes in a file; `coordinates` names those that have not their dimension's name,
        as xarray does."""

    def shape(self, one: DataArray) -> tuple[int, ...]:
        """Return the shape of a variable in the whole file."""
        return tuple(self.coordinates.sizes[dim] for dim in one.dims)

    def is_of(self, found: Dataset) -> bool:
        """Return whether a file is of this sweep: with its attributes, coordinates and results."""
        return (
            found.attrs == self.sample.attrs
            and found.coords.to_dataset().equals(self.coordinates)
            and all(
                name in found
                and (found[name].dims, found[name].shape) == (variable.dims, self.shape(variable))
                for name, variable in self.sample.data_vars.items()
            )
        )


def sizes(axes: Axes) -> dict[str, int]:
    """Return the number of values along each dimension."""
    return {dim: len(axis) for dim, axis in axes.values()}


def create(path: Path, form: Form) -> None:
    """Create a store with all its coordinates and no results.

    It is made in memory and then written file by file: Zarr writes several files at once, and goes
    on with the others after one has failed.
    """
    import zarr
    from zarr.storage import MemoryStore

    made: dict[str, Any] = {}  # content by path
    group = zarr.create_group(MemoryStore(made), zarr_format=2, attributes=form.marked)
    for name, variable in {**form.sample.data_vars, **form.coordinates.coords}.items():
        shape, own = form.shape(variable), name in form.coordinates
        array = group.create_array(
            str(name),
            shape=shape,
            chunks=shape if own else form.sides + shape[len(form.sides) :],
            dtype=variable.dtype,
            fill_value=math.nan if variable.dtype.kind == "f" else None,
            attributes={**variable.attrs, "_ARRAY_DIMENSIONS": [str(dim) for dim in variable.dims]},
        )
        if own:
            array[...] = variable.values
    zarr.consolidate_metadata(group.store)
    for name in made:
        (path / name).parent.mkdir(parents=True, exist_ok=True)
    write_files((path / name, part.to_bytes()) for name, part in made.items())


@contextlib.contextmanager
def writer(path: Path) -> Iterator[Writer]:
    """Open a store for writing; yield a function that writes the results of one block."""
    import zarr

    for leftover in path.rglob("*.partial"):
        if _UNFINISHED.search(leftover.name):
            leftover.unlink()
    with zarr.config.set({"array.write_empty_chunks": True}):  # a chunk that lacks is lost
        group: Any = zarr.open_group(path, mode="r+")
        arrays = dict(group.arrays())

        def write(block: Block, data: Dataset) -> None:
            for name, variable in data.data_vars.items():
                arrays[name][block] = variable.values

        yield write


def opened(path: str | Path) -> Dataset:
    """Open what `write` has written; numbers are read when they are needed."""
    import xarray as xr

    _check_metadata(Path(path))
    return xr.open_dataset(path, engine="zarr", chunks=None)


def lost(path: Path, form: Form) -> tuple[list[Block], int]:
    """Return the blocks of a store that are not there, and the number of all its blocks."""
    import zarr

    group: Any = zarr.open_group(path, mode="r")
    arrays = {str(name): group[name] for name in form.sample.data_vars}
    lengths = tuple(next(iter(arrays.values())).chunks[: len(form.grid)])
    missing, count = [], 0
    for block in blocks(form.grid, lengths):
        count += 1
        place = [side.start // length for side, length in zip(block, lengths, strict=True)]
        if not all(_is_there(path / name, array, place, block) for name, array in arrays.items()):
            missing.append(block)
    return missing, count


def _check_metadata(store: Path) -> None:
    """Raise OSError unless all metadata of a store are there, as they were consolidated."""
    try:
        consolidated = json.loads((store / ".zmetadata").read_bytes())["metadata"]
        own = {name: json.loads((store / name).read_bytes()) for name in consolidated}
    except (KeyError, OSError, TypeError, ValueError) as error:
        raise OSError("its metadata are damaged") from error
    if json.dumps(own) != json.dumps(consolidated):  # a nan equals no nan
        raise OSError("its metadata are damaged")


def _is_there(folder: Path, array: Any, place: Sequence[int], block: Block) -> bool:
    """Return whether a chunk of an array is there and can be read."""
    indices = [*place, *[0] * (array.ndim - len(place))] or [0]
    if not (folder / ".".join(map(str, indices))).is_file():
        return False
    try:
        array[block]
    except (OSError, RuntimeError, ValueError):  # of the file, or of what decompresses it
        return False
    return True


def check_name(path: Path) -> None:
    """Refuse a name that is not that of a Zarr store.

    Raises
    ------
    InvalidValue
        If it does not end in ``.zarr``.
    MissingExtra
        If zarr is not installed.

    Examples
    --------
    >>> check_name(Path("map.txt"))
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: a sweep's file must end in .zarr, got 'map.txt'
    """
    suffix = path.suffix.lower()
    if suffix != ".zarr":
        to = f".to_netcdf({path.name!r})"
        way = f"; xarray.open_zarr('map.zarr'){to} makes one of it" if suffix == ".nc" else ""
        raise InvalidValue(f"a sweep's file must end in .zarr, got {shown(path.name)}{way}")
    need("a .zarr file", "dask", "zarr")
