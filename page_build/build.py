"""From the package to a folder with the files that are made of it, and a digest of its sources."""

import hashlib
import json
from pathlib import Path

from kernel_build.build import write
from kernel_build.targets import WASM

from stackbounce.engine import native
from stackbounce.explorer import made

SOURCES = "sources.sha256"
_ENGINE = ("engine.wasm", "layout.json")
_ROOT = Path(__file__).parents[1]
_NO_SOURCES = ("__pycache__", Path(native.FOLDER).name, made.FOLDER.name)


def build(engine: Path, folder: Path) -> None:
    """Write all files, and the digest of what they are made of, to a folder.

    Each file appears whole, and the digest last.

    Parameters
    ----------
    engine : Path
        The folder of the engine for browsers.
    folder : Path
        Where the files go; others in it are removed.
    """
    sources, files = _digest_of_sources(engine), list_files(engine)
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        write(folder / name, content)
    for path in folder.glob("[!.]*"):
        if path.name not in files:
            path.unlink()
    write(folder / SOURCES, sources.encode())


def is_up_to_date(engine: Path, folder: Path) -> bool:
    """Return whether a folder has the files that are made of the present sources."""
    try:
        return (folder / SOURCES).read_text() == _digest_of_sources(engine)
    except OSError:
        return False


def list_files(engine: Path) -> dict[str, bytes]:
    """Return all files by their names."""
    from page_build.assembly import read_static
    from page_build.data import model_json, options_json
    from page_build.forms import one_file, web_files

    texts = {"model.json": model_json(), "options.json": options_json()}
    data = {name: text.encode() for name, text in texts.items()} | _read_engine(engine)
    other = {made.ONE_FILE: one_file(data), made.WAITING: read_static(made.WAITING)}
    return web_files(data) | {name: text.encode() for name, text in other.items()}


def has_engine(folder: Path) -> bool:
    """Return whether a folder has the engine for browsers that fits the present sources."""
    try:
        manifest = json.loads((folder / native.MANIFEST).read_text("utf-8"))
    except OSError:
        return False
    return WASM in manifest["libraries"] and manifest["sources"] == native.digest_of_sources()


def _read_engine(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in _ENGINE}


def _digest_of_sources(engine: Path) -> str:
    """Return a hash of all that the files are made of."""
    folders = _ROOT / "src" / "stackbounce", _ROOT / "page_build"
    found = [path for folder in folders for path in folder.rglob("*")]
    contents = {
        path.relative_to(_ROOT).as_posix(): path.read_bytes()
        for path in found
        if path.is_file() and not set(path.parts) & set(_NO_SOURCES)
    }
    digest = hashlib.sha256()
    for name, content in sorted((contents | _read_engine(engine)).items()):
        digest.update(name.encode() + b"\0" + content + b"\0")
    return digest.hexdigest()
