"""The package's compiled code: it was made when the package was built, and is only loaded here.

The folder `native` holds a library for each platform of the wheel, `engine.wasm` for browsers, and
`manifest.json` with their digests and that of the engine's sources. A library that does not fit is
never loaded: not if its digest is another, not if the sources have changed since, and not on a
processor without the instructions that it needs. Plain Python then gives the same bits, slowly.
"""

import ctypes
import functools
import hashlib
import json
import platform
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "native"
MANIFEST = "manifest.json"


class NoCompiledCode(UserWarning):
    """Says once why drops are run as plain Python."""


def digest_of_sources() -> str:
    """Return a hash of all source files of the engine."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode() + b"\0" + source.read_bytes() + b"\0")
    return digest.hexdigest()


def platform_name() -> str:
    """Return the name of this platform, such as ``linux-x86_64``."""
    system = {"linux": "linux", "darwin": "macos", "win32": "windows"}.get(
        sys.platform, sys.platform
    )
    machine = platform.machine().lower()
    return f"{system}-{ {'amd64': 'x86_64', 'arm64': 'aarch64'}.get(machine, machine) }"


def available() -> bool:
    """Return whether there is compiled code for this machine; warn once if there is none."""
    return _library() is not None


@functools.cache
def compiled(entry: Callable[..., Any]) -> Callable[..., Any]:
    """Return the compiled form of one of `entries.ENTRIES`; records are passed as a `Table`.

    Raises
    ------
    RuntimeError
        If there is no compiled code for this machine, see `available`.
    """
    from stackbounce.engine.entries import signature

    found = _library()
    if found is None:
        raise RuntimeError(reason())
    library, level = found
    takes = signature(entry)
    kinds: dict[type, Any] = {float: ctypes.c_double, int: ctypes.c_int64}
    function: Any = library[f"{entry.__name__}_{level}" if level else entry.__name__]
    function.argtypes = [kinds.get(kind, ctypes.c_void_p) for kind in takes.arguments]
    function.restype = ctypes.c_int64 if takes.returns else None
    return function  # type: ignore[no-any-return]


@functools.cache
def _library() -> tuple[Any, str] | None:
    """Return the library of this machine and the processor level to use, or None with a warning."""
    try:
        return _load()
    except _NoLibraryError as reason:
        warnings.warn(
            f"stackbounce runs as plain Python, about a hundred times slower: {reason}",
            NoCompiledCode,
            stacklevel=2,
        )
        return None


def reason() -> str:
    """Return why there is no compiled code."""
    try:
        _load()
    except _NoLibraryError as found:
        return str(found)
    return "the compiled code was not there when it was first asked for"


class _NoLibraryError(Exception):
    """Why no library is loaded."""


def _load() -> tuple[Any, str]:
    """Return the library of this machine and the processor level to use."""
    name = platform_name()
    try:
        manifest = json.loads((FOLDER / MANIFEST).read_text("utf-8"))
        built, entry = manifest["sources"], manifest["libraries"].get(name)
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        raise _NoLibraryError(
            "the package was built without compiled code (install a wheel, or run make kernels)"
        ) from None
    if entry is None:
        raise _NoLibraryError(f"this package has no compiled code for {name}")
    if built != digest_of_sources():
        raise _NoLibraryError("the engine's sources have changed: run make kernels")
    path = FOLDER / entry["file"]
    try:
        content = path.read_bytes()
    except OSError as error:
        raise _NoLibraryError(f"{path.name} cannot be read ({error.strerror})") from None
    if hashlib.sha256(content).hexdigest() != entry["sha256"]:
        raise _NoLibraryError(f"{path.name} is damaged or foreign: install stackbounce again")
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise _NoLibraryError(f"{path.name} cannot be loaded ({error})") from None
    levels = entry["levels"]
    if not levels:
        return library, ""
    library.processor_level.restype = ctypes.c_int64
    fitting = [level for level in levels if int(level[1:]) <= library.processor_level()]
    if not fitting:
        raise _NoLibraryError(f"this processor is older than x86-64-{levels[0]}")
    return library, max(fitting)
