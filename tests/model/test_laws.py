"""The contact laws, Hertz's stiffness from materials, and two contacts in series."""

import dataclasses
import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import stackbounce as sb
from refusals import refusal
from stackbounce import errors
from stackbounce.model import LAWS

STEEL = {"young_modulus": 206e9, "poisson_ratio": 0.3}
RUBBER = {"young_modulus": 5e6, "poisson_ratio": 0.5}

positive = st.floats(1e-3, 1e9)
exponents = st.floats(1.0, 5.0)


SCATTERED = sb.RigidLossBySpeed(0.5, 2.0, 0.43, scatter=0.1, seed=3)
RIGID = [sb.Rigid(0.5), sb.RigidBySpeed(0.5, 2.0), SCATTERED]
FINITE = [
    sb.Spring(2.0),
    sb.Hertz(2.0),
    sb.PowerLaw(2.0, 1.3),
    sb.Dashpot(2.0, 0.3),
    sb.StandardLinearSolid(2.0, 0.5, 0.3),
    sb.Viscoelastic(2.0, 0.3),
    sb.HuntCrossley(2.0, 1.5, 0.3),
    sb.Hysteretic(2.0, restitution=0.5),
    sb.HollowBall(2.0, 0.1, 0.3, 0.5),
]
EXAMPLES = RIGID + FINITE


def test_every_law_is_named():
    assert list(LAWS.values()) == [type(law) for law in EXAMPLES]
    assert all(getattr(sb, name) is law for name, law in LAWS.items())


def test_numbers_become_floats():
    law = sb.HuntCrossley(np.float32(2), 1, np.int64(0))
    assert [type(value) for value in vars(law).values()] == [float] * 3


@pytest.mark.parametrize("law", [*EXAMPLES, sb.Hysteretic(1.0, unloading_exponent=3.3)], ids=repr)
def test_a_law_is_a_frozen_value(law):
    assert eval(repr(law), vars(sb).copy()) == law
    assert hash(law) == hash(dataclasses.replace(law))
    name = dataclasses.fields(law)[0].name
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(law, name, 1.0)
    numbers = set(vars(law)) - {"derived"}
    assert all(type(getattr(law, one)) is float for one in numbers)


