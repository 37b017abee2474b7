"""From laws to restitution and contact time and back, and separate collisions."""

import dataclasses
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import acos, exp, lambertw, mp, mpf, sqrt

import stackbounce as sb
from refusals import refusal
from stackbounce import errors
from stackbounce.model.laws import dashpot, hunt_crossley
from stackbounce.model.laws.series import between

MEASURED = {"mass": 0.0567, "contact_time": 5e-3, "restitution": 0.75, "impact_speed": 3.0}
ELASTIC = [sb.Spring, sb.Hertz, sb.PowerLaw]

masses = st.floats(1e-6, 1e6)
times = st.floats(1e-6, 10.0)
speeds = st.floats(1e-3, 1e3)
restitutions = st.floats(0.01, 1.0)
exponents = st.floats(1.0, 6.0)


@pytest.mark.parametrize(
    "law",
    [
        sb.Spring(3.0),
        sb.Hertz(3.0),
        sb.PowerLaw(3.0, 2.2),
        *(sb.Dashpot(3.0, damping) for damping in (0.8, 4.9, 40.0)),
        sb.StandardLinearSolid(3.0, 0.5, 0.3),
        sb.Viscoelastic(3.0, 0.2),
        *(sb.HuntCrossley(3.0, p, loss) for p in (1.0, 1.5, 4.0) for loss in (0.01, 0.3, 12.0)),
        *(sb.Hysteretic(3.0, exponent=p, unloading_exponent=7.0) for p in (1.0, 1.5, 7.0)),
        sb.HollowBall(3.0, 0.1, 0.3, 0.5),
    ],
    ids=repr,
)
def test_one_collision_is_that_of_a_run(law):
    result = sb.simulate(sb.Drop([sb.Ball(2.0)], [law], impact_speed=1.7))
    assert sb.contact_time(law, 2.0, 1.7) == pytest.approx(result.last_release[0], rel=1e-9)
    assert sb.restitution(law, 2.0, 1.7) == pytest.approx(result.rebound_ratios[0], rel=1e-9)


def test_dashpots_lose_no_digits_at_any_damping():
    ratios = [10.0**i for i in range(-20, 21)]
    ratios += [1.0 + s * 10.0**-i for i in range(1, 16) for s in (-1, 1)] + [1.0, 1.999, 2.0, 2.001]
    with mp.workdps(60):
        for zeta in ratios:
            z = mpf(zeta)
            time = mpf(2) if zeta == 1.0 else (2 * acos(z) / sqrt(1 - z * z)).real
            assert dashpot.duration(zeta) == pytest.approx(float(time), rel=1e-14)
            expected = float(exp(-z * time))
            assert dashpot.restitution(zeta) == pytest.approx(expected, rel=1e-13)


def test_hunt_crossley_loses_no_digits_at_any_dissipation():
    with mp.workdps(60):
        for d in [10.0**i for i in range(-8, 3)] + [0.3, 0.49, 0.51, 0.7, 1.5, 7.0]:
            y = 1 + mpf(d)
            # 1 - d e is the other solution w of w exp(-w) = y exp(-y)
            expected = float((1 + lambertw(-y * exp(-y)).real) / d)
            assert hunt_crossley.restitution(d) == pytest.approx(expected, rel=1e-15)


def test_hunt_crossley_with_tiny_and_huge_dissipation():
    for d in (0.0, 1e-300, 1e-17):
        assert hunt_crossley.restitution(d) == 1.0
        for p in (1.0, 1.5, 40.0):
            law, twin = sb.HuntCrossley(1.0, p, d), sb.PowerLaw(1.0, p)
            lasts = sb.contact_time(twin, 1.0, 1.0)
            assert sb.contact_time(law, 1.0, 1.0) == pytest.approx(lasts, rel=1e-14)
    assert hunt_crossley.restitution(1e-6) == pytest.approx(1.0 - 2e-6 / 3.0, abs=1e-12)
    for d in (1e3, 1e30, 1e299):
        assert hunt_crossley.restitution(d) == pytest.approx(1.0 / d, rel=1e-15)
    # soon as slow as 1/χ, it comes up from C sqrt(2/d), with p = 1, in that times d
    lasts = sb.contact_time(sb.HuntCrossley(1.0, 1.0, 1e3), 1.0, 1.0)
    assert lasts == pytest.approx(math.sqrt(2e3), rel=10.0 / 1e3**0.5)


