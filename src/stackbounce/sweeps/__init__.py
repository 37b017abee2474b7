"""Sweeps: one drop for all combinations of other parameter values, as an xarray Dataset.

If the values are dask arrays, the Dataset is lazy and computed in chunks.

======== ==========================================================================
dataset  in memory: parameters that vary, also texts of ``--over``, become dimensions
store    a sweep larger than memory, written block by block to a file by one process; resumable
files    the Zarr store
draws    tables of draws, each row a drop
======== ==========================================================================

The drops of a sweep are run by `stackbounce.run.batch`.
"""

from stackbounce.sweeps.dataset import grid, sweep
from stackbounce.sweeps.files import opened
from stackbounce.sweeps.store import write

__all__ = ["grid", "opened", "sweep", "write"]
