"""`precise` agrees with what is stored."""

import pytest

from reference import data, precise


@pytest.mark.parametrize(
    ("name", "indices"),
    [
        ("springs", range(0, 320, 32)),
        ("laws", (0, 9, 27)),
        *(
            pytest.param(name, indices, marks=pytest.mark.slow)
            for name, indices in [
                ("hysteretic", range(0, 42, 14)),
                ("laws", range(28, 148, 40)),
                ("gentle", (1,)),
            ]
        ),
    ],
)
def test_stored_values_come_out_again(name, indices):
    """Those of springs were found in normal modes instead."""
    rows = data.read(name)
    for row in [rows[index] for index in indices]:
        outcome = precise.run(**row["case"])
        assert [float(v) for v in outcome.velocities] == pytest.approx(
            row["rebound_speeds"], rel=1e-15, abs=1e-15
        )
        ours = sorted([i.contact, i.start, i.end] for i in outcome.intervals)
        theirs = sorted(row["intervals"])
        for a, b in zip(ours, theirs, strict=True):
            known = [float(x) for x in a if x is not None]
            expected = [x for x in b[:3] if x is not None]
            assert known == pytest.approx(expected, rel=1e-15, abs=1e-14 * row["end_time"])