def test_a_very_steep_contact():
    """It is a wall at compression 1, reached and left at speed 1."""
    assert sb.contact_time(sb.PowerLaw(1.0, 1e6), 1.0, 1.0) == pytest.approx(2.0, rel=1e-4)


@pytest.mark.parametrize("law", [sb.Dashpot(1.0, 0.0), sb.Viscoelastic(1.0, 0.0)])
def test_without_dissipation_laws_are_elastic(law):
    twin = sb.PowerLaw(1.0, law.exponent)
    assert sb.restitution(law, 1.0, 1.0) == 1.0
    assert sb.contact_time(law, 1.0, 1.0) == pytest.approx(
        sb.contact_time(twin, 1.0, 1.0), rel=1e-14
    )


def asked(kind, mass, time, e, speed, p):
    given = {"mass": mass, "contact_time": time, "restitution": e, "impact_speed": speed}
    if kind in (sb.PowerLaw, sb.HuntCrossley, sb.Hysteretic):
        given["exponent"] = p
    return given


@given(
    st.sampled_from([*ELASTIC, sb.Dashpot, sb.HuntCrossley, sb.Hysteretic]),
    masses, times, restitutions, speeds, exponents,
)  # fmt: skip
def test_laws_come_out_as_asked(kind, mass, time, e, speed, p):
    e = e if kind.loss else 1.0
    law = sb.calibrate(kind, **asked(kind, mass, time, e, speed, p))
    assert type(law) is kind
    assert sb.restitution(law, mass, speed) == pytest.approx(e, abs=1e-13)
    assert sb.contact_time(law, mass, speed) == pytest.approx(time, rel=1e-12)


def by_runs(kind):
    """Return a law's class without its formulas: runs give restitution, time and calibration."""
    usual = sb.model.laws.ContactLaw
    measured = {name: getattr(usual, name) for name in ("restitution_at", "duration_at")}
    calibrated = classmethod(usual.calibrated.__func__)
    return type(kind.__name__, (kind,), measured | {"calibrated": calibrated})


@pytest.mark.parametrize("kind", [*ELASTIC, sb.Dashpot, sb.Viscoelastic, sb.HuntCrossley])
@pytest.mark.parametrize("e", [1.0, 0.99, 0.75, 0.3, 0.05])
@pytest.mark.parametrize(("mass", "time"), [(0.0567, 5e-3), (2e-3, 1e-4), (5.0, 0.1)])
def test_a_law_is_found_by_runs_alone(kind, e, mass, time):
    given_ = asked(kind, mass, time, e, 3.0, 1.3)
    if not kind.loss:
        del given_["restitution"]
    exact = sb.calibrate(kind, **given_)
    law = by_runs(kind).calibrated({"exponent": kind.default_exponent()} | given_)
    assert vars(law) == pytest.approx(vars(exact), rel=1e-9, abs=1e-15)


def test_a_law_that_is_found_by_runs_keeps_its_other_numbers():
    given_ = MEASURED | {"exponent": 1.0}
    law = by_runs(sb.StandardLinearSolid).calibrated(given_ | {"relaxation_time": 1e-3})
    assert law.relaxation_time == 1e-3
    assert sb.restitution(law, 0.0567, 3.0) == pytest.approx(0.75, rel=1e-9)
    assert sb.contact_time(law, 0.0567, 3.0) == pytest.approx(5e-3, rel=1e-9)
    with pytest.raises(ArithmeticError):  # however strong the relaxation is
        by_runs(sb.StandardLinearSolid).calibrated(given_ | {"relaxation_time": 1.0})
    with pytest.raises(sb.StackbounceError, match=r"a relaxation_time of 2e\+02 contact times"):
        sb.calibrate(sb.StandardLinearSolid, **given_, relaxation_time=1.0)


