"""Press curves: what went in comes out, whatever the record looks like."""

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from measure.near import near
from refusals import refusal
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.measure import press, split_series
from stackbounce.measure.statistics.ar_noise import correlation_factor
from stackbounce.plots.measurements.press import draw
from synthetic.press import press_record
from work import calls_of, memory_of

BALL = sb.Hysteretic(4e4, exponent=1.3, restitution=0.78)
STEEP = np.linspace(-0.02, 0.05, 400)
USUAL = {"peak": 5e-3, "slack": 1e-3, "noise": 0.1, "seed": 1}
LOSSY = sb.Hysteretic(1e4, restitution=0.5)


@pytest.mark.parametrize(
    "law", [sb.Spring(1e4), sb.Hertz(5e5), sb.PowerLaw(3e8, 3.0), BALL, LOSSY], ids=repr
)
def test_what_went_in_comes_out(law):
    found = press(press_record(law, **USUAL))
    assert near(found.exponent, law.exponent)
    assert near(found.stiffness, law.stiffness)
    assert near(found.restitution, getattr(law, "restitution", 1.0))
    assert near(found.unloading_exponent, getattr(law, "unloading_exponent", law.exponent))
    assert near(found.peak_compression, 5e-3)
    assert found.loading.fits
    assert found.unloading.fits


def test_without_noise_it_is_exact():
    found = press(press_record(BALL, peak=5e-3, points=2000))
    assert found.exponent.nominal_value == pytest.approx(1.3, rel=1e-6)
    assert found.stiffness.nominal_value == pytest.approx(4e4, rel=1e-5)
    assert found.restitution.nominal_value == pytest.approx(0.78, rel=1e-5)


@pytest.mark.parametrize(("force", "compression"), [(-1, 1), (1, -1), (-1, -1), (1e-9, 1e-6)])
def test_any_sign_and_unit(force, compression):
    data = press_record(BALL, **USUAL)
    own = press(data).exponent
    turned = press((compression * data.compression.values, force * data.force.values))
    assert turned.exponent.nominal_value == pytest.approx(own.nominal_value, rel=1e-6)
    assert turned.exponent.std_dev == pytest.approx(own.std_dev, rel=1e-3)
    assert any("was reversed" in note for note in turned.notes) == (min(force, compression) < 0)


def test_a_shifted_scale_and_a_zero_that_is_off():
    data = press_record(BALL, offset=-3.0, **USUAL)
    found = press((data.compression.values + 0.4, data.force.values))
    assert near(found.contact, 0.4)
    assert near(found.zero, -3.0)
    assert near(found.exponent, 1.3)


def test_a_drift_is_seen_where_there_is_slack_on_both_sides():
    assert near(press(press_record(BALL, drift=5.0, **USUAL)).restitution, 0.78)


def test_loading_only():
    data = press_record(BALL, **USUAL)
    found = press(data.isel(point=slice(0, data.compression.values.argmax() + 1)))
    assert near(found.exponent, 1.3)
    assert found.work_out is found.restitution is found.unloading is found.loss is None
    assert any("no unloading" in note for note in found.notes)
    assert found.parts()["contact"]["law"] == "PowerLaw"
    assert draw(None, found).axes


def test_a_force_that_is_never_zero():
    data = press_record(BALL, peak=5e-3, noise=0.02, points=800, seed=2)
    found = press(data.where(data.compression > 1.5e-3, drop=True))
    assert near(found.exponent, 1.3)
    assert near(found.work_in, 4e4 * 5e-3**2.3 / 2.3)
    assert any("too few points before the contact" in note for note in found.notes)


def test_short_slack_tells_the_zero_and_coarse_compressions_keep_their_peak():
    found = press(press_record(BALL, peak=5e-3, slack=5e-4, noise=0.4, offset=2.0))
    assert near(found.exponent, 1.3)
    assert near(found.zero, 2.0)
    coarse = press_record(BALL, peak=5e-3, points=401)
    found = press(coarse.assign(compression=np.round(coarse.compression, 4)))
    assert near(found.restitution, 0.78)
    assert found.peak_compression.nominal_value == pytest.approx(5e-3, abs=5e-5)


