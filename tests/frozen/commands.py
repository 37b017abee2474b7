"""What every command answers: numbers as JSON, tables for people, and the files it saves."""

import itertools
import json
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from frozen import lab

LINES = Path(__file__).with_name("commands.txt")
FORMATS = sorted(lab.made())  # files as programs write them; some need to be told what they hold
COMPARISONS = (
    "fit cross2007/B1-B2 --compare",
    "fit cross2007/basketball-tennis --compare",
    "fit equal.toml --compare",
)
_SLOW = "+"


def lines_of(file: Path) -> list[str]:
    """Return the lines of a list, without remarks and blank lines."""
    lines = (line.strip() for line in file.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def numbers() -> dict[str, Any]:
    """Return what the commands answer to machines, and what they save."""
    with lab.folder():
        found = {line.strip("+ "): _numbers(line) for line in lines_of(LINES)}
        return found | {f"measure {name}": _numbers(f"measure {name}") for name in FORMATS}


def comparisons() -> dict[str, Any]:
    """Return what the usual models give side by side, which takes half a minute."""
    with lab.folder():
        return {line: _numbers(line) for line in COMPARISONS}


def texts() -> dict[str, Any]:
    """Return what the commands print for people; the slow ones are run only if others need them."""
    with lab.folder():
        lines = [line for line in lines_of(LINES) if not line.startswith(_SLOW)]
        return {line: _told(lab.run(shlex.split(line))) for line in lines}


def _told(ran: lab.Ran) -> dict[str, Any]:
    return {"code": ran.code, "out": ran.out, "err": ran.err}


def _numbers(line: str) -> dict[str, Any]:
    """Run a command for machines; what failed has its message instead of an answer."""
    arguments = shlex.split(line.strip("+ "))
    ran = lab.run([*arguments, "--json"])
    if ran.code:
        return {"code": ran.code, "err": ran.err}
    return {"json": json.loads(ran.out), **_written(arguments)}


def _written(arguments: Sequence[str]) -> dict[str, Any]:
    """Return the contents of the files that a command saved."""
    written: dict[str, Any] = {}
    for option, value in itertools.pairwise(arguments):
        path = Path(value)
        if option == "--save":
            files = sorted(path.iterdir()) if path.is_dir() else [path]
            written |= {str(file): _without_mark(file) for file in files}
        elif option == "--out":
            with xr.open_zarr(path) as dataset:
                written[value] = {"attributes": dataset.attrs, "values": dataset.load()}
    return written


def _without_mark(path: Path) -> str:
    """Return a file without its last line, the digest of the rest, which has no tolerance."""
    return path.read_text(encoding="utf-8").rpartition("# sha256")[0]
