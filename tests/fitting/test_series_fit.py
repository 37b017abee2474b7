"""`fit_series`: all datasets, all laws, and the page of it."""

import csv
import json

import pytest

from stackbounce import datasets
from stackbounce.cli import main
from stackbounce.errors import FileError
from stackbounce.fitting.series import fit_series, write
from stackbounce.fitting.series.comparison import AGREES, REFUTED, verdict
from stackbounce.model import LAWS

ALL = ("fit", "dataset:all", "--compare")
FEW = ("granite-spheres", "superball-knocks")


@pytest.fixture
def few(monkeypatch):
    """Let there be two datasets only."""
    monkeypatch.setattr(datasets, "names", lambda: FEW)


@pytest.mark.usefixtures("few")
def test_the_files_hold_what_was_found(tmp_path, capsys):
    out = tmp_path / "laws"
    assert main([*ALL, "--out", str(out), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    written = json.loads((out / "laws.json").read_text("utf-8"))
    assert [one["name"] for one in told["series"]] == list(FEW[1:])
    assert [one["name"] for one in written["series"]] == list(FEW[1:])
    assert written["left_out"] == {"granite-spheres": "it has one value only"}
    with (out / "laws.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    asked = [(one["name"], law["law"]) for one in written["series"] for law in one["laws"]]
    assert [(row["dataset"], row["law"]) for row in rows] == asked
    page = (out / "index.html").read_text("utf-8")
    assert written["summary"] in page
    for one in written["series"]:
        assert one["summary"] in page
        assert datasets.describe(one["name"]).address in page
        assert (out / "figures" / f"{one['name']}.svg").read_bytes().startswith(b"<?xml")


@pytest.mark.slow
@pytest.mark.usefixtures("few")
def test_the_same_version_writes_the_same_bytes(tmp_path):
    for name in ("one", "two"):
        write(fit_series("dataset:all"), tmp_path / name)
    files = [path.relative_to(tmp_path / "one") for path in (tmp_path / "one").rglob("*.*")]
    assert len(files) == 5
    for name in files:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


@pytest.mark.usefixtures("few")
def test_a_file_of_somebody_else_stays(tmp_path):
    (tmp_path / "index.html").write_text("mine")
    with pytest.raises(FileError, match=r"index\.html"):
        write(fit_series("dataset:all"), tmp_path)
    assert (tmp_path / "index.html").read_text() == "mine"


@pytest.fixture(scope="module")
def everything():
    return fit_series("dataset:all")


@pytest.mark.slow
def test_every_dataset_is_compared_or_has_a_reason_and_the_summary_counts_them(everything):
    compared = [found.series.name for found in everything.comparisons]
    assert sorted([*compared, *everything.left_out]) == list(datasets.names())
    assert len(compared) >= 15
    for found in everything.comparisons:
        asked = [name for outcome in found.outcomes for name in outcome.laws]
        assert sorted([*asked, *found.skipped]) == sorted(LAWS)
    verdicts = sum(len(found.outcomes) for found in everything.comparisons)
    shaky = sum(not found.steady for found in everything.comparisons)
    assert everything.summary.startswith(f"{len(compared)} series have {verdicts} verdicts")
    assert f"change a verdict in {shaky} of the series" in everything.summary


def laws_of(comparison, verdict):
    return {name for one in comparison.outcomes if one.verdict == verdict for name in one.laws}


def p_of(comparison, law):
    return next(one.p for one in comparison.outcomes if law in one.laws)


@pytest.mark.slow
def test_what_the_docs_say_of_balls_and_laws(everything):
    found = {one.series.name: one for one in everything.comparisons}
    golf = found["golf-marble-flights"]
    assert golf.tells_apart
    assert golf.steady
    assert {"Rigid", "Dashpot", "Hysteretic"} <= laws_of(golf, AGREES)
    assert {"Viscoelastic", "HuntCrossley"} <= laws_of(golf, REFUTED)
    assert "Without the drag of the air: Viscoelastic doubtful (p: 0.047)" in golf.summary
    assert p_of(golf, "Viscoelastic") == pytest.approx(0.0067, abs=5e-5)
    heights = found["golf-marble-heights"]
    assert p_of(heights, "Rigid") == pytest.approx(0.48, abs=5e-3)
    assert p_of(heights, "Viscoelastic") == pytest.approx(0.77, abs=5e-3)
    rubber = found["rubber-ball-two-heights"]
    assert rubber.tells_apart
    assert "HuntCrossley" in laws_of(rubber, AGREES)
    assert not found["table-tennis-nine-heights"].tells_apart
    assert "superball-contact-time" in everything.left_out
    assert laws_of(found["superball-knocks"], REFUTED) == {"RigidBySpeed"}
    refuted = [name for name in found if "HuntCrossley" in laws_of(found[name], REFUTED)]
    assert len(refuted) > len(found) / 2
    assert any(not laws_of(comparison, AGREES) for comparison in found.values())
    (rigid,) = (
        law for law in found["table-tennis-parquet-flights"].outcomes if "Rigid" in law.laws
    )
    assert rigid.verdict == AGREES
    assert verdict(rigid.p_without_air) == REFUTED
