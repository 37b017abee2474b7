"""Compile the kernels and make the page while hatchling builds the package, and complete README.

A wheel holds kernels and page, see `kernel_build` and `page_build`.

The environment variable STACKBOUNCE_PLATFORM, such as ``macos-aarch64``, asks for the wheel of
another platform, and ``any`` for that of all others: plain Python, and the page. Where nothing can
be compiled, the wheel has plain Python only, and no page.
"""

import json
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

NATIVE = "stackbounce/engine/native"
PAGE = "stackbounce/explorer/made"
MANIFEST = "manifest.json"
BUILT = "build/kernels"  # what is only for wheels
ANY = "any"
# Not PYTHONPATH: beside an editable installation, pip's build takes its folder out of that path.
START = (
    "import sys; sys.path[:0] = sys.argv[1:3]; del sys.argv[1:3]; "
    "from {}.__main__ import main; sys.exit(main())"
)


class KernelHook(BuildHookInterface[Any]):
    """Hatchling calls it before it builds a wheel, be it `standard` or `editable`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile what is not up to date, and put it into the wheel."""
        root = Path(self.root)
        sys.path[:0] = [str(root / "src"), str(root)]
        from kernel_build.__main__ import IMPOSSIBLE, NO_COMPILER
        from kernel_build.targets import TARGETS, WASM

        from stackbounce.engine.native import platform_name

        other = "" if version == "editable" else os.environ.get("STACKBOUNCE_PLATFORM", "")
        name = other or platform_name()
        folder = root / BUILT / "native" if other else root / "src" / NATIVE
        page = root / BUILT / "page" if other else root / "src" / PAGE
        asked = WASM if name == ANY else name
        status = self._run("kernel_build", "--platform", asked, "--folder", str(folder))
        if status in (IMPOSSIBLE, NO_COMPILER) and not other:
            return  # it has said why
        if status:
            self.app.abort(f"the kernels could not be compiled for {name}")
        if self._run("page_build", "--engine", str(folder), "--folder", str(page)):
            self.app.abort("the page could not be made")
        if version != "editable":
            build_data["force_include"] |= {
                str(file): f"{PAGE}/{file.name}"
                for file in sorted(page.iterdir())
                if file.suffix != ".sha256"  # of the sources
            }
        if version != "editable" and name != ANY:
            build_data["pure_python"] = False
            build_data["tag"] = f"py3-none-{TARGETS[name].wheel}"
            build_data["force_include"] |= self._library(folder, name)

    def _run(self, builder: str, *given: str) -> int:
        """Run one of the builders; return its exit status."""
        start = [sys.executable, "-c", START.format(builder), f"{self.root}/src", self.root]
        return subprocess.run([*start, *given], cwd=self.root, check=False).returncode

    def _library(self, folder: Path, name: str) -> dict[str, str]:
        """Return a platform's library and a manifest of it, each with its place in the wheel."""
        manifest = json.loads((folder / MANIFEST).read_text("utf-8"))
        library = manifest["libraries"][name]
        manifest["libraries"] = {name: library}
        ours = Path(self.root) / BUILT / f"{name}.json"
        ours.parent.mkdir(parents=True, exist_ok=True)
        ours.write_text(json.dumps(manifest, indent=2) + "\n", "utf-8")
        return {
            str(folder / library["file"]): f"{NATIVE}/{library['file']}",
            str(ours): f"{NATIVE}/{MANIFEST}",
        }


class ReadmeHook(MetadataHookInterface):
    """Hatchling calls it for the metadata, of which README is the long description."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Set README with whole addresses, in the source of this version, for its relative ones."""
        root = Path(self.root)
        version = runpy.run_path(str(root / "src/stackbounce/version.py"))["__version__"]
        source = metadata["urls"]["Source"]

        def whole(link: re.Match[str]) -> str:
            kind = "raw" if link[1].endswith((".gif", ".png")) else "blob"
            return f"]({urljoin(f'{source}/{kind}/v{version}/', link[1])})"

        text = re.sub(r"\]\((?!https://)([^)]+)\)", whole, (root / "README.md").read_text("utf-8"))
        metadata["readme"] = {"content-type": "text/markdown", "text": text}
