"""From IR to libraries: LLVM optimises and emits, zig's linker links."""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import llvmlite.binding as llvm

from kernel_build.targets import Target

_PROCESSOR_LEVEL = Path(__file__).with_name("processor_level.c")
_WINDOWS = Path(__file__).with_name("windows.c")
_INLINING = 275  # LLVM's threshold at its third level of optimisation


def make_library(ir: str, target: Target, folder: Path) -> Path:
    """Compile the IR of `lowering.lower` for a target; return the library's path.

    Raises
    ------
    RuntimeError
        If the machine code needs a function that is not its own, or the linker fails.
    """
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    exported: list[str] = []
    with tempfile.TemporaryDirectory() as room:
        parts = [] if "" in target.levels else [_PROCESSOR_LEVEL]
        parts += [_WINDOWS] if "windows" in target.zig else []
        for level, processor in target.levels.items():
            text = ir.replace("@level@", f"_{level}" if level else "")
            exported += _exported(text)
            parts.append(Path(room) / f"kernels{level}.o")
            parts[-1].write_bytes(_emit(text, target, processor))
        made = _link(parts, exported, target, Path(room) / target.file)
        folder.mkdir(parents=True, exist_ok=True)
        return Path(shutil.copyfile(made, folder / target.file))


def _exported(text: str) -> list[str]:
    """Return the names of the functions that IR exports."""
    return re.findall(r'^define i64 @"?(\w+)"?\(', text, re.MULTILINE)


def _emit(text: str, target: Target, processor: str) -> bytes:
    """Return optimised machine code as an object file.

    No fast-math and no contraction: what each operation rounds to is the same for all targets.
    """
    machine = llvm.Target.from_triple(target.triple).create_target_machine(
        cpu=processor, features=target.features, opt=3, reloc="pic", codemodel="default"
    )
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


def _link(parts: list[Path], exported: list[str], target: Target, path: Path) -> Path:
    """Link object files and C to a library that needs no other; return its path."""
    shape = ["-shared", "-nostdlib", "-s", "-O1"]
    if target.file.endswith(".dylib"):
        shape.append(f"-Wl,-install_name,@rpath/{target.file}")
    if target.zig.startswith("wasm"):
        shape = ["-nostdlib", "-Wl,--no-entry", "-Wl,--export-memory", "-s"]
        shape += [f"-Wl,--export={name}" for name in (*exported, "__heap_base")]
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target.zig, *shape]
    done = subprocess.run(
        [*command, *map(str, parts), "-o", str(path)], capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(f"the linker failed for {path.name}: {done.stderr.strip()}")
    return path
