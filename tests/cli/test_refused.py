"""Commands that are refused in one line: ``refused.toml`` lists them."""

import shlex
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from measure import make_files as made

LAB = Path(__file__).parents[2] / "docs" / "lab"
TABLE = tomllib.loads(Path(__file__).with_name("refused.toml").read_text(encoding="utf-8"))
LINES = [
    (f"{group['command']} {words}", line)
    for group in TABLE["refused"]
    for words, line in group["lines"]
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refused")
    shutil.copytree(LAB, folder, dirs_exist_ok=True)
    made.main(folder / "made")
    (folder / "folder.svg").mkdir()
    for name, text in TABLE["files"].items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def files(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(("command", "line"), LINES)
def test_it_says_why_and_writes_nothing(refused, folder, monkeypatch, command, line):
    monkeypatch.chdir(folder)
    before = files(folder)
    err = refused(*shlex.split(command)).removesuffix("\n")
    assert err.startswith(line.removesuffix("…"))
    assert line.endswith("…") or err == line
    assert files(folder) == before


# --- draws of the numbers of a drop: ``stackbounce fit --draws`` and ``sweep --draws``
MEASURED = ("basketball", "tennis", "--measured", "rebound_ratios.1=1.64 ± 0.02")


def test_the_draws_of_a_fit_are_drops_of_a_sweep(printed):
    tie = "contacts.0.stiffness=1500+0.5*contacts.1.stiffness"
    what = (*MEASURED, "--height", "63cm")
    vary = ("--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m", "--tie", tie)
    files = ("--sample", "1600", "--draws", "draws.csv", "--save", "fitted.toml")
    out = printed("fit", *what, *vary, *files)
    assert "Draws: draws.csv; now: stackbounce sweep … --draws draws.csv\n" in out
    out = printed("sweep", "fitted.toml", "--draws", "draws.csv", "--out", "bounce.zarr")
    with xr.open_zarr("bounce.zarr") as data:
        upper, lower = data.contacts_1_stiffness.values, data.contacts_0_stiffness.values
        assert lower == pytest.approx(1500.0 + 0.5 * upper)
        assert float(data.rebound_ratio.sel(ball=1).std()) == pytest.approx(0.02, rel=0.3)
    assert np.loadtxt("draws.csv", delimiter=",", skiprows=1).shape == (data.sizes["draw"], 2)


def test_a_sweep_of_draws_has_one_drop_for_each_row(printed, told):
    Path("draws.csv").write_text("gaps.0 (mm);balls.0.mass (g)\n1,5;24,8\n\n2;30\n")
    given = ("sweep", "basketball", "tennis", "--draws", "draws.csv", "--out", "draws.zarr")
    out = printed(*given, "--over", "height=1,2,3")
    assert "draw: 2, each with its own\n" in out
    assert "    gaps_0: 0.0015 to 0.002 m\n" in out
    with xr.open_zarr("draws.zarr") as data:
        assert data.rebound_ratio.dims == ("draw", "height", "ball")
        assert data.balls_0_mass.values.tolist() == [0.0248, 0.03]
        assert data.gaps_0.dims == ("draw",)
    assert told(*given, "--over", "height=1,2,3")["over"] == {"draw": 2, "height": 3}
