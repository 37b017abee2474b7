"""The optional dependencies: what each extra of the package holds, and what is said without it."""

from importlib.util import find_spec

from stackbounce.errors import MissingExtra

_MEASURE = ("pandas", "scipy", "uncertainties")
_FIT = (*_MEASURE, "emcee")
_PLOTS = ("corner", "matplotlib")
_PAPER = (*_FIT, *_PLOTS, "jinja2")

EXTRAS = {
    "sweep": ("dask", "zarr"),
    "cluster": ("distributed",),
    "plots": _PLOTS,
    "masses": ("scipy",),
    "measure": _MEASURE,
    "sheets": ("openpyxl",),
    "fit": _FIT,
    "paper": _PAPER,
    "web": (
        *_PAPER,
        *("fastapi", "pebble", "psutil", "pydantic", "python_multipart", "segno", "starlette"),
        "uvicorn",
    ),
}
"""The modules that each extra brings; ``all`` has them all, and a plain install none."""


def need(extra: str, what: str) -> None:
    """Refuse to go on where a module of an extra is not installed.

    Parameters
    ----------
    extra : str
        One of `EXTRAS`.
    what : str
        What needs it; the message begins with it.

    Raises
    ------
    MissingExtra
        If a module is missing.

    Examples
    --------
    >>> need("fit", "stackbounce fit")
    """
    missing = [module for module in EXTRAS[extra] if find_spec(module) is None]
    if missing:
        names = ", ".join(missing)
        raise MissingExtra(f"{what} needs {names}: pip install 'stackbounce[{extra}]'")
