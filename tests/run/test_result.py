"""The borders of simulate and Result: what they refuse, and what they give back."""

import copy
import math
import pickle
import re
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from drops import every_law
from refusals import refusal
from stackbounce import errors

BALL, SPRING = sb.Ball(1.0), sb.Spring(1.0)
DROP = sb.Drop([BALL], [SPRING], impact_speed=2.0)


@pytest.fixture(scope="module")
def result():
    return sb.simulate(DROP)


def test_only_a_drop_is_run():
    assert refusal(errors.InvalidType, sb.simulate, 3) == "drop must be a Drop, got 3"


@pytest.mark.parametrize("value", [0, 1, "yes", np.True_, [True]])
def test_compiled_is_true_false_or_none(value):
    got = refusal(errors.InvalidType, sb.simulate, DROP, compiled=value)
    assert got == f"compiled must be True, False or None, got {errors.shown(value)}"


@pytest.mark.parametrize("value", [0, 2**62, 2**64])
def test_a_limit_that_a_counter_can_hold(value):
    got = refusal(errors.InvalidValue, sb.simulate, DROP, event_limit=value)
    assert got == f"event_limit must be a whole number from 1 to 1e+18, got {value}"


def test_the_largest_limit_runs_compiled():
    assert sb.simulate(DROP, event_limit=10**18, compiled=True).status is sb.Status.FINISHED


def test_a_stack_too_tall_to_run():
    drop = sb.Drop([BALL] * 2001, [SPRING] * 2001, impact_speed=1.0)
    got = refusal(errors.InvalidValue, sb.simulate, drop)
    assert got == "balls must be at most 2000 for a run, got 2001"


@pytest.mark.parametrize(
    "times",
    [
        *(0.5, 1, np.float32(0.5), (0.5, Fraction(1, 2)), range(3), []),
        *(np.array([0, 1], dtype="u1"), np.array([0.5, 1], dtype=object)),
        xr.DataArray([0.5, 1.0]),
    ],
)
def test_times_are_real_numbers_of_any_kind(result, times):
    expected = np.atleast_1d(np.asarray(times, dtype=float))
    got = result.sample(times)
    np.testing.assert_array_equal(got.time, expected)
    np.testing.assert_allclose(
        got.position[0], -2.0 * np.sin(np.minimum(expected, math.pi)), atol=1e-14
    )


class Unreadable:
    def __array__(self, *_, **__):
        raise RuntimeError("no array")


@pytest.mark.parametrize(
    "times",
    [
        *([0.5, True], np.array([True]), b"1", [1j], [[1], [2, 3]]),
        np.array([1, 2], dtype="m8[ns]"),
        np.ma.array([1.0, 2.0], mask=[False, True]),
        [np.ma.masked, 1.0],
        Unreadable(),
    ],
)
def test_times_that_are_no_real_numbers(result, times):
    assert refusal(errors.InvalidType, result.sample, times).startswith("times")


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        (-1, "times must be seconds from 0, got -1"),
        (math.nan, "times must be a finite number of seconds, got nan"),
        (np.array([0.5, math.inf]), "times must be seconds from 0, got inf"),
        ([1, 10**400], f"times.1 must be a finite number of seconds, got 1{'0' * 56}..."),
        (np.zeros((2, 2)), "times must be a list of numbers, got an array of 2 axes"),
        ([[1, 2]], "times must be a list of numbers, got an array of 2 axes"),
    ],
)
def test_times_out_of_range(result, times, expected):
    assert refusal(errors.InvalidValue, result.sample, times) == expected


@pytest.mark.parametrize("speed", [5e-324, 1e-200, 1.0, 1e200, 1e307])
@pytest.mark.parametrize("mass", [1e-308, 1.0, 1e308])
def test_the_energy_of_any_speed_and_mass(speed, mass):
    drop = sb.Drop([sb.Ball(mass)] * 2, [sb.Rigid(1.0)] * 2, impact_speed=speed)
    assert sb.simulate(drop).energy_retained == pytest.approx(1.0, abs=1e-15)
    drop = sb.Drop([sb.Ball(mass)], [sb.Rigid(0.0)], impact_speed=speed)
    assert sb.simulate(drop).energy_retained == 0.0


@pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))]
)
def test_copies_cannot_be_written_to_either(again):
    result = sb.simulate(DROP)
    names = ("rebound_speeds", "rebound_ratios", "collisions", "intervals", "events", "apexes")
    arrays = [getattr(result, name) for name in names]
    other = again(result)
    for name, array in zip(names, arrays, strict=True):
        assert not getattr(other, name).flags.writeable
        np.testing.assert_array_equal(getattr(other, name), array)
    np.testing.assert_array_equal(other.sample([1.0]).position, result.sample([1.0]).position)


# --- the time of the peak force in `Result.intervals`
@pytest.mark.parametrize("law", every_law(1.0).values(), ids=every_law(1.0))
@pytest.mark.parametrize("masses", [(0.6,), (0.6, 1.0, 0.3), (1.0, 10.0)], ids=len)
def test_no_force_is_larger_and_that_one_is_there(law, masses):
    balls = [sb.Ball(mass) for mass in masses]
    result = sb.simulate(sb.Drop(balls, [law] * len(masses), impact_speed=1.0))
    for row in result.intervals:
        times = np.linspace(row["start"], row["end"], 2001)
        force = result.sample(np.append(times, row["peak_time"])).force.values[row["contact"]]
        assert force[-1] == pytest.approx(row["peak_force"], rel=1e-13)
        assert force[:-1].max() <= row["peak_force"] * (1.0 + 1e-13)


def test_a_dashpot_alone_has_its_peak_at_the_touch():
    result = sb.simulate(sb.Drop([sb.Ball(1.0)], [sb.Dashpot(1.0, 1.9)], impact_speed=1.0))
    assert result.intervals["peak_time"] == pytest.approx([0.0], abs=1e-12)


def test_rigid_balls_have_it_at_the_collision():
    result = sb.simulate(sb.Drop([sb.Ball(1.0)] * 2, [sb.Rigid(0.5)] * 2, [0.1], impact_speed=1.0))
    assert (result.intervals["peak_time"] == result.intervals["start"]).all()


def test_a_result_is_a_dataset_with_units():
    result = sb.simulate(sb.stack("basketball", "tennis", gravity=9.81), until=2.0)
    ds = result.to_dataset()
    for name in ("interval", "event", "apex"):
        rows = result.apexes if name == "apex" else getattr(result, f"{name}s")
        for field in rows.dtype.names:
            assert np.array_equal(ds[f"{name}_{field}"].values, rows[field])
    v = result.rebound_speeds
    assert result.rebound_heights == pytest.approx(v * abs(v) / 19.62)
    assert ds.rebound_height.values == pytest.approx(result.rebound_heights)
    assert ds.status == sb.Status.TIME_REACHED
    assert ds.interval_impulse.attrs == {"long_name": "interval impulse", "units": "N s"}
    assert {name for name in ds.data_vars if "units" not in ds[name].attrs} == {"event_kind"}
    assert sb.Drop.from_mapping(tomllib.loads(ds.attrs["drop"])) == result.drop


def test_a_number_of_the_drop_is_no_argument_of_simulate():
    for name, kind in (("gravity", "Drop"), ("gap", "Drop"), ("mass", "Ball")):
        got = refusal(errors.InvalidType, sb.simulate, DROP, **{name: 1.0})
        right = f"give it to {kind}(…), or see Drop.replace"
        assert got == f"{name} is no argument of simulate; {right}"
    assert "; did you mean until? " in refusal(errors.InvalidType, sb.simulate, DROP, utnil=1.0)


def test_an_attribute_that_is_not_there_says_what_is(result):
    for name, right in (("_energies", ""), ("collision", "; did you mean collisions?")):
        got = refusal(AttributeError, getattr, result, name)
        assert got == f"Result has no attribute '{name}'{right}"
    path = Path(errors.__file__).with_name("attributes.toml")
    owners = {"stackbounce": sb, "Drop": DROP, "Result": result, "drop": DROP, "result": result}
    for owner, tried in tomllib.loads(path.read_text("utf-8")).items():
        for name, right in tried.items():
            assert refusal(AttributeError, getattr, owners[owner], name).endswith(f"; use {right}")
            for first, there in re.findall(r"\b(stackbounce|result|drop)\.(\w+)", right):
                assert hasattr(owners[first], there)
