"""Laws from measured points: splines, what is refused, files, press curves."""

import itertools
import json

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import errors
from stackbounce.cli import main
from stackbounce.measure import one_ball, press
from stackbounce.model.laws.tabulated import monotone_spline
from synthetic.press import press_record

X, Y, BACK = [0.0, 1e-3, 2e-3, 4e-3], [0.0, 10.0, 15.0, 60.0], [0.0, 0.0, 8.0, 60.0]


def at(spline, x):
    starts = np.array([one[0] for one in spline])
    begin, a, b, s = np.array(spline)[np.searchsorted(starts, x, side="right") - 1].T
    return a + (x - begin) * (b + (x - begin) * s), b + 2.0 * (x - begin) * s


@pytest.mark.parametrize("seed", range(20))
def test_a_spline_goes_through_its_points_and_rises(seed):
    rng = np.random.default_rng(seed)
    x = np.concatenate([[0.0], np.cumsum(10.0 ** rng.uniform(-3.0, 0.0, 9))])
    y = np.concatenate([[0.0], np.cumsum(10.0 ** rng.uniform(-4.0, 2.0, 9))])
    spline = monotone_spline(x.tolist(), y.tolist())
    assert at(spline, x)[0] == pytest.approx(y, rel=1e-9, abs=1e-9 * y[-1])
    values, slopes = at(spline, np.linspace(0.0, 1.5 * x[-1], 20_001))
    assert np.diff(values).min() > -1e-9 * y[-1]
    assert slopes.min() > -1e-9 * slopes.max()


def test_a_spline_has_no_corner_but_at_the_last_point_of_a_level():
    spline = monotone_spline(X, Y)
    for before, after in itertools.pairwise(spline):
        one, two = before[2] + 2.0 * (after[0] - before[0]) * before[3], after[2]
        assert one == pytest.approx(two, rel=1e-9)


def test_a_spline_converges_to_a_smooth_curve():
    misses = []
    for count in (5, 9, 17):
        x = np.linspace(0.0, 1.0, count)
        spline = monotone_spline(x.tolist(), (x**1.5 + x).tolist())
        fine = np.linspace(0.3, 1.0, 1001)
        misses.append(np.abs(at(spline, fine)[0] - fine**1.5 - fine).max())
    assert misses[0] > 3.0 * misses[1] > 9.0 * misses[2]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"force": [0.0, 1.0]}, "force must have 4 points, as compression, got 2"),
        ({"force": [1.0, 2.0, 3.0, 4.0]}, "force.0 must be 0, where the ball is just touched"),
        ({"force": [0.0, 2.0, 2.0, 4.0]}, "force.2 must be above force.1, 2.0, got 2.0"),
        ({"compression": [0.0, 1.0, 1.0005, 4.0]}, "compression.2 must be at least 0.1 % above"),
        ({"compression": [0.0]}, "compression must have from 2 to 16 points, got 1"),
        ({"unloading": [0.0, 1.0, 2.0, 3.0]}, "unloading must end with the last force, 60.0"),
        ({"unloading": [0.0, 11.0, 12.0, 60.0]}, "unloading.1 must be at most force.1, 10.0"),
        ({"unloading": [0.0, 5.0, 4.0, 60.0]}, "unloading.2 must be at least unloading.1"),
        ({"unloading": BACK, "restitution": 0.8}, "unloading and restitution must not both be"),
        ({"restitution": 0.0}, "restitution must be a number from 1e-05 to 1, got 0"),
        ({"force": [0.0, 1.0, float("nan"), 3.0]}, "force.2 must be a finite number"),
    ],
)
def test_what_is_no_table_is_refused(given, words):
    with pytest.raises(errors.InvalidValue) as caught:
        sb.Tabulated(**({"compression": X, "force": Y} | given))
    assert words in str(caught.value)


def test_what_is_no_sequence_is_refused():
    with pytest.raises(errors.InvalidType, match="force must be a list, got 'many'"):
        sb.Tabulated(X, "many")
    for value in (np.array(3.0), {0.0, 1e-3}):
        with pytest.raises(errors.InvalidType, match="compression must be a list"):
            sb.Tabulated(value, Y)


