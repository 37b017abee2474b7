"""Compile the engine's kernels when the package is built.

=============== ==============================================================================
`records`       how numba sees a record of arrays: the one pointer that a kernel takes
`lowering`      kernels in Python -> intermediate representation of LLVM (IR), by numba
`targets`       the platforms, with the processor levels of each
`machine_code`  IR -> optimised object files, by llvmlite -> a library, by zig's linker
`layout`        `layout.json`: records, entries and codes, for callers in other languages
`build`         all of that, for some targets, and a manifest of the libraries
`jit`           compiles any kernel for the tests and benchmarks of this machine
`check_library` compares a library for another processor, run by an emulator
=============== ==============================================================================

`python -m kernel_build` writes the libraries of this platform and `engine.wasm` to
`src/stackbounce/engine/native`; the build of a wheel does so, too (`hatch_build.py`).

All platforms can be built on any of them (`--all`), but not run. On Linux with x86-64 the tests run
its own library and, in node, `engine.wasm`. `check_library` has run that of Linux with aarch64
there, under qemu, with the same bits. Those of macOS and Windows have been linked only, not run:
they export what they should, and need nothing but, on macOS, the system's own library.
"""
