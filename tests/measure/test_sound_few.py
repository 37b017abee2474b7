"""Sounds of one bounce or two: what they tell, and what is missing."""

import numpy as np
import pytest

from stackbounce import plots
from stackbounce.errors import InvalidValue
from stackbounce.measure import analyse, one_ball
from stackbounce.measure.kinds.bounces.analysis import Bounces, bounces
from stackbounce.measure.kinds.sound.few_bounces import FewBounces
from synthetic.falls import falls
from synthetic.sound import sound

TWO = falls(0.5, 0.8, bounces=2)


def test_two_bounces_have_one_flight_and_its_apex():
    told, heard = analyse(sound(TWO, seed=1))
    assert isinstance(told, FewBounces)
    (flight,), (height,) = told.flights, told.apex_heights
    assert flight.nominal_value == pytest.approx(np.diff(TWO.touches)[0], abs=1e-4)
    assert height.nominal_value == pytest.approx(0.5 * 0.8**2, abs=2e-4)
    assert 0.0 < height.std_dev < 2e-4
    assert "needs 3 bounces in a row" in told.notes[0]
    assert "2 were heard" in told.notes[0]
    assert told.parts() == {}
    rows = {row.name: row for one in (told, heard) for row in one.rows()}
    assert rows["time of knock 1"].value.nominal_value == pytest.approx(0.5 + flight.n, abs=1e-4)
    loud = sorted(rows[f"loudness of knock {k}"].value for k in range(2))
    assert 0.3 < loud[0] < loud[1] == 1.0
    assert rows["apex height after bounce 0"].unit == "m"


def test_one_bounce_has_a_time_and_a_loudness():
    told, heard = analyse(sound(falls(0.5, 0.8, bounces=1), seed=1))
    assert told.flights == ()
    assert told.rows() == []
    assert "1 was heard" in told.notes[0]
    assert any("Only 1 knock: too few" in note for note in heard.notes)
    assert [row.name for row in heard.rows()][2:4] == ["time of knock 0", "loudness of knock 0"]


def test_two_bounces_and_the_drop_height_have_a_restitution():
    told, _ = analyse(sound(TWO, seed=1), height=0.5)
    assert isinstance(told, Bounces)
    (kept,) = told.restitutions
    assert kept.nominal_value == pytest.approx(0.8, abs=5e-4)
    assert told.numbers == (0,)
    assert told.parts()["contact"]["restitution"] == pytest.approx(0.8, abs=5e-4)
    with pytest.raises(InvalidValue, match="at least two bounces where the drop height is known"):
        bounces([1.0], drop_height=0.5)


def test_gravity_counts():
    (earth, _), (moon, _) = (analyse(sound(TWO, seed=1), gravity=g) for g in (9.81, 1.62))
    assert earth.apex_heights[0].n / moon.apex_heights[0].n == pytest.approx(9.81 / 1.62)


def test_two_knocks_have_a_picture_and_no_ball():
    data = sound(TWO, seed=1)
    found = analyse(data)
    assert all(plots.measured(data, told).axes for told in found)
    with pytest.raises(InvalidValue, match="no contact was found"):
        one_ball([told.parts() for told in found], mass=0.057)
