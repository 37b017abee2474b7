"""Drops in which something was wrong, mostly found by the fuzz: `data/bugs.json` says what."""

import numpy as np
import pytest

import stackbounce as sb
from drops import drop_of
from fuzz.check import faults_of
from reference import data

ROWS = data.read("bugs")
STOPS = np.linspace(0.0, 1.0, 200, endpoint=False)[1:]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["was"])
def test_nothing_is_wrong_any_more(row):
    options = {name: row[name] for name in ("until", "event_limit") if name in row}
    for rtol in row["rtols"]:
        result = sb.simulate(drop_of(row["case"]), rtol=rtol, **options)
        assert result.status.name == row["status"]
        assert result.energy_retained < 1.0 + rtol
        assert faults_of(result, STOPS) == []
        if "rebound_speeds" in row:  # by thirty digits
            within = row["within"] * rtol * result.drop.reference_speed
            assert result.rebound_speeds == pytest.approx(row["rebound_speeds"], abs=within)
            assert result.collisions.tolist() == row["collisions"]