@pytest.mark.parametrize("hold", [60, 0])
def test_a_force_that_relaxes(hold):
    found = press(press_record(BALL, hold=hold, relaxation=0.1, **USUAL))
    assert near(found.relaxed, 0.1 * 4e4 * 5e-3**1.3)
    assert near(found.exponent, 1.3)
    assert near(found.restitution, 0.78 * 0.9**0.5)


def test_rows_and_picture_show_what_was_found():
    data = press_record(BALL, **USUAL)
    found = press(data)
    assert found.rows()[0].unit == "N/m"
    assert {"exponent", "restitution", "energy lost"} <= {row.name for row in found.rows()}
    above, below = draw(data, found).axes
    assert "out" in above.get_legend().get_texts()[1].get_text()
    assert below.get_xlabel() == "compression from contact (mm)"
    assert above.texts[0].get_text() == "39 % of the work lost"  # 1 - 0.78**2


@pytest.mark.slow
def test_several_cycles():
    data = press_record(BALL, cycles=3, **USUAL)
    found = press(data)
    assert found.cycle == "3 of 3"
    assert near(found.restitution, 0.78)
    assert draw(data, found).axes


def test_small_reversals_on_the_way_in():
    turns = [(0, 2, 80), (2, 1.8, 10), (1.8, 5, 120), (5, 0, 200)]
    way = 1e-3 * np.concatenate([np.linspace(*turn) for turn in turns])
    found = press((way, 1e4 * way + np.random.default_rng(3).normal(0.0, 0.1, len(way))))
    assert found.cycle is None
    assert near(found.work_in, 0.125)
    assert near(found.exponent, 1.0)
    assert found.parts()["contact"] == {"law": "Spring", "stiffness": pytest.approx(1e4, rel=0.01)}


def test_an_unloading_that_is_no_power_law_is_told():
    way = 1e-3 * np.concatenate([np.linspace(0, 5, 200), np.linspace(5, 0, 200)])
    force = 1e4 * way
    force[200:] *= np.clip(1.0 - 4e2 * (5e-3 - way[200:]), 0.2, None)
    found = press((way, force + np.random.default_rng(1).normal(0.0, 0.05, 400)))
    assert found.loading.fits
    assert 0.0 < found.loading.misfit < 0.05 / 50.0  # less than the noise of a point
    assert not found.unloading.fits
    assert any("unloading is not well described" in note for note in found.notes)


def test_numbers_that_are_missing():
    data = press_record(BALL, **USUAL)
    data.force.values[::7] = np.nan
    found = press(data)
    assert near(found.exponent, 1.3)
    assert any("without a number" in note for note in found.notes)


def test_a_million_points_take_hardly_more_steps_than_few():
    data = press_record(BALL, points=1_000_000, **USUAL)
    _, few = calls_of(press, press_record(BALL, points=10_000, **USUAL))
    _, many = calls_of(press, data)
    assert many < 1.5 * few
    found, held = memory_of(press, data)
    assert held < 12 * data.force.nbytes
    assert near(found.exponent, 1.3, 5.0)
    assert found.exponent.std_dev < 2e-3


@pytest.mark.parametrize("seed", range(3))
def test_points_weigh_as_their_noise_with_that_of_the_compression_along_the_curve(seed):
    how = {"peak": 5e-3, "slack": 1e-3, "noise": 0.1, "jitter": 2e-5, "seed": seed}
    found = press(press_record(sb.Hertz(5e5), **how))
    assert near(found.exponent, 1.5)
    assert found.exponent.std_dev < 6e-3  # 8e-3, or much more, if all points weigh the same


