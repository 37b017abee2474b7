"""From the entries to a folder with a library for each target, and a manifest of them."""

import hashlib
import json
import os
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from kernel_build.targets import TARGETS, Target
from stackbounce.engine.native import MANIFEST, digest_of_manifest, digest_of_sources

__all__ = ["build", "is_up_to_date", "write"]

_HALF = ("run_drop", "run_batch")  # entries that take as long to compile as all others
_SLOWER = "v4"  # the level at which these are slower than one below, which then serves


def build(names: list[str], folder: Path) -> None:
    """Write the libraries of some targets, and a manifest, to a folder.

    Each file appears whole, and the manifest last: whoever reads meanwhile, or builds the same,
    never gets half a file.
    """
    from kernel_build.layout import FILE, layout
    from kernel_build.machine_code import link
    from stackbounce.engine.entries import ENTRIES

    sources, entries = digest_of_sources(), list(ENTRIES)
    objects = compile_entries(entries, names)
    targets = [TARGETS[name] for name in names]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        made = list(pool.map(link, objects, [entries] * len(names), targets))
    libraries = {
        name: {
            "file": TARGETS[name].file,
            "sha256": hashlib.sha256(content).hexdigest(),
            "levels": [level for level in TARGETS[name].levels if level],
        }
        for name, content in zip(names, made, strict=True)
    }
    manifest = {
        "sources": sources,
        "builder": _digest_of_builder(),
        "layout": FILE,
        "entries": {name: _kinds(entry) for name, entry in ENTRIES.items()},
        "libraries": libraries,
    }
    manifest["digest"] = digest_of_manifest(manifest)
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in zip(names, made, strict=True):
        write(folder / TARGETS[name].file, content)
    write(folder / FILE, (json.dumps(layout(), indent=1) + "\n").encode())
    write(folder / MANIFEST, (json.dumps(manifest, indent=2) + "\n").encode())


def compile_entries(entries: list[str], names: list[str]) -> list[list[bytes]]:
    """Return the object files for each target, by as many processes as there are processors.

    Two of them lower half of the entries each, and others compile what these return.
    """
    from kernel_build.machine_code import compile_level

    halves = [[name for name in entries if (name in _HALF) == half] for half in (True, False)]
    os.environ["PYTHONHASHSEED"] = "0"  # numba writes what it keeps in sets in another order else
    new = get_context("spawn")
    with (
        ProcessPoolExecutor(len(halves), mp_context=new) as lowering,
        # What LLVM compiled before in a process changes a few bytes of what it compiles next.
        ProcessPoolExecutor(mp_context=new, max_tasks_per_child=1) as compiling,
    ):
        lowered = {lowering.submit(_lower, half): k for k, half in enumerate(halves)}
        parts = {
            (name, lowered[ir], level): compiling.submit(
                compile_level, ir.result(), TARGETS[name], level
            )
            for ir in as_completed(lowered)
            for name in names
            for level in _levels(TARGETS[name], halves[lowered[ir]])
        }
        return [
            [
                parts[name, half, level].result()
                for half in range(len(halves))
                for level in _levels(TARGETS[name], halves[half])
            ]
            for name in names
        ]


def _levels(target: Target, entries: list[str]) -> list[str]:
    """Return the levels that entries are compiled for."""
    slower = any(entry in _HALF for entry in entries)
    return [level for level in target.levels if not (slower and level == _SLOWER)]


def _lower(entries: list[str]) -> str:
    """Return the IR of some entries."""
    from kernel_build.lowering import lower
    from stackbounce.engine.entries import ENTRIES

    return lower([ENTRIES[name] for name in entries])


def _kinds(entry: Callable[..., Any]) -> list[str]:
    """Return what an entry takes: records, floats and integers."""
    from stackbounce.engine.entries import arguments

    scalars = {float: "float", int: "int"}
    return [scalars.get(kind, "record") for kind in arguments(entry)]


def write(path: Path, content: bytes) -> None:
    """Write a file that is there as a whole or not at all."""
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as new:
        new.write(content)
    written = Path(new.name)
    try:
        written.chmod(0o644)
        written.replace(path)
    except BaseException:
        written.unlink(missing_ok=True)
        raise


def is_up_to_date(folder: Path, names: list[str]) -> bool:
    """Return whether a folder has the libraries, made of the present sources by this folder."""
    try:
        manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
        libraries = [manifest["libraries"][name] for name in names]
        whole = (folder / manifest["layout"]).is_file() and all(
            hashlib.sha256((folder / library["file"]).read_bytes()).hexdigest() == library["sha256"]
            for library in libraries
        )
        made_of = manifest["sources"], manifest["builder"]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return False
    return whole and made_of == (digest_of_sources(), _digest_of_builder())


def _digest_of_builder() -> str:
    """Return a hash of the files in this folder."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.[pc]*")):
        if source.is_file():
            digest.update(source.name.encode() + b"\0" + source.read_bytes() + b"\0")
    return digest.hexdigest()
