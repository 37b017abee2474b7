"""Compile the kernels while hatchling builds the package: a wheel holds them, see `kernel_build`.

The environment variable STACKBOUNCE_PLATFORM, such as ``macos-aarch64``, asks for the wheel of
another platform. Where nothing can be compiled, the wheel has plain Python only.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NATIVE = "stackbounce/engine/native"
MANIFEST = "manifest.json"
BUILT = "build/kernels"  # what is only for wheels
# Not PYTHONPATH: beside an editable installation, pip's build takes its folder out of that path.
START = (
    "import sys; sys.path[:0] = sys.argv[1:3]; del sys.argv[1:3]; "
    "from kernel_build.__main__ import main; sys.exit(main())"
)


class KernelHook(BuildHookInterface[Any]):
    """Hatchling calls it before it builds a wheel, be it `standard` or `editable`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile what is not up to date, and put it into the wheel."""
        root = Path(self.root)
        sys.path[:0] = [str(root / "src"), str(root)]
        from kernel_build.__main__ import IMPOSSIBLE
        from kernel_build.targets import TARGETS, WASM

        from stackbounce.engine.native import platform_name

        other = "" if version == "editable" else os.environ.get("STACKBOUNCE_PLATFORM", "")
        name = other or platform_name()
        folder = root / BUILT / name if other else root / "src" / NATIVE
        start = [sys.executable, "-c", START, str(root / "src"), str(root)]
        done = subprocess.run(
            [*start, "--platform", name, "--folder", str(folder)], cwd=root, check=False
        )
        if done.returncode == IMPOSSIBLE and not other:
            return  # it has said why
        if done.returncode:
            self.app.abort(f"the kernels could not be compiled for {name}")
        if version != "editable":
            build_data["pure_python"] = False
            build_data["tag"] = f"py3-none-{TARGETS[name].wheel}"
            build_data["force_include"] |= self._files(folder, [name, WASM])

    def _files(self, folder: Path, names: list[str]) -> dict[str, str]:
        """Return the libraries and a manifest of them, each with its place in the wheel."""
        manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
        manifest["libraries"] = {name: manifest["libraries"][name] for name in names}
        ours = Path(self.root) / BUILT / f"{names[0]}.json"
        ours.parent.mkdir(parents=True, exist_ok=True)
        ours.write_text(json.dumps(manifest, indent=2) + "\n", "utf-8")
        files = [entry["file"] for entry in manifest["libraries"].values()] + [manifest["layout"]]
        return {str(folder / file): f"{NATIVE}/{file}" for file in files} | {
            str(ours): f"{NATIVE}/{MANIFEST}"
        }