def test_a_sequence_may_be_endless():
    with pytest.raises(errors.InvalidValue, match="must hold at most 16 values, got more"):
        sb.Tabulated(itertools.count(), Y)
    with pytest.raises(errors.InvalidValue, match="balls must hold at most 100000 values"):
        sb.Drop(itertools.repeat(sb.Ball(1.0)), [sb.Spring(1.0)], impact_speed=1.0)


def test_tables_are_not_pressed_in_series():
    law = sb.Tabulated(X, Y)
    with pytest.raises(errors.InvalidValue, match="give the table of both together"):
        sb.series(law, law)


@pytest.mark.parametrize("own", [{}, {"unloading": BACK}, {"restitution": 0.7}])
def test_a_table_is_a_value_that_files_keep(own, tmp_path, capfd):
    law = sb.Tabulated(X, Y, **own)
    assert law == eval(repr(law), {"Tabulated": sb.Tabulated})
    drop = sb.Drop([sb.Ball(0.1)], [law], impact_speed=1.0)
    path = tmp_path / "drop.toml"
    path.write_text(drop.to_toml(), encoding="utf-8")
    assert sb.Drop.from_toml(path) == drop
    assert main(["simulate", str(path), "--json"]) == 0
    assert json.loads(capfd.readouterr().out)["drop"]["contacts"] == [law.to_mapping()]


def test_a_drop_beyond_the_table_says_so(tmp_path, capfd):
    for speed, beyond, before in ((0.6, False, False), (5.0, True, False), (0.01, False, True)):
        drop = sb.Drop([sb.Ball(0.1)], [sb.Tabulated(X, Y)], impact_speed=speed)
        path = tmp_path / "drop.toml"
        path.write_text(drop.to_toml(), encoding="utf-8")
        assert main(["simulate", str(path)]) == 0
        told = " ".join(capfd.readouterr().out.split())
        assert ("but its table ends at 4.000 mm" in told) == beyond
        assert ("but its table begins at 1.000 mm: how the force rises" in told) == before


@pytest.mark.parametrize(("exponent", "e"), [(1.0, 0.77), (1.5, 0.9), (1.3, 0.6)])
def test_a_press_curve_becomes_its_table(exponent, e):
    """Its forces are within the noise of one reading, 0.2 N, of the true ones."""
    true = sb.Hysteretic(4e4, exponent=exponent, restitution=e)
    law = press(press_record(true, peak=5e-3, slack=1e-3, noise=0.2, seed=2)).as_law()
    x = np.linspace(0.2e-3, 4.8e-3, 50)
    force, _ = at(monotone_spline(law.compression, law.force), x)
    assert force == pytest.approx(4e4 * x**exponent, abs=0.2)
    mass = 0.1
    speed = (2.0 * 4e4 * 5e-3 ** (exponent + 1.0) / (exponent + 1.0) / mass) ** 0.5
    assert law.restitution_at(mass, speed) == pytest.approx(e, abs=0.01)


def test_a_press_without_a_way_back_makes_a_lossless_table():
    x = np.linspace(0.0, 5e-3, 80)
    law = press((x, 2e4 * x)).as_law()
    assert law.unloading is None
    assert law.force == pytest.approx(2e4 * np.array(law.compression), rel=1e-3)


def test_the_command_saves_a_table_and_a_bounce_gives_its_loss(tmp_path, capfd):
    true = sb.Hysteretic(4e4, exponent=1.3, restitution=0.78)
    data = press_record(true, peak=5e-3, slack=1e-3, noise=0.1, seed=1)
    record = tmp_path / "press.csv"
    columns = np.column_stack([1e3 * data.compression, data.force])
    np.savetxt(record, columns, delimiter=",", header="compression (mm),force (N)", comments="")
    saved = tmp_path / "ball.toml"
    assert main(["measure", str(record), "--mass", "57g", "--tabulated", "--save", str(saved)]) == 0
    (law,) = sb.Drop.from_toml(saved).contacts
    assert isinstance(law, sb.Tabulated)
    assert law.unloading is not None
    table = {"contact": law.to_mapping()}
    bounce = {"contact": {"law": "Rigid", "restitution": 0.7}}
    (both,) = one_ball([table, bounce], mass=0.057).contacts
    assert both == sb.Tabulated(law.compression, law.force, restitution=0.7)
    capfd.readouterr()
