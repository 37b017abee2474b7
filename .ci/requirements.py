"""Print requirements of pyproject.toml: `python .ci/requirements.py runtime`, `dev` or `lowest`.

What the package needs with all its extras; what those who change it need besides; or the lowest
versions of the first which are allowed, and what tests need.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
OF_THEN = ["numcodecs==0.16.3"]  # later ones warn of how the lowest zarr uses them
TOOLS = set("hypothesis httpx llvmlite mpmath numba pytest pytest-xdist pyyaml sphinx".split())
CONTENT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


def runtime() -> list[str]:
    """Return what the package needs with all its extras."""
    project = CONTENT["project"]
    extras = project["optional-dependencies"].values()
    return _others({*project["dependencies"], *(asked for extra in extras for asked in extra)})


def dev() -> list[str]:
    """Return what those who change the package need besides."""
    return _others(set(CONTENT["dependency-groups"]["dev"]))


def lowest() -> list[str]:
    """Return the lowest versions that are allowed, and the tools' as in constraints.txt."""
    ours = runtime()
    if unbounded := [
        asked for asked in ours if not re.fullmatch(r"[\w.-]+(\[\w+\])?>=[\w.]+", asked)
    ]:
        raise SystemExit(f"pyproject.toml gives no lowest version of {', '.join(unbounded)}")
    pinned = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    tools = [tool for tool in pinned if tool.partition("==")[0].lower() in TOOLS]
    return [asked.replace(">=", "==") for asked in ours] + OF_THEN + tools


def _others(asked: set[str]) -> list[str]:
    """Return what is asked for in order, without the package itself."""
    return sorted(name for name in asked if not name.startswith("stackbounce["))


if __name__ == "__main__":
    kind = {"runtime": runtime, "dev": dev, "lowest": lowest}[sys.argv[1]]
    sys.stdout.write("\n".join(kind()) + "\n")
