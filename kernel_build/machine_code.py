"""From IR to libraries: LLVM optimises and emits, zig's linker links."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import llvmlite.binding as llvm

from kernel_build.targets import Target

_PROCESSOR_LEVEL = Path(__file__).with_name("processor_level.c")
_WINDOWS = Path(__file__).with_name("windows.c")
_INLINING = 100  # more than that makes the kernels of nonlinear laws 5 % slower


def compile_level(ir: str, target: Target, level: str) -> bytes:
    """Compile the IR of `lowering.lower`; return optimised machine code as an object file.

    No fast-math and no contraction: what each operation rounds to is the same for all targets.

    Raises
    ------
    RuntimeError
        If the machine code needs a function that is not its own.
    """
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=target.levels[level],
        features=target.features,
        opt=3,
        reloc="pic",
        codemodel="default",
    )
    text = ir.replace("@level@", f"_{level}" if level else "")
    module = llvm.parse_assembly(text)
    module.triple, module.data_layout = target.triple, str(machine.target_data)
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.slp_vectorization = True
    tuning.inlining_threshold = _INLINING
    builder = llvm.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)
    foreign = [
        function.name
        for function in module.functions
        if function.is_declaration and not function.name.startswith("llvm.")
    ]
    if foreign:
        raise RuntimeError(f"kernels call {', '.join(foreign)}, which is no function of their own")
    return bytes(machine.emit_object(module))


def link(objects: list[bytes], entries: list[str], target: Target) -> bytes:
    """Link object files to a library that exports the entries and needs no other library.

    Nothing is written but to a folder of its own, with zig's cache in it: neither a path nor the
    time comes into the library.

    Raises
    ------
    RuntimeError
        If the linker fails.
    """
    with tempfile.TemporaryDirectory() as room:
        parts = [] if "" in target.levels else [str(_PROCESSOR_LEVEL)]
        if target.file.endswith(".dll"):
            parts.append(str(_WINDOWS))
        for k, content in enumerate(objects):
            Path(room, f"{k}.o").write_bytes(content)
            parts.append(f"{k}.o")
        shape = ["-shared", "-nostdlib", "-s", "-O1"]
        if target.file.endswith(".dylib"):
            shape.append(f"-Wl,-install_name,@rpath/{target.file}")
        if target.zig.startswith("wasm"):
            shape = ["-nostdlib", "-Wl,--no-entry", "-Wl,--export-memory", "-s"]
            shape += [f"-Wl,--export={name}" for name in (*entries, "__heap_base")]
        command = [sys.executable, "-m", "ziglang", "cc", "-target", target.zig, *shape]
        caches = {f"ZIG_{which}_CACHE_DIR": str(Path(room, "zig")) for which in ("GLOBAL", "LOCAL")}
        done = subprocess.run(
            [*command, *parts, "-o", target.file],
            capture_output=True,
            text=True,
            check=False,
            cwd=room,
            env=os.environ | caches,
        )
        if done.returncode:
            raise RuntimeError(f"the linker failed for {target.file}: {done.stderr.strip()}")
        return Path(room, target.file).read_bytes()