def test_what_is_not_needed_is_passed_over_and_exponents_have_defaults():
    assert sb.calibrate(sb.Rigid, **MEASURED) == sb.Rigid(0.75)
    assert sb.calibrate(sb.Rigid, restitution=0) == sb.Rigid(0.0)
    given_ = MEASURED | {"restitution": 1}
    plain = sb.calibrate(sb.Spring, mass=0.0567, contact_time=5e-3, exponent=1)
    assert sb.calibrate(sb.Spring, **given_).stiffness == pytest.approx(plain.stiffness, rel=1e-14)
    plain = sb.calibrate(sb.Dashpot, mass=0.0567, contact_time=5e-3, restitution=0.75)
    assert vars(sb.calibrate(sb.Dashpot, **MEASURED)) == pytest.approx(vars(plain), rel=1e-14)
    assert sb.calibrate(sb.PowerLaw, **given_, exponent=1).stiffness == pytest.approx(
        0.0567 * (math.pi / 5e-3) ** 2, rel=1e-15
    )
    assert sb.calibrate(sb.HuntCrossley, **MEASURED).exponent == 1.5
    assert sb.calibrate(sb.Hysteretic, **MEASURED).exponent == 1.0
    given_ = {"mass": 1.0, "contact_time": 1.0, "exponent": 1}
    assert sb.calibrate(sb.PowerLaw, **given_).exponent == 1.0


def test_two_masses_are_reduced():
    given_ = MEASURED | {"mass": (0.150, 0.057)}
    law = sb.calibrate(sb.Dashpot, **given_)
    assert law == sb.calibrate(sb.Dashpot, **(given_ | {"mass": np.array([0.057, 0.150])}))
    one = 0.150 * 0.057 / 0.207
    assert sb.restitution(law, (0.150, 0.057)) == pytest.approx(sb.restitution(law, one), rel=1e-15)
    assert sb.contact_time(law, one) == pytest.approx(5e-3, rel=1e-14)
    law = sb.Spring(1.0)
    assert sb.contact_time(law, (1e300, 1e12)) == pytest.approx(math.pi * 1e6, rel=1e-15)


