"""Contact times: stiffness and constants with errors."""

import pytest
from uncertainties import correlation_matrix, ufloat

import stackbounce as sb
from stackbounce.errors import InvalidValue
from stackbounce.measure import dynamic_stiffness, law_constants
from stackbounce.measure.kinds.contact.kind import of_numbers
from stackbounce.measure.setup import Setup

MEASURED = {
    "mass": ufloat(0.0567, 0.0005),
    "contact_time": ufloat(5e-3, 0.1e-3),
    "restitution": ufloat(0.75, 0.02),
    "impact_speed": ufloat(3.0, 0.05),
}


def test_errors_of_both():
    k = dynamic_stiffness(MEASURED["mass"], MEASURED["contact_time"])
    relative = ((0.0005 / 0.0567) ** 2 + (2 * 0.1 / 5.0) ** 2) ** 0.5
    assert k.std_dev / k.nominal_value == pytest.approx(relative)
    law = sb.calibrate(sb.Spring, mass=0.0567, contact_time=5e-3)
    assert k.nominal_value == pytest.approx(law.stiffness)


@pytest.mark.parametrize(
    ("law", "known"), [("Rigid", ["restitution"]), ("Spring", ["mass", "contact_time"])]
)
def test_a_contact_without_a_restitution_or_without_a_time(law, known):
    found = of_numbers(Setup(**{name: MEASURED[name] for name in known}))
    assert found.parts()["contact"]["law"] == law


def test_two_balls_have_their_reduced_mass():
    pair = dynamic_stiffness((ufloat(0.1, 0.01), 0.1), 1e-3)
    assert pair.nominal_value == pytest.approx(dynamic_stiffness(0.05, 1e-3).nominal_value)
    assert pair.std_dev / pair.nominal_value == pytest.approx(0.05)


@pytest.mark.parametrize("law", [sb.Dashpot, sb.Viscoelastic, sb.HuntCrossley, sb.Hysteretic])
def test_constants_are_those_of_calibrate(law):
    found = law_constants(law, **MEASURED)
    at = {name: value.nominal_value for name, value in MEASURED.items()}
    assert found.law == sb.calibrate(law, **at)
    for name, value in found.constants.items():
        assert value.nominal_value == getattr(found.law, name)
    # to first order: with one number changed by its error, as much as its share of the error
    moved = sb.calibrate(law, **(at | {"restitution": 0.77}))
    for name, value in found.constants.items():
        shares = value.error_components()
        share = next((s for v, s in shares.items() if v is MEASURED["restitution"]), 0.0)
        change = getattr(moved, name) - value.nominal_value
        assert abs(change) == pytest.approx(share, rel=0.12, abs=1e-9 * value.nominal_value)


def test_constants_know_their_correlation():
    found = law_constants("Dashpot", **MEASURED).constants
    names = ("contact_time", "restitution")
    matrix = correlation_matrix([*found.values(), *(MEASURED[name] for name in names)])
    assert matrix[0, 2] < -0.9
    assert matrix[1, 3] < -0.9


@pytest.mark.parametrize(
    ("law", "given"),
    [
        (sb.Rigid, {"restitution": ufloat(0.0, 0.01)}),
        (sb.Rigid, {"restitution": ufloat(1.0, 0.01)}),
        (sb.PowerLaw, {**MEASURED, "restitution": 1.0, "exponent": ufloat(1.0, 0.1)}),
        (sb.Hysteretic, {**MEASURED, "restitution": ufloat(1.0, 0.02)}),
    ],
)
def test_at_the_ends_of_a_range(law, given):
    found = law_constants(law, **given)
    assert all(value.std_dev >= 0.0 for value in found.constants.values())
    contact = found.parts()["contact"]
    assert contact["law"] == law.__name__
    sb.Drop.from_mapping({"balls": [{"mass": 0.1}], "contacts": [contact], "impact_speed": 1.0})
    assert found.rows()[0].value == law.__name__


@pytest.mark.parametrize(
    ("function", "given", "error", "words"),
    [
        (dynamic_stiffness, (ufloat(-1.0, 0.1), 1.0), InvalidValue, "mass must be a positive num"),
        (dynamic_stiffness, (1.0, "5 mm"), InvalidValue, "contact_time must be"),
        (dynamic_stiffness, ((1.0, 1.0, 1.0), 1e-3), InvalidValue, "pair"),
        (dynamic_stiffness, (ufloat(1.0, float("nan")), 1e-3), InvalidValue, "error"),
        (law_constants, ("Sprung",), InvalidValue, "did you mean Spring"),
        (law_constants, ("Spring",), InvalidValue, "restitution must be 1"),
    ],
)
def test_what_cannot_be(function, given, error, words):
    more = {"mass": 1.0, "contact_time": 1.0, "restitution": 0.9}
    with pytest.raises(error, match=words):
        function(*given, **more if function is law_constants else {})
