"""Compile the engine's kernels when the package is built.

=============== ==============================================================================
`records`       how numba sees a record of arrays: the one pointer that a kernel takes
`lowering`      kernels in Python -> intermediate representation of LLVM (IR), by numba
`targets`       the platforms, with the processor levels of each
`machine_code`  IR -> optimised object files, by llvmlite -> a library, by zig's linker
`jit`           compiles any kernel for the tests and benchmarks of this machine
=============== ==============================================================================

`python -m kernel_build` writes the libraries of this platform and `engine.wasm` to
`src/stackbounce/engine/native`; the build of a wheel does so, too (`hatch_build.py`).
"""
