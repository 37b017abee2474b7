"""Contact times: stiffness and constants with errors, and the paper's own."""

import pytest
from uncertainties import correlation_matrix, ufloat

import stackbounce as sb
from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.bench import Bench
from stackbounce.errors import InvalidValue
from stackbounce.measure import dynamic_stiffness, law_constants, split_series
from stackbounce.measure.kinds.contact import CONTACT
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
    found = CONTACT.of_numbers(Setup(**{name: MEASURED[name] for name in known}))
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


# The paper's own numbers, with the errors that it states or its digits show.


@pytest.fixture
def bench():
    return Bench(PAPER)


def bounced(bench, ball):
    """Return the stiffness of a ball that bounces, by its mass and contact time."""
    return dynamic_stiffness(bench.measured(f"{ball}.mass"), bench.measured(f"{ball}.contact_time"))


def test_a_bounce_is_stiffer_than_a_press(bench):
    balls = ("B1", "B2", "B3")
    ratios = [bounced(bench, ball) / bench.measured(f"{ball}.static_stiffness") for ball in balls]
    assert [f"{ratio:.1fP}" for ratio in ratios] == ["1.3±0.2", "2.8±0.3", "1.9±0.2"]
    pressed = bench.measured("static.force") / bench.measured("static.tennis")
    tennis = [f"{1e-4 * one:.2fP}" for one in (bounced(bench, "tennis"), pressed)]
    assert tennis == ["2.25±0.05", "1.03±0.02"]


def test_two_superballs_in_series_are_stiffer_than_the_fits(bench):
    for upper, fit, expected in (("B2", "fig13", "2.17±0.11"), ("B3", "B3_fit", "1.62±0.12")):
        both = 1.0 / (1.0 / bounced(bench, "B1") + 1.0 / bounced(bench, upper))
        assert f"{1e-4 * both:.2fP}" == expected
        assert both.nominal_value > bench(f"{fit}.ball_stiffness")


def test_hessels_steel_balls(bench):
    """Both ratios are near the diameters', but the digits tell them apart."""
    lengths = [bench.measured(f"steel.{size}_diameter") for size in ("large", "small")]
    diameters = lengths[0] / lengths[1]
    times, masses = bench.measured("steel.time_ratio"), bench.measured("steel.mass_ratio")
    stiffness = dynamic_stiffness(masses, times) / dynamic_stiffness(1.0, 1.0)
    assert f"{stiffness:.3fP}" == "1.422±0.001"
    assert f"{diameters:.3fP}" == "1.411±0.003"
    # Hertz's law at one speed makes the times go as the diameters, and its constant as their roots
    late = diameters - times
    assert 1.0 < late.nominal_value / late.std_dev < 2.0
    large, small = (
        law_constants("Hertz", mass=mass, contact_time=time, impact_speed=1.0).constants
        for mass, time in ((masses, times), (1.0, 1.0))
    )
    assert f"{large['stiffness'] / small['stiffness']:.3fP}" == "1.199±0.001"
    assert f"{diameters**0.5:.3fP}" == "1.188±0.001"


def test_figure_seven(bench):
    lengths = [bench.measured(f"static.{name}") for name in ("basketball", "tennis", "both")]
    split = split_series(*lengths, force=bench.measured("static.force"))
    assert f"{1e3 * split.bottom:.2fP}" == "9.30±0.03"
    assert f"{1e3 * split.top:.2fP}" == "15.50±0.08"
    assert f"{1e3 * split.excess:.2fP}" == "6.20±0.09"
    assert f"{split.ratio:.3fP}" == "1.823±0.010"  # printed 1.8
    assert f"{split.floor_stiffness:.0fP}" == "3226±54"
    assert f"{split.ball_stiffness:.0fP}" == "1770±30"
