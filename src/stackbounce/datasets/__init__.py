"""Published measurements of bounces and collisions as small tables, each with its source.

`tables/` has one file for each; a file that is put there is a dataset.

- `description.py`: what a dataset says of itself
- `paper.py`: the tables of Cross (2007), from `stackbounce.cross2007`, as descriptions
- `loading.py`: the files of `tables/`; `names`, `describe`, and `load`, which makes a Dataset
"""

from stackbounce.datasets.description import Column, Description
from stackbounce.datasets.loading import describe, load, names

__all__ = ["Column", "Description", "describe", "load", "names"]
