"""Which cases of coverage are counted: a few in each run of the tests, all with `make coverage`."""

import os
from collections.abc import Collection


def chosen(cases: Collection[str], *few: str) -> list[str]:
    """Return the names of some cases, or of all where all are asked for."""
    missing = set(few) - set(cases)
    assert not missing, missing
    return list(cases if os.environ.get("STACKBOUNCE_COVERAGE") == "all" else few)
