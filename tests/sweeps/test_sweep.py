"""Sweeps: every element as `simulate` has it, by path, by dimension, lazily, with provenance."""

import json
from itertools import product

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from stackbounce.run.batch import solve
from stackbounce.run.engines import choose_lanes
from stackbounce.run.options import run_options
from stackbounce.run.paths import drop_at, identifier, number_at
from stackbounce.sweeps.draws import read_draws

TWO = [sb.Ball(0.15), sb.Ball(0.057)]
LAWS = {
    "rigid": [sb.Rigid(0.8), sb.Rigid(0.9)],
    "springs": [sb.Spring(2500.0), sb.Spring(1000.0)],
    "hertz": [sb.Hertz(1e5), sb.PowerLaw(1e5, 1.3)],
    "damped": [sb.Dashpot(2500.0, 1.0), sb.Viscoelastic(1e5, 1e-4)],
    "linear": [sb.Dashpot(2500.0, 1.0), sb.StandardLinearSolid(1e4, 0.5, 2e-3)],
    "losses": [sb.HuntCrossley(1e5, 1.5, 0.1), sb.Hysteretic(1e4, restitution=0.8)],
    "hysteresis": [sb.Hysteretic(1e4, restitution=0.8), sb.Spring(1e3)],
}
OTHER_NAMES = {"rebound_ratio": "rebound_ratios"}  # of a result, where a sweep has another one


def assert_same(element, drop, until=None, rtol=1e-12):
    """Bit for bit, but for two balls, which have engines of their own."""
    lanes = choose_lanes(drop, [], run_options(drop, until, rtol, 1_000_000))
    near = 10.0 * rtol if lanes == "run_pairs" else 1e-12
    result = sb.simulate(drop, until=until, rtol=rtol)
    for name in element.data_vars:
        expected = getattr(result, OTHER_NAMES.get(name, name))
        if lanes and np.asarray(expected).dtype.kind == "f":
            assert element[name].values == pytest.approx(expected, rel=near, abs=1e-14), name
        else:
            assert np.array_equal(element[name].values, expected, equal_nan=True), name


