"""The optional dependencies: what each extra of the package holds, and what is said without it."""

from importlib.util import find_spec

from stackbounce.errors import MissingExtra

MEASURING = ("pandas", "scipy", "uncertainties")
"""The modules without which nothing is measured or fitted."""

_LAB = (*MEASURING, "corner", "emcee", "jinja2", "matplotlib", "openpyxl")
_SERVER = "fastapi pebble psutil pydantic python_multipart segno starlette uvicorn".split()

EXTRAS = {"lab": _LAB, "sweep": ("dask", "distributed", "zarr"), "app": (*_LAB, *_SERVER)}
"""The modules that each extra brings; ``all`` has them all, and a plain install none."""


def is_installed(extra: str) -> bool:
    """Return whether all modules of an extra are installed.

    Examples
    --------
    >>> is_installed("lab")
    True
    """
    return all(find_spec(module) for module in EXTRAS[extra])


def need(what: str, *modules: str) -> None:
    """Refuse to go on where a module of an extra is not installed.

    Parameters
    ----------
    what : str
        What needs them; the message begins with it.
    *modules : str
        The modules, each of one of `EXTRAS`.

    Raises
    ------
    MissingExtra
        If one is missing; the message names the extra that brings it.

    Examples
    --------
    >>> need("a picture", "matplotlib")
    """
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        extra = next(name for name, brought in EXTRAS.items() if {*missing} <= {*brought})
        names = ", ".join(missing)
        raise MissingExtra(f"{what} needs {names}: pip install 'stackbounce[{extra}]'")
