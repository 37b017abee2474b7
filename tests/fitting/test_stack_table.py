"""Tables with a column for each ball of a stack: drops, errors, fit, picture, and how to cite."""

import json

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import plots
from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.fitting import standard_models
from stackbounce.fitting.cite import cite
from stackbounce.fitting.series import read_stack
from stackbounce.run.paths import number_at

FALLS = (0.3, 0.6, 1.0, 1.4)


def true_stack(height, gap=0.0):
    balls = [sb.Ball(0.15, 0.16), sb.Ball(0.057, 0.065)]
    laws = [sb.Hysteretic(k, restitution=0.85) for k in (2500.0, 1200.0)]
    return sb.Drop(balls, laws, gaps=[gap], height=height)


@pytest.fixture
def table(tmp_path):
    """Return a function that writes a table and returns its path."""

    def write(text, name="stack.csv"):
        (tmp_path / name).write_text(text, "utf-8")
        return tmp_path / name

    return write


@pytest.fixture
def by_height(table):
    """Heights in cm that both balls rise to from some heights."""
    rises = {
        h: [100.0 * v * abs(v) / (2 * 9.80665) for v in sb.simulate(true_stack(h)).rebound_speeds]
        for h in FALLS
    }
    rows = (f"{100 * h:g},{upper:.2f},{lower:.2f}\n" for h, (lower, upper) in rises.items())
    return table("Drop height (cm),Tennis (cm),Basketball (cm)\n" + "".join(rows))


@pytest.mark.parametrize(
    ("text", "names", "value"),
    [
        ("height (m),tennis (cm),basketball (cm)\n1,200,3\n", "rebound_heights", 0.03),
        ("Fallhöhe;Tennis (cm);Basketball (cm)\n1,0;200,0;3,0\n", "rebound_heights", 0.03),
        ("v0 (m/s),basketball v/v0,tennis v/v0\n4.4,0.1,1.3\n", "rebound_ratios", 0.1),
    ],
)
def test_a_column_names_a_ball_and_the_heavier_one_is_below(table, text, names, value):
    found = read_stack(table(text), ["0.01"] if names == "rebound_ratios" else ["1 cm"])
    (drop,), (data,) = found.drops.values(), found.data.values()
    assert [ball.name for ball in drop.balls] == ["basketball", "tennis"]
    assert data[f"{names}.0"] == (pytest.approx(value), pytest.approx(0.01))


def test_a_gap_of_its_own_for_each_drop(table):
    found = read_stack(
        table("gap (mm),h0 (cm),tennis (cm),basketball (cm)\n0,60,90,1\n2,60,95,1\n")
    )
    assert [drop.gaps for drop in found.drops.values()] == [(0.0,), (0.002,)]
    models = standard_models(found.drops)
    assert not [path for path in models["Hysteretic"].vary if path.startswith("gaps")]


@pytest.mark.parametrize(
    ("errors", "rows", "error", "note"),
    [
        ([], "60,120,1\n60,124,1\n", 0.04 / 2**0.5, "scatter of repeated drops, with 1 degree of"),
        ([], "60,120,1\n90,184,2\n", 0.005, "half of the step in which it was written, 5 mm"),
        (["2 cm"], "60,120,1\n60,124,1\n", 0.02, "The balls are stacked basketball below tennis."),
    ],
)
def test_where_errors_come_from(table, errors, rows, error, note):
    found = read_stack(table("height (cm),tennis (cm),basketball (cm)\n" + rows), errors)
    assert found.data["row_2"]["rebound_heights.1"][1] == pytest.approx(error)
    assert any(note in said for said in found.notes)


@pytest.mark.parametrize(
    "text",
    [
        "student,height (cm),tennis (cm),basketball (cm)\nAnna,60,120,2\nBen,90,184,3\n",
        "error,height,tennis,basketball,temperature\n1,60,120,2,21\n1,90,184,3,21\n",
    ],
)
def test_other_columns_are_passed_over_and_heights_have_one_unit(table, text):
    found = read_stack(table(text), ["1 cm"])
    assert [data["rebound_heights.0"] for data in found.data.values()] == [
        (0.02, 0.01),
        (0.03, 0.01),
    ]


def test_a_row_without_a_ball_is_told_and_a_wrong_one_refused(table):
    head = "height (cm),tennis (cm),basketball (cm)\n60,120,1\n"
    found = read_stack(table(head + "90,,\n"))
    assert list(found.drops) == ["row_2"]
    assert any("Row 3 has no" in note for note in found.notes)
    with pytest.raises(InvalidValue, match="row 3: height must be"):
        read_stack(table(head + "-90,120,1\n"))
    assert read_stack(table("height (cm),tennis (cm)\n60,40\n")) is None


def test_a_table_alone_gives_stiffness_and_restitution(by_height, tmp_path, capsys):
    picture = tmp_path / "stack.svg"
    assert main(["fit", str(by_height), "--plot", str(picture), "--cite"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "The balls are stacked basketball below tennis." in said
    assert "8 numbers of 4 drops" in said
    assert "doi = {10.1119/1.2772286}" in said
    assert "drop height (m)" in picture.read_text("utf-8")
    assert main(["fit", str(by_height), "--json"]) == 0
    values = json.loads(capsys.readouterr().out)["values"]
    assert values["restitution"]["value"] == pytest.approx(0.85, abs=0.002)
    assert main(["fit", str(by_height), "--mass", "50g"]) == 2
    assert "--mass is of a table of bounces" in capsys.readouterr().err


def test_a_fit_is_drawn_against_the_gap_and_shows_itself():
    gaps = (0.0, 1e-3, 2e-3, 4e-3)
    drops = {f"gap_{k}": true_stack(1.0, gap) for k, gap in enumerate(gaps)}
    data = {
        key: {"rebound_ratios": [(ratio, 0.01) for ratio in sb.simulate(drop).rebound_ratios]}
        for key, drop in drops.items()
    }
    found = sb.fit(drops, data, {"contacts.1.stiffness": (300.0, 5000.0)})
    above, below = plots.fit(found).axes[:2]
    assert below.get_xlabel() == "gap (mm)"
    curves = [line for line in above.lines if line.get_linestyle() == "-"]
    assert [len(line.get_xdata()) for line in curves] == [80, 80]
    best, deviations = found.along(number_at(drops["gap_0"], "gaps.0"), np.array(gaps))
    fitted = [[row.fitted for row in found.residuals if row.drop == key] for key in drops]
    assert best["rebound_ratios"] == pytest.approx(np.array(fitted), rel=1e-9)
    stiffness = found["contacts.1.stiffness"]
    slopes = [abs(slope(drop, stiffness.nominal_value)) for drop in drops.values()]
    assert deviations["rebound_ratios"][:, 1] == pytest.approx(
        np.array(slopes) * stiffness.std_dev, rel=1e-3
    )
    assert repr(found).splitlines()[1].split()[0] == "contacts.1.stiffness"
    assert "Chi squared" in found._repr_html_()
    assert "8 numbers of 4 drops" in cite(found)


def slope(drop, stiffness, step=1.0):
    """The derivative of the upper ball's ratio by the upper stiffness."""
    ends = []
    for k in (stiffness - step, stiffness + step):
        laws = [drop.contacts[0], sb.Hysteretic(k, restitution=0.85)]
        ends.append(sb.simulate(sb.Drop(drop.balls, laws, drop.gaps, height=1.0)).rebound_ratios[1])
    return (ends[1] - ends[0]) / (2.0 * step)