@pytest.mark.fast_cases(3)
@pytest.mark.parametrize("count", [3, 30])
@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS)
def test_every_element_is_what_simulate_returns(laws, count):
    drop = sb.Drop(TWO, laws, [0.001], impact_speed=3.53)
    mass = np.geomspace(0.05, 1.0, count)
    ds = sb.sweep(drop, {"balls.0.mass": mass, "gaps.0": [0.0, 0.004]}, rtol=1e-9)
    assert ds.sizes == {"balls_0_mass": count, "gaps_0": 2, "ball": 2, "contact": 2}
    for i in (0, count // 2, count - 1):
        for j, gap in enumerate((0.0, 0.004)):
            one = sb.Drop([sb.Ball(float(mass[i])), TWO[1]], laws, [gap], impact_speed=3.53)
            assert_same(ds[{"balls_0_mass": i, "gaps_0": j}], one, rtol=1e-9)


@pytest.mark.parametrize(
    ("path", "laws", "values"),
    [
        ("contacts.1.stiffness", LAWS["springs"], [500.0, 2000.0]),
        ("contacts.1.exponent", LAWS["losses"], [1.5, 2.0]),
        ("contacts.1.unloading_exponent", LAWS["losses"], [3.0, 8.0]),
        ("contacts.0.restitution", LAWS["rigid"], [0.0, 1.0]),
        ("gaps.0", LAWS["springs"], [0.0, 0.01]),
        ("impact_speed", LAWS["hertz"], [1.0, 5.0]),
        ("balls.1.diameter", LAWS["springs"], [0.1, 0.2]),
        ("gravity", LAWS["springs"], [0.0, 9.81]),
    ],
)
def test_any_number_can_vary(path, laws, values):
    drop = sb.Drop([sb.Ball(0.15), sb.Ball(0.057, diameter=0.065)], laws, impact_speed=3.53)
    ds = sb.sweep(drop, {path: values}, until=1.0)
    for k, value in enumerate(values):
        other = drop_at(drop, {number_at(drop, path): value})
        assert other != drop or value in (drop.gravity, drop.gaps[0])
        assert_same(ds[{identifier(path): k}], other, until=1.0)


def test_height_and_gravity_vary_together():
    drop = sb.Drop(TWO, LAWS["springs"], height=1.0)
    heights, gravities = [0.5, 2.0], [0.0, 3.7]
    ds = sb.sweep(drop, {"height": heights, "gravity": gravities}, until=0.02)
    for (i, height), (j, gravity) in product(enumerate(heights), enumerate(gravities)):
        one = sb.Drop(TWO, LAWS["springs"], height=height, gravity=gravity)
        assert_same(ds[{"height": i, "gravity": j}], one, until=0.02)


def test_velocities_of_a_cradle():
    row = [None, sb.Hertz(1e9), sb.Hertz(1e9)]
    drop = sb.Drop([sb.Ball(0.03)] * 3, row, velocities=[1.0, 0.0, 0.0])
    ds = sb.sweep(drop, {"velocities.1": np.linspace(-1.0, 1.0, 5)})
    for k, velocity in enumerate(np.linspace(-1.0, 1.0, 5)):
        one = sb.Drop(drop.balls, row, velocities=[1.0, velocity, 0.0])
        assert_same(ds[{"velocities_1": k}], one)
    with pytest.raises(sb.StackbounceError, match=r"must not all be 0.*velocities.0 1: velociti"):
        sb.sweep(drop, {"velocities.0": [1.0, 0.0]})


def test_arrays_broadcast_by_dimension_name():
    drop = sb.Drop(TWO, LAWS["springs"], impact_speed=3.53)
    mass = xr.DataArray([0.1, 0.2, 0.3], dims="run")
    gap = xr.DataArray([0.0, 0.001, 0.002], dims="run")
    options = {"coords": {"soft": ["a", "b"]}, "attrs": {"units": "kN/m"}}
    stiffness = xr.DataArray([1.0, 2.0], dims="soft", **options)
    ds = sb.sweep(drop, {"balls.0.mass": mass, "gaps.0": gap, "contacts.0.stiffness": stiffness})
    assert ds.status.dims == ("run", "soft")
    assert ds.contacts_0_stiffness.values.tolist() == [1000.0, 2000.0]
    assert ds.gaps_0.dims == ("run",)
    laws = [sb.Spring(2000.0), LAWS["springs"][1]]
    one = sb.Drop([sb.Ball(0.2), TWO[1]], laws, [0.001], impact_speed=3.53)
    assert_same(ds.sel(soft="b").isel(run=1), one)


def test_nothing_varies():
    drop = sb.Drop(TWO, LAWS["springs"], impact_speed=3.53)
    assert_same(sb.sweep(drop, {}), drop)
    assert_same(sb.sweep(drop, {"balls.0.mass": 0.15}), drop)


def test_provenance_and_units():
    drop = sb.Drop(TWO, LAWS["losses"], impact_speed=3.53)
    ds = sb.sweep(drop, {"balls.0.mass": [0.1]}, rtol=1e-6)
    assert ds.attrs["stackbounce"] == sb.__version__
    assert json.loads(ds.attrs["varied"]) == ["balls.0.mass"]
    assert set(json.loads(ds.attrs["laws"])) == {"HuntCrossley", "Hysteretic"}
    assert ds.attrs["rtol"] == 1e-6
    words = {"long_name": "mass of ball 0", "path": "balls.0.mass"}
    assert ds.balls_0_mass.attrs == {"units": "kg", **words}
    assert ds.first_touch.attrs["units"] == "s"
    flags = ds.status.attrs
    names = dict(zip(flags["flag_values"], flags["flag_meanings"].split(), strict=True))
    assert names == {int(status): status.name for status in sb.Status}


def test_an_unfinished_drop_is_marked_and_the_others_are_not():
    drop = sb.Drop([sb.Ball(1.0), sb.Ball(1.0)], [sb.Rigid(1.0)] * 2, impact_speed=1.0)
    ds = sb.sweep(drop, {"balls.1.mass": [1.0, 1e8]}, event_limit=100)
    assert [sb.Status(status).name for status in ds.status.values] == ["FINISHED", "EVENT_LIMIT"]
    assert ds.collisions.values.sum(axis=-1).tolist() == [3, 100]
    assert np.isfinite(ds.rebound_ratio).all()


def test_an_error_has_all_numbers_of_the_element():
    drop = sb.Drop(TWO, LAWS["losses"], impact_speed=3.53)
    values = {"contacts.1.exponent": [1.0, 3.0], "contacts.1.unloading_exponent": [2.0, 5.0]}
    with pytest.raises(sb.StackbounceError) as caught:
        sb.sweep(drop, values)
    assert "contacts.1.exponent = 3, contacts.1.unloading_exponent = 2" in str(caught.value)
    with pytest.raises(sb.StackbounceError, match="only one of the two can vary"):
        sb.sweep(drop, {"contacts.1.restitution": [0.5], "contacts.1.unloading_exponent": [5.0]})


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"balls.0.mas": [1.0]}, r"balls.0.mas is not a parameter .*; did you mean balls.0.mass\?"),
        ({"contacts.0.restitution": [1.0]}, "contacts.0.restitution is not a parameter of this"),
        ({"balls.0.mass": [1, -1]}, r"balls.0.mass must be a .*, got -1.0 \(at balls_0_mass 1: "),
        ({"gaps.0": [0.0, np.nan]}, r"gaps.0 must be .*, got nan \(at gaps_0 1: gaps.0 = nan\)"),
        ({"balls.0.mass": ["a"]}, "balls.0.mass.0 must be a mass .*, got 'a'"),
        ({"balls.0.mass": [[1.0], [2.0]]}, "or a DataArray with named dimensions, got 2"),
        ({"balls.0.mass": xr.DataArray(1.0, {"status": 5})}, "or coordinate named status"),
        ({1: [1.0]}, "a path must be a string, got 1"),
        ([1.0], "values must be a mapping of paths to values"),
    ],
)
def test_errors_name_what_was_wrong(values, message):
    drop = sb.Drop(TWO, LAWS["springs"], impact_speed=3.53)
    with pytest.raises(sb.StackbounceError, match=message):
        sb.sweep(drop, values)


