"""The stored drops of `tests/data`: cases, at random or from the paper, and their solutions.

In the files contacts without a name are springs or hysteretic. The numbers are those of `precise`,
to 20 or 28 digits; an interval is contact, start, end, peak force, peak compression, impulse. The
rows of ``bugs`` and ``extreme`` have velocities at most. The latter are two balls with ratios of
masses and contact times of up to a million, under all pairs of seven laws. A program of power
series in C++ found the same to 4e-16; those with a relaxing solid were solved by it alone.
"""

import json
from pathlib import Path
from typing import Any

DATA = Path(__file__).parents[1] / "data"
Case = dict[str, Any]


def read(name: str) -> list[Case]:
    """Return the rows of a data file, their numbers as floats, each contact with its law's name."""
    rows = json.loads((DATA / f"{name}.json").read_text())
    for row in rows:
        row["case"]["contacts"] = [
            c and {"law": "Hysteretic" if len(c) > 1 else "Spring", **c}
            for c in row["case"]["contacts"]
        ]
    return rows