REFUSED = tomllib.loads(Path(__file__).with_name("refused.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("law", "given", "said"),
    [*REFUSED["alone"], *((law, MEASURED | more, said) for law, more, said in REFUSED["measured"])],
)
def test_what_is_no_measurement_of_a_law(law, given, said):
    assert refusal(errors.InvalidValue, sb.calibrate, getattr(sb, law), **given) == said


@pytest.mark.parametrize("kind", [sb.HollowBall, sb.StandardLinearSolid])
def test_some_laws_have_a_least_restitution(kind):
    least = kind.least_restitution
    given_ = MEASURED | {"restitution": 0.999 * least}
    got = refusal(errors.InvalidValue, sb.calibrate, kind, **given_)
    assert got.startswith(f"restitution must be at least {least:.3g} for a {kind.__name__}, got ")
    law = sb.calibrate(kind, **MEASURED | {"restitution": least})
    assert sb.restitution(law, 0.0567, 3.0) == pytest.approx(least, rel=1e-6)
    with pytest.raises((errors.InvalidValue, ArithmeticError)):
        kind.calibrated(given_ | {"restitution": 0.3 * least, "exponent": 1.0})


def test_a_hollow_ball_has_a_least_restitution_for_the_time_at_which_it_shall_buckle():
    measured = {"mass": 0.1, "contact_time": 1e-2, "impact_speed": 1.0, "buckling_time": 6e-4}
    with pytest.raises(errors.InvalidValue, match="buckling_time must be below") as caught:
        sb.calibrate(sb.HollowBall, restitution=0.05, **measured)
    least = float(str(caught.value).rpartition(", for which restitution must be at least ")[2])
    sb.calibrate(sb.HollowBall, restitution=least, **measured)
    with pytest.raises(errors.InvalidValue):
        sb.calibrate(sb.HollowBall, restitution=0.99 * least, **measured)
    early = sb.calibrate(sb.HollowBall, restitution=1e-3, **measured | {"buckling_time": 4e-6})
    assert sb.contact_time(early, 0.1, 1.0) == pytest.approx(1e-2, rel=1e-9)
    with pytest.raises(errors.InvalidValue) as caught:  # no restitution at all
        sb.calibrate(sb.HollowBall, restitution=0.9, **measured | {"buckling_time": 3e-3})
    assert str(caught.value).endswith("a restitution of 0.9, got 0.3 times")


@pytest.mark.parametrize("value", [{"a": 1.0, "b": 2.0}, ([1.0], 2.0), True, np.array(1.0)])
def test_a_mass_is_a_number_or_two(value):
    got = refusal(errors.InvalidType, sb.calibrate, sb.Dashpot, **(MEASURED | {"mass": value}))
    assert re.match(r"mass(\.0)? must be a positive number of kilograms, got ", got)


@pytest.mark.parametrize("kind", [sb.Spring(1.0), "Spring", int, None])
def test_a_class_is_calibrated(kind):
    got = refusal(errors.InvalidType, sb.calibrate, kind, **MEASURED)
    assert got.startswith("law_class must be the class of a contact law (Rigid, RigidBySpeed, ")


@pytest.mark.parametrize("decay_time", [None, 0.02, 3e-4])
@pytest.mark.parametrize("mass", [0.057, (0.3, 0.057)])
def test_a_bond_vibrates_as_measured(mass, decay_time):
    bond = sb.calibrate(sb.Bond, mass=mass, frequency=800.0, decay_time=decay_time)
    parts = [mass] if isinstance(mass, float) else mass
    inertia = 1.0 / sum(1.0 / part for part in parts)
    roots = np.roots([inertia, bond.damping, bond.stiffness])
    assert np.abs(roots.imag) == pytest.approx([2.0 * np.pi * 800.0] * 2, rel=1e-12)
    assert -roots.real == pytest.approx([0.0 if decay_time is None else 1.0 / decay_time] * 2)


@pytest.mark.parametrize(
    ("law", "missing", "timed"),
    [
        (sb.Dashpot(1, 1), "mass", "mass"),
        (sb.Viscoelastic(1, 1), "mass and impact_speed", "mass and impact_speed"),
        (sb.HuntCrossley(1, 1, 1), "impact_speed", "mass and impact_speed"),
        (sb.Hysteretic(1, restitution=0.5), None, "mass"),
        (sb.Hysteretic(1, exponent=2, restitution=0.5), None, "mass and impact_speed"),
        (sb.Hertz(1), None, "mass and impact_speed"),
        (sb.Spring(1), None, "mass"),
        (sb.Rigid(0.5), None, None),
    ],
)
def test_mass_and_speed_are_asked_for_where_they_count(law, missing, timed):
    name = type(law).__name__
    if missing is None:
        assert 0.0 <= sb.restitution(law) <= 1.0
    else:
        got = refusal(errors.InvalidValue, sb.restitution, law)
        right = f"must be given, as the restitution of {name} depends on it, got None"
        assert got == f"{missing} {right}"
    if timed is None:
        assert sb.contact_time(law) == 0.0
    else:
        got = refusal(errors.InvalidValue, sb.contact_time, law)
        right = f"must be given, as the contact time of {name} depends on it, got None"
        assert got == f"{timed} {right}"


def test_measures_of_something_else():
    for measure in (sb.restitution, sb.contact_time):
        assert refusal(errors.InvalidType, measure, 0.78) == "law must be a contact law, got 0.78"
        got = refusal(errors.InvalidValue, measure, sb.Spring(1.0), 1.0, -1.0)
        assert got == "impact_speed must be a positive number of m/s, got -1.0"
        got = refusal(errors.InvalidValue, measure, sb.Spring(1.0), -1.0)
        assert got == "mass must be a positive number of kilograms, got -1.0"


@pytest.mark.parametrize("law", [sb.HuntCrossley(1, 1, 1e308), sb.Dashpot(1e-300, 1e300)])
def test_what_no_number_can_hold_is_refused(law):
    got = refusal(errors.InvalidValue, sb.restitution, law, 1e-300, 1e300)
    expected = "law, mass and impact_speed must give a restitution in the range of numbers, got "
    assert got.startswith(expected)


def test_separate_collisions_at_the_speeds_from_the_bottom_up():
    balls = [sb.Ball(0.6), sb.Ball(0.058), sb.Ball(0.01)]
    laws = [sb.Dashpot(2500.0, 7.0), sb.HuntCrossley(1e5, 1.5, 0.1), sb.HuntCrossley(1e5, 1.5, 0.2)]
    drop = sb.Drop(balls, laws, impact_speed=2.0)
    e0 = sb.restitution(laws[0], 0.6)
    v0 = 2.0 * e0
    e1 = sb.restitution(laws[1], impact_speed=v0 + 2.0)
    v1 = (0.6 * v0 - 0.058 * 2.0 + 0.6 * e1 * (v0 + 2.0)) / 0.658  # Newton's rule
    e2 = sb.restitution(laws[2], impact_speed=v1 + 2.0)
    got = [law.restitution for law in sb.separate(drop).contacts]
    assert got == pytest.approx([e0, e1, e2], rel=1e-14)
    v_out = sb.simulate(
        sb.separate(dataclasses.replace(drop, balls=balls[:2], contacts=laws[:2], gaps=None))
    )
    assert v_out.rebound_speeds[1] == pytest.approx(v1, rel=1e-12)


def test_a_pair_of_separate_collisions_has_its_reduced_mass():
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(0.1)], [None, sb.Dashpot(100.0, 1.0)], impact_speed=1.0)
    drop = dataclasses.replace(drop, impact_speed=None, velocities=[1.0, 0.0])
    floor, balls = sb.separate(drop).contacts
    assert floor is None
    assert balls.restitution == sb.restitution(sb.Dashpot(100.0, 1.0), (1.0, 0.1))


