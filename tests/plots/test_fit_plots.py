"""Pictures of fits: what is in them is what was found."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import plots
from stackbounce.errors import InvalidValue
from stackbounce.units import rounded

BALLS = [sb.Ball(0.15), sb.Ball(0.057)]
DROP = sb.Drop(BALLS, [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53)
BETWEEN = {"contacts.1.stiffness": (700.0, 2500.0)}


@pytest.fixture(scope="module")
def one():
    return sb.fit(DROP, {"rebound_ratios.1": "1.64 ± 0.02"}, BETWEEN)


@pytest.fixture(scope="module")
def two():
    laws = [sb.Spring(2500.0), sb.Spring(1480.0)]
    truth = sb.simulate(sb.Drop(BALLS, laws, gaps=[4e-3], impact_speed=3.53))
    data = {
        "rebound_ratios": [(ratio, 0.02) for ratio in truth.rebound_ratios.tolist()],
        "first_touch.1": (float(truth.first_touch[1]), 0.3e-3),
    }
    return sb.fit(DROP, data, BETWEEN | {"gaps.0": ("0 mm", "10 mm")})


@pytest.fixture(scope="module")
def records():
    """A fit to the floor's force in newtons, and to that between the balls in volts."""
    times = np.arange(-0.01, 0.05, 2e-4)
    result = sb.simulate(sb.Drop(BALLS, [sb.Spring(2600.0), sb.Spring(1100.0)], impact_speed=3.53))
    forces = result.sample(np.maximum(times, 0.0)).force
    noise = np.random.default_rng(1)
    data = {}
    for k, scale, unit in ((0, 1.0, "N"), (1, 0.02, "V")):
        values = scale * (forces.sel(contact=k).values + noise.normal(0.0, 0.5, len(times)))
        record = forces.sel(contact=k, drop=True).copy(data=values).assign_coords(time=times + 0.3)
        record.attrs = {"units": unit}
        data[f"force.{k}"] = record
    return sb.fit(DROP, data, {"contacts.0.stiffness": None, "contacts.1.stiffness": None})


def dots(axes, marker="o"):
    lines = [line for line in axes.lines if line.get_marker() == marker]
    return np.concatenate([np.stack(line.get_data(), axis=1) for line in lines])


@pytest.mark.slow
def test_a_cell_for_each_pull(two):
    axes = plots.fitted(two).axes[0]
    written = [float(text.get_text()) for text in axes.texts]
    assert written == pytest.approx([row.pull for row in two.residuals], abs=0.051)
    names = [label.get_text() for label in axes.get_xticklabels()]
    assert names == ["rebound_ratios.0", "rebound_ratios.1", "first_touch.1"]


def test_pulls_of_models_are_written_in_few_characters():
    data = {"rebound_ratios.1": "1.64 ± 0.02", "rebound_ratios.0": "0.2 ± 0.0001"}
    axes = plots.compared(sb.compare({"one": sb.Model(DROP, BETWEEN)}, data)).axes[1]
    assert {text.get_text() for text in axes.texts} == {"+11.7", "+142"}


def test_a_curve_over_one_parameter(one):
    axes = plots.fitted(one).axes[-1]
    assert axes.get_xlabel() == "contacts.1.stiffness (N/m)"
    values, above = max((line.get_data() for line in axes.lines), key=lambda data: len(data[0]))
    again = one.profile("contacts.1.stiffness", values[::50]) - one.chi_squared
    assert above[::50] == pytest.approx(again, abs=1e-9)
    best = one["contacts.1.stiffness"]
    assert dots(axes)[0] == pytest.approx([best.nominal_value, 0.0], abs=1e-6)
    low, high = one.intervals()["contacts.1.stiffness"][:2]
    assert np.interp([low, high], values, above) == pytest.approx([1.0, 1.0], abs=0.02)


@pytest.mark.slow
def test_two_parameters_have_a_profile_each(two):
    _, bar, *panels = plots.fitted(two).axes
    assert bar.get_ylabel() == "off by\n(errors)"
    assert [axes.get_xlabel() for axes in panels] == ["contacts.1.stiffness (N/m)", "gaps.0 (mm)"]
    for axes, name in zip(panels, two.names, strict=True):
        values, above = max((line.get_data() for line in axes.lines), key=lambda data: len(data[0]))
        assert len(values) == 61
        assert above == pytest.approx(two.profile(name, values) - two.chi_squared)
        assert np.all(above > -1e-6)
        assert dots(axes)[0] == pytest.approx([two[name].nominal_value, 0.0], abs=1e-6)


@pytest.mark.slow
def test_a_profile_meets_the_limits_of_the_interval(two):
    for name, interval in two.intervals().items():
        above = two.profile(name, interval[:2]) - two.chi_squared
        assert not any(interval[2:])
        assert above == pytest.approx([1.0, 1.0], abs=5e-3)
    with pytest.raises(InvalidValue, match=r"did you mean gaps\.0"):
        two.profile("gaps.1", [0.0])
    with pytest.raises(InvalidValue, match=r"gaps\.0 must be a number from 0 to 0\.01, got 1"):
        two.profile("gaps.0", [1.0])


@pytest.mark.slow
def test_three_parameters_have_no_map():
    data = {"rebound_ratios": ["0.42 ± 0.02", "1.72 ± 0.02"], "energy_retained": "0.99 ± 0.01"}
    vary = BETWEEN | {"gaps.0": ("0 mm", "5 mm"), "contacts.0.stiffness": (2e3, 3e3)}
    assert len(plots.fitted(sb.fit(DROP, data, vary)).axes) == 2  # the pulls and their colors


def test_records_with_the_fitted_curve(records):
    figure = plots.fitted(records)
    assert [axes.get_ylabel() for axes in figure.axes] == ["force (N)", "signal"]
    for axes, own in zip(figure.axes, records.records, strict=True):
        assert own.name in axes.get_title(loc="left")
        measured, curve = axes.lines
        at = np.interp(curve.get_xdata() / 1e3, own.times, own.fitted)
        assert curve.get_ydata() == pytest.approx(at, abs=1e-9 * np.abs(at).max())
        assert measured.get_xdata().tolist() == curve.get_xdata().tolist()
        off = measured.get_ydata() - curve.get_ydata()
        assert np.sqrt(np.mean((off / own.error) ** 2)) == pytest.approx(1.0, abs=0.25)
        assert 0.9 < own.scatter < 1.15
    assert records["contacts.0.stiffness"].nominal_value == pytest.approx(2600.0, rel=0.02)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("which", ["one", "two"])
def test_a_corner_has_a_panel_for_each_pair(which, request):
    found = request.getfixturevalue(which)
    posterior = found.sample(6400, rng=2)
    figure = plots.corner(posterior)
    count = len(found.names)
    assert len(figure.axes) == count**2
    for k, name in enumerate(found.names):
        title = figure.axes[k * (count + 1)].get_title()
        middle = posterior.quantiles(name)[1] * (1e3 if name == "gaps.0" else 1.0)
        assert float(title.strip("$").partition("^")[0]) == pytest.approx(middle, rel=0.01)
    assert figure.axes[-1].get_xlabel() == (
        "gaps.0 (mm)" if count == 2 else f"{found.names[0]} (N/m)"
    )


def test_numbers_end_where_their_error_does():
    assert rounded((1.0, 0.5), 0.0) == ["1", "0.5"]
    assert rounded((1.23456e9,), 1e7) == ["1.235e+09"]
    assert rounded((1234567.0,), 1234.0) == ["1234567"]
