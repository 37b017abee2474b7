"""The paper's audit: every number of the paper beside what the solvers give, and its tables."""

import csv
import io
import json
from pathlib import Path
from typing import Any

from frozen import lab

_SOURCES = ("source", "computed by")  # lines of the package's own code


def answers() -> dict[str, Any]:
    """Return what ``stackbounce paper`` writes to audit.json and audit.csv, by the rows' names."""
    with lab.folder():
        ran = lab.run(["paper", "--out", "paper"])
        if ran.code:
            return {"code": ran.code, "err": ran.err}
        told = json.loads(Path("paper/audit.json").read_text(encoding="utf-8"))
        table = Path("paper/audit.csv").read_text(encoding="utf-8")
        figures = sorted(file.name for file in Path("paper/figures").iterdir())
    named = {key: _named(value) for key, value in told.items()}
    rows = {row["id"]: _numbers(row) for row in csv.DictReader(io.StringIO(table))}
    return {"json": _without_sources(named), "csv": _without_sources(rows), "files": figures}


def _named(value: Any) -> Any:
    """Return a list of things with names as a mapping, so that a new one shifts no other."""
    for key in ("id", "name"):
        if isinstance(value, list) and value and all(key in one for one in value):
            return {str(one[key]): one for one in value}
    return value


def _numbers(row: dict[str, str]) -> dict[str, Any]:
    """Return the cells of a row, numbers as such."""
    return {key: _number(cell) for key, cell in row.items()}


def _number(cell: str) -> float | str:
    try:
        return float(cell)
    except ValueError:
        return cell


def _without_sources(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_sources(one) for key, one in value.items() if key not in _SOURCES}
    if isinstance(value, list):
        return [_without_sources(one) for one in value]
    return value
