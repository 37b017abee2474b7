"""The first press curve or sound in a fresh process of the server took seconds, for imports."""

import asyncio
import dataclasses
import sys
from pathlib import Path

import pytest

from stackbounce.explorer import LIMITS
from stackbounce.explorer.answers.records import measure_record
from stackbounce.explorer.workers import Workers

LAB = Path(__file__).parents[2] / "docs" / "lab"


def imported_for(name):
    """Return the libraries, but for this package, that a file makes a process import."""
    before = set(sys.modules)
    measure_record(name, (LAB / name).read_bytes(), {"mass": "57 g"})
    return {one for one in set(sys.modules) - before if not one.startswith("stackbounce.")}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["basketball-press.csv", "tennis.wav", "stack-video.txt"])
def test_a_process_has_imported_what_measures_before_its_first_job(name):
    workers = Workers(dataclasses.replace(LIMITS, workers=1))

    async def run():
        workers.start()
        return await workers.run(imported_for, name, seconds=60.0)

    try:
        assert asyncio.run(run()) <= {"uncertainties.umath"}
    finally:
        workers.stop()
