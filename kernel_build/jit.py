"""Compile any kernel at once, for the tests and benchmarks of this machine."""

import dis
import functools
import types
from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit

import kernel_build.records  # noqa: F401 - tells numba what a Table is
from stackbounce.engine.kernels import MARK

_OPTIONS: dict[str, Any] = {  # no reference counts: kernels allocate nothing
    "error_model": "numpy",
    "nogil": True,
    "_nrt": False,
}
_NO_WRAPPERS = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


@functools.cache
def compile_kernel(function: Callable[..., Any], *, called: bool = True) -> Callable[..., Any]:
    """Return the numba-compiled form of a kernel; its marked callees are compiled with it.

    What is not to be `called` from Python has no wrappers for that, and compiles in less time.
    """
    namespace = dict(function.__globals__)
    for instruction in dis.get_instructions(function):
        if instruction.opname != "LOAD_GLOBAL":
            continue
        name = instruction.argval
        callee = namespace.get(name)
        if getattr(callee, MARK, False):
            namespace[name] = compile_kernel(callee, called=called)
        elif isinstance(callee, tuple):  # a table: quick to look up and to compile as an array
            namespace[name] = np.array(callee)
    clone = types.FunctionType(
        function.__code__, namespace, function.__name__, function.__defaults__
    )
    clone.__qualname__ = function.__qualname__
    clone.__module__ = function.__module__
    options = _OPTIONS if called else _OPTIONS | _NO_WRAPPERS
    result: Callable[..., Any] = njit(**options)(clone)
    return result
