"""Print the lowest version of each dependency that pyproject.toml allows, and what tests need."""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOOLS = set("hypothesis httpx llvmlite mpmath numba pytest pytest-xdist pyyaml sphinx".split())
OWN = ("all", "bench", "dev")  # extras that bring nothing of their own to users


def lowest() -> list[str]:
    """Return requirements: the lowest versions, and the tools' as in constraints.txt."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    asked = {*project["dependencies"], *(one for key in extras.keys() - OWN for one in extras[key])}
    ours = [one for one in sorted(asked) if not one.startswith("stackbounce[")]
    if unbounded := [one for one in ours if not re.fullmatch(r"[\w.-]+(\[\w+\])?>=[\w.]+", one)]:
        raise SystemExit(f"pyproject.toml gives no lowest version of {', '.join(unbounded)}")
    pinned = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    tools = [one for one in pinned if one.partition("==")[0].lower() in TOOLS]
    return [one.replace(">=", "==") for one in ours] + tools


if __name__ == "__main__":
    sys.stdout.write("\n".join(lowest()) + "\n")
