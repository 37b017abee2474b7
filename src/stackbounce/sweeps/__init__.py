"""A Drop and the numbers that vary -> an xarray Dataset; lazily, in chunks, for dask arrays.

======= ==========================================================================
dataset the numbers that vary as named dimensions, and the resulting Dataset
store   a sweep larger than memory, written block by block to a file; resumable
files   the file formats: Zarr, NetCDF
axes    texts such as those of ``--over`` -> numbers and their values
======= ==========================================================================

The drops of a sweep are run by `stackbounce.run.batch`.
"""

from stackbounce.sweeps.axes import grid
from stackbounce.sweeps.dataset import sweep
from stackbounce.sweeps.store import opened, write

__all__ = ["grid", "opened", "sweep", "write"]
