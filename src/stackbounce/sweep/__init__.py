"""A Drop and the numbers that vary -> xarray, in chunks and lazily where they are dask's.

======= ===================================================================
paths   the numbers of a drop by their paths
columns rows of numbers -> what the engine takes for many drops, checked
solve   many drops at once, in blocks and threads
dataset the numbers that vary as named dimensions, and the Dataset that is returned
======= ===================================================================
"""

from stackbounce.sweep.dataset import sweep

__all__ = ["sweep"]
