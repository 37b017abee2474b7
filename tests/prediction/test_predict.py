"""Errors carried from the numbers of a drop to what follows."""

import math
import pickle

import numpy as np
import pytest
from uncertainties import correlated_values, covariance_matrix, ufloat

import stackbounce as sb
from stackbounce.errors import InvalidType, InvalidValue

ONE = sb.Drop([sb.Ball(0.06)], [sb.Spring(2e4)], height=0.63)
RIGID = sb.Drop([sb.Ball(0.06)], [sb.Rigid(0.8)], impact_speed=3.0)
LOSSY = sb.Drop(
    [sb.Ball(0.03), sb.Ball(0.0248)],
    [sb.Hysteretic(5.6e4, restitution=0.78), sb.Spring(1.6e4)],
    gaps=[0.0014],
    height=0.2,
)
CHANGING = {"gaps.0": (0.0014, 3e-4), "balls.0.mass": (0.03, 0.001)}


def test_one_ball_on_a_spring_is_the_closed_form():
    mass, stiffness, height = ufloat(0.06, 0.001), ufloat(2e4, 300.0), ufloat(0.63, 0.01)
    given = {"balls.0.mass": mass, "contacts.0.stiffness": stiffness, "height": height}
    found = sb.predict(ONE, given)
    time, speed = math.pi * (mass / stiffness) ** 0.5, (2 * 9.80665 * height) ** 0.5
    for one, exact in ((found["durations.0"], time), (found["rebound_speeds.0"], speed)):
        assert one.nominal_value == pytest.approx(exact.nominal_value, rel=1e-12)
        assert one.std_dev == pytest.approx(exact.std_dev, rel=1e-4)
        assert abs((one - exact).std_dev) < 1e-3 * exact.std_dev  # they are correlated
    assert found.method == "derivatives"
    assert found.energy_retained.std_dev == 0.0


def test_correlated_numbers_keep_their_covariance():
    matrix = np.array([[4e-6, 5e-3], [5e-3, 9e2 * 100]]) * 0.01
    mass, stiffness = correlated_values([0.06, 2e4], matrix)
    found = sb.predict(ONE, {"balls.0.mass": mass, "contacts.0.stiffness": stiffness})
    exact = math.pi * (mass / stiffness) ** 0.5
    assert found["durations.0"].std_dev == pytest.approx(exact.std_dev, rel=1e-4)
    both = covariance_matrix([found["durations.0"], mass])
    assert both[0][1] == pytest.approx(covariance_matrix([exact, mass])[0][1], rel=1e-4)
    assert float(found.sensitivity.sel(quantity="durations.0").sum()) == pytest.approx(1.0)
    assert "correlated" in found.advice("durations.0")


def test_errors_of_offsets_and_of_the_drop_add_up():
    drop = sb.stack("basketball", "B1", "tennis", height=1.0, gap="1 mm")
    drop = drop.replace(contacts=[sb.Hertz(1e6)] * 3, impact_speed=2.0)
    one, off = {"offsets.1": "10 ± 5 µm"}, ufloat(0.0, 2e-5)
    transfer = sb.simulate(drop).sideways().transfer.values
    found = sb.predict(drop, {**one, "offsets.2": off, "impact_speed": (2.0, 0.02)})
    assert found.method == "derivatives"
    for ball in range(3):
        speed = found.sideways[f"sideways_speed.{ball}"]
        assert speed.nominal_value == pytest.approx(1e-5 * transfer[ball, 1])
        alone = [sb.predict(drop, given) for given in (one, {"offsets.2": off})]
        parts = [each.sideways[f"sideways_speed.{ball}"].std_dev for each in alone]
        assert parts == pytest.approx(np.abs([5e-6, 2e-5] * transfer[ball, 1:]))
        fast, slow = (sb.simulate(drop.replace(impact_speed=v)).sideways() for v in (2.02, 1.98))
        by_speed = 0.5e-5 * float(fast.transfer[ball, 1] - slow.transfer[ball, 1])
        assert speed.std_dev == pytest.approx(math.hypot(*parts, by_speed), rel=1e-3)
        assert speed.error_components()[off] == pytest.approx(parts[1])
    assert found.notes == ()
    assert "first order ends" in sb.predict(drop, {"offsets.2": "0 ± 2 cm"}).notes[0]
    assert "angle.2" in str(found)


def test_offsets_of_draws():
    drop = LOSSY.replace(balls=[sb.Ball(ball.mass, diameter=0.04) for ball in LOSSY.balls])
    found = sb.predict(drop, {**CHANGING, "offsets.1": "0 ± 1 mm"}, draws=200)
    alone = found.result.sideways({1: 1e-3}).landing.values
    assert found.sideways["landing.1"].std_dev == pytest.approx(abs(alone[1]))


def test_changing_counts_are_drawn():
    found = sb.predict(LOSSY, CHANGING)
    assert found.method == "draws"
    assert found.how == "errors by 10000 draws: contact 0 collides 1 or 2 times"
    shares = found.collisions[0]
    assert set(shares) == {1, 2}
    assert sum(shares.values()) == pytest.approx(1.0)
    low, middle, high = found.quantiles("rebound_speeds.1")
    assert low < middle < high


