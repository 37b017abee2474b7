"""Lines and maps of sweeps show the numbers they are given."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import stackbounce as sb
from stackbounce import plots
from stackbounce.measure.finding import Findings
from stackbounce.plots.sweep_curves import SHOWN

DROP = sb.Drop([sb.Ball(1.0)] * 2, [sb.Rigid(0.9), sb.Rigid(0.5)], impact_speed=1.0)
MASS, LOSS = np.geomspace(0.001, 1.0, 12), np.linspace(0.05, 1.0, 9)
OVER_BOTH = {"balls.0.mass": MASS, "contacts.1.restitution": LOSS}


def texts(labels):
    return [label.get_text() for label in labels]


def test_lines_follow_each_ball():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS})
    axes = plots.lines(ds).axes[0]
    for b, line in enumerate(axes.get_lines()):
        assert np.array_equal(line.get_xdata(), MASS)
        assert np.array_equal(line.get_ydata(), ds.rebound_ratio[:, b])
    assert texts(axes.get_legend().get_texts()) == ["ball 0", "ball 1"]
    assert (axes.get_xscale(), axes.get_xlabel()) == ("log", "balls.0.mass (kg)")
    assert plots.lines(ds, "energy_retained").axes[0].get_ylabel() == "energy retained"
    assert not plt.get_fignums()  # no figure is left with pyplot


def test_a_map_has_a_color_for_each_value():
    ds = sb.sweep(DROP, OVER_BOTH)
    axes = plots.heatmap(ds).axes[0]
    assert np.array_equal(axes.collections[0].get_array(), ds.rebound_ratio[:, :, 1])
    assert (axes.get_ylabel(), axes.get_xlabel()) == ("balls.0.mass (kg)", "contacts.1.restitution")
    lowest = plots.heatmap(ds, index=0).axes[0]
    assert np.array_equal(lowest.collections[0].get_array(), ds.rebound_ratio[:, :, 0])


def test_unfinished_drops_are_told_and_left_out():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS}, event_limit=3)
    unfinished = ds.status.isin([sb.Status.EVENT_LIMIT, sb.Status.INVALID]).values
    axes = plots.lines(ds).axes[0]
    assert unfinished.any()
    assert "could not be finished: see status" in axes.get_title(loc="left")
    assert np.array_equal(np.isnan(axes.get_lines()[0].get_ydata()), unfinished)


@pytest.mark.parametrize("show", SHOWN)
def test_nothing_to_draw(show):
    ds = sb.sweep(DROP, OVER_BOTH)
    ds["status"][:] = int(sb.Status.INVALID)
    axes = plots.heatmap(ds, show).axes[0]
    assert axes.collections[0].get_array().mask.all()
    assert axes.patch.get_hatch()
    plots.lines(ds.isel(contacts_1_restitution=0), show).draw_without_rendering()


def test_one_ball_by_its_index():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS})
    for index in (0, -2):
        (line,) = plots.lines(ds, index=index).axes[0].get_lines()
        assert np.array_equal(line.get_ydata(), ds.rebound_ratio[:, 0])


def test_balls_have_their_names():
    balls = [sb.Ball(1.0, name="basketball"), sb.Ball(0.1)]
    drop = sb.Drop(balls, [sb.Spring(1e4)] * 2, impact_speed=1.0)
    ds = sb.sweep(drop, {"gaps.0": [0.0, 0.001], "balls.0.mass": [1.0, 2.0]})
    titles = [plots.heatmap(ds, index=k).axes[0].get_title(loc="left") for k in (0, 1)]
    assert titles == ["rebound ratio of ball 0 (basketball)", "rebound ratio of ball 1"]
    legend = plots.lines(ds.isel(gaps_0=0)).axes[0].get_legend()
    assert texts(legend.get_texts()) == ["ball 0 (basketball)", "ball 1"]


def test_cells_lie_around_their_values():
    masses, losses = np.geomspace(0.01, 100.0, 5), np.array([0.9, 0.1, 0.5])  # not in order
    ds = sb.sweep(DROP, {"balls.0.mass": masses, "contacts.1.restitution": losses})
    mesh = plots.heatmap(ds).axes[0].collections[0]
    assert np.array_equal(mesh.get_array(), ds.rebound_ratio[:, [1, 2, 0], 1])
    corners = np.asarray(mesh.get_coordinates())
    assert corners[:, 0, 1] == pytest.approx(np.geomspace(10**-2.5, 10**2.5, 6))
    assert corners[0, :, 0] == pytest.approx([-0.1, 0.3, 0.7, 1.1])


def test_axes_tell_small_values_in_small_units():
    drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1e4)] * 2, impact_speed=1.0)
    ds = sb.sweep(drop, {"gaps.0": np.linspace(0.0, 0.004, 5), "balls.0.mass": [0.1, 0.2, 0.4]})
    figure = plots.heatmap(ds, "last_release")
    axes, bar = figure.axes
    figure.draw_without_rendering()
    assert (axes.get_ylabel(), axes.get_xlabel()) == ("gaps.0 (mm)", "balls.0.mass (g)")
    assert axes.get_title(loc="left") == "last release of contact 1 (ms)"
    assert texts(axes.get_yticklabels())[1:-1] == list("01234")
    assert {"100", "200"} <= {text.get_text() for text in axes.get_xticklabels()}
    assert float(bar.get_yticklabels()[0].get_text()) > 1.0  # ms
    assert axes.get_ylim() == pytest.approx((-0.0005, 0.0045))  # the data stay in m
    law = sb.PowerLaw(1e5, exponent=2.5)
    one = sb.sweep(sb.Drop([sb.Ball(1.0)], [law], height=1.0), {"contacts.0.stiffness": [1e5, 2e5]})
    assert plots.lines(one).axes[0].get_xlabel() == "contacts.0.stiffness (N/m$^{2.5}$)"


def test_differences_of_round_off_are_not_drawn():
    drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    ds = sb.sweep(drop, {"balls.0.mass": MASS, "contacts.0.stiffness": MASS})
    assert 0.0 < np.ptp(ds.energy_retained.values) < 1e-9
    axes, bar = plots.heatmap(ds, "energy_retained").axes
    assert len(axes.collections) == 1  # no contours
    assert texts(bar.get_yticklabels()) == ["1"]
    low, high = plots.lines(ds.isel(balls_0_mass=3), "energy_retained").axes[0].get_ylim()
    assert (low, high) == pytest.approx((0.5, 1.5))


def test_a_change_of_sign_is_white():
    drop = sb.Drop([sb.Ball(1.0)] * 2, [None, sb.Spring(1.0)], velocities=[1.0, 0.0])
    ds = sb.sweep(drop, {"velocities.1": np.linspace(-3.0, 0.5, 6), "balls.1.mass": MASS})
    axes, bar = plots.heatmap(ds, index=0).axes
    mesh = axes.collections[0]
    assert mesh.get_cmap().name == "RdBu_r"
    assert mesh.norm(0.0) == 0.5
    values = ds.rebound_ratio.sel(ball=0).values
    assert bar.get_ylim() == pytest.approx((values.min(), values.max()))
    assert plots.heatmap(1e-3 * ds, index=0).axes[0].collections[0].get_cmap().name == "RdBu_r"


@pytest.mark.slow
def test_names_of_contours_do_not_touch():
    drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    masses, stiffnesses = np.geomspace(0.1, 20, 60), np.geomspace(0.05, 50, 60)
    over = {"balls.0.mass": masses, "contacts.0.stiffness": stiffnesses}
    figure = plots.heatmap(sb.sweep(drop, over), index=0)
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in figure.axes[0].texts]
    assert len(boxes) > 8
    assert not any(one.overlaps(two) for k, one in enumerate(boxes) for two in boxes[:k])


def test_lines_show_infinitely_many_above_all_others():
    ds = sb.sweep(DROP, {"balls.0.mass": np.geomspace(0.002, 1.0, 30)})
    assert (ds.collisions == -1).any()
    axes = plots.lines(ds, "collisions").axes[0]
    ticks = dict(zip(texts(axes.get_yticklabels()), axes.get_yticks(), strict=True))
    drawn = axes.get_lines()[0].get_ydata()
    finite = ds.collisions[:, 0].values
    assert np.array_equal(drawn[finite >= 0], finite[finite >= 0])
    assert set(drawn[finite < 0]) == {ticks["∞"]}
    assert ticks["∞"] > finite.max()


def test_many_counts_are_grouped():
    ds = sb.sweep(DROP, OVER_BOTH)
    axes, bar = plots.heatmap(ds, "collisions").axes
    names = texts(bar.get_yticklabels())
    counts = ds.collisions[:, :, 1].values
    assert counts.max() > 12
    assert counts.min() == -1
    for count, place in zip(counts.ravel(), axes.collections[0].get_array().ravel(), strict=True):
        first, _, last = names[int(place)].partition("–")
        assert count == -1 if first == "∞" else int(first) <= count <= int(last or first)


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (2, 2), (7, 1)])
@pytest.mark.parametrize("show", SHOWN)
def test_small_maps_fill_their_axes(shape, show):
    ds = sb.sweep(DROP, OVER_BOTH)
    few = ds.isel(balls_0_mass=slice(shape[0]), contacts_1_restitution=slice(shape[1]))
    axes = plots.heatmap(few, show).axes[0]
    assert np.isfinite(axes.collections[0].get_coordinates()).all()
    assert axes.collections[0].get_array().shape == shape
    assert np.ptp(axes.get_xlim()) > 0.0 < np.ptp(axes.get_ylim())


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (plots.lines, "must have one dimension, got balls.0.mass, contacts.1"),
        (lambda ds: plots.heatmap(ds.isel(balls_0_mass=0)), "must have two dimensions"),
        (lambda ds: plots.heatmap(ds, "colisions"), "did you mean collisions"),
        (lambda ds: plots.heatmap(ds, index=2), "index must name a ball from 0 to 1, got 2"),
        (lambda _: plots.heatmap(3), "data must be a Dataset from sweep, got 3"),
        (plots.bounce, "must be a Result or a Prediction, got a Dataset: plots.lines, heatmap or"),
        (lambda _: plots.lines(DROP), r"got a Drop: plots.bounce\(simulate\(drop\)\) draws it"),
        (lambda _: plots.fit(sb.simulate(DROP)), "got a Result: plots.bounce draws it"),
        (lambda ds: plots.heatmap(ds, axes="left"), "axes must be 1 Axes of matplotlib, got 0"),
    ],
)
def test_errors(draw, message):
    with pytest.raises(sb.StackbounceError, match=message):
        draw(sb.sweep(DROP, OVER_BOTH))
    plt.close("all")


def test_every_plot_draws_into_axes_of_the_user():
    drop = sb.Drop([sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0)] * 2, impact_speed=3.5)
    data = {"rebound_ratios": ["0.2 ± 0.05", "1.7 ± 0.1"]}
    found = sb.fit(drop, data, ["contacts.0.stiffness", "contacts.1.stiffness"])
    models = sb.compare(sb.standard_models(drop), data)
    bounces = Findings([sb.measure.bounces([0.0, 0.8, 1.44, 1.952])])
    series = sb.fit_series("dataset:golf-marble-heights", laws=["Rigid"])
    ds = sb.sweep(DROP, OVER_BOTH)
    draws = [
        (2, lambda axes: plots.bounce(sb.simulate(drop), axes=axes)),
        (1, lambda axes: plots.lines(ds.isel(balls_0_mass=0), axes=axes)),
        (1, lambda axes: plots.heatmap(ds, ax=axes)),
        (1, lambda axes: plots.highest(sb.highest(["B1", "B2"], 2), axes=axes)),
        (1, lambda axes: plots.measured(None, bounces, axes=axes)),
        (2, lambda axes: plots.restitutions(series, axes=axes)),
        (3, lambda axes: plots.fitted(found, axes=axes)),
        (2, lambda axes: plots.compared(models, axes=axes)),
        (4, lambda axes: plots.corner(found.sample(6400), axes=axes)),
    ]
    for count, draw in draws:
        _, axes = plt.subplots(1 + (count == 4), -(-count // (1 + (count == 4))))
        with pytest.raises(sb.StackbounceError, match=f"{count} Axes of matplotlib, got 7"):
            draw(plt.subplots(7)[1])
        assert draw(axes) is axes
        empty = [panel for panel in np.ravel(axes) if not panel.has_data() and panel.axison]
        assert len(empty) == (count == 4)  # above the diagonal of a corner plot
        plt.close("all")


def test_a_prediction_is_drawn_with_bands():
    drop = sb.Drop([sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0)] * 2, height=0.6)
    banded = plots.bounce(sb.predict(drop, {"height": (0.6, 0.02)})).axes
    plain = plots.bounce(sb.simulate(drop)).axes
    more = [len(b.collections) - len(p.collections) for b, p in zip(banded, plain, strict=True)]
    assert more == [2, 2]
    for axes in banded:  # a band is around its curve
        for line, band in zip(axes.lines, axes.collections[-2:], strict=False):
            (x0, y0), (x1, y1) = band.get_paths()[0].get_extents().get_points()
            assert x1 == pytest.approx(line.get_xdata().max(), rel=0.01)
            assert y0 <= line.get_ydata()[line.get_xdata() >= 0.0].min() + 0.05 * (y1 - y0)
            assert line.get_ydata().max() <= y1
            assert x0 == pytest.approx(0.0, abs=0.02 * x1)
