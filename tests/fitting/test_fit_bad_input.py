"""What cannot be fitted is refused in one clear line; what fails on the way is told."""

from importlib import import_module

import numpy as np
import pytest
from uncertainties import ufloat

import stackbounce as sb
from drops import STACK
from refusals import refusal
from stackbounce.errors import InvalidType, InvalidValue, UnitError

STIFFNESS = "contacts.1.stiffness"
DATA = {"rebound_ratios.1": (1.6, 0.02)}
VARY = {STIFFNESS: (500.0, 2000.0)}
NAN = float("nan")


WRONG_DATA = [
    ({"rebound_ratio.1": (1, 0.1)}, InvalidValue, "did you mean rebound_ratios?"),
    ({"rebound_ratios.-1": (1, 0.1)}, InvalidValue, "number of a ball from 0 to 1"),
    ({"rebound_ratios.01": (1, 0.1)}, InvalidValue, "number of a ball from 0 to 1"),
    ({"rebound_ratios.\u0661": (1, 0.1)}, InvalidValue, "number of a ball from 0 to 1"),
    ({"durations." + "9" * 5000: (1, 0.1)}, InvalidValue, "number of a contact from 0 to 1"),
    ({"energy_retained.0": (1, 0.1)}, InvalidValue, "is of the whole stack"),
    ({"rebound_ratios.1": 1.6}, InvalidValue, "must be a number with its error, such as"),
    ({"rebound_ratios.1": None}, InvalidValue, "must be a number with its error, such as"),
    ({"rebound_ratios.1": (1.0, 0.0)}, InvalidValue, "error must be a positive number"),
    ({"rebound_ratios.1": (1.0, NAN)}, InvalidValue, "finite number, got nan"),
    ({"rebound_ratios.1": (NAN, 0.1)}, InvalidValue, "finite number, got nan"),
    ({"rebound_ratios.1": (1.0, 1e308)}, InvalidValue, "error must be at most 1e+100"),
    ({"rebound_ratios.1": (1e300, 1e-300)}, InvalidValue, "must be at most 1e+100 of its err"),
    ({"rebound_ratios.1": "a lot"}, UnitError, "rebound_ratios.1 must be a pure number"),
    ({"durations.0": "5 ± 1 kg"}, UnitError, "durations.0 must be"),
    ({"rebound_ratios.1": (1j, 0.1)}, InvalidType, "rebound_ratios.1 must be a pure number"),
    ({"rebound_ratios": [(1, 0.1)]}, InvalidValue, "must be a list of 2, one for each ball"),
    ({"rebound_ratios": (1.6, 0.1)}, InvalidValue, "rebound_ratios.0 must be a number with"),
    ({"collisions.1": 1}, InvalidValue, "1 number for 0 measured numbers"),
    ({**DATA, "collisions.1": 1.5}, InvalidType, "collisions.1 must be a whole number"),
    ({**DATA, "collisions.1": -2}, InvalidValue, "collisions.1 must be a whole number"),
    ({**DATA, "rebound_ratios": [None, (1, 0.1)]}, InvalidValue, "is given twice"),
    (None, InvalidType, "data must map names to what was measured"),
    ({1: (1, 0.1)}, InvalidType, "data must have names for keys, got 1"),
]
WRONG_BOUNDS = [
    (None, InvalidType, "vary must name what may change"),
    (STIFFNESS, InvalidType, "vary must name what may change"),
    ([[STIFFNESS]], InvalidType, "vary must list names"),
    ({3: (1.0, 2.0)}, InvalidType, "vary must have names for keys, got 3"),
    (["contacts.5.stiffness"], InvalidValue, "did you mean contacts.1.stiffness?"),
    ({"mass": (1.0, 2.0)}, InvalidValue, "neither a number of the drop nor used by a tie"),
    ({"m\u00e4ss": (1.0, 2.0)}, InvalidValue, "is not a parameter of the drop"),
    ({STIFFNESS: (2000.0, 500.0)}, InvalidValue, "lower bound below the upper one, got 2000"),
    ({STIFFNESS: (500.0, 500.0)}, InvalidValue, "lower bound below the upper one, got 500"),
    ({STIFFNESS: (-5.0, 500.0)}, InvalidValue, "cannot be varied to -5"),
    ({STIFFNESS: (NAN, 500.0)}, InvalidValue, "finite number"),
    ({STIFFNESS: "1 m : 2 m"}, UnitError, f"{STIFFNESS} must be a stiffness"),
    ({STIFFNESS: 1000.0}, InvalidValue, "between two bounds"),
    ({STIFFNESS: "1000 ± 0"}, InvalidValue, "error must be a positive number"),
    ({"gaps.0": (0.0, 1e308)}, InvalidValue, "at most 1e+100 apart, got 0 and 1e+308"),
    ({"gaps.0": (0.0, 1e-300)}, InvalidValue, "bounds above 1e-12 "),
    ({STIFFNESS: sb.Range(5.0, 9.0, prior=(7.0, -1.0))}, InvalidValue, "positive number"),
    ([STIFFNESS, "gaps.0"], InvalidValue, "2 numbers for 1 measured number"),
    (["balls.0.diameter"], InvalidValue, "balls.0.diameter is not given in the drop and"),
]
WRONG_DROPS = [
    (None, DATA, InvalidType, "drop must be a Drop or map names to Drops"),
    ({"a": 5}, {"a": DATA}, InvalidType, "drop must be a Drop or map names to Drops, got 5"),
    ({0: STACK}, {0: DATA}, InvalidValue, "a drop's name must be letters, digits and _"),
    ({"a.b": STACK}, {"a.b": DATA}, InvalidValue, "a drop's name must be letters"),
    ({"\u00e4": STACK}, {"\u00e4": DATA}, InvalidValue, "a drop's name must be letters"),
    ({"a": STACK}, {"b": DATA}, InvalidValue, "data of 'b': no drop; known: a"),
    ({"a": STACK}, DATA, InvalidValue, "data of 'rebound_ratios.1': no drop"),
    ({"a": STACK}, [DATA], InvalidType, "data must map each drop's name to its data"),
    ({"a": STACK}, {"a": None}, InvalidType, "a must map names to what was measured"),
    ({"a": STACK}, {}, InvalidValue, "1 number for 0 measured numbers"),
]


