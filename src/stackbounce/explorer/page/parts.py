"""The files of the page that are made of the package: the page has them in a folder `made/`."""

import functools
from pathlib import Path

from stackbounce.engine import native
from stackbounce.errors import FileError
from stackbounce.explorer.page.data import model_json
from stackbounce.model.laws import LAWS

KINDS = {
    "engine.wasm": "application/wasm",
    "layout.json": "application/json",
    "laws.js": "text/javascript; charset=utf-8",
    "model.json": "application/json",
}
"""The files, with their media types."""


@functools.cache
def made_file(name: str) -> bytes:
    r"""Return one of the files of `KINDS`.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> made_file("engine.wasm")[:4]
    b'\x00asm'
    """
    if name == "laws.js":
        return _laws_js().encode()
    if name == "model.json":
        return model_json().encode()
    try:
        return (Path(native.FOLDER) / name).read_bytes()
    except OSError:
        raise FileError(
            f"{name} is not in this installation: the page computes with the engine that was "
            "compiled when stackbounce was built, and there was none"
        ) from None


def _laws_js() -> str:
    """Return what the page computes of some laws in their own way, see `ContactLaw.page_code`."""
    codes = (
        f"  {name}: {{ {', '.join(f'{what}: {code}' for what, code in kind.page_code.items())} }},"
        for name, kind in LAWS.items()
        if kind.page_code
    )
    return "\n".join(["export const LAW_CODE = {", *codes, "};", ""])
