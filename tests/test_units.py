import math

import numpy as np
import pint
import pytest
import xarray as xr
from uncertainties import ufloat

import stackbounce as sb
from refusals import refusal
from stackbounce import errors
from stackbounce.units import quantity


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("58 mm", "m", 0.058),
        ("0.63m", "m", 0.63),
        ("5 µm", "m", 5e-6),
        ("2 in", "m", 0.0508),
        ("24.8 g", "kg", 0.0248),
        ("20 kN/m", "N/m", 20000.0),
        ("9.81 m/s^2", "m/s**2", 9.81),
        ("9.81 m s^-2", "m/s**2", 9.81),
        ("36 km/h", "m/s", 10.0),
        ("78 %", "", 0.78),
        ("1 N/mm^1.5", "N/m**1.5", 1000.0**1.5),
        ("-.5 m", "m", -0.5),
        ("+2 m", "m", 2.0),
        (" 2 m ", "m", 2.0),
        ("0.058", "m", 0.058),
        (0.058, "m", 0.058),
        (np.float64(0.058), "m", 0.058),
    ],
)
def test_strings_with_units_and_numbers_of_si(text, unit, value):
    got = quantity(text, unit)
    assert type(got) is float
    assert got == pytest.approx(value, rel=1e-15, abs=0)


@pytest.mark.parametrize("text", ["24.8 g", "8.5 g", "0.1 g", "101 g"])
def test_decimal_prefixes_lose_no_digit(text):
    assert quantity(text, "kg") == float(f"{text.removesuffix(' g')}e-3")


@pytest.mark.parametrize(
    ("text", "unit", "kind"),
    [
        ("3 kg", "m", 'a length (a number of m or a string such as "58 mm")'),
        ("3 m", "kg", "a mass"),
        ("3 m", "m/s", "a speed"),
        ("3 m", "", "a pure number"),
        ("1 N/m", "N/m**1.5", "a quantity"),
    ],
)
def test_units_that_do_not_fit(text, unit, kind):
    said, _, got = refusal(errors.UnitError, quantity, text, unit, "x").partition(", got ")
    assert said.startswith(f"x must be {kind}")
    assert got == repr(text)


@pytest.mark.parametrize(
    "text",
    [
        "", " ", "mm", "mm 58", "58 58 mm", "1,5 mm", "nan", "inf", "nan m", "0x10 m",
        "1e9999999 m",
        "1 Ym^9 Ym^9 Ym^9 m^-9 m^-9 m^-8",
        "3 m**", "3 m^", "3 (m)", "3 m;", "3 'm'", "4 lambda", "4 if", "3 m**9**9**9**9", "٣ m",
        "3 dB", "4 degC", "3 " + "m" * 100, "3 " + "m " * 40, "__import__('os')", "3 __class__",
    ],
)  # fmt: skip
def test_strings_that_cannot_be_read(text):
    said = refusal(errors.UnitError, quantity, text, "m", "x")
    assert said.startswith("x must be a length ")
    assert len(said) < 200


@pytest.mark.parametrize("value", [None, True, [1.0], {}, b"3 m"])
def test_neither_number_nor_string(value):
    with pytest.raises(errors.InvalidType, match=r"^x must be a length "):
        quantity(value, "m", "x")


@pytest.mark.parametrize("value", [math.nan, math.inf, "1e999", "1e999 m"])
def test_not_finite(value):
    with pytest.raises(errors.InvalidValue, match=r"^x must be a finite number of m, got "):
        quantity(value, "m", "x")


# --- numbers with units, wherever a number is taken

U = pint.UnitRegistry()  # not the package's own
G = U("m/s^2")
BALLS, SPRINGS = [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)]
DROP = sb.Drop(BALLS, SPRINGS, gaps=[0.002], height=0.63)
TWO = sb.Drop([sb.Ball(1.0), sb.Ball(0.5), sb.Ball(0.01)], [sb.Rigid(1.0)] * 3, height=1.0)


