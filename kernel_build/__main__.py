"""Compile the kernels: `python -m kernel_build [--all] [--force]`."""

import argparse
import hashlib
import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from kernel_build.layout import FILE, write_layout
from kernel_build.targets import TARGETS, WASM
from stackbounce.engine.native import FOLDER, MANIFEST, digest_of_sources, platform_name


def main() -> None:
    """Compile what is not there or not up to date."""
    parser = argparse.ArgumentParser(prog="python -m kernel_build", description=__doc__)
    parser.add_argument("--all", action="store_true", help="for all platforms, not this one only")
    parser.add_argument("--platform", default=platform_name(), help="such as linux-x86_64")
    parser.add_argument("--force", action="store_true", help="also if all is up to date")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where the libraries go")
    given = parser.parse_args()
    names = list(TARGETS) if given.all else [n for n in (given.platform, WASM) if n in TARGETS]
    if given.force or not _is_up_to_date(given.folder, names):
        build(names, given.folder)


def build(names: list[str], folder: Path) -> None:
    """Write the libraries of some targets, and a manifest, to a folder."""
    from kernel_build.lowering import lower
    from kernel_build.machine_code import make_library
    from stackbounce.engine.entries import ENTRIES

    ir = lower(ENTRIES)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        paths = list(pool.map(lambda name: make_library(ir, TARGETS[name], folder), names))
    libraries = {
        name: {
            "file": path.name,
            "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
            "levels": [level for level in TARGETS[name].levels if level],
        }
        for name, path in zip(names, paths, strict=True)
    }
    write_layout(folder)
    manifest = {"sources": digest_of_sources(), "layout": FILE, "libraries": libraries}
    (folder / MANIFEST).write_text(json.dumps(manifest, indent=2) + "\n", "utf-8")


def _is_up_to_date(folder: Path, names: list[str]) -> bool:
    """Return whether a folder has the libraries, made of the present sources."""
    try:
        manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
    except (OSError, ValueError):
        return False
    built = manifest.get("libraries", {})
    there = all(name in built and (folder / built[name]["file"]).is_file() for name in names)
    there = there and (folder / manifest.get("layout", FILE)).is_file()
    return there and manifest.get("sources") == digest_of_sources()


if __name__ == "__main__":
    main()
