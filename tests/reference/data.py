"""The stored drops of `tests/data`: cases, at random or from the paper, and their solutions.

Contacts are springs or hysteretic where they have no name. The numbers are those of `precise`, to
20 or 28 digits; an interval is contact, start, end, peak force, peak compression, impulse.
"""

import json
from pathlib import Path
from typing import Any

DATA = Path(__file__).parents[1] / "data"
Case = dict[str, Any]


def read(name: str) -> list[Case]:
    """Return the rows of a data file, their numbers as floats."""
    return json.loads((DATA / f"{name}.json").read_text())


def with_names(case: Case) -> Case:
    """Return a case whose contacts have the names of their laws."""
    contacts = [
        c and {"law": "Hysteretic" if len(c) > 1 else "Spring", **c} for c in case["contacts"]
    ]
    return {**case, "contacts": contacts}
