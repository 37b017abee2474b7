"""From kernels in Python to one module of LLVM's intermediate representation (IR), by numba.

numba compiles each kernel to IR of its own; here it stops there. All of it is linked and optimised
once for each target, which takes a tenth of the time that numba takes to compile for one.
"""

import gc
import re
from collections.abc import Callable, Iterable
from typing import Any

import llvmlite.binding as llvm
from numba import types
from numba.core import codegen
from numba.core.registry import cpu_target

from kernel_build.jit import compile_kernel
from kernel_build.records import RecordType
from stackbounce.engine.entries import arguments

_SCALARS = {float: types.float64, int: types.int64}
_IN_IR = {float: "double", int: "i64"}
# functions of a C library that are instructions of all targets, and round as IEEE 754 says
_INSTRUCTIONS = ("sqrt", "floor", "fabs")
# `math.frexp` of a normal number by its bits: kernels give it no other
_FREXP = """
define internal double @numba_frexp(double %x, ptr %e) alwaysinline {
  %bits = bitcast double %x to i64
  %shifted = lshr i64 %bits, 52
  %field = and i64 %shifted, 2047
  %power = sub i64 %field, 1022
  %small = trunc i64 %power to i32
  store i32 %small, ptr %e
  %fraction = and i64 %bits, -9218868437227405313
  %half = or i64 %fraction, 4602678819172646912
  %m = bitcast i64 %half to double
  ret double %m
}
"""


class _Library(codegen.JITCodeLibrary):
    """What numba makes of one kernel: its IR, neither optimised nor made into machine code."""

    made: list["_Library"] = []  # noqa: RUF012 - all of them

    def _optimize_functions(self, module: Any) -> None:
        module.data_layout = self._codegen._data_layout

    def finalize(self) -> None:
        self._raise_if_finalized()
        self._finalized = True
        self.made.append(self)

    def get_pointer_to_function(self, name: str) -> int:  # noqa: ARG002 - numba's signature
        return 0  # there is none: nothing is run


def lower(entries: Iterable[Callable[..., Any]]) -> str:
    """Return the IR of kernels, for no target yet; each is exported under its own name.

    The name of an exported function ends with ``@level@``, in place of which comes the level of the
    processor. Nothing else is exported. A process can call this once.
    """
    gc.disable()  # numba's objects live to the end, and the search for dead ones takes its time
    generator: Any = cpu_target.target_context.codegen()
    generator._library_class = _Library
    generator.set_env = lambda *_: None
    wrappers = []
    for entry in entries:
        takes = arguments(entry)
        kinds = tuple(_SCALARS.get(kind) or RecordType(kind) for kind in takes)
        kernel: Any = compile_kernel(entry, called=False)
        kernel.compile(kinds)
        compiled = kernel.overloads[kinds]
        compiled.library._ensure_finalized()
        name = compiled.fndesc.llvm_func_name
        wrappers.append(_wrapper(entry.__name__, name, takes))
    whole = llvm.parse_assembly("")
    for library in _Library.made:
        whole.link_in(library._final_module, preserve=True)
    for function in whole.functions:
        if not function.is_declaration:
            function.linkage = "internal"
    for variable in whole.global_variables:
        variable.linkage = "internal" if not variable.is_declaration else "external"
    return _without_library(str(whole)) + "".join(wrappers)


def _wrapper(name: str, kernel: str, arguments: tuple[type, ...]) -> str:
    """Return the IR of a function with plain arguments that calls a kernel as numba does.

    numba's functions take a pointer for the result and one for an exception. Kernels raise none; if
    one does, the result is -1.
    """
    kinds = [_IN_IR.get(kind, "ptr") for kind in arguments]
    takes = ", ".join(f"{kind} %a{k}" for k, kind in enumerate(kinds))
    return f"""
define i64 @"{name}@level@"({takes}) {{
  %result = alloca i64
  %exception = alloca ptr
  store i64 0, ptr %result
  %failed = call i32 @"{kernel}"(ptr %result, ptr %exception, {takes})
  %value = load i64, ptr %result
  %good = icmp eq i32 %failed, 0
  %answer = select i1 %good, i64 %value, i64 -1
  ret i64 %answer
}}
"""


def _without_library(text: str) -> str:
    """Return IR that needs no C library: functions of it are instructions, no loop calls memset."""
    text = re.sub(
        r"^target (triple|datalayout).*\n|^source_filename.*\n", "", text, flags=re.MULTILINE
    )
    text = text.replace("= common global", "= internal global")
    for name in _INSTRUCTIONS:
        text = re.sub(rf"^declare double @{name}\(double.*\n", "", text, flags=re.MULTILINE)
        text = text.replace(f"@{name}(", f"@llvm.{name}.f64(")
        if f"@llvm.{name}.f64(" in text and f"declare double @llvm.{name}.f64" not in text:
            text += f"declare double @llvm.{name}.f64(double)\n"
    if "@numba_frexp" in text:
        text = re.sub(r"^declare double @numba_frexp\(.*\n", "", text, flags=re.MULTILINE) + _FREXP
    return re.sub(r"^(define .*) \{$", r'\1 "no-builtins" {', text, flags=re.MULTILINE)
