"""Scenarios whose numbers have errors: what is written is read again, to the last bit."""

import random

import pytest
from uncertainties import ufloat

import stackbounce as sb
from explorer.page.scenarios import drawn
from stackbounce.errors import InvalidValue
from stackbounce.prediction import read_scenario, write_scenario
from stackbounce.prediction.inputs import read_inputs
from stackbounce.run.paths import numbers_of, value_in

DROP = sb.Drop(
    [sb.Ball(0.15, name="a (1) ± b"), sb.Ball(0.057)],
    [sb.Hertz(2e5), sb.Hysteretic(1000.0, restitution=0.8)],
    gaps=[0.002],
    velocities=[-3.0, -3.5],
)


@pytest.mark.parametrize("seed", range(40))
def test_what_is_written_is_read(tmp_path, seed):
    chance = random.Random(seed)
    drop = sb.Drop.from_mapping(drawn(1, seed, 1)[0])
    numbers = [
        one for one in numbers_of(drop).values() if value_in(drop, one) == value_in(drop, one)
    ]
    chosen = chance.sample(numbers, min(3, len(numbers)))
    errors = {
        one.path: (value_in(drop, one), 10.0 ** chance.uniform(-9, 3))
        for one in chosen
        if one.field not in ("restitution", "unloading_exponent")  # a law is written by one of them
    }
    path = tmp_path / "drop.toml"
    path.write_text(write_scenario(drop, errors), encoding="utf-8")
    read, found = read_scenario(path)
    assert read == drop
    known = read_inputs(read, found)
    numbers = zip(known.values, known.deviations, strict=True)
    assert dict(zip(known.paths, numbers, strict=True)) == errors


def test_numbers_have_their_units_and_places():
    errors = {
        "balls.0.mass": "150 ± 2 g",
        "contacts.0.stiffness": (2.1e5, 1e4),
        "contacts.1.unloading_exponent": (2.0, 0.1),
        "gaps.0": ufloat(0.002, 0.0005),
        "velocities.1": (-3.5, 0.1),
        "velocities.0": (-3.1, 0.0),
    }
    lines = write_scenario(DROP, errors).splitlines()
    assert 'gaps = ["0.002 ± 0.0005 m"]' in lines
    assert 'velocities = [-3.1, "-3.5 ± 0.1 m/s"]' in lines
    assert 'mass = "0.15 ± 0.002 kg"' in lines
    assert 'stiffness = "210000.0 ± 10000.0 N/m**1.5"' in lines
    assert 'unloading_exponent = "2.0 ± 0.1"' in lines
    assert not any(line.startswith("restitution") for line in lines)


def test_correlated_errors_have_no_place_in_a_file():
    mass = ufloat(0.15, 0.002)
    with pytest.raises(InvalidValue, match="must be independent"):
        write_scenario(DROP, {"balls.0.mass": mass, "balls.1.mass": mass / 3})