def test_draws_repeat_bit_for_bit_and_follow_the_seed():
    found = [sb.predict(LOSSY, CHANGING, draws=500, rng=seed) for seed in (0, 0, 1)]
    first, second, other = (prediction.draws for prediction in found)
    assert first.identical(second)
    assert not np.array_equal(other.rebound_speeds, first.rebound_speeds)


def test_long_runs_are_drawn_less_often():
    tower = sb.Drop([sb.Ball(0.06)], [sb.Rigid(0.99)], height=1.0, gravity=9.81)
    found = sb.predict(tower, {"height": (1.0, 0.01)}, until=200.0)
    events = len(found.result.events)
    assert events > 120
    assert found.draws.sizes["draw"] == 1_000_000 // events
    short = sb.predict(tower, {"height": (1.0, 0.01)}, until=6.0, draws=200)
    assert short.draws.sizes["draw"] == 200


def test_an_error_that_comes_from_few_draws_is_said_to_be_rough():
    (note,) = sb.predict(LOSSY, CHANGING, draws=200).notes
    assert note.startswith("the error of rebound_ratios.0, rebound_ratios.1, rebound_speeds.0 and")


def test_draws_are_drops_of_their_own():
    draws = sb.predict(LOSSY, CHANGING, draws=300).draws
    ds = sb.sweep(LOSSY, {path: draws[path.replace(".", "_")] for path in CHANGING})
    assert np.array_equal(ds.rebound_ratio, draws.rebound_ratios)
    assert np.array_equal(ds.last_release, draws.last_release)


def test_impossible_numbers_are_left_out_and_named():
    found = sb.predict(LOSSY, {"gaps.0": (0.0, 1e-4)})
    assert float(found.draws.gaps_0.min()) >= 0.0
    assert "gaps.0 must be a number of metres, 0 or above" in found.how
    (note,) = found.notes  # the energy retained has its maximum at a small gap
    assert note.startswith("the error of energy_retained is known")
    half = 1e-4 * math.sqrt(1.0 - 2.0 / math.pi)  # of half a normal distribution
    assert float(found.draws.gaps_0.std()) == pytest.approx(half, rel=0.03)


def test_round_off_has_no_error():
    row = sb.Drop([sb.Ball(0.1)] * 2, [None, sb.Spring(1e4)], velocities=[1.0, 0.0])
    found = sb.predict(row, {"velocities.0": (1.0, 0.01)})
    assert found.method == "derivatives"
    assert found["rebound_speeds.0"].std_dev == 0.0
    assert found["rebound_speeds.1"].std_dev == pytest.approx(0.01, rel=1e-6)
    assert math.isnan(found["first_touch.0"].nominal_value)


def test_the_advice_names_the_number_that_makes_most():
    errors = {"contacts.0.restitution": (0.8, 0.001), "impact_speed": (3.0, 0.03)}
    assert sb.predict(RIGID, errors).advice() == (
        "measure impact_speed better: it makes 98 % of the variance of rebound_speeds.0"
    )
    assert sb.predict(RIGID, {"impact_speed": (3.0, 0.03)}).advice() == ""


def test_given_draws_are_used_as_they_are():
    restitution = np.random.default_rng(3).uniform(0.7, 0.9, 500)
    speed = 3.0 / restitution
    found = sb.predict(RIGID, {"contacts.0.restitution": restitution, "impact_speed": speed})
    assert found.how == "errors by 500 draws: draws were given"
    assert np.allclose(found.draws.rebound_speeds, 3.0)
    assert found["rebound_speeds.0"].std_dev == 0.0
    assert found["rebound_ratios.0"].std_dev == pytest.approx(restitution.std())
    mixed = sb.predict(RIGID, {"contacts.0.restitution": restitution, "impact_speed": (3.0, 0.1)})
    assert mixed.draws.sizes["draw"] == 500
    assert mixed.draws.impact_speed.std() > 0.05


def test_apexes_and_forces_have_errors():
    drop = sb.Drop([sb.Ball(0.06)], [sb.Rigid(0.8)], height=1.0, gravity=9.81)
    found = sb.predict(drop, {"height": (1.0, 0.01)}, until=1.2)
    first = found.apexes[0]
    assert first.height.nominal_value == pytest.approx(0.64)
    assert first.height.std_dev == pytest.approx(0.0064, rel=1e-3)
    found = sb.predict(ONE, {"height": (0.63, 0.01)})
    peak = found.carry(lambda result: {"force": result.intervals["peak_force"].max()})["force"]
    exact = (2 * 9.80665 * ufloat(0.63, 0.01) * 0.06 * 2e4) ** 0.5
    assert (peak.nominal_value, peak.std_dev) == pytest.approx((exact.n, exact.s), rel=1e-3)


