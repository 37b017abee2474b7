"""Published measurements of bounces and collisions as small tables, each with its source.

`tables/` has one file for each; a file that is put there is a dataset.

`loading.py` has what a dataset says of itself, its source and its columns; `names`, `describe`, and
`load`, which makes a Dataset. The measurements of Cross (2007) are in `stackbounce.cross2007`.
"""

from stackbounce.datasets.loading import Column, Description, describe, load, names

__all__ = ["Column", "Description", "describe", "load", "names"]