def test_correlated_noise_has_larger_errors():
    how = USUAL | {"points": 600, "seed": 4}
    quiet, slow = (press(press_record(BALL, **how, **more)) for more in ({}, {"memory": 20}))
    assert slow.linear_stiffness.std_dev > 2.5 * quiet.linear_stiffness.std_dev


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (([0.0, 1.0], [0.0, 1.0]), "at least 6 points"),
        ((np.arange(9.0), np.full(9, np.nan)), "at least 6 points"),
        ((np.arange(9.0), np.ones(9)), "force must change"),
        ((np.ones(9), np.arange(9.0)), "compression must change"),
        ((np.arange(9.0), np.arange(8.0)), "one length"),
        ((np.arange(200.0), np.random.default_rng(1).normal(0, 1, 200)), "rise with the compress"),
        ((np.linspace(5.0, 0.0, 99), np.linspace(9.0, 0.0, 99)), "must have a loading"),
        ((STEEP, np.exp(1e3 * STEEP)), "power law in numbers of a finite size"),
        (None, "data must be"),
        ("file.csv", "data must be"),
        (xr.Dataset({"x": ("point", [1.0])}), "data must be"),
    ],
)
def test_what_is_no_press_curve(data, message):
    assert message in refusal((InvalidType, InvalidValue), press, data)


def test_its_option_is_checked():
    with pytest.raises(InvalidType, match="tabulated"):
        press(press_record(BALL, **USUAL), tabulated=1)


def test_parts_make_a_contact():
    contact = press(press_record(BALL, **USUAL)).parts()["contact"]
    balls = [{"mass": 0.1}]
    drop = sb.Drop.from_mapping({"balls": balls, "contacts": [contact], "impact_speed": 1.0})
    assert isinstance(drop.contacts[0], sb.Hysteretic)
    linear = press(press_record(sb.Hysteretic(1e4, restitution=0.8), **USUAL)).parts()["contact"]
    assert set(linear) == {"law", "stiffness", "restitution"}


def test_numbers_know_their_correlation():
    found = press(press_record(BALL, **USUAL))
    again = found.peak_force / found.peak_compression
    assert (again - found.secant_stiffness).std_dev < 1e-6 * again.std_dev
    at = found.compression_at(0.5 * found.peak_force.nominal_value)
    both = (at.std_dev / at.nominal_value, found.stiffness.std_dev / found.stiffness.nominal_value)
    assert both[0] < 0.3 * both[1]


def test_springs_in_series_have_no_excess():
    k = [3e3, 9e3]
    found = [
        press(press_record(sb.Spring(one), peak=30.0 / one, noise=0.05, seed=i))
        for i, one in enumerate([*k, 2250.0])
    ]
    split = split_series(*(one.compression_at(30.0) for one in found), force=30.0)
    assert near(split.excess, 0.0)
    assert near(split.floor_stiffness, 6e3)  # of the bottom half of the lower ball
    assert near(split.ball_stiffness, 4.5e3)
    assert any("in series" in note for note in split.notes) or abs(split.excess) < 1e-4
    assert split.rows()[0].name.startswith("stiffness ratio")
    assert split.parts()["contact"]["law"] == "Spring"


def test_split_series_is_checked():
    with pytest.raises(InvalidValue, match="upper must be a length"):
        split_series(1e-3, "2 ms", 3e-3, force=1.0)
    with pytest.raises(InvalidValue, match="both must be compressed"):
        split_series(3e-3, 1e-3, 1e-3, force=1.0)


@pytest.mark.parametrize(("repeated", "least", "most"), [(1, 0.99, 1.6), (4, 1.5, 5.0)])
def test_residuals_of_a_short_curve_that_go_together_count_less(repeated, least, most):
    noise = np.random.default_rng(3).normal(0.0, 1.0, 24 // repeated)
    assert least < correlation_factor(np.repeat(noise, repeated), 8) < most
    assert correlation_factor(np.repeat(noise, repeated)) == 1.0