@pytest.mark.parametrize("laws", [LAWS["springs"], LAWS["losses"]], ids=["springs", "losses"])
def test_order_and_number_of_rows_change_no_bit(laws):
    drop = sb.Drop(TWO, laws, [0.001], impact_speed=3.53)
    mass = np.random.default_rng(1).uniform(0.05, 1.0, 5000)
    ds = sb.sweep(drop, {"balls.0.mass": mass}, rtol=1e-6)
    back = sb.sweep(drop, {"balls.0.mass": mass[::-1]}, rtol=1e-6)
    back = back.isel(balls_0_mass=slice(None, None, -1))
    part = sb.sweep(drop, {"balls.0.mass": mass[1000:1040]}, rtol=1e-6)
    few = sb.sweep(drop, {"balls.0.mass": mass[1000:1005]}, rtol=1e-6)
    for name in ds.data_vars:
        assert np.array_equal(ds[name], back[name])
        assert np.array_equal(ds[name][1000:1040], part[name])
        assert np.array_equal(ds[name][1000:1005], few[name])


def test_other_values_in_the_sweep_change_no_bit():
    laws = [sb.PowerLaw(2500.0, 1.0), sb.PowerLaw(1000.0, 1.0)]
    drop = sb.Drop(TWO, laws, [0.001], impact_speed=3.53)
    mass = np.geomspace(0.05, 1.0, 30)
    alone = sb.sweep(drop, {"contacts.1.exponent": [1.0], "balls.0.mass": mass}, rtol=1e-6)
    both = sb.sweep(drop, {"contacts.1.exponent": [1.0, 1.5], "balls.0.mass": mass}, rtol=1e-6)
    for name in alone.data_vars:
        assert np.array_equal(alone[name][0], both[name][0]), name


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("shape", [(2, 40, 130), (3, 5000), (5000, 3), (1, 1, 7000)])
def test_a_grid_is_cut_into_blocks_that_fit_together(shape):
    drop = sb.Drop(TWO, LAWS["springs"], impact_speed=3.53)
    paths = ["impact_speed", "balls.0.mass", "gaps.0"][-len(shape) :]
    axes = [np.linspace(1e-4, 2e-3, size) for size in shape]
    ds = sb.sweep(drop, dict(zip(paths, axes, strict=True)))
    everywhere = np.meshgrid(*axes, indexing="ij")
    rows = [xr.DataArray(values.ravel(), dims="run") for values in everywhere]
    rows = sb.sweep(drop, dict(zip(paths, rows, strict=True)))
    for name in ds.data_vars:
        assert np.array_equal(ds[name].values.reshape(rows[name].shape), rows[name]), name


def test_tall_stacks_are_as_simulated():
    balls = [sb.Ball(0.01 * (1 + k % 7)) for k in range(12)]
    drop = sb.Drop(balls, [sb.Rigid(0.9)] * 12, impact_speed=3.53)
    ds = sb.sweep(drop, {"balls.3.mass": np.linspace(0.01, 0.5, 30)})
    for k in (0, 17, 29):
        one = drop_at(drop, {number_at(drop, "balls.3.mass"): float(ds.balls_3_mass[k])})
        assert_same(ds.isel(balls_3_mass=k), one)


def test_plain_python_gives_the_same_bits():
    for laws in LAWS.values():
        drop = sb.Drop(TWO, laws, [0.001], impact_speed=3.53)
        rows = {number_at(drop, "balls.0.mass"): np.geomspace(0.05, 1.0, 20)}
        options = run_options(drop, None, 1e-6, 10**6)
        swift, plain = (solve(drop, rows, (20,), options, compiled=way) for way in (True, False))
        for one, other in zip(swift, plain, strict=True):
            assert one.tobytes() == other.tobytes()


@pytest.mark.parametrize(
    "text", ["gaps.0 (mm);balls.0.mass\n1,5;0,1\n", "gaps.0 (mm),balls.0.mass\n1.5,0.1\n"]
)
def test_a_comma_is_a_decimal_mark_where_it_does_not_part_the_columns(text, tmp_path):
    path = tmp_path / "draws.csv"
    path.write_text(text)
    drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    numbers = {path: values for path, (_, values) in read_draws(drop, path).items()}
    assert numbers == {"gaps.0": [1.5e-3], "balls.0.mass": [0.1]}
