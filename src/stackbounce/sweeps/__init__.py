"""A Drop and the numbers that vary -> xarray, in chunks and lazily where they are dask's.

======= ==========================================================================
paths   the numbers of a drop by their paths
columns rows of numbers -> what the engine takes for many drops, checked
blocks  a grid of drops cut into blocks
engines which engine solves them
solve   many drops at once, in blocks and threads
dataset the numbers that vary as named dimensions, and the Dataset that comes of them
store   a sweep larger than memory, block by block to a file, resumed
files   the kinds of file: Zarr, NetCDF
axes    texts such as those of ``--over`` -> numbers and their values
======= ==========================================================================
"""

from stackbounce.sweeps.axes import grid
from stackbounce.sweeps.dataset import sweep
from stackbounce.sweeps.store import opened, write

__all__ = ["grid", "opened", "sweep", "write"]
