"""The files of the page that were made when the package was built: they are only read here.

The folder `made` holds the explorer as one file, that of the folder form, and what the page has in
its folder `made/`: the engine, data, formulas of laws, and options of measurements. `page_build` in
the repository makes them.
"""

import base64
import hashlib
from pathlib import Path

from stackbounce.errors import FileError

FOLDER = Path(__file__).with_suffix("")
ONE_FILE = "explorer.html"
KINDS = {
    "engine.wasm": "application/wasm",
    "layout.json": "application/json",
    "laws.js": "text/javascript; charset=utf-8",
    "model.json": "application/json",
    "options.json": "application/json",
}
"""The files of the page's folder `made/`, with their media types."""

PAGE_POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; "
    "style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'"
)
"""The content security policy of the page where its files come from a server.

It loads nothing from elsewhere, and runs no script that is not a file of its own."""

HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-embedder-policy": "require-corp",
    "permissions-policy": "camera=(), geolocation=(), microphone=(self)",
    "cache-control": "no-cache",
}
"""The headers of every answer; its content security policy depends on the page."""

_FORM = "index.html explorer.css explorer.js explorer.webmanifest icon.svg offline.js".split()
_OF_FORM = ("engine.wasm", "layout.json", "model.json")  # in its folder made/


def made_file(name: str) -> bytes:
    r"""Return one of the files.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> made_file("engine.wasm")[:4]
    b'\x00asm'
    """
    try:
        return (FOLDER / name).read_bytes()
    except OSError:
        raise FileError(
            f"{name} is not in this installation: the page computes with the engine that was "
            "compiled when stackbounce was built, and there was none"
        ) from None


def one_file() -> str:
    """Return the HTML of the whole explorer, which needs no server and no network.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> one_file()[:15]
    '<!doctype html>'
    """
    return made_file(ONE_FILE).decode()


def folder_files() -> dict[str, bytes]:
    """Return the files of the explorer as a folder for any web server, by their paths in it.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> sorted(folder_files())[:3]
    ['explorer.css', 'explorer.js', 'explorer.webmanifest']
    """
    own = {name: made_file(name) for name in _FORM}
    return own | {f"made/{name}": made_file(name) for name in _OF_FORM}


def digest(content: bytes) -> str:
    """Return what browsers call a content: in a content security policy, and in what is fetched.

    Examples
    --------
    >>> digest(b"")[:12]
    'sha256-47DEQ'
    """
    return f"sha256-{base64.b64encode(hashlib.sha256(content).digest()).decode()}"