@pytest.mark.parametrize(
    ("given", "kind", "message"),
    [
        *(({"data": data}, *expected) for data, *expected in WRONG_DATA),
        *(({"vary": vary}, *expected) for vary, *expected in WRONG_BOUNDS),
        *(({"drop": drop, "data": data}, *expected) for drop, data, *expected in WRONG_DROPS),
        *(({"starts": n}, InvalidValue, "starts must ") for n in (0, 10**9)),
        ({"starts": 1.5}, InvalidType, "starts must "),
        ({"rng": 1.5}, InvalidType, "rng must "),
        ({"rtol": 1.0}, InvalidValue, "rtol must "),
        ({"tie": 5}, InvalidType, "tie must "),
    ],
)
def test_data_bounds_drops_and_options_that_do_not_fit(given, kind, message):
    asked = {"drop": STACK, "data": DATA, "vary": VARY} | given
    told = refusal(kind, sb.fit, **asked)
    assert message in told
    assert len(told) < 1000


def test_an_interval_needs_a_width():
    found = sb.fit(STACK, DATA, VARY, starts=1)
    for sigma in (0.0, -1.0, NAN):
        with pytest.raises(InvalidValue, match=r"^sigma must be"):
            found.intervals(sigma=sigma)


def test_numbers_may_come_in_many_forms():
    forms = [(1.6, 0.02), "1.6 ± 0.02", "1.6 +/- 0.02", ufloat(1.6, 0.02), np.array([1.6, 0.02])]
    data = [{"rebound_ratios.1": form} for form in forms]
    data += [{"rebound_ratios": form} for form in ([None, (1.6, 0.02)], ["", "1.6 ± 0.02"])]
    found = [sb.fit(STACK, one, VARY, starts=1).best for one in data]
    assert all(one == found[0] for one in found)
    data = [{"rebound_ratios": form([(0.64, 0.02), (1.6, 0.02)])} for form in (list, np.array)]
    one, other = (sb.fit(STACK, both, VARY, starts=1).best for both in data)
    assert one == other


def test_bounds_may_come_in_many_forms():
    forms = [(500.0, 2000.0), [500, 2000], "0.5 kN/m : 2 kN/m", sb.Range("0.5 kN/m", 2e3)]
    found = [sb.fit(STACK, DATA, {STIFFNESS: form}, starts=1).best for form in forms]
    assert all(one == found[0] for one in found)


def test_a_drop_that_never_ends_is_told(monkeypatch):
    """With room for two events no drop comes to an end."""
    assert not sb.fit(STACK, DATA, VARY, starts=4).unsolved
    monkeypatch.setattr(import_module("stackbounce.fitting.objective"), "_EVENTS", 2)
    hertz = sb.Drop(STACK.balls, [sb.Hertz(1e5), sb.Hertz(5e4)], impact_speed=3.5)
    found = sb.fit(hertz, DATA, {STIFFNESS: (1e4, 1e5)}, starts=4)
    assert found.unsolved["EVENT_LIMIT"] > 4
    assert "(EVENT_LIMIT)" in found.notes[0]
    assert found.chi_squared == 1e8
    assert "rebound_ratios.1: the fitted drop has none" in found.notes
    assert any("runs did not finish" in note for note in found.sample(640).notes)
