"""The published measurements: every file is valid, has its source, and says what it says."""

import json
import re
from importlib.resources import files

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import datasets
from stackbounce.cli import main
from stackbounce.datasets.loading import si_unit
from stackbounce.units import in_si

NAMES = datasets.names()


def test_each_file_is_a_dataset_and_they_have_many_sources():
    folder = files("stackbounce.datasets").joinpath("tables")
    found = {one.name.removesuffix(".toml") for one in folder.iterdir()}
    assert found == set(NAMES)
    assert len({datasets.describe(name).source for name in NAMES}) >= 15


@pytest.mark.parametrize("name", NAMES)
def test_every_dataset_loads_in_si_units_with_its_source(name):
    about, data = datasets.describe(name), sb.datasets.load(name)
    assert re.match(r"https?://", about.address)
    assert re.fullmatch(r"(10\.\d{4,9}/\S+)?", about.doi)
    for column in about.columns:
        variable = data[column.name]
        assert variable.sizes["row"] == len(column.values)
        if column.unit != "text":
            assert np.isfinite(variable).all()
            assert variable.attrs["units"] == si_unit(column)
            assert si_unit(column) == "1" or in_si(si_unit(column)) or si_unit(column) == "K"
    assert data.attrs["source"] == about.source


@pytest.mark.parametrize("name", NAMES)
def test_what_cannot_be_is_not_there(name):
    data = datasets.load(name)
    for key in ("restitution", "energy_retained"):
        if key in data:
            assert ((data[key] > 0.0) & (data[key] < 1.0)).all()
    if {"drop_height", "rebound_height"} <= set(data):
        heights = [data[key] for key in ("drop_height", "rebound_height")]
        fallen, leapt = (one.mean(dim=one.dims[1:]) if one.ndim > 1 else one for one in heights)
        assert (leapt < fallen).all()
    if "apex_height" in data:
        assert (data.apex_height.diff("row") < 0.0).all()


NINE = [0.158, 0.215, 0.256, 0.309, 0.341, 0.407, 0.479, 0.571, 0.643]


@pytest.mark.parametrize(
    ("name", "means"),
    [
        ("rubber-ball-two-heights", [0.759, 1.384]),
        ("table-tennis-two-heights", [0.674, 1.247]),
        ("table-tennis-nine-heights", NINE),
        ("table-tennis-parquet-heights", [0.0451, 0.0679, 0.0742, 0.0885, 0.1578, 0.2496]),
        ("golf-marble-heights", [0.6383, 0.7198, 0.7902, 0.8677]),
    ],
)
def test_readings_have_the_means_that_the_sources_print(name, means):
    found = datasets.load(name).rebound_height.mean("rebound_height_reading")
    assert found.values == pytest.approx(means, abs=6e-5)


def test_flights_have_the_means_that_the_source_prints():
    flights = datasets.load("tennis-stoneware-flights")
    found = flights.flight_time.mean("flight_time_reading").values
    assert found[4:7] == pytest.approx([0.5007, 0.3805, 0.2894], abs=1e-4)
    assert (flights.drop_height[4], flights.flight[4]) == (0.55, 1)


def test_the_restitutions_that_reports_print_follow_from_their_heights():
    rubber = datasets.load("rubber-ball-bounces").apex_height.values
    found = np.sqrt(rubber[1:] / rubber[:-1])
    assert found == pytest.approx([0.76, 0.77, 0.81, 0.81, 0.81, 0.82], abs=0.0062)


def test_units_of_the_sources_are_converted():
    rule = datasets.load("tennis-ball-rule")
    assert rule.drop_height.values == pytest.approx(2.54)
    assert rule.rebound_height.values == pytest.approx([1.3462, 1.4732])
    assert rule.forward_deformation.values == pytest.approx([5.588e-3, 7.366e-3])
    assert rule.return_deformation.values == pytest.approx([8.001e-3, 10.795e-3])
    assert rule.force.values == pytest.approx(80.068, abs=1e-3)
    assert datasets.load("table-tennis-temperature").temperature.values[0] == 305.15
    assert datasets.load("superball-contact-time").contact_time_error.values[0] == 1e-3
    assert datasets.load("baseball-rule").impact_speed.values[0] == pytest.approx(25.908)


@pytest.mark.parametrize("name", NAMES)
def test_a_dataset_and_its_columns_say_all_of_themselves_that_they_have_to(name):
    about = datasets.describe(name)
    texts = [value for value in vars(about).values() if isinstance(value, str)]
    assert all(text == text.strip() for text in texts)
    assert all((about.title, about.measured, about.ball, about.source))
    assert about.seen in ("full text", "excerpt", "abstract", "quoted")
    assert about.kind in ("measured", "rule")
    assert (about.seen == "quoted") == bool(about.quoted_by)
    assert len({column.name for column in about.columns}) == len(about.columns)
    assert len({len(column.values) for column in about.columns}) == 1
    for column in about.columns:
        assert all((column.name, column.meaning)), column
        words = [isinstance(value, str) and bool(value) for value in column.values]
        assert set(words) == {column.unit == "text"}, column
        assert len({isinstance(value, tuple) and len(value) for value in column.values}) == 1
        assert len(column.errors) in (0, len(column.values)), column
        assert all(error >= 0.0 for error in column.errors), column
        assert bool(column.assumed_error) == bool(column.assumed_because), column
        assert not (column.assumed_error and column.errors), column


def test_the_command_lists_all_and_shows_one(capsys):
    assert main(["datasets"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in NAMES)
    assert main(["datasets", "croquet-energy"]) == 0
    assert "Am. J. Phys. 68, 920 (2000)" in capsys.readouterr().out
    assert main(["datasets", "golf-marble-heights", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["datasets"]
    assert found["columns"][0]["values"] == [80.0, 90.0, 100.0, 110.0]
    assert main(["datasets", "granite-sphere"]) == 2
    assert "got 'granite-sphere'; did you mean granite-spheres" in capsys.readouterr().err
