"""Every finite law, pure and mixed, against the thirty-digit reference of `reference.precise`."""

import json
import math

import numpy as np
import pytest

import stackbounce as sb
from reference.make_data import DATA

ROWS = json.loads((DATA / "laws.json").read_text())
KEPT = ["contact", "start", "end", "peak_force", "peak_compression", "impulse"]
TOLERANCES = (1e-4, 1e-6, 1e-9, 1e-12, 1e-13)
ROUND_OFF = 1e-12  # of a time, below which the end of a creeping contact is not known
CREEPING = 0.02  # of the speed before: a contact that ends slower ends at an ill-conditioned time


def drop_of(case):
    contacts = []
    for law in case["contacts"]:
        numbers = dict(law or {})
        contacts.append(getattr(sb, numbers.pop("law"))(**numbers) if law else None)
    return sb.Drop(
        [sb.Ball(mass) for mass in case["masses"]],
        contacts,
        case["gaps"],
        velocities=case["velocities"],
        gravity=case.get("gravity", 0.0),
    )


def table(rows):
    """Return intervals in order of contact and start; nan for an end that is open."""
    rows = sorted(tuple(math.nan if x is None else float(x) for x in row) for row in rows)
    out = np.array(rows).reshape(-1, 6)
    out[~np.isfinite(out)] = math.nan
    return out


@pytest.mark.parametrize("rtol", TOLERANCES)
@pytest.mark.parametrize("index", range(len(ROWS)))
def test_error_is_below_ten_times_the_tolerance_asked_for(index, rtol):
    row = ROWS[index]
    drop = drop_of(row["case"])
    result = sb.simulate(drop, until=row["case"].get("until"), rtol=rtol, compiled=True)
    expected = table(row["intervals"])
    counts = np.bincount(expected[:, 0].astype(int), minlength=len(drop.balls))
    assert result.collisions.tolist() == counts.tolist()
    error = np.abs(result.rebound_speeds - row["rebound_speeds"]).max()
    assert error <= 10 * rtol * drop.reference_speed
    found = table(result.intervals[KEPT].tolist())
    for column in (3, 4, 5):  # peaks and impulses, by the largest of them
        size = np.max(expected[:, column], initial=0.0)
        assert found[:, column] == pytest.approx(expected[:, column], abs=100 * rtol * size)
    # a time's error is that of a length over the speed there, which can be small
    time = max(rtol, ROUND_OFF) * row["end_time"]
    assert found[:, 1] == pytest.approx(expected[:, 1], abs=1e3 * time)
    if len(drop.balls) == 1 and abs(row["rebound_speeds"][0]) < CREEPING * drop.reference_speed:
        return
    assert found[:, 2] == pytest.approx(expected[:, 2], abs=1e3 * time, nan_ok=True)
