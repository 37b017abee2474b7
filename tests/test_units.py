import math

import numpy as np
import pytest

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


def test_unknown_unit_is_said_to_be_one():
    with pytest.raises(errors.UnitError, match=r"got '3 furlongz', of unknown unit$"):
        quantity("3 furlongz", "m")


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