def test_a_prediction_as_a_table_and_as_values():
    found = sb.predict(RIGID, {"impact_speed": (3.0, 0.03)})
    assert "rebound_speeds.0 2.400 ± 0.024 m/s" in " ".join(repr(found).split())
    assert found.as_dict()["values"]["rebound_speeds.0"]["error"] == pytest.approx(0.024)
    assert pickle.loads(pickle.dumps(found))["rebound_speeds.0"].std_dev == pytest.approx(0.024)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("errors", [{"height": (0.2, 0.002)}, {"gaps.0": (1e-4, 1e-4)}])
def test_a_band_encloses_the_curve(errors):
    found = sb.predict(LOSSY, errors)
    times = np.linspace(1e-4, 5e-3, 20)
    low, high = found.band(times, "velocity")
    middle = found.result.sample(times).velocity.values
    assert low.shape == (2, 20)
    assert np.all(low <= high)
    assert np.mean((low <= middle + 1e-9) & (middle - 1e-9 <= high)) > 0.9


def test_an_error_of_zero_is_no_error():
    found = sb.predict(RIGID, {"impact_speed": (3.0, 0.03), "contacts.0.restitution": (0.8, 0.0)})
    assert found["rebound_speeds.0"].std_dev == pytest.approx(0.024)
    assert list(found.sensitivity.number) == ["impact_speed", "contacts.0.restitution"]


def test_numbers_in_many_forms_replace_the_drops_own():
    for form in ("1.00 m ± 1 cm", (1.0, 0.01), ("100 cm", "10 mm"), ufloat(1.0, 0.01)):
        found = sb.predict(ONE, {"height": form})
        assert str(found["rebound_speeds.0"]) == "4.429+/-0.022"
        assert found.drop.height == 1.0
        assert found.result.rebound_speeds[0] == pytest.approx(found.rebound_speeds[0].n)


def test_drops_that_do_not_finish_are_counted():
    (note,) = sb.predict(LOSSY, {"height": (0.2, 0.001)}, event_limit=1).notes
    assert note == "10000 of 10000 drops did not finish and were left out"


UNEQUAL = {"impact_speed": np.ones(500), "contacts.0.restitution": np.ones(400)}


@pytest.mark.parametrize(
    ("errors", "message"),
    [
        ([1], "errors must map paths to numbers with errors"),
        ({"mass": (1.0, 0.1)}, "mass is not a parameter of this drop"),
        ({"impact_speed": 3.0}, "impact_speed must be a number with an error"),
        ({"impact_speed": "3 ± 1 kg"}, "impact_speed must be a speed"),
        ({"impact_speed": (3.0, -0.1)}, "impact_speed's error must be 0 or above, got -0.1"),
        ({"impact_speed": (3.0, 1e308)}, "impact_speed's error must be at most 1e+100, got 1e+308"),
        ({"impact_speed": np.linspace(1.0, 1e308, 200)}, "impact_speed's error must be at most"),
        ({"impact_speed": (3.0, 0.0)}, "errors must have a number with an error above 0"),
        ({"impact_speed": (-3.0, 0.1)}, "impact_speed must be a positive number"),
        ({"impact_speed": np.ones(5)}, "an array of 100 draws or more"),
        ({"impact_speed": np.full(500, math.nan)}, "impact_speed must have finite draws"),
        (UNEQUAL, "errors must have as many draws of each number, got 400 and 500"),
    ],
)
def test_bad_input_is_one_clear_error(errors, message):
    with pytest.raises((InvalidValue, InvalidType)) as caught:
        sb.predict(RIGID, errors)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_curves_and_names_that_are_not_predicted_are_refused():
    found = sb.predict(RIGID, {"impact_speed": (3.0, 0.03)})
    with pytest.raises(InvalidValue, match="'speed' is not a curve; known: position, velocity"):
        found.band([0.0], "speed")
    for ask in (found.__getitem__, found.quantiles, found.advice):
        with pytest.raises(InvalidValue, match=r"is not predicted; did you mean rebound_speeds\.0"):
            ask("rebound_speed.0")


def test_a_seed_has_32_bits():
    with pytest.raises(sb.StackbounceError, match="the seed must be"):
        sb.predict(RIGID, {"impact_speed": (3.0, 0.03)}, rng=2**32)
    assert sb.predict(RIGID, {"impact_speed": (3.0, 0.03)}, rng=2**32 - 1)["rebound_speeds.0"]


def test_a_generator_gives_other_draws_each_time_and_its_own_seed_the_same():
    errors, rng = {"impact_speed": (3.0, 0.03)}, np.random.default_rng(5)
    one, other, again, third = (
        sb.predict(RIGID, errors, draws=100, rng=source).draws
        for source in (rng, rng, np.random.default_rng(5), np.random.SeedSequence(5))
    )
    assert not one.equals(other)
    assert one.equals(again)
    assert one.equals(third)
    for wrong in ("a", 1.5, [-1]):
        with pytest.raises(sb.StackbounceError, match="rng must be a whole number or a Generator"):
            sb.predict(RIGID, errors, rng=wrong)
