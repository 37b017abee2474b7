"""Datasets as series: speeds and restitutions from heights and times, and their covariances."""

import numpy as np
import pytest
import xarray as xr

from stackbounce import datasets
from stackbounce.fitting.series.series import make_series, why_not
from stackbounce.model import drag
from stackbounce.model.drop import STANDARD_GRAVITY


def table(**columns):
    rows = {name: ("row", values) for name, values in columns.items()}
    return xr.Dataset(rows, attrs={"name": "made", "title": "made", "ball": "made"})


def test_the_drag_is_corrected_where_mass_and_diameter_are_known():
    """A table tennis ball that keeps 0.8 of its speed: the heights and knocks of its bounces."""
    k, g = drag.sphere_drag(1.2, 0.45, 0.04) / 0.0027, STANDARD_GRAVITY
    speeds = [4.0, drag.landing_speed(k, 0.8 * 4.0, g)]
    falls = [drag.fall_height(k, speed, g) for speed in speeds]
    rises = [drag.risen(k, 0.8 * speed, g) for speed in speeds]
    pairs = zip(speeds, rises, strict=True)
    flights = [drag.rise_time(k, 0.8 * v, g) + drag.fall_time(k, h, g) for v, h in pairs]
    knocks = table(drop_height=falls[:1] * 3, knock_time=np.cumsum([0.0, *flights]))
    for data in (table(drop_height=falls, rebound_height=rises), knocks):
        in_air = data.assign_attrs(mass=0.0027, diameter=0.04)
        series = make_series(in_air)
        assert series.drag == pytest.approx(k)
        assert series.values == pytest.approx([0.8, 0.8], rel=1e-9)
        assert series.speeds == pytest.approx(speeds, rel=1e-9)
        for plain in (make_series(in_air, air=False), make_series(data)):
            assert plain.drag == 0.0
            assert (plain.values < 0.77).all()


@pytest.mark.parametrize("name", ["rubber-ball-bounces", "steel-on-metallic-glass"])
def test_covariances_are_those_of_draws(name):
    data = datasets.load(name)
    series = make_series(data)
    generator = np.random.default_rng(1)
    drawn = []
    for _ in range(500):
        moved = data.copy()
        for key, one in data.items():
            error = one.attrs.get("assumed_error")
            if error:
                moved[key] = one + error * generator.standard_normal(one.shape)
        drawn.append(make_series(moved).values)
    found, wanted = np.cov(np.array(drawn).T), series.covariance()
    scale = np.sqrt(np.outer(wanted.diagonal(), wanted.diagonal()))
    assert np.abs(found - wanted).max() < 0.2 * scale.max()
    assert np.abs((found - wanted) / scale).max() < 0.2
    assert (wanted.diagonal(1) < 0.0).all()  # neighbours share a number


def test_the_scatter_of_throws_is_the_error_of_their_mean():
    """Flights of a ball whose restitution varies and whose knocks are heard late or early."""
    data = datasets.load("golf-marble-flights")
    generator = np.random.default_rng(2)
    found, given = [], []
    for _ in range(400):
        rows = []
        for _ in range(2):
            kept = 0.9 + 0.01 * generator.standard_normal((8, 5))
            flights = 0.8 * np.cumprod(kept, axis=0) + 0.001 * generator.standard_normal((8, 5))
            rows.append(flights)
        moved = data.assign(flight_time=(data.flight_time.dims, np.concatenate(rows)))
        series = make_series(moved, air=False)
        found.append(series.values)
        given.append(series.published)
    assert np.cov(np.array(found).T).diagonal().mean() == pytest.approx(
        np.mean([covariance.diagonal().mean() for covariance in given]), rel=0.1
    )
    assert np.mean([covariance[0, 1] for covariance in given]) == pytest.approx(
        np.cov(np.array(found).T).diagonal(1)[:6].mean(), abs=3e-6
    )


def test_the_knocks_of_the_superball_are_two_restitutions():
    series = make_series(datasets.load("superball-knocks"))
    assert series.values == pytest.approx([0.9356, 0.9364], abs=1e-4)
    assert series.speeds == pytest.approx([3.705, 3.467], abs=1e-3)


def test_the_basketball_loses_as_a_power_of_its_speed_if_the_air_is_left_out():
    series = make_series(datasets.load("leather-basketball"), air=False)
    assert series.values == pytest.approx([0.81, 0.85])
    loss, speed = np.log(1.0 - series.values), np.log(series.speeds)
    assert np.diff(loss) / np.diff(speed) == pytest.approx(0.43, abs=0.005)


def test_errors_have_the_degrees_of_freedom_of_their_scatter():
    """The more of an error is assumed, the less matters how well its scatter is known."""
    heights = make_series(datasets.load("rubber-ball-two-heights"))
    assert heights.freedom(0.0) == pytest.approx(2 * 9)
    assert heights.freedom(0.0) < heights.freedom() < heights.freedom(2.0)
    flights = make_series(datasets.load("golf-marble-flights"), air=False)
    assert 0.9 * 14 * 4 < flights.freedom() < 14 * 4  # neighbouring bounces are correlated
    assert make_series(datasets.load("steel-on-metallic-glass")).freedom() == np.inf


def test_a_drag_that_is_not_known_well_moves_all_values_together():
    series = make_series(datasets.load("table-tennis-bounces"))
    without = make_series(datasets.load("table-tennis-bounces"), air=False)
    assert (series.values > without.values).all()
    assert np.linalg.matrix_rank(series.assumed - without.assumed, tol=1e-7) >= 1
    assert (np.sqrt(series.covariance().diagonal()) > np.sqrt(without.assumed.diagonal())).all()


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("baseball-rule", "it has the limits of rules, no measurement"),
        ("granite-spheres", "it has one value only"),
        ("superball-contact-time", "it has one value only"),  # one mean over five heights
        ("ice-spheres", "it has no restitutions of one ball at known speeds"),
        ("golf-marble-flights", ""),
    ],
)
def test_what_is_no_series_says_why(name, reason):
    assert why_not(datasets.load(name)) == reason
