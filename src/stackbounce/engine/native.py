"""The package's compiled code: it was made when the package was built, and is only loaded here.

The folder `native` holds a library for each platform of the wheel, `engine.wasm` for browsers, and
`manifest.json` with their digests, its own and that of the engine's sources. A library that does
not fit is never loaded: not if its digest or the manifest's is another, not if the sources have
changed since, and not on a processor without the instructions that it needs. Plain Python then
gives the same bits, slowly.
"""

import ctypes
import functools
import hashlib
import json
import os
import platform
import sys
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

_HERE = os.path.dirname(__file__)
FOLDER = os.path.join(_HERE, "native")
MANIFEST = "manifest.json"
_LEVELS = {"v2": 2, "v3": 3, "v4": 4}  # of x86-64
_KINDS: dict[str, Any] = {
    "record": ctypes.c_void_p,
    "float": ctypes.c_double,
    "int": ctypes.c_int64,
}


class NoCompiledCode(UserWarning):
    """Warns once that drops are run as plain Python, and why."""


def digest_of_sources() -> str:
    """Return a hash of all source files of the engine, and of its tables."""
    digest = hashlib.sha256()
    for name in sorted(file for file in os.listdir(_HERE) if file.endswith((".py", ".toml"))):
        digest.update(name.encode() + b"\0" + _content(name) + b"\0")
    return digest.hexdigest()


def digest_of_manifest(manifest: dict[str, Any]) -> str:
    """Return a hash of all of a manifest but its libraries, which a wheel has a part of."""
    rest = {key: manifest[key] for key in manifest if key not in ("digest", "libraries")}
    return hashlib.sha256(json.dumps(rest, sort_keys=True).encode()).hexdigest()


def platform_name() -> str:
    """Return the name of this platform, such as ``linux-x86_64``."""
    systems = {"darwin": "macos", "win32": "windows"}
    system = systems.get(sys.platform, sys.platform)
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
def compiled(entry: str) -> Callable[..., Any]:
    """Return the compiled form of one of `entries.ENTRIES`, by its name.

    A record is passed as the address of its `tables.Table`.

    Raises
    ------
    RuntimeError
        If there is no compiled code for this machine, see `available`.
    """
    found = _library()
    if isinstance(found, str):
        raise RuntimeError(found)  # noqa: TRY004 - no wrong type: it says why there is none
    function = _function(found, entry)
    function.argtypes = [_KINDS[kind] for kind in found.entries[entry]]
    function.restype = ctypes.c_int64
    result: Callable[..., Any] = function
    return result


def _function(found: "_Library", entry: str) -> Any:
    """Return an entry for the processor's level, or for the highest below it that it has."""
    if not found.level:
        return found.library[entry]
    below = range(int(found.level[1:]), 0, -1)
    names = (f"{entry}_v{number}" for number in below)
    return next(found.library[name] for name in names if hasattr(found.library, name))


class _Library(NamedTuple):
    """A library, as it is loaded."""

    library: Any
    level: str  # of the processor; empty where the library has one only
    entries: dict[str, list[str]]  # the kinds of the arguments of each entry


class _NoLibraryError(Exception):
    """Why no library is loaded."""


@functools.cache
def _library() -> _Library | str:
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


def _load() -> _Library:
    """Return the library of this machine and the processor level to use."""
    file, digest, levels, entries = _described(platform_name())
    try:
        content = _content(file, FOLDER)
    except OSError as error:
        raise _NoLibraryError(
            f"{file} cannot be read ({error.strerror}): install stackbounce again"
        ) from None
    if hashlib.sha256(content).hexdigest() != digest:
        raise _NoLibraryError(f"{file} is damaged or foreign: install stackbounce again")
    try:
        library = ctypes.CDLL(os.path.join(FOLDER, file))
    except OSError as error:
        raise _NoLibraryError(
            f"{file} cannot be loaded ({error}): install stackbounce again"
        ) from None
    if not levels:
        return _Library(library, "", entries)
    level = _processor_level(library)
    fitting = [name for name, number in levels.items() if number <= level]
    if not fitting:
        least = min(levels, key=levels.__getitem__)
        raise _NoLibraryError(
            f"this processor lacks instructions of x86-64-{least}: use a newer one"
        )
    return _Library(library, max(fitting, key=levels.__getitem__), entries)


def _described(name: str) -> tuple[str, str, dict[str, int], dict[str, list[str]]]:
    """Return the file of a platform's library, its digest, its levels, and all entries."""
    described = None
    try:
        manifest = _manifest()
        built, entry = str(manifest["sources"]), manifest["libraries"].get(name)
        if entry is not None:
            levels = {level: _LEVELS[level] for level in entry["levels"]}
            described = str(entry["file"]), str(entry["sha256"]), levels, manifest["entries"]
    except FileNotFoundError:
        raise _NoLibraryError(
            "the package was built without compiled code (install a wheel that has it, or run "
            "make kernels)"
        ) from None
    except (OSError, ValueError, KeyError, AttributeError, TypeError, RecursionError):
        raise _NoLibraryError(f"{MANIFEST} is damaged: install stackbounce again") from None
    if described is None:
        raise _NoLibraryError(
            f"this package has no compiled code for {name}: install one for it, if there is one"
        )
    if built != digest_of_sources():
        raise _NoLibraryError("the engine's sources have changed: run make kernels")
    return described


def _manifest() -> dict[str, Any]:
    """Return the manifest; raise an error if it is not as it was built."""
    manifest: dict[str, Any] = json.loads(_content(MANIFEST, FOLDER))
    if manifest["digest"] != digest_of_manifest(manifest):
        raise ValueError("the manifest has another digest")
    return manifest


def _content(name: str, folder: str = _HERE) -> bytes:
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def _processor_level(library: Any) -> int:
    """Return the level of this processor among those of x86-64, as the library finds it."""
    library.processor_level.restype = ctypes.c_int64
    return int(library.processor_level())
