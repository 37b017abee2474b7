"""Compile the kernels: `python -m kernel_build [--all] [--force]`.

The exit status is 0 if all is up to date now, 3 for a platform that is not in `targets`, and 4
without numba or zig.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from kernel_build.build import build, is_up_to_date
from kernel_build.targets import TARGETS, WASM
from stackbounce.engine.native import FOLDER, platform_name

IMPOSSIBLE, NO_COMPILER = 3, 4


def main() -> int:
    """Compile what is not there or not up to date; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m kernel_build")
    parser.add_argument("--all", action="store_true", help="for all platforms, not this one only")
    parser.add_argument("--platform", default=platform_name(), help="such as linux-x86_64")
    parser.add_argument("--force", action="store_true", help="also if all is up to date")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where the libraries go")
    given = parser.parse_args()
    if given.platform not in TARGETS and not given.all:
        return _impossible(IMPOSSIBLE, f"kernels are not compiled for {given.platform}")
    names = list(TARGETS) if given.all else list(dict.fromkeys((given.platform, WASM)))
    if given.force or not is_up_to_date(given.folder, names):
        missing = _missing_tool()
        if missing:
            return _impossible(NO_COMPILER, missing)
        print("Compiling the kernels: a minute or two", flush=True)  # noqa: T201
        build(names, given.folder)
    return 0


def _missing_tool() -> str:
    """Return which tool is not there or does not run; nothing if all do."""
    try:
        import llvmlite.binding  # noqa: F401
        import numba  # noqa: F401
    except ImportError as error:
        return f"compiling kernels needs numba: {error}"
    command = [sys.executable, "-m", "ziglang", "version"]
    try:
        zig = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        return f"compiling kernels needs zig: {error}"
    lines = zig.stderr.strip().splitlines() or ["it does not run"]
    return f"compiling kernels needs zig: {lines[-1]}" if zig.returncode else ""


def _impossible(status: int, reason: str) -> int:
    print(f"{reason}; drops run as plain Python", file=sys.stderr)  # noqa: T201
    return status


if __name__ == "__main__":
    sys.exit(main())
