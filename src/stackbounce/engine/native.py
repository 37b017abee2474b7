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
    return not isinstance(_library(), str)


def reason() -> str:
    """Return why there is no compiled code, and what to do; nothing if there is some."""
    found = _library()
    return found if isinstance(found, str) else ""


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
    if isinstance(found, str):
        raise RuntimeError(found)  # noqa: TRY004 - no wrong type: it says why there is none
    library, level = found
    takes = signature(entry)
    kinds: dict[type, Any] = {float: ctypes.c_double, int: ctypes.c_int64}
    function = library[f"{entry.__name__}_{level}" if level else entry.__name__]
    function.argtypes = [kinds.get(kind, ctypes.c_void_p) for kind in takes.arguments]
    function.restype = ctypes.c_int64 if takes.returns else None
    result: Callable[..., Any] = function
    return result


class _NoLibraryError(Exception):
    """Why no library is loaded."""


@functools.cache
def _library() -> tuple[Any, str] | str:
    """Return the library of this machine and the processor level to use, or why there is none."""
    try:
        return _load()
    except _NoLibraryError as error:
        warnings.warn(
            f"drops run as plain Python, about a hundred times slower: {error}",
            NoCompiledCode,
            stacklevel=2,
        )
        return str(error)


def _load() -> tuple[Any, str]:
    """Return the library of this machine and the processor level to use."""
    path, digest, levels = _described(platform_name())
    try:
        content = path.read_bytes()
    except OSError as error:
        raise _NoLibraryError(
            f"{path.name} cannot be read ({error.strerror}): install stackbounce again"
        ) from None
    if hashlib.sha256(content).hexdigest() != digest:
        raise _NoLibraryError(f"{path.name} is damaged or foreign: install stackbounce again")
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise _NoLibraryError(
            f"{path.name} cannot be loaded ({error}): install stackbounce again"
        ) from None
    if not levels:
        return library, ""
    level = _processor_level(library)
    fitting = [name for name, number in levels.items() if number <= level]
    if not fitting:
        least = min(levels, key=levels.__getitem__)
        raise _NoLibraryError(
            f"this processor lacks instructions of x86-64-{least}: use a newer one"
        )
    return library, max(fitting, key=levels.__getitem__)


def _described(name: str) -> tuple[Path, str, dict[str, int]]:
    """Return path, digest and processor levels of a platform's library, from the manifest."""
    described = None
    try:
        manifest = json.loads((FOLDER / MANIFEST).read_text("utf-8"))
        built, entry = str(manifest["sources"]), manifest["libraries"].get(name)
        if entry is not None:
            levels = {str(level): int(level[1:]) for level in entry["levels"]}
            described = FOLDER / entry["file"], str(entry["sha256"]), levels
    except FileNotFoundError:
        raise _NoLibraryError(
            "the package was built without compiled code (install a wheel that has it, or run "
            "make kernels)"
        ) from None
    except (OSError, ValueError, KeyError, AttributeError, TypeError):
        raise _NoLibraryError(f"{MANIFEST} is damaged: install stackbounce again") from None
    if described is None:
        raise _NoLibraryError(
            f"this package has no compiled code for {name}: install one for it, if there is one"
        )
    if built != digest_of_sources():
        raise _NoLibraryError("the engine's sources have changed: run make kernels")
    return described


def _processor_level(library: Any) -> int:
    """Return the level of this processor among those of x86-64, as the library tells it."""
    library.processor_level.restype = ctypes.c_int64
    return int(library.processor_level())
