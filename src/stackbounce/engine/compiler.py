"""One source, two modes: a kernel runs as plain Python, or compiled by numba.

A function marked with :func:`kernel` stays an ordinary Python function, so that a single drop needs
no compiler. :func:`compile_kernel` clones it, with its marked callees compiled in the clone's
namespace, and hands the clone to numba. Both modes give the same bits: no fast-math, no threads.
"""

import contextlib
import dis
import functools
import hashlib
import os
import tempfile
import threading
import types
from collections.abc import Callable, Iterator, MutableSequence, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

Floats: TypeAlias = MutableSequence[float]  # a list, or an array when compiled
Integers: TypeAlias = MutableSequence[int]
Rows: TypeAlias = Sequence[Floats]  # a list of lists, or an array of rows

Function = TypeVar("Function", bound=Callable[..., Any])
_MARK = "__stackbounce_kernel__"
_OPTIONS: dict[str, Any] = {  # no reference counts: kernels allocate nothing
    "error_model": "numpy",
    "nogil": True,
    "_nrt": False,
}


_lock = threading.Lock()


def kernel(function: Function) -> Function:
    """Mark a function as a kernel: callable as it is, and compilable with its marked callees."""
    setattr(function, _MARK, True)
    return function


def with_callees(function: Function, name: str, **callees: Callable[..., Any]) -> Function:
    """Return a kernel under another name that calls other kernels where it calls those named.

    It is compiled as if it had been written out with them, so that a choice costs no time.
    """
    namespace = function.__globals__ | callees
    other: Any = types.FunctionType(function.__code__, namespace, name, function.__defaults__)
    other.__module__ = function.__module__
    return kernel(other)  # type: ignore[no-any-return]


def compile_kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the numba-compiled form of a kernel; its marked callees are compiled with it.

    A lock admits one thread at a time, because `caching` changes a global setting of numba.
    """
    with _lock:
        return _compiled(function)


@functools.cache
def _compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the numba-compiled form of a kernel; the caller must hold the lock."""
    from numba import njit

    namespace = dict(function.__globals__)
    for instruction in dis.get_instructions(function):
        if instruction.opname != "LOAD_GLOBAL":
            continue
        name = instruction.argval
        callee = namespace.get(name)
        if getattr(callee, _MARK, False):
            namespace[name] = _compiled(callee)
    clone = types.FunctionType(
        function.__code__, namespace, function.__name__, function.__defaults__
    )
    clone.__qualname__ = function.__qualname__
    clone.__module__ = function.__module__
    with caching() as cached:
        result: Callable[..., Any] = njit(cache=cached, **_OPTIONS)(clone)
    return result


@contextlib.contextmanager
def caching() -> Iterator[bool]:
    """Let numba cache compiled code in this package's own folder; yield whether it can."""
    from numba.core import config

    folder = _cache_folder()
    previous = config.CACHE_DIR  # type: ignore[attr-defined]
    config.CACHE_DIR = "" if folder is None else str(folder)  # type: ignore[attr-defined]
    try:
        yield folder is not None
    finally:
        config.CACHE_DIR = previous  # type: ignore[attr-defined]


def _digest() -> str:
    """Return a hash of all source files of the engine."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


_DIGEST = _digest()  # of the sources at import; the files may change later


@functools.cache
def _cache_folder() -> Path | None:
    """Return a writable folder for compiled code, named by a hash of the engine's sources.

    numba looks for changes only in the file of the cached function itself. With the hash in the
    folder's name, a change in any file of the engine gets a new folder.
    """
    user = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    for parent in (user, Path(tempfile.gettempdir())):
        folder = parent / "stackbounce" / _DIGEST
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                return folder
        except OSError:
            continue
    return None
