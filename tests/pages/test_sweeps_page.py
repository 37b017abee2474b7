"""The page of maps and lines: its commands draw its pictures, and these agree with the paper's."""

import re
import runpy
import shlex

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from pages.consoles import DOCS, FENCE, read_page, write_files
from stackbounce.cli import main
from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.figures_models import (
    after_collision,
    rebound_by_mass,
    rebound_by_stiffness,
)

TEXT = read_page("sweeps")
WORDS = [
    [shlex.split(line)[1:] for line in fence.replace("\\\n", " ")[2:].split("\n$ ")]
    for fence in FENCE.findall(TEXT)
]
COMMANDS = [words for (words, *_) in WORDS if "--plot" in words]
(OF_DRAWS,) = (commands for commands in WORDS if len(commands) > 1)


@pytest.fixture(scope="module")
def sweeps():
    module = runpy.run_path(str(DOCS / "figures" / "sweeps.py"))
    return {name: sb.sweep(*what) for name, what in module["SWEEPS"].items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    write_files(TEXT, folder)
    return folder


@pytest.fixture
def bench():
    return Bench(PAPER)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("command", COMMANDS, ids=lambda words: words[-1])
def test_a_command_makes_the_data_of_its_picture(command, sweeps, folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert main(command) == 0
    store = command[command.index("--out") + 1]
    xr.testing.assert_equal(xr.open_zarr(store).load(), sweeps[store.removesuffix(".zarr")])
    assert (folder / command[-1]).stat().st_size > 10_000


def test_draws_are_dropped_from_each_height(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert [main(words) for words in OF_DRAWS] == [0, 0]
    ds = xr.open_zarr("posterior.zarr")
    assert dict(ds.status.sizes) == {"draw": 2400, "height": 3}
    assert ds.rebound_ratio.std("draw").sel(ball=1).values == pytest.approx(0.02, rel=0.2)


def test_every_picture_has_its_command():
    shown = re.findall(r"^\.\. plot:: figures/sweeps.py (\w+)$", TEXT, re.MULTILINE)
    assert len(COMMANDS) == len(shown) == len(set(shown)) > 0


def test_lines_are_those_of_figures_4a_and_6(sweeps, bench):
    of_mass, of_stiffness = sweeps["mass"], sweeps["stiffness"]
    masses, mass_ratio = of_mass["balls.0.mass"], bench("basketball.mass") / bench("tennis.mass")
    own = rebound_by_mass(bench, masses.values[::20], bench("models.stiffness_ratio"))
    assert of_mass.rebound_ratio.values[::20] == pytest.approx(own.T, abs=1e-11)
    own = rebound_by_stiffness(bench, mass_ratio, np.geomspace(0.1, 100.0, 241)[::20])
    assert of_stiffness.rebound_ratio.values[::20] == pytest.approx(own.T, abs=1e-11)


def test_lines_are_those_of_figure_2_where_they_meet_once_or_twice(sweeps, bench):
    ds = sweeps["separate"]
    for count in (1, 2):
        own = ds.isel({"balls.0.mass": (ds.collisions.sel(contact=1) == count).values})
        masses, ratios = own["balls.0.mass"].values, own.rebound_ratio.values
        after = after_collision(bench, masses[::10], bench("models.restitution"), count)
        back = -bench("models.restitution") * after[0]  # from the floor, where it went down again
        after[0] = np.where(after[0] < 0.0, back, after[0])
        assert ratios[::10] == pytest.approx(after.T, abs=1e-12)


def test_a_gap_of_one_millimetre_is_section_v(sweeps):
    at = sweeps["gap"].sel({"gaps.0": 0.001}, method="nearest").rebound_ratio
    assert at.values == pytest.approx([0.24, 1.83], abs=0.04)
