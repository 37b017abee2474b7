"""The texts that are kept, and how they compare with the answers of now."""

import difflib
from pathlib import Path

from frozen import fuzz, laws

GROUPS = {"fuzz": fuzz.answers, "laws": laws.answers}


def compare(name: str) -> list[str]:
    """Return the lines that have changed, the kept ones with a minus before them."""
    kept = _file(name).read_text("utf-8").splitlines()
    found = difflib.unified_diff(kept, list(GROUPS[name]()), n=0, lineterm="")
    return [line for line in found if not line.startswith(("---", "+++", "@@"))]


def write(name: str) -> None:
    """Keep the answers of now."""
    _file(name).write_text("\n".join(GROUPS[name]()) + "\n", "utf-8")


def _file(name: str) -> Path:
    return Path(__file__).with_name(f"{name}.txt")
