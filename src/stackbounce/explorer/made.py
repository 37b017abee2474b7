"""The files of the page that were made when the package was built: they are only read here.

The folder `made` holds the explorer as one file, and as files for a web server: page, styles,
script, engine and data. `page_build` in the repository makes them.
"""

import base64
import hashlib
from pathlib import Path

from stackbounce.errors import FileError
from stackbounce.files import shipped_table

FOLDER = Path(__file__).with_suffix("")
ONE_FILE = "explorer.html"
WAITING = "waiting.html"  # while the paper is being computed
PAGE = "index.html"
PLAYING = "explorer.css explorer.js icon.svg engine.wasm layout.json model.json".split()
"""What the page asks any server for."""

MEASURING = "options.json microphone_worklet.js floor-force.csv two-tracks.csv".split()
"""What it asks a server of stackbounce for, besides."""

HTTP = shipped_table(__package__, "http.toml")
"""What the servers of the page tell browsers."""

PAGE_POLICY: str = HTTP["policy"]
"""The content security policy of the page where its files come from a server.

It loads nothing from elsewhere, and runs no script that is not a file of its own."""

HEADERS: dict[str, str] = HTTP["headers"]
"""The headers of every answer; its content security policy depends on the page."""

FOLDER_PAGE = "folder.html"  # the page where any other server has it, in a folder
OF_FOLDER = (*PLAYING, "explorer.webmanifest", "offline.js")


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
    ['engine.wasm', 'explorer.css', 'explorer.js']
    """
    return {PAGE: made_file(FOLDER_PAGE)} | {name: made_file(name) for name in OF_FOLDER}


def digest(content: bytes) -> str:
    """Return what browsers call a content: in a content security policy, and in what is fetched.

    Examples
    --------
    >>> digest(b"")[:12]
    'sha256-47DEQ'
    """
    return f"sha256-{base64.b64encode(hashlib.sha256(content).digest()).decode()}"
