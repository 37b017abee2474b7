"""``stackbounce fit --compare`` and the paper's data sets on the command line."""

import pytest
from rich.console import Console

import stackbounce as sb
from stackbounce.cli.fit_tables import print_comparison


def test_a_data_set_is_fitted_by_its_name(told):
    found = told("fit", "cross2007/B1-B2")
    assert list(found["values"]) == ["contacts.0.stiffness", "contacts.1.stiffness", "gaps.0"]
    assert [row["measured"] for row in found["residuals"][:2]] == [0.28, 1.91]


def test_what_varies_in_a_data_set_can_be_told(told):
    more = ("--vary", "contacts.0.restitution=0.5:1")
    assert told("fit", "cross2007/B1-B2", *more)["values"]["contacts.0.restitution"]["value"] > 0.8


@pytest.mark.slow
def test_the_usual_models_side_by_side(printed, tmp_path):
    picture = tmp_path / "compared.svg"
    out = printed("fit", "cross2007/B1-B3", "--compare", "--plot", str(picture))
    lines = [line.split("  ")[0] for line in out.splitlines()]
    # Springs without loss throw B3 too high
    assert 0 < lines.index("Rigid, one for each contact") < lines.index("Spring")
    # three numbers were measured: the lossy ones, which have four, cannot be fitted
    assert "HuntCrossley: vary has 4 numbers for 3 measured numbers" in out
    assert "as long as yours at 1.981 m/s, the geometric mean" in " ".join(out.split())
    assert picture.read_text(encoding="utf-8").startswith("<?xml")


def test_a_comparison_for_machines(told):
    found = told("fit", "cross2007/B1", "--compare")
    assert found["calibration_speed"] == pytest.approx((2.0 * 9.80665 * 0.2) ** 0.5, rel=1e-9)
    best = found["scores"][0]
    assert best["chi_squared"] < 1e-9
    assert (best["model"], best["same_as"][:1]) == ("Hysteretic", ["Hysteretic, Hertz loading"])


def test_models_of_as_many_numbers_are_as_far_apart_as_their_chi_squared(capsys):
    balls, vary = [sb.Ball(0.15), sb.Ball(0.057)], {"contacts.0.restitution": (0.1, 1.0)}
    right, wrong = (
        sb.Drop(balls, [sb.Rigid(0.8), sb.Rigid(e)], impact_speed=3.0) for e in (0.9, 0.5)
    )
    ratios = [(ratio, 0.01) for ratio in sb.simulate(right).rebound_ratios]
    models = {"right": sb.Model(right, vary), "wrong": sb.Model(wrong, vary)}
    print_comparison(Console(width=100), sb.compare(models, {"rebound_ratios": ratios}), 3.0)
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    best, other = (row for row in rows if row and row[0] in models)
    assert float(other[5]) - float(best[5]) == pytest.approx(float(other[2]), abs=1.0)
