"""Print requirements of pyproject.toml: `python .ci/requirements.py build`, `runtime` or `lowest`.

What a build needs; what the package needs with all its extras; or the lowest versions of that
which are allowed, and what tests need.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOOLS = set("hypothesis httpx llvmlite mpmath numba pytest pytest-xdist pyyaml sphinx".split())
OWN = ("all", "bench", "dev")  # extras that bring nothing of their own to users
CONTENT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


def build() -> list[str]:
    """Return what a build needs."""
    return list(CONTENT["build-system"]["requires"])


def runtime() -> list[str]:
    """Return what the package needs with all its extras."""
    project = CONTENT["project"]
    extras = project["optional-dependencies"]
    asked = {*project["dependencies"], *(one for key in extras.keys() - OWN for one in extras[key])}
    return [one for one in sorted(asked) if not one.startswith("stackbounce[")]


def lowest() -> list[str]:
    """Return the lowest versions that are allowed, and the tools' as in constraints.txt."""
    ours = runtime()
    if unbounded := [one for one in ours if not re.fullmatch(r"[\w.-]+(\[\w+\])?>=[\w.]+", one)]:
        raise SystemExit(f"pyproject.toml gives no lowest version of {', '.join(unbounded)}")
    pinned = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    tools = [one for one in pinned if one.partition("==")[0].lower() in TOOLS]
    return [one.replace(">=", "==") for one in ours] + tools


if __name__ == "__main__":
    kind = {"build": build, "runtime": runtime, "lowest": lowest}[sys.argv[1]]
    sys.stdout.write("\n".join(kind()) + "\n")
