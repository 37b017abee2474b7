"""The records that the explorer offers for a try are those that `example_records` makes."""

import re
from importlib.resources import files

import numpy as np
import pytest

import stackbounce as sb
from example_records import floor_force, two_tracks

EXAMPLES = files("stackbounce.explorer") / "static" / "examples"
MADE = {
    "floor-force.csv": (floor_force, 0.1, "waveform"),
    "two-tracks.csv": (two_tracks, 1e-4, "track"),
}


def _numbers(text):
    return np.array([float(number) for number in re.findall(r"-?\d+\.\d+(?:E[+-]?\d+)?", text)])


@pytest.mark.parametrize("name", MADE)
def test_a_record_is_as_it_is_made_to_its_last_digit_and_read_as_what_it_is(name):
    make, digit, holds = MADE[name]
    kept, made = (EXAMPLES / name).read_text(encoding="utf-8"), make()
    assert kept.count("\n") == made.count("\n") > 100
    assert kept.splitlines()[0] == made.splitlines()[0]
    np.testing.assert_allclose(_numbers(kept), _numbers(made), rtol=0.0, atol=1.001 * digit)
    assert sb.read(EXAMPLES / name).attrs["holds"] == holds


def test_the_page_offers_each_record_and_no_other():
    said = (EXAMPLES.parent / "index.html").read_text(encoding="utf-8")
    offered = set(re.findall(r'data-example="(.+?)"', said))
    assert offered == set(MADE) == {path.name for path in EXAMPLES.iterdir()}