@pytest.mark.parametrize(
    ("got", "right"),
    [
        (lambda: sb.Ball("57 g", 6.6 * U.cm, "t", "2 MPa"), sb.Ball(0.057, 0.066, "t", 2e6)),
        (lambda: sb.Drop(BALLS, SPRINGS, ["2 mm"], height=63 * U.cm), DROP),
        (lambda: sb.Drop(BALLS, SPRINGS, [2] * U.mm, None, "63 cm", gravity="0 m/s^2"), DROP),
        (lambda: sb.Drop(BALLS, SPRINGS, velocities=["-1 m/s", 0]).velocities, (-1.0, 0.0)),
        (lambda: sb.Hertz("3e6 N/m^1.5"), sb.Hertz(3e6)),
        (lambda: sb.PowerLaw(2 * U("kN/m^1.2"), "1.2"), sb.PowerLaw(2e3, 1.2)),
        (lambda: sb.Hysteretic("2 kN/m", restitution="75 %"), sb.Hysteretic(2e3, restitution=0.75)),
        (lambda: sb.Tabulated(["0 mm", "1 mm"], [0, 20] * U.N), sb.Tabulated([0, 1e-3], [0, 20])),
        (lambda: sb.calibrate(sb.Spring, mass="57 g", contact_time=5 * U.ms).stiffness, 22502.698),
        (lambda: sb.contact_time(sb.Spring(22500.0), [57, 57] * U.g), 3.5357459e-3),
        (lambda: sb.restitution(sb.Dashpot(100.0, "2 N s/m"), "1 kg", "1 m/s"), 0.74407940),
        (lambda: sb.simulate(DROP, until="1 ms").end_time, 1e-3),
        (lambda: list(sb.simulate(DROP).sample([1, 2] * U.ms).time), [1e-3, 2e-3]),
        (lambda: list(sb.highest(["B1", "B2"], 2, gaps=["1 mm"]).gap), [1e-3]),
        (lambda: sb.highest(TWO, masses=("20 g", "0.9 kg")).within, (0.02, 0.9)),
        (lambda: sb.Air("1.2 kg/m^3").rise(sb.Ball(0.057, 0.066), "5 m/s", 9.81 * G), 1.24583945),
        (lambda: sb.measure.dynamic_stiffness("57 ± 1 g", 5 * U.ms).n, 22502.698),
        (lambda: sb.measure.heights("1 m", [0.25] * U.m).mean.n, 0.5),
        (lambda: sb.predict(DROP, {"height": 63 * U.cm * ufloat(1, 0.1)}).drop.height, 0.63),
    ],
)  # fmt: skip
def test_a_number_may_have_a_unit(got, right):
    assert got() == (pytest.approx(right, rel=1e-6) if isinstance(right, float) else right)


@pytest.mark.parametrize(
    "values",
    [["10 g", "20 g"], ("10 g", "20 g"), "10 g:20 g:2", "10g,20g", [10.0, 20.0] * U.g,
     [10 * U.g, "20 g"], ("x", [10, 20] * U.g), xr.DataArray([10.0, 20.0] * U.g, dims="x")],
    ids=str,
)  # fmt: skip
def test_values_of_a_sweep_may_have_units(values):
    ds = sb.sweep(DROP, {"balls.1.mass": values})
    assert ds.balls_1_mass.values.tolist() == [0.01, 0.02]


def test_a_wrong_unit_says_what_would_be_right():
    got = refusal(errors.UnitError, quantity, "3 furlongz", "m")
    assert got.endswith(", got '3 furlongz', of unknown unit")
    right = 'mass must be a mass (a number of kg or a string such as "150 g"), got '
    assert refusal(errors.UnitError, sb.Ball, "16 cm") == right + "'16 cm'"
    assert refusal(errors.UnitError, sb.Ball, 16 * U.cm) == right + "'16 centimeter'"
    got = refusal(errors.UnitError, sb.sweep, DROP, {"balls.0.mass": [1, 2] * U.m})
    assert got == f"balls.0.{right}'[1 2] meter'"
    assert "(predict takes one)" in refusal(errors.UnitError, sb.Ball, ufloat(0.15, 0.01))