@pytest.mark.parametrize("law", FINITE, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("value", [-1.0, 0.0, math.nan, math.inf])
def test_stiffness_is_positive_and_finite(law, value):
    got = refusal(errors.InvalidValue, dataclasses.replace, law, stiffness=value)
    assert got.startswith("stiffness must be a positive number of N/m")
    got = refusal(errors.UnitError, dataclasses.replace, law, stiffness="1 kg")
    assert got.endswith("got '1 kg'")


NOT_FINITE = math.nan, math.inf
FROM_1 = (0.5, 0.99, 1.1e6, 1e308, *NOT_FINITE), 1e6, "a number from 1 to 1e+06"
NO_LOSS = (-1e-300, *NOT_FINITE), 0.0
BY_SPEED = {
    "restitution": ((0.0, 1.1), 1.0, "a number above 0 and at most 1"),
    "speed": ((0.0, 1e10), 1e9, "a number of m/s from 1e-09 to 1e+09"),
    "speed_exponent": ((-0.1, 4.1), 0.0, "a number from 0 to 4"),
    "scatter": ((-0.1, 1.1), 1.0, "a number from 0 to 1"),
    "seed": ((-1.0, 2.0**32), 0.0, "a number from 0 to 4.29497e+09"),
}
LOSSY = partial(sb.Hysteretic, 1.0)
NUMBERS = [  # a law, one of its fields, values that are wrong, one that is not, and what is right
    (LOSSY, "restitution", (-0.1, 0, 1.1, *NOT_FINITE), 1.0, "a number above 0 and at most 1"),
    (LOSSY, "unloading_exponent", *FROM_1),
    (partial(LOSSY, unloading_exponent=1e6), "exponent", *FROM_1),
    (RIGID[0], "restitution", (-0.1, 1.1, *NOT_FINITE), 0.0, "a number from 0 to 1"),
    (FINITE[2], "exponent", *FROM_1),
    (FINITE[3], "damping", *NO_LOSS, "a number of N s/m, 0 or above"),
    (FINITE[4], "relaxation_strength", *NO_LOSS, "a number, 0 or above"),
    (FINITE[5], "dissipative_time", *NO_LOSS, "a number of seconds, 0 or above"),
    (FINITE[6], "exponent", *FROM_1),
    (FINITE[6], "dissipation", *NO_LOSS, "a number of s/m, 0 or above"),
    *((law, field, *numbers) for law in RIGID[1:] for field, numbers in BY_SPEED.items()),
]


@pytest.mark.parametrize(("law", "field", "wrong", "right", "words"), NUMBERS)
def test_numbers_have_ranges(law, field, wrong, right, words):
    make = law if callable(law) else partial(dataclasses.replace, law)
    for value in wrong:
        got = refusal(errors.InvalidValue, make, **{field: value})
        assert got == f"{field} must be {words}, got {value}"
    refusal(errors.InvalidType, make, **{field: [1.0]})
    assert getattr(make(**{field: right}), field) == right


def test_two_materials():
    a, b = sb.Ball(1.0, 0.1, **STEEL), sb.Ball(1.0, 0.04, **RUBBER)
    modulus = 1.0 / ((1.0 - 0.3**2) / 206e9 + (1.0 - 0.5**2) / 5e6)
    expected = 4.0 / 3.0 * modulus * math.sqrt(1.0 / (1.0 / 0.05 + 1.0 / 0.02))
    assert sb.Hertz.between(a, b).stiffness == pytest.approx(expected, rel=1e-14)
    assert sb.Hertz.between(b, a) == sb.Hertz.between(a, b)


def test_what_a_ball_lacks_is_named():
    ball = sb.Ball(1.0, 0.06, **STEEL)
    for name in ("diameter", "young_modulus", "poisson_ratio"):
        bare = dataclasses.replace(ball, **{name: None})
        got = refusal(errors.InvalidValue, sb.Hertz.between, bare)
        assert got == f"ball_a.{name} must be given for a Hertz contact, got None"
        got = refusal(errors.InvalidValue, sb.Hertz.between, ball, bare)
        assert got == f"ball_b.{name} must be given for a Hertz contact, got None"
    got = refusal(errors.InvalidValue, sb.Hertz.between, sb.Ball(1.0))
    assert got.startswith("ball_a.diameter, ball_a.young_modulus, ball_a.poisson_ratio must be")
    assert refusal(errors.InvalidType, sb.Hertz.between, 3) == "ball_a must be a Ball, got 3"


def test_materials_are_checked():
    got = refusal(errors.InvalidValue, sb.Ball, 1.0, young_modulus=0.0)
    assert got == "young_modulus must be a positive number of pascals, got 0.0"
    for value in (-1.1, 0.51, math.nan):
        got = refusal(errors.InvalidValue, sb.Ball, 1.0, poisson_ratio=value)
        assert got == f"poisson_ratio must be a number from -1 to 0.5, got {value}"
    got = refusal(errors.InvalidValue, sb.Ball, 1.0, poisson_ratio=-1)
    assert got == "poisson_ratio must be above -1, got -1"
    assert sb.Ball(1.0, poisson_ratio=0.5).poisson_ratio == 0.5


def force(law, c, rate):
    """Return the force of a law, compressed by c > 0 at a rate."""
    match law:
        case sb.Dashpot():
            return law.stiffness * c + law.damping * rate
        case sb.Viscoelastic():
            return law.stiffness * (c**1.5 + 1.5 * law.dissipative_time * math.sqrt(c) * rate)
        case sb.HuntCrossley():
            return law.stiffness * c**law.exponent * (1.0 + law.dissipation * rate)
        case _:
            return law.stiffness * c**law.exponent


@st.composite
def partners(draw):
    """Draw two laws of one class whose series is of that class."""
    k1, k2, p = draw(positive), draw(positive), draw(exponents)
    loss = draw(st.just(0.0) | st.floats(1e-290, 10.0))  # smaller ones lose digits in a product
    kind = draw(st.sampled_from(FINITE[:7]))
    match kind:
        case sb.Spring() | sb.Hertz():
            return type(kind)(k1), type(kind)(k2)
        case sb.PowerLaw():
            return sb.PowerLaw(k1, p), sb.PowerLaw(k2, p)
        case sb.Dashpot():
            return sb.Dashpot(k1, k1 * loss), sb.Dashpot(k2, k2 * loss)
        case sb.StandardLinearSolid():  # of which `force` knows the lasting spring
            return tuple(sb.StandardLinearSolid(k, loss, 0.5) for k in (k1, k2))
        case sb.Viscoelastic():
            return sb.Viscoelastic(k1, loss), sb.Viscoelastic(k2, loss)
        case sb.HuntCrossley():
            other = loss * (k2 / k1) ** (1.0 / p)
            return sb.HuntCrossley(k1, p, loss), sb.HuntCrossley(k2, p, other)


@given(partners(), st.floats(0.1, 10.0), st.floats(-1.0, 1.0))
def test_contacts_in_series_have_one_force_and_compressions_that_add_up(laws, c, rate):
    a, b = laws
    both = sb.series(a, b)
    share = 1.0 / (1.0 + (a.stiffness / b.stiffness) ** (1.0 / a.exponent))  # of a
    expected = force(both, c, rate)
    scale = 1e-9 * (abs(expected) + both.stiffness * c**both.exponent)
    assert force(a, share * c, share * rate) == pytest.approx(expected, abs=scale)
    rest = 1.0 - share
    if rest > 1e-3:  # else it has lost its digits
        assert force(b, rest * c, rest * rate) == pytest.approx(expected, abs=scale)


@given(partners())
def test_series_does_not_depend_on_the_order(laws):
    one, other = sb.series(*laws), sb.series(*reversed(laws))
    assert type(one) is type(other)
    assert vars(one) == pytest.approx(vars(other), rel=1e-9)


def test_beside_a_spring_that_is_far_harder_the_soft_one_is_alone():
    assert sb.series(sb.Spring(1e-200), sb.Spring(1e200)).stiffness == 1e-200


def test_hertz_contacts_with_a_rigid_floor_are_not_in_series_as_spheres():
    lower, upper = sb.Ball(1.0, 0.06, **STEEL), sb.Ball(1.0, 0.06, **STEEL)
    alone = sb.Hertz.between(lower)
    both = sb.Hertz.between(lower, upper)
    assert sb.series(alone, alone).stiffness == pytest.approx(both.stiffness, rel=1e-14)
    small = sb.Ball(1.0, 0.01, **STEEL)
    both = sb.series(alone, sb.Hertz.between(small)).stiffness
    assert both != pytest.approx(sb.Hertz.between(lower, small).stiffness, rel=1e-2)


def test_rigid_contacts_and_others_are_not_in_series():
    got = refusal(errors.InvalidValue, sb.series, sb.Spring(1), sb.Rigid(1))
    assert got == "law_b must be a law with a compression, got Rigid(restitution=1.0)"
    got = refusal(errors.InvalidType, sb.series, 3, sb.Rigid(1))
    assert got == "law_a must be a contact law, got 3"


SOLID, DAMPED = sb.StandardLinearSolid, sb.HuntCrossley


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (sb.Spring(1), sb.Hertz(1), "be of one class, got Spring and Hertz: if both are powers"),
        (sb.PowerLaw(1, 2), sb.PowerLaw(1, 3), "have the same exponent, got 2.0 and 3.0: "),
        (sb.Dashpot(1, 1), sb.Dashpot(2, 1), "have the same damping/stiffness, got 1.0 and 0.5"),
        (SOLID(1, 1, 1), SOLID(1, 2, 1), "have the same relaxation_strength, got 1.0 and 2.0"),
        (SOLID(1, 1, 1), SOLID(2, 1, 3), "have the same relaxation_time, got 1.0 and 3.0"),
        (sb.Viscoelastic(1, 1), sb.Viscoelastic(1, 0), "have the same dissipative_time, got 1.0"),
        (DAMPED(1, 1, 1), DAMPED(2, 1, 1), "have the same dissipation/stiffness**(1/exponent)"),
        (
            sb.Hysteretic(1, restitution=0.5),
            sb.Hysteretic(1, restitution=0.6),
            "have the same unloading_exponent, got 7.0 and ",
        ),
    ],
)
def test_contacts_that_make_no_law_in_series(a, b, expected):
    got = refusal(errors.InvalidValue, sb.series, a, b)
    assert got.startswith(f"law_a and law_b must {expected}")
