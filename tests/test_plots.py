"""Lines and maps of sweeps show the numbers they are given."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import stackbounce as sb
from stackbounce import plots

DROP = sb.Drop([sb.Ball(1.0)] * 2, [sb.Rigid(0.9), sb.Rigid(0.5)], impact_speed=1.0)
MASS, LOSS = np.geomspace(0.001, 1.0, 12), np.linspace(0.05, 1.0, 9)


def test_lines_follow_each_ball():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS})
    axes = plots.lines(ds).axes[0]
    for b, line in enumerate(axes.get_lines()):
        assert np.array_equal(line.get_xdata(), MASS)
        assert np.array_equal(line.get_ydata(), ds.rebound_ratio[:, b])
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["ball 0", "ball 1"]
    assert (axes.get_xscale(), axes.get_xlabel()) == ("log", "balls.0.mass (kg)")
    assert plots.lines(ds, "energy_retained").axes[0].get_ylabel() == "energy retained"


def test_a_map_has_a_color_for_each_value():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS, "contacts.1.restitution": LOSS})
    axes = plots.heatmap(ds).axes[0]
    assert np.array_equal(axes.collections[0].get_array(), ds.rebound_ratio[:, :, 1])
    assert (axes.get_ylabel(), axes.get_xlabel()) == ("balls.0.mass (kg)", "contacts.1.restitution")
    lowest = plots.heatmap(ds, index=0).axes[0]
    assert np.array_equal(lowest.collections[0].get_array(), ds.rebound_ratio[:, :, 0])


def test_a_map_of_collisions_names_infinity():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS, "contacts.1.restitution": LOSS})
    assert (ds.collisions == -1).any()
    _, bar = plots.heatmap(ds, "collisions").axes
    names = [text.get_text() for text in bar.get_yticklabels()]
    assert names[-1] == "∞"
    assert names[0] == str(int(ds.collisions.where(ds.collisions > 0).min()))


def test_unfinished_drops_are_told():
    ds = sb.sweep(DROP, {"balls.0.mass": MASS}, event_limit=3)
    assert "could not be finished: see status" in plots.lines(ds).axes[0].get_title(loc="left")


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (plots.lines, "must have one dimension, got balls.0.mass, contacts.1"),
        (lambda ds: plots.heatmap(ds.isel({"balls.0.mass": 0})), "must have two dimensions"),
        (lambda ds: plots.heatmap(ds, "colisions"), "did you mean collisions"),
        (lambda ds: plots.heatmap(ds, index=2), "index must name a ball from 0 to 1, got 2"),
        (lambda _: plots.heatmap(3), "data must be a Dataset from sweep, got 3"),
    ],
)
def test_errors(draw, message):
    ds = sb.sweep(DROP, {"balls.0.mass": MASS, "contacts.1.restitution": LOSS})
    with pytest.raises(sb.StackbounceError, match=message):
        draw(ds)


def test_no_figure_is_left_with_pyplot():
    plots.lines(sb.sweep(DROP, {"balls.0.mass": MASS}))
    assert not plt.get_fignums()
