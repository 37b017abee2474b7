"""The datasets of the folder `tables`: one file in TOML for each."""

import functools
import tomllib
from importlib.resources import files

from stackbounce.datasets.description import Description, read_description

__all__ = ["published"]


@functools.cache
def published() -> dict[str, Description]:
    """Return the datasets of the folder by their names, in alphabetical order.

    Raises
    ------
    InvalidValue
        If a file is not as `read_description` wants it.

    Examples
    --------
    >>> published()["golf-marble-heights"].surface
    'marble'
    """
    folder = files("stackbounce.datasets").joinpath("tables")
    found = {
        file.name.removesuffix(".toml"): tomllib.loads(file.read_text(encoding="utf-8"))
        for file in folder.iterdir()
        if file.name.endswith(".toml")
    }
    return {name: read_description(name, found[name]) for name in sorted(found)}
