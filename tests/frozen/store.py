"""The files that keep what was: a table of paths and values for each group."""

import gzip
import json
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent / "data"


def file_of(group: str) -> Path:
    """Return the file of a group."""
    return FOLDER / f"{group}.json.gz"


def kept(group: str) -> dict[str, Any]:
    """Return what was kept of a group; nothing if it is new."""
    file = file_of(group)
    if not file.exists():
        return {}
    found: dict[str, Any] = json.loads(gzip.decompress(file.read_bytes()))
    return found


def keep(group: str, table: dict[str, Any]) -> None:
    """Write the table of a group: the same table is the same file."""
    FOLDER.mkdir(exist_ok=True)
    lines = json.dumps(table, ensure_ascii=False, indent=0)
    file_of(group).write_bytes(gzip.compress(lines.encode(), compresslevel=9, mtime=0))


def as_stored(table: dict[str, Any]) -> dict[str, Any]:
    """Return a table as it would be read again."""
    found: dict[str, Any] = json.loads(json.dumps(table))
    return found