def test_a_contact_that_does_not_close_has_the_reference_speed():
    law = sb.HuntCrossley(1.0, 1.5, 0.1)
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], [law, law], velocities=[0.5, 3.0])
    expected = sb.restitution(law, impact_speed=3.0)
    assert [one.restitution for one in sb.separate(drop).contacts] == [expected, expected]


@pytest.mark.parametrize("loss", [1e-3, 1e-5, 1e-6, 1e-10, 1e-15])
def test_a_viscoelastic_contact_that_hardly_loses(loss):
    """1 - e = 1.15348 v*² - ..., however small it is."""
    e = 1.0 - loss
    asked = {"mass": 0.1, "contact_time": 1e-3, "impact_speed": 1.0}
    law = sb.calibrate(sb.Viscoelastic, restitution=e, **asked)
    assert sb.restitution(law, mass=0.1, impact_speed=1.0) == pytest.approx(e, abs=1e-12)
    squared = 1.5 * law.dissipative_time * (law.stiffness / 0.1) ** 0.4
    assert squared == pytest.approx((1.0 - e) / 1.15348, rel=2e-3 if loss > 1e-4 else 1e-4)
    run = sb.simulate(sb.Drop([sb.Ball(0.1)], [law], impact_speed=1.0))
    assert run.rebound_ratios == pytest.approx([e], abs=1e-11)


@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_two_lossy_balls_keep_the_energy_of_both(exponent):
    one = sb.Hysteretic(3e4, exponent=exponent, restitution=0.9)
    other = sb.Hysteretic(1e4, exponent=exponent, restitution=0.6)
    both = between(one, other)
    soft = np.array([one.stiffness, other.stiffness]) ** (-1.0 / exponent)  # as work at one force
    assert both.stiffness ** (-1.0 / exponent) == pytest.approx(soft.sum(), rel=1e-14)
    assert both.restitution**2 == pytest.approx(np.average([0.81, 0.36], weights=soft), rel=1e-14)


def test_two_balls_on_exact_laws_are_in_series():
    assert between(sb.Spring(3.0), sb.Spring(6.0)) == sb.Spring(2.0)
    lossless = between(sb.Spring(3.0), sb.Hysteretic(6.0, restitution=1.0))
    assert (lossless.stiffness, lossless.restitution) == pytest.approx((2.0, 1.0))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (sb.Rigid(0.5), sb.Rigid(0.5)),
        (sb.Spring(1.0), sb.Hertz(1.0)),
        (sb.Spring(1.0), sb.Dashpot(1.0, 0.1)),
        (sb.Hysteretic(1.0, restitution=0.5), sb.Rigid(0.5)),
        (sb.Hysteretic(1, restitution=0.5), sb.Hysteretic(1, exponent=1.5, restitution=0.5)),
    ],
)
def test_two_balls_that_are_no_law_together(one, other):
    with pytest.raises(sb.StackbounceError, match="law_"):
        between(one, other)
